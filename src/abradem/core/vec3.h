// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace abradem {

/// Cartesian vector; its unit is that of what it holds.
struct Vec3 {
  double x = 0.0, y = 0.0, z = 0.0;

  constexpr Vec3& operator+=(const Vec3& b) noexcept { return x += b.x, y += b.y, z += b.z, *this; }
  constexpr Vec3& operator-=(const Vec3& b) noexcept { return x -= b.x, y -= b.y, z -= b.z, *this; }
  constexpr Vec3& operator*=(double s) noexcept { return x *= s, y *= s, z *= s, *this; }
  constexpr bool operator==(const Vec3&) const noexcept = default;
};

constexpr Vec3 operator+(Vec3 a, const Vec3& b) noexcept { return a += b; }
constexpr Vec3 operator-(Vec3 a, const Vec3& b) noexcept { return a -= b; }
constexpr Vec3 operator-(const Vec3& a) noexcept { return {-a.x, -a.y, -a.z}; }
constexpr Vec3 operator*(Vec3 a, double s) noexcept { return a *= s; }
constexpr Vec3 operator*(double s, Vec3 a) noexcept { return a *= s; }
constexpr Vec3 operator/(const Vec3& a, double s) noexcept { return {a.x / s, a.y / s, a.z / s}; }

[[nodiscard]] constexpr double dot(const Vec3& a, const Vec3& b) noexcept {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
[[nodiscard]] constexpr Vec3 cross(const Vec3& a, const Vec3& b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
[[nodiscard]] constexpr double norm2(const Vec3& a) noexcept { return dot(a, a); }
[[nodiscard]] inline double norm(const Vec3& a) noexcept { return std::sqrt(norm2(a)); }
/// Unit vector along a; the zero vector stays zero.
[[nodiscard]] inline Vec3 normalized(const Vec3& a) noexcept {
  const double length = norm(a);
  return length > 0.0 ? a / length : Vec3{};
}
[[nodiscard]] inline bool is_finite(const Vec3& a) noexcept {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

}  // namespace abradem
