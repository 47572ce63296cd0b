// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abradem/core/vec3.h"

namespace abradem::geometry {

/// Where a rigid body stands and how it moves: a turn about an axis through `pivot`, then a shift.
/// World x = turn (x_body - pivot) + pivot + shift.
struct Pose {
  Vec3 row0{1, 0, 0}, row1{0, 1, 0}, row2{0, 0, 1};  ///< rows of the rotation matrix
  Vec3 pivot, shift;
  Vec3 velocity;  ///< of the pivot [m/s]
  Vec3 spin;      ///< angular velocity [rad/s]

  [[nodiscard]] Vec3 turn(const Vec3& v) const noexcept { return {dot(row0, v), dot(row1, v), dot(row2, v)}; }
  [[nodiscard]] Vec3 turn_back(const Vec3& v) const noexcept { return v.x * row0 + v.y * row1 + v.z * row2; }
  [[nodiscard]] Vec3 to_world(const Vec3& p) const noexcept { return turn(p - pivot) + pivot + shift; }
  [[nodiscard]] Vec3 to_body(const Vec3& p) const noexcept { return turn_back(p - pivot - shift) + pivot; }
  /// Velocity of the body at a point given in the world [m/s].
  [[nodiscard]] Vec3 velocity_at(const Vec3& world) const noexcept {
    return velocity + cross(spin, world - pivot - shift);
  }
};

/// Rotation by an angle [rad] about a unit axis (Rodrigues).
[[nodiscard]] Pose rotation_pose(const Vec3& axis, const Vec3& pivot, double angle, double rate) noexcept;

/// The body is carried by `inner`, and that by `outer`: x = outer(inner(x_body)), with the velocities of
/// both.
[[nodiscard]] Pose compose(const Pose& outer, const Pose& inner) noexcept;

}  // namespace abradem::geometry
