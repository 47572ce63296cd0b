// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/report/paper_figures.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "abradem/analysis/statistics.h"
#include "abradem/report/text.h"

namespace abradem::report {
namespace {

using Kind = Series::Kind;

constexpr double kUm = 1e3;  // of a millimetre

std::string panel_title(std::size_t number, const std::string& text) {
  return fmt::format("({}) {}", static_cast<char>('a' + number), capital(text));
}

/// Mean and standard deviation over the sections of a run's last revolution, against the mesh size.
Series against_mesh_size(const PaperReading& reading, std::string_view column, double factor) {
  Series series{.kind = Kind::line_markers, .name = reading.name, .colour = reading.colour};
  for (const FinishedRun& run : reading.mesh_sizes) {
    const analysis::Summary s = analysis::summarise(run.sections(run.last_revolution(), column, factor));
    series.x.push_back(1e3 * run.mesh_size());
    series.y.push_back(s.mean);
    series.y_low.push_back(s.mean - s.sd);
    series.y_high.push_back(s.mean + s.sd);
  }
  return series;
}

/// A published range as a band over x, unnamed where it stands in the legend already.
Series published_band(std::string name, const PublishedClaim& claim, double factor, double from, double to) {
  const auto [low, high] = std::minmax({factor * claim.numbers.front(), factor * claim.numbers.back()});
  return {.kind = Kind::band,
          .name = std::move(name),
          .x = {from, to},
          .y_low = {low, low},
          .y_high = {high, high},
          .theirs = true};
}

bool has_revolutions(const PaperRuns& runs) {
  return std::ranges::any_of(runs.readings, [](const PaperReading& r) { return r.revolutions.has_value(); });
}

/// What a distribution over the sections is of.
struct Measure {
  std::string id, title, axis;
  double factor = 1.0;           // from the tables' millimetres
  const char *range, *majority;  // claims of the paper
  bool width = false;
};

std::string_view column_of(const Measure& measure, const PaperReading& reading) {
  return measure.width ? std::string_view(reading.width_column) : "depth_mm";
}

/// Counts in equal bins from the lowest to the highest value, over the middles of the bins.
Series histogram(const std::string& name, const std::vector<double>& values, int colour) {
  constexpr std::size_t kBins = 20;
  Series series{.kind = Kind::bars, .name = name, .colour = colour};
  if (values.empty()) return series;
  const auto [low, high] = std::ranges::minmax(values);
  const double width = std::max(high - low, 1e-12) / kBins;
  series.y.assign(kBins, 0.0);
  for (std::size_t b = 0; b < kBins; ++b) series.x.push_back(low + (static_cast<double>(b) + 0.5) * width);
  for (const double v : values) ++series.y[std::min(kBins - 1, static_cast<std::size_t>((v - low) / width))];
  return series;
}

/// Fig. 10, 11: around the disc, and how the values are spread.
std::optional<Figure> distribution(const PaperRuns& runs, const Measure& measure) {
  if (!has_revolutions(runs)) return {};
  Figure figure{.id = measure.id, .title = measure.title, .columns = 2};
  double revolution = 0.0;
  for (const PaperReading& reading : runs.readings) {
    if (!reading.revolutions) continue;
    const FinishedRun& run = *reading.revolutions;
    revolution = run.last_revolution();
    Panel around{.title = panel_title(figure.panels.size(), reading.name + ", around the disc"),
                 .x = {.title = "angle [°]"},
                 .y = {.title = measure.axis}};
    around.x.range = {0.0, 360.0};
    // Beside values an order of size away the bands would hide the scatter.
    if (!reading.conserving || measure.width) {
      for (const auto& [id, name] :
           {std::pair{measure.range, "paper: range"}, {measure.majority, "paper: majority"}})
        if (const PublishedClaim* claim = runs.published.find(id))
          around.series.push_back(published_band(name, *claim, measure.factor, 0.0, 360.0));
    }
    Series points{.kind = Kind::markers, .name = reading.name, .colour = reading.colour};
    points.x = run.sections(revolution, "angle_deg");
    points.y = run.sections(revolution, column_of(measure, reading), measure.factor);
    Panel spread{.title = panel_title(figure.panels.size() + 1, reading.name + ", spread"),
                 .x = {.title = measure.axis},
                 .y = {.title = "sections [-]"},
                 .series = {histogram(reading.name, points.y, reading.colour)}};
    around.series.push_back(std::move(points));
    figure.panels.push_back(std::move(around));
    figure.panels.push_back(std::move(spread));
  }
  figure.caption = fmt::format(
      "Sections after revolution {:.6g}, α = {:.3g} 1/Pa. Grey: the ranges that the paper states (darker: "
      "where most are).{}",
      revolution, runs.setup.wear.front().wear_coefficient,
      measure.width
          ? fmt::format(" Widths: {} ({}); {} ({}).", runs.readings[0].name, runs.readings[0].width_name,
                        runs.readings[1].name, runs.readings[1].width_name)
          : "");
  return figure;
}

/// Fig. 12, 13: a box for each revolution.
std::optional<Figure> boxes_by_revolution(const PaperRuns& runs, const Measure& measure) {
  if (!has_revolutions(runs)) return {};
  Figure figure{.id = measure.id, .title = measure.title, .columns = 2};
  const PublishedClaim* range = runs.published.find(measure.range);
  for (const PaperReading& reading : runs.readings) {
    if (!reading.revolutions) continue;
    Panel panel{.title = panel_title(figure.panels.size(), reading.name),
                .x = {.title = "revolution [-]"},
                .y = {.title = measure.axis}};
    Series box{.kind = Kind::box, .name = "sections", .colour = reading.colour};
    for (const double revolution : reading.revolutions->column("revolution")) {
      for (const double value :
           reading.revolutions->sections(revolution, column_of(measure, reading), measure.factor)) {
        box.x.push_back(revolution);
        box.y.push_back(value);
      }
    }
    if (range != nullptr && !box.x.empty() && (!reading.conserving || measure.width)) {
      const double low = measure.factor * range->numbers.front(),
                   high = measure.factor * range->numbers.back();
      panel.series.push_back({.kind = Kind::markers,
                              .name = "paper: range after revolution 10",
                              .x = {10.0},
                              .y = {0.5 * (low + high)},
                              .y_low = {low},
                              .y_high = {high},
                              .theirs = true});
    }
    box.name = reading.name;
    panel.series.push_back(std::move(box));
    figure.panels.push_back(std::move(panel));
  }
  figure.caption =
      "Over the sections of each revolution: quartiles, whiskers to 1.5 quartile ranges, outliers as points.";
  return figure;
}

const Measure kDepth{
    "fig10-depths", "Wear depth after ten revolutions (Fig. 10)", "wear depth [µm]", kUm, "D01", "D02",
    false};
const Measure kWidth{
    "fig11-widths", "Wear width after ten revolutions (Fig. 11)", "wear width [mm]", 1.0, "W01", "W02", true};

}  // namespace

std::optional<Figure> fig07_mesh_size(const PaperRuns& runs) {
  if (runs.readings[0].mesh_sizes.empty() && runs.readings[1].mesh_sizes.empty()) return {};
  Panel depth{.title = "(a) Depth", .x = {.title = "mesh size [mm]"}, .y = {.title = "wear depth [µm]"}};
  Panel width{.title = "(b) Width", .x = {.title = "mesh size [mm]"}, .y = {.title = "wear width [mm]"}};
  for (const PaperReading& reading : runs.readings) {
    if (reading.mesh_sizes.empty()) continue;
    depth.series.push_back(against_mesh_size(reading, "depth_mm", kUm));
    width.series.push_back(against_mesh_size(reading, kMeshWidth, 1.0));
  }
  Figure figure{.id = "fig07-mesh-size",
                .title = "Depth and width against mesh size (Fig. 7)",
                .panels = {depth, width},
                .columns = 2};
  figure.caption = fmt::format(
      "Mean over the sections after one revolution, α = {:.3g} 1/Pa; bars: one standard deviation. The paper "
      "states the "
      "trends only: depth falls, width grows. Width: from the first displaced node to the last, for the "
      "conserving grooves are "
      "too shallow here for a threshold of 0.5 µm.",
      runs.setup.wear.front().wear_coefficient);
  return figure;
}

std::optional<Figure> fig08_contours(const PaperRuns& runs) {
  Figure figure{.id = "fig08-contours", .title = "Contours for six mesh sizes (Fig. 8)", .columns = 2};
  for (const PaperReading& reading : runs.readings) {
    if (reading.mesh_sizes.empty()) continue;
    Panel panel{.title = panel_title(figure.panels.size(), reading.name),
                .x = {.title = "radius from the track [mm]"},
                .y = {.title = "height [µm]"}};
    panel.x.range = {-1.5, 1.5};
    int colour = 0;
    for (std::size_t k = 0; k < reading.mesh_sizes.size(); ++k) {
      // Six of ten: the first, then every second.
      if (k != 0 && k % 2 == 0) continue;
      const FinishedRun& run = reading.mesh_sizes[k];
      const auto profiles = profiles_of(run, run.last_revolution(), 1e3 * runs.track);
      if (profiles.empty()) continue;
      panel.series.push_back({.kind = Kind::line,
                              .name = fmt::format("{:.2g} mm", 1e3 * run.mesh_size()),
                              .x = profiles.front().x_mm,
                              .y = profiles.front().height_um,
                              .colour = colour++});
    }
    figure.panels.push_back(std::move(panel));
  }
  if (figure.panels.empty()) return {};
  figure.caption = fmt::format(
      "The section at angle 0 after one revolution, α = {:.3g} 1/Pa, cut from meshes of different size.",
      runs.setup.wear.front().wear_coefficient);
  return figure;
}

std::optional<Figure> fig09_forces(const PaperRuns& runs) {
  if (!has_revolutions(runs)) return {};
  Figure figure{.id = "fig09-forces", .title = "Normal force in each revolution (Fig. 9)", .columns = 2};
  for (const PaperReading& reading : runs.readings) {
    if (!reading.revolutions) continue;
    const FinishedRun& run = *reading.revolutions;
    Panel panel{.title = panel_title(figure.panels.size(), reading.name),
                .x = {.title = "revolution [-]"},
                .y = {.title = "normal force [N]"}};
    Series box{.kind = Kind::box, .name = reading.name, .colour = reading.colour};
    const std::vector<double> revolutions = run.column("revolution");
    for (const double revolution : revolutions) {
      for (const double force : run.forces(revolution, "normal_along_N")) {
        box.x.push_back(revolution);
        box.y.push_back(force);
      }
    }
    panel.series.push_back(std::move(box));
    Series means{.kind = Kind::markers, .name = "mean", .x = revolutions, .colour = 2};
    for (const double revolution : revolutions)
      means.y.push_back(analysis::summarise(run.forces(revolution, "normal_along_N")).mean);
    panel.series.push_back(std::move(means));
    if (const PublishedClaim* mean = runs.published.find("N01"); mean != nullptr && !mean->numbers.empty())
      panel.series.push_back({.kind = Kind::line,
                              .name = "paper: all means close to 5 N",
                              .x = revolutions,
                              .y = std::vector<double>(revolutions.size(), mean->numbers.front()),
                              .theirs = true});
    figure.panels.push_back(std::move(panel));
  }
  figure.caption =
      "Along the load, integrated in time with the paper's step; about 500 samples of each revolution, "
      "outliers as points. The "
      "scales of the panels differ. By the paper's rules each triangle is a contact with a damper of its "
      "own, which brings "
      "that step to the limit of stability: from revolution 2 on the pin chatters.";
  return figure;
}

std::optional<Figure> fig10_depths(const PaperRuns& runs) { return distribution(runs, kDepth); }
std::optional<Figure> fig11_widths(const PaperRuns& runs) { return distribution(runs, kWidth); }

std::optional<Figure> fig12_depth_boxes(const PaperRuns& runs) {
  Measure measure = kDepth;
  measure.id = "fig12-depth-boxes";
  measure.title = "Wear depth by revolution (Fig. 12)";
  return boxes_by_revolution(runs, measure);
}

std::optional<Figure> fig13_width_boxes(const PaperRuns& runs) {
  Measure measure = kWidth;
  measure.id = "fig13-width-boxes";
  measure.title = "Wear width by revolution (Fig. 13)";
  return boxes_by_revolution(runs, measure);
}

std::optional<Figure> fig14_contours(const PaperReading& reading, const PaperRuns& runs) {
  if (!reading.revolutions) return {};
  const FinishedRun& run = *reading.revolutions;
  std::vector<double> last = run.column("revolution");
  if (last.size() > 3) last.erase(last.begin(), last.end() - 3);
  Figure figure{.id = reading.conserving ? "fig14-contours-conserving" : "fig14-contours-paper",
                .title = fmt::format(
                    "Contours of the last three revolutions at eight positions, {} (Fig. 14)", reading.name),
                .columns = 4};
  const PublishedClaim* depths = runs.published.find("D03");
  for (std::size_t turn = 0; turn < last.size(); ++turn) {
    const auto profiles = profiles_of(run, last[turn], 1e3 * runs.track);
    figure.panels.resize(std::max(figure.panels.size(), profiles.size()));
    for (std::size_t p = 0; p < profiles.size(); ++p) {
      Panel& panel = figure.panels[p];
      if (panel.series.empty()) {
        panel = {.title = fmt::format("{:.0f}°", profiles[p].angle),
                 .x = {.title = "radius from the track [mm]"},
                 .y = {.title = "height [µm]"}};
        panel.x.range = {-1.0, 1.0};
        if (depths != nullptr && turn == 0)
          panel.series.push_back(
              published_band("paper: depths after revolution 10", *depths, -kUm, -1.0, 1.0));
      }
      panel.series.push_back({.kind = Kind::line,
                              .name = fmt::format("revolution {:.6g}", last[turn]),
                              .x = profiles[p].x_mm,
                              .y = profiles[p].height_um,
                              .colour = static_cast<int>(turn)});
    }
  }
  if (figure.panels.empty()) return {};
  figure.caption = fmt::format(
      "Sections at eight angles, α = {:.3g} 1/Pa. Grey: between the smallest and the largest depth that the "
      "paper finds at "
      "its eight positions.",
      run.wear_coefficient());
  return figure;
}

}  // namespace abradem::report
