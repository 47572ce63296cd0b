// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/contact/mesh_candidates.h"

#include <gtest/gtest.h>

#include <numbers>
#include <set>

#include "abradem/contact/candidate_kernels.h"
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

TEST(MeshCandidates, HoldEveryTriangleAlongASlideOverAWornSurface) {
  constexpr double deepest = 15e-6;
  const Vec3 down{0, 0, -1};
  core::RandomStream random(22);
  for (const double degrees : {0.0, 25.0, 90.0, 205.0}) {
    test::Scene scene(test::jittered_plate(6e-3, 6e-3, 0.15e-3, 0.25, 3));
    for (Vec3& p : scene.mesh.vertices) p.z -= random.uniform(0.0, deepest);
    const double angle = degrees * std::numbers::pi / 180.0;
    const CandidateSkin skin{30e-6, 3e-6, 0.75e-3 * Vec3{std::cos(angle), std::sin(angle), 0.0}};
    const Vec3 start{0.2e-3, -0.1e-3, R - 40e-6};
    const SurfaceView view{scene.mesh, scene.grid, 2, 0.0, deepest};
    scene.candidates.update(view, start, down, R, skin);
    const std::set<Index> have(scene.candidates.triangle.begin(), scene.candidates.triangle.end());
    EXPECT_LT(have.size(), scene.mesh.triangles.size() / 3);
    for (int trial = 0; trial < 25; ++trial) {
      const Vec3 c = start + random.uniform(0.0, 1.0) * skin.slide + Vec3{0, 0, random.uniform(-3e-6, 3e-6)};
      EXPECT_FALSE(scene.candidates.stale(view, c, R));
      for (const Index t : in_reach(scene.mesh, c, R)) EXPECT_TRUE(have.contains(t));
    }
  }
}

TEST(MeshCandidates, MeasureTrianglesAndNodes) {
  auto rough = test::jittered_plate(4e-3, 4e-3, 0.2e-3, 0.25, 3);
  test::roughen(rough, 20e-6, 3);
  test::Scene scene(rough);
  const Vec3 c{0, 0, R - 40e-6};
  const MeshCandidates& m = scene.candidates_at(c, R);
  std::vector<double> node_area(m.node_count());
  std::vector<Vec3> node_vector(m.node_count());
  double longest2 = 0.0;
  for (std::size_t t = 0; t < m.triangle_count(); ++t) {
    const Vec3 a = geometry::area_vector(rough, m.triangle[t]);
    EXPECT_NEAR(norm(a - Vec3{m.ax[t], m.ay[t], m.az[t]}), 0.0, 1e-14 * norm(a));
    EXPECT_NEAR(m.area[t], norm(a), 1e-14 * norm(a));
    EXPECT_EQ(m.longest[t], std::max({m.l01[t], m.l12[t], m.l20[t]}));
    longest2 = std::max(longest2, m.longest[t]);
    for (const auto v : {m.v0[t], m.v1[t], m.v2[t]}) {
      node_area[static_cast<std::size_t>(v)] += norm(a) / 3.0;
      node_vector[static_cast<std::size_t>(v)] += a / 3.0;
    }
  }
  EXPECT_EQ(m.longest_edge2, longest2);
  for (std::size_t i = 0; i < m.node_count(); ++i) {
    EXPECT_NEAR(m.node_area[i], node_area[i], 1e-14 * node_area[i]);
    EXPECT_NEAR(norm(node_vector[i] - Vec3{m.bx[i], m.by[i], m.bz[i]}), 0.0, 1e-14 * node_area[i]);
    EXPECT_GE(dot(m.node_position(i) - m.mean_point, m.mean_normal), -m.below_plane);
  }
}

TEST(MeshCandidates, CountTheNodesInFrontThatReachALevel) {
  const std::vector<double> excess{3, 1, 2, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  EXPECT_EQ(MeshCandidates::count_above(excess, 0.0), 16U);
  EXPECT_EQ(MeshCandidates::count_above(excess, 1.0), 8U);
  EXPECT_EQ(MeshCandidates::count_above(excess, 3.0), 0U);
  EXPECT_EQ(MeshCandidates::count_above(excess, -1.0), 24U);
}

TEST(MeshCandidates, AddUpHowFarCentroidsInsideTheBallMove) {
  test::Scene scene(test::jittered_plate(4e-3, 4e-3, 0.2e-3, 0.25, 3));
  const MeshCandidates& m = scene.candidates_at({0, 0, R - 40e-6}, R);
  core::RandomStream random(23);
  std::vector<kernels::NodeMotion> moved(m.x.size());
  std::vector<double> scratch;
  for (std::size_t i = 0; i < m.node_count(); ++i) {
    const double inside = random.uniform(-1.0, 0.2) > 0.0 ? 1.0 : 0.0;
    const double x = random.uniform(-1e-7, 1e-7), y = random.uniform(-1e-7, 1e-7);
    moved[i] = {x, y, random.uniform(-1e-6, 0.0), inside};
  }
  double volume = 0.0;
  for (std::size_t t = 0; t < m.triangle_count(); ++t) {
    Vec3 motion;
    bool inside = false;
    for (const auto v : {m.v0[t], m.v1[t], m.v2[t]}) {
      const auto i = static_cast<std::size_t>(v);
      motion += Vec3{moved[i][0], moved[i][1], moved[i][2]} / 3.0;
      inside = inside || moved[i][3] > 0.0;
    }
    if (inside) volume += norm(motion) * m.area[t];
  }
  EXPECT_GT(volume, 0.0);
  EXPECT_NEAR(kernels::centroid_motion(m, moved, scratch), volume, 1e-13 * volume);
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

/// What is measured to the bit does not depend on which of the moves before were looked at.
TEST(MeshCandidates, ToTheBitForgetWhenTheyWereUpdated) {
  for (const bool to_the_bit : {true, false}) {
    test::Scene scene(test::jittered_plate(8e-3, 8e-3, 2e-3, 0.2));
    MeshCandidates often, seldom;
    const Vec3 c{0.1e-3, 0.2e-3, 3e-3};
    const CandidateSkin skin{1e-3, 1e-3};
    double odometer = 0.0;
    const auto update = [&](MeshCandidates& m, std::uint64_t revision) {
      m.update({scene.mesh, scene.grid, revision, odometer, odometer}, c, {}, 3.1e-3, skin, to_the_bit);
    };
    update(often, 1);
    update(seldom, 1);
    for (std::uint64_t revision = 2; revision <= 4; ++revision) {  // each 0.2 % of an edge
      for (std::size_t v = 0; v < scene.mesh.vertices.size(); v += 2) scene.mesh.vertices[v].z -= 4e-6;
      odometer += 4e-6;
      update(often, revision);
      if (revision == 4) update(seldom, revision);
    }
    ASSERT_EQ(often.gatherings(), 1U);
    ASSERT_GT(often.triangle_count(), 4U);
    bool same = true;
    for (std::size_t t = 0; t < often.triangle_count(); ++t)
      same = same && often.area[t] == seldom.area[t] && often.ax[t] == seldom.ax[t];
    EXPECT_EQ(same, to_the_bit);
  }
}

}  // namespace
}  // namespace abradem::contact
