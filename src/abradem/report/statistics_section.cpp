// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/report/statistics_section.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "abradem/analysis/groove_statistics.h"
#include "abradem/analysis/regression.h"
#include "abradem/analysis/run_in.h"
#include "abradem/core/error.h"
#include "abradem/report/text.h"

namespace abradem::report {
namespace {

using analysis::Normality;
using analysis::RunIn;
using analysis::SectionStatistics;

constexpr std::size_t kOutputs = 60, kRows = 12;  // looked at; in the table
constexpr double kLevel = 0.05;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::string number(double x, int digits = 3) {
  return std::isfinite(x) ? fmt::format("{:.{}g}", x, digits) : "–";
}

/// At most `most` of n, evenly spread, with the first and the last.
std::vector<std::size_t> spread(std::size_t n, std::size_t most) {
  std::vector<std::size_t> out;
  const std::size_t kept = std::min(n, most);
  for (std::size_t i = 0; i < kept; ++i) out.push_back(kept < 2 ? n - 1 : i * (n - 1) / (kept - 1));
  return out;
}

GrooveSeries thinned_series(const GrooveSeries& s) {
  if (s.revolutions.size() <= kOutputs) return s;
  GrooveSeries out;
  out.counted = s.counted;
  out.ends = s.ends;
  out.track_radius_mm = s.track_radius_mm;
  for (const GrooveSeries::Grown& g : s.grown) out.grown.push_back({g.name, g.unit, {}});
  for (const std::size_t i : spread(s.revolutions.size(), kOutputs)) {
    out.revolutions.push_back(s.revolutions[i]);
    out.depths_mm.push_back(s.depths_mm[i]);
    out.widths_mm.push_back(s.widths_mm[i]);
    for (std::size_t g = 0; g < s.grown.size(); ++g) out.grown[g].values.push_back(s.grown[g].values[i]);
  }
  return out;
}

bool ascends(const std::vector<double>& n) {
  for (std::size_t i = 0; i < n.size(); ++i)
    if (!(n[i] > (i == 0 ? 0.0 : n[i - 1]))) return false;
  return true;
}

/// dV/dn from output to output.
std::vector<double> rates(const std::vector<double>& n, const std::vector<double>& sums) {
  std::vector<double> out;
  for (std::size_t i = 0; i < n.size(); ++i)
    out.push_back((sums[i] - (i == 0 ? 0.0 : sums[i - 1])) / (n[i] - (i == 0 ? 0.0 : n[i - 1])));
  return out;
}

/// A series whose run-in is sought.
struct Watched {
  std::string name, unit;
  RunIn run_in;
};

struct Fit {
  std::string name, unit;
  analysis::IncrementFit law;
  double cumulative_r_squared = kNan;
};

/// Everything computed once.
class Statistics {
 public:
  explicit Statistics(const GrooveSeries& all) : s(thinned_series(all)), outputs(all.revolutions.size()) {
    for (std::size_t i = 0; i < s.revolutions.size(); ++i) {
      depth.push_back(analysis::section_statistics(s.depths_mm[i], s.ends));
      width.push_back(analysis::section_statistics(s.widths_mm[i], s.ends));
    }
    find_normal();
    if (!ascends(s.revolutions)) return;
    find_run_ins();
    fit();
  }

  GrooveSeries s;
  std::size_t outputs;
  std::vector<SectionStatistics> depth, width;
  analysis::NormalFrom normal;
  std::optional<analysis::NormalFromByBins> by_bins;
  std::vector<Watched> watched;
  std::vector<Fit> fits;  ///< degrees 1 and 2 of each grown quantity

 private:
  void find_normal() {
    std::vector<double> depth_p, width_p;
    std::size_t fewest_sections = depth.empty() ? 0 : s.depths_mm.front().size();
    for (std::size_t i = 0; i < depth.size(); ++i) {
      depth_p.push_back(depth[i].normality.all.equiprobable.p);
      width_p.push_back(width[i].normality.all.equiprobable.p);
      fewest_sections = std::min(fewest_sections, s.depths_mm[i].size());
    }
    normal = analysis::normal_from(s.revolutions, depth_p, width_p, kLevel);
    const int most = static_cast<int>(fewest_sections / 5);  // five values expected in each
    if (most >= 5)
      by_bins = analysis::normal_from_by_bins(s.revolutions, s.depths_mm, s.widths_mm,
                                              analysis::Binning::equiprobable, 5, most, kLevel);
  }

