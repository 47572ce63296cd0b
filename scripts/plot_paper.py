#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the figures of a study, a sweep, an analysis or a run for print.

    plot_paper.py FOLDER [-o OUT] [--only ID ...] [--formats pdf,png] [--width auto|single|double]

FOLDER is what Abradem wrote: its tables/figures.json says what is drawn from which rows of tables/*.csv; a run's
folder has no such file, and its tables are drawn as in its report. Each figure becomes OUT/<id>.<format> (OUT:
FOLDER/figures), 85 or 175 mm wide, in colours that the colour-blind can tell apart; OUT/captions.txt holds the
captions. Needs matplotlib 3.6 or newer.
"""
import argparse
import csv
import json
import math
import pathlib
import sys
import textwrap

SINGLE, DOUBLE = 85 / 25.4, 175 / 25.4  # widths of one column and of the page [inch]
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#000000", "#E69F00", "#56B4E9", "#7F7F7F"]  # Okabe and Ito
MARKERS = ["o", "s", "D", "^", "P", "*", "v", "h"]
THEIRS = "#555555"
DASHES = {"solid": "-", "dash": "--", "dot": ":"}
STYLE = {
    "font.size": 8, "axes.labelsize": 8, "axes.titlesize": 8, "legend.fontsize": 7, "xtick.labelsize": 7, "ytick.labelsize": 7,
    "font.family": "sans-serif", "font.sans-serif": ["Arial", "Helvetica", "Liberation Sans", "DejaVu Sans"], "axes.linewidth": 0.6,
    "xtick.major.width": 0.6, "ytick.major.width": 0.6, "lines.linewidth": 1.2, "lines.markersize": 3.5, "axes.spines.top": False,
    "axes.spines.right": False, "axes.formatter.useoffset": False, "legend.frameon": False, "pdf.fonttype": 42, "svg.fonttype": "none", "svg.hashsalt": "abradem",
}


class Problem(Exception):
    """What a user can act on."""


# ---------------------------------------------------------------- data

def read_rows(file):
    try:
        with open(file, newline="", encoding="utf-8") as stream:
            return list(csv.reader(stream))
    except OSError as error:
        raise Problem(f"{file}: {error.strerror}; figures need the tables that Abradem wrote beside its page") from error


def attach(figure, tables):
    """Hands each series of a specification its rows, as lists x, y, y_low, y_high, z."""
    rows = iter(read_rows(tables / figure["file"])[1:])
    for panel in figure["panels"]:
        for series in panel["series"]:
            mine = [row for _, row in zip(range(series["rows"]), rows)]
            if len(mine) < series["rows"]:
                raise Problem(f"{tables / figure['file']}: ends before the rows that figures.json names; make the page again")
            for column, role in enumerate(figure["roles"]):
                if role not in ("panel", "series"):
                    series[role] = [float(row[column]) for row in mine]
            if series["kind"] in ("heat", "surface"):
                width, z = series["width"], series["z"]
                series["x"], series["y"] = series["x"][:width], series["y"][::width] if width else []
                series["z"] = [z[k:k + width] for k in range(0, len(z), width)] if width else []
    return figure


def specification(number, name, title, panels, columns=1):
    return {"number": number, "id": name, "title": title, "caption": "", "columns": columns, "panels": panels}


def series_of(kind, name, x, y, colour=0, **more):
    return {"kind": kind, "name": name, "colour": colour, "dash": "solid", "theirs": False, "edges": "y_low" in more, "x": x, "y": y} | more


def run_figures(folder):
    """The figures of a single run, from its own tables."""
    tables = folder / "tables"

    def columns(name):
        header, *rows = read_rows(tables / f"{name}.csv")
        return {key: [float(row[c] or "nan") for row in rows] for c, key in enumerate(header)}

    record = json.loads((folder / "run.json").read_text(encoding="utf-8"))
    measured, unit = record.get("measurement", {}), record.get("counted", "revolution")
    turns, contours, profiles, force = (columns(name) for name in ("revolutions", "contours", "profiles", "force"))
    if not turns["revolution"]:
        raise Problem(f"{tables / 'revolutions.csv'}: no rows; the run ended before its first output")
    n, last = turns["revolution"], turns["revolution"][-1]
    along = {"title": f"{unit}s [-]"}

    def laboratory(low, high):
        return {**series_of("band", "measured", [min(0, n[0]), last], []), "y_low": [low, low], "y_high": [high, high], "theirs": True}

    def panel(title, x, y, series):
        return {"title": title, "x": {"log": False, "equal": False, **x}, "y": {"log": False, "equal": False, "title": y}, "series": series}

    volume = [series_of("line_markers", "mesh", n, turns["swept_volume_mm3"]), series_of("line", "wear law", n, turns["law_volume_mm3"], 1, dash="dash")]
    if any(map(math.isfinite, turns["paper_volume_mm3"])):
        volume.append(series_of("line", "paper's measure", n, turns["paper_volume_mm3"], 3, dash="dot"))
    if "wear_volume_mm3" in measured:
        mean, sd = (measured["wear_volume_mm3"][key] for key in ("mean", "sd"))
        volume.insert(0, laboratory(mean - sd, mean + sd))
    growth = []
    for title, key, factor, label in (("(a)", "depth", 1e3, "depth [µm]"), ("(b)", "width", 1.0, "width [mm]")):
        mean, sd = ([factor * v for v in turns[f"{key}_{what}_mm"]] for what in ("mean", "sd"))
        series = [series_of("line_markers", "mean and standard deviation", n, mean, y_low=[m - s for m, s in zip(mean, sd)], y_high=[m + s for m, s in zip(mean, sd)])]
        if f"{key}_mm" in measured:
            series.insert(0, laboratory(*(factor * measured[f"{key}_mm"][end] for end in ("low", "high"))))
        growth.append(panel(title, along, label, series))
    cuts = []
    for colour, angle in enumerate(sorted({a for a, r in zip(profiles["angle_deg"], profiles["revolution"]) if r == last})):
        points = sorted((x, 1e3 * y) for x, y, a, r in zip(profiles["radius_mm"], profiles["height_mm"], profiles["angle_deg"], profiles["revolution"])
                        if r == last and a == angle)
        cuts.append(series_of("line", f"{angle:.4g}°", [x for x, _ in points], [y for _, y in points], colour % 8, dash="solid" if colour < 8 else "dash"))
    spread = []
    for title, key, factor, label in (("(a)", "depth_mm", 1e3, "depth [µm]"), ("(b)", "width_mm", 1.0, "width [mm]")):
        values = [factor * v for v, r in zip(contours[key], contours["revolution"]) if r == last and math.isfinite(v)]
        centres, counts = histogram(values)
        spread.append(panel(title, {"title": label}, "contours [-]", [series_of("bars", "", centres, counts)]))
    boxes = series_of("box", "", [], [], boxes=box_statistics([math.ceil(r - 1e-9) or 1 for r in force["revolution"]], force["normal_force_N"]))
    return [specification(1, "volume", f"Wear volume against {unit}s", [panel("", along, "wear volume [mm³]", volume)]),
            specification(2, "growth", f"Depth and width against {unit}s", growth, 2),
            specification(3, "contours", f"Contours after {unit} {last:g}", [panel("", {"title": "radius [mm]"}, "height [µm]", cuts)]),
            specification(4, "spread", f"Depth and width over the contours after {unit} {last:g}", spread, 2),
            specification(5, "force", f"Normal force in each {unit}", [panel("", {"title": f"{unit} [-]"}, "normal force [N]", [boxes])])]


def histogram(values):
    if not values:
        return [], []
    low, high, bins = min(values), max(values), max(5, round(1.2 * math.sqrt(len(values))))
    step = (high - low) / bins or max(1e-6, 1e-3 * abs(high))
    counts = [0] * bins
    for value in values:
        counts[min(bins - 1, int((value - low) / step))] += 1
    return [low + (k + 0.5) * step for k in range(bins)], counts


def box_statistics(groups, values):
    """Quartiles of type 7, whiskers to the last value within 1.5 quartile ranges, as Abradem's own."""
    out = []
    for group in sorted(set(groups)):
        data = sorted(v for g, v in zip(groups, values) if g == group and math.isfinite(v))
        if not data:
            continue

        def quantile(p):
            at = p * (len(data) - 1)
            k = min(int(at), len(data) - 2) if len(data) > 1 else 0
            return data[k] + (at - k) * (data[min(k + 1, len(data) - 1)] - data[k])

        q1, median, q3 = (quantile(p) for p in (0.25, 0.5, 0.75))
        inside = [v for v in data if q1 - 1.5 * (q3 - q1) <= v <= q3 + 1.5 * (q3 - q1)]
        out.append({"x": group, "q1": q1, "median": median, "q3": q3, "low": inside[0], "high": inside[-1],
                    "outliers": [v for v in data if v < inside[0] or v > inside[-1]]})
    return out


# ---------------------------------------------------------------- drawing

def style(series, panel):
    """Colour, marker and dash as on the page: theirs are hollow, and grey where a panel has one of them."""
    others = {s["name"] for s in panel["series"] if s["theirs"] and s["kind"] != "band"}
    grey = series["theirs"] and (series["kind"] == "band" or len(others) == 1)
    dash = "dash" if series["theirs"] and series["dash"] == "solid" else series["dash"]
    return THEIRS if grey else COLOURS[series["colour"]], MARKERS[series["colour"]], DASHES[dash]


def spacing(positions):
    at = sorted(set(positions))
    return min((b - a for a, b in zip(at, at[1:])), default=1.0)


def place(series, panel, kind, share):
    """Width, and offset of one of several boxes or bars at a position."""
    all_of = [s for s in panel["series"] if s["kind"] == kind]
    at = [b["x"] for s in all_of for b in s["boxes"]] if kind == "box" else [v for s in all_of for v in s["x"]]
    width = share * spacing(at) / len(all_of)
    return width, (next(k for k, s in enumerate(all_of) if s is series) - (len(all_of) - 1) / 2) * width


def draw_line(axes, series, panel):
    colour, marker, dash = style(series, panel)
    lines, markers, many = series["kind"] != "markers", series["kind"] != "line", len(series["x"]) > 150
    options = {"color": colour, "linestyle": dash if lines else "none", "rasterized": len(series["x"]) > 5000, "zorder": 4 if series["theirs"] else 3}
    if markers:
        options |= {"marker": marker, "markerfacecolor": "none" if series["theirs"] else colour, "markeredgewidth": 0.8, "markersize": 1.5 if many else 4}
    if series.get("edges"):
        errors = [[y - low for y, low in zip(series["y"], series["y_low"])], [high - y for y, high in zip(series["y"], series["y_high"])]]
        return axes.errorbar(series["x"], series["y"], [[max(0.0, e) if math.isfinite(e) else 0.0 for e in side] for side in errors], capsize=1.6, elinewidth=0.7, **options)
    return axes.plot(series["x"], series["y"], **options)[0]


def draw_band(axes, series, panel):
    return axes.fill_between(series["x"], series["y_low"], series["y_high"], color=style(series, panel)[0], alpha=0.22, linewidth=0, zorder=1)


def draw_box(axes, series, panel):
    colour, (width, offset) = style(series, panel)[0], place(series, panel, "box", 0.66)
    statistics = [{"q1": b["q1"], "med": b["median"], "q3": b["q3"], "whislo": b["low"], "whishi": b["high"], "fliers": b["outliers"]} for b in series["boxes"]]
    line = {"color": colour, "linewidth": 0.7}
    drawn = axes.bxp(statistics, [b["x"] + offset for b in series["boxes"]], widths=0.8 * width, patch_artist=True, manage_ticks=False, boxprops={"facecolor": colour + "33", "edgecolor": colour, "linewidth": 0.7},
                     medianprops={"color": colour, "linewidth": 1.1}, whiskerprops=line, capprops=line,
                     flierprops={"marker": ".", "markersize": 1.5, "markerfacecolor": colour, "markeredgecolor": "none", "rasterized": True})
    at = sorted({b["x"] for b in series["boxes"]})
    if len(at) <= 15 and not panel["x"].get("labels"):
        axes.set_xticks(at, [f"{v:g}" for v in at])
    return drawn["boxes"][0] if drawn["boxes"] else None


def draw_bars(axes, series, panel):
    colour, named = style(series, panel)[0], bool(panel["x"].get("labels"))
    width, offset = place(series, panel, "bars", 0.8) if named else (spacing(series["x"]), 0.0)
    look = {"facecolor": "none", "edgecolor": colour, "linewidth": 0.8} if series["theirs"] else {"facecolor": colour, "alpha": 0.75, "edgecolor": "white", "linewidth": 0.4}
    return axes.bar([v + offset for v in series["x"]], series["y"], width, zorder=1, **look)


def scale(figure, title):
    values = [v for p in figure["panels"] for s in p["series"] if s.get("z_title") == title for row in s["z"] for v in row if math.isfinite(v)]
    low, high = (min(values), max(values)) if values else (0.0, 1.0)
    return {"vmin": low, "vmax": high, "cmap": "YlGnBu_r" if high <= 0 or (low < 0 and -low > high) else "YlGnBu"}


def draw_heat(axes, series, colours):
    return axes.pcolormesh(series["x"], series["y"], series["z"], shading="nearest", rasterized=True, **colours)


def draw_surface(axes, series, colours):
    import numpy
    from matplotlib import cm, colors

    x, y = numpy.meshgrid(series["x"], series["y"])
    z = numpy.array(series["z"], dtype=float)
    if series["polar"]:
        x, y = y * numpy.cos(numpy.radians(x)), y * numpy.sin(numpy.radians(x))
        if 359.5 < series["x"][-1] - series["x"][0] + spacing(series["x"]) and series["x"][-1] - series["x"][0] < 359.999:  # close the ring
            x, y, z = (numpy.column_stack([a, a[:, 0]]) for a in (x, y, z))
    extent, tall = max(numpy.ptp(x), numpy.ptp(y)), (numpy.nanmax(z) - numpy.nanmin(z)) or 1.0
    exaggeration = series["exaggeration"] or (0.06 if series["polar"] else 0.2) * extent / (tall * series["z_unit"])
    painted = cm.ScalarMappable(colors.Normalize(colours["vmin"], colours["vmax"]), colours["cmap"])
    step = [max(1, n // 240) for n in z.shape]
    axes.plot_surface(x, y, z, facecolors=painted.to_rgba(z), rstride=step[0], cstride=step[1], shade=False, rasterized=True, linewidth=0, antialiased=False)
    axes.set_box_aspect((numpy.ptp(x) / extent, numpy.ptp(y) / extent, max(0.02, tall * series["z_unit"] * exaggeration / extent)), zoom=1.15)
    axes.set_zlabel(series["z_title"])
    if series["polar"]:
        unit = series.get("unit", "")
        axes.set(xlabel=f"x {unit}", ylabel=f"y {unit}", zticks=[], zlabel="")
    return painted


DRAW = {"line": draw_line, "markers": draw_line, "line_markers": draw_line, "band": draw_band, "box": draw_box, "bars": draw_bars}


def log_ticks(axis, low, high):
    """1, 2, 5 over few decades, as numbers where they are short."""
    from matplotlib import ticker

    decades = math.log10(high / low) if low > 0 else 9
    steps = [1, 1.5, 2, 3, 4, 5, 6, 8] if decades < 0.7 else [1, 2, 5] if decades < 2.2 else [1]
    axis.set_major_locator(ticker.LogLocator(subs=steps))
    if decades < 7 and 1e-3 <= low and high < 1e5:
        axis.set_major_formatter(ticker.FuncFormatter(lambda v, _: f"{v:.3g}" if v < 1000 else f"{v:.0f}"))
    elif decades >= 2.2:
        axis.set_major_formatter(ticker.FuncFormatter(lambda v, _: power(round(math.log10(v))) if v > 0 else ""))
    if decades < 2.2:
        axis.set_minor_formatter(ticker.NullFormatter())


def power(exponent):
    return "10" + "".join("⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".index(c)] for c in str(exponent))


def scaled(axis, title):
    """Takes the power of ten of very small and very large numbers into the unit: [10⁻¹¹ 1/Pa]."""
    from matplotlib import ticker

    size = max(map(abs, axis.get_view_interval()))
    exponent = math.floor(math.log10(size) + 1e-9) if size > 0 else 0
    if -4 < exponent < 5:
        return title
    axis.set_major_formatter(ticker.FuncFormatter(lambda v, _: f"{v / 10.0**exponent:.4g}"))
    at = title.rfind("[")
    return f"{title[:at]}[{power(exponent)}{']' if title[at:] == '[-]' else ' ' + title[at + 1:]}" if at >= 0 else f"{title} [{power(exponent)}]"


def set_axes(axes, panel, width):
    for which in "xy":
        description = panel[which]
        title = description["title"]
        if not description["log"] and not description.get("labels"):
            title = scaled(getattr(axes, f"{which}axis"), title)
        lines = textwrap.wrap(title, max(16, int(width * 72 / 4.1 * (1.0 if which == "x" else 0.75))))
        getattr(axes, f"set_{which}label")("\n".join(lines).replace("$", r"\$"))
        if description["log"]:
            getattr(axes, f"set_{which}scale")("log")
            log_ticks(getattr(axes, f"{which}axis"), *(getattr(axes, f"get_{which}lim")() if not description.get("range") else description["range"]))
        if description.get("range"):
            getattr(axes, f"set_{which}lim")(description["range"])
        if description.get("labels"):
            getattr(axes, f"set_{which}ticks")([at for at, _ in description["labels"]], [text for _, text in description["labels"]])
    if panel["x"]["equal"] or panel["y"]["equal"]:
        axes.set_aspect("equal", adjustable="datalim")


def draw_panel(axes, panel, figure, width):
    """Draws one panel.   Returns what the legend names and the colour scale, if any."""
    legend, mappable = {}, None
    for series in panel["series"]:
        if series["kind"] in ("heat", "surface"):
            series["unit"] = panel["y"]["title"][panel["y"]["title"].rfind("["):] if "[" in panel["y"]["title"] else ""
            colours = scale(figure, series["z_title"])
            if series["z"]:
                mappable = (draw_heat if series["kind"] == "heat" else draw_surface)(axes, series, colours), series["z_title"]
            continue
        if not series["x"] and not series.get("boxes"):
            continue
        handle = DRAW[series["kind"]](axes, series, panel)
        if series["name"] and handle is not None:
            legend.setdefault(series["name"], handle)
    if not axes.has_data():
        axes.text(0.5, 0.5, "no data", transform=axes.transAxes, ha="center", va="center", color=THEIRS)
    if panel["title"]:
        axes.set_title(panel["title"].replace("$", r"\$"), loc="left", fontweight="bold")
    if not any(s["kind"] == "surface" for s in panel["series"]):
        set_axes(axes, panel, width)
    return legend, mappable


def draw(figure, width):
    import matplotlib.pyplot as plt

    panels, columns = figure["panels"], max(1, min(figure["columns"], len(figure["panels"])))
    rows = math.ceil(len(panels) / columns)
    size = {"auto": SINGLE if columns == 1 else DOUBLE, "single": SINGLE, "double": DOUBLE}[width]
    cell = size / columns
    solid = [any(s["kind"] == "surface" for s in panel["series"]) for panel in panels]
    page = plt.figure(figsize=(size, rows * max(1.5, (0.95 if any(solid) else 0.72) * cell) + 0.1), layout="constrained")
    legend = {}
    for k, panel in enumerate(panels):
        axes = page.add_subplot(rows, columns, k + 1, projection="3d" if solid[k] else None)
        named, mappable = draw_panel(axes, panel, figure, 0.8 * cell)
        for name, handle in named.items():
            legend.setdefault(name, handle)
        # A ring in 3D leaves little room beside it: one scale is enough where another panel has it.
        shown = any(s["kind"] == "heat" and s["z_title"] == mappable[1] for p in panels for s in p["series"]) if mappable else False
        if mappable and not (solid[k] and shown):
            page.colorbar(mappable[0], ax=axes, label=mappable[1], shrink=0.8 if solid[k] else 1.0, pad=0.1 if solid[k] else 0.02)
    top = 0.0
    if legend:
        for count in range(len(legend), 0, -1):
            drawn = page.legend(legend.values(), [name.replace("$", r"\$") for name in legend], loc="upper center", ncol=count, bbox_to_anchor=(0.5, 1.0), borderaxespad=0.1, columnspacing=1.2, handlelength=1.8)
            box = drawn.get_window_extent(page.canvas.get_renderer())
            if box.width <= 0.98 * page.bbox.width or count == 1:
                break
            drawn.remove()
        page.set_size_inches(size, page.get_figheight() + box.height / page.dpi)
        top = box.height / page.bbox.height + 0.01
    page.get_layout_engine().set(rect=(0, 0, 1, 1 - top))
    return page


def load(folder):
    file = folder / "tables" / "figures.json"
    if file.is_file():
        try:
            return [attach(figure, folder / "tables") for figure in json.loads(file.read_text(encoding="utf-8"))]
        except (ValueError, KeyError) as error:
            raise Problem(f"{file}: {error!r}; make the page again with this version of Abradem") from error
    if (folder / "run.json").is_file():
        return run_figures(folder)
    raise Problem(f"{folder}: neither tables/figures.json nor run.json; expected a folder that Abradem wrote (run, sweep, analyse, …)")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("-o", "--output", type=pathlib.Path, help="where the figures go (FOLDER/figures)")
    parser.add_argument("--only", nargs="+", metavar="ID", help="these figures")
    parser.add_argument("--formats", default="pdf,png", help="of pdf, png, svg, eps; separated by commas (pdf,png)")
    parser.add_argument("--width", choices=["auto", "single", "double"], default="auto", help="85 mm, 175 mm, or by the number of panels")
    parser.add_argument("--dpi", type=int, default=300, help="of PNG and of what is rasterised (300)")
    options = parser.parse_args()
    try:
        import matplotlib
        if tuple(int(part) for part in matplotlib.__version__.split(".")[:2]) < (3, 6):
            raise Problem(f"matplotlib {matplotlib.__version__} is too old; plot_paper.py needs 3.6 or newer (pip install --upgrade matplotlib)")
        matplotlib.use("Agg")
        matplotlib.rcParams.update(STYLE)
        import matplotlib.pyplot as plt
        figures = load(options.folder)
        known = [figure["id"] for figure in figures]
        for wanted in options.only or []:
            if wanted not in known:
                raise Problem(f"no figure '{wanted}'; there are: {', '.join(known)}")
        output = options.output or options.folder / "figures"
        output.mkdir(parents=True, exist_ok=True)
        captions = []
        for figure in figures:
            if options.only and figure["id"] not in options.only:
                continue
            page = draw(figure, options.width)
            for kind in options.formats.split(","):
                undated = {"pdf": {"CreationDate": None}, "svg": {"Date": None}}.get(kind)
                page.savefig(output / f"{figure['id']}.{kind}", dpi=options.dpi, metadata=undated)
            plt.close(page)
            captions.append(f"Figure {figure['number']} ({figure['id']}). {figure['title']}. {figure['caption']}".rstrip())
        (output / "captions.txt").write_text("\n".join(captions) + "\n", encoding="utf-8")
    except ImportError as error:
        print(f"plot_paper.py needs matplotlib, which is not installed ({error}): apt install python3-matplotlib, or pip install matplotlib", file=sys.stderr)
        return 2
    except (Problem, ValueError, OSError) as error:
        print(f"plot_paper.py: {error}", file=sys.stderr)
        return 2
    print(f"{len(captions)} figures in {output}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
