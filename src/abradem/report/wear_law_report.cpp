// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/report/wear_law_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "abradem/report/text.h"

namespace abradem::report {

namespace {

using analysis::Estimate;
using analysis::FTest;
using study::CrossValidation;
using study::Identifiable;
using study::WearLawFit;
using Json = nlohmann::ordered_json;

constexpr double kMm3 = 1e9;

std::string number(double x, int digits = 4) {
  return std::isfinite(x) ? fmt::format("{:.{}g}", x, digits) : "-";
}
std::string interval(const Estimate& e, double unit = 1.0) {
  return fmt::format("{} to {}", number(unit * e.low, 3), number(unit * e.high, 3));
}
std::string percent(double share) {
  return std::isfinite(share) ? fmt::format("{:.3g} %", 100.0 * share) : "-";
}
std::string p_text(double p) {
  return !std::isfinite(p) ? "p unknown"
         : p < 1e-4        ? fmt::format("p = {:.1e}", p)
                           : fmt::format("p = {:.2g}", p);
}
std::string f_text(const FTest& t) {
  return fmt::format("F({}, {}) = {}, {}", t.df_simpler, t.df_error, number(t.statistic, 3), p_text(t.p));
}
std::string name(const WearLawFit& r) { return r.tests.material.empty() ? "the tests" : r.tests.material; }

/// "V = 8.3e-3 mm^3 (F/N)^1.79 (s/m)^q" as far as the exponents are known.
std::string law(const WearLawFit& r) {
  switch (r.identifiable) {
    case Identifiable::both:
      return fmt::format("V = {} mm^3 (F/N)^{} (s/m)^{}", number(kMm3 * r.k->value), number(r.p->value),
                         number(r.q->value));
    case Identifiable::force:
      return fmt::format("V = {} mm^3 (F/N)^{} at s = {} m", number(kMm3 * r.k->value), number(r.p->value),
                         number(r.distance));
    case Identifiable::distance:
      return fmt::format("V = {} mm^3 (s/m)^{} at F = {} N", number(kMm3 * r.k->value), number(r.q->value),
                         number(r.force));
    case Identifiable::combined:
      return fmt::format("V = {} mm^3 (F/{} N)^{} along s ~ F^{}", number(kMm3 * r.volume.value),
                         number(r.force), number(r.combined->value), number(r.slope));
    case Identifiable::neither:
      break;
  }
  return fmt::format("V = {} mm^3 at F = {} N, s = {} m", number(kMm3 * r.volume.value), number(r.force),
                     number(r.distance));
}

std::string archard_sentence(const WearLawFit& r) {
  const std::string level = number(100.0 * (1.0 - r.confidence), 3) + " %";
  if (r.identifiable == Identifiable::neither)
    return "Archard's law cannot be tested: all tests have the same force and distance.";
  if (!std::isfinite(r.against_archard.p))
    return "Archard's law cannot be tested: nothing is left over by the power law to compare with.";
  if (!r.archard_rejected())
    return fmt::format("Archard's law V = alpha F s is not rejected at {} ({}): alpha = {} 1/Pa ({}).", level,
                       f_text(r.against_archard), number(r.archard.value), interval(r.archard));
  return fmt::format(
      "Archard's law V = alpha F s does not hold: exponents of 1 are rejected at {} ({}). Its best alpha, {} "
      "1/Pa, "
      "leaves a scatter of ln V of {} where the power law leaves {}.",
      level, f_text(r.against_archard), number(r.archard.value), number(r.archard_residual_sd, 3),
      number(r.residual_sd, 3));
}

std::string exponent_text(const char* what, const Estimate& e) {
  const bool one = e.low <= 1.0 && e.high >= 1.0;
  return fmt::format("{} = {} ({}{})", what, number(e.value), interval(e), one ? ", which holds 1" : "");
}

std::string law_sentence(const WearLawFit& r) {
  std::string text = fmt::format("Power law: {}", law(r));
  std::string exponents;
  if (r.p) exponents += exponent_text("p", *r.p);
  if (r.q) exponents += (exponents.empty() ? "" : ", ") + exponent_text("q", *r.q);
  if (r.combined) exponents += exponent_text("p + b q", *r.combined);
  if (!exponents.empty()) text += fmt::format("; {}", exponents);
  return text + fmt::format("; R2 = {} in ln V, {} tests. Intervals are of {} %.", number(r.r_squared, 3),
                            r.tests.volume.size(), number(100.0 * r.confidence, 3));
}

std::string identifiable_sentence(const WearLawFit& r) {
  switch (r.identifiable) {
    case Identifiable::force:
      return fmt::format(
          "q is not identifiable: all tests slid {} m, so they say nothing of how wear grows with the "
          "distance. "
          "Archard's law is tested in the force alone.",
          number(r.distance));
    case Identifiable::distance:
      return fmt::format(
          "p is not identifiable: all tests had {} N, so they say nothing of how wear grows with the force. "
          "Archard's law is tested in the distance alone.",
          number(r.force));
    case Identifiable::combined:
      return fmt::format(
          "p and q are not identifiable: force and distance were changed together, ln s = a + b ln F with b "
          "= {}, so "
          "only p + b q is found (1 + b = {} by Archard's law).",
          number(r.slope), number(1.0 + r.slope));
    case Identifiable::neither:
      return "Neither p nor q is identifiable: all tests have the same force and distance.";
    case Identifiable::both:
      break;
  }
  if (r.variance_inflation > 10.0)
    return fmt::format(
        "Force and distance were changed nearly together: the variances of p and q are {} times those of a "
        "crossed "
        "design.",
        number(r.variance_inflation, 3));
  return {};
}

std::string validation_sentence(const WearLawFit& r) {
  const auto pair = [&](const CrossValidation& power, const CrossValidation& archard) {
    return fmt::format("{} by the power law, {} by Archard's", percent(power.relative_error),
                       percent(archard.relative_error));
  };
  std::string text =
      fmt::format("Error of prediction (rms of predicted/measured - 1), each test left out in turn: {}",
                  pair(r.one_out, r.one_out_archard));
  if (r.level_out.folds > 1 && r.level_out.folds < r.one_out.folds)
    text += fmt::format("; all tests of one force and distance left out together ({} folds): {}",
                        r.level_out.folds, pair(r.level_out, r.level_out_archard));
  return text + ".";
}

std::string residual_sentence(const WearLawFit& r) {
  const double level = 1.0 - r.confidence;
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : "; ") + part; };
  if (r.curvature && std::isfinite(r.curvature->p))
    add(fmt::format("a bend in the logarithms is {} ({})",
                    r.curvature->p < level ? "seen: no single power law" : "not seen", f_text(*r.curvature)));
  if (r.lack_of_fit && std::isfinite(r.lack_of_fit->p))
    add(fmt::format("against the scatter of repeats the power law {} ({})",
                    r.lack_of_fit->p < level ? "lacks something" : "lacks nothing that is seen",
                    f_text(*r.lack_of_fit)));
  const auto& d = r.residuals;
  if (std::isfinite(d.shapiro_wilk.p))
    add(fmt::format("residuals normal: Shapiro-Wilk {}, Anderson-Darling {}", p_text(d.shapiro_wilk.p),
                    p_text(d.anderson_darling.p)));
  if (std::isfinite(d.equal_scatter_p)) add(fmt::format("equal scatter: {}", p_text(d.equal_scatter_p)));
  if (std::isfinite(d.outlier_p))
    add(fmt::format("furthest out: test {} of this material, {} sd, {}", d.outlier + 1,
                    number(d.studentised[d.outlier], 3), p_text(d.outlier_p)));
  return text.empty() ? "No residuals to look at." : fmt::format("Diagnosis: {}.", text);
}

