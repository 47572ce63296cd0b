// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/report/paper_claims.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "abradem/analysis/run_in.h"
#include "abradem/analysis/statistics.h"
#include "abradem/core/error.h"
#include "abradem/report/text.h"
#include "abradem/study/calibration.h"

namespace abradem::report {
namespace {

using study::Interval;
using study::Verdict;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kLevel = 0.05;
/// The revolutions that the paper's run-in leaves, and those it models the test with.
constexpr double kLeastRevolutions = 8.0, kModelledRevolutions = 12.0;
constexpr double kPublishedCoefficient = 1.7e-11;

using Answer = std::optional<ClaimAnswer>;

std::string number(double x, int digits = 3) { return readable(x, digits); }
std::string range_text(Interval r, const char* unit) {
  return fmt::format("{} to {} {}", number(r.low), number(r.high), unit);
}
std::string percent_off(double ours, double theirs) {
  const double percent = 100.0 * (ours / theirs - 1.0);
  return std::abs(percent) < 0.5 ? "0 %" : fmt::format("{:+.0f} %", percent);
}
Interval interval_of(const PublishedClaim& claim) { return {claim.numbers.front(), claim.numbers.back()}; }

/// The wear coefficients that the measured volume asks for, and where V reaches it.
double target(const PaperRuns& runs) {
  return runs.measured.wear_volume ? 1e9 * runs.measured.wear_volume->mean : kNaN;
}
Interval target_band(const PaperRuns& runs) {
  if (!runs.measured.wear_volume) return {kNaN, kNaN};
  const auto& v = *runs.measured.wear_volume;
  return {1e9 * (v.mean - v.sd), 1e9 * (v.mean + v.sd)};
}

// ---------------------------------------------------------------- mesh size

std::vector<double> mesh_means(const PaperReading& reading, std::string_view column) {
  std::vector<double> out;
  for (const FinishedRun& run : reading.mesh_sizes)
    out.push_back(analysis::summarise(run.sections(run.last_revolution(), column)).mean);
  return out;
}

Answer mesh_trend(const PaperReading& reading, const std::vector<double>& y, study::Trend trend,
                  const char* unit) {
  if (y.size() < 2) return {};
  const double sign = trend == study::Trend::rising ? 1.0 : -1.0;
  int good = 0;
  for (std::size_t k = 1; k < y.size(); ++k) good += sign * (y[k] - y[k - 1]) > 0.0;
  return ClaimAnswer{fmt::format("{} to {} {}", number(y.front()), number(y.back()), unit),
                     study::judge_trend(y, trend),
                     fmt::format("From {} to {} mm it {} in {} of {} steps.",
                                 number(1e3 * reading.mesh_sizes.front().mesh_size(), 2),
                                 number(1e3 * reading.mesh_sizes.back().mesh_size(), 2),
                                 trend == study::Trend::rising ? "grows" : "falls", good, y.size() - 1)};
}

Answer m01(const PublishedClaim&, const PaperRuns&, const PaperReading& r) {
  return mesh_trend(r, mesh_means(r, "depth_mm"), study::Trend::falling, "mm");
}
Answer m02(const PublishedClaim&, const PaperRuns&, const PaperReading& r) {
  return mesh_trend(r, mesh_means(r, kMeshWidth), study::Trend::rising, "mm");
}
Answer f08(const PublishedClaim&, const PaperRuns&, const PaperReading& r) {
  std::vector<double> depth = mesh_means(r, "depth_mm"), width = mesh_means(r, kMeshWidth);
  for (std::size_t k = 0; k < depth.size(); ++k) depth[k] /= width[k];
  return mesh_trend(r, depth, study::Trend::falling, "mm/mm");
}

// ---------------------------------------------------------------- force

Answer n01(const PublishedClaim& claim, const PaperRuns&, const PaperReading& r) {
  if (!r.revolutions) return {};
  std::vector<double> means;
  for (const double turn : r.revolutions->column("revolution"))
    means.push_back(analysis::summarise(r.revolutions->forces(turn, "normal_along_N")).mean);
  const auto [low, high] = std::ranges::minmax(means);
  const double theirs = claim.numbers.front();
  const double worst = std::abs(low - theirs) > std::abs(high - theirs) ? low : high;
  const bool same = fmt::format("{:.3f}", low) == fmt::format("{:.3f}", high);
  return ClaimAnswer{same ? fmt::format("{:.3f} N", low) : fmt::format("{:.3f} to {:.3f} N", low, high),
                     study::judge_value(theirs, worst, claim.tolerance),
                     fmt::format("The mean furthest from {} N is {} off, of about 500 samples: a pin that is "
                                 "free along its load carries it on "
                                 "average, whatever the contact rule.",
                                 number(theirs), percent_off(worst, theirs))};
}

Answer n02(const PublishedClaim& claim, const PaperRuns&, const PaperReading& r) {
  if (!r.revolutions) return {};
  const std::vector<double> turns = r.revolutions->column("revolution");
  std::size_t with = 0;
  double largest = 0.0;
  for (const double turn : turns) {
    const std::vector<double> forces = r.revolutions->forces(turn, "normal_along_N");
    const double mean = analysis::summarise(forces).mean;
    const auto outliers = analysis::tukey_outliers(forces);
    with += std::ranges::any_of(outliers,
                                [&](std::size_t k) { return forces[k] > (1.0 + claim.tolerance) * mean; });
    if (!forces.empty()) largest = std::max(largest, std::ranges::max(forces));
  }
  return ClaimAnswer{
      fmt::format("in {} of {} revolutions; largest {} N", with, turns.size(), number(largest)),
      with == turns.size() ? Verdict::reproduced
      : with > 0           ? Verdict::trend_only
                           : Verdict::not_reproduced,
      with > 0 ? "High: a fifth above the mean and beyond 1.5 quartile ranges. Each triangle has a damper of "
                 "its own, so the paper's time step is at the limit of "
                 "stability and the pin chatters (decision 014)."
               : "One patch has one damper whatever the mesh: the force is steady, and the outliers are "
                 "not physics but the rule of contact (decision 014)."};
}

// ---------------------------------------------------------------- depth and width over the sections

std::vector<double> at_profiles(const FinishedRun& run, double revolution, std::string_view column) {
  std::vector<double> angles;
  const auto &turns = run.profiles["revolution"], &all = run.profiles["angle_deg"];
  for (std::size_t k = 0; k < all.size(); ++k)
    if (std::abs(turns[k] - revolution) < 1e-3 && (angles.empty() || angles.back() != all[k]))
      angles.push_back(all[k]);
  const std::vector<double> values = run.sections(revolution, column),
                            places = run.sections(revolution, "angle_deg");
  std::vector<double> out;
  for (std::size_t k = 0; k < values.size(); ++k)
    if (std::ranges::any_of(angles, [&](double a) { return std::abs(a - places[k]) < 1e-6; }))
      out.push_back(values[k]);
  return out;
}

enum class Part { all, majority, profiles };

Answer spread(const PublishedClaim& claim, const PaperReading& r, std::string_view column, Part part) {
  if (!r.revolutions) return {};
  const double last = r.revolutions->last_revolution();
  std::vector<double> values = part == Part::profiles ? at_profiles(*r.revolutions, last, column)
                                                      : r.revolutions->sections(last, column);
  if (values.empty()) return {};
  std::ranges::sort(values);
  const double outside = part == Part::majority ? 0.1 : 0.0;
  const Interval ours{analysis::quantile(values, outside), analysis::quantile(values, 1.0 - outside)};
  const Interval theirs = interval_of(claim);
  const bool depth = column == "depth_mm";
  const double middle = analysis::quantile(values, 0.5);
  std::string why =
      fmt::format("The range is {} mm wide, theirs {}; its middle is {} from the middle of theirs.",
                  number(ours.high - ours.low, 2), number(theirs.high - theirs.low, 2),
                  percent_off(middle, 0.5 * (theirs.low + theirs.high)));
  const Verdict verdict = study::judge_range(theirs, ours, claim.tolerance);
  if (verdict != Verdict::reproduced && depth)
    why += r.conserving
               ? " Conserving, the mesh loses a sixth of what eq. 9 takes."
               : " A pin that can only move up and down chatters less than theirs seems to have done.";
  return ClaimAnswer{range_text(ours, "mm"), verdict, why};
}

Answer d01(const PublishedClaim& c, const PaperRuns&, const PaperReading& r) {
  return spread(c, r, "depth_mm", Part::all);
}
Answer d02(const PublishedClaim& c, const PaperRuns&, const PaperReading& r) {
  return spread(c, r, "depth_mm", Part::majority);
}
Answer d03(const PublishedClaim& c, const PaperRuns&, const PaperReading& r) {
  return spread(c, r, "depth_mm", Part::profiles);
}
Answer w01(const PublishedClaim& c, const PaperRuns&, const PaperReading& r) {
  return spread(c, r, r.width_column, Part::all);
}
Answer w02(const PublishedClaim& c, const PaperRuns&, const PaperReading& r) {
  return spread(c, r, r.width_column, Part::majority);
}
Answer w03(const PublishedClaim& c, const PaperRuns&, const PaperReading& r) {
  return spread(c, r, r.width_column, Part::profiles);
}

Answer growth(const PublishedClaim& claim, const PaperReading& r, std::string_view column,
              study::Growth kind) {
  if (!r.revolutions || r.revolutions->revolutions.rows() < 3) return {};
  const std::vector<double> turns = r.revolutions->column("revolution");
  std::vector<double> means;
  for (const double turn : turns)
    means.push_back(analysis::summarise(r.revolutions->sections(turn, column)).mean);
  const double p = study::growth_exponent(turns, means);
  return ClaimAnswer{
      fmt::format("grows as n^{:.2f}", p), study::judge_growth(p, kind, claim.tolerance),
      kind == study::Growth::linear
          ? fmt::format(
                "Linear would be n^1 within {}; a groove that gets wider as it gets deeper slows down, a "
                "rigid sphere's depth grows as n^0.67.",
                claim.tolerance)
          : "A rigid sphere's width grows as n^0.33."};
}
Answer d04(const PublishedClaim& c, const PaperRuns&, const PaperReading& r) {
  return growth(c, r, "depth_mm", study::Growth::linear);
}
Answer w04(const PublishedClaim& c, const PaperRuns&, const PaperReading& r) {
  return growth(c, r, r.width_column, study::Growth::slowing);
}

/// Revolutions from the first on in which the largest value is an outlier.
Answer leading_outliers(const PublishedClaim& claim, const PaperReading& r, std::string_view column) {
  if (!r.revolutions) return {};
  int leading = 0, any = 0, turn_number = 0;
  for (const double turn : r.revolutions->column("revolution")) {
    const std::vector<double> values = r.revolutions->sections(turn, column);
    const auto outliers = analysis::tukey_outliers(values);
    const double largest = values.empty() ? 0.0 : std::ranges::max(values);
    const bool high = std::ranges::any_of(outliers, [&](std::size_t k) { return values[k] == largest; });
    if (high && leading == turn_number) ++leading;
    any += high;
    ++turn_number;
  }
  return ClaimAnswer{
      fmt::format("in the first {} revolutions; in {} of {} in all", leading, any, turn_number),
      leading == static_cast<int>(claim.numbers.front()) ? Verdict::reproduced
      : leading > 0                                      ? Verdict::trend_only
                                                         : Verdict::not_reproduced,
      "The paper explains them by the first indentation; set down gently at its load the pin makes none, and "
      "what there is comes from the mesh."};
}
Answer o01(const PublishedClaim& c, const PaperRuns&, const PaperReading& r) {
  return leading_outliers(c, r, "depth_mm");
}
Answer o02(const PublishedClaim& c, const PaperRuns&, const PaperReading& r) {
  return leading_outliers(c, r, r.width_column);
}

// ---------------------------------------------------------------- normality

Answer p_values(const PublishedClaim& claim, const PaperReading& r, std::string_view column) {
  if (!r.revolutions) return {};
  const std::vector<double> p = r.revolutions->normality(column, r.binning);
  if (p.size() != claim.numbers.size()) return {};
  int same = 0;
  std::string normal;
  for (std::size_t k = 0; k < p.size(); ++k) {
    same += !std::isnan(p[k]) && (p[k] > kLevel) == (claim.numbers[k] > kLevel);
    if (p[k] > kLevel) normal += fmt::format("{}R{}", normal.empty() ? "" : ", ", k + 1);
  }
  return ClaimAnswer{
      normal.empty() ? "p > 5 % in no revolution" : "p > 5 % in " + normal,
      study::judge_p_values(claim.numbers, p, kLevel),
      fmt::format(
          "{} of {} fall on the same side of 5 %; neighbouring sections share a contact, which the test "
          "does not know, and its bins are not stated.",
          same, p.size())};
}
Answer p01(const PublishedClaim& c, const PaperRuns&, const PaperReading& r) {
  return p_values(c, r, "depth_mm");
}
Answer p02(const PublishedClaim& c, const PaperRuns&, const PaperReading& r) {
  return p_values(c, r, r.width_column);
}

/// The revolution from which depth and width are normal; NaN where there is none.
double normal_from(const PaperReading& r) {
  const FinishedRun& run = *r.revolutions;
  const analysis::NormalFrom found =
      analysis::normal_from(run.column("revolution"), run.normality("depth_mm", r.binning),
                            run.normality(r.width_column, r.binning), kLevel);
  return found.revolution.value_or(kNaN);
}

Answer run_in(const PublishedClaim& claim, const PaperReading& r, double ours) {
  if (!r.revolutions) return {};
  const bool found = std::isfinite(ours);
  return ClaimAnswer{
      found ? number(ours, 4) : fmt::format("none in {:.6g} revolutions", r.revolutions->last_revolution()),
      study::judge_value(claim.numbers.front(), ours, claim.tolerance),
      found
          ? "From the same rule: depth and width pass the chi-squared test from there to the last revolution."
          : "By the same rule there is no revolution from which depth and width pass the test to the end: "
            "the "
            "rule is not a property of the wear."};
}
Answer p03(const PublishedClaim& c, const PaperRuns&, const PaperReading& r) {
  return run_in(c, r, r.revolutions ? normal_from(r) - 1.0 : kNaN);
}
Answer c07(const PublishedClaim& c, const PaperRuns&, const PaperReading& r) {
  return run_in(c, r, r.revolutions ? normal_from(r) : kNaN);
}
Answer c06(const PublishedClaim& c, const PaperRuns& runs, const PaperReading& r) {
  return run_in(c, r, r.revolutions ? runs.passes_test / normal_from(r) : kNaN);
}

// ---------------------------------------------------------------- volume

Answer volume_fit(const PublishedClaim& claim, const PaperRuns&, const PaperReading& r) {
  for (const study::PublishedFit& fit : study::published_fits()) {
    if (fmt::format("V{}", fit.equation) != claim.id) continue;
    const FinishedRun* run = r.with_coefficient(fit.wear_coefficient);
    if (run == nullptr || run->revolutions.rows() < 4) return {};
    const std::vector<double> n = run->column("revolution"), ours = run->column(r.volume_column);
    std::vector<double> theirs;
    for (const double x : n)
      theirs.push_back(claim.numbers[0] + x * (claim.numbers[1] + x * claim.numbers[2]));
    const Verdict verdict = study::judge_curve(n, theirs, ours, claim.tolerance);
    std::string why =
        fmt::format("{} after revolution {:.6g}, {} after {:.6g}.", percent_off(ours.front(), theirs.front()),
                    n.front(), percent_off(ours.back(), theirs.back()), n.back());
    if (!r.conserving && r.revolutions &&
        std::abs(r.revolutions->wear_coefficient() / fit.wear_coefficient - 1.0) < 1e-6)
      why += fmt::format(" Integrated in time, with the chatter of the paper's step: {} mm³ after {:.6g}.",
                         number(r.revolutions->column(r.volume_column).back()),
                         r.revolutions->last_revolution());
    if (verdict != Verdict::reproduced)
      why += r.conserving ? " Archard's law at this coefficient removes α F L, in proportion to n; theirs is "
                            "more and grows "
                            "(decision 013)."
                          : " The tally of eq. 10-12 does not grow with n as theirs does; no rule with a "
                            "converged time step "
                            "was found that does (decision 013).";
    return ClaimAnswer{fmt::format("{} after {:.6g}, {} mm³ after {:.6g} rev", number(ours.front()),
                                   n.front(), number(ours.back()), n.back()),
                       verdict, why};
  }
  return {};
}

/// The coefficient whose run has the measured volume after n revolutions, between the runs that there are; a
/// conserving volume is proportional to it. NaN beyond the largest.
double coefficient_for(const PaperRuns& runs, const PaperReading& r, double n) {
  std::vector<double> coefficients, volumes;
  for (const FinishedRun& run : r.coefficients) {
    const double v = run.at(n, r.volume_column);
    if (!std::isfinite(v)) continue;
    coefficients.push_back(run.wear_coefficient());
    volumes.push_back(v);
  }
  if (coefficients.empty()) return kNaN;
  const double found = study::passes(coefficients, volumes, target(runs));
  return std::isfinite(found) || !r.conserving ? found : coefficients.back() * target(runs) / volumes.back();
}

Answer coefficient(const PublishedClaim& claim, const PaperRuns& runs, const PaperReading& r, double n) {
  if (r.coefficients.empty() || !std::isfinite(r.coefficients.back().at(n, r.volume_column))) return {};
  const double ours = coefficient_for(runs, r, n);
  return ClaimAnswer{std::isfinite(ours) ? readable(ours, 3) + " 1/Pa"
                                         : fmt::format("more than {} 1/Pa",
                                                       readable(r.coefficients.back().wear_coefficient(), 2)),
                     study::judge_value(claim.numbers.front(), ours, claim.tolerance),
                     fmt::format("The coefficient that wears the measured {} mm³ in {:.0f} revolutions{}.",
                                 number(target(runs)), n,
                                 r.conserving ? ": V = α F L, so α n is what counts (decision 007)"
                                              : ", between the runs; the volume is the tally of eq. 10-12")};
}
Answer c01(const PublishedClaim& c, const PaperRuns& runs, const PaperReading& r) {
  return coefficient(c, runs, r, kModelledRevolutions);
}
Answer c03(const PublishedClaim& c, const PaperRuns& runs, const PaperReading& r) {
  return coefficient(c, runs, r, kLeastRevolutions);
}

double revolutions_for(const FinishedRun& run, const PaperReading& r, double volume) {
  return study::passes(run.column("revolution"), run.column(r.volume_column), volume);
}
std::string revolutions_text(double n, const FinishedRun& run) {
  return std::isfinite(n) ? number(n) : fmt::format("more than {:.6g}", run.last_revolution());
}

Answer c04(const PublishedClaim& claim, const PaperRuns& runs, const PaperReading& r) {
  const FinishedRun* run = r.with_coefficient(1e-11);
  if (run == nullptr || run->last_revolution() < claim.numbers.front()) return {};
  const double n = revolutions_for(*run, r, target(runs));
  return ClaimAnswer{
      revolutions_text(n, *run),
      !std::isfinite(n) || n > claim.numbers.front() ? Verdict::reproduced : Verdict::not_reproduced,
      fmt::format("After {:.6g} revolutions {} of {} mm³ are gone.", run->last_revolution(),
                  number(run->column(r.volume_column).back()), number(target(runs)))};
}

Answer c05(const PublishedClaim& claim, const PaperRuns& runs, const PaperReading& r) {
  const FinishedRun* run = r.with_coefficient(2e-11);
  if (run == nullptr) return {};
  const Interval band = target_band(runs);
  const Interval ours{revolutions_for(*run, r, band.low), revolutions_for(*run, r, band.high)};
  return ClaimAnswer{
      std::isfinite(ours.low) ? fmt::format("{} to {}", number(ours.low), revolutions_text(ours.high, *run))
                              : revolutions_text(kNaN, *run),
      study::judge_range(interval_of(claim), ours, claim.tolerance),
      fmt::format("After {:.6g} revolutions {} mm³ are gone; the measured band is {} to {} mm³.",
                  run->last_revolution(), number(run->column(r.volume_column).back()), number(band.low),
                  number(band.high))};
}

Answer f16(const PublishedClaim& claim, const PaperRuns&, const PaperReading& r) {
  if (r.coefficients.empty()) return {};
  const FinishedRun& run = r.coefficients.back();
  if (run.last_revolution() < 10.0) return {};
  const auto mean = [&](double turn) { return analysis::summarise(run.forces(turn, "normal_sum_N")).mean; };
  const double ours = mean(10.0) / mean(1.0);
  return ClaimAnswer{
      fmt::format("{:.3f}", ours), study::judge_value(claim.numbers.front(), ours, claim.tolerance),
      "Growth of the sum of the contacts' normal forces: the flanks tilt them by a few degrees, so the "
      "horizontal part cannot carry the growth that Fig. 16 ascribes to it."};
}

// ---------------------------------------------------------------- against the test

/// The run that stands for the test: the paper's coefficient by its rules, the calibrated one (soft pin) by
/// ours.
const FinishedRun* against_test(const PaperRuns& runs, const PaperReading& r) {
  if (r.conserving) return runs.calibrated.empty() ? nullptr : &runs.calibrated.front();
  return r.with_coefficient(kPublishedCoefficient);
}

struct Groove {
  double depth, width, volume;
};
Groove groove(const FinishedRun& run, const PaperReading& r) {
  const double last = run.last_revolution();
  return {analysis::summarise(run.sections(last, "depth_mm")).mean,
          analysis::summarise(run.sections(last, r.width_column)).mean, run.at(last, r.volume_column)};
}

Answer table4_value(const PublishedClaim& claim, const PaperReading& r, double Groove::*member,
                    const char* unit, const char* reason_paper, const char* reason_conserving) {
  const FinishedRun* run = r.with_coefficient(kPublishedCoefficient);
  if (run == nullptr || claim.numbers.size() < 2) return {};
  const double ours = groove(*run, r).*member, test = claim.numbers[0], theirs = claim.numbers[1];
  const Verdict verdict = study::judge_value(theirs, ours, claim.tolerance);
  std::string why = fmt::format("{} from theirs.", percent_off(ours, theirs));
  if (verdict != Verdict::reproduced)
    why += fmt::format(" {}", r.conserving ? reason_conserving : reason_paper);
  return ClaimAnswer{fmt::format("{} {}, {} from the test", number(ours), unit, percent_off(ours, test)),
                     verdict, why};
}
Answer t01(const PublishedClaim& c, const PaperRuns&, const PaperReading& r) {
  return table4_value(
      c, r, &Groove::depth, "mm", "Eq. 9 with a pin that does not chatter is shallower.",
      "Conserving, this coefficient wears a quarter of the measured volume in 12 revolutions.");
}
Answer t02(const PublishedClaim& c, const PaperRuns&, const PaperReading& r) {
  return table4_value(c, r, &Groove::width, "mm",
                      "The width is set by the softened pin and the element size (decision 012).",
                      "The width is set by the softened pin (decision 012).");
}
Answer t03(const PublishedClaim& c, const PaperRuns&, const PaperReading& r) {
  return table4_value(c, r, &Groove::volume, "mm³",
                      "The tally of eq. 10-12 grows less with n than theirs (decision 013).",
                      "V = α F L is 0.141 mm³ here (decision 013).");
}

Answer f18(const PublishedClaim& claim, const PaperRuns& runs, const PaperReading& r) {
  const FinishedRun* run = against_test(runs, r);
  if (run == nullptr || claim.numbers.size() < 2) return {};
  const Groove g = groove(*run, r);
  const bool deeper = g.depth > claim.numbers[0], wider = g.width > claim.numbers[1];
  return ClaimAnswer{fmt::format("{} mm, {} mm", number(g.depth), number(g.width)),
                     deeper && wider   ? Verdict::reproduced
                     : deeper || wider ? Verdict::trend_only
                                       : Verdict::not_reproduced,
                     fmt::format("The mean contour is {} and {} than the largest measured.",
                                 deeper ? "deeper" : "shallower", wider ? "wider" : "narrower")};
}

Answer measured(const PublishedClaim& claim, const PaperRuns& runs, const PaperReading& r,
                double Groove::*member, const char* unit, const char* explanation) {
  const FinishedRun* run = against_test(runs, r);
  if (run == nullptr) return {};
  const double ours = groove(*run, r).*member;
  const Interval theirs = interval_of(claim);
  std::string text = fmt::format("{} {}", number(ours), unit);
  const Verdict verdict = study::judge_inside(theirs, ours);
  std::string why = verdict == Verdict::reproduced ? "Inside the measured range."
                    : ours < theirs.low            ? percent_off(ours, theirs.low) + " from its lower end."
                                                   : percent_off(ours, theirs.high) + " from its upper end.";
  if (r.conserving && runs.calibrated.size() > 1) {
    const double stiff = groove(runs.calibrated.back(), r).*member;
    text += fmt::format(" (stiff pin: {})", number(stiff));
    why += fmt::format(" A realistic, stiff pin gives {} {}, {} the range.", number(stiff), unit,
                       study::judge_inside(theirs, stiff) == Verdict::reproduced ? "inside" : "outside");
  }
  if (verdict != Verdict::reproduced || r.conserving) why += fmt::format(" {}", explanation);
  return ClaimAnswer{text, verdict, why};
}
Answer e01(const PublishedClaim& c, const PaperRuns& runs, const PaperReading& r) {
  return measured(c, runs, r, &Groove::depth, "mm", "The softened pin makes the groove shallow and wide.");
}
Answer e02(const PublishedClaim& c, const PaperRuns& runs, const PaperReading& r) {
  return measured(c, runs, r, &Groove::width, "mm",
                  "The softened pin is wide by its own contact; the real one was flattened by its wear.");
}
Answer e03(const PublishedClaim& c, const PaperRuns& runs, const PaperReading& r) {
  return measured(
      c, runs, r, &Groove::volume, "mm³",
      r.conserving ? "The coefficient was chosen for this volume." : "Their coefficient with their rules.");
}
Answer e04(const PublishedClaim& claim, const PaperRuns& runs, const PaperReading& r) {
  const double ours =
      coefficient_for(runs, r, kModelledRevolutions) * kModelledRevolutions / runs.passes_test;
  if (r.coefficients.empty()) return {};
  return ClaimAnswer{
      std::isfinite(ours) ? readable(ours, 3) + " 1/Pa" : "–", study::judge_inside(interval_of(claim), ours),
      fmt::format("α n of the runs that wear the measured volume, over the test's {:.6g} revolutions.{}",
                  runs.passes_test,
                  r.conserving ? " It is the measured volume over load and sliding distance."
                               : " Eq. 9 needs less for more groove.")};
}

Answer f17(const PublishedClaim& claim, const PaperRuns&, const PaperReading& r) {
  const FinishedRun* run = r.profile ? &*r.profile : nullptr;
  if (run == nullptr) return {};
  const double last = run->last_revolution();
  const std::vector<double> depth = run->sections(last, "depth_mm"), angle = run->sections(last, "angle_deg");
  std::vector<double> spots;
  const double median = analysis::summarise(depth).median;
  for (const std::size_t k : analysis::tukey_outliers(depth))
    if (depth[k] > median) spots.push_back(angle[k]);
  const Interval theirs = interval_of(claim);
  const auto within = [&](double from, double to) {
    return std::ranges::count_if(spots, [&](double a) { return (a >= from && a <= to) || a + 360.0 <= to; });
  };
  std::ptrdiff_t best = 0;
  for (const double from : spots) best = std::max(best, within(from, from + theirs.high - theirs.low));
  constexpr std::size_t kSeveral = 3;
  const std::ptrdiff_t half = (std::ssize(spots) + 1) / 2;
  const Verdict verdict = spots.size() < kSeveral                   ? Verdict::not_reproduced
                          : within(theirs.low, theirs.high) >= half ? Verdict::reproduced
                          : best >= half                            ? Verdict::trend_only
                                                                    : Verdict::not_reproduced;
  const auto deepest = std::ranges::max_element(depth) - depth.begin();
  return ClaimAnswer{spots.empty() ? "no spots"
                                   : fmt::format("{} outliers; deepest at {:.0f}°", spots.size(),
                                                 angle[static_cast<std::size_t>(deepest)]),
                     verdict,
                     "Where spots lie is a matter of the unstructured mesh, and the paper's is not known. "
                     "Reproduced: half of "
                     "three or more in its sector; trend only: half of them in any sector of that size."};
}

// ---------------------------------------------------------------- all of them

using Measure = Answer (*)(const PublishedClaim&, const PaperRuns&, const PaperReading&);
struct Entry {
  std::string_view id;
  std::string_view rule;  ///< by which the measure judges; the file must say the same
  std::size_t numbers;    ///< that the claim must state at least
  Measure measure;
};
constexpr Entry kMeasures[] = {
    {"E01", "inside", 2, e01},       {"E02", "inside", 2, e02},       {"E03", "inside", 2, e03},
    {"E04", "inside", 2, e04},       {"M01", "falling", 0, m01},      {"M02", "rising", 0, m02},
    {"N01", "value", 1, n01},        {"N02", "outliers", 0, n02},     {"D01", "range", 2, d01},
    {"D02", "range", 2, d02},        {"W01", "range", 2, w01},        {"W02", "range", 2, w02},
    {"D03", "range", 2, d03},        {"W03", "range", 2, w03},        {"D04", "linear", 0, d04},
    {"W04", "slowing", 0, w04},      {"O01", "count", 1, o01},        {"O02", "count", 1, o02},
    {"P01", "p_values", 1, p01},     {"P02", "p_values", 1, p02},     {"P03", "count", 1, p03},
    {"V13", "curve", 4, volume_fit}, {"V14", "curve", 4, volume_fit}, {"V15", "curve", 4, volume_fit},
    {"V16", "curve", 4, volume_fit}, {"V17", "curve", 4, volume_fit}, {"C01", "value", 1, c01},
    {"C03", "value", 1, c03},        {"C04", "at_least", 1, c04},     {"C05", "range", 2, c05},
    {"C06", "value", 1, c06},        {"C07", "count", 1, c07},        {"T01", "value", 2, t01},
    {"T02", "value", 2, t02},        {"T03", "value", 2, t03},        {"F08", "falling", 0, f08},
    {"F16", "value", 1, f16},        {"F17", "sector", 2, f17},       {"F18", "above", 2, f18}};

}  // namespace

std::vector<JudgedClaim> judge_claims(const PaperRuns& runs) {
  std::vector<JudgedClaim> judged;
  for (const PublishedClaim& claim : runs.published.claims) {
    const auto entry = std::ranges::find(kMeasures, claim.id, &Entry::id);
    if (entry == std::end(kMeasures)) continue;
    if (claim.rule != entry->rule || claim.numbers.size() < entry->numbers)
      throw IoError(
          fmt::format("{}: claim '{}' has the rule '{}' and {} numbers; it is judged by '{}' with {} or more",
                      runs.setup.study->published, claim.id, claim.rule, claim.numbers.size(), entry->rule,
                      entry->numbers));
    JudgedClaim out{&claim, {}};
    for (std::size_t r = 0; r < runs.readings.size(); ++r)
      out.answers[r] = entry->measure(claim, runs, runs.readings[r]);
    judged.push_back(std::move(out));
  }
  return judged;
}

std::string verdict_text(study::Verdict verdict) {
  return verdict == Verdict::reproduced   ? "reproduced"
         : verdict == Verdict::trend_only ? "trend only"
                                          : "not reproduced";
}

}  // namespace abradem::report
