// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/wear/radial_integrals.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace abradem::wear {
namespace {

constexpr double kSphere = 3e-3, kDeepest = 20e-6;

/// By points of equal parts; the mean of the parts' centroids.
std::array<double, 3> by_points(const std::array<Vec3, 3>& r, const std::function<double(double)>& weight) {
  constexpr int n = 1200;
  const double part = 0.5 * norm(cross(r[1] - r[0], r[2] - r[0])) / (n * n);
  std::array<double, 3> sum{};
  const auto add = [&](double b1, double b2) {
    const double w = weight(norm((1.0 - b1 - b2) * r[0] + b1 * r[1] + b2 * r[2])) * part;
    sum[0] += w * (1.0 - b1 - b2), sum[1] += w * b1, sum[2] += w * b2;
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; i + j < n; ++j) {
      add((i + 1.0 / 3) / n, (j + 1.0 / 3) / n);
      if (i + j + 1 < n) add((i + 2.0 / 3) / n, (j + 2.0 / 3) / n);
    }
  return sum;
}

/// Triangles at the depth kDeepest of a sphere, against the disc's radius of 0.25 mm: around it, cut by one,
/// two and three edges, with a corner in it, wholly inside, beside it, tilted.
std::vector<std::array<Vec3, 3>> triangles() {
  const double z = kDeepest - kSphere, u = 1e-4;
  const auto flat = [&](double x0, double y0, double x1, double y1, double x2, double y2) {
    return std::array<Vec3, 3>{Vec3{x0 * u, y0 * u, z}, Vec3{x1 * u, y1 * u, z}, Vec3{x2 * u, y2 * u, z}};
  };
  return {flat(-20, -9, 18, -11, 1, 21),
          flat(-20, -1, 18, -1.2, 1, 21),
          flat(-0.7, -2, 15, -2, -0.3, 14),
          flat(-3, -1.5, 3, -1.4, 0, 3.2),
          flat(-1, -1.1, 1.2, -0.8, 0.1, 1.3),
          flat(3, 0, 9, -1, 7, 6),
          flat(0, 0, 14, 0, 0, 14),
          flat(-9, 0, 9, 0, 0, 12),
          flat(0.4, 0.3, 1.9, 0.35, 1.0, 1.6),
          {Vec3{-6e-4, -2e-4, z - 3e-5}, Vec3{5e-4, -1e-4, z + 2e-5}, Vec3{0, 9e-4, z + 1e-5}}};
}

TEST(RadialIntegrals, EqualFineQuadrature) {
  const double d_e = 20e-6, s = kSphere - kDeepest + 0.5 * d_e;
  for (const auto& r : triangles()) {
    const auto hertz = by_points(r, [&](double u) { return std::sqrt(std::max(0.0, 2.0 * (s - u))); });
    const auto overlap = by_points(r, [&](double u) { return std::max(0.0, kSphere - u); });
    const CornerIntegrals a = integrate_over_triangle(HertzBall{s}, r[0], r[1], r[2]);
    const CornerIntegrals b = integrate_over_triangle(OverlapBall{kSphere}, r[0], r[1], r[2]);
    // Of all that one sphere presses. The points err by up to 6e-6 of it, at the rim of Hertz's pressure;
    // with 4800 parts a side the two differ by 3.4e-7 and 2.6e-8.
    const double all_hertz = 2.0 / 3.0 * std::numbers::pi * kSphere * std::pow(d_e, 1.5),
                 all_overlap = std::numbers::pi * kSphere * kDeepest * kDeepest;
    const std::array<double, 3> mine{a.at0, a.at1, a.at2}, other{b.at0, b.at1, b.at2};
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(mine[k] / all_hertz, hertz[k] / all_hertz, 1e-5);
      EXPECT_NEAR(other[k] / all_overlap, overlap[k] / all_overlap, 1e-6);
    }
  }
}

TEST(RadialIntegrals, OfADiscInsideAreItsVolumeAtItsMiddle) {
  const double d_e = 20e-6, h = kSphere - kDeepest, s = h + 0.5 * d_e;
  const Vec3 r0{-7e-4, -5e-4, -h}, r1{8e-4, -5e-4, -h}, r2{1e-4, 9e-4, -h};
  const CornerIntegrals a = integrate_over_triangle(HertzBall{s}, r0, r1, r2);
  const double v = s - h, F = std::sqrt(2.0) * std::pow(v, 1.5) * (2.0 / 3.0 * s - 0.4 * v);
  EXPECT_NEAR((a.at0 + a.at1 + a.at2) / (2.0 * std::numbers::pi * F), 1.0, 1e-13);
  const Vec3 middle = (a.at0 * r0 + a.at1 * r1 + a.at2 * r2) / (a.at0 + a.at1 + a.at2);
  EXPECT_NEAR(middle.x, 0.0, 1e-16);
  EXPECT_NEAR(middle.y, 0.0, 1e-16);
}

/// What falls on a triangle falls on the parts of it, wherever the cut runs; through the middle too.
TEST(RadialIntegrals, OfTheParts) {
  const double d_e = 20e-6, h = kSphere - kDeepest, s = h + 0.5 * d_e;
  const Vec3 r0{-2e-4, -1e-4, -h}, r1{4e-4, -1e-4, -h}, r2{0.0, 6e-4, -h};
  const CornerIntegrals all = integrate_over_triangle(HertzBall{s}, r0, r1, r2);
  const double sum = all.at0 + all.at1 + all.at2;
  for (const Vec3& m : {Vec3{0.0, 0.0, -h}, Vec3{1e-4, 1e-4, -h}, Vec3{1e-12, 1e-12, -h}, 0.5 * (r0 + r1)}) {
    double parts = 0.0;
    for (const auto& [a, b] : {std::pair{r0, r1}, {r1, r2}, {r2, r0}}) {
      if (norm(cross(a - m, b - m)) == 0.0) continue;
      const CornerIntegrals p = integrate_over_triangle(HertzBall{s}, a, b, m);
      parts += p.at0 + p.at1 + p.at2;
    }
    EXPECT_NEAR(parts / sum, 1.0, 1e-7);  // eight points on an edge: 2e-8
  }
}

}  // namespace
}  // namespace abradem::wear
