// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/geometry/pose.h"

#include <cmath>

namespace abradem::geometry {

Pose rotation_pose(const Vec3& axis, const Vec3& pivot, double angle, double rate) noexcept {
  const double c = std::cos(angle), s = std::sin(angle), t = 1.0 - c;
  const auto& [x, y, z] = axis;
  Pose pose;
  pose.row0 = {t * x * x + c, t * x * y - s * z, t * x * z + s * y};
  pose.row1 = {t * x * y + s * z, t * y * y + c, t * y * z - s * x};
  pose.row2 = {t * x * z - s * y, t * y * z + s * x, t * z * z + c};
  pose.pivot = pivot;
  pose.spin = rate * axis;
  return pose;
}

Pose compose(const Pose& outer, const Pose& inner) noexcept {
  const Vec3 x = outer.turn({inner.row0.x, inner.row1.x, inner.row2.x}),
             y = outer.turn({inner.row0.y, inner.row1.y, inner.row2.y}),
             z = outer.turn({inner.row0.z, inner.row1.z, inner.row2.z});
  const Vec3 pivot = outer.to_world(inner.pivot + inner.shift);
  Pose pose;
  pose.row0 = {x.x, y.x, z.x};
  pose.row1 = {x.y, y.y, z.y};
  pose.row2 = {x.z, y.z, z.z};
  pose.pivot = inner.pivot;
  pose.shift = pivot - inner.pivot;
  pose.velocity = outer.velocity_at(pivot) + outer.turn(inner.velocity);
  pose.spin = outer.spin + outer.turn(inner.spin);
  return pose;
}

}  // namespace abradem::geometry
