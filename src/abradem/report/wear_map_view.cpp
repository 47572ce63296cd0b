// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/report/wear_map_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace abradem::report {
namespace {

constexpr std::array kQuantities{
    std::pair{"wear_depth_um", "wear depth [µm]"},
    std::pair{"wear_volume_um3", "wear volume [µm³]"},
    std::pair{"sliding_mm", "sliding distance [mm]"},
    std::pair{"shear_work_J", "work of friction [J]"},
    std::pair{"normal_work_J", "work lost along the normal [J]"},
    std::pair{"impacts", "impacts [-]"},
    std::pair{"impact_energy_J", "energy of the impacts [J]"},
    std::pair{"peak_pressure_MPa", "peak pressure [MPa]"},
    std::pair{"archard_um3", "Archard's volume [µm³]"},
    std::pair{"shear_work_um3", "volume by shear work [µm³]"},
    std::pair{"finnie_um3", "Finnie's volume [µm³]"},
    std::pair{"oka_um3", "Oka's volume [µm³]"},
    std::pair{"impact_energy_um3", "volume by impact energy [µm³]"},
    std::pair{"expression_um3", "volume by the expression [µm³]"},
};

const std::vector<double>* field(const io::VtpSurface& surface, const char* name) {
  const auto found = surface.cell_data.find(name);
  return found != surface.cell_data.end() && found->second.values.size() == surface.mesh.triangles.size()
             ? &found->second.values
             : nullptr;
}

/// All triangles, or where they are too many those under the greatest pressure, in their order.
std::vector<std::size_t> chosen(const io::VtpSurface& surface, std::size_t most) {
  std::vector<std::size_t> all(surface.mesh.triangles.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  if (all.size() <= most) return all;
  const std::vector<double>& pressure = *field(surface, "peak_pressure_MPa");
  std::ranges::stable_sort(all, std::greater{}, [&](std::size_t t) { return pressure[t]; });
  all.resize(most);
  std::ranges::sort(all);
  return all;
}

}  // namespace

std::optional<WearMapView> wear_map_view(const std::vector<WallFrame>& frames, std::size_t max_triangles) {
  std::vector<std::pair<std::string, io::VtpSurface>> walls;
  for (const WallFrame& frame : frames) {
    io::VtpSurface surface = io::read_vtp(frame.file);
    if (field(surface, "peak_pressure_MPa") != nullptr) walls.emplace_back(frame.name, std::move(surface));
  }
  if (walls.empty()) return std::nullopt;
  WearMapView view;
  for (const auto& [key, title] : kQuantities) view.quantities.push_back({key, title, {}});
  for (const auto& mapped : walls) {
    const io::VtpSurface& surface = mapped.second;
    WearMapView::Wall& wall = view.walls.emplace_back();
    wall.name = mapped.first;
    wall.first_vertex = view.x_mm.size();
    wall.first_triangle = view.i.size();
    wall.mesh_triangles = surface.mesh.triangles.size();
    const std::vector<std::size_t> triangles = chosen(surface, max_triangles / walls.size());
    std::vector<std::int32_t> number(surface.mesh.vertices.size(), -1);
    const auto vertex = [&](geometry::Index v) {
      std::int32_t& n = number[static_cast<std::size_t>(v)];
      if (n < 0) {
        n = static_cast<std::int32_t>(view.x_mm.size());
        const Vec3 p = 1e3 * surface.mesh.vertices[static_cast<std::size_t>(v)];
        view.x_mm.push_back(static_cast<float>(p.x));
        view.y_mm.push_back(static_cast<float>(p.y));
        view.z_mm.push_back(static_cast<float>(p.z));
      }
      return n;
    };
    for (const std::size_t t : triangles) {
      const geometry::Triangle& corners = surface.mesh.triangles[t];
      view.i.push_back(vertex(corners[0]));
      view.j.push_back(vertex(corners[1]));
      view.k.push_back(vertex(corners[2]));
    }
    for (WearMapView::Quantity& quantity : view.quantities) {
      const std::vector<double>* values = field(surface, quantity.key.c_str());
      for (const std::size_t t : triangles) quantity.values.push_back(values != nullptr ? (*values)[t] : 0.0);
    }
    wall.vertices = view.x_mm.size() - wall.first_vertex;
    wall.triangles = triangles.size();
  }
  std::erase_if(view.quantities, [](const WearMapView::Quantity& q) {
    return std::ranges::none_of(q.values, [](double v) { return v > 0.0; });
  });
  return view.quantities.empty() ? std::nullopt : std::optional(std::move(view));
}

}  // namespace abradem::report
