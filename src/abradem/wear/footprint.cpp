// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/wear/footprint.h"

#include <algorithm>
#include <cmath>

#include "abradem/contact/overlap_series.h"
#include "abradem/contact/triangle_excess.h"
#include "abradem/core/simd.h"
#include "abradem/wear/radial_integrals.h"

namespace abradem::wear {

namespace {

using contact::CandidateTriangle;
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
  [[nodiscard]] HertzBall ball(double R) const { return {0.5 * base + R}; }
};

struct OverlapWeight {
  ABRADEM_INLINE double operator()(double e) const { return of_depth(depth(e)); }
  ABRADEM_INLINE double of_depth(double g) const { return g > 0.0 ? g : 0.0; }
  [[nodiscard]] OverlapBall ball(double R) const { return {R}; }
};

/// depth() of a shallow excess (nodes count only there) without root or quotient; negative wherever e is.
ABRADEM_INLINE double shallow_depth(double e) {
  using contact::series::kOverlap;
  return e * (kOverlap[1] + e * (kOverlap[2] + e * (kOverlap[3] + e * (kOverlap[4] + e * kOverlap[5]))));
}

/// Excess at the rim of Hertz's disc.
double hertz_rim(double R, double deepest, double d_e) noexcept {
  const double g = (deepest - 0.5 * d_e) / R;
  return g * (2.0 - g);
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

/// A triangle by its excess at the corners, and its squared edges in units of R^2.
struct Corners {
  double e0, e1, e2, l01, l12, l20;
};

/// Excess of the sphere at points of a triangle: along a line a parabola of curvature -2.
ABRADEM_DISPATCH void excess_at(std::size_t padded_count, const Corners& corners, const double* __restrict b1,
                                const double* __restrict b2, double* __restrict e) {
  const auto [e0, e1, e2, l01, l12, l20] = corners;
  for (std::size_t i = 0; i < padded_count; ++i) {
    const double b0 = 1.0 - b1[i] - b2[i];
    e[i] = b0 * (e0 + b1[i] * l01 + b2[i] * l20) + b1[i] * (e1 + b2[i] * l12) + b2[i] * e2;
  }
}

/// Sums of weight times share of area: of all points, and with the coordinates of vertices 1 and 2.
struct Moments {
  double all, with1, with2;
};
template <typename Weight>
ABRADEM_INLINE Moments weigh(std::size_t padded_count, const double* __restrict e,
                             const double* __restrict share, const double* __restrict b1,
                             const double* __restrict b2, double* __restrict w, const Weight weight) {
  for (std::size_t i = 0; i < padded_count; ++i) w[i] = share[i] * weight(e[i]);
  core::Lanes all{}, with1{}, with2{};
  for (std::size_t i = 0; i < padded_count; i += MeshCandidates::kLanes) {
    core::Lanes wi, at1, at2;
    core::load_lanes(wi, w + i);
    core::load_lanes(at1, b1 + i);
    core::load_lanes(at2, b2 + i);
    all += wi;
    with1 += wi * at1;
    with2 += wi * at2;
  }
  return {ABRADEM_SUM_LANES(all), ABRADEM_SUM_LANES(with1), ABRADEM_SUM_LANES(with2)};
}

ABRADEM_DISPATCH Moments weigh_points(std::size_t padded_count, const double* __restrict e,
                                      const double* __restrict share, const double* __restrict b1,
                                      const double* __restrict b2, double* __restrict w,
                                      const HertzWeight weight) {
  return weigh(padded_count, e, share, b1, b2, w, weight);
}
ABRADEM_DISPATCH Moments weigh_points(std::size_t padded_count, const double* __restrict e,
                                      const double* __restrict share, const double* __restrict b1,
                                      const double* __restrict b2, double* __restrict w,
                                      const OverlapWeight weight) {
  return weigh(padded_count, e, share, b1, b2, w, weight);
}

}  // namespace

const FootprintShares& FootprintIntegrator::hertz(const MeshCandidates& candidates, const OverlapField& field,
                                                  double d_e, bool by_elements, std::span<const char> mask) {
  return integrate(candidates, field, hertz_rim(field.R, field.deepest, d_e), std::sqrt(field.R * d_e),
                   by_elements, mask, HertzWeight{d_e - 2.0 * field.deepest, 2.0 * field.R});
}

const FootprintShares& FootprintIntegrator::hertz(std::span<const CandidateTriangle> triangles,
                                                  const Ball& ball, double d_e) {
  return integrate(triangles, ball, hertz_rim(ball.R, ball.deepest, d_e),
                   HertzWeight{d_e - 2.0 * ball.deepest, 2.0 * ball.R});
}

const FootprintShares& FootprintIntegrator::overlap(std::span<const CandidateTriangle> triangles,
                                                    const Ball& ball) {
  return integrate(triangles, ball, 0.0, OverlapWeight{});
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
  const auto masked_out = [&](std::size_t t) { return !mask.empty() && mask[t] == 0; };
  if (!worn) {
    under_.clear();
    for (std::size_t t = 0; t < n; ++t)
      if (!masked_out(t)) under_.push_back(candidates.triangle_at(t));
    integrate(under_, {field.c, field.R, field.deepest}, cut, weight);
    for (std::vector<double>* array : {&at0_, &at1_, &at2_}) {
      array->resize(candidates.padded_triangle_count());
      for (std::size_t k = under_.size(); k > 0; --k)  // from k - 1 to its place among all
        std::swap((*array)[static_cast<std::size_t>(under_[k - 1].local)], (*array)[k - 1]);
    }
    return share_out(n);
  }

  for (auto* array : {&at0_, &at1_, &at2_}) array->assign(candidates.padded_triangle_count(), 0.0);
  // Points no further apart than a fifth of the footprint's radius; the sliding averages what is left.
  constexpr int kFinest = 48;
  // Compared as it is: a spot of no size asks for infinitely many, a state that is not a number for none.
  const double wanted = 2.0 * kEdgesPerReach / edges;
  choose_points(wanted < kFinest ? std::max(static_cast<int>(std::ceil(wanted)), 2) : kFinest);
  shares_.total = 0.0;
  for (std::size_t t = 0; t < n; ++t) {
    if (bound(candidates, field, t) <= cut || masked_out(t)) continue;
    subdivide(candidates, field, t, weight);
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
  return share_out(n);
}

const FootprintShares& FootprintIntegrator::share_out(std::size_t count) noexcept {
  shares_.count = count;
  shares_.at0 = at0_;
  shares_.at1 = at1_;
  shares_.at2 = at2_;
  return shares_;
}

/// The sphere is as new: a weight of the distance from its centre.
template <typename Weight>
const FootprintShares& FootprintIntegrator::integrate(std::span<const CandidateTriangle> triangles,
                                                      const Ball& ball, double cut, const Weight& weight) {
  const double inverse = 1.0 / (ball.R * ball.R);
  const auto excess = [&](const Vec3& corner) { return 1.0 - norm2(corner - ball.c) * inverse; };
  for (auto* array : {&at0_, &at1_, &at2_}) array->assign(triangles.size(), 0.0);
  shares_.nodal = false;
  shares_.total = 0.0;
  for (std::size_t k = 0; k < triangles.size(); ++k) {
    const auto& [p0, p1, p2] = triangles[k].corner;
    const double e0 = excess(p0), e1 = excess(p1), e2 = excess(p2);
    if (std::max({e0, e1, e2}) + triangles[k].longest * inverse / 3.0 <= cut) continue;
    const CornerIntegrals part =
        integrate_over_triangle(weight.ball(ball.R), p0 - ball.c, p1 - ball.c, p2 - ball.c);
    at0_[k] = part.at0;
    at1_[k] = part.at1;
    at2_[k] = part.at2;
    shares_.total += (part.at0 + part.at1) + part.at2;
  }
  if (!(shares_.total > 0.0) && !triangles.empty()) {
    // A spot too small for numbers: all of it to the triangle that reaches deepest.
    double most = -1.0;
    std::size_t deepest = 0;
    for (std::size_t k = 0; k < triangles.size(); ++k) {
      const auto& [p0, p1, p2] = triangles[k].corner;
      const double e = contact::triangle_excess(excess(p0), excess(p1), excess(p2), norm2(p1 - p0) * inverse,
                                                norm2(p2 - p1) * inverse, norm2(p0 - p2) * inverse);
      if (e > most) most = e, deepest = k;
    }
    at0_[deepest] = at1_[deepest] = at2_[deepest] = 1.0;
    shares_.total = 3.0;
  }
  return share_out(triangles.size());
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

void FootprintIntegrator::choose_points(int parts) {
  if (points_.parts == parts) return;
  points_.parts = parts;
  for (auto* array : {&points_.b1, &points_.b2, &points_.share}) array->clear();
  const double third = 1.0 / 3.0, step = 1.0 / parts;
  const auto add = [&](double b1, double b2, double share) {
    points_.b1.push_back(b1);
    points_.b2.push_back(b2);
    points_.share.push_back(share);
  };
  for (int i = 0; i < parts; ++i)
    for (int j = 0; i + j < parts; ++j) {
      add((i + third) * step, (j + third) * step, step * step);
      if (i + j + 1 < parts) add((i + 2 * third) * step, (j + 2 * third) * step, step * step);
    }
  while (points_.share.size() % MeshCandidates::kLanes != 0) add(third, third, 0.0);
  points_.e.resize(points_.share.size());
  points_.w.resize(points_.share.size());
}

/// Under a worn tip: centroid rule on equal parts of triangle t.
template <typename Weight>
void FootprintIntegrator::subdivide(const MeshCandidates& candidates, const OverlapField& field,
                                    std::size_t t, const Weight& weight) {
  const auto v0 = static_cast<std::size_t>(candidates.v0[t]), v1 = static_cast<std::size_t>(candidates.v1[t]),
             v2 = static_cast<std::size_t>(candidates.v2[t]);
  const double inverse = 1.0 / (field.R * field.R);
  const std::size_t n = points_.share.size();
  const double *b1 = points_.b1.data(), *b2 = points_.b2.data();
  double* e = points_.e.data();
  excess_at(n,
            {field.raw[v0], field.raw[v1], field.raw[v2], candidates.l01[t] * inverse,
             candidates.l12[t] * inverse, candidates.l20[t] * inverse},
            b1, b2, e);
  // From the excess of the sphere as new to that of the sphere as it is.
  const Vec3 p0 = candidates.node_position(v0) - field.c, p1 = candidates.node_position(v1) - field.c,
             p2 = candidates.node_position(v2) - field.c;
  for (std::size_t i = 0; i < n; ++i)
    e[i] = field.tip.excess(e[i], (1.0 - b1[i] - b2[i]) * p0 + b1[i] * p1 + b2[i] * p2, field.R);
  const Moments sum = weigh_points(n, e, points_.share.data(), b1, b2, points_.w.data(), weight);
  at0_[t] = candidates.area[t] * (sum.all - sum.with1 - sum.with2);
  at1_[t] = candidates.area[t] * sum.with1;
  at2_[t] = candidates.area[t] * sum.with2;
}

}  // namespace abradem::wear
