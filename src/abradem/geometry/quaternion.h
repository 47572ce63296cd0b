// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "abradem/core/vec3.h"

namespace abradem::geometry {

/// A rotation as a unit quaternion: from a body's own frame to the world.
struct Quaternion {
  double w = 1.0, x = 0.0, y = 0.0, z = 0.0;

  constexpr bool operator==(const Quaternion&) const noexcept = default;
  /// From the body's frame to the world.
  [[nodiscard]] Vec3 turn(const Vec3& v) const noexcept {
    const Vec3 u{x, y, z}, t = 2.0 * cross(u, v);
    return v + w * t + cross(u, t);
  }
  /// From the world to the body's frame.
  [[nodiscard]] Vec3 turn_back(const Vec3& v) const noexcept {
    const Vec3 u{-x, -y, -z}, t = 2.0 * cross(u, v);
    return v + w * t + cross(u, t);
  }
  [[nodiscard]] double norm2() const noexcept { return w * w + x * x + y * y + z * z; }
};

/// First b, then a.
[[nodiscard]] constexpr Quaternion operator*(const Quaternion& a, const Quaternion& b) noexcept {
  return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
          a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

[[nodiscard]] inline Quaternion normalized(const Quaternion& q) noexcept {
  const double per_length = 1.0 / std::sqrt(q.norm2());
  return {q.w * per_length, q.x * per_length, q.y * per_length, q.z * per_length};
}

/// The rotation that takes the axes x, y, z to a, b, c, which are orthonormal and right-handed.
[[nodiscard]] Quaternion quaternion_of(const Vec3& a, const Vec3& b, const Vec3& c) noexcept;

/// Uniform over all rotations, of three numbers that are uniform in [0, 1) [Shoemake 1992, Graphics Gems III,
/// p. 124].
[[nodiscard]] Quaternion uniform_rotation(double u0, double u1, double u2) noexcept;

}  // namespace abradem::geometry