  void watch(std::string name, std::string unit, const std::vector<double>& values) {
    if (std::ranges::all_of(values, [](double x) { return std::isfinite(x); }))
      watched.push_back({std::move(name), std::move(unit), analysis::find_run_in(s.revolutions, values)});
  }

  void find_run_ins() {
    for (const GrooveSeries::Grown& g : s.grown)
      watch(fmt::format("{} per {}", g.name, s.counted), g.unit, rates(s.revolutions, g.values));
    const auto scatter = [&](const char* name, const std::vector<SectionStatistics>& of) {
      std::vector<double> values;
      for (const SectionStatistics& one : of) values.push_back(one.summary.sd / one.summary.mean);
      watch(name, "-", values);
    };
    scatter("scatter of depth, sd/mean", depth);
    scatter("scatter of width, sd/mean", width);
  }

  void fit() {
    const std::vector<double>& n = s.revolutions;
    for (const GrooveSeries::Grown& g : s.grown) {
      if (!std::ranges::all_of(g.values, [](double x) { return std::isfinite(x); })) continue;
      for (const int degree : {1, 2}) {
        if (n.size() < static_cast<std::size_t>(degree) + 2) continue;
        fits.push_back({g.name, g.unit, analysis::fit_increments(n, g.values, degree),
                        analysis::fit_polynomial(n, g.values, {.degree = degree}).r_squared});
      }
    }
  }
};

// --- words -----------------------------------------------------------------------------------------------
std::string verdicts(const Normality& n) {
  std::string text;
  const auto add = [&](const char* name, double p) {
    text += fmt::format("{}{} p = {}", text.empty() ? "" : ", ", name, readable_p(p));
  };
  add("chi-squared", n.equiprobable.p);
  add("Anderson-Darling", n.anderson_darling.p);
  add("Shapiro-Wilk", n.shapiro_wilk.p);
  return text;
}

std::string normality_sentence(const Statistics& a, const char* what, const SectionStatistics& last) {
  const analysis::Correlation& c = last.normality.correlation;
  const std::string head = fmt::format("{} after {} {}s, {} sections", what,
                                       number(a.s.revolutions.back(), 6), a.s.counted, last.summary.count);
  if (c.r.empty()) return fmt::format("{}: no scatter beyond round-off, so there is nothing to test.", head);
  std::string text = fmt::format("{}: {}.", head, verdicts(last.normality.all));
  if (c.independent_step == 0) return text + " No distance makes the sections independent.";
  if (c.independent_step == 1)
    text += " Neighbouring sections are not correlated, so all count.";
  else
    text += fmt::format(
        " Sections know of each other over {} of them{}; of the {} that are {} apart: {}.", number(c.length),
        std::isfinite(a.s.track_radius_mm)
            ? fmt::format(" ({} mm along the track)",
                          number(analysis::along_track(c.length, last.summary.count, a.s.track_radius_mm)))
            : "",
        last.normality.independent.count, c.independent_step, verdicts(last.normality.independent));
  if (std::isfinite(last.equiprobable.share_passing))
    text += fmt::format(
        " With {} to {} equiprobable bins in place of {}, {:.0f} % of the chi-squared tests find nothing (p "
        "from {} to "
        "{}); with equal-width bins, {:.0f} %.",
        last.equiprobable.bins.front(), last.equiprobable.bins.back(), last.normality.all.equiprobable.bins,
        100.0 * last.equiprobable.share_passing, readable_p(last.equiprobable.p_min),
        readable_p(last.equiprobable.p_max), 100.0 * last.equal_width.share_passing);
  return text;
}

std::string rule_sentence(const Statistics& a) {
  const auto no_verdict = [](const SectionStatistics& one) {
    return std::isnan(one.normality.all.equiprobable.p);
  };
  if (std::ranges::all_of(a.depth, no_verdict) || std::ranges::all_of(a.width, no_verdict))
    return "The rule of the paper, steady from where on every p of depth and width exceeds 0.05, cannot be "
           "applied: the "
           "chi-squared test needs 20 sections that scatter.";
  std::string text = "The rule of the paper, steady from where on every p of depth and width exceeds 0.05, ";
  if (a.normal.revolution)
    text += fmt::format("is met from {} {} on, {} output{} to the end.", a.s.counted,
                        number(*a.normal.revolution, 6), a.normal.lasting, a.normal.lasting == 1 ? "" : "s");
  else
    text += "is not met.";
  if (a.by_bins) {
    double low = INFINITY, high = 0.0;
    for (const analysis::NormalFrom& f : a.by_bins->found)
      if (f.revolution) low = std::min(low, *f.revolution), high = std::max(high, *f.revolution);
    text += fmt::format(" With {} to {} bins it is met for {:.0f} % of the numbers of bins",
                        a.by_bins->bins.front(), a.by_bins->bins.back(), 100.0 * a.by_bins->share_found);
    if (high > 0.0)
      text += fmt::format(", from {} {} to {} on", a.s.counted, number(low, 6), number(high, 6));
    text += ".";
  }
  return text + " That tests find nothing is no evidence of a steady state.";
}

std::string state(const RunIn& r) {
  switch (r.state) {
    case RunIn::State::too_short:
      return "too few outputs";
    case RunIn::State::from_start:
      return "no run-in seen";
    case RunIn::State::found:
      return "run-in, then steady";
    case RunIn::State::not_steady:
      break;
  }
  return "not steady yet";
}

std::string run_in_sentence(const Statistics& a, const Watched& w) {
  const RunIn& r = w.run_in;
  switch (r.state) {
    case RunIn::State::too_short:
      return fmt::format("{}: {} outputs are too few to look for a run-in (7 are needed).", w.name,
                         a.s.revolutions.size());
    case RunIn::State::from_start:
      if (r.p <= kLevel)
        return fmt::format("{}: steady from the start at {} [{}]; it changes (p = {}), but by less than 1 %.",
                           w.name, number(r.level), w.unit, readable_p(r.p));
      return fmt::format("{}: nothing distinguishes it from a level, {} [{}] ({}), from the start (p = {}).",
                         w.name, number(r.level), w.unit,
                         fmt::format("{} to {}", number(r.level_low), number(r.level_high)), readable_p(r.p));
    case RunIn::State::found:
      return fmt::format(
          "{}: runs in until {} {} (95 % interval {} to {}; p = {}), then steady at {} [{}] ({} to {}).",
          w.name, a.s.counted, number(r.revolution, 6), number(r.low, 6), number(r.high, 6), readable_p(r.p),
          number(r.level), w.unit, number(r.level_low), number(r.level_high));
    case RunIn::State::not_steady:
      break;
  }
  return fmt::format("{}: changes (p = {}), and no part at its end is shown to be steady.", w.name,
                     readable_p(r.p));
}

std::string fit_sentence(const Statistics& a, const Fit& fit) {
  const auto& law = fit.law;
  const double at = law.coefficients.back(), low = law.low.back(), high = law.high.back();
  if (law.degree == 1)
    return fmt::format("The {} grows by {} {} per {} ({} to {}), by its increments.", fit.name, number(at, 5),
                       fit.unit, a.s.counted, number(low, 6), number(high, 6));
  const bool bends = !(low <= 0.0 && high >= 0.0);
  const double change = (law.rate(a.s.revolutions.back()) - law.rate(0.0)) / law.rate(0.0);
  return fmt::format(
      "Its growth {} (b2 = {} {} per {} squared, {} to {}: its rate changes by {:.2g} % to the end).",
      bends ? "bends" : "shows no bend", number(at), fit.unit, a.s.counted, number(low), number(high),
      100.0 * change);
}

// --- tables ----------------------------------------------------------------------------------------------
DataTable normality_table(const Statistics& a, const std::string& id) {
  DataTable t{.id = id + "-normality", .title = "Tests of normality"};
  t.caption = fmt::format(
      "p-values; below 0.05 a test speaks against a normal distribution. χ²: equiprobable bins, df = bins - "
      "3 (the true "
      "p lies between this one and that of df + 2); equal width: {} bins from the smallest to the largest, "
      "the tails "
      "pooled. Independent: of sections thinned until they are not correlated. Bins passing: share of the "
      "numbers of "
      "bins from 5 on, with 5 or more values each, for which χ² finds nothing.{}",
      analysis::kEqualWidthBins,
      a.s.revolutions.size() > kRows || a.outputs > a.s.revolutions.size()
          ? fmt::format(" {} of {} outputs.", std::min(kRows, a.s.revolutions.size()), a.outputs)
          : "");
  t.columns = {a.s.counted,
               "of",
               "sections",
               "mean [mm]",
               "sd [mm]",
               "outliers",
               "bins",
               "χ²",
               "χ², equal width",
               "Anderson-Darling",
               "Shapiro-Wilk",
               "correlation length [sections]",
               "independent sections",
               "independent: χ²",
               "independent: Anderson-Darling",
               "independent: Shapiro-Wilk",
               "bins passing [%]",
               "equal-width bins passing [%]"};
  for (const std::size_t i : spread(a.s.revolutions.size(), kRows))
    for (const auto& [what, of] : {std::pair{"depth", &a.depth[i]}, std::pair{"width", &a.width[i]}}) {
      const Normality &n = of->normality.all, &independent = of->normality.independent;
      t.rows.push_back({number(a.s.revolutions[i], 6), what, std::to_string(of->summary.count),
                        number(of->summary.mean, 4), number(of->summary.sd), std::to_string(of->outliers),
                        std::to_string(n.equiprobable.bins), readable_p(n.equiprobable.p),
                        readable_p(n.equal_width.p), readable_p(n.anderson_darling.p),
                        readable_p(n.shapiro_wilk.p), number(of->normality.correlation.length),
                        std::to_string(independent.count), readable_p(independent.equiprobable.p),
                        readable_p(independent.anderson_darling.p), readable_p(independent.shapiro_wilk.p),
                        number(100.0 * of->equiprobable.share_passing),
                        number(100.0 * of->equal_width.share_passing)});
    }
  return t;
}

DataTable run_in_table(const Statistics& a, const std::string& id) {
  DataTable t{
      .id = id + "-run-in",
      .title = "Run-in",
      .caption =
          "A ramp that passes into a level, against a level alone. p: share of shuffled series that a "
          "ramp fits as well; its interval by bootstrap. Drift: change per " +
          a.s.counted + " of the steady part, with its 95 % interval."};
  t.columns = {"of",
               "finding",
               "steady from " + a.s.counted,
               "95 % interval",
               "p",
               "level",
               "level, 95 % interval",
               "drift",
               "drift, 95 % interval"};
  for (const Watched& w : a.watched) {
    const RunIn& r = w.run_in;
    t.rows.push_back(
        {fmt::format("{} [{}]", w.name, w.unit), state(r), number(r.revolution, 6),
         std::isfinite(r.low) ? fmt::format("{} to {}", number(r.low, 6), number(r.high, 6)) : "–",
         readable_p(r.p), number(r.level, 4),
         std::isfinite(r.level) ? fmt::format("{} to {}", number(r.level_low, 4), number(r.level_high, 4))
                                : "–",
         number(r.drift, 2),
         std::isfinite(r.drift) ? fmt::format("{} to {}", number(r.drift_low, 2), number(r.drift_high, 2))
                                : "–"});
  }
  return t;
}

DataTable fit_table(const Statistics& a, const std::string& id) {
  DataTable t{
      .id = id + "-fits",
      .title = "Fits of the increments",
      .caption =
          "V(n) = b₁ n + b₂ n² by least squares (QR) of the increments, which are independent where the "
          "sums are not, with 95 % intervals. R² of the increments about their mean rate; beside it R² of "
          "a fit to the sums themselves, which is close to 1 whatever the law."};
  t.columns = {
      "of",      "law", "b₁", "b₁, 95 % interval", "b₂", "b₂, 95 % interval", "p (b₂ = 0)", "R², increments",
      "R², sums"};
  for (const Fit& f : a.fits) {
    const auto& law = f.law;
    const auto interval = [&](std::size_t j) {
      return fmt::format("{} to {}", number(law.low[j], 6), number(law.high[j], 6));
    };
    const bool quadratic = law.degree == 2;
    t.rows.push_back({fmt::format("{} [{}]", f.name, f.unit), quadratic ? "quadratic" : "linear",
                      number(law.coefficients[0], 5), interval(0),
                      quadratic ? number(law.coefficients[1], 4) : "–", quadratic ? interval(1) : "–",
                      quadratic ? readable_p(law.p[1]) : "–", number(law.r_squared, 4),
                      number(f.cumulative_r_squared, 8)});
  }
  return t;
}

// --- figures ---------------------------------------------------------------------------------------------
Figure p_figure(const Statistics& a, const std::string& id) {
  Figure figure{.id = id + "-p", .title = "Tests of normality against " + a.s.counted + "s", .columns = 2};
  figure.caption =
      "Solid: all sections; dashed: sections thinned to independent ones. The dotted line is p = 0.05; "
      "points below 10⁻⁶ are drawn there.";
  for (const bool depth : {true, false}) {
    const std::vector<SectionStatistics>* of = depth ? &a.depth : &a.width;
    Panel panel{.title = depth ? "Depth" : "Width",
                .x = {.title = a.s.counted + "s [-]"},
                .y = {.title = "p [-]", .log = true, .range = std::array{5e-7, 1.5}}};
    const auto add = [&](const char* name, int colour, bool independent, auto p_of) {
      Series s{.kind = Series::Kind::line_markers,
               .name = independent ? fmt::format("{}, independent", name) : name,
               .x = a.s.revolutions,
               .colour = colour};
      if (independent) s.dash = Series::Dash::dash;
      for (const SectionStatistics& one : *of)
        s.y.push_back(std::max(1e-6, p_of(independent ? one.normality.independent : one.normality.all)));
      for (std::size_t i = 0; i < of->size(); ++i)
        if (std::isnan(p_of(independent ? (*of)[i].normality.independent : (*of)[i].normality.all)))
          s.y[i] = kNan;
      panel.series.push_back(std::move(s));
    };
    for (const bool independent : {false, true}) {
      add("χ²", 0, independent, [](const Normality& n) { return n.equiprobable.p; });
      add("Anderson-Darling", 1, independent, [](const Normality& n) { return n.anderson_darling.p; });
      add("Shapiro-Wilk", 2, independent, [](const Normality& n) { return n.shapiro_wilk.p; });
    }
    Series level{.kind = Series::Kind::line,
                 .name = "p = 0.05",
                 .x = {a.s.revolutions.front(), a.s.revolutions.back()},
                 .y = {kLevel, kLevel},
                 .colour = 7};
    level.dash = Series::Dash::dot;
    panel.series.push_back(std::move(level));
    figure.panels.push_back(std::move(panel));
  }
  return figure;
}

Figure correlation_figure(const Statistics& a, const std::string& id) {
  Figure figure{.id = id + "-correlation", .title = "What a section knows of its neighbours"};
  const double at = a.s.revolutions.back();
  figure.caption = fmt::format(
      "Autocorrelation along the track{}. Grey: where independent sections lie 19 times in 20. The "
      "correlation length "
      "is where r falls to 1/e.",
      std::isfinite(at) ? fmt::format(" after {} {}s", number(at, 6), a.s.counted) : "");
  const bool in_mm = std::isfinite(a.s.track_radius_mm);
  Panel panel{.x = {.title = in_mm ? "distance along the track [mm]" : "distance [sections]"},
              .y = {.title = "autocorrelation r [-]"}};
  double last = 0.0, band = 0.0;
  const auto add = [&](const char* name, int colour, const SectionStatistics& of) {
    const analysis::Correlation& c = of.normality.correlation;
    Series s{.kind = Series::Kind::line_markers, .name = name, .colour = colour};
    const std::size_t shown = std::min<std::size_t>(c.r.size(), 41);
    for (std::size_t k = 0; k < shown; ++k) {
      s.x.push_back(in_mm
                        ? analysis::along_track(static_cast<double>(k), of.summary.count, a.s.track_radius_mm)
                        : static_cast<double>(k));
      s.y.push_back(c.r[k]);
    }
    if (s.x.empty()) return;
    last = std::max(last, s.x.back());
    band = c.noise_band;
    panel.series.push_back(std::move(s));
  };
  add("depth", 0, a.depth.back());
  add("width", 1, a.width.back());
  if (panel.series.empty()) return figure;
  Series noise{.kind = Series::Kind::band,
               .name = "independent sections",
               .x = {0.0, last},
               .y = {0.0, 0.0},
               .y_low = {-band, -band},
               .y_high = {band, band}};
  noise.theirs = true;
  panel.series.insert(panel.series.begin(), std::move(noise));
  figure.panels.push_back(std::move(panel));
  return figure;
}

/// The first grown quantity: its sums with the quadratic law, its rates with both.
Figure growth_figure(const Statistics& a, const std::string& id) {
  Figure figure{.id = id + "-growth", .columns = 2};
  if (a.fits.size() < 2 || a.fits[1].law.degree != 2) return figure;
  const GrooveSeries::Grown& g = a.s.grown.front();
  figure.title = "Growth of " + g.name;
  figure.caption =
      "Left: the law fitted to the increments with its 95 % confidence band. Right: the increments "
      "themselves, which show what the sums hide.";
  const analysis::IncrementFit& law = a.fits[1].law;
  Panel sums{.title = "Sums",
             .x = {.title = a.s.counted + "s [-]"},
             .y = {.title = fmt::format("{} [{}]", g.name, g.unit)}};
  Series band{.kind = Series::Kind::band, .name = "95 % confidence", .colour = 0},
      line{.name = "quadratic law", .colour = 0},
      outputs{
          .kind = Series::Kind::markers, .name = "outputs", .x = a.s.revolutions, .y = g.values, .colour = 1};
  Panel rate_panel{.title = "Increments",
                   .x = sums.x,
                   .y = {.title = fmt::format("{} per {} [{}]", g.name, a.s.counted, g.unit)}};
  Series straight{.name = "linear law", .colour = 2}, bent{.name = "quadratic law", .colour = 0},
      increments{.kind = Series::Kind::markers,
                 .name = "outputs",
                 .x = a.s.revolutions,
                 .y = rates(a.s.revolutions, g.values),
                 .colour = 1};
  straight.dash = Series::Dash::dash;
  constexpr int kPoints = 60;
  for (int i = 0; i <= kPoints; ++i) {
    const double n = a.s.revolutions.back() * i / kPoints;
    const analysis::Estimate e = law.mean_at(n);
    for (Series* s : {&band, &line, &straight, &bent}) s->x.push_back(n);
    band.y.push_back(e.value);
    band.y_low.push_back(e.low);
    band.y_high.push_back(e.high);
    line.y.push_back(e.value);
    bent.y.push_back(law.rate(n));
    straight.y.push_back(a.fits[0].law.rate(n));
  }
  sums.series = {std::move(band), std::move(line), std::move(outputs)};
  rate_panel.series = {std::move(straight), std::move(bent), std::move(increments)};
  figure.panels = {std::move(sums), std::move(rate_panel)};
  return figure;
}

std::vector<std::string> findings(const Statistics& a) {
  std::vector<std::string> out;
  if (a.s.revolutions.empty() || a.depth.back().summary.count == 0) {
    out.emplace_back("There are no sections of a groove to make statistics of.");
    return out;
  }
  out.push_back(normality_sentence(a, "Depth", a.depth.back()));
  out.push_back(normality_sentence(a, "Width", a.width.back()));
  if (a.depth.size() > 1) out.push_back(rule_sentence(a));
  std::string text;
  for (const Watched& w : a.watched)
    text += (text.empty() ? "Run-in of the " : " Of the ") + run_in_sentence(a, w);
  if (!text.empty() && a.depth.size() > 1) out.push_back(text);
  text.clear();
  for (const Fit& fit : a.fits) text += (text.empty() ? "" : " ") + fit_sentence(a, fit);
  if (!text.empty()) out.push_back(text);
  return out;
}

}  // namespace

GrooveSeries groove_series(const Table& contours) {
  GrooveSeries out;
  const std::vector<double>&n = contours["revolution"], &depth = contours["depth_mm"],
        &width = contours["width_mm"];
  for (std::size_t r = 0; r < n.size(); ++r) {
    if (out.revolutions.empty() || n[r] != out.revolutions.back()) {
      out.revolutions.push_back(n[r]);
      out.depths_mm.emplace_back();
      out.widths_mm.emplace_back();
    }
    out.depths_mm.back().push_back(depth[r]);
    out.widths_mm.back().push_back(width[r]);
  }
  return out;
}

std::vector<std::string> statistics_findings(const GrooveSeries& series) {
  return findings(Statistics(series));
}

PageSection statistics_section(const GrooveSeries& series, const std::string& id) {
  const Statistics a(series);
  PageSection section{.title = "Statistics of the groove"};
  for (const std::string& finding : findings(a)) section.items.emplace_back(Paragraph{finding});
  if (a.s.revolutions.empty() || a.depth.back().summary.count == 0) return section;
  section.items.emplace_back(normality_table(a, id));
  if (a.depth.size() > 1) section.items.emplace_back(p_figure(a, id));
  if (Figure figure = correlation_figure(a, id); !figure.panels.empty())
    section.items.emplace_back(std::move(figure));
  if (!a.watched.empty() && a.depth.size() > 1) section.items.emplace_back(run_in_table(a, id));
  if (!a.fits.empty()) section.items.emplace_back(fit_table(a, id));
  if (Figure figure = growth_figure(a, id); !figure.panels.empty())
    section.items.emplace_back(std::move(figure));
  return section;
}

}  // namespace abradem::report
