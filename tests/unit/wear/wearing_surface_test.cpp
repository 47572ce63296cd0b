// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/wear/wearing_surface.h"

#include <gtest/gtest.h>

#include <limits>

#include "abradem/core/error.h"
#include "abradem/wear/archard.h"
#include "support/surfaces.h"

namespace abradem::wear {
namespace {

using test::TriangleMesh;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Wears random elements by random volumes in `updates` updates; all vertices of an element get random parts.
double wear_at_random(WearingSurface& surface, double largest, int updates, std::uint64_t seed,
                      const std::function<bool(const Vec3&)>& where = {}) {
  core::RandomStream random(seed);
  double total = 0.0;
  for (int u = 0; u < updates; ++u) {
    for (Index t = 0; t < surface.mesh().triangle_count(); ++t) {
      if (where && !where(surface.mesh().vertices[at(surface.mesh().triangles[at(t)][0])])) continue;
      if (random.uniform() < 0.5) continue;
      const double p0 = random.uniform() * largest, p1 = random.uniform() * largest,
                   p2 = random.uniform() * largest;
      surface.deposit(t, p0 + p1 + p2, p0, p1, p2);
      total += p0 + p1 + p2;
    }
    surface.deform_conserving();
  }
  return total;
}

TEST(Archard, IsCoefficientTimesForceTimesDistance) {
  EXPECT_DOUBLE_EQ(archard_volume(6.81e-11, {5.0, 0.138}), 6.81e-11 * 5.0 * 0.138);
}

TEST(WearingSurface, SweptBetweenIsTheVolumeOfAPrismAndOfATetrahedron) {
  const Vec3 from[3]{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const Vec3 down[3]{{0, 0, -0.1}, {1, 0, -0.1}, {0, 1, -0.1}};
  EXPECT_NEAR(swept_between(from, down), 0.05, 1e-16);
  const Vec3 corner[3]{{0, 0, -0.3}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_NEAR(swept_between(from, corner), 0.3 * 0.5 / 3.0, 1e-16);
  EXPECT_NEAR(swept_between(corner, from), -0.3 * 0.5 / 3.0, 1e-16);
}

TEST(WearingSurface, OneElementSinksByItsVolumeOverTheThirdOfEachStar) {
  // Two triangles of a unit square: vertices 0 and 2 share both (star third 1/3), 1 and 3 have one (1/6).
  TriangleMesh square;
  square.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  WearingSurface surface(square);
  EXPECT_TRUE(surface.flat());
  surface.deposit(0, 3e-3, 1e-3, 1e-3, 1e-3);
  surface.deform_conserving();
  const auto& v = surface.mesh().vertices;
  EXPECT_NEAR(v[0].z, -3e-3, 1e-17);
  EXPECT_NEAR(v[1].z, -6e-3, 1e-17);
  EXPECT_NEAR(v[2].z, -3e-3, 1e-17);
  EXPECT_EQ(v[3].z, 0.0);
  EXPECT_NEAR(surface.swept_volume(), 3e-3, 1e-17);
  EXPECT_EQ(surface.deposited_volume(), 3e-3);
  EXPECT_EQ(surface.element_volume()[0], 3e-3);
  EXPECT_EQ(surface.worn_triangles(), (std::vector<Index>{0, 1}));
  EXPECT_EQ(surface.revision(), 2U);
  EXPECT_NEAR(surface.odometer(), 6e-3, 1e-17);
}

TEST(WearingSurface, WithoutDepositNothingMoves) {
  const TriangleMesh mesh = test::sphere_mesh(1.0, 2);
  WearingSurface surface(mesh);
  surface.deposit(3, 0.0, 0.0, 0.0, 0.0);
  surface.deform_conserving();
  surface.deform_paper();
  EXPECT_EQ(surface.mesh().vertices, mesh.vertices);
  EXPECT_EQ(surface.swept_volume(), 0.0);
  EXPECT_TRUE(surface.worn_triangles().empty());
}

TEST(WearingSurface, SweepsWhatIsDepositedOnFlatNoisyAndCurvedSurfaces) {
  const auto cylinder = test::jittered_plate(2.0, 2.0, 0.1, 0.2, 4, [](double x, double) {
    return std::sqrt(4.0 - x * x) - 2.0;  // closed borders do not matter: wear stays inside
  });
  auto noisy = test::jittered_plate(2.0, 2.0, 0.1, 0.2, 4);
  test::roughen(noisy, 0.02, 5);
  const auto inside = [](const Vec3& p) { return std::abs(p.x) < 0.6 && std::abs(p.y) < 0.6; };
  for (const TriangleMesh& mesh : {test::jittered_plate(2.0, 2.0, 0.1, 0.2, 4), noisy, cylinder}) {
    WearingSurface surface(mesh);
    const double total = wear_at_random(surface, 2e-7, 20, 8, inside);
    EXPECT_NEAR(surface.swept_volume() / total, 1.0, 1e-12);
    EXPECT_NEAR(surface.deposited_volume() / total, 1.0, 1e-14);
  }
}

TEST(WearingSurface, SweepsWhatIsDepositedAtOpenBorders) {
  const auto shapes = {test::Height{},
                       test::Height([](double x, double y) { return 0.1 * x * x - 0.05 * x * y; })};
  for (const auto& height : shapes) {
    WearingSurface surface(test::jittered_plate(2.0, 2.0, 0.2, 0.2, 4, height));
    const double total = wear_at_random(surface, 2e-6, 20, 8);
    EXPECT_NEAR(surface.swept_volume() / total, 1.0, 1e-12);
  }
}

TEST(WearingSurface, OfAClosedBodySweepsTheChangeOfItsVolume) {
  for (const TriangleMesh& mesh : {test::sphere_mesh(1.0, 3), test::box_mesh(1.0, 6)}) {
    WearingSurface surface(mesh);
    const double total = wear_at_random(surface, 1e-4, 10, 2);
    const double lost = geometry::signed_volume(mesh) - geometry::signed_volume(surface.mesh());
    ASSERT_GT(lost, 0.01);
    EXPECT_NEAR(surface.swept_volume() / lost, 1.0, 1e-12);
    EXPECT_NEAR(lost / total, 1.0, 1e-12);
    EXPECT_EQ(surface.guards().fatal_steps, 0U);
  }
}

TEST(WearingSurface, DoesNotDependOnTheOrderOfDeposits) {
  const TriangleMesh mesh = test::sphere_mesh(1.0, 3);
  WearingSurface forward(mesh), backward(mesh);
  const auto deposit = [](WearingSurface& s, Index t) { s.deposit(t, 3e-6, 1e-6, 1e-6, 1e-6); };
  for (Index t = 0; t < mesh.triangle_count(); t += 2) deposit(forward, t);
  for (Index t = mesh.triangle_count() - 2; t >= 0; t -= 2) deposit(backward, t);
  forward.deform_conserving();
  backward.deform_conserving();
  EXPECT_EQ(forward.mesh().vertices, backward.mesh().vertices);
}

TEST(WearingSurface, PaperRuleMovesThreeNodesByTheFullDepthAndSweepsSixTimesTheVolume) {
  WearingSurface surface(test::jittered_plate(2.0, 2.0, 0.1, 0.0));
  // An element in the middle: A = 0.005, dV / A = 1e-6.
  const Index element = surface.mesh().triangle_count() / 2 + 20;
  const double area = norm(area_vector(surface.mesh(), element));
  surface.deposit_element(element, 1e-6 * area);
  const double eq_11 = surface.deform_paper();
  for (const Index v : surface.mesh().triangles[at(element)])
    EXPECT_NEAR(surface.mesh().vertices[at(v)].z, -1e-6, 1e-20);
  EXPECT_NEAR(eq_11, 1e-6 * area, 1e-20);  // the element in contact alone: its centre sank by dV / A
  // Each of the three nodes carries a third of its star; on this grid stars hold 4 or 8 triangles, 6 on
  // average.
  double stars = 0.0;
  for (const Index v : surface.mesh().triangles[at(element)])
    stars += static_cast<double>(surface.stars()[v].size());
  EXPECT_NEAR(surface.swept_volume() / (1e-6 * area), stars / 3.0, 1e-9);
}

TEST(WearingSurface, PaperRuleSweepsTheMeanSquareValenceOverTheMean) {
  // Elements of one size worn alike: a vertex of n triangles sinks n times and sweeps n thirds of an element
  // each time. Summed, sum n^2 / sum n: six where all have six, more where they vary.
  for (const bool regular : {true, false}) {
    TriangleMesh mesh =
        test::jittered_plate(6.0, 6.0, 0.1, 0.0);  // diagonals alternate: 4 or 8 around a vertex
    if (regular)
      for (std::size_t t = 0; t < mesh.triangles.size(); t += 2) {
        auto &first = mesh.triangles[t], &second = mesh.triangles[t + 1];
        if (first[2] != second[2]) continue;  // already cut from the first to the third corner
        const Index a = first[0], b = first[1], c = second[1], d = first[2];
        first = {a, b, c};
        second = {a, c, d};
      }
    WearingSurface surface(mesh);
    double worn = 0.0;
    for (Index t = 0; t < mesh.triangle_count(); ++t) {
      const double volume = 1e-6 * norm(area_vector(mesh, t));
      surface.deposit_element(t, volume);
      worn += volume;
    }
    double n = 0.0, n2 = 0.0;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const auto valence = static_cast<double>(surface.stars()[v].size());
      n += valence;
      n2 += valence * valence;
    }
    surface.deform_paper();
    const double kappa = surface.swept_volume() / worn;
    EXPECT_NEAR(kappa / (n2 / n), 1.0, 1e-9);
    EXPECT_NEAR(kappa, regular ? 6.0 : 20.0 / 3.0, 0.15);  // vertices on the border have fewer
  }
}

TEST(WearingSurface, PaperRuleUsesTheNormalsOfTheBeginningOfTheStep) {
  const TriangleMesh mesh = test::sphere_mesh(1.0, 2);
  WearingSurface surface(mesh);
  surface.deposit_element(0, 1e-4);
  surface.deposit_element(1, 1e-4);
  surface.deform_paper();
  Vec3 expected;  // of a vertex of both
  const Index shared = mesh.triangles[0][1];
  for (const Index t : {Index{0}, Index{1}}) {
    const auto& v = mesh.triangles[at(t)];
    if (v[0] != shared && v[1] != shared && v[2] != shared) continue;
    const Vec3 a = area_vector(mesh, t);
    expected -= a * (1e-4 / norm2(a));
  }
  EXPECT_NEAR(norm(surface.mesh().vertices[at(shared)] - mesh.vertices[at(shared)] - expected), 0.0, 1e-16);
}

TEST(WearingSurface, CountsStepsTooDeepForTheMesh) {
  const double h = 0.1;
  WearingSurface surface(test::jittered_plate(2.0, 2.0, h, 0.0));
  const Index element = surface.mesh().triangle_count() / 2;
  const Index vertex = surface.mesh().triangles[at(element)][0];
  // A third of the star; altitude of the triangles: h / sqrt 2.
  const double star = h * h / 6.0 * static_cast<double>(surface.stars()[vertex].size());
  surface.deposit(element, 1e-3 * h * star, 1e-3 * h * star, 0.0, 0.0);
  surface.deform_conserving();
  EXPECT_EQ(surface.guards().deep_steps, 0U);
  surface.deposit(element, 0.2 * h * star, 0.2 * h * star, 0.0, 0.0);
  surface.deform_conserving();
  EXPECT_EQ(surface.guards().deep_steps, 1U);
  EXPECT_EQ(surface.guards().fatal_steps, 0U);
  surface.deposit(element, 2.0 * h * star, 2.0 * h * star, 0.0, 0.0);
  surface.deform_conserving();
  EXPECT_EQ(surface.guards().fatal_steps, 1U);
  EXPECT_EQ(surface.guards().worst_vertex, surface.mesh().triangles[at(element)][0]);
}

TEST(WearingSurface, CountsWhatIsNoNumberAsTooDeep) {
  WearingSurface surface(test::jittered_plate(4e-3, 4e-3, 1e-3, 0.2));
  surface.deposit(0, 3e-15, 1e-15, 1e-15, 1e-15);
  surface.deposit_at_vertex(surface.mesh().triangles[0][1], std::numeric_limits<double>::quiet_NaN());
  surface.deform_conserving();
  EXPECT_GE(surface.guards().fatal_steps, 1U);
  EXPECT_GE(surface.guards().worst_vertex, 0);
}

TEST(WearingSurface, CountsTrianglesThatTurnOver) {
  // A thin blade worn through: its vertices pass the opposite side.
  WearingSurface surface(test::sphere_mesh(1.0, 1));
  EXPECT_EQ(surface.guards().flipped, 0U);
  surface.deposit_element(0, 1.0);
  surface.deform_paper();
  surface.check_orientation();
  EXPECT_GT(surface.guards().flipped, 0U);
}

TEST(WearingSurface, RefusesMeshesWithoutArea) {
  EXPECT_THROW(WearingSurface(TriangleMesh{}), GeometryError);
  TriangleMesh sliver;
  sliver.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  sliver.triangles = {{0, 1, 2}};
  EXPECT_THROW(WearingSurface{sliver}, GeometryError);
}

}  // namespace
}  // namespace abradem::wear
