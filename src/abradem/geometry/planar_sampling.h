// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "abradem/geometry/delaunay.h"

namespace abradem::geometry {

/// A flat region, in units of the wanted edge length: a ring (inner > 0), a disc (inner = 0) or, when
/// half_length > 0, a rectangle; centred on the origin.
struct PlanarRegion {
  double inner = 0.0, outer = 0.0;
  double half_length = 0.0, half_width = 0.0;

  [[nodiscard]] bool is_rectangle() const noexcept { return half_length > 0.0; }
  /// Distance from p to the nearest border; negative outside.
  [[nodiscard]] double depth(Point2 p) const noexcept;
};

/// Points for an unstructured, near-equilateral triangulation of a region with edges of about 1.
struct PlanarSample {
  std::vector<Point2> points;  ///< along a Hilbert curve, so neighbours are near in memory; `centre` is last
  std::vector<char> is_free;   ///< 1: may be smoothed; 0: on a border, or the centre of a ring
  std::vector<Index> polygon;  ///< the outer border, counter-clockwise
  Index centre = 0;            ///< ring: an auxiliary point in the hole; else an ordinary point of the mesh
};

/// Borders get equally spaced points from a random phase (a rectangle its corners). The inside is a
/// polycrystal: grains of about twelve edges across, the Voronoi cells of jittered seeds, each holding a
/// triangular lattice of its own random orientation and offset. So no direction is favoured along any path
/// longer than a few grains, and inside a grain triangles are equilateral. Points nearer than 0.65 to one
/// that is already there are left out.
[[nodiscard]] PlanarSample sample_region(const PlanarRegion& region, std::uint64_t seed);

/// The order for inserting the points into a Delaunay triangulation: random rounds, each twice as large as
/// the one before and each along the curve [Amenta, Choi & Rote 2003]: O(n log n), short walks.
[[nodiscard]] std::vector<Index> insertion_order(Index count, std::uint64_t seed);

/// The point of the unit circle at the given fraction of a turn in [0, 1). Own series, so that the bits do
/// not depend on the mathematical library.
[[nodiscard]] Point2 unit_circle(double turn) noexcept;

}  // namespace abradem::geometry
