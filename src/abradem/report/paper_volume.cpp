// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "abradem/analysis/regression.h"
#include "abradem/report/paper_figures.h"
#include "abradem/report/text.h"
#include "abradem/study/calibration.h"

namespace abradem::report {
namespace {

using Kind = Series::Kind;

const study::PublishedFit* published_fit(double coefficient) {
  for (const study::PublishedFit& fit : study::published_fits())
    if (std::abs(fit.wear_coefficient / coefficient - 1.0) < 1e-6) return &fit;
  return nullptr;
}

std::string coefficient_name(double coefficient) { return fmt::format("α = {:.2g} 1/Pa", coefficient); }

/// Archard's volume alpha F 2 pi r n [mm^3].
double archard(const PaperRuns& runs, double coefficient, double revolutions) {
  return 1e9 * coefficient * runs.load * 2.0 * std::numbers::pi * runs.track * revolutions;
}

/// A fit of few points has no band.
std::optional<analysis::PolynomialFit> quadratic(const FinishedRun& run, const PaperReading& reading) {
  const std::vector<double> n = run.column("revolution");
  if (n.size() < 4) return {};
  return analysis::fit_polynomial(n, run.column(reading.volume_column), {.degree = 2});
}

void add_coefficient(Panel& panel, const PaperReading& reading, const FinishedRun& run, int colour) {
  const std::vector<double> n = run.column("revolution");
  if (const auto fit = quadratic(run, reading)) {
    Series band{.kind = Kind::band, .colour = colour};
    Series line{.kind = Kind::line, .colour = colour};
    for (double x = n.front(); x <= n.back() + 1e-9; x += 0.25) {
      const analysis::Estimate mean = fit->mean_at(x);
      line.x.push_back(x);
      line.y.push_back(mean.value);
      band.x.push_back(x);
      band.y_low.push_back(mean.low);
      band.y_high.push_back(mean.high);
    }
    panel.series.push_back(std::move(band));
    panel.series.push_back(std::move(line));
  }
  panel.series.push_back({.kind = Kind::markers,
                          .name = coefficient_name(run.wear_coefficient()),
                          .x = n,
                          .y = run.column(reading.volume_column),
                          .colour = colour});
  const study::PublishedFit* theirs = published_fit(run.wear_coefficient());
  if (theirs == nullptr) return;
  Series curve{.kind = Kind::line,
               .name = fmt::format("paper, eq. {}", theirs->equation),
               .colour = colour,
               .theirs = true};
  for (double x = 1.0; x <= 12.0 + 1e-9; x += 0.25) {
    curve.x.push_back(x);
    curve.y.push_back(1e9 * theirs->volume(x));
  }
  panel.series.push_back(std::move(curve));
}

/// A coefficient [mm^3] with half its interval; what no balance could weigh is 0.
constexpr double kNothing = 1e-6;
std::string bounds(double value, double low, double high) {
  const double half = 0.5 * (high - low);
  if (std::abs(value) < kNothing && half < kNothing) return "0 ± < 10⁻⁶";
  return fmt::format("{} ± {}", fmt::format("{:.3g}", value), fmt::format("{:.1g}", half));
}

/// Mean of a column over the force samples of a revolution, or its first sample (revolution 0).
double force_mean(const FinishedRun& run, double revolution, std::string_view column) {
  const std::vector<double>& all = run.force[column];
  if (revolution <= 0.0) return all.empty() ? std::numeric_limits<double>::quiet_NaN() : all.front();
  const std::vector<double> values = run.forces(revolution, column);
  double sum = 0.0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

}  // namespace

std::optional<Figure> fig15_volumes(const PaperRuns& runs) {
  Figure figure{.id = "fig15-volumes", .title = "Wear volume against revolutions (Fig. 15)", .columns = 2};
  for (const PaperReading& reading : runs.readings) {
    if (reading.coefficients.empty()) continue;
    Panel panel{
        .title = fmt::format("({}) {}", static_cast<char>('a' + figure.panels.size()), capital(reading.name)),
        .x = {.title = "revolution [-]"},
        .y = {.title = "wear volume [mm³]"}};
    if (const auto& lab = runs.measured.wear_volume)
      panel.series.push_back({.kind = Kind::band,
                              .name = "measured",
                              .x = {1.0, 12.0},
                              .y_low = {1e9 * (lab->mean - lab->sd), 1e9 * (lab->mean - lab->sd)},
                              .y_high = {1e9 * (lab->mean + lab->sd), 1e9 * (lab->mean + lab->sd)},
                              .theirs = true});
    int colour = 0;
    for (const FinishedRun& run : reading.coefficients) add_coefficient(panel, reading, run, colour++ % 8);
    if (reading.revolutions && !reading.conserving)
      panel.series.push_back(
          {.kind = Kind::line,
           .name = coefficient_name(reading.revolutions->wear_coefficient()) + ", with chatter",
           .x = reading.revolutions->column("revolution"),
           .y = reading.revolutions->column(reading.volume_column),
           .colour = std::max(0, colour - 1) % 8,
           .dash = Series::Dash::dot});
    figure.panels.push_back(std::move(panel));
  }
  if (figure.panels.empty()) return {};
  figure.caption = fmt::format(
      "Markers: runs; lines: quadratic fits to them with their 95 % confidence bands (often thinner than the "
      "line); dashed: "
      "the paper's fits, eq. 13-17; grey: the measured volume. The runs are quasi-static; dotted: one "
      "integrated in time with "
      "the paper's step, which makes the pin chatter. Volumes: {} ({}); {} ({}).",
      runs.readings[0].name, runs.readings[0].volume_name, runs.readings[1].name,
      runs.readings[1].volume_name);
  return figure;
}

std::optional<Figure> fig15_ratio(const PaperRuns& runs) {
  Figure figure{.id = "fig15-over-archard", .title = "Wear volume over Archard's α F L", .columns = 2};
  for (const PaperReading& reading : runs.readings) {
    if (reading.coefficients.empty()) continue;
    Panel panel{
        .title = fmt::format("({}) {}", static_cast<char>('a' + figure.panels.size()), capital(reading.name)),
        .x = {.title = "revolution [-]"},
        .y = {.title = "volume over α F L [-]"}};
    panel.y.range = {0.0, 7.5};
    int colour = 0;
    for (const FinishedRun& run : reading.coefficients) {
      Series ours{
          .kind = Kind::line_markers, .name = coefficient_name(run.wear_coefficient()), .colour = colour % 8};
      ours.x = run.column("revolution");
      ours.y = run.column(reading.volume_column);
      for (std::size_t k = 0; k < ours.x.size(); ++k)
        ours.y[k] /= archard(runs, run.wear_coefficient(), ours.x[k]);
      panel.series.push_back(std::move(ours));
      if (const study::PublishedFit* fit = published_fit(run.wear_coefficient())) {
        Series theirs{.kind = Kind::line,
                      .name = fmt::format("paper, eq. {}", fit->equation),
                      .colour = colour % 8,
                      .theirs = true};
        for (double n = 1.0; n <= 12.0; ++n) {
          theirs.x.push_back(n);
          theirs.y.push_back(1e9 * fit->volume(n) / archard(runs, run.wear_coefficient(), n));
        }
        panel.series.push_back(std::move(theirs));
      }
      ++colour;
    }
    figure.panels.push_back(std::move(panel));
  }
  if (figure.panels.empty()) return {};
  figure.caption =
      "What the law that the paper states (eq. 3) removes is 1. Its published volumes are 2 to 6.8 times "
      "that and grow with "
      "the groove; no rule with a converged time step does (decision 013). The measured coefficient was "
      "found with this law.";
  return figure;
}

std::optional<DataTable> fits_table(const PaperRuns& runs) {
  DataTable table{.id = "eq13-17-fits",
                  .title = "Quadratic fits y = c + a x + b x² of volume against revolutions (eq. 13-17)",
                  .columns = {"α [1/Pa]", "of", "a [mm³]", "b [mm³]", "c [mm³]", "R²",
                              "b by increments [mm³]", "p of b = 0"}};
  table.caption =
      "±: half of the 95 % interval. Values of a sum are not independent, so its R² is close to 1 whatever "
      "the law; the fit of "
      "the increments is the one whose interval means something. Its p is the chance of such a b where the "
      "true one is 0.";
  const PaperReading& first = runs.readings[runs.readings[0].coefficients.empty() ? 1 : 0];
  for (const FinishedRun& reference : first.coefficients) {
    const double alpha = reference.wear_coefficient();
    const std::string name = fmt::format("{:.2g}", alpha);
    if (const study::PublishedFit* fit = published_fit(alpha)) {
      const PublishedClaim* claim = runs.published.find(fmt::format("V{}", fit->equation));
      table.rows.push_back(
          {name, fmt::format("paper, eq. {}", fit->equation), readable(fit->a1), readable(fit->a2),
           readable(fit->a0),
           claim != nullptr && claim->numbers.size() == 4 ? readable(claim->numbers[3], 3) : "–", "–", "–"});
    }
    for (const PaperReading& reading : runs.readings) {
      const FinishedRun* run = reading.with_coefficient(alpha);
      if (run == nullptr) continue;
      const auto fit = quadratic(*run, reading);
      if (!fit) continue;
      const analysis::IncrementFit increments =
          analysis::fit_increments(run->column("revolution"), run->column(reading.volume_column), 2);
      table.rows.push_back(
          {name, reading.name, bounds(fit->coefficients[1], fit->low[1], fit->high[1]),
           bounds(fit->coefficients[2], fit->low[2], fit->high[2]),
           bounds(fit->coefficients[0], fit->low[0], fit->high[0]), fmt::format("{:.6f}", fit->r_squared),
           bounds(increments.coefficients[1], increments.low[1], increments.high[1]),
           std::abs(increments.coefficients[1]) < kNothing ? "–" : readable(increments.p[1], 2)});
    }
  }
  if (table.rows.empty()) return {};
  return table;
}

std::optional<Figure> fig16_force_components(const PaperRuns& runs) {
  Figure figure{.id = "fig16-force-components",
                .title = "Components of the normal force before and after (Fig. 16)",
                .columns = 2};
  double coefficient = 0.0, last = 0.0;
  for (const PaperReading& reading : runs.readings) {
    if (reading.coefficients.empty()) continue;
    const FinishedRun& run = reading.coefficients.back();
    coefficient = run.wear_coefficient();
    last = run.last_revolution();
    Panel panel{
        .title = fmt::format("({}) {}", static_cast<char>('a' + figure.panels.size()), capital(reading.name)),
        .x = {.title = "component [-]",
              .labels = {{1.0, "along the load"}, {2.0, "across"}, {3.0, "sum of magnitudes"}}},
        .y = {.title = "normal force [N]"}};
    const auto bars = [&](std::string name, double revolution, int colour) {
      panel.series.push_back(
          {.kind = Kind::bars,
           .name = std::move(name),
           .x = {1.0, 2.0, 3.0},
           .y = {force_mean(run, revolution, "normal_along_N"),
                 force_mean(run, revolution, "normal_across_N"), force_mean(run, revolution, "normal_sum_N")},
           .colour = colour});
    };
    bars("before: first sample", 0.0, 0);
    bars(fmt::format("after: revolution {:.6g}", last), last, 1);
    figure.panels.push_back(std::move(panel));
  }
  if (figure.panels.empty()) return {};
  figure.caption = fmt::format(
      "α = {:.3g} 1/Pa, quasi-static. Across: the mean size of the part that is not along the load. The "
      "paper explains by it "
      "that the wear per revolution grows; the flanks of the groove are so flat that it adds a few per cent "
      "at most.",
      coefficient);
  return figure;
}

}  // namespace abradem::report
