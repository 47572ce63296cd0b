// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "abradem/contact/mesh_candidates.h"

namespace abradem::simulation {

/// Where in a mesh's own frame a sphere may be near it: a bitmap that turns away almost all who are not, at
/// the price of one look-up.
class NearGrid {
 public:
  /// Makes the bitmap for spheres of at most this reach, unless the present one still holds.
  void update(const contact::SurfaceView& surface, double reach);
  [[nodiscard]] bool may_be_near(const Vec3& c) const noexcept {
    const double fx = (c.x - low_.x) * per_cell_, fy = (c.y - low_.y) * per_cell_,
                 fz = (c.z - low_.z) * per_cell_;
    if (!(fx >= 0.0 && fy >= 0.0 && fz >= 0.0 && fx < count_[0] && fy < count_[1] && fz < count_[2]))
      return false;
    const auto i = static_cast<std::size_t>(fx), j = static_cast<std::size_t>(fy),
               k = static_cast<std::size_t>(fz);
    return near_[(k * static_cast<std::size_t>(count_[1]) + j) * static_cast<std::size_t>(count_[0]) + i] !=
           0;
  }

 private:
  Vec3 low_;
  double per_cell_ = 0.0, reach_ = -1.0, allowed_ = 0.0;  // allowed_: wear that the bitmap allows for [m]
  double count_[3] = {0.0, 0.0, 0.0};
  std::vector<std::uint8_t> near_;
};

/// Distance from a point to the nearest triangle within `reach`, as the mesh is now; none: further away.
[[nodiscard]] std::optional<double> distance_within(const contact::SurfaceView& surface, const Vec3& c,
                                                    double reach);

/// Does a ray from c meet the surface first from its back? Where the surface bounds a solid: c is inside it.
[[nodiscard]] bool is_behind(const contact::SurfaceView& surface, const Vec3& c);

}  // namespace abradem::simulation
