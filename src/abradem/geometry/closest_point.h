// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "abradem/core/vec3.h"

namespace abradem::geometry {

/// Where on a triangle a point lies. Edge k runs from vertex k to vertex k + 1.
enum class Feature : std::uint8_t { face, edge0, edge1, edge2, vertex0, vertex1, vertex2 };

[[nodiscard]] constexpr bool is_edge(Feature f) noexcept {
  return f >= Feature::edge0 && f <= Feature::edge2;
}
[[nodiscard]] constexpr bool is_vertex(Feature f) noexcept { return f >= Feature::vertex0; }

struct ClosestPoint {
  Vec3 point;
  Feature feature = Feature::face;
};

/// The point of triangle a, b, c nearest to p, and the feature it lies on. A point on the border between two
/// features belongs to the smaller one (vertex before edge before face). Six dot products, no square root;
/// triangles without area are taken as the segment or point they are.
/// [Ericson, Real-Time Collision Detection, 2005, Sec. 5.1.5]
[[nodiscard]] ClosestPoint closest_point_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b,
                                                     const Vec3& c) noexcept;

/// Where the ray meets the plane of the triangle, in units of the direction, if that is inside the triangle;
/// a hair of tolerance keeps a ray through a shared edge from slipping between its two triangles.
[[nodiscard]] std::optional<double> ray_meets(const Vec3& from, const Vec3& direction,
                                              const Vec3 (&v)[3]) noexcept;

/// The point of segment a, b nearest to p, as the fraction of the way from a to b in [0, 1].
[[nodiscard]] double closest_fraction_on_segment(const Vec3& p, const Vec3& a, const Vec3& b) noexcept;

}  // namespace abradem::geometry
