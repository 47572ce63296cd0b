// SPDX-License-Identifier: BSD-3-Clause
// Maps of what the walls suffer. docs/theory/wear.md#maps
#include <fmt/core.h>

#include <algorithm>

#include "abradem/core/error.h"
#include "abradem/simulation/simulation.h"

namespace abradem::simulation {

namespace {

std::size_t at(std::int32_t i) noexcept { return static_cast<std::size_t>(i); }

bool inside(const RegionSetup& region, const Vec3& p) noexcept {
  const Vec3 &a = region.low, &b = region.high;
  return p.x >= a.x && p.x <= b.x && p.y >= a.y && p.y <= b.y && p.z >= a.z && p.z <= b.z;
}

/// The first region of each element's wall that holds its centre; behind the last: the rest of the wall.
std::vector<std::uint16_t> region_of_elements(const geometry::TriangleMesh& mesh,
                                              const std::vector<RegionSetup>& regions,
                                              const std::string& wall) {
  std::vector<std::uint16_t> of;
  of.reserve(mesh.triangles.size());
  for (const geometry::Triangle& v : mesh.triangles) {
    const Vec3 centre =
        (mesh.vertices[at(v[0])] + mesh.vertices[at(v[1])] + mesh.vertices[at(v[2])]) * (1.0 / 3.0);
    std::uint16_t k = 0;  // the case reader allows fewer than 65536
    bool found = false;
    for (const RegionSetup& region : regions) {
      if (region.wall != wall) continue;
      found = inside(region, centre);
      if (found) break;
      ++k;
    }
    of.push_back(k);
  }
  return of;
}

}  // namespace

/// Books on the map what a contact did where it has landed. What lies at a node is of the triangles around
/// it, each by its part of the node's area, as in book_elements.
void SphereWall::map_landed(const MapLayer& map, const Landing& landing,
                            const wear::MapSample& sample) const {
  if (landing.nowhere()) return;
  wear::WearMap::Booking booking(*map.map, *map.layer, sample);
  for (const WearShare& s : landing.triangles) booking.add(at(s.triangle), s.whole, s.area);
  if (landing.nodes != nullptr) {
    const wear::FootprintShares& shares = *landing.nodes;
    static thread_local std::vector<double> density;  // at each candidate node [1/m^2]
    density.assign(candidates_.node_count(), 0.0);
    for (std::size_t i = 0; i < shares.at_node.size() && i < density.size(); ++i)
      density[i] = shares.at_node[i] / (3.0 * shares.total * candidates_.node_area[i]);
    for (std::size_t t = 0; t < candidates_.triangle_count(); ++t) {
      const double share =
          (density[at(candidates_.v0[t])] + density[at(candidates_.v1[t])] + density[at(candidates_.v2[t])]) *
          candidates_.area[t];
      if (share > 0.0) booking.add(at(candidates_.triangle[t]), share, candidates_.area[t]);
    }
  }
  booking.finish();
}

/// A map for each triangulated wall that something wears, where maps are asked for.
void Simulation::choose_maps() {
  maps_.resize(walls_.size());
  for (const RegionSetup& region : setup_.regions)
    if (std::ranges::find(setup_.walls, region.wall, &WallSetup::name) == setup_.walls.end())
      throw InputError(fmt::format("region '{}': there is no wall named '{}'", region.name, region.wall));
  const Maps maps = setup_.output.maps;
  if (maps == Maps::on && ploughs())
    throw InputError("output.maps: what [ploughing] moves aside has no map; use maps = \"off\"");
  if (maps == Maps::off || ploughs() || (maps == Maps::automatic && setup_.insertions.empty())) return;
  std::vector<std::string> materials;
  for (const ParticleSetup& p : setup_.particles) materials.push_back(p.material);
  for (const InsertionSetup& i : setup_.insertions) materials.push_back(i.material);
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    if (walls_[w].is_plane()) continue;
    const std::string& worn = walls_[w].setup().material;
    std::vector<int> abraders;
    for (std::size_t m = 0; m < setup_.materials.size(); ++m) {
      const std::string& name = setup_.materials[m].name;
      const bool wears = std::ranges::any_of(
          setup_.wear, [&](const WearSetup& s) { return s.abrader == name && s.worn == worn; });
      if (wears && std::ranges::find(materials, name) != materials.end())
        abraders.push_back(static_cast<int>(m));
    }
    if (abraders.empty()) continue;
    const geometry::TriangleMesh& mesh = walls_[w].surface().mesh();
    maps_[w].emplace(mesh.triangles.size(), abraders,
                     region_of_elements(mesh, setup_.regions, walls_[w].setup().name), regions_of(w).size());
    if (setup_.run.method == Method::dynamic) walls_[w].watch_impacts();
  }
}

MapLayer Simulation::map_layer(std::size_t wall, int abrader) noexcept {
  if (!maps_[wall]) return {};
  wear::WearMap::Layer* layer = maps_[wall]->layer(abrader);
  return layer != nullptr ? MapLayer{&*maps_[wall], layer} : MapLayer{};
}

std::vector<std::string> Simulation::regions_of(std::size_t wall) const {
  std::vector<std::string> names;
  for (const RegionSetup& region : setup_.regions)
    if (region.wall == walls_[wall].setup().name) names.push_back(region.name);
  names.push_back(walls_[wall].setup().name);
  return names;
}

wear::MechanismVolumes Simulation::mapped_volumes(std::size_t wall, std::size_t element) const {
  wear::MechanismVolumes sum{};
  for (const wear::WearMap::Layer& layer : maps_[wall]->layers()) {
    const wear::WearMap::Element& e = layer.elements[element];
    const wear::MechanismVolumes v =
        wear::mapped_volumes(wear_laws(layer.abrader, walls_[wall].material()), e);
    for (std::size_t m = 0; m < sum.size(); ++m) sum[m] += v[m];
  }
  return sum;
}

}  // namespace abradem::simulation