std::string common_sentence(std::span<const WearLawFit> fits) {
  const auto test = study::common_exponents(fits);
  if (!test || !std::isfinite(test->p)) return {};
  return fmt::format("One set of exponents for all materials, each with its own k, is {} ({}).",
                     test->p < 1.0 - fits.front().confidence ? "rejected" : "not rejected", f_text(*test));
}

std::string summary_sentence(std::span<const WearLawFit> fits) {
  std::string held, rejected, untested;
  for (const WearLawFit& r : fits) {
    std::string& list = !std::isfinite(r.against_archard.p) ? untested
                        : r.archard_rejected()              ? rejected
                                                            : held;
    list += (list.empty() ? "" : ", ") + name(r);
  }
  std::string text;
  const auto add = [&](const char* what, const std::string& list) {
    if (!list.empty()) text += fmt::format("{}{} {}", text.empty() ? "" : "; ", what, list);
  };
  add("linear Archard does not hold for", rejected);
  add("linear Archard is not rejected for", held);
  add("linear Archard cannot be tested for", untested);
  if (!text.empty()) text[0] = 'L';
  return text + ".";
}

// --- tables ----------------------------------------------------------------------------------------------
DataTable exponents_table(std::span<const WearLawFit> fits) {
  const std::string c = number(100.0 * fits.front().confidence, 3) + " %";
  DataTable t{
      .id = "exponents",
      .title = "Power law and Archard's law",
      .caption = fmt::format(
          "V = k F^p s^q by least squares of ln V. Archard's law is p = q = 1; the F-test compares what the "
          "two "
          "leave over. A dash: the tests do not tell. k is in mm³ at 1 N and 1 m; where an exponent is not "
          "known, at the tests' own force or distance. Intervals of {}.",
          c)};
  t.columns = {"material",     "tests",   "p [-]",  "p, interval",         "q [-]",
               "q, interval",  "k [mm³]", "R² [-]", "scatter of ln V [-]", "F-test of Archard, p [-]",
               "Archard's law"};
  for (const WearLawFit& r : fits)
    t.rows.push_back({name(r), std::to_string(r.tests.volume.size()), r.p ? number(r.p->value) : "–",
                      r.p ? interval(*r.p) : "–", r.q ? number(r.q->value) : "–", r.q ? interval(*r.q) : "–",
                      r.k ? number(kMm3 * r.k->value) : "–", number(r.r_squared, 3), number(r.residual_sd, 3),
                      number(r.against_archard.p, 2),
                      !std::isfinite(r.against_archard.p) ? "not testable"
                      : r.archard_rejected()              ? "rejected"
                                                          : "not rejected"});
  return t;
}

