// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/simulation/near_grid.h"

#include <algorithm>
#include <cmath>

#include "abradem/geometry/closest_point.h"

namespace abradem::simulation {

void NearGrid::update(const contact::SurfaceView& surface, double reach) {
  if (reach <= reach_ && surface.displaced <= allowed_) return;
  reach_ = reach;
  allowed_ = 2.0 * surface.displaced + 0.05 * reach;
  const double grow = reach_ + allowed_;
  const geometry::BoundingBox box = geometry::bounding_box(surface.mesh.vertices);
  low_ = box.low - Vec3{grow, grow, grow};
  const Vec3 extent = box.high + Vec3{grow, grow, grow} - low_;
  constexpr double kMostCells = 1 << 24;
  double cell = reach;
  const auto cells = [&](double length) { return std::floor(length / cell) + 1.0; };
  while (cells(extent.x) * cells(extent.y) * cells(extent.z) > kMostCells) cell *= 1.26;
  per_cell_ = 1.0 / cell;
  count_[0] = cells(extent.x), count_[1] = cells(extent.y), count_[2] = cells(extent.z);
  const auto nx = static_cast<std::size_t>(count_[0]), ny = static_cast<std::size_t>(count_[1]);
  near_.assign(nx * ny * static_cast<std::size_t>(count_[2]), 0);
  const auto cell_of = [&](double x, double low, double count) {
    return static_cast<std::size_t>(std::clamp(std::floor((x - low) * per_cell_), 0.0, count - 1.0));
  };
  for (const geometry::Triangle& t : surface.mesh.triangles) {
    Vec3 p[3];
    for (std::size_t k = 0; k < 3; ++k) p[k] = surface.mesh.vertices[static_cast<std::size_t>(t[k])];
    const geometry::BoundingBox around = geometry::bounding_box(p);
    const Vec3 normal = normalized(cross(p[1] - p[0], p[2] - p[0]));
    const double slab = grow + 0.5 * std::sqrt(3.0) * cell;  // of a cell's centre from the plane
    for (auto k = cell_of(around.low.z - grow, low_.z, count_[2]);
         k <= cell_of(around.high.z + grow, low_.z, count_[2]); ++k)
      for (auto j = cell_of(around.low.y - grow, low_.y, count_[1]);
           j <= cell_of(around.high.y + grow, low_.y, count_[1]); ++j)
        for (auto i = cell_of(around.low.x - grow, low_.x, count_[0]);
             i <= cell_of(around.high.x + grow, low_.x, count_[0]); ++i) {
          const Vec3 centre = low_ + cell * Vec3{static_cast<double>(i) + 0.5, static_cast<double>(j) + 0.5,
                                                 static_cast<double>(k) + 0.5};
          if (std::abs(dot(centre - p[0], normal)) <= slab) near_[(k * ny + j) * nx + i] = 1;
        }
  }
}

std::optional<double> distance_within(const contact::SurfaceView& surface, const Vec3& c, double reach) {
  const double grown = reach + surface.displaced;
  const Vec3 box{grown, grown, grown};
  double nearest2 = reach * reach;
  bool found = false;
  surface.grid.visit_near(
      c - box, c + box,
      [&](const Vec3& centre, const Vec3& half) {
        const auto beyond = [](double offset, double h) { return std::max(0.0, std::abs(offset) - h); };
        const Vec3 gap{beyond(c.x - centre.x, half.x), beyond(c.y - centre.y, half.y),
                       beyond(c.z - centre.z, half.z)};
        return norm2(gap) < grown * grown;
      },
      [&](geometry::Index t) {
        const geometry::Triangle& v = surface.mesh.triangles[static_cast<std::size_t>(t)];
        const auto at = [&](std::size_t k) { return surface.mesh.vertices[static_cast<std::size_t>(v[k])]; };
        const double d2 = norm2(c - geometry::closest_point_on_triangle(c, at(0), at(1), at(2)).point);
        if (d2 < nearest2) nearest2 = d2, found = true;
      });
  return found ? std::optional(std::sqrt(nearest2)) : std::nullopt;
}

bool is_behind(const contact::SurfaceView& surface, const Vec3& c) {
  const Vec3 ray = normalized(Vec3{1.0, 0.137, 0.0713});  // along no face or edge that anyone draws
  const geometry::BoundingBox box = surface.grid.box();
  const double reach = norm(box.high - box.low) + norm(c - box.low) + surface.displaced;
  const Vec3 end = c + reach * ray, grown{surface.displaced, surface.displaced, surface.displaced};
  double nearest = reach;
  bool behind = false;
  surface.grid.visit_near(
      c - grown, end + grown,
      [&](const Vec3& centre, const Vec3& half) {  // the slab test
        const Vec3 low = centre - half - grown, high = centre + half + grown;
        const double in =
            std::max({(low.x - c.x) / ray.x, (low.y - c.y) / ray.y, (low.z - c.z) / ray.z, 0.0});
        const double out = std::min({(high.x - c.x) / ray.x, (high.y - c.y) / ray.y, (high.z - c.z) / ray.z});
        return in <= out;
      },
      [&](geometry::Index t) {
        const geometry::Triangle& v = surface.mesh.triangles[static_cast<std::size_t>(t)];
        const auto at = [&](std::size_t k) { return surface.mesh.vertices[static_cast<std::size_t>(v[k])]; };
        const Vec3 corners[]{at(0), at(1), at(2)};
        const auto d = geometry::ray_meets(c, ray, corners);
        if (!d || *d < 0.0 || *d >= nearest) return;
        nearest = *d;
        behind = dot(cross(corners[1] - corners[0], corners[2] - corners[0]), ray) > 0.0;
      });
  return behind;
}

}  // namespace abradem::simulation
