// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/report/figure_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include "abradem/analysis/statistics.h"
#include "abradem/core/error.h"
#include "abradem/report/text.h"

namespace abradem::report {
namespace {

using Kind = Series::Kind;

constexpr std::array kKinds = {"line", "markers", "line_markers", "band", "box", "bars", "heat", "surface"};
constexpr std::array kDashes = {"solid", "dash", "dot"};
/// More points than these outside a box hide one another.
constexpr std::size_t kMaxOutliers = 400;

bool is_grid(const Series& s) { return s.kind == Kind::heat || s.kind == Kind::surface; }

/// A cell of a grid takes one value of the page where a point takes two or more.
constexpr std::size_t kCellsPerPoint = 3;

std::size_t rows_of(const Series& s) { return is_grid(s) ? s.z.size() : s.x.size(); }

/// What axis titles write and names of columns cannot.
constexpr std::pair<std::string_view, std::string_view> kSpelling[] = {
    {"µ", "u"},     {"μ", "mu"},      {"³", "3"},     {"²", "2"},     {"⁻", "-"},     {"¹", "1"},
    {"°", "deg"},   {"%", "percent"}, {"α", "alpha"}, {"κ", "kappa"}, {"δ", "delta"}, {"Δ", "delta"},
    {"θ", "theta"}, {"σ", "sigma"},   {"χ", "chi"},   {"φ", "phi"},   {"·", " "},     {"/", " per "}};

/// Letters, digits and single underscores.
std::string spelled(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const auto known = std::find_if(std::begin(kSpelling), std::end(kSpelling),
                                    [&](const auto& entry) { return text.starts_with(entry.first); });
    const std::string_view piece = known != std::end(kSpelling) ? known->second : text.substr(0, 1);
    text.remove_prefix(known != std::end(kSpelling) ? known->first.size() : 1);
    for (const char c : piece) {
      const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
      if (plain) {
        out += c;
      } else if (!out.empty() && out.back() != '_' && (static_cast<unsigned char>(c) < 0x80)) {
        out += '_';
      }
    }
  }
  while (!out.empty() && out.back() == '_') out.pop_back();
  return out;
}

/// The one name that all axes of a figure give, or the plain one.
std::string common_name(const Figure& figure, const Axis Panel::*axis, std::string_view plain) {
  std::string name;
  for (const Panel& panel : figure.panels) {
    const std::string mine = column_name((panel.*axis).title);
    if (mine.empty() || (!name.empty() && mine != name)) return std::string(plain);
    name = mine;
  }
  return name.empty() ? std::string(plain) : name;
}

struct Columns {
  std::string x, y, z;
  bool edges = false, grids = false;
};

/// The one name that all z titles of a figure give, or the plain one.
std::string common_z_name(const Figure& figure) {
  std::set<std::string> names;
  for (const Panel& panel : figure.panels) {
    for (const Series& s : panel.series) {
      if (is_grid(s)) names.insert(column_name(s.z_title));
    }
  }
  return names.size() == 1 && !names.begin()->empty() ? *names.begin() : std::string("z");
}

Columns columns_of(const Figure& figure) {
  Columns columns{common_name(figure, &Panel::x, "x"), common_name(figure, &Panel::y, "y"),
                  common_z_name(figure), false, false};
  for (const Panel& panel : figure.panels) {
    for (const Series& s : panel.series) {
      columns.edges = columns.edges || !s.y_low.empty();
      columns.grids = columns.grids || is_grid(s);
    }
  }
  const std::set<std::string> distinct{columns.x, columns.y, columns.z, "panel", "series"};
  if (distinct.size() == 5) return columns;
  return {std::string("x"), std::string("y"), std::string("z"), columns.edges, columns.grids};
}

void append_number(fmt::memory_buffer& out, double value, int digits) {
  out.push_back(',');
  if (!std::isfinite(value)) {
    fmt::format_to(std::back_inserter(out), "nan");
  } else if (digits > 0) {
    fmt::format_to(std::back_inserter(out), "{:.{}g}", value, digits);
  } else {
    fmt::format_to(std::back_inserter(out), "{}", value);
  }
}

std::vector<double> picked(const std::vector<double>& values, const std::vector<std::size_t>& rows) {
  std::vector<double> out;
  if (values.empty()) return out;
  out.reserve(rows.size());
  for (const std::size_t row : rows) out.push_back(values[row]);
  return out;
}

/// The first, every k-th and the last of n.
std::vector<std::size_t> every(std::size_t n, std::size_t k) {
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < n; row += k) rows.push_back(row);
  if (n > 0 && rows.back() != n - 1) rows.push_back(n - 1);
  return rows;
}