DataTable prediction_table(std::span<const WearLawFit> fits) {
  DataTable t{
      .id = "prediction",
      .title = "Error of prediction",
      .caption =
          "Root mean square of predicted/measured - 1 for tests that the fit has not seen, on the same "
          "folds. Level: all tests of one force and distance. A dash: a fold cannot be fitted."};
  t.columns = {"material",
               "power law, one test out [%]",
               "Archard, one test out [%]",
               "levels",
               "power law, one level out [%]",
               "Archard, one level out [%]",
               "alpha of Archard [1/Pa]",
               "alpha, interval [1/Pa]"};
  const auto cell = [](const CrossValidation& c) { return number(100.0 * c.relative_error, 3); };
  for (const WearLawFit& r : fits)
    t.rows.push_back({name(r), cell(r.one_out), cell(r.one_out_archard), std::to_string(r.level_out.folds),
                      cell(r.level_out), cell(r.level_out_archard), number(r.archard.value),
                      interval(r.archard)});
  return t;
}

DataTable diagnosis_table(std::span<const WearLawFit> fits) {
  DataTable t{
      .id = "diagnosis",
      .title = "What the power law leaves over",
      .caption =
          "p-values: small ones speak against the assumption named. Lack of fit: against the scatter of "
          "tests with the same force and distance, which is too large where something else was varied "
          "among them. Furthest out: externally studentised residual, p for the largest of all tests."};
  t.columns = {"material",
               "no bend, p [-]",
               "no lack of fit, p [-]",
               "normal (Shapiro-Wilk), p [-]",
               "normal (Anderson-Darling), p [-]",
               "equal scatter, p [-]",
               "furthest out: test",
               "studentised [-]",
               "p [-]"};
  for (const WearLawFit& r : fits) {
    const auto& d = r.residuals;
    const bool outlier = std::isfinite(d.outlier_p);
    t.rows.push_back({name(r), r.curvature ? number(r.curvature->p, 2) : "–",
                      r.lack_of_fit ? number(r.lack_of_fit->p, 2) : "–", number(d.shapiro_wilk.p, 2),
                      number(d.anderson_darling.p, 2), number(d.equal_scatter_p, 2),
                      outlier ? std::to_string(d.outlier + 1) : "–",
                      outlier ? number(d.studentised[d.outlier], 3) : "–", number(d.outlier_p, 2)});
  }
  return t;
}

// --- figures ---------------------------------------------------------------------------------------------
constexpr int kColours = 8;
int colour(std::size_t i) { return static_cast<int>(i % kColours); }

