// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/report/walls_section.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "abradem/report/text.h"

namespace abradem::report {
namespace {

using namespace std::string_view_literals;
using Kind = Series::Kind;

constexpr std::array kLaws{std::pair{"archard_mm3"sv, "Archard"sv},
                           std::pair{"shear_work_mm3"sv, "shear work"sv},
                           std::pair{"finnie_mm3"sv, "Finnie"sv},
                           std::pair{"oka_mm3"sv, "Oka"sv},
                           std::pair{"impact_energy_mm3"sv, "impact energy"sv},
                           std::pair{"expression_mm3"sv, "expression"sv}};

std::string name_of(const RunFolder& run, double wall) {
  const auto w = static_cast<std::size_t>(wall);
  return w < run.manifest.walls.size() ? run.manifest.walls[w] : fmt::format("wall {}", w);
}

/// Walls that a table names, ascending.
std::set<double> walls_in(const Table& table) { return {table["wall"].begin(), table["wall"].end()}; }

/// One row's value against time for one wall.
template <typename Value>
Series over_time(const Table& table, double wall, std::string name, int colour, const Value& value) {
  Series series{.kind = Kind::line, .name = std::move(name), .colour = colour % 8};
  for (std::size_t r = 0; r < table.rows(); ++r) {
    if (table["wall"][r] != wall) continue;
    series.x.push_back(table["time_s"][r]);
    series.y.push_back(value(r));
  }
  return series;
}

/// Length of a vector in three columns.
auto length(const Table& t, std::string_view x, std::string_view y, std::string_view z) {
  return [&t, x, y, z](std::size_t r) { return std::hypot(t[x][r], t[y][r], t[z][r]); };
}

Figure loads(const RunFolder& run) {
  const Table& table = *run.walls;
  Figure figure{.id = "wall-loads",
                .title = "Loads on the walls",
                .caption =
                    "Of all particles, at single steps. Torque: about the centre of the wall's motion, or "
                    "about the origin. Power: what the wall spends on the particles. Components: "
                    "tables/walls.csv.",
                .columns = 2};
  const Axis time{.title = "time [s]"};
  Panel force{.title = "Force", .x = time, .y = {.title = "force [N]"}};
  Panel torque{.title = "Torque", .x = time, .y = {.title = "torque [N m]"}};
  Panel power{.title = "Power", .x = time, .y = {.title = "power [W]"}};
  int colour = 0;
  bool works = false;
  for (const double wall : walls_in(table)) {
    const std::string name = name_of(run, wall);
    force.series.push_back(
        over_time(table, wall, name, colour, length(table, "force_x_N", "force_y_N", "force_z_N")));
    torque.series.push_back(
        over_time(table, wall, name, colour, length(table, "torque_x_Nm", "torque_y_Nm", "torque_z_Nm")));
    Series spent = over_time(table, wall, name, colour, [&](std::size_t r) { return table["power_W"][r]; });
    if (std::ranges::any_of(spent.y, [](double p) { return p != 0.0; })) {
      works = true;
      power.series.push_back(std::move(spent));
    }
    ++colour;
  }
  figure.panels = {std::move(force), std::move(torque)};
  if (works) figure.panels.push_back(std::move(power));
  return figure;
}

DataTable volumes(const RunFolder& run) {
  const Table& table = *run.laws;
  DataTable out{.id = "law-volumes",
                .title = "Volume worn, by law",
                .caption =
                    "At the end of the run. The sum over the meshes is the law volume of the ledger; "
                    "analytic planes keep their shape and stand outside it.",
                .columns = {"wall"}};
  std::vector<std::string_view> used;
  for (const auto& [column, law] : kLaws)
    if (std::ranges::any_of(table[column], [](double v) { return v > 0.0; })) {
      used.push_back(column);
      out.columns.push_back(fmt::format("{} [mm³]", law));
    }
  out.columns.insert(out.columns.end(), {"sum [mm³]", "impacts [-]"});
  const std::size_t walls = walls_in(table).size();
  for (std::size_t r = table.rows() - walls; r < table.rows(); ++r) {
    std::vector<std::string> cells{name_of(run, table["wall"][r])};
    double sum = 0.0;
    for (const std::string_view column : used) {
      sum += table[column][r];
      cells.push_back(readable(table[column][r]));
    }
    cells.push_back(readable(sum));
    cells.push_back(readable_count(static_cast<long long>(table["impacts"][r])));
    out.rows.push_back(std::move(cells));
  }
  return out;
}

Figure growth(const RunFolder& run) {
  const Table& table = *run.laws;
  Figure figure{.id = "law-growth",
                .title = "Wear over time, by law",
                .caption = "Volume that the laws have taken from each wall since the start.",
                .columns = 2};
  for (const double wall : walls_in(table)) {
    Panel panel{.title = name_of(run, wall), .x = {.title = "time [s]"}, .y = {.title = "volume [mm³]"}};
    for (std::size_t k = 0; k < kLaws.size(); ++k) {
      const auto& values = table[kLaws[k].first];
      Series series = over_time(table, wall, std::string(kLaws[k].second), static_cast<int>(k),
                                [&](std::size_t r) { return values[r]; });
      if (std::ranges::any_of(series.y, [](double v) { return v > 0.0; }))
        panel.series.push_back(std::move(series));
    }
    if (!panel.series.empty()) figure.panels.push_back(std::move(panel));
  }
  return figure;
}

/// Erosion per mass by angle on one wall: what was found, and the law for the mean impact.
Figure erosion(const RunFolder& run, double wall) {
  const Table &impacts = *run.impacts, &law = *run.erosion;
  Figure figure{.id = fmt::format("erosion-{}", static_cast<int>(wall)),
                .title = fmt::format("Erosion of '{}' against the angle of impact", name_of(run, wall))};
  Panel volume{
      .title = "Erosion", .x = {.title = "angle of impact [deg]"}, .y = {.title = "erosion [mm³/kg]"}};
  Panel number{.title = "Impacts", .x = {.title = "angle of impact [deg]"}, .y = {.title = "impacts [-]"}};
  volume.x.range = number.x.range = std::array{0.0, 92.0};  // room for the marker at 90
  double speed = 0.0;
  for (const auto& [found, curve, name, colour] :
       {std::tuple{"finnie_mm3"sv, "finnie_mm3_per_kg"sv, "Finnie"sv, 0},
        std::tuple{"oka_mm3"sv, "oka_mm3_per_kg"sv, "Oka"sv, 1},
        std::tuple{"expression_mm3"sv, "expression_mm3_per_kg"sv, "expression"sv, 3}}) {
    Series points{
        .kind = Kind::markers, .name = fmt::format("{}, impacts of the run", name), .colour = colour};
    for (std::size_t r = 0; r < impacts.rows(); ++r) {
      if (impacts["wall"][r] != wall || !(impacts[found][r] > 0.0)) continue;
      points.x.push_back(impacts["angle_mean_deg"][r]);
      points.y.push_back(impacts[found][r] / impacts["mass_kg"][r]);
    }
    if (points.x.empty()) continue;
    std::set<double> abraders;
    for (std::size_t r = 0; r < law.rows(); ++r)
      if (law["wall"][r] == wall && law[curve][r] > 0.0) abraders.insert(law["abrader"][r]);
    for (const double abrader : abraders) {
      Series line{.kind = Kind::line, .name = fmt::format("{}, the law", name), .colour = colour};
      for (std::size_t r = 0; r < law.rows(); ++r) {
        if (law["wall"][r] != wall || law["abrader"][r] != abrader) continue;
        line.x.push_back(law["angle_deg"][r]);
        line.y.push_back(law[curve][r]);
        speed = law["speed_m_per_s"][r];
      }
      volume.series.push_back(std::move(line));
    }
    volume.series.push_back(std::move(points));
  }
  Series count{.kind = Kind::bars, .colour = 2};
  for (std::size_t r = 0; r < impacts.rows(); ++r) {
    if (impacts["wall"][r] != wall) continue;
    count.x.push_back(impacts["angle_mean_deg"][r]);
    count.y.push_back(impacts["impacts"][r]);
  }
  number.series = {std::move(count)};
  figure.caption = fmt::format(
      "Volume per mass of what struck at an angle from the surface, in classes of 2.5°. Lines: the laws at "
      "the mean "
      "speed of all impacts, {} m/s.",
      readable(speed, 3));
  figure.panels = {std::move(volume), std::move(number)};
  figure.columns = 2;
  return figure;
}

}  // namespace

std::optional<PageSection> walls_section(const RunFolder& run) {
  PageSection section{.title = "Walls"};
  if (run.laws && run.laws->rows() > 0) {
    section.items.emplace_back(volumes(run));
    if (Figure figure = growth(run); !figure.panels.empty()) section.items.emplace_back(std::move(figure));
    if (run.impacts && run.erosion)
      for (const double wall : walls_in(*run.impacts)) section.items.emplace_back(erosion(run, wall));
  }
  if (run.walls && run.walls->rows() > 0 && run.particles) section.items.emplace_back(loads(run));
  if (section.items.empty()) return std::nullopt;
  return section;
}

}  // namespace abradem::report
