// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/report/seed_section.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "abradem/analysis/correlation.h"
#include "abradem/analysis/normality.h"
#include "abradem/analysis/run_in.h"
#include "abradem/report/statistics_section.h"
#include "abradem/report/table.h"
#include "abradem/report/text.h"

namespace abradem::report {
namespace {

using analysis::SeedSensitivity;

constexpr std::string_view kSeed = "run.seed";
constexpr double kLevel = 0.05;

std::string number(double x, int digits = 3) {
  return std::isfinite(x) ? fmt::format("{:.{}g}", x, digits) : "–";
}

/// The sections of one run, and what the paper's rule makes of them.
struct SeedRun {
  std::string name, seed;
  GrooveSeries series;
  analysis::NormalFrom normal;
};

/// Runs that differ in the seed alone.
struct Group {
  std::string label;  ///< the other keys and their values; empty without
  std::vector<SeedRun> runs;
};

SeedRun read(const SweepRun& run, const std::string& seed) {
  using namespace std::string_view_literals;
  constexpr std::array kColumns{"revolution"sv, "depth_mm"sv, "width_mm"sv};
  SeedRun out{
      run.name, seed, groove_series(read_table(run.folder / "tables" / "contours.csv", kColumns)), {}};
  std::vector<double> depth_p, width_p;
  for (std::size_t k = 0; k < out.series.revolutions.size(); ++k) {
    depth_p.push_back(analysis::chi_squared_normality(out.series.depths_mm[k]).p);
    width_p.push_back(analysis::chi_squared_normality(out.series.widths_mm[k]).p);
  }
  out.normal = analysis::normal_from(out.series.revolutions, depth_p, width_p, kLevel);
  return out;
}

std::vector<Group> groups(const SweepTable& table, const std::vector<SweepRun>& runs, std::size_t seed) {
  std::vector<Group> out;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    if (table.status[r] != "completed") continue;
    std::string label;
    for (std::size_t f = 0; f < table.factors.size(); ++f)
      if (f != seed)
        label += fmt::format("{}{} = {}", label.empty() ? "" : ", ", table.factors[f].title,
                             table.factors[f].text[r]);
    auto same = std::ranges::find(out, label, &Group::label);
    if (same == out.end()) same = out.insert(out.end(), Group{label, {}});
    SeedRun run = read(runs[r], table.factors[seed].text[r]);
    if (!run.series.depths_mm.empty()) same->runs.push_back(std::move(run));
  }
  std::erase_if(out, [](const Group& g) { return g.runs.size() < 2; });
  return out;
}

/// Depths (widths) of the last output of every run; thinned to sections that are not correlated.
std::vector<std::vector<double>> samples(const Group& group, bool width, bool independent) {
  std::vector<std::vector<double>> out;
  for (const SeedRun& run : group.runs) {
    const std::vector<double>& all = (width ? run.series.widths_mm : run.series.depths_mm).back();
    out.push_back(all);
    if (!independent) continue;
    const int step = analysis::correlation(all, analysis::Ends::joined).independent_step;
    if (step < 2) continue;
    out.back().clear();
    for (const std::size_t i : analysis::thinned(all.size(), step)) out.back().push_back(all[i]);
  }
  return out;
}

struct NamedTest {
  const char* name;
  SeedSensitivity::Test SeedSensitivity::*test;
  double (*p)(const analysis::Normality&);
};
constexpr std::array kTests{NamedTest{"χ²", &SeedSensitivity::equiprobable,
                                      [](const analysis::Normality& n) { return n.equiprobable.p; }},
                            NamedTest{"χ², equal width", &SeedSensitivity::equal_width,
                                      [](const analysis::Normality& n) { return n.equal_width.p; }},
                            NamedTest{"Anderson-Darling", &SeedSensitivity::anderson_darling,
                                      [](const analysis::Normality& n) { return n.anderson_darling.p; }},
                            NamedTest{"Shapiro-Wilk", &SeedSensitivity::shapiro_wilk,
                                      [](const analysis::Normality& n) { return n.shapiro_wilk.p; }}};

std::string finding(const Group& group) {
  double low = INFINITY, high = 0.0;
  int met = 0;
  for (const SeedRun& run : group.runs)
    if (run.normal.revolution) {
      low = std::min(low, *run.normal.revolution), high = std::max(high, *run.normal.revolution);
      ++met;
    }
  std::string text = group.label.empty() ? "" : group.label + ": ";
  text += fmt::format(
      "the rule of the paper (every chi-squared p of depth and width above 0.05 to the end) is met by {} of "
      "{} seeds",
      met, group.runs.size());
  if (met > 0)
    text += low == high ? fmt::format(", from revolution {} on", number(low, 6))
                        : fmt::format(", from revolution {} to {} on", number(low, 6), number(high, 6));
  text += ".";
  if (group.label.empty()) text[0] = 'T';
  return text;
}

DataTable verdict_table(const std::vector<Group>& all) {
  DataTable t{
      .id = "seed-sensitivity",
      .title = "Verdicts over the seeds",
      .caption =
          "Of the sections after the last output. Passing: share of the seeds with p > 0.05. Independent: "
          "of sections thinned until they are not correlated."};
  t.columns = {"runs with",   "seeds",      "of",       "sections", "test",
               "passing [%]", "smallest p", "median p", "largest p"};
  for (const Group& group : all)
    for (const bool width : {false, true})
      for (const bool independent : {false, true}) {
        const SeedSensitivity s = analysis::seed_sensitivity(samples(group, width, independent), kLevel);
        for (const NamedTest& named : kTests) {
          const SeedSensitivity::Test& test = s.*(named.test);
          t.rows.push_back({group.label.empty() ? "all" : group.label, std::to_string(group.runs.size()),
                            width ? "width" : "depth", independent ? "independent" : "all", named.name,
                            number(100.0 * test.share_passing), readable_p(test.p_min),
                            readable_p(test.p_median), readable_p(test.p_max)});
        }
      }
  return t;
}

DataTable rule_table(const std::vector<Group>& all) {
  DataTable t{
      .id = "seed-rule",
      .title = "Steady from where on, by the rule of the paper",
      .caption =
          "The first revolution from which to the end every chi-squared p of depth and width exceeds 0.05, "
          "and the outputs that this rests on. A dash: the last output fails."};
  t.columns = {"run", "runs with", "seed", "from revolution", "outputs", "of"};
  for (const Group& group : all)
    for (const SeedRun& run : group.runs)
      t.rows.push_back({run.name, group.label.empty() ? "all" : group.label, run.seed,
                        run.normal.revolution ? number(*run.normal.revolution, 6) : "–",
                        std::to_string(run.normal.lasting), std::to_string(run.series.revolutions.size())});
  return t;
}

/// One point per run: its p, for each test.
Figure p_figure(const std::vector<Group>& all) {
  Figure figure{.id = "seed-p", .title = "p of each test, one point per run", .columns = 2};
  figure.caption =
      "After the last output, all sections; points below 10⁻⁶ are drawn there. The dotted line is p = 0.05.";
  for (const bool width : {false, true}) {
    Panel panel{.title = width ? "Width" : "Depth",
                .x = {.title = "test [-]", .range = std::array{-0.5, 3.5}},
                .y = {.title = "p [-]", .log = true, .range = std::array{5e-7, 1.5}}};
    for (std::size_t k = 0; k < kTests.size(); ++k)
      panel.x.labels.emplace_back(static_cast<double>(k), kTests[k].name);
    for (std::size_t g = 0; g < all.size() && g < 8; ++g) {
      Series s{.kind = Series::Kind::markers,
               .name = all[g].label.empty() ? "runs" : all[g].label,
               .colour = static_cast<int>(g)};
      const SeedSensitivity sensitivity = analysis::seed_sensitivity(samples(all[g], width, false), kLevel);
      for (std::size_t k = 0; k < kTests.size(); ++k)
        for (std::size_t r = 0; r < sensitivity.samples.size(); ++r) {
          const double p = kTests[k].p(sensitivity.samples[r]);
          // Side by side, so that equal ones can be told apart.
          const double beside =
              static_cast<double>(r + 1) / static_cast<double>(sensitivity.samples.size() + 1) - 0.5;
          s.x.push_back(static_cast<double>(k) + 0.6 * beside);
          s.y.push_back(std::isnan(p) ? p : std::max(p, 1e-6));
        }
      panel.series.push_back(std::move(s));
    }
    Series level{
        .kind = Series::Kind::line, .name = "p = 0.05", .x = {-0.5, 3.5}, .y = {kLevel, kLevel}, .colour = 7};
    level.dash = Series::Dash::dot;
    panel.series.push_back(std::move(level));
    figure.panels.push_back(std::move(panel));
  }
  return figure;
}

}  // namespace

std::optional<PageSection> seed_section(const SweepTable& table, const std::vector<SweepRun>& runs) {
  const auto seed =
      std::ranges::find_if(table.factors, [](const SweepColumn& f) { return f.title.starts_with(kSeed); });
  if (seed == table.factors.end()) return std::nullopt;
  const std::vector<Group> all = groups(table, runs, static_cast<std::size_t>(seed - table.factors.begin()));
  if (all.empty()) return std::nullopt;
  PageSection section{.title = "What the seed of the mesh decides"};
  for (const Group& group : all) section.items.emplace_back(Paragraph{finding(group)});
  section.items.emplace_back(p_figure(all));
  section.items.emplace_back(verdict_table(all));
  section.items.emplace_back(rule_table(all));
  return section;
}

}  // namespace abradem::report
