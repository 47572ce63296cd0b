// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/geometry/quaternion.h"

#include <numbers>

namespace abradem::geometry {

Quaternion quaternion_of(const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
  // Each component squared is a sum of diagonal elements; the largest of them is divided by.
  const double trace = a.x + b.y + c.z;
  if (trace > 0.0) return normalized(Quaternion{1.0 + trace, b.z - c.y, c.x - a.z, a.y - b.x});
  if (a.x >= b.y && a.x >= c.z)
    return normalized(Quaternion{b.z - c.y, 1.0 + a.x - b.y - c.z, b.x + a.y, c.x + a.z});
  if (b.y >= c.z) return normalized(Quaternion{c.x - a.z, b.x + a.y, 1.0 - a.x + b.y - c.z, c.y + b.z});
  return normalized(Quaternion{a.y - b.x, c.x + a.z, c.y + b.z, 1.0 - a.x - b.y + c.z});
}

Quaternion uniform_rotation(double u0, double u1, double u2) noexcept {
  constexpr double kTwoPi = 2.0 * std::numbers::pi;
  const double r = std::sqrt(1.0 - u0), s = std::sqrt(u0);
  return normalized(Quaternion{s * std::cos(kTwoPi * u2), r * std::sin(kTwoPi * u1),
                               r * std::cos(kTwoPi * u1), s * std::sin(kTwoPi * u2)});
}

}  // namespace abradem::geometry