Panel measured_panel(std::span<const WearLawFit> fits, const char* title, bool power) {
  Panel panel{.title = title,
              .x = {.title = "measured volume [mm³]", .log = true},
              .y = {.title = "predicted volume [mm³]", .log = true}};
  double low = INFINITY, high = 0.0;
  for (std::size_t m = 0; m < fits.size(); ++m) {
    const WearLawFit& r = fits[m];
    Series s{.kind = Series::Kind::markers, .name = name(r), .colour = colour(m)};
    const std::vector<double>& predicted = (power ? r.one_out : r.one_out_archard).predicted;
    for (std::size_t i = 0; i < predicted.size(); ++i) {
      s.x.push_back(kMm3 * r.tests.volume[i]);
      s.y.push_back(kMm3 * predicted[i]);
      low = std::min(low, s.x.back());
      high = std::max(high, s.x.back());
    }
    panel.series.push_back(std::move(s));
  }
  Series equal{
      .kind = Series::Kind::line, .name = "predicted = measured", .x = {low, high}, .y = {low, high}};
  equal.dash = Series::Dash::dash;
  equal.colour = 7;
  panel.series.push_back(std::move(equal));
  return panel;
}

Figure measured_figure(std::span<const WearLawFit> fits) {
  return {.id = "predicted",
          .title = "Measured against predicted volume",
          .caption = "Each test predicted by a fit of the other tests of its material.",
          .panels = {measured_panel(fits, "Power law", true), measured_panel(fits, "Archard's law", false)},
          .columns = 2};
}

/// V against F or s with the law and its bands, the other factor at its mean.
Figure law_figure(std::span<const WearLawFit> fits) {
  Figure figure{.id = "laws", .title = "Volume against force", .columns = 2};
  figure.caption =
      "Line: power law at the mean distance; dark band: its confidence; dashed: Archard's law there.";
  for (std::size_t m = 0; m < fits.size(); ++m) {
    const WearLawFit& r = fits[m];
    if (r.identifiable != Identifiable::both && r.identifiable != Identifiable::force) continue;
    const auto [low, high] = std::ranges::minmax(r.tests.force);
    Panel panel{.title = name(r),
                .x = {.title = "force [N]", .log = true},
                .y = {.title = "volume [mm³]", .log = true}};
    Series band{.kind = Series::Kind::band, .name = "confidence", .colour = 0},
        line{.name = "power law", .colour = 0}, archard{.name = "Archard's law", .colour = 1},
        tests{.kind = Series::Kind::markers, .name = "tests", .theirs = true};
    archard.dash = Series::Dash::dash;
    constexpr int kPoints = 40;
    for (int i = 0; i <= kPoints; ++i) {
      const double f = low * std::pow(high / low, i / double{kPoints});
      std::vector<double> row{1.0, std::log(f / r.force)};
      if (r.identifiable == Identifiable::both) row.push_back(0.0);
      const Estimate e = r.model.mean_at(row);
      for (Series* s : {&band, &line, &archard}) s->x.push_back(f);
      band.y.push_back(kMm3 * std::exp(e.value));
      band.y_low.push_back(kMm3 * std::exp(e.low));
      band.y_high.push_back(kMm3 * std::exp(e.high));
      line.y.push_back(band.y.back());
      archard.y.push_back(kMm3 * r.archard.value * f * r.distance);
    }
    for (std::size_t i = 0; i < r.tests.force.size(); ++i) {
      tests.x.push_back(r.tests.force[i]);
      tests.y.push_back(kMm3 * r.tests.volume[i]);
    }
    panel.series = {std::move(band), std::move(line), std::move(archard), std::move(tests)};
    figure.panels.push_back(std::move(panel));
  }
  return figure;
}

Figure residual_figure(std::span<const WearLawFit> fits) {
  Figure figure{
      .id = "residuals",
      .title = "What the laws leave over",
      .caption =
          "ln of measured over fitted volume, against the force: a trend or a bend is what a law misses.",
      .columns = 2};
  for (const bool power : {true, false}) {
    Panel panel{.title = power ? "Power law" : "Archard's law",
                .x = {.title = "force [N]", .log = true},
                .y = {.title = "ln(measured/fitted) [-]"}};
    for (std::size_t m = 0; m < fits.size(); ++m) {
      const WearLawFit& r = fits[m];
      Series s{.kind = Series::Kind::markers, .name = name(r), .x = r.tests.force, .colour = colour(m)};
      for (std::size_t i = 0; i < s.x.size(); ++i)
        s.y.push_back(std::log(r.tests.volume[i] / (power ? r.fitted : r.archard_fitted)[i]));
      panel.series.push_back(std::move(s));
    }
    figure.panels.push_back(std::move(panel));
  }
  return figure;
}

