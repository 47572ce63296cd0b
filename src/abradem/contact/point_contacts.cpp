// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/contact/point_contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

namespace abradem::contact {

namespace {

using geometry::Feature;

std::size_t at(std::int32_t i) noexcept { return static_cast<std::size_t>(i); }

int rank(Feature f) noexcept { return geometry::is_vertex(f) ? 2 : geometry::is_edge(f) ? 1 : 0; }

/// Vertices that a feature consists of: two of an edge, one of a vertex (twice); none of a face.
std::array<Index, 2> feature_vertices(const CandidateTriangle& triangle, Feature feature) noexcept {
  const std::array<Index, 3>& v = triangle.vertex;
  switch (feature) {
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

/// Faces first, then edges, then vertices; the deepest first; the candidates' order last, so that the result
/// does not depend on anything else.
bool stronger(const PointContact& a, const PointContact& b) noexcept {
  return std::tuple(rank(a.feature), -a.overlap, a.triangle) <
         std::tuple(rank(b.feature), -b.overlap, b.triangle);
}

}  // namespace

void PointContactFinder::begin(const Vec3& c, double R, double odometer) noexcept {
  Findings& f = found();
  radius_ = R;
  last_ = c;
  odometer_ = odometer;
  f.touched.clear();
  f.triangles.clear();
  f.raw.clear();
  excess_known_ = false;
}

/// Notes the triangle where the ball cuts it, or else how far it is out of reach.
void PointContactFinder::meet(const CandidateTriangle& triangle, const Vec3& c, double R, const Tip& tip,
                              bool sheet, OutOfReach& out) {
  const auto closest =
      geometry::closest_point_on_triangle(c, triangle.corner[0], triangle.corner[1], triangle.corner[2]);
  const Vec3 offset = c - closest.point;
  const double distance = norm(offset);
  if (distance >= R) {
    const Vec3 away = offset / distance;
    const double rounding = 1e-14 * (std::abs(c.x) + std::abs(c.y) + std::abs(c.z) + R);
    out = {away, dot(away, c) - odometer_ - (distance - R) + rounding};
    return;
  }
  // A triangle seen from behind belongs to the far side of the solid.
  if (distance == 0.0 || (!sheet && dot(triangle.normal, offset) < 0.0)) return;
  const double overlap = tip.worn() ? tip.overlap(-offset, R) : R - distance;
  const Vec3 n = tip.worn() ? tip.inward_normal(-offset) : offset / distance;
  Findings& f = found();
  f.touched.push_back(
      {closest.point, n, overlap, closest.feature, triangle.local, triangle.local, f.touched.size()});
  f.triangles.push_back(triangle);
}

void PointContactFinder::collect(const MeshCandidates& candidates, const Vec3& c, double R, const Tip& tip,
                                 bool sheet) {
  if (stamp_ != candidates.stamp() || radius_ != R) out_.assign(candidates.triangle_count(), {});
  stamp_ = candidates.stamp();
  begin(c, R, candidates.odometer());
  for (std::size_t t = 0; t < candidates.triangle_count(); ++t)
    if (!out_[t].holds(c, odometer_)) meet(candidates.triangle_at(t), c, R, tip, sheet, out_[t]);
  if (!tip.worn()) return;
  Findings& f = found();
  find_excess(candidates);
  f.raw = f.excess;
  f.correction.apply(candidates, c, R, tip, f.raw, f.excess);
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

bool PointContactFinder::touched(std::size_t t) const noexcept {
  return std::ranges::any_of(found().touched, [&](const PointContact& p) { return at(p.triangle) == t; });
}

FreeWay PointContactFinder::free_way(double most) const noexcept { return way_past(most, {}); }

/// Past all triangles but those touched, and these.
FreeWay PointContactFinder::way_past(double most, std::span<const std::int32_t> these) const noexcept {
  FreeWay way{.from = last_, .wear = odometer_, .any = most};
  way.gap.fill(std::numeric_limits<double>::infinity());
  for (std::size_t t = 0; t < out_.size(); ++t) {
    double gap = dot(out_[t].away, last_) - odometer_ - out_[t].level;
    if (gap >= way.any || touched(t) || std::ranges::find(these, static_cast<std::int32_t>(t)) != these.end())
      continue;
    Vec3 away = out_[t].away;
    for (std::size_t k = 0; k < FreeWay::kNearest; ++k)
      if (gap < way.gap[k]) std::swap(gap, way.gap[k]), std::swap(away, way.away[k]);
    way.any = std::min(way.any, gap);
  }
  return way;
}

bool PointContactFinder::note(const MeshCandidates& candidates, double most, FewTriangles& few) const {
  const std::vector<PointContact>& cut = found().touched;
  if (cut.size() > FewTriangles::kMost) return false;
  struct Near {
    std::int32_t triangle = 0;
    double gap = -std::numeric_limits<double>::infinity();
  };
  std::array<Near, FewTriangles::kMost> near;
  std::size_t count = 0;
  for (const PointContact& p : cut) near[count++].triangle = p.triangle;
  for (std::size_t t = 0; t < out_.size(); ++t) {
    const double gap = dot(out_[t].away, last_) - odometer_ - out_[t].level;
    if (gap >= most || touched(t)) continue;
    std::size_t k = count < near.size() ? count++ : near.size();
    for (; k > 0 && gap < near[k - 1].gap; --k)
      if (k < near.size()) near[k] = near[k - 1];
    if (k < near.size()) near[k] = {static_cast<std::int32_t>(t), gap};
  }
  std::array<std::int32_t, FewTriangles::kMost> these{};
  few.count = count;
  for (std::size_t k = 0; k < count; ++k) {
    these[k] = near[k].triangle;
    few.triangle[k] = candidates.triangle_at(at(these[k]));
    few.out[k] = out_[at(these[k])];
    few.order[k] = static_cast<std::uint8_t>(k);
  }
  few.way = way_past(most, std::span(these).first(count));
  std::sort(few.order.begin(), few.order.begin() + static_cast<std::ptrdiff_t>(count),
            [&](std::uint8_t a, std::uint8_t b) { return these[a] < these[b]; });
  return true;
}

std::span<const PointContact> PointContactFinder::per_triangle(const MeshCandidates& candidates,
                                                               const Vec3& c, double R, const Tip& tip) {
  Findings& f = found();
  collect(candidates, c, R, tip, false);
  std::sort(f.touched.begin(), f.touched.end(), stronger);
  f.accepted.clear();
  for (const PointContact& p : f.touched) {
    const auto [a, b] = feature_vertices(f.triangles[p.place], p.feature);
    // Owned by a stronger contact that touches the same feature: a face around it, an edge that ends in it,
    // or itself once more. (Not by an edge opposite to it: which of two triangles stands for an edge is
    // arbitrary.)
    const bool owned = a >= 0 && std::ranges::any_of(f.accepted, [&, a = a, b = b](const PointContact& q) {
                         const CandidateTriangle& triangle = f.triangles[q.place];
                         if (q.feature == Feature::face) return triangle.has(a) && triangle.has(b);
                         const auto [qa, qb] = feature_vertices(triangle, q.feature);
                         return (qa == a || qb == a) && (qa == b || qb == b);
                       });
    if (!owned && p.overlap > 0.0) f.accepted.push_back(p);
  }
  return f.accepted;
}

std::span<const PointContact> PointContactFinder::resolved(const MeshCandidates& candidates, const Vec3& c,
                                                           double R, const Tip& tip, bool sheet) {
  collect(candidates, c, R, tip, sheet);
  return deepest_of_sets();
}

std::span<const PointContact> PointContactFinder::resolved(FewTriangles& few, const Vec3& c, double R,
                                                           double odometer, bool sheet) {
  begin(c, R, odometer);
  for (const std::size_t k : std::span(few.order).first(few.count))
    if (!few.out[k].holds(c, odometer)) meet(few.triangle[k], c, R, {}, sheet, few.out[k]);
  return deepest_of_sets();
}

/// Each set's deepest point, strongest sets first.
std::span<const PointContact> PointContactFinder::deepest_of_sets() {
  Findings& f = found();
  find_flat_sets();
  std::vector<PointContact>& best = f.best;
  best.clear();
  for (const PointContact& p : f.touched) {
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
    const auto [a, b] = feature_vertices(f.triangles[p.place], p.feature);
    const auto set_holds_feature = [&, a = a, b = b](const PointContact& q) {
      return std::ranges::any_of(f.touched, [&](const PointContact& t) {
        return t.set == q.set && f.triangles[t.place].has(a) && f.triangles[t.place].has(b);
      });
    };
    if (a < 0 || std::ranges::none_of(f.accepted, set_holds_feature)) f.accepted.push_back(p);
  }
  return f.accepted;
}

/// A set is named by the first of its triangles.
void PointContactFinder::find_flat_sets() {
  Findings& f = found();
  constexpr double kCosFlat = 0.99619469809174555;  // 5 degrees
  if (f.touched.size() < 2) return;
  f.links.reset(f.touched.size());
  for (std::size_t i = 0; i < f.triangles.size(); ++i)
    for (std::size_t j = i + 1; j < f.triangles.size(); ++j) {
      const CandidateTriangle &s = f.triangles[i], &t = f.triangles[j];
      const bool meet = std::ranges::any_of(t.vertex, [&](Index v) { return s.has(v); });
      if (meet && dot(s.normal, t.normal) / (s.area * t.area) >= kCosFlat)
        f.links.join(static_cast<std::int32_t>(i), static_cast<std::int32_t>(j));
    }
  for (PointContact& p : f.touched)
    p.set = f.touched[at(f.links.root(static_cast<std::int32_t>(p.place)))].triangle;
}

std::span<const int> PointContactFinder::sets(const MeshCandidates& candidates) {
  Findings& f = found();
  f.set.assign(candidates.triangle_count(), -1);
  for (const PointContact& p : f.touched) f.set[at(p.triangle)] = p.set;
  return f.set;
}

std::span<const CandidateTriangle> PointContactFinder::triangles_of(int set) {
  Findings& f = found();
  if (std::ranges::all_of(f.touched, [&](const PointContact& p) { return p.set == set; })) return f.triangles;
  f.of_set.clear();
  for (const PointContact& p : f.touched)
    if (p.set == set) f.of_set.push_back(f.triangles[p.place]);
  return f.of_set;
}

}  // namespace abradem::contact
