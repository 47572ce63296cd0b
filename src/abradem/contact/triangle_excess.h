// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

/// Where a ball reaches deepest into an edge or a triangle, from the excess e = 1 - |x - c|^2 / R^2 at the
/// corners and the squared edges in units of R^2; no coordinates are needed.
namespace abradem::contact {

/// Largest excess on an edge whose ends have ea and eb (its excess is a parabola of curvature -2).
[[nodiscard]] inline double edge_excess(double ea, double eb, double l) noexcept {
  const double b = l + eb - ea;
  return b > 0.0 && b < 2.0 * l ? ea + 0.25 * b * b / l : std::max(ea, eb);
}

/// Largest excess in a triangle, from its corners and squared edges: at the foot of the ball's centre when
/// that lies inside, else on an edge.
[[nodiscard]] inline double triangle_excess(double e0, double e1, double e2, double l01, double l12,
                                            double l20) noexcept {
  const double fu = 0.5 * (e1 - e0 + l01), fv = 0.5 * (e2 - e0 + l20);  // (foot - p0) . edges
  const double uv = 0.5 * (l01 + l20 - l12), det = l01 * l20 - uv * uv;
  if (det > 0.0) {
    const double b1 = (l20 * fu - uv * fv) / det, b2 = (l01 * fv - uv * fu) / det;
    if (b1 >= 0.0 && b2 >= 0.0 && b1 + b2 <= 1.0) return e0 + b1 * fu + b2 * fv;
  }
  return std::max({edge_excess(e0, e1, l01), edge_excess(e1, e2, l12), edge_excess(e2, e0, l20)});
}

}  // namespace abradem::contact
