// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/wear/footprint.h"

#include <algorithm>
#include <cmath>

#include "abradem/core/simd.h"

namespace abradem::wear {

namespace {

using contact::MeshCandidates;

/// g / R of a point of excess e; the negative branch (outside the ball) included.
ABRADEM_INLINE double depth(double e) { return e / (1.0 + std::sqrt(1.0 - e)); }

struct HertzWeight {
  double base, R2;  // (d_e - 2 g_max), 2 R
  ABRADEM_INLINE double operator()(double e) const {
    const double w2 = base + R2 * depth(e);
    return std::sqrt(w2 > 0.0 ? w2 : 0.0);
  }
};

struct OverlapWeight {
  ABRADEM_INLINE double operator()(double e) const {
    const double g = depth(e);
    return g > 0.0 ? g : 0.0;
  }
};

/// Mid-edge rule, for triangles small against the footprint: the weight at the three mid-edges, each shared
/// by the two vertices of its edge.
template <typename Weight>
ABRADEM_INLINE void mid_edges(std::size_t n, const double* __restrict e0, const double* __restrict e1,
                              const double* __restrict e2, const double* __restrict l01,
                              const double* __restrict l12, const double* __restrict l20,
                              const double* __restrict area, double* __restrict w0, double* __restrict w1,
                              double* __restrict w2, const Weight weight) {
  for (std::size_t k = 0; k < n; ++k) {
    const double a = weight(0.5 * (e0[k] + e1[k]) + 0.25 * l01[k]);
    const double b = weight(0.5 * (e1[k] + e2[k]) + 0.25 * l12[k]);
    const double c = weight(0.5 * (e2[k] + e0[k]) + 0.25 * l20[k]);
    const double sixth = area[k] * (1.0 / 6.0);
    w0[k] = sixth * (c + a);
    w1[k] = sixth * (a + b);
    w2[k] = sixth * (b + c);
  }
}

#define ABRADEM_MID_EDGES(name, Weight)                                                                   \
  ABRADEM_DISPATCH void name(std::size_t n, const double* __restrict e0, const double* __restrict e1,     \
                             const double* __restrict e2, const double* __restrict l01,                   \
                             const double* __restrict l12, const double* __restrict l20,                  \
                             const double* __restrict area, double* __restrict w0, double* __restrict w1, \
                             double* __restrict w2, const Weight weight) {                                \
    mid_edges(n, e0, e1, e2, l01, l12, l20, area, w0, w1, w2, weight);                                    \
  }
ABRADEM_MID_EDGES(mid_edges_of, HertzWeight)
ABRADEM_MID_EDGES(mid_edges_of, OverlapWeight)
#undef ABRADEM_MID_EDGES

}  // namespace

const FootprintShares& FootprintIntegrator::hertz(const MeshCandidates& candidates, const OverlapField& field,
                                                  double d_e, std::span<const char> mask) {
  const double g_cut = (field.deepest - 0.5 * d_e) / field.R;
  select(candidates, field, g_cut * (2.0 - g_cut), mask);
  integrate(std::sqrt(field.R * d_e), HertzWeight{d_e - 2.0 * field.deepest, 2.0 * field.R});
  return shares_;
}

const FootprintShares& FootprintIntegrator::overlap(const MeshCandidates& candidates,
                                                    const OverlapField& field, std::span<const char> mask) {
  select(candidates, field, 0.0, mask);
  integrate(std::sqrt(2.0 * field.R * std::max(field.deepest, 0.0)), OverlapWeight{});
  return shares_;
}

/// Takes the triangles that may carry weight: those whose excess may pass the cut.
void FootprintIntegrator::select(const MeshCandidates& candidates, const OverlapField& field, double cut,
                                 std::span<const char> mask) {
  shares_.triangle.clear();
  const std::size_t capacity = candidates.padded_triangle_count();
  for (auto* array : {&e0_, &e1_, &e2_, &l01_, &l12_, &l20_, &area_, &w0_, &w1_, &w2_, &shares_.share,
                      &shares_.at0, &shares_.at1, &shares_.at2})
    array->resize(capacity);
  const double inverse = 1.0 / (field.R * field.R);
  longest_ = 0.0;
  std::size_t k = 0;
  for (std::size_t t = 0; t < candidates.triangle_count(); ++t) {
    if (field.bound[t] <= cut || (!mask.empty() && mask[t] == 0)) continue;
    shares_.triangle.push_back(static_cast<std::int32_t>(t));
    e0_[k] = field.e0[t], e1_[k] = field.e1[t], e2_[k] = field.e2[t];
    l01_[k] = candidates.l01[t] * inverse, l12_[k] = candidates.l12[t] * inverse;
    l20_[k] = candidates.l20[t] * inverse;
    area_[k] = candidates.area[t];
    longest_ = std::max(longest_, candidates.longest[t]);
    ++k;
  }
}

template <typename Weight>
void FootprintIntegrator::integrate(double reach, const Weight& weight) {
  // Points no further apart than a fifth of the footprint's radius; the sliding averages what is left.
  constexpr double kPointsPerReach = 5.0;
  constexpr int kFinest = 48;
  const double ratio = kPointsPerReach * std::sqrt(longest_) / (2.0 * reach);
  const std::size_t n = shares_.triangle.size();
  if (ratio <= 1.0) {
    const std::size_t padded = std::min(
        e0_.size(), (n + MeshCandidates::kLanes - 1) / MeshCandidates::kLanes * MeshCandidates::kLanes);
    mid_edges_of(padded, e0_.data(), e1_.data(), e2_.data(), l01_.data(), l12_.data(), l20_.data(),
                 area_.data(), w0_.data(), w1_.data(), w2_.data(), weight);
  } else {
    const int parts = std::min(kFinest, static_cast<int>(std::ceil(2.0 * ratio)));
    for (std::size_t k = 0; k < n; ++k) subdivide(k, parts, weight);
  }
  normalise();
}

/// Centroid rule on n^2 equal parts of triangle k.
template <typename Weight>
void FootprintIntegrator::subdivide(std::size_t k, int n, const Weight& weight) {
  double sum0 = 0.0, sum1 = 0.0, sum2 = 0.0;
  const double third = 1.0 / 3.0, step = 1.0 / n;
  const auto add = [&](double b1, double b2) {
    const double b0 = 1.0 - b1 - b2;
    const double e =
        b0 * e0_[k] + b1 * e1_[k] + b2 * e2_[k] + b0 * b1 * l01_[k] + b1 * b2 * l12_[k] + b2 * b0 * l20_[k];
    const double w = weight(e);
    sum0 += w * b0;
    sum1 += w * b1;
    sum2 += w * b2;
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; i + j < n; ++j) {
      add((i + third) * step, (j + third) * step);
      if (i + j + 1 < n) add((i + 2 * third) * step, (j + 2 * third) * step);
    }
  const double part = area_[k] * step * step;
  w0_[k] = part * sum0;
  w1_[k] = part * sum1;
  w2_[k] = part * sum2;
}

void FootprintIntegrator::normalise() {
  const std::size_t n = shares_.triangle.size();
  double total = 0.0;
  for (std::size_t k = 0; k < n; ++k) total += (w0_[k] + w1_[k]) + w2_[k];
  if (!(total > 0.0)) {  // a spot finer than the finest sampling: all of it to the triangle it lies in
    const auto highest = [&](std::size_t k) { return std::max({e0_[k], e1_[k], e2_[k]}) + l01_[k] / 3.0; };
    std::size_t best = 0;
    for (std::size_t k = 1; k < n; ++k)
      if (highest(k) > highest(best)) best = k;
    if (n > 0) w0_[best] = w1_[best] = w2_[best] = 1.0;
    total = 3.0;
  }
  const double inverse = 1.0 / total;
  std::size_t kept = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double share = ((w0_[k] + w1_[k]) + w2_[k]) * inverse;
    if (share == 0.0) continue;
    shares_.triangle[kept] = shares_.triangle[k];
    shares_.share[kept] = share;
    shares_.at0[kept] = w0_[k] * inverse;
    shares_.at1[kept] = w1_[k] * inverse;
    shares_.at2[kept] = w2_[k] * inverse;
    ++kept;
  }
  shares_.triangle.resize(kept);
}

}  // namespace abradem::wear
