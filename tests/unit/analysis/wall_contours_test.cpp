// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/analysis/wall_contours.h"

#include <gtest/gtest.h>

#include <numbers>

#include "abradem/core/error.h"
#include "support/cases.h"

namespace abradem::analysis {
namespace {

using simulation::Simulation;

Simulation worn(const simulation::Setup& setup) {
  Simulation run(setup);
  while (!run.finished()) run.step();
  return run;
}

TEST(WornWall, IsTheFirstThatDeforms) {
  test::PinOnDisc pin;
  pin.size = 0.4e-3;
  simulation::Setup s = pin.setup();
  EXPECT_EQ(worn_wall(Simulation(s).walls()), std::optional<std::size_t>(0));
  s.walls.insert(s.walls.begin(), s.walls[0]);
  s.walls[0].name = "still";
  s.walls[0].deformation = simulation::DeformationRule::none;
  EXPECT_EQ(worn_wall(Simulation(s).walls()), std::optional<std::size_t>(1));
  s.walls.pop_back();
  EXPECT_EQ(worn_wall(Simulation(s).walls()), std::nullopt);
}

TEST(WallContours, GoAroundTheAxisOfAWallThatTurns) {
  test::PinOnDisc pin;
  pin.track = 6e-3;
  pin.size = 0.2e-3;
  pin.revolutions = 0.25;
  simulation::Setup s = pin.setup();
  s.output.every = {0.25, true};
  const Simulation run = worn(s);
  const auto contours = wall_contours(run.walls()[0], 8);
  ASSERT_EQ(contours.size(), 8u);
  // The disc turns counterclockwise under a pin at angle 0, so the wear goes clockwise over its material,
  // from 0 to -90 degrees: the sections at 0, -45 and (but for the patch's end) -90.
  EXPECT_GT(contours[7].depth, 0.5e-6);
  EXPECT_DOUBLE_EQ(contours[7].angle, 7.0 * std::numbers::pi / 4.0);
  for (const std::size_t k : {2u, 3u, 4u}) EXPECT_EQ(contours[k].depth, 0.0);
}

TEST(WallContours, GoAcrossTheMotionOfAPlateThatOscillates) {
  test::PinOnPlate pin;
  pin.size = 0.1e-3;
  const Simulation run = worn(pin.setup());
  const auto contours = wall_contours(run.walls()[0], 12);
  ASSERT_EQ(contours.size(), 12u);
  for (std::size_t k = 0; k < 12; ++k)
    EXPECT_NEAR(contours[k].angle, 2.0 * std::numbers::pi * (static_cast<double>(k) + 0.5) / 12.0, 1e-9);
  EXPECT_GT(contours[6].depth, 1e-6);
  EXPECT_GT(contours[6].width, 0.3e-3);
}

TEST(WallContours, AreNoneWhereNothingSaysHowToLayThem) {
  test::PinOnPlate pin;
  pin.size = 0.2e-3;
  const Simulation fresh(pin.setup());
  EXPECT_TRUE(wall_contours(fresh.walls()[0], 12).empty());

  test::PinOnDisc on_plane;
  simulation::Setup s = on_plane.setup();
  s.walls[0].mesh = {};
  s.walls[0].mesh.shape = simulation::MeshShape::plane;
  s.walls[0].deformation = simulation::DeformationRule::none;
  const Simulation run(s);
  EXPECT_THROW((void)wall_contours(run.walls()[0], 12), InputError);
}

}  // namespace
}  // namespace abradem::analysis
