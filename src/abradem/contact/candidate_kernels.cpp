// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/contact/candidate_kernels.h"

#include <cmath>
#include <limits>

#include "abradem/core/simd.h"

namespace abradem::contact::kernels {

namespace {

ABRADEM_INLINE double larger(double a, double b) { return a > b ? a : b; }
ABRADEM_INLINE double smaller(double a, double b) { return a < b ? a : b; }

ABRADEM_DISPATCH void measure_each(MeshCandidates& m) noexcept {
  const double* __restrict x = m.x.data();
  const double* __restrict y = m.y.data();
  const double* __restrict z = m.z.data();
  const std::int32_t* __restrict v0 = m.v0.data();
  const std::int32_t* __restrict v1 = m.v1.data();
  const std::int32_t* __restrict v2 = m.v2.data();
  double* __restrict ax = m.ax.data();
  double* __restrict ay = m.ay.data();
  double* __restrict az = m.az.data();
  double* __restrict area = m.area.data();
  double* __restrict plane = m.plane.data();
  double* __restrict l01 = m.l01.data();
  double* __restrict l12 = m.l12.data();
  double* __restrict l20 = m.l20.data();
  double* __restrict longest = m.longest.data();
#pragma omp simd
  for (std::size_t t = 0; t < m.padded_triangle_count(); ++t) {
    const double px = x[v0[t]], py = y[v0[t]], pz = z[v0[t]];
    const double ex = x[v1[t]] - px, ey = y[v1[t]] - py, ez = z[v1[t]] - pz;
    const double fx = x[v2[t]] - px, fy = y[v2[t]] - py, fz = z[v2[t]] - pz;
    const double gx = fx - ex, gy = fy - ey, gz = fz - ez;
    const double nx = 0.5 * (ey * fz - ez * fy), ny = 0.5 * (ez * fx - ex * fz),
                 nz = 0.5 * (ex * fy - ey * fx);
    const double a = ex * ex + ey * ey + ez * ez, b = gx * gx + gy * gy + gz * gz,
                 c = fx * fx + fy * fy + fz * fz;
    ax[t] = nx, ay[t] = ny, az[t] = nz;
    area[t] = std::sqrt(nx * nx + ny * ny + nz * nz);
    plane[t] = nx * px + ny * py + nz * pz;
    l01[t] = a, l12[t] = b, l20[t] = c;
    longest[t] = larger(larger(a, b), c);
  }
}

ABRADEM_DISPATCH TriangleSums sum_up(const MeshCandidates& candidates) noexcept {
  const double* __restrict l01 = candidates.l01.data();
  const double* __restrict l12 = candidates.l12.data();
  const double* __restrict l20 = candidates.l20.data();
  const double* __restrict longest = candidates.longest.data();
  double longest2 = 0.0, shortest2 = std::numeric_limits<double>::infinity();
#pragma omp simd reduction(max : longest2) reduction(min : shortest2)
  for (std::size_t t = 0; t < candidates.triangle_count(); ++t) {
    longest2 = larger(longest2, longest[t]);
    shortest2 = smaller(shortest2, smaller(smaller(l01[t], l12[t]), l20[t]));
  }
  const std::size_t padded = candidates.padded_triangle_count();
  return {longest2,
          shortest2,
          {core::sum_lanes(candidates.ax.data(), padded), core::sum_lanes(candidates.ay.data(), padded),
           core::sum_lanes(candidates.az.data(), padded)}};
}

}  // namespace

TriangleSums measure_triangles(MeshCandidates& candidates) noexcept {
  measure_each(candidates);
  return sum_up(candidates);
}

ABRADEM_DISPATCH void measure_nodes(MeshCandidates& candidates, std::vector<double>& scratch) {
  // Area and area vector stand together, so that a corner is one addition.
  using Four = double __attribute__((vector_size(32), aligned(8), may_alias));
  const std::size_t nodes = candidates.x.size();
  scratch.assign(4 * nodes, 0.0);
  for (std::size_t t = 0; t < candidates.triangle_count(); ++t) {
    const Four third = Four{candidates.area[t], candidates.ax[t], candidates.ay[t], candidates.az[t]} / 3.0;
    for (const std::int32_t v : {candidates.v0[t], candidates.v1[t], candidates.v2[t]}) {
      Four sum;  // copied: clang takes a pointer to four for an aligned one
      double* around = scratch.data() + 4 * static_cast<std::size_t>(v);
      __builtin_memcpy(&sum, around, sizeof sum);
      sum += third;
      __builtin_memcpy(around, &sum, sizeof sum);
    }
  }
  for (std::size_t i = 0; i < nodes; ++i) {
    const double* around = scratch.data() + 4 * i;
    candidates.node_area[i] = around[0];
    candidates.bx[i] = around[1], candidates.by[i] = around[2], candidates.bz[i] = around[3];
  }
}

ABRADEM_DISPATCH double least_facing(const MeshCandidates& candidates, const Vec3& direction,
                                     double cosine) noexcept {
  const double* __restrict ax = candidates.ax.data();
  const double* __restrict ay = candidates.ay.data();
  const double* __restrict az = candidates.az.data();
  const double* __restrict area = candidates.area.data();
  double least = std::numeric_limits<double>::infinity();
#pragma omp simd reduction(min : least)
  for (std::size_t t = 0; t < candidates.triangle_count(); ++t)
    least =
        smaller(least, ax[t] * direction.x + ay[t] * direction.y + az[t] * direction.z - cosine * area[t]);
  return least;
}

ABRADEM_DISPATCH double centroid_motion(const MeshCandidates& candidates, std::span<const NodeMotion> motion,
                                        std::vector<double>& scratch) {
  // A node's four numbers stand together, so that a corner is one addition.
  using Four = double __attribute__((vector_size(32), aligned(8), may_alias));
  const std::size_t count = candidates.padded_triangle_count();
  if (scratch.size() < 2 * count) scratch.resize(2 * count);
  const double* __restrict area = candidates.area.data();
  double* __restrict swept = scratch.data();
  double* __restrict inside = scratch.data() + count;
  for (std::size_t t = 0; t < count; ++t) {
    Four at0, at1, at2;  // copied: clang takes a pointer to four for an aligned one
    __builtin_memcpy(&at0, motion.data() + candidates.v0[t], sizeof at0);
    __builtin_memcpy(&at1, motion.data() + candidates.v1[t], sizeof at1);
    __builtin_memcpy(&at2, motion.data() + candidates.v2[t], sizeof at2);
    const Four sum = at0 + at1 + at2;
    const Four square = sum * sum;
    swept[t] = (square[0] + square[1]) + square[2];
    inside[t] = sum[3];
  }
#pragma omp simd
  for (std::size_t t = 0; t < count; ++t)
    swept[t] = inside[t] > 0.0 ? std::sqrt(swept[t]) * area[t] * (1.0 / 3.0) : 0.0;
  return core::sum_lanes(swept, count);
}

}  // namespace abradem::contact::kernels
