// SPDX-License-Identifier: BSD-3-Clause
// A triangulated wall is the solid it stands for, not its triangles. docs/verification/walls.md
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "abradem/contact/overlap_integrals.h"
#include "abradem/contact/patch.h"
#include "abradem/wear/wearing_surface.h"
#include "support/cases.h"
#include "support/surfaces.h"

namespace abradem::test {
namespace {

using simulation::ContactRule;

constexpr double R = PinOnDisc::kRadius;

/// Patch contact of a ball at c with a scene; no contact: all zero.
contact::Patch press(Scene& scene, const Vec3& c, double radius, const contact::PairProperties& pair) {
  contact::PatchEvaluator evaluator;
  const auto patches = evaluator.evaluate(scene.candidates_at(c, radius), c, radius, pair);
  return patches.empty() ? contact::Patch{} : patches.front();
}

const contact::PairProperties kPair{
    .E_eff = 2.6285e8, .G_eff = 5.675e7, .beta = 0.0, .static_friction = 0.0, .rolling_friction = 0.0};

class FlatWall : public testing::TestWithParam<ContactRule> {};

// W1: the set-up of MercuryDPM's RollingOverTriangleWalls. Six triangles of the plane z = 0 with a T-junction
// at (1, 0); a ball of R = 0.5 m, m = 1 kg at g = 1 m/s^2 crosses edges, the junction and vertices. The
// moduli give the overlap 0.5 mm of the original's linear spring at rest.
TEST_P(FlatWall, BallCrossesEdgesJunctionAndVerticesAsOnAPlane) {
  const std::pair<Vec3, Vec3> paths[]{
      {{0.1, 0.0, 0}, {1, 0, 0}},      // along y = 0: through the junction
      {{0.1, -0.35, 0}, {1, 0.4, 0}},  // across all edges
      {{1.0, -0.8, 0}, {0, 1, 0}}};    // along the edges x = 1, over the junction
  for (const auto& [start, direction] : paths) {
    SphereOnMesh s;
    s.mesh.vertices = {{0, -1, 0}, {0, 1, 0},  {1, -1, 0}, {1, 0, 0},
                       {1, 1, 0},  {2, -1, 0}, {2, 0, 0},  {2, 1, 0}};
    s.mesh.triangles = {{0, 2, 1}, {2, 4, 1}, {2, 5, 6}, {2, 6, 3}, {3, 6, 7}, {3, 7, 4}};
    s.radius = 0.5;
    s.density = 1.0 / (4.0 / 3.0 * std::numbers::pi * s.radius * s.radius * s.radius);
    s.gravity = {0, 0, -1.0};
    s.restitution = 1.0;
    const double delta = 0.5e-3;
    s.shear_modulus = 1e6;
    s.shear_modulus *= 1.0 / contact::hertz_force(s.pair(), s.radius, delta);
    ASSERT_NEAR(contact::hertz_overlap(s.pair(), s.radius, 1.0), delta, 1e-15);
    s.contact = GetParam();
    s.position = start + Vec3{0, 0, s.radius - delta};
    s.velocity = normalized(direction);
    s.time_step = 1e-3;
    s.end = 1.6;
    simulation::Simulation run = s.run();
    double force = 0.0, normal = 0.0;
    while (!run.finished()) {
      run.step();
      const auto& touches = run.contact(0, 0).touches();
      ASSERT_EQ(touches.size(), 1U);
      force = std::max(force, std::abs(run.force_on(0).normal - 1.0));
      normal = std::max(normal, norm(touches[0].n - Vec3{0, 0, 1}));
    }
    const double speed = std::abs(norm(run.particles().velocity[0]) - 1.0);
    const std::string name = GetParam() == ContactRule::patch ? "W1, patch: " : "W1, resolved: ";
    measured(name + "force", force, 1e-10);
    measured(name + "normal", normal, 1e-10);
    measured(name + "speed", speed, 1e-10);
    EXPECT_LT(force, 1e-10);
    EXPECT_LT(normal, 1e-10);
    EXPECT_LT(speed, 1e-10);
  }
}

INSTANTIATE_TEST_SUITE_P(Rules, FlatWall, testing::Values(ContactRule::patch, ContactRule::resolved));

TEST(Tessellation, ForceOnAFlatMeshIsHertzFrom50MicrometresTo2Millimetres) {
  core::RandomStream random(3);
  for (const double delta : {1.1e-6, 10e-6, 40.8e-6}) {
    double worst = 0.0;
    for (const double h : {0.05e-3, 0.1e-3, 0.2e-3, 0.5e-3, 1e-3, 2e-3}) {
      const double side = 2.2 * std::sqrt(2.0 * R * delta) + 3.0 * h;
      Scene scene(jittered_plate(side, side, h, 0.25, 7));
      for (int trial = 0; trial < 10; ++trial) {
        const Vec3 c{random.uniform(-0.5, 0.5) * h, random.uniform(-0.5, 0.5) * h, R - delta};
        worst = std::max(
            worst,
            std::abs(press(scene, c, R, kPair).elastic_force / contact::hertz_force(kPair, R, delta) - 1.0));
      }
    }
    measured(fmt::format("flat meshes, h = 0.05 to 2 mm, overlap {} um: force", 1e6 * delta), worst, 1e-6);
    EXPECT_LT(worst, 1e-6);
  }
}

TEST(Tessellation, NodeNoiseRipplesTheForceByLessThanOnePercent) {
  // The paper's contact: delta = 40.8 um on 0.1 mm, sqrt(R delta) / h = 3.5; noise of 2 um. Slide at constant
  // height.
  TriangleMesh mesh = jittered_plate(5e-3, 3e-3, 0.1e-3, 0.2, 5);
  roughen(mesh, 2e-6, 11);
  Scene scene(mesh);
  double sum = 0.0, sum2 = 0.0;
  constexpr int n = 400;
  for (int i = 0; i < n; ++i) {
    const double f = press(scene, {-1.5e-3 + 3e-3 * i / n, 0.013e-3, R - 40.8e-6}, R, kPair).elastic_force;
    sum += f, sum2 += f * f;
  }
  const double mean = sum / n, ripple = std::sqrt(sum2 / n - mean * mean) / mean;
  measured("2 um of node noise, sqrt(R delta)/h = 3.5: standard deviation of the force", ripple, 0.01);
  measured("… its mean over Hertz, minus 1", mean / contact::hertz_force(kPair, R, 40.8e-6) - 1.0, 0.02);
  EXPECT_LT(ripple, 0.01);
  EXPECT_NEAR(mean / contact::hertz_force(kPair, R, 40.8e-6), 1.0, 0.02);
}

TEST(WornWall, LoweredUniformlyIsAPlane) {
  // W7: every vertex given its star's share of one depth; then pressed at the same overlap.
  const double depth = 5e-6, delta = 20e-6;
  wear::WearingSurface surface(jittered_plate(3e-3, 3e-3, 0.1e-3, 0.25, 5));
  for (geometry::Index t = 0; t < surface.mesh().triangle_count(); ++t) {
    const double volume = depth * norm(area_vector(surface.mesh(), t));
    surface.deposit(t, volume, volume / 3.0, volume / 3.0, volume / 3.0);
  }
  surface.deform_conserving();
  double flatness = 0.0;
  for (const Vec3& p : surface.mesh().vertices) flatness = std::max(flatness, std::abs(p.z + depth));
  EXPECT_LT(flatness, 1e-12 * depth);
  Scene scene(surface.mesh());
  const contact::Patch patch = press(scene, {0.01e-3, 0.02e-3, R - depth - delta}, R, kPair);
  const double error = patch.elastic_force / contact::hertz_force(kPair, R, delta) - 1.0;
  measured("W7, mesh lowered by 5 um: force", error, 1e-6);
  EXPECT_NEAR(error, 0.0, 1e-6);
  EXPECT_NEAR(norm(patch.n - Vec3{0, 0, 1}), 0.0, 1e-12);
}

/// The rule's integrals for a ball in an exact cylinder groove of radius `groove` along x, by quadrature over
/// its surface: F = K(M) int g n dA.
Vec3 force_in_cylinder(const Vec3& c, double groove) {
  constexpr int n = 1200;
  const double rim = 1.2e-3, step = 2.0 * rim / n;
  Vec3 G;
  double M = 0.0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double x = c.x - rim + (i + 0.5) * step, y = c.y - rim + (j + 0.5) * step;
      const double z = groove - std::sqrt(groove * groove - y * y);
      const Vec3 offset = Vec3{x, y, z} - c;
      const double r2 = norm2(offset);
      if (r2 >= R * R) continue;
      const double r = std::sqrt(r2), cosine = (groove - z) / groove;
      const Vec3 n_out{0.0, -y / groove, cosine};
      const double dA = step * step / cosine;
      G += (R - r) * dA * n_out;
      const double Q = R * (R * R * R - r2 * r) / 3.0 - (R * R * R * R - r2 * r2) / 4.0;
      M -= Q / (r2 * r) * dot(n_out, offset) * dA;
    }
  return contact::patch_stiffness(kPair, R, contact::equivalent_overlap(M, R)) * G;
}

TEST(WornWall, GrooveFlankPushesLikeTheAnalyticCylinder) {
  const double groove = 1.5 * R, delta = 20e-6;
  for (const double lean : {0.0, 0.1, 0.2}) {  // how far up the flank the ball is pressed [rad]
    const Vec3 n{0.0, -std::sin(lean), std::cos(lean)};
    const Vec3 c = Vec3{0.013e-3, 0.0, groove} - (groove - R + delta) * n;
    const Vec3 exact = force_in_cylinder(c, groove);
    for (const double h : {0.1e-3, 0.05e-3}) {
      Scene scene(jittered_plate(3.2e-3, 3.2e-3, h, 0.2, 5, [&](double, double y) {
        return groove - std::sqrt(groove * groove - y * y);
      }));
      const contact::Patch patch = press(scene, c, R, kPair);
      const double error = norm(patch.elastic_force * patch.n - exact) / norm(exact);
      measured(
          fmt::format("W7, cylinder groove of 1.5 R, {} rad up the flank, h = {} mm: force", lean, 1e3 * h),
          error, 0.02);
      EXPECT_LT(error, 0.02);
    }
  }
}

}  // namespace
}  // namespace abradem::test
