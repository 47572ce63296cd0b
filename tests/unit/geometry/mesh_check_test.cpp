// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/geometry/mesh_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "abradem/geometry/generators.h"
#include "abradem/geometry/mesh_repair.h"
#include "unit/geometry/mesh_zoo.h"

namespace abradem::geometry {
namespace {

bool mentions(const std::vector<std::string>& messages, const std::string& part) {
  for (const std::string& m : messages)
    if (m.find(part) != std::string::npos) return true;
  return false;
}

TEST(TriangleQuality, IsOneForEquilateralAndNothingForFlat) {
  EXPECT_NEAR(triangle_quality({0, 0, 0}, {2, 0, 0}, {1, std::numbers::sqrt3, 0}), 1.0, 1e-15);
  EXPECT_NEAR(triangle_quality({0, 0, 0}, {3, 0, 0}, {0, 4, 0}), 4.0 * std::numbers::sqrt3 * 6.0 / 50.0,
              1e-15);
  EXPECT_EQ(triangle_quality({0, 0, 0}, {1, 0, 0}, {2, 0, 0}), 0.0);
  EXPECT_EQ(triangle_quality({1, 1, 1}, {1, 1, 1}, {1, 1, 1}), 0.0);
}

TEST(CheckMesh, MeasuresABox) {
  const MeshReport r = check_mesh(zoo::box(1e-3, 2e-3, 3e-3));
  EXPECT_EQ(r.triangles, 12);
  EXPECT_EQ(r.vertices, 8);
  EXPECT_TRUE(r.closed);
  EXPECT_FALSE(r.inward());
  EXPECT_NEAR(r.volume, 6e-9, 1e-22);
  EXPECT_NEAR(r.area, 22e-6, 1e-18);
  EXPECT_EQ(r.components, 1);
  EXPECT_EQ(r.edge_min, 1e-3);
  EXPECT_NEAR(r.edge_max, std::sqrt(13.0) * 1e-3, 1e-15);
  EXPECT_EQ(r.box.high, (Vec3{1e-3, 2e-3, 3e-3}));
  EXPECT_EQ(r.open_edges + r.non_manifold_edges + r.inconsistent_edges + r.degenerate_triangles + r.slivers +
                r.duplicate_triangles + r.duplicate_vertices + r.unused_vertices + r.border_loops +
                r.small_holes,
            0);
  EXPECT_TRUE(judge_mesh(r).usable());
  EXPECT_TRUE(judge_mesh(r).warnings.empty());
}

TEST(CheckMesh, AcceptsTheGeneratedSheets) {
  const MeshReport ring = check_mesh(make_annulus(20e-3, 24e-3, 0.5e-3, 1));
  EXPECT_EQ(ring.border_loops, 2);
  EXPECT_EQ(ring.small_holes, 0);
  EXPECT_FALSE(ring.closed);
  EXPECT_EQ(ring.volume, 0.0);
  EXPECT_TRUE(judge_mesh(ring, 3e-3).usable());
  EXPECT_TRUE(judge_mesh(ring, 3e-3).warnings.empty());
  EXPECT_EQ(check_mesh(make_plate(10e-3, 5e-3, 0.5e-3, 1)).border_loops, 1);
  // Few triangles are no hole: six of a disc, two of a plate.
  EXPECT_EQ(check_mesh(make_disc(1e-3, 1e-3, 1)).small_holes, 0);
  EXPECT_EQ(check_mesh(make_plate(1e-3, 1e-3, 1e-3, 1)).small_holes, 0);
}

TEST(CheckMesh, FindsMissingTriangles) {
  TriangleMesh mesh = make_disc(5e-3, 0.3e-3, 1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& v = mesh.triangles[t];
    if (norm(mesh.vertices[static_cast<std::size_t>(v[0])] - Vec3{2e-3, 0, 0}) > 0.3e-3) continue;
    mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(t));
    break;
  }
  const MeshReport r = check_mesh(mesh);
  EXPECT_EQ(r.border_loops, 2);
  ASSERT_EQ(r.small_holes, 1);
  EXPECT_NEAR(norm(r.small_hole_place - Vec3{2e-3, 0, 0}), 0.0, 0.5e-3);
  EXPECT_FALSE(judge_mesh(r).usable());
  EXPECT_TRUE(mentions(judge_mesh(r).errors, "1 small hole"));
}

TEST(CheckMesh, LetsAnOpenBoxPass) {
  TriangleMesh mesh = zoo::box(1e-3, 1e-3, 1e-3);
  mesh.triangles.erase(mesh.triangles.begin() + 2, mesh.triangles.begin() + 4);  // the lid
  const MeshReport r = check_mesh(mesh);
  EXPECT_EQ(r.open_edges, 4);
  EXPECT_EQ(r.border_loops, 1);
  EXPECT_TRUE(judge_mesh(r).usable());
}

TEST(CheckMesh, CountsEveryKindOfDefect) {
  TriangleMesh mesh = zoo::box(1e-3, 1e-3, 1e-3);
  mesh.vertices.push_back({0, 0, 0});        // 8: coincides with 0
  mesh.vertices.push_back({5e-4, 0, 0});     // 9: on the edge from 0 to 1
  mesh.vertices.push_back({5e-4, 1e-5, 0});  // 10: a little beside it
  mesh.vertices.push_back({9e-3, 0, 0});     // 11: unused
  mesh.vertices.push_back({0, 0, -1e-3});    // 12
  mesh.triangles.push_back({3, 0, 2});       // the first once more
  mesh.triangles.push_back({0, 9, 1});       // no area
  mesh.triangles.push_back({8, 10, 1});      // thin
  mesh.triangles.push_back({0, 1, 12});      // a fin: an edge with three triangles or more
  const MeshReport r = check_mesh(mesh);
  EXPECT_EQ(r.duplicate_vertices, 1);
  EXPECT_EQ(r.unused_vertices, 1);
  EXPECT_EQ(r.duplicate_triangles, 1);
  EXPECT_EQ(r.degenerate_triangles, 1);
  EXPECT_EQ(r.slivers, 1);
  EXPECT_GE(r.non_manifold_edges, 1);
  EXPECT_FALSE(r.closed);
  const MeshVerdict verdict = judge_mesh(r);
  EXPECT_TRUE(mentions(verdict.errors, "1 triangle has no area"));
  EXPECT_TRUE(mentions(verdict.errors, "1 triangle is there twice"));
  EXPECT_TRUE(mentions(verdict.errors, "more than two triangles"));
  EXPECT_TRUE(mentions(verdict.warnings, "very thin"));
  EXPECT_TRUE(mentions(verdict.warnings, "1 vertex coincides"));
}

TEST(CheckMesh, SeesInconsistentAndInwardOrientation) {
  TriangleMesh mesh = zoo::box(1e-3, 1e-3, 1e-3);
  std::swap(mesh.triangles[0][1], mesh.triangles[0][2]);
  EXPECT_EQ(check_mesh(mesh).inconsistent_edges, 3);
  EXPECT_TRUE(mentions(judge_mesh(check_mesh(mesh)).errors, "face opposite ways"));
  mesh = zoo::box(1e-3, 1e-3, 1e-3);
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  EXPECT_TRUE(check_mesh(mesh).inward());
  EXPECT_TRUE(mentions(judge_mesh(check_mesh(mesh)).errors, "inside out"));
}

TEST(CheckMesh, DoubtsTheUnit) {
  const auto scaled = [](double factor) {
    return check_mesh(make_annulus(20e-3 * factor, 24e-3 * factor, 2e-3 * factor, 1));
  };
  EXPECT_TRUE(judge_mesh(scaled(1.0), 3e-3).usable());
  const MeshVerdict too_large = judge_mesh(scaled(1e3), 3e-3);  // millimetres read as metres
  EXPECT_TRUE(mentions(too_large.errors, "Is the file in millimetres?"));
  const MeshVerdict too_small = judge_mesh(scaled(1e-3), 3e-3);  // metres read as millimetres
  EXPECT_TRUE(mentions(too_small.errors, "Is the file in metres?"));
  EXPECT_TRUE(judge_mesh(scaled(1.0)).warnings.empty());
  EXPECT_TRUE(mentions(judge_mesh(scaled(1e3)).warnings, "millimetres"));
  EXPECT_TRUE(mentions(judge_mesh(scaled(1e-3)).warnings, "metres"));
}

TEST(CheckMesh, AnEmptyMeshIsNotUsable) {
  const MeshReport r = check_mesh({});
  EXPECT_FALSE(r.closed);
  EXPECT_TRUE(mentions(judge_mesh(r).errors, "no triangles"));
}

TEST(WeldVertices, JoinsASoupAndKeepsTheOrder) {
  const TriangleMesh whole = make_disc(5e-3, 0.5e-3, 2);
  TriangleMesh soup = zoo::unshared(whole);
  const Index removed = weld_vertices(soup);
  EXPECT_EQ(removed, 3 * whole.triangle_count() - whole.vertex_count());
  ASSERT_EQ(soup.vertex_count(), whole.vertex_count());
  ASSERT_EQ(soup.triangle_count(), whole.triangle_count());
  for (std::size_t t = 0; t < whole.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      ASSERT_EQ(soup.vertices[static_cast<std::size_t>(soup.triangles[t][k])],
                whole.vertices[static_cast<std::size_t>(whole.triangles[t][k])]);
}

TEST(WeldVertices, JoinsWithinTheToleranceOnly) {
  // The corners of the unit box, jittered: 1e-7 is within 1e-6 of the mean edge, 1e-4 is not.
  for (const auto& [jitter, expected] : {std::pair{1e-7, 8}, std::pair{-1e-7, 8}, std::pair{1e-4, 36}}) {
    TriangleMesh soup = zoo::unshared(zoo::box(1, 1, 1));
    double factor = 0.0;
    for (Vec3& v : soup.vertices) v.x += jitter * factor, factor += 1.0 / 36.0;
    weld_vertices(soup);
    EXPECT_EQ(soup.vertex_count(), expected) << jitter;
  }
}

TEST(WeldVertices, TakesMinusZeroForZero) {
  TriangleMesh mesh{{{0.0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, 0, 0}, {-1, 0, 0}, {0, -1, 0}},
                    {{0, 1, 2}, {3, 4, 5}}};
  EXPECT_EQ(weld_vertices(mesh, 0.0), 1);
}

TEST(RepairMesh, LeavesASoundMeshAlone) {
  TriangleMesh mesh = make_annulus(20e-3, 24e-3, 1e-3, 1);
  const TriangleMesh before = mesh;
  EXPECT_FALSE(repair_mesh(mesh).changed());
  EXPECT_EQ(mesh.vertices, before.vertices);
  EXPECT_EQ(mesh.triangles, before.triangles);
}

TEST(RepairMesh, MendsABoxWithEveryRepairableDefect) {
  TriangleMesh mesh = zoo::unshared(zoo::box(1e-3, 2e-3, 3e-3));
  std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
  std::swap(mesh.triangles[7][0], mesh.triangles[7][1]);
  mesh.triangles.push_back(mesh.triangles[5]);
  mesh.triangles.push_back({0, 0, 1});
  mesh.vertices.push_back({9, 9, 9});
  const RepairRecord done = repair_mesh(mesh);
  EXPECT_EQ(done.welded_vertices, 28);
  EXPECT_EQ(done.unused_vertices, 1);
  EXPECT_EQ(done.duplicate_triangles, 1);
  EXPECT_EQ(done.degenerate_triangles, 1);
  EXPECT_EQ(done.flipped_triangles, 2);
  EXPECT_FALSE(done.turned_outward);
  const MeshReport r = check_mesh(mesh);
  EXPECT_TRUE(r.closed);
  EXPECT_NEAR(r.volume, 6e-9, 1e-20);
  EXPECT_TRUE(judge_mesh(r).usable());
  EXPECT_FALSE(repair_mesh(mesh).changed()) << "a second repair must find nothing";
}

TEST(RepairMesh, TurnsAClosedMeshOutwardButNotASheet) {
  TriangleMesh body = zoo::box(1, 1, 1);
  for (Triangle& t : body.triangles) std::swap(t[1], t[2]);
  EXPECT_TRUE(repair_mesh(body).turned_outward);
  EXPECT_GT(signed_volume(body), 0.0);
  TriangleMesh sheet = make_plate(1, 1, 0.2, 1);
  for (Triangle& t : sheet.triangles) std::swap(t[1], t[2]);
  EXPECT_FALSE(repair_mesh(sheet).changed()) << "which side of a sheet is outside is the user's choice";
}

TEST(RepairMesh, CannotOrientAMoebiusStrip) {
  TriangleMesh strip;
  constexpr Index n = 20;
  for (Index i = 0; i < n; ++i) {
    const double a = 2.0 * std::numbers::pi * i / n;
    for (const double w : {-0.3, 0.3}) {
      const double r = 1.0 + w * std::cos(0.5 * a);
      strip.vertices.push_back({r * std::cos(a), r * std::sin(a), w * std::sin(0.5 * a)});
    }
  }
  for (Index i = 0; i < n; ++i) {
    const bool last = i == n - 1;
    const Index a = 2 * i, b = 2 * i + 1, c = last ? 1 : 2 * i + 2, d = last ? 0 : 2 * i + 3;
    strip.triangles.push_back({a, b, c});
    strip.triangles.push_back({b, d, c});
  }
  repair_mesh(strip);
  const MeshReport r = check_mesh(strip);
  EXPECT_GT(r.inconsistent_edges, 0);
  EXPECT_FALSE(judge_mesh(r).usable());
}

TEST(DropUnusedVertices, KeepsTheOthersInOrder) {
  TriangleMesh mesh{{{9, 9, 9}, {0, 0, 0}, {8, 8, 8}, {1, 0, 0}, {0, 1, 0}}, {{1, 3, 4}}};
  EXPECT_EQ(drop_unused_vertices(mesh), 2);
  EXPECT_EQ(mesh.vertices, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
}

}  // namespace
}  // namespace abradem::geometry
