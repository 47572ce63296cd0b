// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/report/groove_calibration_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

namespace abradem::report {

namespace {

using study::GrooveCalibration;
using Json = nlohmann::ordered_json;

constexpr double kMm = 1e3, kMm2 = 1e6, kMm3 = 1e9;
constexpr std::array kNames{"wear coefficient", "pin to disc", "removed fraction"};
constexpr std::array kUnits{" 1/Pa", "", ""};

std::string number(double x, int digits = 4) {
  return std::isfinite(x) ? fmt::format("{:.{}g}", x, digits) : "-";
}

/// A further measurement's value in the unit that a person reads.
std::pair<double, std::string> shown(const study::FurtherMeasurement& f) {
  if (f.unit == "m") return {1e3, "mm"};
  if (f.unit == "m^2") return {1e6, "mm^2"};
  return {1e9, "ug"};
}

std::string verdict(const GrooveCalibration& r) {
  if (r.inside) return "Volume, depth and width are all inside what was measured.";
  return r.at_limit ? "No parameters reach what was measured; these come closest, at the end of a range."
                    : "These parameters come closest to what was measured.";
}

/// What the measurement leaves open, as a sentence with a space before it; empty when nothing.
std::string open_parameters(const GrooveCalibration& r) {
  const std::vector<std::string> names = study::undetermined(r);
  return names.empty() ? ""
                       : fmt::format(" The measurement does not tell the {}: see what to measure besides.",
                                     fmt::join(names, ", nor the "));
}

/// The direction that the measurement tells least, in words.
std::string flat_direction(const GrooveCalibration& r) {
  std::string text;
  for (std::size_t j = 0; j < 3; ++j)
    text += fmt::format("{}{:+.2f} {}", j == 0 ? "" : ", ", r.directions[0][j],
                        std::array{"ln(wear coefficient)", "ln(pin to disc)", "removed fraction"}[j]);
  return fmt::format("Least known: the combination ({}), to {} (one sd).", text,
                     number(r.direction_sd[0], 3));
}

std::vector<std::vector<std::string>> parameter_rows(const GrooveCalibration& r) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < 3; ++i)
    rows.push_back({std::string(kNames[i]) + kUnits[i], number(r.calibrated.parameters[i]), number(r.low[i]),
                    number(r.high[i])});
  return rows;
}

std::vector<std::vector<std::string>> matched_rows(const GrooveCalibration& r) {
  const std::array<double, 3> values{r.calibrated.volume, r.calibrated.depth, r.calibrated.width};
  const std::array names{"volume [mm^3]", "depth [mm]", "width [mm]"};
  const std::array units{kMm3, kMm, kMm};
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < 3; ++i)
    rows.push_back({names[i], number(units[i] * values[i]), number(units[i] * r.target[i]),
                    number(units[i] * r.target_sd[i]), number(r.residual[i], 2)});
  return rows;
}

std::vector<std::vector<std::string>> further_rows(const GrooveCalibration& r) {
  std::vector<std::vector<std::string>> rows;
  for (const study::FurtherMeasurement& f : r.further) {
    const auto [unit, name] = shown(f);
    rows.push_back({fmt::format("{} [{}]", f.name, name), number(unit * f.value), number(unit * f.sd, 2),
                    number(100.0 * f.sd_after[0], 2), number(100.0 * f.sd_after[1], 2),
                    number(f.sd_after[2], 2), number(f.volume_left, 2)});
  }
  return rows;
}

const std::vector<std::string> kParameterColumns{"parameter", "found", "low", "high"};
const std::vector<std::string> kMatchedColumns{"matched", "model", "measured", "sd", "missed by [sd]"};
const std::vector<std::string> kFurtherColumns{"measure besides",
                                               "predicted",
                                               "sd",
                                               "coefficient after [%]",
                                               "pin to disc after [%]",
                                               "removed fraction after [-]",
                                               "uncertainty left [-]"};

std::string aligned(const std::vector<std::string>& columns,
                    const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    widths.push_back(columns[c].size());
    for (const auto& row : rows) widths[c] = std::max(widths[c], row[c].size());
  }
  std::string text;
  const auto line = [&](const std::vector<std::string>& cells) {
    for (std::size_t c = 0; c < cells.size(); ++c)
      text += c == 0 ? fmt::format("  {:<{}}", cells[c], widths[c])
                     : fmt::format("  {:>{}}", cells[c], widths[c]);
    text += "\n";
  };
  line(columns);
  for (const auto& row : rows) line(row);
  return text;
}

}  // namespace

std::string groove_calibration_text(const GrooveCalibration& r) {
  std::string text = verdict(r) + open_parameters(r) + "\n\n" +
                     aligned(kParameterColumns, parameter_rows(r)) + "\n" +
                     aligned(kMatchedColumns, matched_rows(r));
  text += fmt::format("\nIntervals of {} %; {} trials of {} revolutions.\n", number(100.0 * r.coverage),
                      r.runs, number(r.revolutions));
  text += fmt::format(
      "Correlations: coefficient and pin {:+.2f}, coefficient and fraction {:+.2f}, pin and "
      "fraction {:+.2f}.\n",
      r.correlation[0][1], r.correlation[0][2], r.correlation[1][2]);
  text += flat_direction(r) + "\n\n" + aligned(kFurtherColumns, further_rows(r));
  text += fmt::format("\nEach as if measured to {} %; the first would settle most.\n",
                      number(100.0 * r.further.front().precision));
  return text;
}