/// The first, the last, and of each stretch of 2 k points the lowest and the highest. A gap stays a gap, for
/// a number that is not finite counts as the lowest.
std::vector<std::size_t> extremes(const std::vector<double>& y, std::size_t k) {
  std::vector<std::size_t> rows{0};
  const auto lower = [&](std::size_t a, std::size_t b) {
    return std::isfinite(y[b]) && (!std::isfinite(y[a]) || y[a] < y[b]);
  };
  std::vector<std::size_t> stretch;
  for (std::size_t from = 1; from + 1 < y.size(); from += 2 * k) {
    stretch.resize(std::min(2 * k, y.size() - 1 - from));
    std::iota(stretch.begin(), stretch.end(), from);
    const auto [lowest, highest] = std::minmax_element(stretch.begin(), stretch.end(), lower);
    rows.push_back(std::min(*lowest, *highest));
    if (*lowest != *highest) rows.push_back(std::max(*lowest, *highest));
  }
  rows.push_back(y.size() - 1);
  return rows;
}

Series thinned(const Series& s, std::size_t k) {
  Series out = s;
  if (is_grid(s)) {
    const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(k))));
    const auto columns = every(s.x.size(), side), lines = every(s.y.size(), side);
    out.x = picked(s.x, columns);
    out.y = picked(s.y, lines);
    out.z.clear();
    for (const std::size_t line : lines) {
      for (const std::size_t column : columns) out.z.push_back(s.z[line * s.x.size() + column]);
    }
    return out;
  }
  if (s.x.size() < 50) return out;
  const bool drawn_through = s.kind == Kind::line || s.kind == Kind::line_markers;
  const auto rows = drawn_through ? extremes(s.y, k) : every(s.x.size(), k);
  for (std::vector<double> Series::*column : {&Series::x, &Series::y, &Series::y_low, &Series::y_high})
    out.*column = picked(s.*column, rows);
  return out;
}

void check(const Series& s, const std::string& where) {
  const auto fail = [&](const std::string& what) {
    throw Error(ExitCode::internal, fmt::format("{}: {}", where, what));
  };
  if (s.theirs && s.name.empty()) fail("published or measured values must have a name");
  if (s.colour < 0 || s.colour > 7) fail(fmt::format("colour {}; expected 0 to 7", s.colour));
  if (s.y_low.size() != s.y_high.size())
    fail(fmt::format("{} lower and {} upper edges", s.y_low.size(), s.y_high.size()));
  if (is_grid(s)) {
    if (s.z.size() != s.x.size() * s.y.size())
      fail(fmt::format("{} values of z over {} columns and {} rows", s.z.size(), s.x.size(), s.y.size()));
    if (s.z_title.empty()) fail("heat and surface need the title of z, with its unit");
    if (!s.y_low.empty()) fail("heat and surface have no edges");
    return;
  }
  const std::size_t y = s.kind == Kind::band ? s.y_low.size() : s.y.size();
  if (s.x.size() != y) fail(fmt::format("{} values of x and {} of y", s.x.size(), y));
  if (!s.y_low.empty() && s.y_low.size() != s.x.size())
    fail(fmt::format("{} values of x and {} of the edges", s.x.size(), s.y_low.size()));
}

