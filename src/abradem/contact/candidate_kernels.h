// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

#include "abradem/contact/mesh_candidates.h"

/// The loops over all candidates of a sphere, on arrays padded to eight lanes.
namespace abradem::contact::kernels {

/// What the triangles have in common.
struct TriangleSums {
  double longest2 = 0.0, shortest2 = 0.0;  ///< of all edges [m^2]
  Vec3 area;                               ///< sum of the area vectors [m^2]
};

/// Area vectors, areas, planes and edges of the triangles from the positions of their nodes.
TriangleSums measure_triangles(MeshCandidates& candidates) noexcept;

/// A third of the areas and of the area vectors around each node.
/// @param scratch grows as needed
void measure_nodes(MeshCandidates& candidates, std::vector<double>& scratch);

/// Smallest of area vector . direction - cosine * area over the triangles: negative when one of them is
/// turned by more from the (unit) direction than the cosine tells [m^2].
double least_facing(const MeshCandidates& candidates, const Vec3& direction, double cosine) noexcept;

/// A node's motion [m] along x, y, z, and 1 where it is inside the ball (else 0).
using NodeMotion = std::array<double, 4>;

/// Sum over the triangles with a corner inside the ball of |motion of the centroid| times area [m^3].
/// @param motion of each node, padded   @param scratch grows as needed
double centroid_motion(const MeshCandidates& candidates, std::span<const NodeMotion> motion,
                       std::vector<double>& scratch);

}  // namespace abradem::contact::kernels
