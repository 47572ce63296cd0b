// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/contact/overlap_integrals.h"

#include <gtest/gtest.h>

#include <numbers>

#include "abradem/contact/overlap_series.h"
#include "support/surfaces.h"

namespace abradem::contact {
namespace {

constexpr double R = 3e-3;

/// Centroid rule on n^2 parts: G = int max(0, R - r) dA, and M = d int Q(r) / r^3 dA with Q = int_r^R (R - s)
/// s^2 ds (the cone of the overlap seen from the centre).
OverlapIntegrals by_quadrature(const Vec3& a, const Vec3& b, const Vec3& c, int n) {
  const Vec3 area2 = cross(b - a, c - a);
  const Vec3 normal = normalized(area2);
  const double part = 0.5 * norm(area2) / (static_cast<double>(n) * n);
  OverlapIntegrals sum;
  const auto add = [&](double u, double v) {
    const double r = norm(a + u * (b - a) + v * (c - a));
    if (r >= R) return;
    sum.G += part * (R - r);
    const double Q = R * (R * R * R - r * r * r) / 3.0 - (R * R * R * R - r * r * r * r) / 4.0;
    sum.M += part * Q / (r * r * r);
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; i + j < n; ++j) {
      add((i + 1.0 / 3) / n, (j + 1.0 / 3) / n);
      if (i + j + 1 < n) add((i + 2.0 / 3) / n, (j + 2.0 / 3) / n);
    }
  sum.M *= -dot(normal, a);
  return sum;
}

TEST(OverlapOfTriangle, EqualsQuadratureWhereverTheTriangleLies) {
  core::RandomStream random(11);
  const auto point = [&](double delta, double size) {
    return Vec3{random.uniform(-size, size), random.uniform(-size, size),
                -(R - delta) * random.uniform(0.99, 1.01)};
  };
  // n = 300: the centroid rule is off by about (size / 300)^2 times the curvature, and at the rim by less.
  constexpr int n = 300;
  for (const double delta : {0.001 * R, 0.01 * R, 0.1 * R}) {
    const OverlapIntegrals whole = overlap_of_plane(delta, R);
    int met = 0;
    for (int trial = 0; trial < 60; ++trial) {
      const double size = std::sqrt(2.0 * R * delta) * random.uniform(0.05, 3.0);
      const Vec3 a = point(delta, size), b = point(delta, size), c = point(delta, size);
      const OverlapIntegrals exact = overlap_of_triangle(a, b, c, R), sum = by_quadrature(a, b, c, n);
      EXPECT_NEAR(exact.G, sum.G, 2e-4 * (sum.G + whole.G));
      EXPECT_NEAR(exact.M, sum.M, 2e-4 * (std::abs(sum.M) + whole.M));
      met += sum.G > 0.0;
    }
    EXPECT_GT(met, 20);  // the trials must reach the ball
  }
}

TEST(OverlapOfTriangle, IsNothingBesideTheBallAndWithoutArea) {
  const double z = -0.99 * R;
  EXPECT_EQ(overlap_of_triangle({0, 0, z}, {1, 0, z}, {2, 0, z}, R).G, 0.0);
  EXPECT_EQ(overlap_of_triangle({-1, -1, -1.01 * R}, {1, -1, -1.01 * R}, {0, 1, -1.01 * R}, R).G, 0.0);
  // In the plane of the overlap but away from the disc: exactly nothing, no round-off of angles.
  core::RandomStream random(2);
  for (int trial = 0; trial < 200; ++trial) {
    const double turn = random.uniform(0.0, 6.28), size = random.uniform(0.1, 30.0) * R;
    const auto at = [&](double u, double v) {
      return Vec3{u * std::cos(turn) - v * std::sin(turn), u * std::sin(turn) + v * std::cos(turn), z};
    };
    EXPECT_EQ(overlap_of_triangle(at(0.5 * R, -size), at(size + R, 0.3 * size), at(0.6 * R, size), R).G, 0.0);
  }
}

TEST(OverlapOfTriangle, ChangesSignOfMWithTheSide) {
  const double z = 0.99 * R;
  const Vec3 a{-0.2e-3, -0.1e-3, -z}, b{0.3e-3, -0.2e-3, -z}, c{0.1e-3, 0.3e-3, -z};
  const OverlapIntegrals front = overlap_of_triangle(a, b, c, R), back = overlap_of_triangle(a, c, b, R);
  EXPECT_DOUBLE_EQ(front.G, back.G);
  EXPECT_DOUBLE_EQ(front.M, -back.M);
  EXPECT_GT(front.M, 0.0);
}

TEST(OverlapOfTriangle, SumsToThePlaneWhateverTheTriangles) {
  for (const double delta : {1e-4 * R, 1e-3 * R, 1e-2 * R, 3e-2 * R})
    for (const double h : {0.05, 0.3, 2.0}) {
      const double rim = std::sqrt(2.0 * R * delta);
      const auto mesh = test::jittered_plate(5.0 * rim, 5.0 * rim, h * rim, 0.2, 3);
      OverlapIntegrals sum;
      for (const auto& t : mesh.triangles) {
        const Vec3 centre{0.11 * rim, -0.07 * rim, R - delta};
        const OverlapIntegrals one =
            overlap_of_triangle(mesh.vertices[static_cast<std::size_t>(t[0])] - centre,
                                mesh.vertices[static_cast<std::size_t>(t[1])] - centre,
                                mesh.vertices[static_cast<std::size_t>(t[2])] - centre, R);
        sum.G += one.G;
        sum.M += one.M;
      }
      const OverlapIntegrals plane = overlap_of_plane(delta, R);
      // The heights R - delta are rounded to 1e-16 R, which delta^2 turns into 2e-16 R / delta.
      const double tolerance = 1e-11 + 1e-15 * R / delta;
      EXPECT_NEAR(sum.G / plane.G, 1.0, tolerance) << delta / R << " " << h;
      // M is smaller than G by another factor delta: its series is cut earlier, 2e-9 at 3 % of R.
      EXPECT_NEAR(sum.M / plane.M, 1.0, 2 * tolerance + (delta > 0.02 * R ? 3e-9 : 0.0))
          << delta / R << " " << h;
    }
}

TEST(OverlapOfTriangle, KeepsTheSeriesErrorSmallAtTenPercent) {
  const double delta = 0.1 * R, z = -(R - delta);
  const OverlapIntegrals sum =
      overlap_of_triangle({-20 * R, -20 * R, z}, {20 * R, -20 * R, z}, {0, 20 * R, z}, R);
  const OverlapIntegrals plane = overlap_of_plane(delta, R);
  EXPECT_NEAR(sum.G / plane.G, 1.0, 1e-7);
  EXPECT_NEAR(sum.M / plane.M, 1.0, 1e-5);
}

TEST(OverlapOfPlane, IsTheIntegralOverTheCap) {
  // M = int_0^delta of (area of the disc) ... by parts: dM/d(delta) = G.
  const double delta = 0.02 * R, step = 1e-5 * R;
  const double slope =
      (overlap_of_plane(delta + step, R).M - overlap_of_plane(delta - step, R).M) / (2.0 * step);
  EXPECT_NEAR(slope / overlap_of_plane(delta, R).G, 1.0, 1e-6);
}

TEST(EquivalentOverlap, InvertsThePlane) {
  for (const double x : {1e-6, 1e-4, 1e-2, 0.1})
    EXPECT_NEAR(equivalent_overlap(overlap_of_plane(x * R, R).M, R) / (x * R), 1.0, 1e-14) << x;
  EXPECT_EQ(equivalent_overlap(0.0, R), 0.0);
  EXPECT_EQ(equivalent_overlap(-1e-15, R), 0.0);
}

TEST(OverlapSeries, HoldsTheCoefficientsOfItsFunctions) {
  const double eps = 0.05;
  double g = 0.0, q = 0.0, power = 1.0;
  for (std::size_t k = 0; k <= series::kTerms; ++k, power *= eps)
    g += series::kOverlap[k] * power, q += series::kWeighted[k] * power;
  EXPECT_NEAR(g, 1.0 - std::sqrt(1.0 - eps), 1e-13);
  const double root = std::sqrt(1.0 - eps);
  EXPECT_NEAR(q, 1.0 / (12.0 * root * root * root) - 1.0 / 3.0 + 0.25 * root, 1e-11);
}

}  // namespace
}  // namespace abradem::contact