Figure exponent_figure(std::span<const WearLawFit> fits) {
  Figure figure{.id = "exponent-intervals", .title = "Exponents with their intervals", .columns = 2};
  figure.caption = fmt::format("Intervals of {} %; the dashed line is Archard's law.",
                               number(100.0 * fits.front().confidence, 3));
  const auto panel = [&](const char* title, auto member) {
    Panel p{.x = {.title = "material [-]"}, .y = {.title = title}};
    Series s{.kind = Series::Kind::markers};
    for (std::size_t m = 0; m < fits.size(); ++m) {
      const std::optional<Estimate>& e = fits[m].*member;
      if (!e) continue;
      const auto at = static_cast<double>(m);
      s.x.push_back(at);
      s.y.push_back(e->value);
      s.y_low.push_back(e->low);
      s.y_high.push_back(e->high);
    }
    if (s.x.empty()) return;
    for (std::size_t m = 0; m < fits.size(); ++m)
      p.x.labels.emplace_back(static_cast<double>(m), name(fits[m]));
    const double last = static_cast<double>(fits.size()) - 0.5;
    p.x.range = {-0.5, last};
    Series one{
        .kind = Series::Kind::line, .name = "Archard's law", .x = {-0.5, last}, .y = {1.0, 1.0}, .colour = 1};
    one.dash = Series::Dash::dash;
    p.series = {std::move(one), std::move(s)};
    figure.panels.push_back(std::move(p));
  };
  panel("exponent p of the force [-]", &WearLawFit::p);
  panel("exponent q of the distance [-]", &WearLawFit::q);
  if (figure.panels.size() < 2) figure.columns = 1;
  return figure;
}

// --- JSON ------------------------------------------------------------------------------------------------
Json json_value(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }
Json json_estimate(const Estimate& e, double unit = 1.0) {
  return {{"value", json_value(unit * e.value)},
          {"low", json_value(unit * e.low)},
          {"high", json_value(unit * e.high)}};
}
Json json_estimate(const std::optional<Estimate>& e, double unit = 1.0) {
  return e ? json_estimate(*e, unit) : Json(nullptr);
}
Json json_test(const FTest& t) {
  return {{"F", json_value(t.statistic)}, {"df", {t.df_simpler, t.df_error}}, {"p", json_value(t.p)}};
}
Json json_test(const std::optional<FTest>& t) { return t ? json_test(*t) : Json(nullptr); }
Json json_validation(const CrossValidation& power, const CrossValidation& archard) {
  return {{"folds", power.folds},
          {"power_law_relative_error", json_value(power.relative_error)},
          {"power_law_log_error", json_value(power.log_error)},
          {"archard_relative_error", json_value(archard.relative_error)},
          {"archard_log_error", json_value(archard.log_error)}};
}
const char* identifiable_name(Identifiable what) {
  switch (what) {
    case Identifiable::both:
      return "p and q";
    case Identifiable::force:
      return "p";
    case Identifiable::distance:
      return "q";
    case Identifiable::combined:
      return "p + b q";
    case Identifiable::neither:
      break;
  }
  return "neither";
}

