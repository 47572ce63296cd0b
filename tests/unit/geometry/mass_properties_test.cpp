// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/geometry/mass_properties.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "abradem/core/random.h"
#include "abradem/geometry/sphere_fit.h"

namespace abradem::geometry {
namespace {

constexpr double pi = std::numbers::pi;

/// A box of half the given sides about a place, its faces in two triangles each.
TriangleMesh box(const Vec3& h, const Vec3& at) {
  TriangleMesh mesh;
  for (int k = 0; k < 8; ++k)
    mesh.vertices.push_back(at +
                            Vec3{(k & 1 ? 1 : -1) * h.x, (k & 2 ? 1 : -1) * h.y, (k & 4 ? 1 : -1) * h.z});
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

void expect_near(const Vec3& a, const Vec3& b, double tolerance) {
  EXPECT_LE(std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)}), tolerance)
      << a.x << " " << a.y << " " << a.z;
}

TEST(MassProperties, OfABoxAreExact) {
  const Vec3 h{1.0, 2.0, 3.0}, at{5.0, -3.0, 2.0};
  const MassProperties b = mass_properties(box(h, at));
  EXPECT_NEAR(b.volume, 48.0, 1e-12);
  expect_near(b.centre, at, 1e-12);
  expect_near(b.moments, 48.0 / 3.0 * Vec3{4.0 + 9.0, 9.0 + 1.0, 1.0 + 4.0}, 1e-10);
  expect_near(b.products, {}, 1e-10);
}

TEST(MassProperties, OfOneBallAndOfBallsApartAreThoseOfSpheres) {
  const double R = 1.3, V = 4.0 / 3.0 * pi * R * R * R;
  const MassProperties one = mass_properties(std::vector<Ball>{{{1, 2, 3}, R}});
  EXPECT_NEAR(one.volume / V, 1.0, 1e-12);
  expect_near(one.moments, 0.4 * V * R * R * Vec3{1, 1, 1}, 1e-12);
  const MassProperties two = mass_properties(std::vector<Ball>{{{1, 2, 3}, R}, {{5, 2, 3}, R}});
  EXPECT_NEAR(two.volume / V, 2.0, 1e-12);
  expect_near(two.centre, {3, 2, 3}, 1e-12);
  expect_near(two.moments, V * Vec3{0.8 * R * R, 0.8 * R * R + 8.0, 0.8 * R * R + 8.0}, 1e-11);
}

TEST(MassProperties, CountOverlapsOnce) {
  // Two equal balls: both less their lens, V = pi (4 R + d) (2 R - d)^2 / 12; along any direction the same.
  const double R = 1.5, d = 2.0,
               volume = 8.0 / 3.0 * pi * R * R * R - pi * (4 * R + d) * (2 * R - d) * (2 * R - d) / 12.0;
  double worst = 0.0;
  for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 0, 1}, Vec3{0.48, 0.6, 0.64}}) {
    const std::vector<Ball> balls{{-0.5 * d * axis, R}, {0.5 * d * axis, R}};
    const MassProperties b = mass_properties(balls);
    worst = std::max(worst, std::abs(b.volume / volume - 1.0));
    // Moments along the axis and across it by quadrature over the solid of revolution, 2e5 slices.
    double along = 0.0, across = 0.0;
    constexpr int n = 200000;
    for (int k = 0; k < n; ++k) {
      const double s = (k + 0.5) / n * (0.5 * d + R), near = s - 0.5 * d, r2 = R * R - near * near;
      const double slice = 2.0 * pi * r2 * (0.5 * d + R) / n;
      along += 0.5 * slice * r2;
      across += slice * (0.25 * r2 + s * s);
    }
    const PrincipalAxes axes = principal_axes(b);
    EXPECT_NEAR(axes.moments.x / along, 1.0, 1e-5);
    EXPECT_NEAR(axes.moments.y / across, 1.0, 1e-5);
    EXPECT_NEAR(axes.moments.z / across, 1.0, 1e-5);
    EXPECT_NEAR(std::abs(dot(axes.turn.turn({1, 0, 0}), axis)), 1.0, 1e-6);
  }
  EXPECT_LT(worst, 1e-5);
  RecordProperty("worst", std::to_string(1e9 * worst) + "e-9");
  // A ball inside another and a ball twice change nothing.
  const MassProperties same = mass_properties(std::vector<Ball>{{{}, R}, {{0.1, 0, 0}, 0.5}, {{}, R}});
  EXPECT_NEAR(same.volume / (4.0 / 3.0 * pi * R * R * R), 1.0, 1e-12);
}

