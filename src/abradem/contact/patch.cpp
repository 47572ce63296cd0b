// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/contact/patch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "abradem/contact/overlap_integrals.h"
#include "abradem/contact/patch_kernels.h"
#include "abradem/contact/triangle_excess.h"

namespace abradem::contact {

namespace {

/// The fast formulas hold for overlaps below about 3 % of R and edges below about a third of the disc's
/// radius; there their error in force is below 1e-6 (tests/unit/contact/patch_test.cpp).
constexpr double kLargestFastExcess = 0.06;
constexpr double kLargestFastEdge2 = 0.1;  // of the disc's radius squared

/// Depth R - r of a point of excess e = 1 - (r / R)^2; negative outside the ball.
double depth_of(double excess, double R) noexcept { return R * excess / (1.0 + std::sqrt(1.0 - excess)); }

}  // namespace

double patch_stiffness(const PairProperties& pair, double R, double delta) noexcept {
  return 4.0 * pair.E_eff / (3.0 * std::numbers::pi * std::sqrt(R * delta) * (1.0 - 2.0 * delta / (3.0 * R)));
}

std::span<const Patch> PatchEvaluator::evaluate(const MeshCandidates& candidates, const Vec3& c, double R,
                                                const PairProperties& pair, const Tip& tip) {
  patches_.clear();
  clusters_.clear();
  excess_.resize(candidates.x.size());
  largest_excess_ = kernels::node_excess(candidates, c, R, excess_);
  by_nodes_ = !tip.worn() && evaluate_nodes(candidates, c, R, pair);
  if (tip.worn())
    evaluate_worn(candidates, c, R, pair, tip);
  else if (!by_nodes_)
    evaluate_triangles(candidates, c, R, pair);
  return patches_;
}

double fineness(double a, double width) noexcept {
  constexpr double kCoarse = 0.5, kFine = 1.0;
  const double x = std::clamp((a / width - kCoarse) / (kFine - kCoarse), 0.0, 1.0);
  return x * x * (3.0 - 2.0 * x);
}

double width_of(const CandidateTriangle& triangle) noexcept {
  return 4.0 / std::numbers::sqrt3 * triangle.area / std::sqrt(triangle.longest);
}

double width_of(const MeshCandidates& candidates, std::size_t t) noexcept {
  return 4.0 / std::numbers::sqrt3 * candidates.area[t] / std::sqrt(candidates.longest[t]);
}

double PatchEvaluator::fineness_of(const MeshCandidates& candidates, std::span<const int> labels, int label,
                                   double a) const noexcept {
  if (by_nodes_) return 1.0;  // which is taken for edges below half the contact's radius alone
  double sum = 0.0, fine = 0.0;
  for (std::size_t t = 0; t < active_; ++t) {
    if (!(mean_g_[t] > 0.0) || (!labels.empty() && labels[t] != label)) continue;
    const double G = mean_g_[t] * candidates.area[t];
    sum += G;
    fine += G * fineness(a, width_of(candidates, t));
  }
  return sum > 0.0 ? fine / sum : -1.0;
}

void PatchEvaluator::forget() noexcept {
  patches_.clear();
  clusters_.clear();
  excess_.clear();
  raw_.clear();
}

/// The nodal way; false where it does not apply.
bool PatchEvaluator::evaluate_nodes(const MeshCandidates& candidates, const Vec3& c, double R,
                                    const PairProperties& pair) {
  if (!candidates.nearly_flat() || !(largest_excess_ > 0.0) || largest_excess_ > kLargestFastExcess ||
      candidates.longest_edge2 > kLargestFastEdge2 * largest_excess_ * R * R)
    return false;
  const double overlap = R - dot(candidates.mean_normal, c - candidates.mean_point);
  if (!(overlap > 0.0)) return false;
  // Behind the last node inside the ball, or inside once moved into the plane, there is nothing to sum.
  const double below = candidates.below_plane, distance = R - overlap;
  const std::size_t count = MeshCandidates::count_above(excess_, -below * (2.0 * distance + below) / (R * R));
  const kernels::NodeSums s = kernels::node_sums(candidates, c, R, std::span(excess_).first(count), scratch_);
  // The nodal rule errs by some tenths of a per cent of what it integrates, so that must be a small part.
  constexpr double kLargestDifference = 0.3;
  const double along = dot(s.G, candidates.mean_normal);
  if (std::abs(along - s.G_plane) > kLargestDifference * along) return false;

  const OverlapIntegrals plane = overlap_of_plane(overlap, R);
  const Vec3 G = R * s.G + (plane.G - R * s.G_plane) * candidates.mean_normal;
  const double M = R * s.M + (plane.M - R * s.M_plane);

  // The deepest point lies in a triangle of the deepest node.
  deepest_excess_ = largest_excess_;
  const auto node =
      static_cast<std::size_t>(std::find(excess_.begin(), excess_.end(), largest_excess_) - excess_.begin());
  const double inverse = 1.0 / (R * R);
  for (auto k = candidates.star_start[node]; k < candidates.star_start[node + 1]; ++k) {
    const auto t = static_cast<std::size_t>(candidates.star[static_cast<std::size_t>(k)]);
    deepest_excess_ =
        std::max(deepest_excess_, triangle_excess(excess_[static_cast<std::size_t>(candidates.v0[t])],
                                                  excess_[static_cast<std::size_t>(candidates.v1[t])],
                                                  excess_[static_cast<std::size_t>(candidates.v2[t])],
                                                  candidates.l01[t] * inverse, candidates.l12[t] * inverse,
                                                  candidates.l20[t] * inverse));
  }
  if (const Patch patch = make_patch(G, M, depth_of(deepest_excess_, R), R, pair); patch.elastic_force > 0.0)
    patches_.push_back(patch);
  return true;
}

void PatchEvaluator::evaluate_triangles(const MeshCandidates& candidates, const Vec3& c, double R,
                                        const PairProperties& pair) {
  const std::size_t triangles = candidates.padded_triangle_count();
  for (auto* array : {&e0_, &e1_, &e2_, &mean_g_, &mean_m_, &bound_, &inside_, &height_})
    array->resize(triangles);
  for (std::size_t t = 0; t < triangles; ++t) {
    e0_[t] = excess_[static_cast<std::size_t>(candidates.v0[t])];
    e1_[t] = excess_[static_cast<std::size_t>(candidates.v1[t])];
    e2_[t] = excess_[static_cast<std::size_t>(candidates.v2[t])];
  }
  kernels::survey(candidates, c, R, e0_.data(), e1_.data(), e2_.data(), bound_.data(), inside_.data(),
                  height_.data());
  // Candidates are ordered outwards, so what overlaps stands in front.
  std::size_t last = candidates.triangle_count();
  while (last > 0 && bound_[last - 1] <= 0.0) --last;
  active_ = last;
  const std::size_t padded =
      (last + MeshCandidates::kLanes - 1) / MeshCandidates::kLanes * MeshCandidates::kLanes;

  const bool shallow = largest_excess_ > 0.0 && largest_excess_ < kLargestFastExcess;
  const double limit = shallow ? kLargestFastEdge2 * largest_excess_ * R * R : 0.0;
  kernels::whole_triangles(padded, candidates, e0_.data(), e1_.data(), e2_.data(), inside_.data(), R, limit,
                           mean_g_.data(), mean_m_.data());
  deepest_excess_ = largest_excess_;
  classify(candidates, R, limit);
  integrate_rim();
  integrate_exactly(candidates, c, R);
  if (!overlaps_) return;
  deepest_points(candidates, R);
  if (candidates.nearly_flat())
    single(candidates, padded, R, pair);
  else
    cluster(candidates, c, R, pair);
}

/// Sorts the triangles into: whole and small (done), cut by the rim, everything else that may overlap. The
/// first pass compacts without branches: which triangles the rim cuts is as good as random.
void PatchEvaluator::classify(const MeshCandidates& candidates, double R, double limit) {
  rim_.resize(active_);
  general_.clear();
  cut_.resize(active_);
  deep_.resize(active_);
  std::size_t cut = 0, deep = 0;
  bool touched = false;
  const double deepest = deepest_excess_;
  for (std::size_t t = 0; t < active_; ++t) {
    const double bound = bound_[t], inside = inside_[t];
    const bool whole = (inside == 3.0) & (candidates.longest[t] <= limit);
    cut_[cut] = static_cast<std::int32_t>(t);
    cut += static_cast<std::size_t>((bound > 0.0) & !whole);
    deep_[deep] = static_cast<std::int32_t>(t);
    deep += static_cast<std::size_t>(bound > deepest);
    touched |= inside != 0.0;
  }
  deep_.resize(deep);
  overlaps_ = touched;
  for (std::size_t k = 0; k < cut; ++k) {
    const auto t = static_cast<std::size_t>(cut_[k]);
    if (candidates.longest[t] > limit)
      general_.push_back(cut_[k]);
    else if (inside_[t] == 0.0)
      add_caps(candidates, t, R);
    else
      add_rim(candidates, t, R);
  }
}

/// A small triangle whose corners are all outside: the ball may still reach over its edges.
void PatchEvaluator::add_caps(const MeshCandidates& candidates, std::size_t t, double R) {
  const double inverse = 1.0 / (R * R);
  const double l[3]{candidates.l01[t] * inverse, candidates.l12[t] * inverse, candidates.l20[t] * inverse};
  const double w2[3]{edge_excess(e0_[t], e1_[t], l[0]), edge_excess(e1_[t], e2_[t], l[1]),
                     edge_excess(e2_[t], e0_[t], l[2])};
  const double d = height_[t] / (candidates.area[t] * R);
  for (const double w : w2) {
    if (w <= 0.0) continue;
    const auto [g, m] = kernels::cap(w, 1.0 - d * d, candidates.area[t] * inverse);
    mean_g_[t] += g;
    mean_m_[t] += m;
  }
  overlaps_ = overlaps_ || mean_g_[t] > 0.0;
}

void PatchEvaluator::Rim::resize(std::size_t capacity) {
  count = 0;
  const std::size_t size =
      (capacity + MeshCandidates::kLanes) / MeshCandidates::kLanes * MeshCandidates::kLanes;
  if (triangle.size() >= size) return;
  for (auto* array : {&e0, &e1, &e2, &l01, &l12, &l20, &height, &inside, &g, &m}) array->resize(size, 1.0);
  triangle.resize(size, 0);
}

void PatchEvaluator::add_rim(const MeshCandidates& candidates, std::size_t t, double R) {
  const double inverse = 1.0 / (R * R);
  // Twice around, so that turning needs no branch.
  const double e[5]{e0_[t], e1_[t], e2_[t], e0_[t], e1_[t]};
  const double l[5]{candidates.l01[t], candidates.l12[t], candidates.l20[t], candidates.l01[t],
                    candidates.l12[t]};
  // The odd vertex is the one whose side no other shares.
  const bool inside = inside_[t] == 1.0;
  const auto odd =
      static_cast<std::size_t>((e[1] > 0.0) == inside) + 2 * static_cast<std::size_t>((e[2] > 0.0) == inside);
  const std::size_t k = rim_.count++;
  rim_.e0[k] = e[odd], rim_.e1[k] = e[odd + 1], rim_.e2[k] = e[odd + 2];
  rim_.l01[k] = l[odd] * inverse, rim_.l12[k] = l[odd + 1] * inverse, rim_.l20[k] = l[odd + 2] * inverse;
  rim_.height[k] = height_[t] * (inverse / R);
  rim_.inside[k] = inside ? 1.0 : 0.0;
  rim_.triangle[k] = static_cast<std::int32_t>(t);
}

void PatchEvaluator::integrate_rim() {
  constexpr std::size_t lanes = MeshCandidates::kLanes;
  const std::size_t padded = (rim_.count + lanes - 1) / lanes * lanes;
  kernels::rim_triangles(padded,
                         {rim_.e0.data(), rim_.e1.data(), rim_.e2.data(), rim_.l01.data(), rim_.l12.data(),
                          rim_.l20.data(), rim_.height.data(), rim_.inside.data()},
                         rim_.g.data(), rim_.m.data());
  for (std::size_t k = 0; k < rim_.count; ++k) {
    mean_g_[static_cast<std::size_t>(rim_.triangle[k])] = rim_.g[k];
    mean_m_[static_cast<std::size_t>(rim_.triangle[k])] = rim_.m[k];
  }
}

void PatchEvaluator::integrate_exactly(const MeshCandidates& candidates, const Vec3& c, double R) {
  for (const std::int32_t index : general_) {
    const auto t = static_cast<std::size_t>(index);
    const OverlapIntegrals overlap =
        overlap_of_triangle(candidates.node_position(static_cast<std::size_t>(candidates.v0[t])) - c,
                            candidates.node_position(static_cast<std::size_t>(candidates.v1[t])) - c,
                            candidates.node_position(static_cast<std::size_t>(candidates.v2[t])) - c, R);
    if (!(overlap.G > 0.0)) continue;
    mean_g_[t] = overlap.G / (R * candidates.area[t]);
    mean_m_[t] = height_[t] != 0.0 ? overlap.M / (R * height_[t]) : 0.0;
    overlaps_ = true;
  }
}

void PatchEvaluator::deepest_points(const MeshCandidates& candidates, double R) {
  const double inverse = 1.0 / (R * R);
  for (const std::int32_t index : deep_) {
    const auto t = static_cast<std::size_t>(index);
    deepest_excess_ =
        std::max(deepest_excess_, triangle_excess(e0_[t], e1_[t], e2_[t], candidates.l01[t] * inverse,
                                                  candidates.l12[t] * inverse, candidates.l20[t] * inverse));
  }
}

Patch make_patch(const Vec3& G, double M, double deepest, double R, const PairProperties& pair) noexcept {
  const double size = norm(G);
  Patch patch;
  patch.overlap = equivalent_overlap(M, R);
  if (!(patch.overlap > 0.0) || !(size > 0.0)) return {};
  patch.n = G / size;
  patch.elastic_force = patch_stiffness(pair, R, patch.overlap) * size;
  patch.deepest = deepest;
  return patch;
}

void PatchEvaluator::single(const MeshCandidates& candidates, std::size_t padded, double R,
                            const PairProperties& pair) {
  const auto s = kernels::sums(padded, candidates, height_.data(), mean_g_.data(), mean_m_.data());
  const Patch patch = make_patch(R * Vec3{s[0], s[1], s[2]}, R * s[3], depth_of(deepest_excess_, R), R, pair);
  if (patch.elastic_force > 0.0) patches_.push_back(patch);
}

}  // namespace abradem::contact
