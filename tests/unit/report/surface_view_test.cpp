// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/report/surface_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "abradem/core/error.h"
#include "abradem/geometry/generators.h"

namespace abradem::report {
namespace {

using geometry::TriangleMesh;

TriangleMesh in_millimetres(TriangleMesh mesh) {
  for (Vec3& p : mesh.vertices) p *= 1e3;
  return mesh;
}

/// A parabolic groove 8 um deep and 0.75 mm wide.
double groove_um(double s_mm) { return std::max(0.0, 8.0 * (1.0 - std::pow(s_mm / 0.375, 2))); }

std::vector<double> ring_groove(const TriangleMesh& mesh) {
  std::vector<double> depth;
  for (const Vec3& p : mesh.vertices) depth.push_back(groove_um(std::hypot(p.x, p.y) - 22.0));
  return depth;
}

TEST(SunkUm, IsTheWayAgainstTheNormal) {
  const TriangleMesh before = in_millimetres(geometry::make_plate(4e-3, 2e-3, 0.5e-3, 1));
  TriangleMesh after = before;
  after.vertices[3].z -= 0.008;
  after.vertices[3].x += 0.1;  // along the surface: not wear
  const std::vector<double> depth = sunk_um(before, after);
  EXPECT_NEAR(depth[3], 8.0, 1e-9);
  EXPECT_EQ(depth[4], 0.0);
  after.vertices.pop_back();
  EXPECT_THROW((void)sunk_um(before, after), IoError);
}

TEST(WornSurface, KeepsTheBandAroundARing) {
  const TriangleMesh mesh = in_millimetres(geometry::make_annulus(20e-3, 24e-3, 0.2e-3, 1));
  const auto surface = worn_surface(mesh, ring_groove(mesh));
  ASSERT_TRUE(surface);
  EXPECT_FALSE(surface->view.resampled);
  EXPECT_LT(surface->view.i.size(), mesh.triangles.size() / 2);
  EXPECT_GT(surface->view.i.size(), mesh.triangles.size() / 8);
  for (std::size_t v = 0; v < surface->view.x_mm.size(); ++v) {
    EXPECT_NEAR(std::hypot(surface->view.x_mm[v], surface->view.y_mm[v]), 22.0, 0.375 * 5.0 / 3.0 + 0.01);
  }
}

TEST(WornSurface, TheMapIsTheDepthAtEachAngleAndRadius) {
  const TriangleMesh mesh = in_millimetres(geometry::make_annulus(20e-3, 24e-3, 0.1e-3, 1));
  const auto surface = worn_surface(mesh, ring_groove(mesh));
  ASSERT_TRUE(surface);
  const WearMap& map = surface->map;
  ASSERT_TRUE(map.polar);
  for (int v = 0; v < map.v_count; ++v) {
    for (int u = 0; u < map.u_count; ++u) {
      const double depth = map.depth_um[static_cast<std::size_t>(v * map.u_count + u)];
      // Linear in triangles of 0.1 mm: at its border the groove bends by 43 um/mm, which an edge of up to
      // 0.12 mm misses by a quarter of its length.
      EXPECT_NEAR(depth, groove_um(map.v_first + v * map.v_step - 22.0), 1.3) << u << ' ' << v;
    }
  }
}

TEST(WornSurface, AStraightTrackIsAMapOfXAndY) {
  const TriangleMesh mesh = in_millimetres(geometry::make_plate(10e-3, 4e-3, 0.2e-3, 1));
  std::vector<double> depth;
  for (const Vec3& p : mesh.vertices) depth.push_back(groove_um(p.y));
  const auto surface = worn_surface(mesh, depth);
  ASSERT_TRUE(surface);
  EXPECT_FALSE(surface->map.polar);
}

TEST(WornSurface, ABandWithTooManyTrianglesIsResampledFacingTheSameWay) {
  const TriangleMesh mesh = in_millimetres(geometry::make_annulus(20e-3, 24e-3, 0.2e-3, 1));
  const auto surface = worn_surface(mesh, ring_groove(mesh), 5000);
  ASSERT_TRUE(surface);
  const SurfaceView& view = surface->view;
  EXPECT_TRUE(view.resampled);
  ASSERT_GT(view.i.size(), 2500u);
  EXPECT_LE(view.i.size(), 5000u);
  for (std::size_t t = 0; t < view.i.size(); ++t) {
    const auto at = [&](std::int32_t v) {
      return Vec3{view.x_mm[static_cast<std::size_t>(v)], view.y_mm[static_cast<std::size_t>(v)], 0.0};
    };
    ASSERT_GT(cross(at(view.j[t]) - at(view.i[t]), at(view.k[t]) - at(view.i[t])).z, 0.0) << t;
  }
  EXPECT_NEAR(*std::max_element(view.depth_um.begin(), view.depth_um.end()), 8.0, 0.7);
}

TEST(WornSurface, NothingWithoutWear) {
  const TriangleMesh mesh = in_millimetres(geometry::make_plate(4e-3, 2e-3, 0.5e-3, 1));
  EXPECT_FALSE(worn_surface(mesh, std::vector<double>(mesh.vertices.size(), 0.0)));
  EXPECT_FALSE(worn_surface({}, {}));
}

}  // namespace
}  // namespace abradem::report
