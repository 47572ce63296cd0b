// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/contact/patch_kernels.h"

#include <algorithm>
#include <cmath>

#include "abradem/contact/overlap_series.h"
#include "abradem/core/simd.h"

namespace abradem::contact::kernels {

namespace {

constexpr std::size_t kLanes = MeshCandidates::kLanes;
using series::kOverlap, series::kWeighted;

struct Means {
  double g, m;
};

/// Means over a triangle of the two series, from the excess at its corners and its squared edges (units of
/// R^2). Along a line the excess is a parabola of curvature -2, so mid-edges follow exactly, and so do the
/// mean and the mean square of the excess (degree 4). The higher powers, a few per cent of the whole, are
/// taken from these two: mean f = f(mean) + f''(mean) variance / 2.
ABRADEM_INLINE Means means_over(double e0, double e1, double e2, double l01, double l12, double l20) {
  const double m01 = 0.5 * (e0 + e1) + 0.25 * l01;
  const double m12 = 0.5 * (e1 + e2) + 0.25 * l12;
  const double m20 = 0.5 * (e2 + e0) + 0.25 * l20;
  const double m = (m01 + m12 + m20) * (1.0 / 3.0);
  const double mean2 = (6.0 * (e0 * e0 + e1 * e1 + e2 * e2) - 2.0 * (e0 * e1 + e1 * e2 + e2 * e0) -
                        8.0 * (e0 * m12 + e1 * m20 + e2 * m01) + 32.0 * (m01 * m01 + m12 * m12 + m20 * m20) +
                        32.0 * (m01 * m12 + m12 * m20 + m20 * m01)) *
                       (1.0 / 180.0);
  const double v = mean2 - m * m;
  const double m2 = m * m;
  const double rest_g = m * (m2 * (kOverlap[3] + m * (kOverlap[4] + m * kOverlap[5])) +
                             v * (3.0 * kOverlap[3] + m * (6.0 * kOverlap[4] + m * 10.0 * kOverlap[5])));
  const double rest_m =
      m * (m2 * (kWeighted[3] + m * (kWeighted[4] + m * (kWeighted[5] + m * kWeighted[6]))) +
           v * (3.0 * kWeighted[3] +
                m * (6.0 * kWeighted[4] + m * (10.0 * kWeighted[5] + m * 15.0 * kWeighted[6]))));
  return {kOverlap[1] * m + kOverlap[2] * mean2 + rest_g, kWeighted[2] * mean2 + rest_m};
}

/// Integrals of e and e^2 over the cap between a chord of half length w and its arc, h from the disc's
/// centre:
///   int e = 4/15 w^5/h - 4/105 w^7/h^3,  int e^2 = 16/105 w^7/h   (next terms relative (w/h)^4).
struct Cap {
  double e, e2;
};
ABRADEM_INLINE Cap cap_integrals(double w2, double E) {
  const double h2_raw = E - w2, h2 = h2_raw > 0.25 * E ? h2_raw : 0.25 * E;
  const double h = std::sqrt(h2), w5 = w2 * w2 * std::sqrt(w2);
  return {w5 / h * (4.0 / 15.0 - (4.0 / 105.0) * w2 / h2), (16.0 / 105.0) * w5 * w2 / h};
}

}  // namespace

ABRADEM_DISPATCH double node_excess(const MeshCandidates& candidates, const Vec3& c, double R,
                                    std::span<double> excess) noexcept {
  const double* __restrict x = candidates.x.data();
  const double* __restrict y = candidates.y.data();
  const double* __restrict z = candidates.z.data();
  double* __restrict e = excess.data();
  const double R2 = R * R, inverse = 1.0 / R2;
  for (std::size_t i = 0; i < excess.size(); ++i) {
    const double dx = x[i] - c.x, dy = y[i] - c.y, dz = z[i] - c.z;
    e[i] = (R2 - (dx * dx + dy * dy + dz * dz)) * inverse;
  }
  double largest = -1.0;
#pragma omp simd reduction(max : largest)
  for (std::size_t i = 0; i < excess.size(); ++i) largest = e[i] > largest ? e[i] : largest;
  return largest;
}

namespace {

/// g / R of a point inside the ball, from its excess.
ABRADEM_INLINE double series_g(double e) {
  return e * (kOverlap[1] + e * (kOverlap[2] + e * (kOverlap[3] + e * (kOverlap[4] + e * kOverlap[5]))));
}
/// Its weight of M.
ABRADEM_INLINE double series_m(double e) {
  return e * e *
         (kWeighted[2] + e * (kWeighted[3] + e * (kWeighted[4] + e * (kWeighted[5] + e * kWeighted[6]))));
}

/// Terms of node_sums, a row of each in `terms`: G along x, y, z; M; G and M of the plane.
ABRADEM_DISPATCH void node_terms(const MeshCandidates& candidates, const Vec3& c, double R, double distance,
                                 std::size_t padded_count, const double* __restrict excess,
                                 double* __restrict terms) noexcept {
  const double* __restrict x = candidates.x.data();
  const double* __restrict y = candidates.y.data();
  const double* __restrict z = candidates.z.data();
  const double* __restrict bx = candidates.bx.data();
  const double* __restrict by = candidates.by.data();
  const double* __restrict bz = candidates.bz.data();
  double* __restrict gx = terms;
  double* __restrict gy = gx + padded_count;
  double* __restrict gz = gy + padded_count;
  double* __restrict m = gz + padded_count;
  double* __restrict g_plane = m + padded_count;
  double* __restrict m_plane = g_plane + padded_count;
  const double cx = c.x, cy = c.y, cz = c.z, inverse = 1.0 / (R * R), distance2 = distance * distance;
  const double nx = candidates.mean_normal.x, ny = candidates.mean_normal.y, nz = candidates.mean_normal.z;
#pragma omp simd
  for (std::size_t i = 0; i < padded_count; ++i) {
    const double dx = x[i] - cx, dy = y[i] - cy, dz = z[i] - cz;
    const double height = dx * nx + dy * ny + dz * nz;
    const double raw = excess[i], raw_plane = raw + (height * height - distance2) * inverse;
    const double e = raw > 0.0 ? raw : 0.0, ep = raw_plane > 0.0 ? raw_plane : 0.0;
    const double g = series_g(e), area = bx[i] * nx + by[i] * ny + bz[i] * nz;
    gx[i] = g * bx[i];
    gy[i] = g * by[i];
    gz[i] = g * bz[i];
    m[i] = -series_m(e) * (bx[i] * dx + by[i] * dy + bz[i] * dz);
    g_plane[i] = series_g(ep) * area;
    m_plane[i] = series_m(ep) * area * distance;
  }
}

ABRADEM_DISPATCH double sum_row(const double* __restrict values, std::size_t padded_count) noexcept {
  return core::sum_lanes(values, padded_count);
}

}  // namespace

NodeSums node_sums(const MeshCandidates& candidates, const Vec3& c, double R, std::span<const double> excess,
                   std::vector<double>& scratch) {
  const std::size_t n = excess.size();
  if (scratch.size() < 6 * n) scratch.resize(6 * n);
  const double distance = dot(candidates.mean_normal, c - candidates.mean_point);
  node_terms(candidates, c, R, distance, n, excess.data(), scratch.data());
  const auto sum = [&](std::size_t row) { return sum_row(scratch.data() + row * n, n); };
  return {{sum(0), sum(1), sum(2)}, sum(3), sum(4), sum(5)};
}

ABRADEM_DISPATCH void survey(const MeshCandidates& candidates, const Vec3& c, double R,
                             const double* __restrict e0, const double* __restrict e1,
                             const double* __restrict e2, double* __restrict bound, double* __restrict inside,
                             double* __restrict height) noexcept {
  const double* __restrict ax = candidates.ax.data();
  const double* __restrict ay = candidates.ay.data();
  const double* __restrict az = candidates.az.data();
  const double* __restrict plane = candidates.plane.data();
  const double* __restrict longest = candidates.longest.data();
  const double third = 1.0 / (3.0 * R * R);
  const double cx = c.x, cy = c.y, cz = c.z;
  const std::size_t n = candidates.padded_triangle_count();
  for (std::size_t k = 0; k < n; ++k) {
    const double high01 = e0[k] > e1[k] ? e0[k] : e1[k], high = high01 > e2[k] ? high01 : e2[k];
    bound[k] = high + longest[k] * third;
    inside[k] = (e0[k] > 0.0 ? 1.0 : 0.0) + (e1[k] > 0.0 ? 1.0 : 0.0) + (e2[k] > 0.0 ? 1.0 : 0.0);
    height[k] = ax[k] * cx + ay[k] * cy + az[k] * cz - plane[k];
  }
}

ABRADEM_DISPATCH void whole_triangles(std::size_t padded_count, const MeshCandidates& candidates,
                                      const double* __restrict e0, const double* __restrict e1,
                                      const double* __restrict e2, const double* __restrict inside, double R,
                                      double limit, double* __restrict mean_g,
                                      double* __restrict mean_m) noexcept {
  const double* __restrict l01 = candidates.l01.data();
  const double* __restrict l12 = candidates.l12.data();
  const double* __restrict l20 = candidates.l20.data();
  const double* __restrict longest = candidates.longest.data();
  const double inverse = 1.0 / (R * R);
  for (std::size_t k = 0; k < padded_count; ++k) {
    const Means means = means_over(e0[k], e1[k], e2[k], l01[k] * inverse, l12[k] * inverse, l20[k] * inverse);
    const bool whole = (inside[k] == 3.0) & (longest[k] <= limit);
    mean_g[k] = whole ? means.g : 0.0;
    mean_m[k] = whole ? means.m : 0.0;
  }
}

ABRADEM_DISPATCH void rim_triangles(std::size_t padded_count, const RimTriangles& rim,
                                    double* __restrict mean_g, double* __restrict mean_m) noexcept {
  const double* __restrict e0 = rim.e0;
  const double* __restrict e1 = rim.e1;
  const double* __restrict e2 = rim.e2;
  const double* __restrict l01 = rim.l01;
  const double* __restrict l12 = rim.l12;
  const double* __restrict l20 = rim.l20;
  const double* __restrict height = rim.height;
  const double* __restrict inside = rim.inside;
  for (std::size_t k = 0; k < padded_count; ++k) {
    // The rim crosses edges 01 and 02 where e0 + t (e1 - e0 + l) - t^2 l = 0: the far root when vertex 0 is
    // inside, the near one when it is outside.
    const double sign = 2.0 * inside[k] - 1.0;
    const double b1 = e1[k] - e0[k] + l01[k], b2 = e2[k] - e0[k] + l20[k];
    const double d1 = b1 * b1 + 4.0 * l01[k] * e0[k], d2 = b2 * b2 + 4.0 * l20[k] * e0[k];
    const double t1 = (b1 + sign * std::sqrt(d1 > 0.0 ? d1 : 0.0)) / (2.0 * l01[k]);
    const double t2 = (b2 + sign * std::sqrt(d2 > 0.0 ? d2 : 0.0)) / (2.0 * l20[k]);
    // The corner (0, P, Q), and the squared chord PQ from the angle at 0.
    const double p = t1 * t1 * l01[k], q = t2 * t2 * l20[k];
    const double two_cos = l01[k] + l20[k] - l12[k];
    const double chord_raw = p + q - t1 * t2 * two_cos;
    const double chord = chord_raw > 0.0 ? chord_raw : 0.0;
    const Means corner = means_over(e0[k], 0.0, 0.0, p, chord, q);
    const Means all = means_over(e0[k], e1[k], e2[k], l01[k], l12[k], l20[k]);
    const double share = t1 * t2;
    const double outside = 1.0 - inside[k];
    // Area in the same units, by Heron; the disc that the plane cuts from the ball.
    const double area16 = 4.0 * l01[k] * l20[k] - two_cos * two_cos;
    const double inverse_area = 4.0 / std::sqrt(area16 > 1e-300 ? area16 : 1e-300);
    const double d = height[k] * inverse_area;
    const double E = 1.0 - d * d;
    // Between chord and arc, less what of it lies beyond the edge 12 where the ball reaches over that edge
    // too.
    const double b12 = e2[k] - e1[k] + l12[k];
    const double over = e1[k] + 0.25 * b12 * b12 / l12[k];
    const bool reaches = (inside[k] > 0.0) & (b12 > 0.0) & (b12 < 2.0 * l12[k]) & (over > 0.0);
    const double beyond = reaches ? over : 0.0;
    const Cap arc = cap_integrals(0.25 * chord, E), far = cap_integrals(beyond, E);
    const double e = arc.e - far.e, e_2 = arc.e2 - far.e2;
    mean_g[k] =
        outside * all.g + sign * share * corner.g + inverse_area * (kOverlap[1] * e + kOverlap[2] * e_2);
    mean_m[k] = outside * all.m + sign * share * corner.m + inverse_area * (kWeighted[2] * e_2);
  }
}

std::array<double, 2> cap(double w2, double E, double area) noexcept {
  const Cap c = cap_integrals(w2, E);
  return {(kOverlap[1] * c.e + kOverlap[2] * c.e2) / area, kWeighted[2] * c.e2 / area};
}

ABRADEM_DISPATCH std::array<double, 4> sums(std::size_t padded_count, const MeshCandidates& candidates,
                                            const double* __restrict height, const double* __restrict g,
                                            const double* __restrict m) noexcept {
  const double* __restrict ax = candidates.ax.data();
  const double* __restrict ay = candidates.ay.data();
  const double* __restrict az = candidates.az.data();
  core::Lanes sx{}, sy{}, sz{}, sm{};
  for (std::size_t t = 0; t < padded_count; t += kLanes) {
    core::Lanes gt, x, y, z, mt, ht;
    core::load_lanes(gt, g + t);
    core::load_lanes(x, ax + t);
    core::load_lanes(y, ay + t);
    core::load_lanes(z, az + t);
    core::load_lanes(mt, m + t);
    core::load_lanes(ht, height + t);
    sx += gt * x;
    sy += gt * y;
    sz += gt * z;
    sm += mt * ht;
  }
  const std::array<double, 4> total{ABRADEM_SUM_LANES(sx), ABRADEM_SUM_LANES(sy), ABRADEM_SUM_LANES(sz),
                                    ABRADEM_SUM_LANES(sm)};
  return total;
}

}  // namespace abradem::contact::kernels
