// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/contact/mesh_candidates.h"

#include <gtest/gtest.h>

#include <set>

#include "abradem/geometry/closest_point.h"
#include "support/surfaces.h"

namespace abradem::contact {
namespace {

constexpr double R = 3e-3;

std::set<Index> in_reach(const geometry::TriangleMesh& mesh, const Vec3& c, double reach) {
  std::set<Index> found;
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    const auto& v = mesh.triangles[static_cast<std::size_t>(t)];
    const auto p = geometry::closest_point_on_triangle(c, mesh.vertices[static_cast<std::size_t>(v[0])],
                                                       mesh.vertices[static_cast<std::size_t>(v[1])],
                                                       mesh.vertices[static_cast<std::size_t>(v[2])]);
    if (norm(p.point - c) < reach) found.insert(t);
  }
  return found;
}

TEST(MeshCandidates, HoldEveryTriangleInReachWhileTheSphereStaysWithinTheSkin) {
  auto rough = test::jittered_plate(4e-3, 4e-3, 0.3e-3, 0.25, 3);
  test::roughen(rough, 20e-6, 3);
  const std::vector<std::pair<geometry::TriangleMesh, Vec3>> scenes{
      {rough, {0, 0, R - 30e-6}},
      {test::sphere_mesh(2e-3, 3), {0, 3.5e-3, 3.5e-3}},
      {test::box_mesh(2e-3, 3), normalized(Vec3{1, 1, 1}) * (2e-3 * std::sqrt(3.0) + R - 30e-6)}};
  core::RandomStream random(21);
  for (const auto& [mesh, start] : scenes) {
    test::Scene scene(mesh);
    for (const bool known : {false, true}) {
      const Vec3 axis = known ? normalized(-start) : Vec3{};
      const CandidateSkin skin{100e-6, 10e-6};
      scene.candidates.reset();
      const auto gatherings = scene.candidates.gatherings();
      for (int trial = 0; trial < 50; ++trial) {
        const Vec3 side = normalized(cross(axis == Vec3{} ? Vec3{0, 0, 1} : axis, Vec3{0.3, 1.0, 0.2}));
        const Vec3 c = start + random.uniform(-0.99, 0.99) * skin.tangential * side +
                       random.uniform(-0.99, 0.99) * skin.normal * axis;
        const MeshCandidates& m = scene.candidates_at(trial == 0 ? start : c, R, axis, skin);
        const std::set<Index> have(m.triangle.begin(), m.triangle.end());
        for (const Index t : in_reach(mesh, trial == 0 ? start : c, R)) EXPECT_TRUE(have.contains(t));
      }
      if (known) {
        EXPECT_EQ(scene.candidates.gatherings(), gatherings + 1);
      }
    }
  }
}

TEST(MeshCandidates, AreGatheredAnewOutsideTheSkinAndForALongerReach) {
  test::Scene scene(test::jittered_plate(4e-3, 4e-3, 0.3e-3, 0.25, 3));
  const CandidateSkin skin{100e-6, 10e-6};
  const Vec3 c{0, 0, R}, down{0, 0, -1};
  const SurfaceView view{scene.mesh, scene.grid, 1, 0.0, 0.0};
  MeshCandidates& m = scene.candidates_at(c, R, down, skin);
  EXPECT_FALSE(m.stale(view, c + Vec3{99e-6, 0, 9e-6}, R));
  EXPECT_TRUE(m.stale(view, c + Vec3{101e-6, 0, 0}, R));
  EXPECT_TRUE(m.stale(view, c + Vec3{0, 0, 11e-6}, R));
  EXPECT_TRUE(m.stale(view, c, 1.01 * R));
  EXPECT_TRUE(m.stale({scene.mesh, scene.grid, 2, 11e-6, 11e-6}, c, R));  // wear has eaten the skin
  m.reset();
  EXPECT_TRUE(m.stale(view, c, R));
}

TEST(MeshCandidates, FollowVerticesThatWearMoves) {
  test::Scene scene(test::jittered_plate(4e-3, 4e-3, 0.3e-3, 0.25, 3));
  const Vec3 c{0, 0, R - 20e-6}, down{0, 0, -1};
  const CandidateSkin skin{100e-6, 30e-6};
  scene.candidates_at(c, R, down, skin);
  for (Vec3& p : scene.mesh.vertices) p.z -= 5e-6;
  scene.candidates.update({scene.mesh, scene.grid, 2, 5e-6, 5e-6}, c, down, R, skin);
  EXPECT_EQ(scene.candidates.gatherings(), 1U);
  for (std::size_t i = 0; i < scene.candidates.node_count(); ++i) EXPECT_EQ(scene.candidates.z[i], -5e-6);
}

TEST(MeshCandidates, SayWhetherTheSurfaceIsNearlyFlat) {
  const auto roof = [](double degrees) {
    const double slope = std::tan(degrees * std::numbers::pi / 180.0);
    return test::jittered_plate(4e-3, 4e-3, 0.5e-3, 0.0, 1,
                                [=](double x, double) { return -slope * std::abs(x); });
  };
  test::Scene gentle(roof(8.0)), steep(roof(12.0));
  EXPECT_TRUE(gentle.candidates_at({0, 0, R - 10e-6}, R).nearly_flat());
  EXPECT_FALSE(steep.candidates_at({0, 0, R - 10e-6}, R).nearly_flat());
}

}  // namespace
}  // namespace abradem::contact
