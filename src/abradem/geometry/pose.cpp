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

}  // namespace abradem::geometry
