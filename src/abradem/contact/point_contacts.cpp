// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/contact/point_contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "abradem/contact/triangle_links.h"

namespace abradem::contact {

namespace {

using geometry::Feature;

std::size_t at(std::int32_t i) noexcept { return static_cast<std::size_t>(i); }

int rank(Feature f) noexcept { return geometry::is_vertex(f) ? 2 : geometry::is_edge(f) ? 1 : 0; }

/// Local vertices that a feature consists of: two of an edge, one of a vertex (twice); none of a face.
std::array<std::int32_t, 2> feature_vertices(const MeshCandidates& m, const PointContact& p) noexcept {
  const std::array<std::int32_t, 3> v{m.v0[at(p.triangle)], m.v1[at(p.triangle)], m.v2[at(p.triangle)]};
  switch (p.feature) {
    case Feature::edge0:
      return {v[0], v[1]};
    case Feature::edge1:
      return {v[1], v[2]};
    case Feature::edge2:
      return {v[2], v[0]};
    case Feature::vertex0:
      return {v[0], v[0]};
    case Feature::vertex1:
      return {v[1], v[1]};
    case Feature::vertex2:
      return {v[2], v[2]};
    case Feature::face:
      break;
  }
  return {-1, -1};
}

bool has_vertex(const MeshCandidates& m, std::int32_t t, std::int32_t v) noexcept {
  return m.v0[at(t)] == v || m.v1[at(t)] == v || m.v2[at(t)] == v;
}

/// Faces first, then edges, then vertices; the deepest first; the candidates' order last, so that the result
/// does not depend on anything else.
bool stronger(const PointContact& a, const PointContact& b) noexcept {
  return std::tuple(rank(a.feature), -a.overlap, a.triangle) <
         std::tuple(rank(b.feature), -b.overlap, b.triangle);
}

}  // namespace

void PointContactFinder::collect(const MeshCandidates& candidates, const Vec3& c, double R, const Tip& tip,
                                 bool sheet) {
  Findings& f = found();
  if (stamp_ != candidates.stamp() || radius_ != R) bound_.assign(candidates.triangle_count(), {});
  stamp_ = candidates.stamp();
  radius_ = R;
  last_ = c;
  odometer_ = candidates.odometer();
  f.touched.clear();
  excess_known_ = false;
  const double rounding = 1e-14 * (std::abs(c.x) + std::abs(c.y) + std::abs(c.z) + R);
  for (std::size_t t = 0; t < candidates.triangle_count(); ++t) {
    if (dot(bound_[t].away, c) - odometer_ > bound_[t].level) continue;
    const auto closest = geometry::closest_point_on_triangle(
        c, candidates.node_position(at(candidates.v0[t])), candidates.node_position(at(candidates.v1[t])),
        candidates.node_position(at(candidates.v2[t])));
    const Vec3 offset = c - closest.point;
    const double distance = norm(offset);
    if (distance >= R) {
      const Vec3 away = offset / distance;
      bound_[t] = {away, dot(away, c) - odometer_ - (distance - R) + rounding};
    }
    if (distance >= R || distance == 0.0) continue;
    // A triangle seen from behind belongs to the far side of the solid.
    if (!sheet &&
        candidates.ax[t] * offset.x + candidates.ay[t] * offset.y + candidates.az[t] * offset.z < 0.0)
      continue;
    const auto local = static_cast<std::int32_t>(t);
    const double overlap = tip.worn() ? tip.overlap(-offset, R) : R - distance;
    const Vec3 n = tip.worn() ? tip.inward_normal(-offset) : offset / distance;
    f.touched.push_back({closest.point, n, overlap, closest.feature, local, local});
  }
  f.raw.clear();
  if (tip.worn()) {
    find_excess(candidates);
    f.raw = f.excess;
    f.correction.apply(candidates, c, R, tip, f.raw, f.excess);
  }
}

void PointContactFinder::find_excess(const MeshCandidates& candidates) {
  Findings& f = found();
  f.excess.assign(candidates.x.size(), -1.0);
  const double inverse = 1.0 / (radius_ * radius_);
  for (std::size_t i = 0; i < candidates.node_count(); ++i)
    f.excess[i] = 1.0 - norm2(candidates.node_position(i) - last_) * inverse;
  excess_known_ = true;
}

std::span<const double> PointContactFinder::node_excess(const MeshCandidates& candidates) {
  if (!excess_known_) find_excess(candidates);
  return found().excess;
}

FreeWay PointContactFinder::free_way(double most) const noexcept {
  FreeWay way{.from = last_, .wear = odometer_, .any = most};
  way.gap.fill(std::numeric_limits<double>::infinity());
  const auto touched = [&](std::size_t t) {
    return std::ranges::any_of(found().touched, [&](const PointContact& p) { return at(p.triangle) == t; });
  };
  for (std::size_t t = 0; t < bound_.size(); ++t) {
    double gap = dot(bound_[t].away, last_) - odometer_ - bound_[t].level;
    if (gap >= way.any || touched(t)) continue;
    Vec3 away = bound_[t].away;
    for (std::size_t k = 0; k < FreeWay::kNearest; ++k)
      if (gap < way.gap[k]) std::swap(gap, way.gap[k]), std::swap(away, way.away[k]);
    way.any = std::min(way.any, gap);
  }
  return way;
}

std::span<const PointContact> PointContactFinder::per_triangle(const MeshCandidates& candidates,
                                                               const Vec3& c, double R, const Tip& tip) {
  Findings& f = found();
  collect(candidates, c, R, tip, false);
  std::sort(f.touched.begin(), f.touched.end(), stronger);
  f.accepted.clear();
  for (const PointContact& p : f.touched) {
    const auto [a, b] = feature_vertices(candidates, p);
    // Owned by a stronger contact that touches the same feature: a face around it, an edge that ends in it,
    // or itself once more. (Not by an edge opposite to it: which of two triangles stands for an edge is
    // arbitrary.)
    const bool owned =
        a >= 0 && std::ranges::any_of(f.accepted, [&, a = a, b = b](const PointContact& q) {
          if (q.feature == Feature::face)
            return has_vertex(candidates, q.triangle, a) && has_vertex(candidates, q.triangle, b);
          const auto [qa, qb] = feature_vertices(candidates, q);
          return (qa == a || qb == a) && (qa == b || qb == b);
        });
    if (!owned && p.overlap > 0.0) f.accepted.push_back(p);
  }
  return f.accepted;
}

std::span<const PointContact> PointContactFinder::resolved(const MeshCandidates& candidates, const Vec3& c,
                                                           double R, const Tip& tip, bool sheet) {
  Findings& f = found();
  collect(candidates, c, R, tip, sheet);
  find_flat_sets(candidates);
  // Each set's deepest point, strongest sets first.
  std::vector<PointContact>& best = f.best;
  best.clear();
  for (PointContact& p : f.touched) {
    p.set = f.set[at(p.triangle)];
    const auto same = std::ranges::find(best, p.set, &PointContact::set);
    if (same == best.end())
      best.push_back(p);
    else if (p.overlap > same->overlap || (p.overlap == same->overlap && stronger(p, *same)))
      *same = p;
  }
  std::sort(best.begin(), best.end(), stronger);
  f.accepted.clear();
  for (const PointContact& p : best) {
    if (!(p.overlap > 0.0)) continue;
    const auto [a, b] = feature_vertices(candidates, p);
    const auto set_holds_feature = [&, a = a, b = b](const PointContact& q) {
      return std::ranges::any_of(f.touched, [&](const PointContact& t) {
        return t.set == q.set && has_vertex(candidates, t.triangle, a) &&
               has_vertex(candidates, t.triangle, b);
      });
    };
    if (a < 0 || std::ranges::none_of(f.accepted, set_holds_feature)) f.accepted.push_back(p);
  }
  return f.accepted;
}

void PointContactFinder::find_flat_sets(const MeshCandidates& candidates) {
  Findings& f = found();
  constexpr double kCosFlat = 0.99619469809174555;  // 5 degrees
  f.set.assign(candidates.triangle_count(), -1);
  for (const PointContact& p : f.touched) f.set[at(p.triangle)] = p.triangle;
  if (f.touched.size() < 2) return;
  TriangleLinks links(candidates.triangle_count());
  for (std::size_t i = 0; i < f.touched.size(); ++i)
    for (std::size_t j = i + 1; j < f.touched.size(); ++j) {
      const auto s = f.touched[i].triangle, t = f.touched[j].triangle;
      const int shared = has_vertex(candidates, s, candidates.v0[at(t)]) +
                         has_vertex(candidates, s, candidates.v1[at(t)]) +
                         has_vertex(candidates, s, candidates.v2[at(t)]);
      const double cosine =
          (candidates.ax[at(s)] * candidates.ax[at(t)] + candidates.ay[at(s)] * candidates.ay[at(t)] +
           candidates.az[at(s)] * candidates.az[at(t)]) /
          (candidates.area[at(s)] * candidates.area[at(t)]);
      if (shared >= 1 && cosine >= kCosFlat) links.join(s, t);
    }
  for (const PointContact& p : f.touched) f.set[at(p.triangle)] = links.root(p.triangle);
}

}  // namespace abradem::contact
