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
/// R^2). Along a line the excess is a parabola of curvature -2, so mid-edges follow exactly, and so do the mean
/// and the mean square of the excess (degree 4). The higher powers, a few per cent of the whole, are taken from
/// these two: mean f = f(mean) + f''(mean) variance / 2.
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
           v * (3.0 * kWeighted[3] + m * (6.0 * kWeighted[4] + m * (10.0 * kWeighted[5] + m * 15.0 * kWeighted[6]))));
  return {kOverlap[1] * m + kOverlap[2] * mean2 + rest_g, kWeighted[2] * mean2 + rest_m};
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

ABRADEM_DISPATCH void whole_triangles(std::size_t padded_count, const double* __restrict e0,
                                      const double* __restrict e1, const double* __restrict e2,
                                      const double* __restrict l01, const double* __restrict l12,
                                      const double* __restrict l20, const double* __restrict longest, double R,
                                      double limit, double* __restrict mean_g, double* __restrict mean_m,
                                      double* __restrict bound, double* __restrict inside) noexcept {
  const double inverse = 1.0 / (R * R);
  for (std::size_t k = 0; k < padded_count; ++k) {
    const Means means = means_over(e0[k], e1[k], e2[k], l01[k] * inverse, l12[k] * inverse, l20[k] * inverse);
    const double low01 = e0[k] < e1[k] ? e0[k] : e1[k], low = low01 < e2[k] ? low01 : e2[k];
    const double high01 = e0[k] > e1[k] ? e0[k] : e1[k], high = high01 > e2[k] ? high01 : e2[k];
    const bool whole = (low > 0.0) & (longest[k] <= limit);
    mean_g[k] = whole ? means.g : 0.0;
    mean_m[k] = whole ? means.m : 0.0;
    bound[k] = high + longest[k] * inverse * (1.0 / 3.0);
    inside[k] = (e0[k] > 0.0 ? 1.0 : 0.0) + (e1[k] > 0.0 ? 1.0 : 0.0) + (e2[k] > 0.0 ? 1.0 : 0.0);
  }
}

ABRADEM_DISPATCH void rim_triangles(std::size_t padded_count, const double* __restrict e0,
                                    const double* __restrict e1, const double* __restrict e2,
                                    const double* __restrict l01, const double* __restrict l12,
                                    const double* __restrict l20, const double* __restrict E,
                                    const double* __restrict inside, double* __restrict mean_g,
                                    double* __restrict mean_m) noexcept {
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
    // Between chord and arc: with half chord w at distance h from the disc's centre,
    //   int e = 4/15 w^5/h - 4/105 w^7/h^3,  int e^2 = 16/105 w^7/h   (next terms relative (w/h)^4).
    const double w2 = 0.25 * chord, w = std::sqrt(w2), w5 = w2 * w2 * w;
    const double h2 = E[k] - w2;
    const double h = std::sqrt(h2 > 0.25 * E[k] ? h2 : 0.25 * E[k]);
    const double s1 = w5 / h * (4.0 / 15.0 - (4.0 / 105.0) * w2 / (h * h));
    const double s2 = (16.0 / 105.0) * w5 * w2 / h;
    // Area in the same units, by Heron.
    const double area2 = 4.0 * l01[k] * l20[k] - two_cos * two_cos;
    const double inverse_area = 4.0 / std::sqrt(area2 > 1e-300 ? area2 : 1e-300);
    mean_g[k] = outside * all.g + sign * share * corner.g + inverse_area * (kOverlap[1] * s1 + kOverlap[2] * s2);
    mean_m[k] = outside * all.m + sign * share * corner.m + inverse_area * (kWeighted[2] * s2);
  }
}

ABRADEM_DISPATCH std::array<double, 4> sums(const MeshCandidates& candidates, const Vec3& c,
                                            std::span<const double> mean_g,
                                            std::span<const double> mean_m) noexcept {
  const double* __restrict ax = candidates.ax.data();
  const double* __restrict ay = candidates.ay.data();
  const double* __restrict az = candidates.az.data();
  const double* __restrict plane = candidates.plane.data();
  const double* __restrict g = mean_g.data();
  const double* __restrict m = mean_m.data();
  double sx[kLanes]{}, sy[kLanes]{}, sz[kLanes]{}, sm[kLanes]{};
  for (std::size_t t = 0; t < mean_g.size(); t += kLanes)
    for (std::size_t l = 0; l < kLanes; ++l) {
      const std::size_t k = t + l;
      sx[l] += g[k] * ax[k];
      sy[l] += g[k] * ay[k];
      sz[l] += g[k] * az[k];
      sm[l] += m[k] * (ax[k] * c.x + ay[k] * c.y + az[k] * c.z - plane[k]);
    }
  std::array<double, 4> total{};
  for (std::size_t l = 0; l < kLanes; ++l) {
    total[0] += sx[l];
    total[1] += sy[l];
    total[2] += sz[l];
    total[3] += sm[l];
  }
  return total;
}

}  // namespace abradem::contact::kernels
