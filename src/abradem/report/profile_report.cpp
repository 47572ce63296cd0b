// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/report/profile_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

#include "abradem/analysis/groove_statistics.h"
#include "abradem/analysis/statistics.h"
#include "abradem/core/error.h"
#include "abradem/io/normality_table.h"

namespace abradem::report {

namespace {

using analysis::Baseline;
using Json = nlohmann::ordered_json;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kMm = 1e3, kUm = 1e6, kMm2 = 1e6, kDegrees = 180.0 / std::numbers::pi;
constexpr std::size_t kTextRows = 40, kDrawn = 12;
constexpr std::size_t kTestable = 3;  ///< sections of a revolution from which on a test can be made

std::string number(double x, int digits = 4) {
  return std::isfinite(x) ? fmt::format("{:.{}g}", x, digits) : "–";
}

const char* baseline_name(Baseline b) {
  return b == Baseline::line ? "line" : b == Baseline::mean ? "mean" : "none";
}

std::string baseline_sentence(const ProfileAnalysis& a) {
  const std::string shoulder = a.options.shoulder
                                   ? fmt::format("{:g} mm at either end", kMm * *a.options.shoulder)
                                   : std::string("a tenth of the section at either end");
  switch (a.options.baseline) {
    case Baseline::line:
      return fmt::format("Heights are above a straight line through the shoulders ({}), by least squares.",
                         shoulder);
    case Baseline::mean:
      return fmt::format("Heights are above the mean of the shoulders ({}).", shoulder);
    case Baseline::none:
      break;
  }
  return "Heights are taken as they stand: 0 is the unworn surface (--level line takes away a tilt).";
}

MeasuredSection measure(const io::ReadSection& read, const ProfileOptions& options) {
  MeasuredSection out;
  out.name = read.name;
  out.revolution = read.revolution;
  out.contour.angle = read.angle;
  const double length = read.profile.back().radius - read.profile.front().radius;
  try {
    out.levelled = analysis::level(read.profile, options.baseline, options.shoulder.value_or(0.1 * length));
  } catch (const InputError& error) {
    // Without a baseline the shoulders tell the roughness alone.
    if (options.baseline != Baseline::none) throw InputError(fmt::format("{}: {}", read.name, error.what()));
    out.levelled.profile = read.profile;
    out.levelled.roughness = kNan;
  }
  out.contour.profile = out.levelled.profile;
  analysis::measure(out.contour);
  const auto& profile = out.contour.profile;
  out.width_at_depth = options.width_depth ? analysis::opening(profile, *options.width_depth) : kNan;
  const double level = -analysis::width_level(out.contour.depth);
  out.ends_in_groove = profile.front().height < level || profile.back().height < level;
  return out;
}

/// Whether the angles go evenly once round.
bool goes_round(std::span<const double> angles) {
  const auto n = static_cast<double>(angles.size());
  if (angles.size() < 3) return false;
  const double step = 2.0 * std::numbers::pi / n;
  for (std::size_t i = 1; i < angles.size(); ++i)
    if (!(std::abs(angles[i] - angles[i - 1] - step) < 0.01 * step)) return false;
  return true;
}

bool same_revolution(const MeasuredSection& a, const MeasuredSection& b) {
  return a.revolution == b.revolution || (std::isnan(a.revolution) && std::isnan(b.revolution));
}

GrooveSeries series_of(const ProfileAnalysis& a) {
  GrooveSeries s;
  GrooveSeries::Grown area{"mean area of the section", "mm²", {}};
  if (a.options.track_radius) {
    s.track_radius_mm = kMm * *a.options.track_radius;
    area.name = "worn volume", area.unit = "mm³";
  }
  bool round = true;
  std::vector<double> angles, areas;
  for (std::size_t i = 0; i < a.sections.size(); ++i) {
    const MeasuredSection& section = a.sections[i];
    if (i == 0 || !same_revolution(section, a.sections[i - 1])) {
      s.revolutions.push_back(section.revolution);
      s.depths_mm.emplace_back();
      s.widths_mm.emplace_back();
      angles.clear(), areas.clear();
    }
    s.depths_mm.back().push_back(kMm * section.contour.depth);
    s.widths_mm.back().push_back(kMm * section.contour.width);
    angles.push_back(section.contour.angle);
    areas.push_back(kMm2 * section.contour.area);
    if (i + 1 < a.sections.size() && same_revolution(section, a.sections[i + 1])) continue;
    round = round && goes_round(angles);
    const double mean = analysis::summarise(areas).mean;
    area.values.push_back(a.options.track_radius ? mean * 2.0 * std::numbers::pi * s.track_radius_mm : mean);
  }
  s.ends = round ? analysis::Ends::joined : analysis::Ends::open;
  s.grown.push_back(std::move(area));
  return s;
}

bool testable(const ProfileAnalysis& a) {
  return std::ranges::any_of(a.series.depths_mm, [](const auto& d) { return d.size() >= kTestable; });
}

/// A measure of the sections, in the unit of tables.
struct Column {
  const char *title, *json;
  double (*value)(const MeasuredSection&);
};
const std::vector<Column>& columns() {
  static const std::vector<Column> all{
      {"depth [µm]", "depth_mm", [](const MeasuredSection& s) { return kUm * s.contour.depth; }},
      {"width [mm]", "width_mm", [](const MeasuredSection& s) { return kMm * s.contour.width; }},
      {"displaced width [mm]", "displaced_width_mm",
       [](const MeasuredSection& s) { return kMm * s.contour.displaced_width; }},
      {"area [mm²]", "area_mm2", [](const MeasuredSection& s) { return kMm2 * s.contour.area; }},
      {"tilt [mrad]", "tilt", [](const MeasuredSection& s) { return 1e3 * s.levelled.tilt; }},
      {"roughness Rq [µm]", "roughness_um",
       [](const MeasuredSection& s) { return kUm * s.levelled.roughness; }}};
  return all;
}

/// Of the last revolution, where the table has revolutions: a mean over a growing groove says nothing.
std::vector<double> values(const ProfileAnalysis& a, const Column& column) {
  std::vector<double> out;
  for (const MeasuredSection& s : a.sections)
    if (const double x = column.value(s); same_revolution(s, a.sections.back()) && std::isfinite(x))
      out.push_back(x);
  return out;
}

std::string of_which_sections(const ProfileAnalysis& a) {
  const double last = a.sections.back().revolution;
  return std::isfinite(last) ? fmt::format("Sections after revolution {:g}", last)
                             : std::string("All sections");
}

DataTable sections_table(const ProfileAnalysis& a) {
  DataTable t{
      .id = "sections",
      .title = "Sections",
      .caption =
          "Width: between the outermost crossings of max(1 % of the depth, 0.5 µm). Displaced width: from "
          "the first height that is not 0 to the last, as the paper measures; on a rough surface that is "
          "all of the section. Area: what lies below 0, less what lies above. Tilt: taken away. "
          "Roughness: of the shoulders about the baseline."};
  t.columns = {"section"};
  for (const Column& column : columns()) t.columns.emplace_back(column.title);
  if (a.options.width_depth)
    t.columns.push_back(fmt::format("width at {:g} µm [mm]", kUm * *a.options.width_depth));
  for (const MeasuredSection& s : a.sections) {
    t.rows.push_back({s.name});
    for (const Column& column : columns()) t.rows.back().push_back(number(column.value(s)));
    if (a.options.width_depth) t.rows.back().push_back(number(kMm * s.width_at_depth));
  }
  return t;
}

DataTable summary_table(const ProfileAnalysis& a) {
  DataTable t{.id = "summary",
              .title = of_which_sections(a),
              .columns = {"measure", "mean", "sd", "min", "median", "max"}};
  for (const Column& column : columns()) {
    const analysis::Summary s = analysis::summarise(values(a, column));
    t.rows.push_back(
        {column.title, number(s.mean), number(s.sd, 3), number(s.min), number(s.median), number(s.max)});
  }
  return t;
}

std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string aligned(const DataTable& t, std::size_t rows) {
  std::vector<std::size_t> width;
  for (const std::string& c : t.columns) width.push_back(width_of(c));
  const std::size_t shown = std::min(rows, t.rows.size());
  for (std::size_t r = 0; r < shown; ++r)
    for (std::size_t c = 0; c < width.size(); ++c) width[c] = std::max(width[c], width_of(t.rows[r][c]));
  std::string out;
  const auto line = [&](const std::vector<std::string>& cells) {
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const std::string pad(width[c] - width_of(cells[c]), ' ');
      out += c == 0 ? "  " + cells[c] + pad : "  " + pad + cells[c];
    }
    out += '\n';
  };
  line(t.columns);
  for (std::size_t r = 0; r < shown; ++r) line(t.rows[r]);
  if (shown < t.rows.size())
    out += fmt::format("  … {} more; --json and -o have all\n", t.rows.size() - shown);
  return out;
}

// --- figures ---------------------------------------------------------------------------------------------
Figure profile_figure(const ProfileAnalysis& a) {
  Figure figure{.id = "profiles", .title = "Profiles"};
  const std::size_t n = a.sections.size(), drawn = std::min(n, kDrawn);
  figure.caption = n > drawn ? fmt::format("{} of {} sections, evenly spread. ", drawn, n) : std::string{};
  figure.caption += baseline_sentence(a);
  Panel panel{.x = {.title = "position across the track [mm]"}, .y = {.title = "height [µm]"}};
  for (std::size_t k = 0; k < drawn; ++k) {
    const MeasuredSection& s = a.sections[drawn < 2 ? 0 : k * (n - 1) / (drawn - 1)];
    Series line{.name = s.name, .colour = static_cast<int>(k % 8)};
    if (k >= 8) line.dash = Series::Dash::dash;
    for (const auto& p : s.contour.profile) {
      line.x.push_back(kMm * p.radius);
      line.y.push_back(kUm * p.height);
    }
    panel.series.push_back(std::move(line));
  }
  figure.panels.push_back(std::move(panel));
  return figure;
}

Figure measures_figure(const ProfileAnalysis& a) {
  const bool angles =
      std::ranges::all_of(a.sections, [](const auto& s) { return std::isfinite(s.contour.angle); });
  Figure figure{.id = "measures", .title = "Depth and width of the sections", .columns = 2};
  figure.caption = angles ? "Against the angle along the track." : "In the order of the tables.";
  for (const std::size_t c : {std::size_t{0}, std::size_t{1}}) {
    const Column& column = columns()[c];
    Panel panel{.x = {.title = angles ? "angle [deg]" : "section [-]"}, .y = {.title = column.title}};
    std::size_t i = 0;
    for (std::size_t r = 0; r < a.series.revolutions.size(); ++r) {
      const double revolution = a.series.revolutions[r];
      const bool last = r + 1 == a.series.revolutions.size();
      Series s{.kind = Series::Kind::markers,
               .name = std::isfinite(revolution) ? fmt::format("revolution {:g}", revolution) : std::string{},
               .colour = static_cast<int>(r % 8)};
      for (std::size_t k = 0; k < a.series.depths_mm[r].size(); ++k, ++i) {
        const MeasuredSection& section = a.sections[i];
        s.x.push_back(angles ? kDegrees * section.contour.angle : static_cast<double>(k + 1));
        s.y.push_back(column.value(section));
      }
      // Of many revolutions the last few: a legend has an end.
      if (last || r + 8 >= a.series.revolutions.size()) panel.series.push_back(std::move(s));
    }
    figure.panels.push_back(std::move(panel));
  }
  return figure;
}

Json json_number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json json_normality(const GrooveSeries& s) {
  const std::vector<std::string> names = io::normality_columns();
  Json rows = Json::array();
  for (std::size_t r = 0; r < s.revolutions.size(); ++r) {
    std::vector<double> cells{s.revolutions[r]};
    for (const auto* of : {&s.depths_mm[r], &s.widths_mm[r]}) {
      const auto values = io::normality_values(analysis::section_statistics(*of, s.ends));
      cells.insert(cells.end(), values.begin(), values.end());
    }
    Json row;
    for (std::size_t c = 0; c < names.size(); ++c) row[names[c]] = json_number(cells[c]);
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

ProfileAnalysis analyse_profiles(std::span<const io::ReadSection> sections, const ProfileOptions& options) {
  ProfileAnalysis out;
  out.options = options;
  for (const io::ReadSection& section : sections) out.sections.push_back(measure(section, options));
  std::ranges::stable_sort(out.sections, [](const MeasuredSection& a, const MeasuredSection& b) {
    return std::isnan(a.revolution) ? !std::isnan(b.revolution) : a.revolution < b.revolution;
  });
  out.series = series_of(out);
  return out;
}

std::vector<std::string> profile_warnings(const ProfileAnalysis& a) {
  std::vector<std::string> out;
  std::size_t rough = 0, cut = 0, shallow = 0;
  for (const MeasuredSection& s : a.sections) {
    rough += s.levelled.roughness > 0.5 * analysis::width_level(s.contour.depth) ? 1 : 0;
    cut += s.ends_in_groove ? 1 : 0;
    shallow += s.contour.depth > 0.0 && s.contour.width == 0.0 ? 1 : 0;
  }
  const std::size_t n = a.sections.size();
  if (rough > 0)
    out.push_back(
        fmt::format("{} of {} sections are so rough that the level of the width, max(1 % of the depth, 0.5 "
                    "um), lies within it: the "
                    "width may reach to the outermost scratch; --width-at DEPTH measures it deeper",
                    rough, n));
  if (cut > 0)
    out.push_back(fmt::format(
        "{} of {} sections end inside the groove (or the baseline lies too high): their width and "
        "area are too small",
        cut, n));
  if (shallow > 0)
    out.push_back(fmt::format("{} of {} sections are shallower than 0.5 um: they have no width", shallow, n));
  return out;
}

std::string profile_text(const ProfileAnalysis& a) {
  std::string text = baseline_sentence(a) + "\n\n" + aligned(sections_table(a), kTextRows);
  if (a.sections.size() > 1)
    text += "\n" + of_which_sections(a) + "\n" + aligned(summary_table(a), kTextRows);
  if (testable(a)) {
    text += "\n";
    for (const std::string& finding : statistics_findings(a.series)) text += finding + "\n";
  }
  return text;
}

std::string profile_json(const ProfileAnalysis& a) {
  Json json{{"baseline", baseline_name(a.options.baseline)}, {"sections", Json::array()}};
  for (const MeasuredSection& s : a.sections) {
    Json row{{"name", s.name},
             {"revolution", json_number(s.revolution)},
             {"angle_deg", json_number(kDegrees * s.contour.angle)},
             {"depth_mm", json_number(kMm * s.contour.depth)},
             {"width_mm", json_number(kMm * s.contour.width)},
             {"displaced_width_mm", json_number(kMm * s.contour.displaced_width)},
             {"area_mm2", json_number(kMm2 * s.contour.area)},
             {"offset_mm", json_number(kMm * s.levelled.offset)},
             {"tilt", json_number(s.levelled.tilt)},
             {"roughness_um", json_number(kUm * s.levelled.roughness)}};
    if (a.options.width_depth) row["width_at_depth_mm"] = json_number(kMm * s.width_at_depth);
    json["sections"].push_back(std::move(row));
  }
  json["normality"] = json_normality(a.series);
  json["findings"] = testable(a) ? Json(statistics_findings(a.series)) : Json::array();
  json["warnings"] = profile_warnings(a);
  return json.dump(2) + "\n";
}

Page profile_page(const ProfileAnalysis& a, const std::string& source) {
  const auto mean_sd = [&](const Column& column) {
    const analysis::Summary s = analysis::summarise(values(a, column));
    return s.count > 1 ? fmt::format("{} ± {}", number(s.mean), number(s.sd, 2)) : number(s.mean);
  };
  Page page{.title = "Profiles of " + source};
  page.summary = fmt::format("{}: depth {} µm, width {} mm, area {} mm².", of_which_sections(a),
                             mean_sd(columns()[0]), mean_sd(columns()[1]), mean_sd(columns()[3]));
  page.cards = {{"sections", std::to_string(a.sections.size())},
                {"depth", mean_sd(columns()[0]) + " µm"},
                {"width", mean_sd(columns()[1]) + " mm"},
                {"area", mean_sd(columns()[3]) + " mm²"}};
  if (a.options.track_radius)
    page.cards.emplace_back("worn volume", number(a.series.grown.front().values.back()) + " mm³");
  PageSection groove{.title = "The groove"};
  groove.items.emplace_back(Paragraph{baseline_sentence(a)});
  for (const std::string& warning : profile_warnings(a))
    groove.items.emplace_back(Paragraph{"Warning: " + warning + "."});
  groove.items.emplace_back(profile_figure(a));
  if (a.sections.size() > 1) {
    groove.items.emplace_back(measures_figure(a));
    groove.items.emplace_back(summary_table(a));
  }
  groove.items.emplace_back(sections_table(a));
  page.sections.push_back(std::move(groove));
  if (testable(a)) page.sections.push_back(statistics_section(a.series));
  return page;
}

}  // namespace abradem::report
