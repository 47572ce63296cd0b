// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/geometry/closest_point.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>

#include "abradem/core/random.h"

namespace abradem::geometry {
namespace {

const Vec3 kA{0, 0, 0}, kB{1, 0, 0}, kC{0, 1, 0};

/// Slow and independent: the foot of the perpendicular when it is inside (three edge tests), else the nearest
/// of the three edges.
double reference_distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = normalized(cross(b - a, c - a));
  const Vec3 foot = p - dot(p - a, n) * n;
  const bool inside = dot(cross(b - a, foot - a), n) >= 0.0 && dot(cross(c - b, foot - b), n) >= 0.0 &&
                      dot(cross(a - c, foot - c), n) >= 0.0;
  double best = inside ? norm(p - foot) : std::numeric_limits<double>::infinity();
  const std::array<Vec3, 3> corner{a, b, c};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 from = corner[k], edge = corner[(k + 1) % 3] - from;
    const double t = std::clamp(dot(p - from, edge) / norm2(edge), 0.0, 1.0);
    best = std::min(best, norm(p - (from + t * edge)));
  }
  return best;
}

Vec3 random_point(core::RandomStream& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

TEST(ClosestPoint, FindsEachFeature) {
  const auto feature = [](Vec3 p) { return closest_point_on_triangle(p, kA, kB, kC).feature; };
  EXPECT_EQ(feature({0.2, 0.3, 1.0}), Feature::face);
  EXPECT_EQ(feature({0.5, -1.0, 0.5}), Feature::edge0);
  EXPECT_EQ(feature({1.0, 1.0, -0.5}), Feature::edge1);
  EXPECT_EQ(feature({-1.0, 0.5, 0.0}), Feature::edge2);
  EXPECT_EQ(feature({-1.0, -1.0, 0.0}), Feature::vertex0);
  EXPECT_EQ(feature({2.0, -0.1, 0.0}), Feature::vertex1);
  EXPECT_EQ(feature({-0.1, 2.0, 0.0}), Feature::vertex2);
  EXPECT_TRUE(is_edge(Feature::edge2) && !is_edge(Feature::vertex0) && !is_edge(Feature::face));
  EXPECT_TRUE(is_vertex(Feature::vertex0) && !is_vertex(Feature::edge2));
}

TEST(ClosestPoint, OnABorderTheSmallerFeatureWins) {
  const auto feature = [](Vec3 p) { return closest_point_on_triangle(p, kA, kB, kC).feature; };
  EXPECT_EQ(feature({0.0, 0.0, 1.0}), Feature::vertex0);
  EXPECT_EQ(feature({1.0, 0.0, 1.0}), Feature::vertex1);
  EXPECT_EQ(feature({0.0, 1.0, 1.0}), Feature::vertex2);
  EXPECT_EQ(feature({0.5, 0.0, 1.0}), Feature::edge0);
  EXPECT_EQ(feature({0.5, 0.5, 1.0}), Feature::edge1);
  EXPECT_EQ(feature({0.0, 0.5, 1.0}), Feature::edge2);
}

TEST(ClosestPoint, AgreesWithBruteForce) {
  core::RandomStream random(5);
  for (int i = 0; i < 100000; ++i) {
    const Vec3 a = random_point(random, 1.0), b = random_point(random, 1.0), c = random_point(random, 1.0);
    const Vec3 p = random_point(random, 2.0);
    const ClosestPoint found = closest_point_on_triangle(p, a, b, c);
    ASSERT_NEAR(norm(p - found.point) / reference_distance(p, a, b, c), 1.0, 1e-9) << "case " << i;
  }
}

TEST(ClosestPoint, LiesOnTheFeatureItNames) {
  core::RandomStream random(6);
  for (int i = 0; i < 20000; ++i) {
    const std::array<Vec3, 3> v{random_point(random, 1.0), random_point(random, 1.0),
                                random_point(random, 1.0)};
    const ClosestPoint found = closest_point_on_triangle(random_point(random, 2.0), v[0], v[1], v[2]);
    if (is_vertex(found.feature)) {
      ASSERT_EQ(found.point, v[static_cast<std::size_t>(found.feature) - 4]);
    } else if (is_edge(found.feature)) {
      const std::size_t k = static_cast<std::size_t>(found.feature) - 1;
      const Vec3 a = v[k], b = v[(k + 1) % 3];
      ASSERT_NEAR(norm(found.point - a) + norm(b - found.point), norm(b - a), 1e-12);
    } else {
      const Vec3 n = normalized(cross(v[1] - v[0], v[2] - v[0]));
      ASSERT_NEAR(dot(found.point - v[0], n), 0.0, 1e-10);
    }
  }
}

TEST(ClosestPoint, TreatsATriangleWithoutAreaAsASegment) {
  const ClosestPoint on_segment = closest_point_on_triangle({0.25, 1.0, 0.0}, kA, {0.5, 0, 0}, kB);
  EXPECT_NEAR(norm(on_segment.point - Vec3{0.25, 0, 0}), 0.0, 1e-15);
  const ClosestPoint on_point = closest_point_on_triangle({1.0, 1.0, 0.0}, kA, kA, kA);
  EXPECT_EQ(on_point.point, kA);
  EXPECT_TRUE(is_vertex(on_point.feature));
}

}  // namespace
}  // namespace abradem::geometry
