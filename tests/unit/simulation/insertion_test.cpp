// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/simulation/insertion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "abradem/core/error.h"

namespace abradem::simulation {
namespace {

InsertionSetup thousand_in_a_box() {
  InsertionSetup i;
  i.name = "feed";
  i.size.radius = 3e-3;
  i.volume.high = {0.1, 0.1, 0.1};
  i.number = 1000;
  return i;
}

double smallest_gap(const std::vector<contact::SphereRow>& spheres) {
  double gap = 1.0;
  for (std::size_t i = 0; i < spheres.size(); ++i)
    for (std::size_t j = i + 1; j < spheres.size(); ++j)
      gap = std::min(
          gap, norm(spheres[i].position() - spheres[j].position()) - spheres[i].radius - spheres[j].radius);
  return gap;
}

TEST(Inserter, PlacesAllInsideTheBoxWithoutOverlaps) {
  InsertionSetup setup = thousand_in_a_box();
  setup.size.kind = SizeKind::uniform;
  setup.size.low = 2e-3, setup.size.high = 4e-3;
  const auto spheres = Inserter(setup, 0, 2500.0, 1, 1).insert(0.0, {});
  ASSERT_EQ(spheres.size(), 1000u);
  EXPECT_GE(smallest_gap(spheres), 0.0);
  for (const contact::SphereRow& s : spheres)
    for (const double x : {s.x, s.y, s.z}) {
      EXPECT_GE(x, s.radius);
      EXPECT_LE(x, 0.1 - s.radius);
    }
}

TEST(Inserter, PlacesInsideATiltedCylinderAndBesideWhatIsThere) {
  InsertionSetup setup = thousand_in_a_box();
  setup.volume.shape = VolumeShape::cylinder;
  setup.volume.base = {0.1, 0.0, 0.0}, setup.volume.top = {0.2, 0.1, 0.1}, setup.volume.radius = 0.04;
  setup.number = 400;
  Inserter inserter(setup, 0, 2500.0, 1, 1);
  contact::Spheres present;
  contact::SphereRow boulder;
  boulder.set_position({0.15, 0.05, 0.05});
  boulder.radius = 0.025;
  present.row.push_back(boulder);
  present.id.push_back(0);
  auto spheres = inserter.insert(0.0, present);
  ASSERT_EQ(spheres.size(), 400u);
  const Vec3 axis = normalized(setup.volume.top - setup.volume.base);
  for (const contact::SphereRow& s : spheres) {
    const Vec3 p = s.position() - setup.volume.base;
    const double along = dot(p, axis);
    EXPECT_LE(norm(p - along * axis), 0.04 - 3e-3 + 1e-12);
    EXPECT_GE(along, 3e-3 - 1e-12);
    EXPECT_LE(along, norm(setup.volume.top - setup.volume.base) - 3e-3 + 1e-12);
  }
  spheres.push_back(boulder);
  EXPECT_GE(smallest_gap(spheres), 0.0);
}

/// Sizes of a table are not known before it is read.
TEST(Inserter, SaysWhenOneOfATableDoesNotFit) {
  InsertionSetup setup = thousand_in_a_box();
  setup.size.kind = SizeKind::table;
  setup.size.radii = {1e-3, 60e-3};
  setup.size.shares = {1.0, 1.0};
  try {
    static_cast<void>(Inserter(setup, 0, 2500.0, 1, 1));
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("too small for one sphere of 60 mm radius"), std::string::npos);
  }
}

TEST(Inserter, LeavesOutWhereWallsStand) {
  const InsertionSetup setup = thousand_in_a_box();
  Inserter inserter(setup, 0, 2500.0, 1, 1);
  const auto right = [](const Vec3& c, double R) { return c.x - R > 0.05; };
  const auto spheres = inserter.insert(0.0, {}, {}, right);
  ASSERT_EQ(spheres.size(), 1000u);
  for (const contact::SphereRow& s : spheres) EXPECT_TRUE(right(s.position(), s.radius));
  EXPECT_THROW(static_cast<void>(Inserter(thousand_in_a_box(), 0, 2500.0, 1, 1)
                                     .insert(0.0, {}, {}, [](const Vec3&, double) { return false; })),
               InputError);
}

TEST(Inserter, SaysHowFarItCameWhenTheVolumeIsFull) {
  InsertionSetup setup = thousand_in_a_box();
  setup.number = 4000;
  try {
    static_cast<void>(Inserter(setup, 0, 2500.0, 1, 1).insert(0.0, {}));
    FAIL() << "4000 spheres fill 45 % of the box";
  } catch (const InputError& e) {
    const std::string text = e.what();
    EXPECT_NE(text.find("insertion 'feed': its volume is full after 2"), std::string::npos) << text;
    EXPECT_NE(text.find("of the 4000"), std::string::npos) << text;
  }
}

TEST(Inserter, KeepsToItsRateAndItsMass) {
  InsertionSetup setup = thousand_in_a_box();
  setup.number = 0;
  setup.mass = 0.05;
  setup.mass_rate = 0.5;
  setup.start = 0.2;
  Inserter inserter(setup, 0, 2500.0, 1, 1);
  EXPECT_FALSE(inserter.wants(0.1));
  const double one = 2500.0 * 4.0 / 3.0 * std::numbers::pi * 27e-9;
  for (double t = 0.0; t < 0.5; t += 1e-3) {
    if (inserter.wants(t)) static_cast<void>(inserter.insert(t, {}));
    const double wanted = std::clamp(0.5 * (t - 0.2), 0.0, 0.05);
    EXPECT_NEAR(inserter.inserted_mass(), wanted, 2.0 * one) << t;
  }
  EXPECT_NEAR(inserter.inserted_mass(), 0.05, 0.5 * one);
}

ClumpShape dumbbell() {
  return clump_shape({"dumbbell", {{{-1e-3, 0, 0}, 1.5e-3}, {{1e-3, 0, 0}, 1.5e-3}}, {}});
}

TEST(Inserter, PlacesClumpsAtEveryTurnInsideTheBoxWithoutOverlaps) {
  InsertionSetup setup = thousand_in_a_box();
  setup.size.kind = SizeKind::uniform;
  setup.size.low = 1.5e-3, setup.size.high = 3e-3;
  const ClumpShape shape = dumbbell();
  Inserter inserter(setup, 0, 2500.0, 1, 1, &shape);
  EXPECT_NEAR(inserter.smallest_sphere(), 1.5e-3 * 1.5e-3 / shape.radius, 1e-15);
  contact::Spheres present;
  contact::SphereRow boulder;
  boulder.set_position({0.05, 0.05, 0.05});
  boulder.radius = 0.02;
  present.row.push_back(boulder);
  present.id.push_back(0);
  const auto clumps = inserter.insert_clumps(0.0, present);
  ASSERT_EQ(clumps.size(), 1000u);
  double gap = 1.0, across = 0.0;
  const auto sphere = [&](const Clumps::Birth& b, std::size_t k) {
    return geometry::Ball{b.position + b.turn.turn(b.radius * shape.spheres[k].centre),
                          b.radius * shape.spheres[k].radius};
  };
  for (std::size_t i = 0; i < clumps.size(); ++i) {
    across += std::abs(clumps[i].turn.turn({1, 0, 0}).z) / 1000.0;
    for (std::size_t k = 0; k < 2; ++k) {
      const geometry::Ball a = sphere(clumps[i], k);
      for (const double x : {a.centre.x, a.centre.y, a.centre.z}) {
        EXPECT_GE(x, a.radius);
        EXPECT_LE(x, 0.1 - a.radius);
      }
      gap = std::min(gap, norm(a.centre - boulder.position()) - a.radius - boulder.radius);
      for (std::size_t j = i + 1; j < clumps.size(); ++j)
        for (std::size_t m = 0; m < 2; ++m) {
          const geometry::Ball b = sphere(clumps[j], m);
          gap = std::min(gap, norm(a.centre - b.centre) - a.radius - b.radius);
        }
    }
  }
  EXPECT_GE(gap, 0.0);
  EXPECT_NEAR(across, 0.5, 0.037);  // four standard errors, 0.29 / sqrt(1000)
  // The turns have a stream of their own: spheres of the same insertion have the same sizes.
  const auto spheres = Inserter(setup, 0, 2500.0, 1, 1).insert(0.0, {});
  EXPECT_EQ(spheres[0].radius, clumps[0].radius);
}

TEST(Inserter, SaysWhenAShapeDoesNotFitOrItsVolumeIsFull) {
  const ClumpShape shape = dumbbell();
  InsertionSetup setup = thousand_in_a_box();
  const auto refusal = [&] {
    try {
      static_cast<void>(Inserter(setup, 0, 2500.0, 1, 1, &shape).insert_clumps(0.0, {}));
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string("accepted");
  };
  setup.number = 4000;
  EXPECT_NE(refusal().find("insertion 'feed': its volume is full after "), std::string::npos) << refusal();
  setup.number = 1;
  setup.volume.high = {0.1, 0.1, 7e-3};  // a sphere of 3 mm goes in, the dumbbell is 8 mm long
  EXPECT_NE(refusal().find("too small for one 'dumbbell'"), std::string::npos) << refusal();
  setup.volume.high = {0.1, 0.1, 9e-3};
  EXPECT_EQ(refusal(), "accepted");
}

TEST(ClumpShape, IsCentredInItsPrincipalAxes) {
  const ClumpShape row = clump_shape({"row", {{{5, 5, 5}, 1}, {{5, 7, 5}, 1}, {{5, 9, 5}, 1}}, {}});
  const double unit = std::cbrt(3.0);
  EXPECT_NEAR(row.radius, unit, 1e-12);
  EXPECT_NEAR(norm(row.spheres[1].centre), 0.0, 1e-12);
  EXPECT_NEAR(std::abs(row.spheres[0].centre.x), 2.0 / unit, 1e-12);
  EXPECT_NEAR(row.bounding, 3.0 / unit, 1e-12);
  const double m = 4.0 / 3.0 * std::numbers::pi / std::pow(unit, 5.0);
  EXPECT_NEAR(row.inertia.x, 3 * 0.4 * m, 1e-11);
  EXPECT_NEAR(row.inertia.z, 3 * 0.4 * m + 8.0 * m, 1e-11);
  EXPECT_THROW(static_cast<void>(clump_shape({"none", {}, {}})), InputError);
  EXPECT_THROW(static_cast<void>(clump_shape({"point", {{{}, 0.0}}, {}})), InputError);
}

TEST(DrawRadius, HasTheMeanAndTheSpreadAsked) {
  core::RandomStream random(3);
  const auto moments = [&](const SizeSetup& size) {
    constexpr int n = 40000;
    double sum = 0.0, sum2 = 0.0;
    for (int k = 0; k < n; ++k) {
      const double R = draw_radius(size, random);
      sum += R, sum2 += R * R;
    }
    return std::pair(sum / n, std::sqrt(sum2 / n - sum / n * sum / n));
  };
  // Standard errors: sd / 200 of the mean, about sd / 280 of the sd; four of them are allowed.
  for (const SizeKind kind : {SizeKind::normal, SizeKind::lognormal}) {
    const auto [mean, sd] = moments({kind, 0.0, 1e-3, 5e-3, 3e-3, 0.3e-3, {}, {}, {}});
    EXPECT_NEAR(mean, 3e-3, 0.02 * 0.3e-3);
    EXPECT_NEAR(sd, 0.3e-3, 0.02 * 0.3e-3);
  }
  const auto [mean, sd] = moments({SizeKind::uniform, 0.0, 2e-3, 4e-3, 0.0, 0.0, {}, {}, {}});
  EXPECT_NEAR(mean, 3e-3, 0.02 * sd);
  EXPECT_NEAR(sd, 2e-3 / std::sqrt(12.0), 0.01 * sd);
  const auto [of_table, spread] =
      moments({SizeKind::table, 0.0, 0.0, 0.0, 0.0, 0.0, {}, {1e-3, 5e-3}, {3.0, 1.0}});
  EXPECT_NEAR(of_table, 2e-3, 0.02 * spread);
}

}  // namespace
}  // namespace abradem::simulation
