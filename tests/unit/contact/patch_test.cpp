// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/contact/patch.h"

#include <gtest/gtest.h>

#include "abradem/contact/overlap_integrals.h"
#include "support/surfaces.h"

namespace abradem::contact {
namespace {

constexpr double R = 3e-3;
const PairProperties kPair{
    .E_eff = 2.6285e8, .G_eff = 5.675e7, .beta = 0.28, .static_friction = 0.5, .rolling_friction = 0.0};

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

struct Comparison {
  double of_hertz = 0.0;  // force over Hertz's on a plane
  double of_exact = 0.0;  // force over that of the exact integrals of the same triangles
  double tilt = 0.0;      // angle between the two normals [rad]
};

/// The evaluator against the exact integrals, triangle by triangle.
Comparison compare(test::Scene& scene, const Vec3& c, double delta) {
  PatchEvaluator evaluator;
  MeshCandidates& m = scene.candidates_at(c, R);
  const auto patches = evaluator.evaluate(m, c, R, kPair);
  if (patches.size() != 1) return {};
  Vec3 G;
  double M = 0.0;
  for (std::size_t t = 0; t < m.triangle_count(); ++t) {
    const OverlapIntegrals o =
        overlap_of_triangle(m.node_position(at(m.v0[t])) - c, m.node_position(at(m.v1[t])) - c,
                            m.node_position(at(m.v2[t])) - c, R);
    G += o.G * (Vec3{m.ax[t], m.ay[t], m.az[t]} / m.area[t]);
    M += o.M;
  }
  const Patch exact = make_patch(G, M, 0.0, R, kPair);
  return {patches[0].elastic_force / hertz_force(kPair, R, delta),
          patches[0].elastic_force / exact.elastic_force, norm(patches[0].n - exact.n)};
}

TEST(Patch, EqualsHertzAndTheExactIntegralsOnFlatMeshes) {
  for (const double fraction : {1e-4, 1e-3, 3e-3, 1e-2, 3e-2}) {
    const double delta = fraction * R, rim = std::sqrt(2.0 * R * delta);
    for (const double h : {0.05e-3, 0.1e-3, 0.2e-3, 0.5e-3, 1e-3, 2e-3}) {
      const double side = 2.2 * rim + 3.0 * h;  // the rim stays inside
      test::Scene scene(test::jittered_plate(side, side, h, 0.25, 5));
      core::RandomStream random(17);
      for (int trial = 0; trial < 8; ++trial) {
        const Vec3 c{random.uniform(-0.5, 0.5) * h, random.uniform(-0.5, 0.5) * h, R - delta};
        const Comparison r = compare(scene, c, delta);
        EXPECT_NEAR(r.of_hertz, 1.0, 1e-6) << fraction << " " << h;
        EXPECT_NEAR(r.of_exact, 1.0, 1e-6) << fraction << " " << h;
        EXPECT_LT(r.tilt, 1e-12) << fraction << " " << h;
      }
    }
  }
}

// On rough meshes the nodal way is used up to edges of a third of the disc's radius. Its error is that of the
// nodal rule at the rim, of the roughness alone: here 2 um on 40 um, 5 % of the overlap.
TEST(Patch, StaysCloseToTheExactIntegralsOnRoughMeshes) {
  for (const double h : {0.05e-3, 0.1e-3, 0.3e-3}) {
    auto mesh = test::jittered_plate(1.5e-3, 1.5e-3, h, 0.25, 5);
    test::roughen(mesh, 2e-6, 9);
    test::Scene scene(std::move(mesh));
    core::RandomStream random(3);
    for (int trial = 0; trial < 8; ++trial) {
      const Vec3 c{random.uniform(-0.5, 0.5) * h, random.uniform(-0.5, 0.5) * h, R - 40e-6};
      const Comparison r = compare(scene, c, 40e-6);
      EXPECT_NEAR(r.of_exact, 1.0, 3e-3) << h;
      EXPECT_LT(r.tilt, 1e-3) << h;
    }
  }
}

TEST(Patch, GivesTheForceDeepestPointAndNormalOfAPlane) {
  test::Scene scene(test::jittered_plate(4e-3, 4e-3, 0.15e-3, 0.25, 2));
  const double delta = 40e-6;
  const Vec3 c{0.03e-3, -0.05e-3, R - delta};
  PatchEvaluator evaluator;
  const auto patches = evaluator.evaluate(scene.candidates_at(c, R), c, R, kPair);
  ASSERT_EQ(patches.size(), 1U);
  const Patch& p = patches[0];
  EXPECT_NEAR(p.overlap / delta, 1.0, 1e-7);
  EXPECT_NEAR(p.deepest / delta, 1.0, 1e-12);  // inside a triangle, deeper than any node
  EXPECT_NEAR(norm(p.n - Vec3{0, 0, 1}), 0.0, 1e-14);
}

TEST(Patch, IsEmptyJustOutOfReach) {
  test::Scene scene(test::jittered_plate(4e-3, 4e-3, 0.2e-3, 0.25, 2));
  PatchEvaluator evaluator;
  for (const double gap : {1e-12, 1e-6, 1e-3}) {
    const Vec3 c{0.0, 0.0, R + gap};
    EXPECT_TRUE(evaluator.evaluate(scene.candidates_at(c, R), c, R, kPair).empty()) << gap;
  }
}

TEST(Patch, DoesNotDependOnHowTheSceneIsTurned) {
  const double delta = 30e-6, angle = 0.7;
  const Vec3 axis = normalized(Vec3{1.0, -2.0, 0.5});
  const auto turn = [&](const Vec3& p) {
    return p * std::cos(angle) + cross(axis, p) * std::sin(angle) +
           axis * (dot(axis, p) * (1.0 - std::cos(angle)));
  };
  auto mesh = test::jittered_plate(2e-3, 2e-3, 0.1e-3, 0.25, 2);
  test::roughen(mesh, 2e-6, 4);
  test::Scene straight(mesh);
  for (Vec3& p : mesh.vertices) p = turn(p);
  test::Scene turned(mesh);
  const Vec3 c{0.0, 0.0, R - delta};
  PatchEvaluator a, b;
  const Patch p = a.evaluate(straight.candidates_at(c, R), c, R, kPair).front();
  const Patch q = b.evaluate(turned.candidates_at(turn(c), R), turn(c), R, kPair).front();
  EXPECT_NEAR(q.elastic_force / p.elastic_force, 1.0, 1e-12);
  EXPECT_NEAR(norm(q.n - turn(p.n)), 0.0, 1e-12);
}

TEST(Patch, ForceIsTheGradientOfItsPotential) {
  // On a rough open mesh whose borders lie outside the ball: with U(M) such that U' = K, the work of any
  // small move is the change of U. U' = K(delta(M)); check dU along z and x by central differences of the
  // force's own integral over a small square path: its closed-loop work vanishes.
  auto mesh = test::jittered_plate(2e-3, 2e-3, 0.1e-3, 0.25, 2);
  test::roughen(mesh, 2e-6, 4);
  test::Scene scene(mesh);
  PatchEvaluator evaluator;
  const auto force = [&](const Vec3& c) {
    const auto patches = evaluator.evaluate(scene.candidates_at(c, R), c, R, kPair);
    return patches.empty() ? Vec3{} : patches[0].elastic_force * patches[0].n;
  };
  const Vec3 low{-0.05e-3, 0.0, R - 45e-6}, high{0.12e-3, 0.0, R - 20e-6};
  const Vec3 corners[5]{low, {high.x, 0, low.z}, high, {low.x, 0, high.z}, low};
  double net = 0.0, gross = 0.0;
  constexpr int n = 400;
  for (int side = 0; side < 4; ++side) {
    const Vec3 step = (corners[side + 1] - corners[side]) / n;
    for (int i = 0; i < n; ++i) {
      const double work = dot(force(corners[side] + (i + 0.5) * step), step);
      net += work;
      gross += std::abs(work);
    }
  }
  EXPECT_LT(std::abs(net) / gross, 1e-6);
}

TEST(Patch, SplitsAtAConcaveCornerAndMergesOnASmoothBowl) {
  // Concave right angle: floor z = 0 and wall x = 0.
  geometry::TriangleMesh corner;
  const double L = 20e-3;
  corner.vertices = {{0, -L, 0}, {L, -L, 0}, {L, L, 0}, {0, L, 0}, {0, -L, L}, {0, L, L}};
  corner.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 5}, {0, 5, 4}};
  test::Scene scene(corner);
  const double delta = 20e-6;
  const Vec3 c{R - delta, 0.1e-3, R - delta};
  PatchEvaluator evaluator;
  const auto patches = evaluator.evaluate(scene.candidates_at(c, R), c, R, kPair);
  ASSERT_EQ(patches.size(), 2U);
  for (const Patch& p : patches) EXPECT_NEAR(p.elastic_force / hertz_force(kPair, R, delta), 1.0, 1e-9);
  EXPECT_NEAR(dot(patches[0].n, patches[1].n), 0.0, 1e-12);
  EXPECT_EQ(evaluator.clusters().size(), scene.candidates.padded_triangle_count());

