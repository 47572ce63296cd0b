// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "abradem/geometry/triangle_mesh.h"

namespace abradem::geometry {

/// One side of one triangle, filed under the smaller of its two vertices.
struct Side {
  Index low = 0, high = 0;  ///< its vertices, low < high
  Index triangle = 0;
  bool forward = false;  ///< the triangle runs along it from low to high
};

/// All sides of a mesh, those of the same edge next to each other, ordered by (low, high, triangle). Sides
/// from a vertex to itself are left out. O(n log valence).
[[nodiscard]] std::vector<Side> sorted_sides(const TriangleMesh& mesh);

/// The sides that belong to the same edge as the one at `begin`.
[[nodiscard]] std::span<const Side> sides_of_edge(std::span<const Side> sides, std::size_t begin) noexcept;

}  // namespace abradem::geometry
