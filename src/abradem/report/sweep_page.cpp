// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/report/sweep_page.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <string_view>

namespace abradem::report {
namespace {

/// A result worth a figure.
struct Shown {
  std::string_view column, id, title, axis;
  double scale = 1.0;  ///< from the table's unit to the axis's
};
constexpr std::array kShown{
    Shown{"swept_volume_mm3", "volume", "Worn volume", "volume the wall lost [mm³]"},
    Shown{"depth_mean_mm", "depth", "Depth of the groove", "mean depth of the sections [µm]", 1e3},
    Shown{"width_mean_mm", "width", "Width of the groove", "mean width of the sections [mm]"},
    Shown{"area_mean_mm2", "area", "Worn section", "mean area of the sections [µm²]", 1e6},
    Shown{"force_mean_N", "force", "Normal force", "mean normal force of the last interval [N]"},
    Shown{"kappa", "kappa", "Volume lost over volume of the law", "κ [-]"},
    Shown{"outflow_kg_per_s", "outflow", "Mass flow out", "mean mass flow out [kg/s]"},
    Shown{"particles", "particles", "Particles in the run", "particles at the end [-]"},
};

/// Same to this relative difference: nothing to see in a figure.
constexpr double kSame = 1e-9;

const SweepColumn* find(const SweepTable& table, std::string_view title) {
  const auto found = std::ranges::find(table.results, title, &SweepColumn::title);
  return found == table.results.end() ? nullptr : &*found;
}

bool varies(const SweepColumn& column) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double x : column.number)
    if (std::isfinite(x)) low = std::min(low, x), high = std::max(high, x);
  return high - low > kSame * std::max(std::abs(low), std::abs(high));
}

/// For legends: the last word of a key, "size" of "wall.disc.mesh.size [mm]", and its unit, " mm".
std::pair<std::string, std::string> short_name(const SweepColumn& factor) {
  const std::size_t bracket = factor.title.rfind(" [");
  const std::string key = factor.title.substr(0, bracket);
  const std::string word = key.substr(key.rfind('.') + 1);
  if (bracket == std::string::npos) return {word, ""};
  return {word, fmt::format(" {}", factor.title.substr(bracket + 2, factor.title.size() - bracket - 3))};
}

/// Positive, and over more than two decades: lines would hide all but the largest.
bool spans_decades(const std::vector<double>& y) {
  double low = std::numeric_limits<double>::infinity(), high = 0.0;
  for (const double value : y)
    if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
  return low > 0.0 && high > 100.0 * low;
}

/// Positions of a factor's values along an axis: the numbers themselves, or 0, 1, … for words, in the order
/// in which they first appear.
struct Positions {
  std::vector<double> x;
  Axis axis;
};

Positions positions_of(const SweepColumn& factor) {
  Positions p;
  p.axis.title = factor.title.ends_with(']') ? factor.title : factor.title + " [-]";
  if (!factor.number.empty()) {
    p.x = factor.number;
    p.axis.log = factor.logarithmic;
    return p;
  }
  std::map<std::string, double> known;
  for (const std::string& word : factor.text) {
    const auto [at, is_new] = known.try_emplace(word, static_cast<double>(known.size()));
    if (is_new) p.axis.labels.emplace_back(at->second, word);
    p.x.push_back(at->second);
  }
  return p;
}

/// The mean of y at each x; empty unless some x has several values and there are at least two.
Series level_means(const std::vector<double>& x, const std::vector<double>& y) {
  std::map<double, std::pair<double, int>> levels;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!std::isfinite(y[i])) continue;
    auto& [sum, count] = levels[x[i]];
    sum += y[i];
    ++count;
  }
  Series means{.kind = Series::Kind::line, .name = "mean"};
  means.colour = 1;
  const bool repeated = std::ranges::any_of(levels, [](const auto& l) { return l.second.second > 1; });
  if (!repeated || levels.size() < 2) return means;
  for (const auto& [at, level] : levels) {
    means.x.push_back(at);
    means.y.push_back(level.first / level.second);
  }
  return means;
}

/// Runs as points in the order of their x, joined by a line.
Series curve(std::string name, const std::vector<std::size_t>& runs, const std::vector<double>& x,
             const std::vector<double>& y, int colour) {
  Series series{.kind = Series::Kind::line_markers, .name = std::move(name)};
  series.colour = colour;
  std::vector<std::size_t> order = runs;
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return x[i]; });
  for (const std::size_t i : order) {
    series.x.push_back(x[i]);
    series.y.push_back(y[i]);
  }
  return series;
}

constexpr std::size_t kColours = 8;  // of a page

/// Runs by their value of one factor, in the order of the table.
std::vector<std::pair<std::string, std::vector<std::size_t>>> levels_of(const SweepColumn& factor) {
  std::vector<std::pair<std::string, std::vector<std::size_t>>> levels;
  for (std::size_t i = 0; i < factor.text.size(); ++i) {
    const auto known = std::ranges::find_if(levels, [&](const auto& l) { return l.first == factor.text[i]; });
    if (known == levels.end())
      levels.push_back({factor.text[i], {i}});
    else
      known->second.push_back(i);
  }
  return levels;
}

/// A result against one of the factors.
class EffectPanel {
 public:
  EffectPanel(const SweepTable& table, std::size_t factor, const Shown& shown, const SweepColumn& result)
      : table_(table), factor_(factor), positions_(positions_of(table.factors[factor])) {
    for (const double value : result.number) y_.push_back(shown.scale * value);
    panel_.x = positions_.axis;
    panel_.y.title = shown.axis;
    panel_.y.log = spans_decades(y_);
  }

