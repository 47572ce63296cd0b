// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "abradem/contact/mesh_candidates.h"

/// The loops of the contact rule `patch` over arrays padded to eight lanes; everything in units of R.
namespace abradem::contact::kernels {

/// excess[i] = 1 - |x_i - c|^2 / R^2, positive inside the ball. Returns the largest.
double node_excess(const MeshCandidates& candidates, const Vec3& c, double R, std::span<double> excess) noexcept;

/// For triangles wholly inside the ball with squared edges below `limit`: means over the triangle of g / R and
/// of the weight of M (others: zero). For all: a bound that the excess nowhere exceeds in the triangle (squared
/// distances are convex: corner + longest edge squared / 3), and how many corners lie inside (0 … 3).
void whole_triangles(std::size_t padded_count, const double* e0, const double* e1, const double* e2,
                     const double* l01, const double* l12, const double* l20, const double* longest, double R,
                     double limit, double* mean_g, double* mean_m, double* bound, double* inside) noexcept;

/// For triangles cut once by the rim, vertex 0 alone inside (inside = 1) or alone outside (inside = 0): the same
/// means, taken over the overlapped part and related to the whole triangle. E = disc radius squared / R^2.
void rim_triangles(std::size_t padded_count, const double* e0, const double* e1, const double* e2,
                   const double* l01, const double* l12, const double* l20, const double* E,
                   const double* inside, double* mean_g, double* mean_m) noexcept;

/// sum mean_g a_T (three components) and sum mean_m (a_T . c - plane_T).
std::array<double, 4> sums(const MeshCandidates& candidates, const Vec3& c, std::span<const double> mean_g,
                           std::span<const double> mean_m) noexcept;

}  // namespace abradem::contact::kernels
