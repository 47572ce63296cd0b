// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/report/flow_page.h"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <utility>

#include "abradem/report/text.h"

namespace abradem::report {
namespace {

using Kind = Series::Kind;

constexpr double kMm = 1e3;
const Axis kDistance{.title = "distance along the line [mm]"};

template <class Value>
Series along(const FlowSummary& s, std::string name, int colour, Value&& value) {
  Series series{.kind = Kind::line_markers, .name = std::move(name), .colour = colour};
  for (const analysis::FlowBin& bin : s.bins) {
    series.x.push_back(kMm * bin.distance);
    series.y.push_back(value(bin));
  }
  return series;
}

Figure velocities(const FlowSummary& s) {
  Figure figure{.id = "flow-velocity",
                .title = "Mean velocity",
                .caption = "Of the particles of each part of the line, over all frames taken."};
  Panel panel{.x = kDistance, .y = {.title = "velocity [m/s]"}};
  if (!s.component.empty()) {
    Series band{.kind = Kind::band, .name = "± fluctuation"};
    for (const analysis::FlowBin& bin : s.bins) {
      const double v = dot(bin.velocity, s.direction);
      band.x.push_back(kMm * bin.distance);
      band.y_low.push_back(v - bin.fluctuation);
      band.y_high.push_back(v + bin.fluctuation);
    }
    panel.series.push_back(std::move(band));
    panel.series.push_back(
        along(s, s.component, 0, [&](const analysis::FlowBin& b) { return dot(b.velocity, s.direction); }));
    figure.caption += " The band is as wide as single particles scatter about the mean (rms).";
  } else {
    panel.series = {along(s, "x", 0, [](const analysis::FlowBin& b) { return b.velocity.x; }),
                    along(s, "y", 1, [](const analysis::FlowBin& b) { return b.velocity.y; }),
                    along(s, "z", 2, [](const analysis::FlowBin& b) { return b.velocity.z; })};
  }
  for (const FlowSummary::Points& points : s.measured) {
    Series series{.kind = Kind::markers, .name = points.name, .y = points.velocity, .theirs = true};
    for (const double d : points.distance) series.x.push_back(kMm * d);
    panel.series.push_back(std::move(series));
  }
  figure.panels = {std::move(panel)};
  return figure;
}

Figure particles(const FlowSummary& s) {
  Figure figure{.id = "flow-particles",
                .title = "Fluctuation and number",
                .caption =
                    "Fluctuation: root mean square of one component of the velocity about its mean. "
                    "Number: of particles in a part of the line, mean of the frames.",
                .columns = 2};
  Panel scatter{.title = "Fluctuation", .x = kDistance, .y = {.title = "fluctuation [m/s]"}};
  scatter.series = {along(s, "", 3, [](const analysis::FlowBin& b) { return b.fluctuation; })};
  Panel number{.title = "Particles", .x = kDistance, .y = {.title = "particles in a frame [-]"}};
  number.series = {along(
      s, "", 4, [&](const analysis::FlowBin& b) { return static_cast<double>(b.samples) / s.moments; })};
  figure.panels = {std::move(scatter), std::move(number)};
  return figure;
}

DataTable numbers(const FlowSummary& s) {
  DataTable table{.id = "flow-profile", .title = "Velocities along the line"};
  table.columns = {"distance [mm]", "particles [-]", "x [m/s]", "y [m/s]", "z [m/s]", "fluctuation [m/s]"};
  if (!s.component.empty()) table.columns.push_back(s.component + " [m/s]");
  for (const analysis::FlowBin& b : s.bins) {
    std::vector<std::string> row{readable(kMm * b.distance),
                                 readable(static_cast<double>(b.samples) / s.moments)};
    for (const double v : {b.velocity.x, b.velocity.y, b.velocity.z, b.fluctuation})
      row.push_back(std::isfinite(v) ? readable(v) : "–");
    if (!s.component.empty()) row.push_back(b.samples > 0 ? readable(dot(b.velocity, s.direction)) : "–");
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

Page flow_page(const FlowSummary& s) {
  Page page{.title = s.title, .summary = s.sentence};
  PageSection section{.title = "Flow along a line"};
  section.items.emplace_back(velocities(s));
  section.items.emplace_back(particles(s));
  section.items.emplace_back(numbers(s));
  page.sections.push_back(std::move(section));
  return page;
}

}  // namespace abradem::report
