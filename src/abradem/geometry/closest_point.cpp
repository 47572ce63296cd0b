// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/geometry/closest_point.h"

#include <algorithm>
#include <cmath>

namespace abradem::geometry {

namespace {

/// For triangles without area, where the regions below have no meaning: the nearest of the three edges.
ClosestPoint closest_on_border(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
  const Vec3* corner[3] = {&a, &b, &c};
  ClosestPoint best;
  double best_distance2 = -1.0;
  for (int k = 0; k < 3; ++k) {
    const Vec3 &from = *corner[k], &to = *corner[(k + 1) % 3];
    const double t = closest_fraction_on_segment(p, from, to);
    const Vec3 q = from + t * (to - from);
    if (best_distance2 >= 0.0 && norm2(p - q) >= best_distance2) continue;
    best_distance2 = norm2(p - q);
    const int feature = t <= 0.0 ? 4 + k : (t >= 1.0 ? 4 + (k + 1) % 3 : 1 + k);
    best = {q, static_cast<Feature>(feature)};
  }
  return best;
}

}  // namespace

double closest_fraction_on_segment(const Vec3& p, const Vec3& a, const Vec3& b) noexcept {
  const Vec3 ab = b - a;
  const double length2 = norm2(ab);
  return length2 > 0.0 ? std::clamp(dot(p - a, ab) / length2, 0.0, 1.0) : 0.0;
}

ClosestPoint closest_point_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0.0 && d2 <= 0.0) return {a, Feature::vertex0};

  const Vec3 bp = p - b;
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0.0 && d4 <= d3) return {b, Feature::vertex1};

  const Vec3 cp = p - c;
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0.0 && d5 <= d6) return {c, Feature::vertex2};

  // Ericson's barycentric numerators, up to the common factor |ab x ac|^2.
  const double vc = d1 * d4 - d3 * d2;
  const double vb = d5 * d2 - d1 * d6;
  const double va = d3 * d6 - d5 * d4;
  const double sum = va + vb + vc;
  if (!(sum > 1e-24 * norm2(ab) * norm2(ac))) return closest_on_border(p, a, b, c);
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return {a + d1 / (d1 - d3) * ab, Feature::edge0};
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0)
    return {b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b), Feature::edge1};
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return {a + d2 / (d2 - d6) * ac, Feature::edge2};
  return {a + vb / sum * ab + vc / sum * ac, Feature::face};
}

std::optional<double> ray_meets(const Vec3& from, const Vec3& direction, const Vec3 (&v)[3]) noexcept {
  const Vec3 normal = cross(v[1] - v[0], v[2] - v[0]);
  const double slope = dot(normal, direction), size = dot(normal, normal);
  if (std::abs(slope) < 1e-12 * std::sqrt(size)) return {};
  const double t = dot(normal, v[0] - from) / slope;
  const Vec3 hit = from + t * direction;
  for (int k = 0; k < 3; ++k) {
    const Vec3 &a = v[k], &b = v[(k + 1) % 3];
    if (dot(cross(b - a, hit - a), normal) < -1e-9 * size) return {};
  }
  return t;
}

}  // namespace abradem::geometry
