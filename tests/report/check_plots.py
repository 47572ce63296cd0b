#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""check_plots.py SCRIPT FOLDER: runs plot_paper.py on FOLDER/page, FOLDER/study and on a run's folder; fails, saying why."""
import pathlib
import re
import struct
import subprocess
import sys

script, folder = sys.argv[1], pathlib.Path(sys.argv[2])
failures = []


def check(good, what):
    if not good:
        failures.append(what)


def plot(*arguments):
    return subprocess.run([sys.executable, "-W", "error", script, *map(str, arguments)], capture_output=True, text=True, check=False)


def width_mm(png):
    data = png.read_bytes()
    check(data[1:4] == b"PNG", f"{png}: no PNG")
    return 25.4 * struct.unpack(">I", data[16:20])[0] / 300


page = folder / "page"
done = plot(page, "--formats", "pdf,png,svg")
check(done.returncode == 0 and "7 figures" in done.stdout, f"page: {done.returncode}, {done.stdout}{done.stderr}")
names = {"mesh_size": 175, "forces": 85, "spread": 175, "disc": 85, "trace": 85, "nothing": 85, "discrepancies": 85}
for name, width in names.items():
    check(abs(width_mm(page / "figures" / f"{name}.png") - width) < 0.2, f"{name}.png is not {width} mm wide")
    check((page / "figures" / f"{name}.pdf").read_bytes().startswith(b"%PDF"), f"{name}.pdf: no PDF")
text = re.sub(r"<!--.*?-->", "", (page / "figures" / "mesh_size.svg").read_text(encoding="utf-8"), flags=re.S)
for wanted in ("wear depth [µm]", "mesh size [mm]", "(b) Width", "Yan et al. (2022), Fig. 7", "fit, 0.65 + 0.6 h"):
    check(wanted in text, f"mesh_size.svg lacks '{wanted}'")
captions = (page / "figures" / "captions.txt").read_text(encoding="utf-8")
check("Figure 1 (mesh_size). Depth and width against mesh size. Mean over" in captions, f"captions: {captions}")

# Same input, same bytes.
before = (page / "figures" / "forces.pdf").read_bytes()
plot(page, "--only", "forces")
check((page / "figures" / "forces.pdf").read_bytes() == before, "forces.pdf differs when it is drawn again")

# Of the published study the widest, the tallest, one over many decades, and the views in 3D.
study = folder / "study"
widths = {"table3-p-values": 175, "fig14-contours-paper": 175, "fig15-volumes": 175, "fig17-wear-profile": 85}
done = plot(study, "--formats", "png", "--only", *widths)
check(done.returncode == 0 and "4 figures" in done.stdout, f"study: {done.returncode}, {done.stdout}{done.stderr}")
for name, width in widths.items():
    check(abs(width_mm(study / "figures" / f"{name}.png") - width) < 0.2, f"{name}.png is not {width} mm wide")

run = folder / "run"
subprocess.run([sys.executable, pathlib.Path(__file__).parent / "make_run.py", run, "--revolutions", "3", "--size", "1"], check=True)
done = plot(run, "-o", folder / "of_run", "--formats", "png", "--width", "double")
check(done.returncode == 0 and "5 figures" in done.stdout, f"run: {done.returncode}, {done.stdout}{done.stderr}")
for name in ("volume", "growth", "contours", "spread", "force"):
    check(abs(width_mm(folder / "of_run" / f"{name}.png") - 175) < 0.2, f"{name}.png of a run is not 175 mm wide")

for arguments, wanted in (([page, "--only", "mesh-size"], "no figure 'mesh-size'; there are: mesh_size,"), ([folder / "none"], "neither tables/figures.json nor run.json")):
    done = plot(*arguments)
    check(done.returncode == 2 and wanted in done.stderr and "Traceback" not in done.stderr, f"{arguments}: {done.returncode}, {done.stderr}")
cut = page / "tables" / "trace.csv"
cut.write_text("\n".join(cut.read_text(encoding="utf-8").splitlines()[:100]), encoding="utf-8")
done = plot(page)
check(done.returncode == 2 and "trace.csv: ends before the rows" in done.stderr, f"a table cut short: {done.returncode}, {done.stderr}")

for failure in failures:
    print(f"FAIL {failure}", file=sys.stderr)
sys.exit(1 if failures else 0)