  // A bowl of twice the ball's radius is one contact, however many facets.
  const double bowl = 2.0 * R;
  test::Scene smooth(test::jittered_plate(3e-3, 3e-3, 0.2e-3, 0.2, 8, [&](double x, double y) {
    return bowl - std::sqrt(bowl * bowl - x * x - y * y);
  }));
  const Vec3 above{0.0, 0.0, R - 30e-6};
  EXPECT_EQ(evaluator.evaluate(smooth.candidates_at(above, R), above, R, kPair).size(), 1U);
}

TEST(PatchStiffness, MakesAPlaneHertz) {
  for (const double x : {1e-4, 1e-2, 0.1}) {
    const double delta = x * R;
    EXPECT_NEAR(
        patch_stiffness(kPair, R, delta) * overlap_of_plane(delta, R).G / hertz_force(kPair, R, delta), 1.0,
        1e-13);
  }
}

TEST(HertzMindlin, ReproducesThePaperRegime) {
  // R = 3 mm, G = 0.1 GPa, nu = 0.24 on steel, 5 N: approach 40.79 um, S_n = 1.839e5 N/m, S_t = 1.588e5 N/m.
  const PairProperties p = material::effective_moduli({4850, 0.1e9, 0.24}, {7932, 78e9, 0.30});
  const double delta = hertz_overlap(p, R, 5.0), a = contact_radius(R, delta);
  EXPECT_NEAR(delta, 40.79e-6, 0.01e-6);
  EXPECT_NEAR(hertz_force(p, R, delta), 5.0, 1e-12);
  EXPECT_NEAR(a, 0.350e-3, 0.0005e-3);
  EXPECT_NEAR(normal_stiffness(p, a), 1.839e5, 100.0);
  EXPECT_NEAR(tangential_stiffness(p, a), 1.588e5, 100.0);
}

