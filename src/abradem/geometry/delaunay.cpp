// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/geometry/delaunay.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace abradem::geometry {

namespace {

std::size_t at(Index i) noexcept { return static_cast<std::size_t>(i); }

/// Twice the signed area of a, b, c; positive when counter-clockwise.
double doubled_area(Point2 a, Point2 b, Point2 c) noexcept {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Is d inside the circle through a, b, c (counter-clockwise), beyond round-off? The error of the determinant
/// is below 1e-15 times the permanent [Shewchuk 1997, Sec. 4.3: (10 + 96 eps) eps]; cocircular points give
/// no.
bool inside_circle(Point2 a, Point2 b, Point2 c, Point2 d) noexcept {
  const double ax = a.x - d.x, ay = a.y - d.y;
  const double bx = b.x - d.x, by = b.y - d.y;
  const double cx = c.x - d.x, cy = c.y - d.y;
  const double a2 = ax * ax + ay * ay, b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
  const double determinant = a2 * (bx * cy - cx * by) + b2 * (cx * ay - ax * cy) + c2 * (ax * by - bx * ay);
  const double permanent = a2 * (std::abs(bx * cy) + std::abs(cx * by)) +
                           b2 * (std::abs(cx * ay) + std::abs(ax * cy)) +
                           c2 * (std::abs(ax * by) + std::abs(bx * ay));
  return determinant > 2e-15 * permanent;
}

}  // namespace

Delaunay::Delaunay(std::vector<Point2> points, std::span<const Index> polygon, Index centre)
    : points_(std::move(points)) {
  const auto n = static_cast<Index>(polygon.size());
  triangles_.reserve(2 * points_.size());
  neighbours_.reserve(2 * points_.size());
  for (Index i = 0; i < n; ++i) {
    const Index next = (i + 1) % n, previous = (i + n - 1) % n;
    triangles_.push_back({polygon[at(i)], polygon[at(next)], centre});
    neighbours_.push_back({-1, next, previous});
    pending_.push_back(i);
  }
  legalize();
}

void Delaunay::relink(Index t, Index from, Index to) noexcept {
  if (t < 0) return;
  *std::ranges::find(neighbours_[at(t)], from) = to;
}

Index Delaunay::locate(Point2 p) const {
  Index t = last_, came_from = -1;
  // In a Delaunay triangulation this walk ends [Devillers, Pion & Teillaud 2002]; the bound only guards
  // against round-off turning it in a circle around a point on an edge.
  for (std::size_t steps = 0; steps < 4 * triangles_.size() + 16; ++steps) {
    const Triangle& v = triangles_[at(t)];
    const Triangle& n = neighbours_[at(t)];
    Index next = -1;
    for (std::size_t k = 0; k < 3 && next < 0; ++k) {
      if (n[k] < 0 || n[k] == came_from) continue;
      if (doubled_area(points_[at(v[k])], points_[at(v[(k + 1) % 3])], p) < 0.0) next = n[k];
    }
    if (next < 0) return t;
    came_from = std::exchange(t, next);
  }
  return t;
}

void Delaunay::insert(Index point) {
  const Index t = locate(points_[at(point)]);
  const Triangle v = triangles_[at(t)], n = neighbours_[at(t)];
  const auto t1 = static_cast<Index>(triangles_.size()), t2 = t1 + 1;
  triangles_[at(t)] = {v[0], v[1], point};
  neighbours_[at(t)] = {n[0], t1, t2};
  triangles_.push_back({v[1], v[2], point});
  neighbours_.push_back({n[1], t2, t});
  triangles_.push_back({v[2], v[0], point});
  neighbours_.push_back({n[2], t, t1});
  relink(n[1], t, t1);
  relink(n[2], t, t2);
  pending_.assign({t, t1, t2});
  legalize();
  last_ = t;
}

bool Delaunay::flip_if_needed(Index t, std::size_t k) {
  const Index o = neighbours_[at(t)][k];
  if (o < 0) return false;
  Triangle &vt = triangles_[at(t)], &vo = triangles_[at(o)];
  Triangle &nt = neighbours_[at(t)], &no = neighbours_[at(o)];
  const Index a = vt[k], b = vt[(k + 1) % 3], p = vt[(k + 2) % 3];
  const std::size_t j = vo[0] == b ? 0 : (vo[1] == b ? 1 : 2);  // o sees the same edge from b to a
  const Index d = vo[(j + 2) % 3];
  const Point2 pa = points_[at(a)], pb = points_[at(b)], pp = points_[at(p)], pd = points_[at(d)];
  if (!inside_circle(pb, pa, pd, pp)) return false;
  if (!(doubled_area(pa, pd, pp) > 0.0 && doubled_area(pd, pb, pp) > 0.0)) return false;
  const Index beyond_bp = nt[(k + 1) % 3], beyond_pa = nt[(k + 2) % 3];
  const Index beyond_ad = no[(j + 1) % 3], beyond_db = no[(j + 2) % 3];
  vt = {a, d, p};
  nt = {beyond_ad, o, beyond_pa};
  vo = {d, b, p};
  no = {beyond_db, beyond_bp, t};
  relink(beyond_ad, o, t);
  relink(beyond_bp, t, o);
  pending_.push_back(t);
  pending_.push_back(o);
  return true;
}

void Delaunay::legalize() {
  while (!pending_.empty()) {
    const Index t = pending_.back();
    pending_.pop_back();
    for (std::size_t k = 0; k < 3; ++k)
      if (flip_if_needed(t, k)) break;  // t is pending again, with its new edges
  }
}

void Delaunay::restore_delaunay() {
  const auto count = static_cast<Index>(triangles_.size());
  for (Index t = 0; t < count; ++t)
    for (std::size_t k = 0; k < 3; ++k)
      if (neighbours_[at(t)][k] > t && flip_if_needed(t, k)) {
        legalize();
        break;
      }
}

void Delaunay::erase_star(Index point) {
  std::vector<Index> new_number(triangles_.size(), -1);
  Index kept = 0;
  for (std::size_t t = 0; t < triangles_.size(); ++t)
    if (std::ranges::find(triangles_[t], point) == triangles_[t].end()) new_number[t] = kept++;
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    if (new_number[t] < 0) continue;
    const std::size_t to = at(new_number[t]);
    triangles_[to] = triangles_[t];
    for (std::size_t k = 0; k < 3; ++k) {
      const Index n = neighbours_[t][k];
      neighbours_[to][k] = n < 0 ? -1 : new_number[at(n)];
    }
  }
  triangles_.resize(at(kept));
  neighbours_.resize(at(kept));
  last_ = 0;
}

