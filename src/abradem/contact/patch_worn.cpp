// SPDX-License-Identifier: BSD-3-Clause
// The patch of a sphere with a worn tip: the same integrals, with the tip's recession taken from the overlap.
#include <algorithm>
#include <cmath>

#include "abradem/contact/overlap_series.h"
#include "abradem/contact/patch.h"
#include "abradem/contact/patch_kernels.h"

namespace abradem::contact {

namespace {

/// Nodes inside the ball from which they alone carry the integrals: as many as lie within two and a half
/// edges of one another.
constexpr std::ptrdiff_t kEnoughNodes = 20;
constexpr double kLargestSeriesExcess = 0.06;

std::size_t at(std::int32_t i) noexcept { return static_cast<std::size_t>(i); }

/// g / R of a point of excess e > 0.
double overlap_of(double e) noexcept { return e / (1.0 + std::sqrt(1.0 - e)); }
/// Its weight of M; see overlap_series.h.
double weighted_of(double e) noexcept {
  const double r = std::sqrt(1.0 - e), g = overlap_of(e);
  if (g > 1e-2) return 1.0 / (12.0 * r * r * r) - 1.0 / 3.0 + r / 4.0;
  return e * e *
         (series::kWeighted[2] +
          e * (series::kWeighted[3] + e * (series::kWeighted[4] + e * (series::kWeighted[5]))));
}

/// Do all nodes that the sphere as new reaches face alike, so that they are one patch? A worn tip presses on
/// a surface that has taken its shape: which of its spots overlap first says nothing.
bool faces_one_way(const MeshCandidates& m, std::span<const double> raw) noexcept {
  constexpr double kCos45Degrees2 = 0.5;
  for (std::size_t i = 0; i < m.node_count(); ++i) {
    if (!(raw[i] > 0.0)) continue;
    const Vec3 b{m.bx[i], m.by[i], m.bz[i]};
    const double along = dot(b, m.mean_normal);
    if (!(along > 0.0) || along * along < kCos45Degrees2 * norm2(b)) return false;
  }
  return true;
}

}  // namespace

void PatchEvaluator::evaluate_worn(const MeshCandidates& candidates, const Vec3& c, double R,
                                   const PairProperties& pair, const Tip& tip) {
  raw_ = excess_;
  correction_.apply(candidates, c, R, tip, raw_, excess_);
  largest_excess_ = *std::max_element(excess_.begin(), excess_.end());
  const bool one_way = candidates.nearly_flat() || faces_one_way(candidates, raw_);
  if (one_way && largest_excess_ < kLargestSeriesExcess &&
      std::ranges::count_if(excess_, [](double e) { return e > 0.0; }) >= kEnoughNodes) {
    const kernels::NodeSums s = kernels::node_sums(candidates, c, R, excess_, scratch_);
    const Patch patch = make_patch(R * s.G, R * s.M, R * overlap_of(largest_excess_), R, pair);
    if (patch.elastic_force > 0.0) patches_.push_back(patch);
    return;
  }

  const std::size_t triangles = candidates.padded_triangle_count();
  for (auto* array : {&e0_, &e1_, &e2_, &bound_, &inside_, &height_}) array->resize(triangles);
  for (std::size_t t = 0; t < triangles; ++t) {
    e0_[t] = raw_[at(candidates.v0[t])];
    e1_[t] = raw_[at(candidates.v1[t])];
    e2_[t] = raw_[at(candidates.v2[t])];
  }
  kernels::survey(candidates, c, R, e0_.data(), e1_.data(), e2_.data(), bound_.data(), inside_.data(),
                  height_.data());
  active_ = candidates.triangle_count();
  while (active_ > 0 && bound_[active_ - 1] <= 0.0) --active_;
  mean_g_.assign(triangles, 0.0);
  mean_m_.assign(triangles, 0.0);
  deepest_excess_ = std::max(largest_excess_, 0.0);
  overlaps_ = false;
  integrate_worn(candidates, c, R, tip);
  if (!overlaps_) return;
  const std::size_t padded =
      (active_ + MeshCandidates::kLanes - 1) / MeshCandidates::kLanes * MeshCandidates::kLanes;
  if (one_way)
    single(candidates, padded, R, pair);
  else
    tip_ = &tip, cluster(candidates, c, R, pair), tip_ = nullptr;
}

/// Centroid rule on parts of each triangle, two points of the map apart: what is finer the map does not hold.
void PatchEvaluator::integrate_worn(const MeshCandidates& candidates, const Vec3& c, double R,
                                    const Tip& tip) {
  constexpr int kFinest = 64;
  const double inverse = 1.0 / (R * R);
  for (std::size_t t = 0; t < active_; ++t) {
    if (bound_[t] <= 0.0) continue;
    const Vec3 p0 = candidates.node_position(at(candidates.v0[t])) - c;
    const Vec3 p1 = candidates.node_position(at(candidates.v1[t])) - c;
    const Vec3 p2 = candidates.node_position(at(candidates.v2[t])) - c;
    const int parts = std::clamp(
        static_cast<int>(std::ceil(std::sqrt(candidates.longest[t]) / (2.0 * tip.shape->cell))), 1, kFinest);
    const double step = 1.0 / parts, third = step / 3.0;
    double g = 0.0, m = 0.0;
    const auto add = [&](double b1, double b2) {
      const Vec3 x = (1.0 - b1 - b2) * p0 + b1 * p1 + b2 * p2;
      const double raw = 1.0 - norm2(x) * inverse;
      if (raw <= 0.0) return;
      const double e = tip.excess(raw, x, R);
      if (e <= 0.0) return;
      g += overlap_of(e);
      m += weighted_of(e);
      deepest_excess_ = std::max(deepest_excess_, e);
    };
    for (int i = 0; i < parts; ++i)
      for (int j = 0; i + j < parts; ++j) {
        add(i * step + third, j * step + third);
        if (i + j + 1 < parts) add(i * step + 2.0 * third, j * step + 2.0 * third);
      }
    mean_g_[t] = g * step * step;
    mean_m_[t] = m * step * step;
    overlaps_ = overlaps_ || g > 0.0;
  }
}

}  // namespace abradem::contact