TEST(HertzMindlin, CutsTheSpringToCoulombsConeAndCallsTheRestSlip) {
  PairProperties p = kPair;
  p.beta = 0.0;
  TangentialHistory history;
  const double a = 0.3e-3, S_t = tangential_stiffness(p, a), dt = 1e-5;
  const ContactState state{{0, 0, 1}, 5.0, a, 5e-4, {5.0, 0, 0}};
  const ContactForce f = hertz_mindlin(p, state, dt, history);
  ASSERT_LT(0.5 * 5.0 / S_t, 5e-5);  // 50 um of motion is past the elastic limit
  EXPECT_NEAR(f.F_t.x, -2.5, 1e-12);
  EXPECT_NEAR(f.slip, 5e-5 - 2.5 / S_t, 1e-18);
  EXPECT_NEAR(history.s.x, 2.5 / S_t, 1e-18);
}

TEST(HertzMindlin, TurnsTheSpringWithTheNormalAtItsLength) {
  const Vec3 s{1e-6, 0.0, 0.0};
  const Vec3 n = normalized(Vec3{0.6, 0.0, 0.8});
  const Vec3 turned = rotate_into_plane(s, n);
  EXPECT_NEAR(dot(turned, n), 0.0, 1e-22);
  EXPECT_NEAR(norm(turned), 1e-6, 1e-20);
  EXPECT_EQ(rotate_into_plane({0, 0, 1e-6}, {0, 0, 1}), Vec3{});  // along the normal: nothing is left to turn
}

}  // namespace
}  // namespace abradem::contact
