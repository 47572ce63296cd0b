// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/wear/radial_integrals.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "abradem/core/simd.h"

namespace abradem::wear {

namespace {

constexpr std::size_t kPoints = 8;
/// Gauss-Legendre's points x taken to x (3 - x^2) / 2: what is singular at an end of the range is smooth in
/// x.
constexpr double kAt[kPoints]{-0.9976659661277575,  -0.9421865814776309, -0.7157267108492514,
                              -0.27206583473169427, 0.27206583473169427, 0.7157267108492514,
                              0.9421865814776309,   0.9976659661277575};
constexpr double kWeight[kPoints]{0.011819958873341375, 0.12186120111608843, 0.3405986866933063,
                                  0.5257201533172638,   0.5257201533172638,  0.3405986866933063,
                                  0.12186120111608843,  0.011819958873341375};

/// What is beyond a distance u, F(u) = ∫_u^s u' w(u') du'.
ABRADEM_INLINE double beyond(const HertzBall& ball, double u) {
  const double v = ball.s > u ? ball.s - u : 0.0;
  return std::numbers::sqrt2 * v * std::sqrt(v) * (2.0 / 3.0 * ball.s - 0.4 * v);
}
ABRADEM_INLINE double beyond(const OverlapBall& ball, double u) {
  const double v = ball.s > u ? ball.s - u : 0.0;
  return v * v * (0.5 * ball.s - v / 3.0);
}

/// Angle under which a stretch of a line at distance d is seen.
double angle(double d, double from, double to) noexcept {
  return std::atan2(d * (to - from), d * d + from * to);
}

/// A triangle as seen from q, the foot of the ball's centre on its plane; edge k starts at corner k.
struct Edges {
  Vec3 out[3];            ///< unit normal outwards, in the plane
  double length[3];       ///< [m]
  double d[3];            ///< distance from q; > 0: q lies inside [m]
  double from[3], to[3];  ///< its ends, along it, from where q is nearest [m]
  double h;               ///< of the centre over the plane [m]
  double twice_area;      ///< [m^2]
};

ABRADEM_INLINE Edges edges_of(const Vec3& r0, const Vec3& r1, const Vec3& r2) {
  const Vec3 corner[3]{r0, r1, r2}, area = cross(r1 - r0, r2 - r0);
  Edges e;
  e.twice_area = norm(area);
  const Vec3 n = area / e.twice_area;
  e.h = std::abs(dot(r0, n));
  for (int k = 0; k < 3; ++k) {
    const Vec3 edge = corner[(k + 1) % 3] - corner[k];
    e.length[k] = norm(edge);
    const Vec3 along = edge / e.length[k];
    e.out[k] = cross(along, n);
    e.d[k] = dot(corner[k], e.out[k]);
    e.from[k] = dot(corner[k], along);
    e.to[k] = e.from[k] + e.length[k];
  }
  return e;
}

/// On the stretch of a line at distance d from q: ∫ F dt, and ∫ (F(0) - F) / r^2 dt.
struct Stretch {
  double beyond = 0.0, within = 0.0;
};
template <typename Ball>
ABRADEM_INLINE Stretch over_stretch(const Ball& ball, double h, double d, double from, double to) {
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from), all = beyond(ball, h);
  double F[kPoints], G[kPoints];
  for (std::size_t i = 0; i < kPoints; ++i) {
    const double t = middle + half * kAt[i], r2 = d * d + t * t;
    F[i] = beyond(ball, std::sqrt(h * h + r2));
    G[i] = kWeight[i] * (all - F[i]) / (r2 + 1e-300);  // at q itself, where it counts for nothing, 0
    F[i] *= kWeight[i];
  }
  const auto sum = [](const double* v) {
    return ((v[0] + v[1]) + (v[2] + v[3])) + ((v[4] + v[5]) + (v[6] + v[7]));
  };
  return {half * sum(F), half * sum(G)};
}

/// The weight depends on the distance r from q alone. With F(r) = ∫_r r' w dr', 0 at the rim of the disc,
/// w x = -grad F and w = div(x (F(0) - F) / r^2), x from q: by Gauss's theorem the integrals of w and of w x
/// lie on the edges, where F is smooth.
template <typename Ball>
ABRADEM_INLINE CornerIntegrals integrate(const Ball& ball, const Vec3& r0, const Vec3& r1, const Vec3& r2) {
  const Edges e = edges_of(r0, r1, r2);
  const double radius2 = ball.s * ball.s - e.h * e.h, all = beyond(ball, e.h);
  if (!(e.h < ball.s)) return {};
  const bool contains = e.d[0] > 0.0 && e.d[1] > 0.0 && e.d[2] > 0.0;
  double of_w = 0.0, on_edge[3]{}, from[3], to[3];  // of each edge, what lies in the disc
  bool cut = false;
  for (int k = 0; k < 3; ++k) {
    const double half = std::sqrt(std::max(radius2 - e.d[k] * e.d[k], 0.0));
    from[k] = std::clamp(-half, e.from[k], e.to[k]);
    to[k] = std::clamp(half, e.from[k], e.to[k]);
    cut = cut || from[k] < to[k];
  }
  if (!cut && !contains) return {};
  if (!cut) of_w = 2.0 * std::numbers::pi * all;
  for (int k = 0; cut && k < 3; ++k) {
    const double d = e.d[k];
    if (from[k] < to[k]) {
      const Stretch inside = over_stretch(ball, e.h, d, from[k], to[k]);
      on_edge[k] = inside.beyond;
      of_w += d * inside.within;
    }
    if (e.from[k] < from[k]) of_w += all * angle(d, e.from[k], from[k]);
    if (to[k] < e.to[k]) of_w += all * angle(d, to[k], e.to[k]);
  }
  double at[3];
  for (int k = 0; k < 3; ++k) {
    double sum = e.d[k] * of_w;
    for (int j = 0; j < 3; ++j) sum += dot(e.out[k], e.out[j]) * on_edge[j];
    at[(k + 2) % 3] = std::max(sum * e.length[k] / e.twice_area, 0.0);  // rounding may leave it below
  }
  return {at[0], at[1], at[2]};
}

ABRADEM_DISPATCH CornerIntegrals of_hertz(const HertzBall& ball, const Vec3& r0, const Vec3& r1,
                                          const Vec3& r2) noexcept {
  return integrate(ball, r0, r1, r2);
}
ABRADEM_DISPATCH CornerIntegrals of_overlap(const OverlapBall& ball, const Vec3& r0, const Vec3& r1,
                                            const Vec3& r2) noexcept {
  return integrate(ball, r0, r1, r2);
}

}  // namespace

CornerIntegrals integrate_over_triangle(const HertzBall& ball, const Vec3& r0, const Vec3& r1,
                                        const Vec3& r2) noexcept {
  return of_hertz(ball, r0, r1, r2);
}
CornerIntegrals integrate_over_triangle(const OverlapBall& ball, const Vec3& r0, const Vec3& r1,
                                        const Vec3& r2) noexcept {
  return of_overlap(ball, r0, r1, r2);
}

}  // namespace abradem::wear
