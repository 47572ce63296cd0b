// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>

#include "abradem/analysis/contour.h"
#include "abradem/analysis/statistics.h"
#include "abradem/core/error.h"
#include "abradem/io/vtp_read.h"
#include "abradem/report/paper_figures.h"
#include "abradem/report/text.h"

namespace abradem::report {
namespace {

using Kind = Series::Kind;

/// Sections around the disc, from the surfaces that a run wrote; empty where it wrote none.
std::vector<analysis::Contour> sections_of(const FinishedRun& run) {
  const std::filesystem::path index = run.run->folder / "series.pvd";
  std::error_code ignored;
  if (!std::filesystem::exists(index, ignored)) return {};
  const std::vector<io::SeriesFrame> frames = io::read_pvd(index);
  if (frames.empty()) return {};
  // The first wall of the index; its first surface is the new one.
  std::vector<std::filesystem::path> files;
  for (const io::SeriesFrame& frame : frames)
    if (frame.part == frames.front().part) files.push_back(frame.file);
  if (files.size() < 2) return {};
  const geometry::TriangleMesh before = io::read_vtp(files.front()).mesh,
                               after = io::read_vtp(files.back()).mesh;
  if (before.vertices.size() != after.vertices.size())
    throw IoError(fmt::format("{}: its surfaces have {} and {} vertices", index.string(),
                              before.vertices.size(), after.vertices.size()));
  return analysis::cut_contours(after, before.vertices, analysis::worn_region(after, before.vertices, 1),
                                analysis::RotaryCuts{});
}

/// Height of a section at a radius, linear between its points; 0 beyond its ends [m].
double height_at(const std::vector<analysis::ProfilePoint>& profile, double radius) {
  const auto above = std::ranges::upper_bound(profile, radius, {}, &analysis::ProfilePoint::radius);
  if (above == profile.begin() || above == profile.end()) return 0.0;
  const auto below = above - 1;
  const double part = (radius - below->radius) / (above->radius - below->radius);
  return below->height + part * (above->height - below->height);
}

/// Heights over angle [deg] and radius [mm].
Series grid(const std::vector<analysis::Contour>& contours, double track, Kind kind) {
  constexpr double kHalf = 0.6e-3, kStep = 0.025e-3;
  Series series{.kind = kind,
                .name = "height",
                .z_title = "height [µm]",
                .polar = kind == Kind::surface,
                .z_unit = 1e-3};
  for (const analysis::Contour& c : contours) series.x.push_back(c.angle * 180.0 / std::numbers::pi);
  for (double r = track - kHalf; r <= track + kHalf + 1e-9; r += kStep) {
    series.y.push_back(1e3 * r);
    for (const analysis::Contour& c : contours) series.z.push_back(1e6 * height_at(c.profile, r));
  }
  return series;
}

Series depth_around(const std::vector<analysis::Contour>& contours, const PaperReading& reading) {
  Series series{.kind = Kind::line, .name = reading.name, .colour = reading.colour};
  for (const analysis::Contour& c : contours) {
    series.x.push_back(c.angle * 180.0 / std::numbers::pi);
    series.y.push_back(1e6 * c.depth);
  }
  return series;
}

/// What was measured, as the box that the bottom and the edges of a groove lie in.
void add_measured(Panel& panel, const PaperRuns& runs) {
  if (!runs.measured.depth || !runs.measured.width) return;
  const double near = 0.5e3 * runs.measured.width->low, far = 0.5e3 * runs.measured.width->high;
  const double shallow = -1e6 * runs.measured.depth->low, deep = -1e6 * runs.measured.depth->high;
  panel.series.push_back({.kind = Kind::band,
                          .name = "measured depths (3 contours)",
                          .x = {-0.2, 0.2},
                          .y_low = {deep, deep},
                          .y_high = {shallow, shallow},
                          .theirs = true});
  const double tick = 0.04 * deep;
  for (const double side : {-1.0, 1.0})
    panel.series.push_back({.kind = Kind::band,
                            .name = "measured half-widths",
                            .x = {std::min(side * near, side * far), std::max(side * near, side * far)},
                            .y_low = {tick, tick},
                            .y_high = {-tick, -tick},
                            .theirs = true});
}

/// A line of Table 4.
struct GrooveResult {
  std::string name;
  double depth = 0.0, width = 0.0, volume = 0.0;  // mm, mm, mm^3
};

GrooveResult result_of(const FinishedRun& run, const PaperReading& reading, std::string name) {
  const double last = run.last_revolution();
  return {std::move(name), analysis::summarise(run.sections(last, "depth_mm")).mean,
          analysis::summarise(run.sections(last, reading.width_column)).mean,
          run.at(last, reading.volume_column)};
}

std::string discrepancy(double ours, double test) {
  return std::isfinite(ours) && test > 0.0 ? fmt::format("{:+.0f} %", 100.0 * (ours / test - 1.0)) : "–";
}

/// 30 GPa of "the pin has 30 GPa".
double pin_modulus(const FinishedRun& run) {
  for (const simulation::MaterialSetup& m : run.setup().materials)
    if (!run.setup().wear.empty() && m.name == run.setup().wear.front().abrader) return m.shear_modulus;
  return std::numeric_limits<double>::quiet_NaN();
}

double removed_fraction(const FinishedRun& run) {
  return run.setup().ploughing ? run.setup().ploughing->removed_fraction : 1.0;
}

/// "depth, width": what lies inside the measured ranges, the volume within one standard deviation.
std::string inside(const GrooveResult& r, const simulation::MeasurementSetup& measured) {
  std::string text;
  const auto note = [&](bool in, const char* what) {
    if (in) text += (text.empty() ? "" : ", ") + std::string(what);
  };
  constexpr double kMm = 1e3, kMm3 = 1e9;
  if (const auto& d = measured.depth) note(r.depth >= kMm * d->low && r.depth <= kMm * d->high, "depth");
  if (const auto& w = measured.width) note(r.width >= kMm * w->low && r.width <= kMm * w->high, "width");
  if (const auto& v = measured.wear_volume)
    note(std::abs(r.volume - kMm3 * v->mean) <= kMm3 * v->sd, "volume");
  return text.empty() ? "none" : text;
}

}  // namespace

std::optional<Figure> fig17_wear_profile(const PaperRuns& runs) {
  Figure figure{.id = "fig17-wear-profile", .title = "The wear profile around the disc (Fig. 17)"};
  Panel around{.x = {.title = "angle [°]"}, .y = {.title = "wear depth [µm]"}};
  around.x.range = {0.0, 360.0};
  double deepest = 0.0, revolution = 0.0, coefficient = 0.0;
  std::vector<Panel> solid;
  for (const PaperReading& reading : runs.readings) {
    if (!reading.profile) continue;
    const std::vector<analysis::Contour> contours = sections_of(*reading.profile);
    if (contours.empty()) continue;
    revolution = reading.profile->last_revolution();
    coefficient = reading.profile->wear_coefficient();
    for (const analysis::Contour& c : contours) deepest = std::max(deepest, 1e6 * c.depth);
    const auto title = [&](const char* what) { return fmt::format("{}, {}", what, reading.name); };
    figure.panels.push_back({.title = title("Unrolled"),
                             .x = {.title = "angle [°]"},
                             .y = {.title = "radius [mm]"},
                             .series = {grid(contours, runs.track, Kind::heat)}});
    if (!reading.conserving)
      solid.push_back({.title = title("In 3D"),
                       .x = {.title = "angle [°]"},
                       .y = {.title = "radius [mm]"},
                       .series = {grid(contours, runs.track, Kind::surface)}});
    around.series.push_back(depth_around(contours, reading));
  }
  if (figure.panels.empty()) return {};
  if (const PublishedClaim* spots = runs.published.find("F17");
      spots != nullptr && spots->numbers.size() == 2)
    around.series.insert(around.series.begin(), {.kind = Kind::band,
                                                 .name = "paper: highly deformed spots",
                                                 .x = spots->numbers,
                                                 .y_low = {0.0, 0.0},
                                                 .y_high = {1.1 * deepest, 1.1 * deepest},
                                                 .theirs = true});
  around.title = "Depth around the disc";
  figure.panels.push_back(std::move(around));
  for (Panel& panel : solid) figure.panels.push_back(std::move(panel));
  for (std::size_t p = 0; p < figure.panels.size(); ++p)
    figure.panels[p].title = fmt::format("({}) {}", static_cast<char>('a' + p), figure.panels[p].title);
  figure.caption = fmt::format(
      "After {:.6g} revolutions at α = {:.3g} 1/Pa: 360 sections, cut from the surface. Where the spots of "
      "an unstructured mesh "
      "lie depends on the mesh.",
      revolution, coefficient);
  return figure;
}

std::optional<Figure> fig18_against_test(const PaperRuns& runs) {
  Figure figure{.id = "fig18-against-test", .title = "Contours against the test (Fig. 18)", .columns = 2};
  const auto start = [&](const std::string& name) {
    Panel panel{.title = fmt::format("({}) {}", static_cast<char>('a' + figure.panels.size()), capital(name)),
                .x = {.title = "radius from the track [mm]"},
                .y = {.title = "height [µm]"}};
    panel.x.range = {-0.8, 0.8};
    add_measured(panel, runs);
    return panel;
  };
  const auto add = [&](Panel& panel, const FinishedRun& run, std::span<const std::size_t> which, int colour,
                       const std::string& name) {
    const auto profiles = profiles_of(run, run.last_revolution(), 1e3 * runs.track);
    for (const std::size_t k : which) {
      if (k >= profiles.size()) continue;
      panel.series.push_back(
          {.kind = Kind::line,
           .name = name.empty() ? fmt::format("contour at {:.0f}°", profiles[k].angle) : name,
           .x = profiles[k].x_mm,
           .y = profiles[k].height_um,
           .colour = colour++});
    }
  };
  constexpr std::size_t kThree[] = {0, 3, 6};
  const FinishedRun* calibrated = runs.readings[0].with_coefficient(1.7e-11);
  if (calibrated != nullptr) {
    Panel panel = start(fmt::format("{}, α = 1.7e-11 1/Pa", runs.readings[0].name));
    add(panel, *calibrated, kThree, 0, "");
    figure.panels.push_back(std::move(panel));
  }
  if (!runs.calibrated.empty()) {
    Panel panel = start("conserving, the measured volume");
    int colour = 3;
    constexpr std::size_t kOne[] = {0};
    for (const FinishedRun& run : runs.calibrated)
      add(panel, run, kOne, colour++, fmt::format("pin of {:.3g} GPa", 1e-9 * pin_modulus(run)));
    figure.panels.push_back(std::move(panel));
  }
  if (runs.laboratory) {
    Panel panel = start("conserving, with a worn pin and ridges");
    add(panel, *runs.laboratory, kThree, 0, "");
    figure.panels.push_back(std::move(panel));
  }
  if (figure.panels.empty()) return {};
  figure.caption =
      "Grey: the ranges that the paper gives for its three measured contours; it prints no coordinates. The "
      "measured groove has ploughed ridges and a worn pin.";
  if (runs.laboratory) figure.caption += " Both are in the last panel only.";
  return figure;
}

std::optional<DataTable> table4(const PaperRuns& runs) {
  std::vector<GrooveResult> rows;
  const auto number = [&](const char* id, std::size_t k) {
    const PublishedClaim* claim = runs.published.find(id);
    return claim != nullptr && claim->numbers.size() > k ? claim->numbers[k]
                                                         : std::numeric_limits<double>::quiet_NaN();
  };
  const GrooveResult test{"test (largest measured depth and width)", number("T01", 0), number("T02", 0),
                          number("T03", 0)};
  const GrooveResult theirs{"paper's model, 12 revolutions at 1.7e-11 1/Pa", number("T01", 1),
                            number("T02", 1), number("T03", 1)};
  for (const PaperReading& reading : runs.readings)
    if (const FinishedRun* run = reading.with_coefficient(1.7e-11))
      rows.push_back(result_of(
          *run, reading,
          fmt::format("{}, {:.6g} revolutions at 1.7e-11 1/Pa", reading.name, run->last_revolution())));
  for (const FinishedRun& run : runs.calibrated)
    rows.push_back(
        result_of(run, runs.readings[1],
                  fmt::format("conserving, {:.6g} revolutions at {:.3g} 1/Pa, pin of {:.3g} GPa",
                              run.last_revolution(), run.wear_coefficient(), 1e-9 * pin_modulus(run))));
  if (runs.laboratory)
    rows.push_back(result_of(*runs.laboratory, runs.readings[1],
                             fmt::format("the same pin, worn, and ridges: {} % of the groove removed",
                                         readable(100.0 * removed_fraction(*runs.laboratory), 3))));
  if (rows.empty()) return {};
  rows.insert(rows.begin(), {test, theirs});
  DataTable table{.id = "table4-against-test",
                  .title = "Against the test (Table 4)",
                  .columns = {"result", "depth [mm]", "depth off", "width [mm]", "width off", "volume [mm³]",
                              "volume off", "inside what was measured", "2/3 depth · width · track [mm³]"}};
  table.caption =
      "Discrepancies as the paper computes them, against the largest of three measured depths and widths "
      "(the measured ranges "
      "are 0.010 to 0.014 mm and 0.65 to 0.80 mm). The last column is the volume of a parabolic groove of "
      "that depth and "
      "width: the paper's own three numbers do not belong to one groove (decision 009).";
  for (const GrooveResult& r : rows) {
    const bool is_test = &r == &rows.front();
    const double shape = 2.0 / 3.0 * r.depth * r.width * 2.0e3 * std::numbers::pi * runs.track;
    table.rows.push_back({r.name, readable(r.depth, 3), is_test ? "" : discrepancy(r.depth, test.depth),
                          readable(r.width, 3), is_test ? "" : discrepancy(r.width, test.width),
                          readable(r.volume, 3), is_test ? "" : discrepancy(r.volume, test.volume),
                          inside(r, runs.measured), readable(shape, 3)});
  }
  return table;
}

}  // namespace abradem::report
