// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abradem/geometry/triangle_mesh.h"

namespace abradem::geometry {

/// Vertices nearer than this part of the mean edge are one and the same: above the rounding of a writer that
/// computed shared corners twice, far below anything that was meant.
inline constexpr double kWeldTolerance = 1e-6;

/// Merges vertices with equal coordinates, then those within `relative_tolerance` times the mean edge length;
/// the lowest index stays. Triangles keep their number and order. Deterministic, O(n).
/// @returns how many vertices went
Index weld_vertices(TriangleMesh& mesh, double relative_tolerance = kWeldTolerance);

/// Removes vertices that no triangle uses; the others keep their order. @returns how many went
Index drop_unused_vertices(TriangleMesh& mesh);

/// What a repair did; all zero when there was nothing to do.
struct RepairRecord {
  Index welded_vertices = 0, unused_vertices = 0;           ///< removed
  Index degenerate_triangles = 0, duplicate_triangles = 0;  ///< removed
  Index flipped_triangles = 0;                              ///< to agree with their neighbours
  bool turned_outward = false;                              ///< a closed mesh was inside out

  [[nodiscard]] bool changed() const noexcept { return *this != RepairRecord{}; }
  bool operator==(const RepairRecord&) const noexcept = default;
};

/// Does what is safe: welds vertices, drops triangles without area and doubles, makes orientations agree
/// across edges (in each component as the majority has it), turns a closed mesh outward, drops unused
/// vertices. Does not move vertices, fill holes or split non-manifold edges.
RepairRecord repair_mesh(TriangleMesh& mesh);

}  // namespace abradem::geometry
