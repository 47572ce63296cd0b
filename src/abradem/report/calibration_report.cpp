// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/report/calibration_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "abradem/report/text.h"

namespace abradem::report {

namespace {

using study::CalibrationPair;
using study::CalibrationPoint;
using study::CalibrationResult;
using study::Estimate;
using study::ProductRange;
using study::Unknown;
using Json = nlohmann::ordered_json;

constexpr double kMm = 1e3, kUm = 1e6, kMm3 = 1e9;

std::string number(double x, int digits = 4) {
  return std::isfinite(x) ? fmt::format("{:.{}g}", x, digits) : "-";
}
std::string percent(double x) { return fmt::format("{:.2g} %", 100.0 * x); }
std::string interval(const Estimate& e) { return fmt::format("{} to {}", number(e.low), number(e.high)); }

std::string volume_name(const CalibrationResult& r) {
  return r.closed_form ? "the volume by Archard's law" : "the volume by the paper's measure (eq. 10-12)";
}

/// Is a mean of the model within the measured range, and how far off if not.
std::string against(const char* what, double mean, const simulation::Range& measured, double unit,
                    const char* unit_name) {
  const std::string range =
      fmt::format("{} to {} {}", number(unit * measured.low), number(unit * measured.high), unit_name);
  const std::string head = fmt::format("{} {} {}", what, number(unit * mean), unit_name);
  if (mean < measured.low)
    return fmt::format("{} is {} below the smallest measured ({})", head, percent(1.0 - mean / measured.low),
                       range);
  if (mean > measured.high)
    return fmt::format("{} is {} above the largest measured ({})", head, percent(mean / measured.high - 1.0),
                       range);
  return fmt::format("{} is within the measured {}", head, range);
}

std::string range_text(const ProductRange& r) {
  if (!r.low_reached) return fmt::format("more than {} 1/Pa, if any", number(r.low));
  return fmt::format("{} to {}{} 1/Pa", number(r.low), r.high_reached ? "" : "more than ", number(r.high));
}

bool overlap(const ProductRange& a, const ProductRange& b) {
  const double a_high = a.high_reached ? a.high : INFINITY, b_high = b.high_reached ? b.high : INFINITY;
  const double a_low = a.low_reached ? a.low : INFINITY, b_low = b.low_reached ? b.low : INFINITY;
  return a_low <= b_high && b_low <= a_high;
}

std::string result_sentence(const CalibrationResult& r) {
  const bool alpha = r.unknown == Unknown::wear_coefficient;
  const Estimate& e = alpha ? r.wear_coefficient : r.revolutions;
  return fmt::format("{} = {}{} for {} = {}{}; {} % interval {}", alpha ? "wear_coefficient" : "revolutions",
                     number(e.value, 6), alpha ? " 1/Pa" : "", alpha ? "revolutions" : "wear_coefficient",
                     number(alpha ? r.revolutions.value : r.wear_coefficient.value, 6), alpha ? "" : " 1/Pa",
                     number(100.0 * r.coverage), interval(e) + (alpha ? " 1/Pa" : ""));
}

std::string fit_sentence(const CalibrationResult& r) {
  if (!r.closed_form)
    return fmt::format(
        "Under the paper's rule {} is not proportional to alpha n, so the root was searched: {} runs, the "
        "last one "
        "{:+.2g} % from the measured mean. V = c alpha n with c from the first run would have been {:+.2g} % "
        "off.",
        volume_name(r), r.runs, 100.0 * r.residual, 100.0 * r.first_residual);
  return fmt::format(
      "Closed form: V = c alpha n with c from one run gave {} {}, and a run there missed the measured volume "
      "by "
      "{:+.2g} %. Corrected by that, the confirming run misses it by {:+.1e} (relative); {} runs in all.",
      r.unknown == Unknown::wear_coefficient ? "wear_coefficient =" : "revolutions =",
      number(r.first_guess, 6), 100.0 * r.first_residual, r.residual, r.runs);
}

std::string interval_sentence(const CalibrationResult& r) {
  if (r.target.sd == 0.0)
    return "The measurement states no standard deviation, so the interval has no width: it is not known how "
           "certain the result is.";
  std::string text = fmt::format(
      "The interval is that of the measurement alone: {} -+ {:.3g} sd = {} to {} mm^3, carried through the "
      "model. If the "
      "tests scatter normally with this sd, it covers {} % of single tests; the uncertainty of their mean is "
      "smaller by the root of their number, which the case does not state.",
      number(kMm3 * r.target.mean), r.z, number(kMm3 * std::max(0.0, r.target.mean - r.z * r.target.sd)),
      number(kMm3 * (r.target.mean + r.z * r.target.sd)), number(100.0 * r.coverage));
  if (!r.failure.empty())
    text += fmt::format(" A bound marked - was not found: a run stops before it ({}).", r.failure);
  return text;
}

std::string ridge_sentence(const CalibrationResult& r) {
  std::string list, failed;
  for (const CalibrationPoint& p : r.ridge)
    (p.failure.empty() ? list : failed) +=
        fmt::format("{}{}", (p.failure.empty() ? list : failed).empty() ? "" : ", ", number(p.revolutions));
  std::string text = fmt::format(
      "Only the product is found: alpha n = {} 1/Pa ({}). Runs with this product in {} revolutions differ by "
      "{} in "
      "volume",
      number(r.product.value), interval(r.product), list, percent(r.ridge_volume_spread));
  if (std::isfinite(r.ridge_depth_spread))
    text += fmt::format(", {} in depth and {} in width, and their mean sections by {} at most (L2)",
                        percent(r.ridge_depth_spread), percent(r.ridge_width_spread),
                        percent(r.ridge_profile_distance));
  text += ": no measured volume, depth or width tells alpha and n apart beyond that.";
  if (!failed.empty())
    text += fmt::format(" The run in {} revolutions fails: too much wear per pass.", failed);
  return text;
}

std::string section_sentence(const CalibrationResult& r) {
  std::string text;
  const auto add = [&](const std::string& sentence) { text += (text.empty() ? "" : "; ") + sentence; };
  if (r.measured_depth && r.calibrated.depth.count > 0)
    add(against("depth", r.calibrated.depth.mean, *r.measured_depth, kUm, "um"));
  if (r.measured_width && r.calibrated.width.count > 0)
    add(against("width", r.calibrated.width.mean, *r.measured_width, kMm, "mm"));
  if (text.empty())
    return "The case gives no measured depth and width (or cuts no sections): nothing checks the volume.";
  return fmt::format("At the calibrated point the mean {}.", text);
}

std::string ranges_sentence(const CalibrationResult& r) {
  std::vector<std::pair<std::string, ProductRange>> ranges{{"volume", r.by_volume}};
  if (r.by_depth) ranges.emplace_back("depth", *r.by_depth);
  if (r.by_width) ranges.emplace_back("width", *r.by_width);
  if (ranges.size() == 1) return {};
  std::string text = "What each would need alpha n to be, alone: ", clashes;
  for (std::size_t i = 0; i < ranges.size(); ++i)
    text += fmt::format("{}{} {}", i == 0 ? "" : "; ", ranges[i].first, range_text(ranges[i].second));
  for (std::size_t i = 0; i < ranges.size(); ++i)
    for (std::size_t k = i + 1; k < ranges.size(); ++k)
      if (!overlap(ranges[i].second, ranges[k].second))
        clashes += fmt::format("{}{} and {}", clashes.empty() ? "" : ", ", ranges[i].first, ranges[k].first);
  if (!clashes.empty())
    return text +
           fmt::format(
               ". These contradict each other ({}): no coefficient and no number of revolutions satisfies "
               "them all, so the shape of the groove must come from elsewhere (stiffness or shape of the "
               "pin, "
               "ploughed edges, the rule of deformation).",
               clashes);
  double low = 0.0, high = INFINITY;
  for (const auto& [name, range] : ranges) {
    low = std::max(low, range.low);
    if (range.high_reached) high = std::min(high, range.high);
  }
  return text + fmt::format(
                    ". They agree where alpha n = {} to {} 1/Pa; there they narrow the product, never alpha "
                    "or n alone.",
                    number(low), number(high));
}

/// The paper's measurement, for which its fits may stand beside ours.
bool is_published(const CalibrationResult& r) {
  return r.test_revolutions && std::abs(*r.test_revolutions - 1302.5) < 1e-9 &&
         std::abs(r.target.mean - 0.565e-9) < 1e-15;
}

std::string published(const CalibrationResult& r, const CalibrationPair& row) {
  for (const study::PublishedFit& fit : study::published_fits())
    if (row.unknown == Unknown::revolutions &&
        std::abs(fit.wear_coefficient / row.wear_coefficient.value - 1.0) < 1e-9)
      return number(fit.revolutions(r.target.mean), 3);
  return "-";
}

std::vector<std::string> pair_columns(const CalibrationResult& r) {
  const std::string c = number(100.0 * r.coverage) + " %";
  std::vector<std::string> columns{"found",           "wear coefficient [1/Pa]", c + " interval [1/Pa]",
                                   "revolutions [-]", c + " interval [-]",       "scaling factor [-]"};
  if (is_published(r)) columns.emplace_back("revolutions, published fit [-]");
  return columns;
}

std::vector<std::string> pair_cells(const CalibrationResult& r, const CalibrationPair& row) {
  const bool alpha = row.unknown == Unknown::wear_coefficient;
  std::vector<std::string> cells{alpha ? "coefficient" : "revolutions",
                                 number(row.wear_coefficient.value),
                                 alpha ? interval(row.wear_coefficient) : "given",
                                 number(row.revolutions.value),
                                 alpha ? "given" : interval(row.revolutions),
                                 number(row.scaling_factor)};
  if (is_published(r)) cells.push_back(published(r, row));
  return cells;
}

std::vector<std::string> point_cells(const CalibrationPoint& p) {
  return {number(p.revolutions),
          number(p.wear_coefficient),
          number(kMm3 * p.volume, 6),
          number(kUm * p.depth.mean),
          number(kMm * p.width.mean),
          number(100.0 * p.profile_distance, 2),
          p.failure.empty() ? "completed" : "failed"};
}
const std::vector<std::string> kPointColumns{
    "revolutions [-]", "wear coefficient [1/Pa]", "volume [mm³]", "depth [µm]",
    "width [mm]",      "section apart [%]",       "run"};

/// Columns of text, each as wide as its widest cell.
std::string aligned(const std::vector<std::string>& columns,
                    const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> width;
  for (const std::string& c : columns) width.push_back(c.size());
  for (const auto& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) width[i] = std::max(width[i], row[i].size());
  std::string out;
  const auto line = [&](const std::vector<std::string>& cells) {
    std::string text = " ";
    for (std::size_t i = 0; i < cells.size(); ++i)
      text += fmt::format(" {:>{}}", cells[i], width[i] + (i > 0));
    out += text + "\n";
  };
  line(columns);
  for (const auto& row : rows) line(row);
  return out;
}

// --- JSON ------------------------------------------------------------------------------------------------
Json json_value(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }
Json json_estimate(const Estimate& e) {
  return {{"value", json_value(e.value)}, {"low", json_value(e.low)}, {"high", json_value(e.high)}};
}
Json json_point(const CalibrationPoint& p) {
  Json json{{"wear_coefficient_per_Pa", json_value(p.wear_coefficient)},
            {"revolutions", json_value(p.revolutions)},
            {"volume_mm3", json_value(kMm3 * p.volume)},
            {"depth_mean_mm", json_value(kMm * p.depth.mean)},
            {"depth_sd_mm", json_value(kMm * p.depth.sd)},
            {"width_mean_mm", json_value(kMm * p.width.mean)},
            {"width_sd_mm", json_value(kMm * p.width.sd)},
            {"profile_distance", json_value(p.profile_distance)}};
  if (!p.failure.empty()) json["failure"] = p.failure;
  return json;
}
Json json_range(const ProductRange& r) {
  return {{"low", json_value(r.low)},
          {"high", json_value(r.high)},
          {"low_reached", r.low_reached},
          {"high_reached", r.high_reached}};
}

// --- figures ---------------------------------------------------------------------------------------------
Series line(std::string name, int colour) {
  Series s;
  s.name = std::move(name);
  s.colour = colour;
  return s;
}

/// A quantity along alpha n with what was measured of it, and the calibrated point.
Panel curve_panel(const CalibrationResult& r, const std::string& title, double unit,
                  double CalibrationResult::CurvePoint::*member, double low, double high, double at) {
  Panel panel;
  panel.x.title = "α·n [1/Pa]";
  panel.y.title = title;
  Series model = line("model, any revolutions", 0);
  for (const auto& p : r.curve) {
    model.x.push_back(p.product);
    model.y.push_back(unit * (p.*member));
  }
  Series measured;
  measured.kind = Series::Kind::band;
  measured.name = "measured";
  measured.theirs = true;
  measured.x = {0.0, r.curve.empty() ? r.product.high : r.curve.back().product};
  measured.y_low = {unit * low, unit * low};
  measured.y_high = {unit * high, unit * high};
  measured.y = {unit * 0.5 * (low + high), unit * 0.5 * (low + high)};
  Series point = line("calibrated run", 1);
  point.kind = Series::Kind::markers;
  point.x = {r.calibrated.product()};
  point.y = {unit * at};
  panel.series = {measured, model, point};
  return panel;
}

Figure curve_figure(const CalibrationResult& r) {
  using Curve = CalibrationResult::CurvePoint;
  Figure f;
  f.id = "along-the-product";
  f.title = "Volume, depth and width against α·n";
  f.caption = fmt::format(
      "One run of the case that goes on beyond the measured ranges. Bands: the measured volume ({} % of "
      "tests), the "
      "measured ranges of depth and width. A band that the model crosses far from the calibrated point "
      "contradicts "
      "the volume.",
      number(100.0 * r.coverage));
  f.columns = 1;
  f.panels.push_back(curve_panel(r, "volume [mm³]", kMm3, &Curve::volume,
                                 std::max(0.0, r.target.mean - r.z * r.target.sd),
                                 r.target.mean + r.z * r.target.sd, r.calibrated.volume));
  if (r.measured_depth && r.by_depth)
    f.panels.push_back(curve_panel(r, "mean depth [µm]", kUm, &Curve::depth, r.measured_depth->low,
                                   r.measured_depth->high, r.calibrated.depth.mean));
  if (r.measured_width && r.by_width)
    f.panels.push_back(curve_panel(r, "mean width [mm]", kMm, &Curve::width, r.measured_width->low,
                                   r.measured_width->high, r.calibrated.width.mean));
  f.columns = static_cast<int>(f.panels.size());
  return f;
}

Figure volume_figure(const CalibrationResult& r) {
  Figure f;
  f.id = "volume-by-revolution";
  f.title = "Volume against revolutions";
  f.caption = fmt::format(
      "The case on its way to {} revolutions at α = {} 1/Pa, with the measured mean and the band of {} % of "
      "tests.{}",
      number(r.revolutions.value), number(r.wear_coefficient.value), number(100.0 * r.coverage),
      r.unknown == Unknown::wear_coefficient
          ? " Dashed: with the coefficients at the ends of the interval (scaled along α·n from the same run)."
          : "");
  Panel panel;
  panel.x.title = "revolutions [-]";
  panel.y.title = "wear volume [mm³]";
  const double n = r.calibrated.revolutions;
  Series measured;
  measured.kind = Series::Kind::band;
  measured.name = "measured";
  measured.theirs = true;
  const double low = std::max(0.0, r.target.mean - r.z * r.target.sd),
               high = r.target.mean + r.z * r.target.sd;
  const double last =
      r.unknown == Unknown::revolutions && std::isfinite(r.revolutions.high) ? r.revolutions.high : n;
  measured.x = {0.0, last};
  measured.y_low = {kMm3 * low, kMm3 * low};
  measured.y_high = {kMm3 * high, kMm3 * high};
  measured.y = {kMm3 * r.target.mean, kMm3 * r.target.mean};
  Series mean = line("measured mean", 0);
  mean.theirs = true;
  mean.x = measured.x;
  mean.y = measured.y;
  panel.series = {measured, mean};
  const auto with = [&](const std::string& name, double alpha, Series::Dash dash) {
    if (!std::isfinite(alpha) || !(alpha > 0.0)) return;
    Series s = line(name, 0);
    s.dash = dash;
    s.x.push_back(0.0);
    s.y.push_back(0.0);
    for (const auto& p : r.curve) {
      const double at = p.product / alpha, volume = kMm3 * p.volume;
      if (at >
          last * (1.0 + 1e-9)) {  // the line ends at the last revolution, between two points of the curve
        const double share = (last - s.x.back()) / (at - s.x.back());
        s.y.push_back(s.y.back() + share * (volume - s.y.back()));
        s.x.push_back(last);
        break;
      }
      s.x.push_back(at), s.y.push_back(volume);
    }
    panel.series.push_back(s);
  };
  with(fmt::format("α = {} 1/Pa", number(r.wear_coefficient.value)), r.wear_coefficient.value,
       Series::Dash::solid);
  if (r.unknown == Unknown::wear_coefficient) {
    with(fmt::format("α = {} 1/Pa", number(r.wear_coefficient.low)), r.wear_coefficient.low,
         Series::Dash::dash);
    with(fmt::format("α = {} 1/Pa", number(r.wear_coefficient.high)), r.wear_coefficient.high,
         Series::Dash::dash);
  }
  f.panels = {panel};
  return f;
}

Figure ridge_figure(const CalibrationResult& r) {
  Figure f;
  f.id = "ridge";
  f.title = "The ridge α·n = constant";
  f.caption =
      "Every pair on the line wears the measured volume; the band is its interval. Points: pairs that were "
      "run, and the "
      "pairs of the table.";
  Panel panel;
  panel.x = {.title = "revolutions [-]", .log = true};
  panel.y = {.title = "wear coefficient [1/Pa]", .log = true};
  Series band, middle = line("α·n of the calibrated run", 0), runs = line("runs", 1),
               pairs = line("table", 2);
  band.kind = Series::Kind::band;
  band.name = fmt::format("{} % interval", number(100.0 * r.coverage));
  runs.kind = pairs.kind = Series::Kind::markers;
  double first = r.calibrated.revolutions, last = first;
  for (const CalibrationPoint& p : r.ridge)
    if (p.failure.empty()) runs.x.push_back(p.revolutions), runs.y.push_back(p.wear_coefficient);
  for (const CalibrationPair& p : r.pairs)
    pairs.x.push_back(p.revolutions.value), pairs.y.push_back(p.wear_coefficient.value);
  for (const auto& x : {runs.x, pairs.x})
    for (const double n : x)
      if (std::isfinite(n)) first = std::min(first, n), last = std::max(last, n);
  if (r.test_revolutions) last = std::max(last, *r.test_revolutions);
  for (int i = 0; i <= 40; ++i) {
    const double n = first * std::pow(last / first, i / 40.0);
    middle.x.push_back(n), middle.y.push_back(r.product.value / n);
    band.x.push_back(n), band.y.push_back(r.product.value / n);
    band.y_low.push_back(r.product.low / n), band.y_high.push_back(r.product.high / n);
  }
  if (r.product.low > 0.0 && std::isfinite(r.product.high)) panel.series.push_back(band);
  panel.series.push_back(middle);
  panel.series.push_back(runs);
  if (!pairs.x.empty()) panel.series.push_back(pairs);
  f.panels = {panel};
  return f;
}

std::string method_sentence(const CalibrationResult& r) {
  return fmt::format("Pair {}/{}; trials {}; matched: {}.", r.abrader, r.worn,
                     r.method == simulation::Method::quasi_static ? "quasi-static" : "dynamic",
                     volume_name(r));
}

}  // namespace

std::vector<std::string> calibration_findings(const CalibrationResult& r) {
  std::vector<std::string> all{fit_sentence(r), interval_sentence(r), ridge_sentence(r), section_sentence(r),
                               ranges_sentence(r)};
  std::erase(all, std::string{});
  return all;
}

std::string calibration_text(const CalibrationResult& r) {
  std::string out = fmt::format("{}\n{}\n", result_sentence(r), method_sentence(r));
  if (r.test_revolutions)
    out += fmt::format("scaling factor {} = {} / {} revolutions\n", number(r.scaling_factor),
                       number(*r.test_revolutions, 6), number(r.revolutions.value, 6));
  for (const std::string& finding : calibration_findings(r)) out += fmt::format("\n* {}\n", finding);
  std::vector<std::vector<std::string>> rows;
  std::string failures;
  for (const CalibrationPair& row : r.pairs) {
    rows.push_back(pair_cells(r, row));
    if (!row.failure.empty())
      failures += fmt::format("  (-: at {} 1/Pa, {} revolutions: {})\n", number(row.wear_coefficient.value),
                              number(row.revolutions.value), row.failure);
  }
  if (!rows.empty())
    out +=
        fmt::format("\nPairs that wear the measured volume:\n{}{}", aligned(pair_columns(r), rows), failures);
  return out;
}

std::string calibration_json(const CalibrationResult& r) {
  Json json;
  json["unknown"] = r.unknown == Unknown::wear_coefficient ? "wear_coefficient" : "revolutions";
  json["pair"] = r.abrader + "/" + r.worn;
  json["method"] = r.method == simulation::Method::quasi_static ? "quasi_static" : "dynamic";
  json["closed_form"] = r.closed_form;
  json["target"] = {{"volume_mm3", kMm3 * r.target.mean},
                    {"sd_mm3", kMm3 * r.target.sd},
                    {"coverage", r.coverage},
                    {"z", r.z}};
  json["wear_coefficient_per_Pa"] = json_estimate(r.wear_coefficient);
  json["revolutions"] = json_estimate(r.revolutions);
  json["product_per_Pa"] = json_estimate(r.product);
  json["scaling_factor"] = json_value(r.scaling_factor);
  json["first_guess"] = json_value(r.first_guess);
  json["first_residual"] = json_value(r.first_residual);
  json["residual"] = json_value(r.residual);
  json["runs"] = r.runs;
  if (!r.failure.empty()) json["failure"] = r.failure;
  json["calibrated"] = json_point(r.calibrated);
  json["ridge"] = {{"volume_spread", json_value(r.ridge_volume_spread)},
                   {"depth_spread", json_value(r.ridge_depth_spread)},
                   {"width_spread", json_value(r.ridge_width_spread)},
                   {"profile_distance", json_value(r.ridge_profile_distance)},
                   {"runs", Json::array()}};
  for (const CalibrationPoint& p : r.ridge) json["ridge"]["runs"].push_back(json_point(p));
  json["product_ranges_per_Pa"] = {{"volume", json_range(r.by_volume)}};
  if (r.by_depth) json["product_ranges_per_Pa"]["depth"] = json_range(*r.by_depth);
  if (r.by_width) json["product_ranges_per_Pa"]["width"] = json_range(*r.by_width);
  json["pairs"] = Json::array();
  for (const CalibrationPair& p : r.pairs) {
    Json row{{"found", p.unknown == Unknown::wear_coefficient ? "wear_coefficient" : "revolutions"},
             {"wear_coefficient_per_Pa", json_estimate(p.wear_coefficient)},
             {"revolutions", json_estimate(p.revolutions)},
             {"scaling_factor", json_value(p.scaling_factor)}};
    if (!p.failure.empty()) row["failure"] = p.failure;
    json["pairs"].push_back(row);
  }
  json["findings"] = calibration_findings(r);
  return json.dump(2) + "\n";
}

Page calibration_page(const CalibrationResult& r, const std::string& title) {
  Page page;
  page.title = title.empty() ? "Calibration" : "Calibration: " + title;
  page.summary = typeset(result_sentence(r) + ".");
  page.cards = {{"wear coefficient", number(r.wear_coefficient.value) + " 1/Pa"},
                {"revolutions", number(r.revolutions.value)},
                {"α·n", number(r.product.value) + " 1/Pa"},
                {"scaling factor", number(r.scaling_factor)},
                {"volume missed by", fmt::format("{:.1e}", std::abs(r.residual))}};
  PageSection result{.title = "Result", .items = {}};
  result.items.emplace_back(Paragraph{typeset(method_sentence(r))});
  for (const std::string& finding : {fit_sentence(r), interval_sentence(r)})
    result.items.emplace_back(Paragraph{typeset(finding)});
  result.items.emplace_back(volume_figure(r));

  PageSection ridge{.title = "What the measurement cannot tell", .items = {}};
  ridge.items.emplace_back(Paragraph{typeset(ridge_sentence(r))});
  ridge.items.emplace_back(ridge_figure(r));
  DataTable runs{
      .id = "ridge-runs",
      .title = "Runs with the same α·n",
      .caption = "Section apart: relative L2 distance of the mean section from the calibrated run's.",
      .columns = kPointColumns};
  for (const CalibrationPoint& p : r.ridge) runs.rows.push_back(point_cells(p));
  ridge.items.emplace_back(runs);

  PageSection sections{.title = "Depth and width", .items = {}};
  for (const std::string& finding : {section_sentence(r), ranges_sentence(r)})
    if (!finding.empty()) sections.items.emplace_back(Paragraph{typeset(finding)});
  sections.items.emplace_back(curve_figure(r));

  page.sections = {result, ridge, sections};
  if (!r.pairs.empty()) {
    DataTable pairs{
        .id = "pairs",
        .title = "Pairs that wear the measured volume",
        .caption = r.closed_form
                       ? "From the calibrated run's V = c α n. The scaling factor is the revolutions of the "
                         "test over these."
                       : "Each row from runs of its own. The scaling factor is the revolutions of the test "
                         "over these.",
        .columns = pair_columns(r)};
    if (is_published(r))
      pairs.caption += " Published fit: where eq. 13-17 of the paper reach the measured mean.";
    for (const CalibrationPair& p : r.pairs) {
      pairs.rows.push_back(pair_cells(r, p));
      if (!p.failure.empty()) pairs.caption += " A bound marked - lies beyond where its run stops.";
    }
    page.sections.push_back({.title = "Coefficients and revolutions", .items = {pairs}});
  }
  return page;
}

}  // namespace abradem::report
