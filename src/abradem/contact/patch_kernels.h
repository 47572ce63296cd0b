// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "abradem/contact/mesh_candidates.h"

/// The loops of the contact rule `patch` over arrays padded to eight lanes; everything in units of R.
namespace abradem::contact::kernels {

/// excess[i] = 1 - |x_i - c|^2 / R^2, positive inside the ball. Returns the largest.
double node_excess(const MeshCandidates& candidates, const Vec3& c, double R,
                   std::span<double> excess) noexcept;

/// Sums over the nodes of an overlap that is fine against the mesh, and of the same nodes moved into the
/// candidates' mean plane; see PatchEvaluator. In units of R where dimensionless.
struct NodeSums {
  Vec3 G;          ///< sum of g / R times nodal area vectors [m^2]
  double M = 0.0;  ///< sum of the weight of M times height of the centre above the node's surface [m^3]
  double G_plane = 0.0, M_plane = 0.0;
};
/// @param scratch grows as needed
NodeSums node_sums(const MeshCandidates& candidates, const Vec3& c, double R, std::span<const double> excess,
                   std::vector<double>& scratch);

/// Per triangle: a bound that the excess nowhere exceeds (squared distances are convex: highest corner plus a
/// third of the longest edge squared), how many corners lie inside (0 … 3), and the height of the ball's
/// centre above the triangle's plane times its area.
void survey(const MeshCandidates& candidates, const Vec3& c, double R, const double* e0, const double* e1,
            const double* e2, double* bound, double* inside, double* height) noexcept;

/// For triangles wholly inside the ball with squared edges below `limit`: means over the triangle of g / R
/// and of the weight of M (others: zero).
void whole_triangles(std::size_t padded_count, const MeshCandidates& candidates, const double* e0,
                     const double* e1, const double* e2, const double* inside, double R, double limit,
                     double* mean_g, double* mean_m) noexcept;

/// Triangles that the rim of the ball cuts, in units of R: vertex 0 alone inside (inside = 1) or alone
/// outside (inside = 0); height of the centre above the plane times the area.
struct RimTriangles {
  const double *e0, *e1, *e2, *l01, *l12, *l20, *height, *inside;
};
/// The same means, taken over the overlapped part and related to the whole triangle.
void rim_triangles(std::size_t padded_count, const RimTriangles& rim, double* mean_g,
                   double* mean_m) noexcept;

/// The two means of a cap: what a straight edge cuts off a disc of squared radius E (units of R^2), w2 =
/// squared half chord, related to a triangle of twice_area (units of R^2).
std::array<double, 2> cap(double w2, double E, double area) noexcept;

/// Over the first triangles: sum mean_g a_T (three components) and sum mean_m height_T.
std::array<double, 4> sums(std::size_t padded_count, const MeshCandidates& candidates, const double* height,
                           const double* mean_g, const double* mean_m) noexcept;

}  // namespace abradem::contact::kernels