std::string json_axis(const Axis& axis) {
  std::string out = fmt::format(R"({{"title":{},"log":{},"equal":{})", json_string(axis.title), axis.log,
                                axis.equal_to_other);
  if (axis.range)
    out += fmt::format(R"(,"range":[{},{}])", json_number((*axis.range)[0]), json_number((*axis.range)[1]));
  if (!axis.labels.empty()) {
    std::vector<std::string> labels;
    for (const auto& [position, text] : axis.labels)
      labels.push_back(fmt::format("[{},{}]", json_number(position), json_string(text)));
    out += fmt::format(R"(,"labels":[{}])", fmt::join(labels, ","));
  }
  return out + "}";
}

std::string json_box(const Box& box) {
  const std::size_t k = (box.outliers.size() + kMaxOutliers - 1) / kMaxOutliers;
  std::vector<std::string> outliers;
  if (k > 0) {
    for (const std::size_t row : every(box.outliers.size(), k))
      outliers.push_back(json_number(box.outliers[row]));
  }
  return fmt::format(R"({{"x":{},"n":{},"low":{},"q1":{},"median":{},"q3":{},"high":{},"outliers":[{}]}})",
                     json_number(box.x), box.count, json_number(box.low), json_number(box.lower_quartile),
                     json_number(box.median), json_number(box.upper_quartile), json_number(box.high),
                     fmt::join(outliers, ","));
}

std::string json_series(const Series& drawn, const Series& complete) {
  std::string out = fmt::format(
      R"({{"kind":"{}","name":{},"colour":{},"dash":"{}","theirs":{},"rows":{},"edges":{})",
      kKinds[static_cast<std::size_t>(drawn.kind)], json_string(drawn.name), drawn.colour,
      kDashes[static_cast<std::size_t>(drawn.dash)], drawn.theirs, rows_of(drawn), !drawn.y_low.empty());
  if (is_grid(drawn))
    out += fmt::format(R"(,"width":{},"z_title":{})", drawn.x.size(), json_string(drawn.z_title));
  if (drawn.kind == Kind::surface)
    out += fmt::format(R"(,"polar":{},"exaggeration":{},"z_unit":{})", drawn.polar,
                       json_number(drawn.exaggeration), json_number(drawn.z_unit));
  if (drawn.kind == Kind::box) {
    std::vector<std::string> all;
    for (const Box& box : boxes(complete)) all.push_back(json_box(box));
    out += fmt::format(R"(,"boxes":[{}])", fmt::join(all, ","));
  }
  return out + "}";
}

}  // namespace

std::string column_name(std::string_view axis_title) {
  const std::size_t open = axis_title.rfind('[');
  std::string name = spelled(axis_title.substr(0, open));
  if (name.empty() || open == std::string_view::npos) return name;
  const std::string unit = spelled(axis_title.substr(open + 1));
  return unit.empty() ? name : name + '_' + unit;
}

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\n\r") == std::string_view::npos) return std::string(text);
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + '"';
}

void check(const Figure& figure) {
  if (figure.columns < 1)
    throw Error(ExitCode::internal, fmt::format("figure '{}': {} columns", figure.id, figure.columns));
  for (std::size_t p = 0; p < figure.panels.size(); ++p) {
    for (std::size_t s = 0; s < figure.panels[p].series.size(); ++s) {
      check(figure.panels[p].series[s], fmt::format("figure '{}', panel {}, series {} ('{}')", figure.id,
                                                    p + 1, s + 1, figure.panels[p].series[s].name));
    }
  }
}

std::size_t row_count(const Figure& figure) {
  std::size_t rows = 0;
  for (const Panel& panel : figure.panels) {
    for (const Series& s : panel.series) rows += rows_of(s);
  }
  return rows;
}

Figure thinned(const Figure& figure, std::size_t max_points) {
  std::size_t cells = 0;
  for (const Panel& panel : figure.panels) {
    for (const Series& s : panel.series) cells += is_grid(s) ? s.z.size() : 0;
  }
  const std::size_t points = row_count(figure) - cells, max_cells = kCellsPerPoint * max_points;
  if (points <= max_points && cells <= max_cells) return figure;
  Figure out = figure;
  for (Panel& panel : out.panels) {
    for (Series& s : panel.series)
      s = is_grid(s) ? thinned(s, (cells + max_cells - 1) / max_cells)
                     : thinned(s, (points + max_points - 1) / max_points);
  }
  return out;
}