std::string groove_calibration_json(const GrooveCalibration& r) {
  const auto state = [](const study::GrooveState& s) {
    return Json{{"wear_coefficient_per_Pa", s.parameters[0]},
                {"pin_to_disc", s.parameters[1]},
                {"removed_fraction", s.parameters[2]},
                {"volume_mm3", kMm3 * s.volume},
                {"depth_mm", kMm * s.depth},
                {"width_mm", kMm * s.width},
                {"ridge_height_mm", kMm * s.ridge_height},
                {"ridge_area_mm2", kMm2 * s.ridge_area},
                {"groove_area_mm2", kMm2 * s.groove_area},
                {"tip_flat_along_mm", kMm * s.flat_along},
                {"tip_flat_across_mm", kMm * s.flat_across},
                {"pin_volume_mm3", kMm3 * s.pin_volume},
                {"pin_mass_loss_ug", 1e9 * s.pin_mass}};
  };
  Json json{{"calibrated", state(r.calibrated)},
            {"inside_measured", r.inside},
            {"at_limit", r.at_limit},
            {"residual_sd", r.residual},
            {"coverage", r.coverage},
            {"low", r.low},
            {"high", r.high},
            {"covariance", r.covariance},
            {"correlation", r.correlation},
            {"directions", r.directions},
            {"direction_sd", r.direction_sd},
            {"revolutions", r.revolutions},
            {"runs", r.runs},
            {"further", Json::array()},
            {"trials", Json::array()}};
  for (const study::FurtherMeasurement& f : r.further) {
    const auto [unit, name] = shown(f);
    json["further"].push_back({{"name", f.name},
                               {"unit", name},
                               {"value", unit * f.value},
                               {"sd", unit * f.sd},
                               {"measured_to", f.precision},
                               {"sd_after", f.sd_after},
                               {"uncertainty_left", f.volume_left}});
  }
  for (const study::GrooveState& s : r.trials) json["trials"].push_back(state(s));
  return json.dump(2) + "\n";
}

Page groove_calibration_page(const GrooveCalibration& r, const std::string& title) {
  Page page;
  page.title = title.empty() ? "Calibration of the groove" : "Calibration of the groove: " + title;
  page.summary = verdict(r) + open_parameters(r);
  page.cards = {{"wear coefficient", number(r.calibrated.parameters[0]) + " 1/Pa"},
                {"pin to disc", number(r.calibrated.parameters[1])},
                {"removed fraction", number(r.calibrated.parameters[2])}};
  PageSection found{.title = "Result", .items = {}};
  found.items.emplace_back(DataTable{.id = "parameters",
                                     .title = "The three numbers",
                                     .caption = fmt::format("Intervals of {} %.", number(100.0 * r.coverage)),
                                     .columns = kParameterColumns,
                                     .rows = parameter_rows(r)});
  found.items.emplace_back(
      DataTable{.id = "matched",
                .title = "What they were found from",
                .caption = "Of a range: its middle, and the sd of a uniform distribution.",
                .columns = kMatchedColumns,
                .rows = matched_rows(r)});
  PageSection known{.title = "How well they are known", .items = {}};
  known.items.emplace_back(Paragraph{flat_direction(r)});
  known.items.emplace_back(
      DataTable{.id = "further",
                .title = "What the test would show besides",
                .caption = "Predicted, and what the uncertainty would come to if it were measured to 10 %. "
                           "Uncertainty left: of the volume of the three numbers' joint region.",
                .columns = kFurtherColumns,
                .rows = further_rows(r)});
  known.items.emplace_back(groove_table({{.name = "calibrated",
                                          .volume = r.calibrated.volume,
                                          .depth = r.calibrated.depth,
                                          .width = r.calibrated.width}}));
  page.sections = {found, known};
  return page;
}

DataTable groove_table(const std::vector<GrooveRow>& ours) {
  // Table 4 of [yan2022]; its test values are the largest of the measured ranges.
  constexpr double kVolume = 0.565, kDepth = 0.014, kWidth = 0.80;
  DataTable table{.id = "table-4",
                  .title = "Table 4 of the paper, again",
                  .caption =
                      "In brackets: deviation from the paper's test values. Measured: 0.010 to 0.014 mm, "
                      "0.65 to 0.80 mm, 0.565 +- 0.089 mm^3.",
                  .columns = {"", "depth [mm]", "width [mm]", "volume [mm^3]", "inside the measured ranges"}};
  const auto cell = [](double value, double test) {
    return std::isfinite(value) ? fmt::format("{:.4f} ({:+.0f} %)", value, 100.0 * (value / test - 1.0))
                                : std::string("-");
  };
  const auto add = [&](const std::string& name, double depth, double width, double volume) {
    std::string inside;
    const auto note = [&](bool in, const char* what) {
      if (in) inside += (inside.empty() ? "" : ", ") + std::string(what);
    };
    note(depth >= 0.010 && depth <= 0.014, "depth");
    note(width >= 0.65 && width <= 0.80, "width");
    note(std::abs(volume - 0.565) <= 0.089, "volume");
    table.rows.push_back({name, cell(depth, kDepth), cell(width, kWidth), cell(volume, kVolume),
                          inside.empty() ? "none" : inside});
  };
  add("test", kDepth, kWidth, kVolume);
  add("paper's model", 0.019, 1.07, 0.532);
  for (const GrooveRow& row : ours) add(row.name, kMm * row.depth, kMm * row.width, kMm3 * row.volume);
  return table;
}

}  // namespace abradem::report
