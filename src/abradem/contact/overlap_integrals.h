// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abradem/core/vec3.h"

/// Integrals of a ball's overlap with a triangulated solid, the base of the contact rule `patch`.
/// docs/theory/contact-walls.md derives them.
///
/// With g(x) = R - |x - c| the local overlap, the overlapped volume weighted by it,
///   M = integral of g over (solid and ball),   dM/dc = -sum_T G_T n_T,   G_T = integral of g over (T and
///   ball),
/// is the potential of the contact: one number for the whole patch, whatever the triangles.
namespace abradem::contact {

struct OverlapIntegrals {
  double G = 0.0;  ///< integral of g over the overlapped part of the triangle [m^3]
  double M = 0.0;  ///< its share of the weighted overlap volume, signed by the side the centre lies on [m^4]
};

/// Of one triangle, any size and position; exact up to a series in (overlap / R): at an overlap of 10 % of R
/// the error is below 1e-7 of G and 1e-5 of M, at 3 % below 1e-11 and 3e-9. O(1).
/// @param a,b,c vertices relative to the ball's centre, counter-clockwise seen from outside   @param R radius
[[nodiscard]] OverlapIntegrals overlap_of_triangle(const Vec3& a, const Vec3& b, const Vec3& c,
                                                   double R) noexcept;

/// Of the half-space under a plane at overlap delta: G = pi R delta^2 (1 - 2 delta / 3 R),
/// M = (pi/3) R delta^3 (1 - delta / 2 R).
[[nodiscard]] OverlapIntegrals overlap_of_plane(double delta, double R) noexcept;

/// The overlap of a plane that has this M [m]: what `patch` calls the overlap of any contact.
[[nodiscard]] double equivalent_overlap(double M, double R) noexcept;

}  // namespace abradem::contact
