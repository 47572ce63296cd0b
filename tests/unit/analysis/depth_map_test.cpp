// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/analysis/depth_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "abradem/core/error.h"
#include "abradem/core/random.h"
#include "abradem/geometry/generators.h"
#include "support/says.h"

namespace abradem::analysis {
namespace {

/// Two right triangles of a square of side 1 at z = height, facing up or down.
geometry::TriangleMesh square(double height, bool up) {
  geometry::TriangleMesh m;
  m.vertices = {{0, 0, height}, {1, 0, height}, {1, 1, height}, {0, 1, height}};
  m.triangles = up ? std::vector<geometry::Triangle>{{0, 1, 2}, {0, 2, 3}}
                   : std::vector<geometry::Triangle>{{0, 2, 1}, {0, 3, 2}};
  return m;
}

void add(DepthPlaces& places, const geometry::TriangleMesh& mesh) {
  places.add(mesh.vertices, mesh.triangles);
}

TEST(DepthPlaces, AverageOverTheirElements) {
  DepthPlaces places(2.0);
  add(places, square(0.5, true));
  ASSERT_EQ(places.size(), 1u);
  EXPECT_DOUBLE_EQ(places.area()[0], 1.0);
  EXPECT_DOUBLE_EQ(places.depths(std::vector{0.2, 0.4})[0], 0.6);
}

/// The two faces of a bar that is thinner than a place, and two walls at the same place.
TEST(DepthPlaces, KeepFacesAndSurfacesApart) {
  DepthPlaces bar(2.0);
  geometry::TriangleMesh both = square(0.6, true);
  const geometry::TriangleMesh below = square(0.5, false);
  for (const geometry::Triangle& t : below.triangles)
    both.triangles.push_back({t[0] + 4, t[1] + 4, t[2] + 4});
  both.vertices.insert(both.vertices.end(), below.vertices.begin(), below.vertices.end());
  add(bar, both);
  EXPECT_EQ(bar.size(), 2u);
  DepthPlaces walls(2.0);
  add(walls, square(0.5, true));
  add(walls, square(0.5, true));
  EXPECT_EQ(walls.size(), 2u);
}

TEST(DepthPlaces, AreAboutAsWideAsAsked) {
  const geometry::TriangleMesh plate = geometry::make_plate(1.0, 1.0, 0.02, 1);
  DepthPlaces places(0.1);
  places.add(plate.vertices, plate.triangles);
  EXPECT_GE(places.size(), 100u);
  EXPECT_LE(places.size(), 121u);
  double area = 0.0;
  for (const double a : places.area()) area += a;
  EXPECT_NEAR(area, 1.0, 1e-12);
}

TEST(DepthPlaces, RefuseWhatIsNoLengthOrNotOfTheirElements) {
  EXPECT_THROW(DepthPlaces(0.0), InputError);
  DepthPlaces places(1.0);
  add(places, square(0.0, true));
  EXPECT_THROW((void)places.depths(std::vector{1.0}), InputError);
}

TEST(MapSize, IsARootMeanSquareOverTheArea) {
  EXPECT_DOUBLE_EQ(map_size(std::vector{3.0, 0.0}, std::vector{1.0, 3.0}), 1.5);
  EXPECT_EQ(map_size({}, {}), 0.0);
}

/// Independent parts of sd 1 on a rate that rises: the noise of their sum is 2, whatever the rise.
TEST(MapNoise, IsThatOfTheSumAndKnowsNoTrend) {
  core::RandomStream random(4);
  constexpr std::size_t kPlaces = 20000;
  const std::vector<double> area(kPlaces, 1.0);
  std::array<std::vector<double>, 4> quarters;
  for (std::size_t q = 0; q < 4; ++q)
    for (std::size_t p = 0; p < kPlaces; ++p)
      quarters[q].push_back(50.0 + 30.0 * static_cast<double>(q) +
                            random.uniform(-1.0, 1.0) * std::sqrt(3.0));
  EXPECT_NEAR(map_noise(quarters, area), 2.0, 0.03);
}

}  // namespace
}  // namespace abradem::analysis