  Panel make() {
    if (table_.factors.size() == 1 && !table_.factors[0].number.empty())
      panel_.series.push_back(curve("", all_runs(), positions_.x, y_, 0));
    else if (!draw_curves())
      draw_points();
    return std::move(panel_);
  }

 private:
  [[nodiscard]] std::vector<std::size_t> all_runs() const {
    std::vector<std::size_t> runs(y_.size());
    std::iota(runs.begin(), runs.end(), std::size_t{0});
    return runs;
  }

  /// Two factors on a grid of few values: one curve for each value of the other.
  bool draw_curves() {
    if (table_.factors.size() != 2) return false;
    const SweepColumn& other = table_.factors[1 - factor_];
    const auto own_levels = levels_of(table_.factors[factor_]), levels = levels_of(other);
    if (levels.size() + own_levels.size() > kColours ||
        levels.size() * own_levels.size() != table_.names.size())
      return false;
    const auto [word, unit] = short_name(other);
    const std::size_t first = factor_ == 0 ? 0 : own_levels.size();
    for (std::size_t l = 0; l < levels.size(); ++l)
      panel_.series.push_back(curve(fmt::format("{}: {}{}", word, levels[l].first, unit), levels[l].second,
                                    positions_.x, y_, static_cast<int>(first + l)));
    return true;
  }

  void draw_points() {
    panel_.series.push_back({.kind = Series::Kind::markers, .name = "runs", .x = positions_.x, .y = y_});
    Series means = level_means(positions_.x, y_);
    if (!means.x.empty()) panel_.series.push_back(std::move(means));
  }

  const SweepTable& table_;
  std::size_t factor_;
  Positions positions_;
  std::vector<double> y_;
  Panel panel_;
};

}  // namespace

std::vector<Figure> main_effects(const SweepTable& table, const std::string& id_prefix) {
  std::vector<Figure> figures;
  for (const Shown& shown : kShown) {
    const SweepColumn* result = find(table, shown.column);
    if (result == nullptr || !varies(*result)) continue;
    Figure figure{.id = id_prefix + std::string(shown.id), .title = std::string(shown.title)};
    bool averaged = false;
    for (std::size_t f = 0; f < table.factors.size(); ++f) {
      figure.panels.push_back(EffectPanel(table, f, shown, *result).make());
      averaged = averaged || figure.panels.back().series.back().name == "mean";
    }
    figure.caption = fmt::format("At the end of each run ({} in the table), against {}.{}", shown.column,
                                 table.factors.size() == 1 ? "the key that varies" : "each key that varies",
                                 averaged ? " Line: mean of the runs with that value." : "");
    figure.columns = static_cast<int>(std::min<std::size_t>(2, figure.panels.size()));
    figures.push_back(std::move(figure));
  }
  return figures;
}

DataTable runs_table(const SweepTable& table, const std::string& id) {
  DataTable out{.id = id, .title = "Runs"};
  out.caption = "Values at the end of each run; summary.csv has all columns with all digits.";
  out.columns = {"run", "status"};
  for (const SweepColumn& factor : table.factors) out.columns.push_back(factor.title);
  std::vector<const SweepColumn*> results;
  for (const Shown& shown : kShown)
    if (const SweepColumn* result = find(table, shown.column);
        result != nullptr && std::ranges::any_of(result->number, [](double x) { return std::isfinite(x); })) {
      results.push_back(result);
      out.columns.push_back(result->title);
    }
  for (std::size_t r = 0; r < table.names.size(); ++r) {
    std::vector<std::string> row{table.names[r], table.status[r]};
    for (const SweepColumn& factor : table.factors) row.push_back(factor.text[r]);
    for (const SweepColumn* result : results)
      row.push_back(std::isfinite(result->number[r]) ? fmt::format("{:.6g}", result->number[r]) : "–");
    out.rows.push_back(std::move(row));
    out.links.push_back(fmt::format("runs/{}/", table.names[r]));
  }
  return out;
}

Page sweep_page(const SweepSummary& summary, const SweepTable& table) {
  const auto count = [&](std::string_view status) { return std::ranges::count(table.status, status); };
  Page page{.title = summary.title.empty() ? "Sweep" : summary.title};
  page.summary =
      fmt::format("{}: {} of {} runs completed{}.", summary.design, count("completed"), table.names.size(),
                  count("failed") > 0 ? fmt::format(", {} failed", count("failed")) : "");
  page.cards = {{"runs", std::to_string(table.names.size())},
                {"completed", std::to_string(count("completed"))},
                {"keys varied", std::to_string(table.factors.size())},
                {"time of all runs", fmt::format("{:.3g} s", summary.seconds)}};
  PageSection effects{.title = "Main effects"};
  for (Figure& figure : main_effects(table)) effects.items.emplace_back(std::move(figure));
  if (effects.items.empty())
    effects.items.emplace_back(Paragraph{count("completed") < 2
                                             ? "Fewer than two runs came to their end: nothing to compare."
                                             : "No result differs from run to run."});
  page.sections.push_back(std::move(effects));
  page.sections.push_back({.title = "Runs", .items = {runs_table(table)}});
  DataTable failed{.id = "failed", .title = "Runs that failed", .columns = {"run", "why"}};
  for (std::size_t r = 0; r < table.names.size(); ++r)
    if (table.status[r] == "failed") failed.rows.push_back({table.names[r], table.messages[r]});
  if (!failed.rows.empty()) page.sections.back().items.emplace_back(std::move(failed));
  if (!summary.command.empty())
    page.sections.push_back({.title = "How it was made", .items = {Paragraph{summary.command}}});
  return page;
}

}  // namespace abradem::report