std::string figure_csv(const Figure& figure, int digits) {
  const Columns columns = columns_of(figure);
  fmt::memory_buffer out;
  const auto add = std::back_inserter(out);
  fmt::format_to(add, "panel,series,{},{}", columns.x, columns.y);
  if (columns.edges) fmt::format_to(add, ",{0}_low,{0}_high", columns.y);
  if (columns.grids) fmt::format_to(add, ",{}", columns.z);
  out.push_back('\n');
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t p = 0; p < figure.panels.size(); ++p) {
    const Panel& panel = figure.panels[p];
    const std::string panel_name = csv_field(panel.title.empty() ? std::to_string(p + 1) : panel.title);
    for (const Series& s : panel.series) {
      const std::string start = fmt::format("{},{}", panel_name, csv_field(s.name));
      for (std::size_t row = 0; row < rows_of(s); ++row) {
        out.append(start);
        append_number(out, is_grid(s) ? s.x[row % s.x.size()] : s.x[row], digits);
        append_number(out, is_grid(s) ? s.y[row / s.x.size()] : s.y.empty() ? kNone : s.y[row], digits);
        if (columns.edges) {
          append_number(out, s.y_low.empty() ? kNone : s.y_low[row], digits);
          append_number(out, s.y_high.empty() ? kNone : s.y_high[row], digits);
        }
        if (columns.grids) append_number(out, is_grid(s) ? s.z[row] : kNone, digits);
        out.push_back('\n');
      }
    }
  }
  return fmt::to_string(out);
}

std::vector<Box> boxes(const Series& series) {
  std::map<double, std::vector<double>> groups;
  for (std::size_t k = 0; k < series.x.size(); ++k) {
    if (std::isfinite(series.x[k]) && std::isfinite(series.y[k])) groups[series.x[k]].push_back(series.y[k]);
  }
  std::vector<Box> out;
  for (auto& [x, values] : groups) {
    std::sort(values.begin(), values.end());
    const analysis::Summary summary = analysis::summarise(values);
    Box box{x,
            values.size(),
            summary.min,
            summary.lower_quartile,
            summary.median,
            summary.upper_quartile,
            summary.max,
            {}};
    const std::vector<std::size_t> outside = analysis::tukey_outliers(values);  // of sorted values: both ends
    for (const std::size_t k : outside) box.outliers.push_back(values[k]);
    std::vector<double> inside;
    std::set_difference(values.begin(), values.end(), box.outliers.begin(), box.outliers.end(),
                        std::back_inserter(inside));
    if (!inside.empty()) {
      box.low = inside.front();
      box.high = inside.back();
    }
    out.push_back(std::move(box));
  }
  return out;
}

std::string figure_json(const Figure& drawn, const Figure& complete, int number) {
  const Columns columns = columns_of(complete);
  std::vector<std::string> roles{"panel", "series", "x", "y"};
  if (columns.edges) roles.insert(roles.end(), {"y_low", "y_high"});
  if (columns.grids) roles.emplace_back("z");
  std::vector<std::string> panels;
  for (std::size_t p = 0; p < drawn.panels.size(); ++p) {
    const Panel& panel = drawn.panels[p];
    std::vector<std::string> series;
    for (std::size_t s = 0; s < panel.series.size(); ++s)
      series.push_back(json_series(panel.series[s], complete.panels[p].series[s]));
    panels.push_back(fmt::format(R"({{"title":{},"x":{},"y":{},"series":[{}]}})", json_string(panel.title),
                                 json_axis(panel.x), json_axis(panel.y), fmt::join(series, ",")));
  }
  return fmt::format(
      R"({{"number":{},"id":{},"title":{},"caption":{},"file":{},"columns":{},"roles":["{}"],"panels":[{}]}})",
      number, json_string(drawn.id), json_string(drawn.title), json_string(drawn.caption),
      json_string(drawn.id + ".csv"), drawn.columns, fmt::join(roles, "\",\""), fmt::join(panels, ","));
}

}  // namespace abradem::report
