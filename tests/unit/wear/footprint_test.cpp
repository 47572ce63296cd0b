// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/wear/footprint.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "abradem/contact/patch.h"
#include "abradem/geometry/closest_point.h"
#include "support/surfaces.h"

namespace abradem::wear {
namespace {

constexpr double R = 3e-3;
const contact::PairProperties kPair{
    .E_eff = 2.6285e8, .G_eff = 5.675e7, .beta = 0.28, .static_friction = 0.5, .rolling_friction = 0.0};

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// Zeroth, first (x, y) and second (x^2 + y^2) moments of a distribution.
struct Moments {
  double zero = 0.0, x = 0.0, y = 0.0, second = 0.0;
};

struct Pressed {
  test::Scene scene;
  contact::PatchEvaluator patches;
  Vec3 c;
  double deepest = 0.0;

  Pressed(test::TriangleMesh mesh, const Vec3& centre) : scene(std::move(mesh)), c(centre) {
    const auto found = patches.evaluate(scene.candidates_at(c, 1.02 * R), c, R, kPair);
    deepest = found.front().deepest;
  }
  [[nodiscard]] OverlapField field() const { return {patches.node_excess(), R, deepest, {}, {}, c}; }
  /// From the loads of nodes, or the parts at the vertices of triangles; related to the total.
  [[nodiscard]] Moments moments(const FootprintShares& s) const {
    const contact::MeshCandidates& m = scene.candidates;
    Moments sum;
    const auto add = [&](double load, std::size_t node) {
      const Vec3 p = m.node_position(node) - c;
      sum.zero += load / s.total;
      sum.x += load / s.total * p.x;
      sum.y += load / s.total * p.y;
      sum.second += load / s.total * (p.x * p.x + p.y * p.y);
    };
    if (s.nodal) {
      for (std::size_t i = 0; i < s.at_node.size(); ++i) add(s.at_node[i], i);
    } else {
      for (std::size_t t = 0; t < s.count; ++t) {
        add(s.at0[t], at(m.v0[t]));
        add(s.at1[t], at(m.v1[t]));
        add(s.at2[t], at(m.v2[t]));
      }
    }
    return sum;
  }
};

/// The same by fine quadrature over each triangle; linear functions of the corners, as the deposit has them.
Moments by_quadrature(const Pressed& p, const std::function<double(double g)>& weight,
                      std::vector<double>* share = nullptr) {
  const contact::MeshCandidates& m = p.scene.candidates;
  const int n = m.triangle_count() > 1000 ? 16 : 60;
  Moments sum;
  if (share != nullptr) share->assign(m.triangle_count(), 0.0);
  for (std::size_t t = 0; t < m.triangle_count(); ++t) {
    const Vec3 a = m.node_position(at(m.v0[t])) - p.c, b = m.node_position(at(m.v1[t])) - p.c,
               d = m.node_position(at(m.v2[t])) - p.c;
    const auto corner_mean = [&](double u, double v, auto&& f) {
      return (1 - u - v) * f(a) + u * f(b) + v * f(d);
    };
    const auto add = [&](double u, double v) {
      const double w = weight(R - norm(a + u * (b - a) + v * (d - a))) * m.area[t] / (n * n);
      sum.zero += w;
      sum.x += w * corner_mean(u, v, [](const Vec3& q) { return q.x; });
      sum.y += w * corner_mean(u, v, [](const Vec3& q) { return q.y; });
      sum.second += w * corner_mean(u, v, [](const Vec3& q) { return q.x * q.x + q.y * q.y; });
      if (share != nullptr) (*share)[t] += w;
    };
    for (int i = 0; i < n; ++i)
      for (int j = 0; i + j < n; ++j) {
        add((i + 1.0 / 3) / n, (j + 1.0 / 3) / n);
        if (i + j + 1 < n) add((i + 2.0 / 3) / n, (j + 2.0 / 3) / n);
      }
  }
  sum.x /= sum.zero, sum.y /= sum.zero, sum.second /= sum.zero;
  if (share != nullptr)
    for (double& s : *share) s /= sum.zero;
  return sum;
}

struct Case {
  double h, delta;
};

class Footprints : public testing::TestWithParam<Case> {
 protected:
  static test::TriangleMesh mesh(double h, double noise) {
    auto plate = test::jittered_plate(std::max(1.6e-3, 4.0 * h), std::max(1.6e-3, 4.0 * h), h, 0.25, 6);
    if (noise > 0.0) test::roughen(plate, noise, 2);
    return plate;
  }
};

TEST_P(Footprints, LoadsAreNotNegativeAndSumToTheTotal) {
  const auto [h, delta] = GetParam();
  for (const double noise : {0.0, 0.03 * delta})
    for (const bool by_elements : {false, true})
      for (const bool hertz : {true, false}) {
        const Pressed p(mesh(h, noise), {0.13 * h, -0.21 * h, R - delta});
        FootprintIntegrator footprint;
        const auto& s = hertz ? footprint.hertz(p.scene.candidates, p.field(), delta, by_elements)
                              : footprint.overlap(p.scene.candidates, p.field(), by_elements);
        ASSERT_GT(s.total, 0.0);
        EXPECT_TRUE(!s.nodal || !by_elements);
        EXPECT_NEAR(p.moments(s).zero, 1.0, 1e-13);
        for (const auto& loads : {s.at_node, s.at0, s.at1, s.at2})
          for (const double load : loads) EXPECT_GE(load, 0.0);
      }
}

TEST_P(Footprints, MomentsEqualFineQuadrature) {
  const auto [h, delta] = GetParam();
  const Pressed p(mesh(h, 0.0), {0.13 * h, -0.21 * h, R - delta});
  FootprintIntegrator footprint;
  // Lengths against the radius of the footprint, or of the mesh where that is coarser: what the nodes
  // resolve.
  for (const bool hertz : {true, false}) {
    const double d_e = delta;
    const auto weight = [&](double g) {
      return hertz ? std::sqrt(std::max(0.0, d_e - 2.0 * (p.deepest - g))) : std::max(0.0, g);
    };
    std::vector<double> share;
    const Moments exact = by_quadrature(p, weight, &share);
    for (const bool by_elements : {false, true}) {
      const auto& s = hertz ? footprint.hertz(p.scene.candidates, p.field(), d_e, by_elements)
                            : footprint.overlap(p.scene.candidates, p.field(), by_elements);
      const Moments mine = p.moments(s);
      const double reach = std::sqrt((hertz ? 1.0 : 2.0) * R * delta), scale = std::max(reach, h);
      EXPECT_NEAR(mine.x, exact.x, 0.01 * scale);
      EXPECT_NEAR(mine.y, exact.y, 0.01 * scale);
      EXPECT_NEAR(mine.second, exact.second, 0.02 * scale * scale);
      if (s.nodal) continue;
      // Triangle by triangle, against the largest share.
      double largest = 0.0, worst = 0.0;
      for (const double x : share) largest = std::max(largest, x);
      for (std::size_t t = 0; t < s.count; ++t)
        worst = std::max(worst, std::abs((s.at0[t] + s.at1[t] + s.at2[t]) / s.total - share[t]));
      EXPECT_LT(worst, 0.12 * largest);
    }
  }
}

TEST_P(Footprints, HertzDoesNotDependOnTheHeightOfTheBall) {
  const auto [h, delta] = GetParam();
  const auto plate = mesh(h, 0.0);
  const Pressed deep(plate, {0.0, 0.0, R - delta}), shallow(plate, {0.0, 0.0, R - 0.7 * delta});
  FootprintIntegrator a, b;
  const Moments p = deep.moments(a.hertz(deep.scene.candidates, deep.field(), delta, false));
  const Moments q = shallow.moments(b.hertz(shallow.scene.candidates, shallow.field(), delta, false));
  // Raising the ball by u changes the differences of depth by u / R only.
  EXPECT_NEAR(p.second / q.second, 1.0, 0.01);
}

INSTANTIATE_TEST_SUITE_P(FineToCoarse, Footprints,
                         testing::Values(Case{0.05e-3, 40.8e-6}, Case{0.1e-3, 40.8e-6}, Case{0.2e-3, 40.8e-6},
                                         Case{0.5e-3, 40.8e-6}, Case{2e-3, 40.8e-6}, Case{0.1e-3, 1.1e-6},
                                         Case{0.025e-3, 1.1e-6}));

TEST(Footprint, OfAPlaneHasTheMomentsOfHertz) {
  // int sqrt(1 - r^2/a^2): <r^2> = 2/5 a^2; of a bed of springs, int (1 - r^2/b^2): <r^2> = b^2 / 3, b^2 = 2
  // R delta.
  const double delta = 40.8e-6;
  const Pressed p(test::jittered_plate(1.6e-3, 1.6e-3, 0.02e-3, 0.2), {0.0, 0.0, R - delta});
  FootprintIntegrator footprint;
  EXPECT_NEAR(
      p.moments(footprint.hertz(p.scene.candidates, p.field(), delta, false)).second / (0.4 * R * delta), 1.0,
      0.01);
  EXPECT_NEAR(
      p.moments(footprint.overlap(p.scene.candidates, p.field(), false)).second / (2.0 / 3.0 * R * delta),
      1.0, 0.01);
}

TEST(Footprint, KeepsToTheMaskedTriangles) {
  const Pressed p(test::jittered_plate(1.6e-3, 1.6e-3, 0.1e-3, 0.2), {0.0, 0.0, R - 40e-6});
  std::vector<char> mask(p.scene.candidates.triangle_count());
  for (std::size_t t = 0; t < mask.size(); ++t)
    mask[t] = p.scene.candidates.x[at(p.scene.candidates.v0[t])] > 0.0;
  FootprintIntegrator footprint;
  const auto& s = footprint.hertz(p.scene.candidates, p.field(), 40e-6, false, mask);
  ASSERT_FALSE(s.nodal);
  double sum = 0.0;
  for (std::size_t t = 0; t < s.count; ++t) {
    const double load = s.at0[t] + s.at1[t] + s.at2[t];
    EXPECT_TRUE(load == 0.0 || mask[t] != 0);
    sum += load;
  }
  EXPECT_NEAR(sum / s.total, 1.0, 1e-13);
}

TEST(Footprint, SpotFinerThanTheSamplingFallsWhereItLies) {
  // A contact radius of 1 um in triangles of 1 mm.
  const double delta = 1e-6 * 1e-6 / R;
  const Pressed p(test::jittered_plate(4e-3, 4e-3, 1e-3, 0.2), {0.31e-3, 0.12e-3, R - delta});
  FootprintIntegrator footprint;
  const auto& s = footprint.hertz(p.scene.candidates, p.field(), delta, false);
  ASSERT_FALSE(s.nodal);
  std::vector<std::size_t> loaded;
  for (std::size_t t = 0; t < s.count; ++t)
    if (s.at0[t] > 0.0) loaded.push_back(t);
  ASSERT_EQ(loaded.size(), 1U);
  const std::size_t t = loaded[0];
  const auto hit =
      geometry::closest_point_on_triangle(p.c, p.scene.candidates.node_position(at(p.scene.candidates.v0[t])),
                                          p.scene.candidates.node_position(at(p.scene.candidates.v1[t])),
                                          p.scene.candidates.node_position(at(p.scene.candidates.v2[t])));
  EXPECT_EQ(hit.feature, geometry::Feature::face);
}

TEST(Footprint, OfAnyForceAsksForACountableNumberOfPoints) {
  // A state that has lost its sense, until it is noticed: d_e of nothing, of everything, of no number.
  const Pressed p(test::jittered_plate(4e-3, 4e-3, 1e-3, 0.2), {0.31e-3, 0.12e-3, 0.999 * R});
  FootprintIntegrator footprint;
  for (const double d_e :
       {0.0, 5e-324, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    for (const bool by_elements : {false, true}) {
      const auto& s = footprint.hertz(p.scene.candidates, p.field(), d_e, by_elements);
      EXPECT_LE(s.count, p.scene.candidates.triangle_count()) << d_e;
      EXPECT_FALSE(s.total < 0.0) << d_e;
    }
}

}  // namespace
}  // namespace abradem::wear