Json json_fit(const WearLawFit& r) {
  const auto& d = r.residuals;
  Json json{{"material", r.tests.material},
            {"tests", r.tests.volume.size()},
            {"identifiable", identifiable_name(r.identifiable)},
            {"force_N", r.force},
            {"distance_m", r.distance},
            {"volume_mm3", json_estimate(r.volume, kMm3)},
            {"p", json_estimate(r.p)},
            {"q", json_estimate(r.q)},
            {"k_mm3", json_estimate(r.k, kMm3)}};
  if (r.combined) json["combined"] = {{"b", r.slope}, {"p_plus_b_q", json_estimate(r.combined)}};
  json["r_squared"] = json_value(r.r_squared);
  json["residual_sd"] = json_value(r.residual_sd);
  json["variance_inflation"] = json_value(r.variance_inflation);
  json["archard"] = {
      {"wear_coefficient_per_Pa", json_estimate(r.archard)},
      {"residual_sd", json_value(r.archard_residual_sd)},
      {"rejected", std::isfinite(r.against_archard.p) ? Json(r.archard_rejected()) : Json(nullptr)},
      {"test", json_test(r.against_archard)}};
  json["one_test_out"] = json_validation(r.one_out, r.one_out_archard);
  json["one_level_out"] = json_validation(r.level_out, r.level_out_archard);
  json["diagnosis"] = {{"curvature", json_test(r.curvature)},
                       {"lack_of_fit", json_test(r.lack_of_fit)},
                       {"shapiro_wilk_p", json_value(d.shapiro_wilk.p)},
                       {"anderson_darling_p", json_value(d.anderson_darling.p)},
                       {"equal_scatter_p", json_value(d.equal_scatter_p)},
                       {"outlier_test", std::isfinite(d.outlier_p) ? Json(d.outlier + 1) : Json(nullptr)},
                       {"outlier_p", json_value(d.outlier_p)}};
  json["findings"] = wear_law_findings(r);
  return json;
}

}  // namespace

std::vector<std::string> wear_law_findings(const WearLawFit& r) {
  std::vector<std::string> out;
  for (std::string s : {archard_sentence(r), law_sentence(r), identifiable_sentence(r),
                        validation_sentence(r), residual_sentence(r)})
    if (!s.empty()) out.push_back(std::move(s));
  return out;
}

std::string wear_law_text(std::span<const WearLawFit> fits) {
  std::string text = summary_sentence(fits) + "\n";
  for (const WearLawFit& r : fits) {
    text += fmt::format("\n{}\n", r.tests.material.empty() ? "All tests" : r.tests.material);
    for (const std::string& finding : wear_law_findings(r)) text += fmt::format("  {}\n", finding);
  }
  if (const std::string common = common_sentence(fits); !common.empty())
    text += fmt::format("\n{}\n", common);
  return text;
}

std::string wear_law_json(std::span<const WearLawFit> fits) {
  Json json{{"confidence", fits.front().confidence}, {"materials", Json::array()}};
  for (const WearLawFit& r : fits) json["materials"].push_back(json_fit(r));
  json["common_exponents"] = json_test(study::common_exponents(fits));
  return json.dump(2) + "\n";
}

Page wear_law_page(std::span<const WearLawFit> fits, const std::string& source) {
  std::size_t tests = 0;
  std::size_t rejected = 0;
  for (const WearLawFit& r : fits) {
    tests += r.tests.volume.size();
    rejected += r.archard_rejected() ? 1 : 0;
  }
  Page page{.title = "Wear law of " + source, .summary = summary_sentence(fits)};
  page.cards = {{"tests", std::to_string(tests)},
                {"materials", std::to_string(fits.size())},
                {"Archard's law rejected", fmt::format("{} of {}", rejected, fits.size())}};
  for (const WearLawFit& r : fits) {
    if (page.cards.size() > 5) break;
    if (r.p)
      page.cards.emplace_back("p, " + name(r), fmt::format("{} ({})", number(r.p->value, 3), interval(*r.p)));
  }
  PageSection law{.title = "The law", .items = {exponents_table(fits), exponent_figure(fits)}};
  if (std::get<Figure>(law.items.back()).panels.empty()) law.items.pop_back();
  if (Figure figure = law_figure(fits); !figure.panels.empty()) law.items.emplace_back(std::move(figure));
  if (const std::string common = common_sentence(fits); !common.empty())
    law.items.emplace_back(Paragraph{common});
  PageSection prediction{.title = "Prediction", .items = {prediction_table(fits), measured_figure(fits)}};
  PageSection left{.title = "Diagnosis", .items = {residual_figure(fits), diagnosis_table(fits)}};
  page.sections = {std::move(law), std::move(prediction), std::move(left)};
  PageSection words{.title = "In words"};
  for (const WearLawFit& r : fits)
    for (const std::string& finding : wear_law_findings(r))
      words.items.emplace_back(
          Paragraph{(r.tests.material.empty() ? "" : name(r) + ": ") + typeset(finding)});
  page.sections.push_back(std::move(words));
  return page;
}

}  // namespace abradem::report