/// The error of a crowd of overlapping balls falls with the panels: far below 1e-3 at the default.
TEST(MassProperties, OfManyBallsConverge) {
  core::RandomStream random(3);
  std::vector<Ball> balls;
  for (int k = 0; k < 15; ++k) {
    const auto any = [&] { return random.uniform(-1.0, 1.0); };
    const double x = any(), y = any();
    balls.push_back({{x, y, any()}, random.uniform(0.3, 0.8)});
  }
  const MassProperties fine = mass_properties(balls, 2048);
  double error[2];
  int at = 0;
  for (const int panels : {8, 64}) {
    const MassProperties b = mass_properties(balls, panels);
    error[at] =
        std::max(std::abs(b.volume / fine.volume - 1.0), norm(b.moments - fine.moments) / norm(fine.moments));
    RecordProperty("error_" + std::to_string(panels), std::to_string(1e9 * error[at]) + "e-9");
    ++at;
  }
  EXPECT_LT(error[0], 1e-3);
  EXPECT_LT(error[1], 1e-6);
  EXPECT_LT(error[1], 0.2 * error[0]);
  // By counting points of a lattice, as rough as that is.
  const double h = 0.02;
  double count = 0.0;
  for (double x = -1.8 + h / 2; x < 1.8; x += h)
    for (double y = -1.8 + h / 2; y < 1.8; y += h)
      for (double z = -1.8 + h / 2; z < 1.8; z += h)
        count += std::ranges::any_of(balls, [&](const Ball& b) {
          return norm2(Vec3{x, y, z} - b.centre) < b.radius * b.radius;
        });
  EXPECT_NEAR(fine.volume / (count * h * h * h), 1.0, 2e-3);
}

TEST(Quaternion, TurnsAsItsAxesSay) {
  core::RandomStream random(5);
  for (int k = 0; k < 200; ++k) {
    const double u = random.uniform(), v = random.uniform();
    const Quaternion q = uniform_rotation(u, v, random.uniform());
    const Vec3 x = q.turn({1, 0, 0}), y = q.turn({0, 1, 0}), z = q.turn({0, 0, 1});
    expect_near(cross(x, y), z, 1e-14);
    const Quaternion r = quaternion_of(x, y, z);
    const Vec3 a{0.3, -0.2, 0.9};
    expect_near(r.turn(a), q.turn(a), 1e-14);
    expect_near(q.turn_back(q.turn(a)), a, 1e-14);
    expect_near((q * r).turn(a), q.turn(r.turn(a)), 1e-14);
  }
}

