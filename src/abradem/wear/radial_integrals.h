// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abradem/core/vec3.h"

namespace abradem::wear {

/// Weight sqrt(max(0, 2 (s - u))) at the distance u from the centre of a ball: Hertz's pressure, whose disc
/// ends at u = s.
struct HertzBall {
  double s;  ///< [m]
};
/// Weight max(0, s - u): overlap with a ball of radius s.
struct OverlapBall {
  double s;  ///< [m]
};

/// Integrals of a weight with the shape functions of a triangle's corners.
struct CornerIntegrals {
  double at0 = 0.0, at1 = 0.0, at2 = 0.0;
};

/// Over the flat triangle whose corners lie at r0, r1, r2 from the ball's centre.
/// docs/theory/wear.md#footprint
[[nodiscard]] CornerIntegrals integrate_over_triangle(const HertzBall& ball, const Vec3& r0, const Vec3& r1,
                                                      const Vec3& r2) noexcept;
[[nodiscard]] CornerIntegrals integrate_over_triangle(const OverlapBall& ball, const Vec3& r0, const Vec3& r1,
                                                      const Vec3& r2) noexcept;

}  // namespace abradem::wear
