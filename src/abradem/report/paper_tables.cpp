// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "abradem/analysis/run_in.h"
#include "abradem/report/paper_figures.h"
#include "abradem/report/text.h"

namespace abradem::report {
namespace {

constexpr double kLevel = 0.05;
/// Smaller p-values are drawn here; the paper's table rounds them to 0.
constexpr double kSmallest = 1e-16;

std::string p_text(double p) {
  if (std::isnan(p)) return "–";
  return p < kSmallest ? "< 10⁻¹⁶" : readable(p, 2);
}

/// The paper's row of Table 3 where it has one.
std::string published_p(const PublishedClaim* claim, std::size_t row) {
  if (claim == nullptr || row >= claim->numbers.size()) return "–";
  return claim->numbers[row] == 0.0 ? "0" : readable(claim->numbers[row], 2);
}

std::string_view column_of(const PaperReading& reading, bool width) {
  return width ? std::string_view(reading.width_column) : "depth_mm";
}

Panel p_panel(const PaperRuns& runs, bool width) {
  Panel panel{.title = width ? "(b) Width" : "(a) Depth",
              .x = {.title = "revolution [-]"},
              .y = {.title = "p of the chi-squared test [-]", .log = true}};
  panel.y.range = {kSmallest, 1.0};
  const auto drawn = [](std::vector<double> p) {
    for (double& v : p) v = std::isnan(v) ? v : std::max(v, kSmallest);
    return p;
  };
  if (const PublishedClaim* claim = runs.published.find(width ? "P02" : "P01")) {
    Series theirs{.kind = Series::Kind::line_markers, .name = "paper, Table 3", .theirs = true};
    for (std::size_t k = 0; k < claim->numbers.size(); ++k) theirs.x.push_back(static_cast<double>(k + 1));
    theirs.y = drawn(claim->numbers);
    panel.series.push_back(std::move(theirs));
  }
  for (const PaperReading& reading : runs.readings) {
    if (!reading.revolutions) continue;
    panel.series.push_back(
        {.kind = Series::Kind::line_markers,
         .name = reading.name,
         .x = reading.revolutions->column("revolution"),
         .y = drawn(reading.revolutions->normality(column_of(reading, width), reading.binning)),
         .colour = reading.colour});
  }
  panel.series.push_back({.kind = Series::Kind::line,
                          .name = "5 %",
                          .x = {1.0, 10.0},
                          .y = {kLevel, kLevel},
                          .colour = 7,
                          .dash = Series::Dash::dot});
  return panel;
}

std::string found_text(const analysis::NormalFrom& found) {
  return found.revolution ? fmt::format("from revolution {:.6g}", *found.revolution) : "never";
}

/// The samples of a run's revolutions.
std::vector<std::vector<double>> samples(const FinishedRun& run, std::string_view column) {
  std::vector<std::vector<double>> out;
  for (const double revolution : run.column("revolution")) out.push_back(run.sections(revolution, column));
  return out;
}

}  // namespace

std::optional<DataTable> table3_normality(const PaperRuns& runs) {
  std::vector<double> revolutions;
  for (const PaperReading& reading : runs.readings)
    if (reading.revolutions && reading.revolutions->revolutions.rows() > revolutions.size())
      revolutions = reading.revolutions->column("revolution");
  if (revolutions.empty()) return {};
  DataTable table{.id = "table3-normality",
                  .title = "Normality of depth and width by revolution (Table 3)",
                  .columns = {"revolution"}};
  table.caption = fmt::format(
      "p of the chi-squared test with the sample's own mean and deviation. The paper does not state its "
      "bins: {} are tested "
      "in {} equal bins with pooled tails, {} in equiprobable bins (df = bins - 3).",
      runs.readings[0].name, analysis::kEqualWidthBins, runs.readings[1].name);
  std::vector<std::vector<double>> ours;
  for (const bool width : {false, true}) {
    table.columns.emplace_back(width ? "width: paper" : "depth: paper");
    for (const PaperReading& reading : runs.readings) {
      table.columns.push_back(fmt::format("{}: {}", width ? "width" : "depth", reading.name));
      ours.push_back(reading.revolutions
                         ? reading.revolutions->normality(column_of(reading, width), reading.binning)
                         : std::vector<double>{});
    }
  }
  for (std::size_t row = 0; row < revolutions.size(); ++row) {
    std::vector<std::string> cells{fmt::format("{:.6g}", revolutions[row])};
    for (std::size_t c = 0; c < ours.size(); ++c) {
      if (c % runs.readings.size() == 0)
        cells.push_back(published_p(runs.published.find(c == 0 ? "P01" : "P02"), row));
      cells.push_back(row < ours[c].size() ? p_text(ours[c][row]) : "–");
    }
    table.rows.push_back(std::move(cells));
  }
  return table;
}

std::optional<Figure> table3_figure(const PaperRuns& runs) {
  if (!runs.readings[0].revolutions && !runs.readings[1].revolutions) return {};
  return Figure{
      .id = "table3-p-values",
      .title = "The p-values of Table 3",
      .caption =
          "Values below 10⁻¹⁶ (also those that the paper prints as 0) are drawn there. The run-in of the "
          "paper ends where both stay above 5 %.",
      .panels = {p_panel(runs, false), p_panel(runs, true)},
      .columns = 2};
}

std::vector<std::string> normality_sensitivity(const PaperRuns& runs) {
  constexpr int kFewest = 5, kMost = 30;
  std::vector<std::string> out;
  for (const PaperReading& reading : runs.readings) {
    std::string text;
    if (reading.seeds.size() > 1) {
      std::map<std::string, int> answers;
      for (const FinishedRun& run : reading.seeds)
        ++answers[found_text(
            analysis::normal_from(run.column("revolution"), run.normality("depth_mm", reading.binning),
                                  run.normality(reading.width_column, reading.binning), kLevel))];
      std::string found;
      for (const auto& [answer, count] : answers)
        found += fmt::format("{}{} on {} of them", found.empty() ? "" : ", ", answer, count);
      text += fmt::format(
          "On {} meshes of the same size and other seeds, without the chatter (quasi-static), depth and "
          "width are both normal at 5 %: {}.",
          reading.seeds.size(), found);
    }
    if (reading.revolutions) {
      const FinishedRun& run = *reading.revolutions;
      const analysis::NormalFromByBins by_bins = analysis::normal_from_by_bins(
          run.column("revolution"), samples(run, "depth_mm"), samples(run, reading.width_column),
          reading.binning, kFewest, kMost, kLevel);
      text += fmt::format(
          "{}Of the numbers of bins from {} to {}, {:.0f} % find any revolution from which both stay "
          "normal.",
          text.empty() ? "" : " ", kFewest, kMost, 100.0 * by_bins.share_found);
    }
    if (!text.empty()) out.push_back(fmt::format("Sensitivity, {}: {}", reading.name, text));
  }
  return out;
}

}  // namespace abradem::report