void Delaunay::sort_triangles() {
  // A counting sort by smallest vertex; within one vertex the former order decides.
  const auto smallest = [&](std::size_t t) { return at(std::ranges::min(triangles_[t])); };
  std::vector<Index> start(points_.size() + 1, 0);
  for (std::size_t t = 0; t < triangles_.size(); ++t) ++start[smallest(t) + 1];
  for (std::size_t v = 0; v < points_.size(); ++v) start[v + 1] += start[v];
  std::vector<Index> place(triangles_.size());
  for (std::size_t t = 0; t < triangles_.size(); ++t) place[t] = start[smallest(t)]++;
  std::vector<Triangle> sorted(triangles_.size()), linked(triangles_.size());
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const Triangle& v = triangles_[t];
    const auto first = static_cast<std::size_t>(std::ranges::min_element(v) - v.begin());
    for (std::size_t k = 0; k < 3; ++k) {
      const Index n = neighbours_[t][(first + k) % 3];
      sorted[at(place[t])][k] = v[(first + k) % 3];
      linked[at(place[t])][k] = n < 0 ? -1 : place[at(n)];
    }
  }
  triangles_ = std::move(sorted);
  neighbours_ = std::move(linked);
  last_ = 0;
}

void Delaunay::smooth(double amount, std::span<const char> is_free) {
  struct Sum {
    double x = 0.0, y = 0.0, area = 0.0;
  };
  std::vector<Sum> sums(points_.size());
  for (const Triangle& v : triangles_) {
    const Point2 p[3] = {points_[at(v[0])], points_[at(v[1])], points_[at(v[2])]};
    const double area = doubled_area(p[0], p[1], p[2]);
    for (std::size_t k = 0; k < 3; ++k) {
      const Point2 a = p[(k + 1) % 3], b = p[(k + 2) % 3];
      Sum& sum = sums[at(v[k])];
      sum.x += area * (1.0 / 3.0) * (a.x + b.x + p[k].x);
      sum.y += area * (1.0 / 3.0) * (a.y + b.y + p[k].y);
      sum.area += area;
    }
  }
  std::vector<Point2> moved = points_;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (!is_free[i] || !(sums[i].area > 0.0)) continue;
    moved[i].x += amount * (sums[i].x / sums[i].area - moved[i].x);
    moved[i].y += amount * (sums[i].y / sums[i].area - moved[i].y);
  }
  // Taking back the three points of a spoilt triangle may spoil a neighbour; when nothing moves, nothing is.
  for (bool spoilt = true; spoilt;) {
    spoilt = false;
    for (const Triangle& v : triangles_) {
      const double area = doubled_area(moved[at(v[0])], moved[at(v[1])], moved[at(v[2])]);
      const double star = std::min({sums[at(v[0])].area, sums[at(v[1])].area, sums[at(v[2])].area});
      if (area > 0.01 * star / 6.0) continue;
      for (const Index i : v) {
        Point2& p = moved[at(i)];
        const Point2 old = points_[at(i)];
        if (p.x == old.x && p.y == old.y) continue;
        p = old;
        spoilt = true;
      }
    }
  }
  points_ = std::move(moved);
  restore_delaunay();
}

double Delaunay::smallest_doubled_area() const noexcept {
  double smallest = 0.0;
  bool first = true;
  for (const Triangle& v : triangles_) {
    const double area = doubled_area(points_[at(v[0])], points_[at(v[1])], points_[at(v[2])]);
    if (first || area < smallest) smallest = area;
    first = false;
  }
  return smallest;
}

}  // namespace abradem::geometry
