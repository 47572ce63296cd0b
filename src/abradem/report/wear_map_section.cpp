// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/report/wear_map_section.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "abradem/report/page_parts.h"
#include "abradem/report/page_source.h"
#include "abradem/report/text.h"

namespace abradem::report {
namespace {

constexpr std::size_t kPlaces = 10;
constexpr double kApart = 0.05;  // of the wall's extent: what is nearer is the same place
constexpr double kHour = 3600.0;

std::string name_of(const RunFolder& run, double wall) {
  const auto w = static_cast<std::size_t>(wall);
  return w < run.manifest.walls.size() ? run.manifest.walls[w] : fmt::format("wall {}", w);
}

std::optional<double> thickness_um(const RunFolder& run, double wall) {
  const auto w = static_cast<std::size_t>(wall);
  if (w >= run.manifest.thickness_mm.size() || !run.manifest.thickness_mm[w]) return std::nullopt;
  return 1e3 * *run.manifest.thickness_mm[w];
}

/// Rows of the deepest elements, each in a place of its own.
std::vector<std::size_t> worst_places(const Table& t) {
  const auto &x = t["x_mm"], &y = t["y_mm"], &z = t["z_mm"], &depth = t["wear_depth_um"], &wall = t["wall"];
  std::vector<std::size_t> rows(t.rows());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  std::ranges::stable_sort(rows, std::greater{}, [&](std::size_t r) { return depth[r]; });
  const auto extent = [](const std::vector<double>& v) {
    const auto [low, high] = std::ranges::minmax(v);
    return high - low;
  };
  if (rows.empty()) return rows;
  const double apart = kApart * std::hypot(extent(x), extent(y), extent(z));
  std::vector<std::size_t> places;
  for (const std::size_t r : rows) {
    if (places.size() == kPlaces || !(depth[r] > 0.0)) break;
    const bool near = std::ranges::any_of(places, [&](std::size_t p) {
      return wall[p] == wall[r] && std::hypot(x[p] - x[r], y[p] - y[r], z[p] - z[r]) < apart;
    });
    if (!near) places.push_back(r);
  }
  return places;
}

DataTable places_table(const RunFolder& run) {
  const Table& t = *run.wear;
  const double settle = run.manifest.settle_s;
  const double hours = run.revolutions.rows() > 0 ? (run.revolutions["time_s"].back() - settle) / kHour : 0.0;
  const std::vector<std::size_t> places = worst_places(t);
  const bool liner =
      std::ranges::any_of(places, [&](std::size_t r) { return thickness_um(run, t["wall"][r]).has_value(); });
  DataTable out{
      .id = "wear-places",
      .title = "Where the walls wear most",
      .caption =
          "The deepest element of each place; places are a twentieth of the worn extent apart. "
          "Rates are means over the run, with the wear coefficients of the case" +
          (settle > 0.0 ? fmt::format(", after the {} s in which the flow settles.", readable(settle))
                        : std::string(".")),
      .columns = {"wall", "element", "x, y, z [mm]", "depth [µm]", "rate [mm/h]"}};
  if (liner) out.columns.emplace_back("worn through after [h]");
  out.columns.insert(out.columns.end(), {"sliding [mm]", "impacts [-]", "peak pressure [MPa]"});
  for (const std::size_t r : places) {
    const double depth = t["wear_depth_um"][r], rate = hours > 0.0 ? depth / hours : 0.0;
    std::vector<std::string> row{
        name_of(run, t["wall"][r]), fmt::format("{}", static_cast<long long>(t["element"][r])),
        fmt::format("{}, {}, {}", readable(t["x_mm"][r]), readable(t["y_mm"][r]), readable(t["z_mm"][r])),
        readable(depth), readable(1e-3 * rate)};
    if (liner) {
      const std::optional<double> thickness = thickness_um(run, t["wall"][r]);
      row.push_back(thickness && rate > 0.0 ? readable(*thickness / rate) : "–");
    }
    row.push_back(readable(t["sliding_mm"][r]));
    row.push_back(readable_count(std::llround(t["impacts"][r])));
    row.push_back(readable(t["peak_pressure_MPa"][r]));
    out.rows.push_back(std::move(row));
  }
  return out;
}

DataTable by_mechanism(const RunFolder& run) {
  const Table& t = *run.wear;
  DataTable out{.id = "wear-mechanisms",
                .title = "What wore the walls",
                .caption =
                    "Sums over the elements of each wall. Work of friction: what sliding contacts lost; "
                    "along the normal: what their damping lost.",
                .columns = {"wall", "volume [mm³]", "work of friction [J]", "work along the normal [J]",
                            "impacts [-]", "energy of the impacts [J]", "worn area [mm²]"}};
  for (const double wall : std::set<double>(t["wall"].begin(), t["wall"].end())) {
    const auto sum = [&](const char* column) {
      double total = 0.0;
      for (std::size_t r = 0; r < t.rows(); ++r)
        if (t["wall"][r] == wall) total += t[column][r];
      return total;
    };
    double area = 0.0;
    for (std::size_t r = 0; r < t.rows(); ++r)
      if (t["wall"][r] == wall && t["wear_volume_mm3"][r] > 0.0) area += t["area_mm2"][r];
    out.rows.push_back({name_of(run, wall), readable(sum("wear_volume_mm3")), readable(sum("shear_work_J")),
                        readable(sum("normal_work_J")), readable_count(std::llround(sum("impacts"))),
                        readable(sum("impact_energy_J")), readable(area)});
  }
  return out;
}

template <class Number>
double step_of(const std::vector<Number>& values) {
  constexpr double kSteps = 1e6;  // the largest value is as many of them
  const double largest = values.empty() ? 0.0 : *std::ranges::max_element(values);
  return largest > 0.0 ? largest / kSteps : 1.0;
}

}  // namespace

std::optional<PageSection> wear_map_section(const RunFolder& run) {
  if (!run.wear || run.wear->rows() == 0) return std::nullopt;
  PageSection section{.title = "Worst places and mechanisms"};
  DataTable places = places_table(run);
  if (!places.rows.empty()) section.items.emplace_back(std::move(places));
  section.items.emplace_back(by_mechanism(run));
  return section;
}

WearMapFigure wear_map_figure(const RunFolder& run, int number) {
  if (!run.wear_map) return {"", "null", ""};
  constexpr double kPosition_mm = 1e-3;
  const WearMapView& view = *run.wear_map;
  WearMapFigure out;
  std::string walls, quantities, facts_walls, facts_quantities;
  for (const WearMapView::Wall& w : view.walls) {
    const std::size_t n = static_cast<std::size_t>(&w - view.walls.data());
    walls += fmt::format("<option value=\"{}\">{}</option>", n, escape_html(w.name));
    facts_walls += fmt::format(
        R"({}{{"name":{},"vertices":[{},{}],"triangles":[{},{}],"mesh_triangles":{}}})", n > 0 ? "," : "",
        json_string(w.name), w.first_vertex, w.vertices, w.first_triangle, w.triangles, w.mesh_triangles);
  }
  out.data += data_block("wm-x", pack_numbers(view.x_mm, kPosition_mm)) +
              data_block("wm-y", pack_numbers(view.y_mm, kPosition_mm)) +
              data_block("wm-z", pack_numbers(view.z_mm, kPosition_mm)) +
              data_block("wm-i", pack_numbers(view.i, 1.0)) + data_block("wm-j", pack_numbers(view.j, 1.0)) +
              data_block("wm-k", pack_numbers(view.k, 1.0));
  for (const WearMapView::Quantity& q : view.quantities) {
    const double step = step_of(q.values);
    quantities += fmt::format("<option value=\"{}\">{}</option>", q.key, escape_html(q.title));
    facts_quantities +=
        fmt::format(R"({}{{"key":{},"title":{},"step":{}}})", facts_quantities.empty() ? "" : ",",
                    json_string(q.key), json_string(q.title), json_number(step));
    out.data += data_block("wm-" + q.key, pack_numbers(q.values, step));
  }
  out.facts = fmt::format(R"({{"position_step":{},"walls":[{}],"quantities":[{}]}})",
                          json_number(kPosition_mm), facts_walls, facts_quantities);
  out.html = fill(wear_map_body(),
                  {{"walls", walls}, {"quantities", quantities}, {"number", std::to_string(number)}});
  return out;
}

}  // namespace abradem::report
