// SPDX-License-Identifier: BSD-3-Clause
// Which overlapped triangles make one contact. A nearly flat surface never comes here.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "abradem/contact/overlap_integrals.h"
#include "abradem/contact/patch.h"
#include "abradem/contact/triangle_links.h"
#include "abradem/geometry/closest_point.h"

namespace abradem::contact {

namespace {

constexpr double kCosSplit = 0.70710678118654752;  // 45 degrees: one spot does not reach round a corner
constexpr double kCosMerge = 0.93969262078590838;  // 20 degrees: two spots that face alike act as one

std::size_t at(std::int32_t i) noexcept { return static_cast<std::size_t>(i); }

struct Spot {
  std::int32_t triangle;  // local
  Vec3 direction;         // from its nearest point to the centre
  double depth;           // [m]
};

Vec3 corner(const MeshCandidates& m, std::size_t t, int k) noexcept {
  return m.node_position(at(k == 0 ? m.v0[t] : k == 1 ? m.v1[t] : m.v2[t]));
}

/// Joins triangles that share a vertex inside the ball, or an edge that the ball cuts.
TriangleLinks connect(const MeshCandidates& m, std::span<const Spot> spots, const Vec3& c, double R) {
  TriangleLinks links(m.triangle_count());
  struct SharedEdge {
    std::int32_t low, high, triangle;
  };
  std::vector<SharedEdge> edges;
  for (const Spot& spot : spots) {
    const std::size_t t = at(spot.triangle);
    const std::int32_t v[3]{m.v0[t], m.v1[t], m.v2[t]};
    for (int k = 0; k < 3; ++k) {
      const Vec3 a = corner(m, t, k), b = corner(m, t, (k + 1) % 3);
      const double s = geometry::closest_fraction_on_segment(c, a, b);
      if (norm2(a + s * (b - a) - c) < R * R)
        edges.push_back({std::min(v[k], v[(k + 1) % 3]), std::max(v[k], v[(k + 1) % 3]), spot.triangle});
    }
  }
  std::ranges::sort(edges, [](const SharedEdge& a, const SharedEdge& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  for (std::size_t i = 1; i < edges.size(); ++i)
    if (edges[i].low == edges[i - 1].low && edges[i].high == edges[i - 1].high)
      links.join(edges[i].triangle, edges[i - 1].triangle);
  return links;
}

}  // namespace

void PatchEvaluator::cluster(const MeshCandidates& candidates, const Vec3& c, double R,
                             const PairProperties& pair) {
  std::vector<Spot> spots;
  for (std::size_t t = 0; t < active_; ++t) {
    if (!(mean_g_[t] > 0.0)) continue;
    const Vec3 nearest = geometry::closest_point_on_triangle(
                             c, corner(candidates, t, 0), corner(candidates, t, 1), corner(candidates, t, 2))
                             .point;
    const Vec3 offset = c - nearest;
    const double distance = norm(offset);
    const double depth = tip_ != nullptr ? tip_->overlap(-offset, R) : R - distance;
    spots.push_back({static_cast<std::int32_t>(t), normalized(offset), depth});
  }
  TriangleLinks links = connect(candidates, spots, c, R);

  // Deepest first: each spot joins the first patch that it is connected to and faces like (or that it faces
  // very much like, connected or not), else begins a patch.
  std::ranges::sort(spots, [](const Spot& a, const Spot& b) {
    return a.depth != b.depth ? a.depth > b.depth : a.triangle < b.triangle;
  });
  struct Seed {
    std::int32_t root;
    Vec3 direction;
    double depth;
    Vec3 G;
    double M;
  };
  std::vector<Seed> seeds;
  clusters_.assign(candidates.padded_triangle_count(), -1);
  for (const Spot& spot : spots) {
    const std::int32_t root = links.root(spot.triangle);
    const auto joins = [&](const Seed& seed) {
      const double cosine = dot(seed.direction, spot.direction);
      return cosine >= (seed.root == root ? kCosSplit : kCosMerge);
    };
    auto seed = std::ranges::find_if(seeds, joins);
    if (seed == seeds.end()) {
      seeds.push_back({root, spot.direction, spot.depth, {}, 0.0});
      seed = seeds.end() - 1;
    }
    const std::size_t t = at(spot.triangle);
    clusters_[t] = static_cast<int>(seed - seeds.begin());
    seed->G += R * mean_g_[t] * Vec3{candidates.ax[t], candidates.ay[t], candidates.az[t]};
    seed->M += R * mean_m_[t] * height_[t];
  }
  for (const Seed& seed : seeds) patches_.push_back(make_patch(seed.G, seed.M, seed.depth, R, pair));
  if (patches_.size() == 1) clusters_.clear();
}

}  // namespace abradem::contact
