// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/wear/footprint.h"

#include <algorithm>
#include <cmath>

#include "abradem/contact/overlap_series.h"
#include "abradem/contact/triangle_excess.h"
#include "abradem/core/simd.h"

namespace abradem::wear {

namespace {

using contact::MeshCandidates;

/// g / R of a point of excess e; the negative branch (outside the ball) included.
ABRADEM_INLINE double depth(double e) { return e / (1.0 + std::sqrt(1.0 - e)); }

struct HertzWeight {
  double base, twice_R;  // d_e - 2 g_max, 2 R
  ABRADEM_INLINE double operator()(double e) const { return of_depth(depth(e)); }
  ABRADEM_INLINE double of_depth(double g) const {
    const double w2 = base + twice_R * g;
    return std::sqrt(w2 > 0.0 ? w2 : 0.0);
  }
};

struct OverlapWeight {
  ABRADEM_INLINE double operator()(double e) const { return of_depth(depth(e)); }
  ABRADEM_INLINE double of_depth(double g) const { return g > 0.0 ? g : 0.0; }
};

/// depth() of a shallow excess (nodes count only there) without root or quotient; negative wherever e is.
ABRADEM_INLINE double shallow_depth(double e) {
  using contact::series::kOverlap;
  return e * (kOverlap[1] + e * (kOverlap[2] + e * (kOverlap[3] + e * (kOverlap[4] + e * kOverlap[5]))));
}

/// Weight times area of each node, and their sum.
template <typename Weight>
ABRADEM_INLINE double nodes(std::size_t padded_count, const double* __restrict excess,
                            const double* __restrict area, double* __restrict load, const Weight weight) {
  for (std::size_t i = 0; i < padded_count; ++i)
    load[i] = area[i] * weight.of_depth(shallow_depth(excess[i]));
  return core::sum_lanes(load, padded_count);
}

ABRADEM_DISPATCH double load_nodes(std::size_t padded_count, const double* __restrict excess,
                                   const double* __restrict area, double* __restrict load,
                                   const HertzWeight weight) {
  return nodes(padded_count, excess, area, load, weight);
}
ABRADEM_DISPATCH double load_nodes(std::size_t padded_count, const double* __restrict excess,
                                   const double* __restrict area, double* __restrict load,
                                   const OverlapWeight weight) {
  return nodes(padded_count, excess, area, load, weight);
}

}  // namespace

const FootprintShares& FootprintIntegrator::hertz(const MeshCandidates& candidates, const OverlapField& field,
                                                  double d_e, bool by_elements, std::span<const char> mask) {
  const double g_cut = (field.deepest - 0.5 * d_e) / field.R;
  return integrate(candidates, field, g_cut * (2.0 - g_cut), std::sqrt(field.R * d_e), by_elements, mask,
                   HertzWeight{d_e - 2.0 * field.deepest, 2.0 * field.R});
}

const FootprintShares& FootprintIntegrator::overlap(const MeshCandidates& candidates,
                                                    const OverlapField& field, bool by_elements,
                                                    std::span<const char> mask) {
  return integrate(candidates, field, 0.0, std::sqrt(2.0 * field.R * std::max(field.deepest, 0.0)),
                   by_elements, mask, OverlapWeight{});
}

template <typename Weight>
const FootprintShares& FootprintIntegrator::integrate(const MeshCandidates& candidates,
                                                      const OverlapField& field, double cut, double reach,
                                                      bool by_elements, std::span<const char> mask,
                                                      const Weight& weight) {
  // Nodes alone are enough where at least five of them span the footprint.
  constexpr double kEdgesPerReach = 2.5;
  constexpr double kShallow = 0.03;  // of R: there the series of shallow_depth errs by less than 1e-8
  const double edges = reach / std::sqrt(candidates.longest_edge2);
  // A worn tip touches over more than that radius: as many nodes as such a disc holds are enough.
  constexpr std::ptrdiff_t kEnoughNodes = 20;
  const bool worn = !field.raw.empty();
  shares_.nodal =
      (edges >= kEdgesPerReach || worn) && field.deepest < kShallow * field.R && !by_elements && mask.empty();
  if (shares_.nodal) {
    at_node_.resize(MeshCandidates::count_above(field.excess, cut));
    shares_.total = load_nodes(at_node_.size(), field.excess.data(), candidates.node_area.data(),
                               at_node_.data(), weight);
    shares_.at_node = at_node_;
    const bool enough = edges >= kEdgesPerReach ||
                        std::ranges::count_if(at_node_, [](double w) { return w > 0.0; }) >= kEnoughNodes;
    if (shares_.total > 0.0 && enough) return shares_;
    shares_.nodal = false;
  }

  // Candidates are ordered outwards, so what is loaded stands in front.
  std::size_t n = candidates.triangle_count();
  while (n > 0 && bound(candidates, field, n - 1) <= cut) --n;
  for (auto* array : {&at0_, &at1_, &at2_}) array->assign(candidates.padded_triangle_count(), 0.0);
  // Points no further apart than a fifth of the footprint's radius; the sliding averages what is left.
  constexpr int kFinest = 48;
  // Compared as it is: a spot of no size asks for infinitely many, a state that is not a number for none.
  const double wanted = 2.0 * kEdgesPerReach / edges;
  const int parts = wanted < kFinest ? std::max(static_cast<int>(std::ceil(wanted)), 2) : kFinest;
  const auto masked_out = [&](std::size_t t) { return !mask.empty() && mask[t] == 0; };
  // The excess of a worn tip at a point of triangle t, from that of the sphere as new.
  const auto worn_excess_of = [&](std::size_t t) {
    const auto p = [&](std::int32_t v) {
      return candidates.node_position(static_cast<std::size_t>(v)) - field.c;
    };
    return [&, p0 = p(candidates.v0[t]), p1 = p(candidates.v1[t]), p2 = p(candidates.v2[t])](
               double e, double b0, double b1, double b2) {
      return field.tip.excess(e, b0 * p0 + b1 * p1 + b2 * p2, field.R);
    };
  };
  shares_.total = 0.0;
  for (std::size_t t = 0; t < n; ++t) {
    if (bound(candidates, field, t) <= cut || masked_out(t)) continue;
    if (worn)
      subdivide(candidates, field, t, parts, weight, worn_excess_of(t));
    else
      subdivide(candidates, field, t, parts, weight, [](double e, double, double, double) { return e; });
    shares_.total += (at0_[t] + at1_[t]) + at2_[t];
  }
  if (!(shares_.total > 0.0) && n > 0) {
    // A spot finer than the finest sampling: all of it to the triangle that reaches deepest.
    const auto deepest = [&](std::size_t t) {
      const auto e = [&](std::int32_t v) { return field.excess[static_cast<std::size_t>(v)]; };
      const double inverse = 1.0 / (field.R * field.R);
      return contact::triangle_excess(e(candidates.v0[t]), e(candidates.v1[t]), e(candidates.v2[t]),
                                      candidates.l01[t] * inverse, candidates.l12[t] * inverse,
                                      candidates.l20[t] * inverse);
    };
    std::size_t best = 0;
    for (std::size_t t = 1; t < n; ++t)
      if (!masked_out(t) && (masked_out(best) || deepest(t) > deepest(best))) best = t;
    at0_[best] = at1_[best] = at2_[best] = 1.0;
    shares_.total = 3.0;
  }
  shares_.count = n;
  shares_.at0 = at0_;
  shares_.at1 = at1_;
  shares_.at2 = at2_;
  return shares_;
}

/// No point of triangle t has a larger excess: squared distances are convex.
double FootprintIntegrator::bound(const MeshCandidates& candidates, const OverlapField& field,
                                  std::size_t t) noexcept {
  const std::span<const double> excess = field.raw.empty() ? field.excess : field.raw;
  return std::max({excess[static_cast<std::size_t>(candidates.v0[t])],
                   excess[static_cast<std::size_t>(candidates.v1[t])],
                   excess[static_cast<std::size_t>(candidates.v2[t])]}) +
         candidates.longest[t] / (3.0 * field.R * field.R);
}

/// Centroid rule on parts^2 equal parts of triangle t. @param excess_of (excess of the sphere as new at a
/// point, its barycentric coordinates) -> excess of the sphere as it is
template <typename Weight, typename ExcessOf>
void FootprintIntegrator::subdivide(const MeshCandidates& candidates, const OverlapField& field,
                                    std::size_t t, int parts, const Weight& weight,
                                    const ExcessOf& excess_of) {
  const std::span<const double> excess = field.raw.empty() ? field.excess : field.raw;
  const double inverse = 1.0 / (field.R * field.R);
  const double l01 = candidates.l01[t] * inverse, l12 = candidates.l12[t] * inverse,
               l20 = candidates.l20[t] * inverse;
  const double e0 = excess[static_cast<std::size_t>(candidates.v0[t])];
  const double e1 = excess[static_cast<std::size_t>(candidates.v1[t])];
  const double e2 = excess[static_cast<std::size_t>(candidates.v2[t])];
  double sum0 = 0.0, sum1 = 0.0, sum2 = 0.0;
  const double third = 1.0 / 3.0, step = 1.0 / parts;
  const auto add = [&](double b1, double b2) {
    const double b0 = 1.0 - b1 - b2;
    // Along a line the excess is a parabola of curvature -2.
    const double e = b0 * e0 + b1 * e1 + b2 * e2 + b0 * b1 * l01 + b1 * b2 * l12 + b2 * b0 * l20;
    const double w = weight(excess_of(e, b0, b1, b2));
    sum0 += w * b0;
    sum1 += w * b1;
    sum2 += w * b2;
  };
  for (int i = 0; i < parts; ++i)
    for (int j = 0; i + j < parts; ++j) {
      add((i + third) * step, (j + third) * step);
      if (i + j + 1 < parts) add((i + 2 * third) * step, (j + 2 * third) * step);
    }
  const double part = candidates.area[t] * step * step;
  at0_[t] = part * sum0;
  at1_[t] = part * sum1;
  at2_[t] = part * sum2;
}

}  // namespace abradem::wear