/// Uniform over all rotations: images of the axes have mean 0 and <n n> = 1/3, and the trace of the matrix
/// its moments under the Haar measure, 0 and 1.
TEST(Quaternion, RandomOnesAreUniform) {
  core::RandomStream random(8);
  constexpr int n = 40000;
  Vec3 mean, squares;
  double trace = 0.0, trace2 = 0.0;
  for (int k = 0; k < n; ++k) {
    const double u = random.uniform(), v = random.uniform();
    const Quaternion q = uniform_rotation(u, v, random.uniform());
    const Vec3 z = q.turn({0, 0, 1});
    mean += z / n;
    squares += Vec3{z.x * z.x, z.y * z.y, z.z * z.z} / n;
    const double t = q.turn({1, 0, 0}).x + q.turn({0, 1, 0}).y + z.z;
    trace += t / n, trace2 += t * t / n;
  }
  // Standard errors: 0.58 / 200, 0.30 / 200, 1 / 200, sqrt(<t^4> - 1) / 200 = sqrt(2) / 200; four are
  // allowed.
  expect_near(mean, {}, 0.012);
  expect_near(squares, {1.0 / 3, 1.0 / 3, 1.0 / 3}, 0.006);
  EXPECT_NEAR(trace, 0.0, 0.02);
  EXPECT_NEAR(trace2, 1.0, 0.03);
}

TEST(SphereFit, OfAnEllipsoidComesNearerWithMoreSpheres) {
  // An ellipsoid 2 : 1.2 : 1, 768 triangles.
  TriangleMesh mesh = box({1, 1, 1}, {});
  for (int level = 0; level < 3; ++level) {
    TriangleMesh finer;
    for (const Triangle& t : mesh.triangles) {
      const auto v = [&](int k) {
        return mesh.vertices[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])];
      };
      const Vec3 p[6]{v(0), v(1), v(2), 0.5 * (v(0) + v(1)), 0.5 * (v(1) + v(2)), 0.5 * (v(2) + v(0))};
      const auto first = static_cast<Index>(finer.vertices.size());
      finer.vertices.insert(finer.vertices.end(), std::begin(p), std::end(p));
      for (const Triangle& c : {Triangle{0, 3, 5}, Triangle{3, 1, 4}, Triangle{5, 4, 2}, Triangle{3, 4, 5}})
        finer.triangles.push_back({first + c[0], first + c[1], first + c[2]});
    }
    mesh = finer;
  }
  for (Vec3& p : mesh.vertices) {
    const Vec3 n = normalized(p);
    p = {7.0 + 2.0 * n.x, 1.2 * n.y, n.z};
  }
  const double volume = signed_volume(mesh);
  EXPECT_NEAR(volume / (4.0 / 3.0 * pi * 2.4), 1.0, 0.02);
  double before = 1.0;
  for (const int count : {1, 5, 20}) {
    const SphereFit fit = fit_spheres(mesh, count);
    EXPECT_LE(fit.balls.size(), static_cast<std::size_t>(count));
    EXPECT_NEAR(mass_properties(fit.balls).volume / volume, 1.0, 1e-3) << count;
    EXPECT_LT(std::abs(fit.volume_error), 1e-3);
    EXPECT_LT(fit.deepest, 0.85 * before) << count;
    EXPECT_LE(fit.growth, fit.furthest);
    before = fit.deepest;
    RecordProperty("deepest_" + std::to_string(count), std::to_string(fit.deepest));
    RecordProperty("furthest_" + std::to_string(count), std::to_string(fit.furthest));
    EXPECT_EQ(fit_spheres(mesh, count), fit);
    const MassProperties solid = mass_properties(mesh), united = mass_properties(fit.balls);
    expect_near(united.centre, solid.centre, 0.1);
  }
  EXPECT_LT(before, 0.1);
}

TEST(SphereFit, OfACubeFillsItsCorners) {
  const SphereFit fit = fit_spheres(box({1, 1, 1}, {0.3, 0.2, 0.1}), 9);
  ASSERT_EQ(fit.balls.size(), 9u);
  EXPECT_NEAR(norm(fit.balls[0].centre - Vec3{0.3, 0.2, 0.1}), 0.0, 0.1);
  EXPECT_LT(std::abs(fit.volume_error), 1e-3);
  EXPECT_LT(fit.deepest, 0.45);  // of one sphere of its volume: 0.49
  RecordProperty("deepest", std::to_string(fit.deepest));
  RecordProperty("furthest", std::to_string(fit.furthest));
}

}  // namespace
}  // namespace abradem::geometry
