// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/contact/point_contacts.h"

#include <gtest/gtest.h>

#include "support/surfaces.h"

namespace abradem::contact {
namespace {

using geometry::Feature;
constexpr double R = 3e-3, kDelta = 30e-6;

/// Two half-planes that meet in the y axis; each falls (convex) or rises (concave) by `slope` away from it.
geometry::TriangleMesh ridge(double slope, double size = 20e-3) {
  geometry::TriangleMesh mesh;
  const double run = size * std::cos(slope), z = -size * std::sin(slope);
  mesh.vertices = {{0, -size, 0},  {0, size, 0},     {run, -size, z},
                   {run, size, z}, {-run, -size, z}, {-run, size, z}};
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {0, 1, 5}, {0, 5, 4}};
  return mesh;
}

struct Found {
  std::vector<PointContact> per_triangle, resolved;
};
Found find(const geometry::TriangleMesh& mesh, const Vec3& c) {
  test::Scene scene(mesh);
  PointContactFinder finder;
  const MeshCandidates& m = scene.candidates_at(c, R);
  const auto a = finder.per_triangle(m, c, R);
  Found found{{a.begin(), a.end()}, {}};
  const auto b = finder.resolved(m, c, R);
  found.resolved.assign(b.begin(), b.end());
  return found;
}

TEST(PointContacts, SharedEdgeCountsOnce) {
  const Found f = find(ridge(0.0), {0.0, 0.0, R - kDelta});
  ASSERT_EQ(f.per_triangle.size(), 1U);
  EXPECT_NEAR(f.per_triangle[0].overlap, kDelta, 1e-15);
  EXPECT_NEAR(norm(f.per_triangle[0].n - Vec3{0, 0, 1}), 0.0, 1e-14);
  EXPECT_EQ(f.resolved.size(), 1U);
}

TEST(PointContacts, SharedVertexCountsOnce) {
  geometry::TriangleMesh fan;
  fan.vertices.push_back({});
  constexpr int n = 6;
  for (int k = 0; k < n; ++k) {
    const double a = 2.0 * std::numbers::pi * k / n;
    fan.vertices.push_back({10e-3 * std::cos(a), 10e-3 * std::sin(a), -1e-3});
    fan.triangles.push_back({0, k + 1, (k + 1) % n + 1});
  }
  const Found f = find(fan, {0.0, 0.0, R - kDelta});
  ASSERT_EQ(f.per_triangle.size(), 1U);
  EXPECT_TRUE(geometry::is_vertex(f.per_triangle[0].feature));
  EXPECT_EQ(f.resolved.size(), 1U);
}

TEST(PointContacts, FaceOwnsTheEdgesAndVerticesAroundIt) {
  // Above a face, near the edge to its coplanar neighbour: the neighbour's nearest point lies on that edge.
  const Found f = find(ridge(0.0), {0.1e-3, -3e-3, R - kDelta});
  ASSERT_EQ(f.per_triangle.size(), 1U);
  EXPECT_EQ(f.per_triangle[0].feature, Feature::face);
  EXPECT_EQ(f.resolved.size(), 1U);
}

TEST(PointContacts, ConvexEdgeIsOneContactAlongTheRadius) {
  const double lean = 0.3;  // between the two normals, which stand at +-45 degrees
  const Vec3 direction{std::sin(lean), 0.0, std::cos(lean)};
  const Found f = find(ridge(std::numbers::pi / 4), (R - kDelta) * direction);
  for (const auto* contacts : {&f.per_triangle, &f.resolved}) {
    ASSERT_EQ(contacts->size(), 1U);
    EXPECT_NEAR(norm((*contacts)[0].n - direction), 0.0, 1e-12);
    EXPECT_NEAR((*contacts)[0].overlap, kDelta, 1e-15);
  }
}

TEST(PointContacts, ConcaveCornerIsOneContactPerFace) {
  const Found f = find(ridge(-std::numbers::pi / 4), {0.0, 1e-3, (R - kDelta) * std::sqrt(2.0)});
  for (const auto* contacts : {&f.per_triangle, &f.resolved}) {
    ASSERT_EQ(contacts->size(), 2U);
    for (const PointContact& p : *contacts) {
      EXPECT_EQ(p.feature, Feature::face);
      EXPECT_NEAR(p.overlap, kDelta, 1e-15);
    }
    EXPECT_NEAR(dot((*contacts)[0].n, (*contacts)[1].n), 0.0, 1e-12);
  }
}

TEST(PointContacts, FlatSetsJoinBelowFiveDegreesOfDihedral) {
  const auto contacts_in_valley = [](double dihedral_degrees) {
    const double slope = 0.5 * dihedral_degrees * std::numbers::pi / 180.0;
    return find(ridge(-slope), {0.0, 1e-3, (R - kDelta) / std::cos(slope)}).resolved.size();
  };
  EXPECT_EQ(contacts_in_valley(4.0), 1U);
  EXPECT_EQ(contacts_in_valley(6.0), 2U);
}

TEST(PointContacts, FineFlatMeshIsOneResolvedContactWithTheOverlapOfThePlane) {
  const auto mesh = test::jittered_plate(3e-3, 3e-3, 0.1e-3, 0.25);
  core::RandomStream random(5);
  for (int trial = 0; trial < 20; ++trial) {
    const Found f = find(mesh, {random.uniform(-1, 1) * 1e-4, random.uniform(-1, 1) * 1e-4, R - kDelta});
    ASSERT_EQ(f.resolved.size(), 1U);
    EXPECT_NEAR(f.resolved[0].overlap, kDelta, 1e-12);
    // The paper's rule counts many: that is what makes it too stiff on meshes finer than the contact.
    EXPECT_GT(f.per_triangle.size(), 10U);
  }
}

TEST(PointContacts, EachFeatureOfAFineMeshCountsOnce) {
  auto mesh = test::jittered_plate(2e-3, 2e-3, 0.1e-3, 0.25);
  test::roughen(mesh, 2e-6, 3);
  test::Scene scene(mesh);
  core::RandomStream random(5);
  PointContactFinder finder;
  for (int trial = 0; trial < 20; ++trial) {
    const Vec3 c{random.uniform(-1, 1) * 1e-4, random.uniform(-1, 1) * 1e-4, R - kDelta};
    const MeshCandidates& m = scene.candidates_at(c, R);
    const auto found = finder.per_triangle(m, c, R);
    for (std::size_t i = 0; i < found.size(); ++i)
      for (std::size_t j = i + 1; j < found.size(); ++j)
        EXPECT_GT(norm(found[i].point - found[j].point), 1e-12);
    // A face touched inside owns its vertices: no contact stands on one of them.
    for (const PointContact& face : found) {
      if (face.feature != Feature::face) continue;
      const auto t = static_cast<std::size_t>(face.triangle);
      for (const auto v : {m.v0[t], m.v1[t], m.v2[t]})
        for (const PointContact& other : found)
          EXPECT_GT(norm(other.point - m.node_position(static_cast<std::size_t>(v))), 1e-12);
    }
  }
}

TEST(PointContacts, SurfaceSeenFromBehindIsNotTouched) {
  const Found f = find(ridge(0.0), {0.1e-3, 0.0, -(R - kDelta)});
  EXPECT_TRUE(f.per_triangle.empty());
  EXPECT_TRUE(f.resolved.empty());
}

TEST(PointContacts, DoNotDependOnTheOrderOfTriangles) {
  auto mesh = test::jittered_plate(1e-3, 1e-3, 0.1e-3, 0.25);
  test::roughen(mesh, 2e-6, 3);
  const Vec3 c{0.01e-3, 0.02e-3, R - kDelta};
  const Found f = find(mesh, c);
  std::ranges::reverse(mesh.triangles);
  const Found g = find(mesh, c);
  ASSERT_EQ(f.per_triangle.size(), g.per_triangle.size());
  // The same points, but for the last bits of those on edges.
  const auto holds = [&](const PointContact& p) {
    return std::ranges::any_of(g.per_triangle,
                               [&](const PointContact& q) { return norm(q.point - p.point) < 1e-15; });
  };
  EXPECT_TRUE(std::ranges::all_of(f.per_triangle, holds));
}

/// Every triangle that the ball cuts where the free way leads is one that it cut where the way began.
TEST(PointContacts, TheFreeWayLeadsToNoOtherTriangle) {
  auto mesh = test::jittered_plate(12e-3, 12e-3, 1e-3, 0.25);
  test::roughen(mesh, 20e-6, 3);
  test::Scene scene(mesh);
  core::RandomStream random(5);
  const auto ball = [&](double size) {
    return Vec3{random.uniform(-1, 1) * size, random.uniform(-1, 1) * size, random.uniform(-1, 1) * size};
  };
  int held = 0, further = 0;
  for (int trial = 0; trial < 50; ++trial) {
    PointContactFinder finder;
    const Vec3 c = Vec3{0.0, 0.0, R} + ball(50e-6);
    const MeshCandidates& m = scene.candidates_at(c, 1.1 * R);
    const auto found = finder.resolved(m, c, R);
    std::vector<std::int32_t> cut;
    for (const PointContact& p : finder.touched()) cut.push_back(p.triangle);
    const FreeWay way = finder.free_way(0.2e-3);
    EXPECT_TRUE(way.holds(c, m.odometer()) || !found.empty());
    for (int sample = 0; sample < 200; ++sample) {
      const Vec3 p = c + ball(30e-6);
      if (!way.holds(p, m.odometer())) continue;
      ++held;
      further += norm(p - c) > *std::ranges::min_element(way.gap);
      for (std::size_t t = 0; t < m.triangle_count(); ++t) {
        const auto corner = [&](std::int32_t v) { return m.node_position(static_cast<std::size_t>(v)); };
        const Vec3 nearest =
            geometry::closest_point_on_triangle(p, corner(m.v0[t]), corner(m.v1[t]), corner(m.v2[t])).point;
        const bool known = std::ranges::find(cut, static_cast<std::int32_t>(t)) != cut.end();
        EXPECT_TRUE(known || norm(p - nearest) >= R);
      }
    }
  }
  EXPECT_GT(held, 2000);
  EXPECT_GT(further, 500);  // half-spaces allow more than a distance would
}

/// Wear that comes towards the sphere shortens the way by as much.
TEST(PointContacts, TheFreeWayShrinksByTheWear) {
  test::Scene scene(ridge(0.0));
  PointContactFinder finder;
  const Vec3 c{0.5e-3, 0.0, R + kDelta};
  const MeshCandidates& m = scene.candidates_at(c, 1.1 * R);
  ASSERT_TRUE(finder.resolved(m, c, R).empty());
  const FreeWay way = finder.free_way(1e-3);
  const double worn = m.odometer();
  EXPECT_TRUE(way.holds(c, worn + 0.99 * kDelta));
  EXPECT_FALSE(way.holds(c, worn + 1.01 * kDelta));
  EXPECT_TRUE(way.holds(c + Vec3{0.0, 0.5e-3, -0.9 * kDelta}, worn));
  EXPECT_FALSE(way.holds(c + Vec3{0.0, 0.5e-3, -1.1 * kDelta}, worn));
  EXPECT_FALSE(way.holds(c + Vec3{0.0, 1.1e-3, 0.0}, worn));
  EXPECT_NEAR(way.least(), kDelta, 1e-12);
}

}  // namespace
}  // namespace abradem::contact
