// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/study/trial.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "abradem/analysis/wall_contours.h"
#include "abradem/core/error.h"
#include "support/cases.h"

namespace abradem::study {
namespace {

using analysis::Contour;
using analysis::ProfilePoint;
using Profile = std::vector<ProfilePoint>;

/// A short run on a narrow ring.
test::PinOnDisc small_case() {
  test::PinOnDisc pin;
  pin.track = 6e-3;
  pin.half_band = 0.9e-3;
  pin.size = 0.2e-3;
  pin.revolutions = 0.3;
  return pin;
}

simulation::Setup small_setup() {
  simulation::Setup s = small_case().setup();
  s.output.every = {0.1, true};
  s.output.contours = 90;
  return s;
}

TEST(Trial, TakesTheSameStepsAsARun) {
  const simulation::Setup setup = small_setup();
  const Outcome outcome = run_trial(setup);

  simulation::Simulation run(setup);
  simulation::Ledger ledger;
  while (!run.finished())
    if (run.advance()) ledger = run.ledger();
  EXPECT_EQ(outcome.steps, run.total_steps());
  EXPECT_EQ(outcome.volumes.law, ledger.law);
  EXPECT_EQ(outcome.volumes.swept, ledger.swept);
  EXPECT_EQ(outcome.volumes.paper, ledger.paper);
  EXPECT_EQ(outcome.ledger.residual, ledger.residual);
  EXPECT_NEAR(outcome.revolutions, 0.3, 1e-12);

  const auto contours = analysis::wall_contours(run.walls()[0], 90);
  ASSERT_EQ(outcome.contours.size(), contours.size());
  double deepest = 0.0;
  for (std::size_t i = 0; i < contours.size(); ++i) {
    EXPECT_EQ(outcome.contours[i].depth, contours[i].depth);
    EXPECT_EQ(outcome.contours[i].profile, contours[i].profile);
    deepest = std::max(deepest, contours[i].depth);
  }
  EXPECT_EQ(outcome.depth.max, deepest);
  EXPECT_EQ(outcome.width.count, 90);
  EXPECT_TRUE(outcome.failure.empty());

  ASSERT_EQ(outcome.history.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(outcome.history[i].revolutions, 0.1 * static_cast<double>(i + 1), 1e-12);
  EXPECT_EQ(outcome.history.back().volumes.law, outcome.volumes.law);
  EXPECT_LT(outcome.history[0].volumes.law, outcome.history[1].volumes.law);
  EXPECT_TRUE(std::isnan(outcome.history[0].depth_mean));
  EXPECT_EQ(outcome.history.back().depth_mean, outcome.depth.mean);
}

TEST(Trial, CutsSectionsAfterEveryOutputWhenAsked) {
  const Outcome outcome = run_trial(small_setup(), simulation::generate_mesh, {.sections_in_history = true});
  ASSERT_EQ(outcome.history.size(), 3u);
  EXPECT_GT(outcome.history[0].depth_mean, 0.0);
  EXPECT_GT(outcome.history[1].width_mean, outcome.history[0].width_mean);
}

TEST(Trial, EndsWhereItHasShownEnough) {
  const auto two = [](const Milestone& m) { return m.revolutions > 0.15; };
  const Outcome outcome = run_trial(small_setup(), simulation::generate_mesh, {.enough = two});
  EXPECT_NEAR(outcome.revolutions, 0.2, 1e-12);
  ASSERT_EQ(outcome.history.size(), 2u);
  EXPECT_EQ(outcome.contours.size(), 90u);
  EXPECT_EQ(outcome.history.back().depth_mean, outcome.depth.mean);
}

TEST(Trial, IsInterruptedByItsWatcher) {
  int looks = 0;
  const auto stop = [&](const simulation::Simulation&) { return ++looks < 2; };
  EXPECT_THROW((void)run_trial(small_setup(), simulation::generate_mesh, {.watch = stop}), Interrupted);
  EXPECT_EQ(looks, 2);
}

TEST(Trial, KeepsOfAFailedRunWhatItHadAtItsLastOutput) {
  // The plate slides away under the pin, which is left without a wall after about 2 mm.
  simulation::Setup s = small_setup();
  s.walls[0].mesh.shape = simulation::MeshShape::plate;
  s.walls[0].mesh.length = 4e-3;
  s.walls[0].mesh.width = 1.8e-3;
  s.walls[0].motion = {};
  s.walls[0].motion.kind = simulation::MotionKind::translation;
  s.walls[0].motion.velocity = {1e-3, 0.0, 0.0};
  s.particles[0].position.x = 0.0;
  s.run.end = {5.0, false};
  s.output.every = {1.0, false};
  EXPECT_THROW((void)run_trial(s), SimulationError);
  const Outcome outcome = run_trial(s, simulation::generate_mesh, {.keep_failed = true});
  EXPECT_NE(outcome.failure.find("it has left the walls"), std::string::npos);
  ASSERT_FALSE(outcome.history.empty());
  EXPECT_LT(outcome.history.size(), 5u);
  EXPECT_EQ(outcome.volumes.law, outcome.history.back().volumes.law);
  // Archard on the millimetres up to then: 1 mm/s for 1 s each.
  EXPECT_NEAR(outcome.history[0].volumes.law / (6.81e-11 * 5.0 * 1e-3), 1.0, 0.01);
}

TEST(MeanProfile, AveragesOnACommonGrid) {
  // A triangle of depth 2 on [1, 3] and one of depth 4 on [2, 4], in steps of 0.5.
  std::vector<Contour> two(2);
  two[0].profile = {{1.0, 0.0}, {2.0, -2.0}, {3.0, 0.0}};
  two[1].profile = {{2.0, 0.0}, {3.0, -4.0}, {4.0, 0.0}};
  const Profile expected{{1.0, 0.0},  {1.5, -0.5}, {2.0, -1.0}, {2.5, -1.5},
                         {3.0, -2.0}, {3.5, -1.0}, {4.0, 0.0}};
  EXPECT_EQ(mean_profile(two, 0.5), expected);
}

TEST(MeanProfile, CountsASectionWithoutWearAsFlat) {
  std::vector<Contour> two(2);
  two[0].profile = {{1.0, 0.0}, {2.0, -2.0}, {3.0, 0.0}};
  const Profile expected{{1.0, 0.0}, {2.0, -1.0}, {3.0, 0.0}};
  EXPECT_EQ(mean_profile(two, 1.0), expected);
  EXPECT_TRUE(mean_profile(std::vector<Contour>(3), 1.0).empty());
  EXPECT_THROW((void)mean_profile(two, 0.0), InputError);
  EXPECT_THROW((void)mean_profile(two, 1e-12), InputError);
}

TEST(MeanProfile, ReachesBeyondTheEndsThatLieBetweenTwoGridPoints) {
  std::vector<Contour> one(1);
  one[0].profile = {{1.25, 0.0}, {1.75, -1.0}, {2.25, 0.0}};
  const Profile expected{{1.0, 0.0}, {1.5, -0.5}, {2.0, -0.5}, {2.5, 0.0}};
  EXPECT_EQ(mean_profile(one, 0.5), expected);
}

TEST(ProfileDistance, IsTheRelativeDifferenceInL2) {
  const Profile b{{0.0, 0.0}, {1.0, -1.0}, {2.0, 0.0}};
  const Profile higher{{0.0, 0.0}, {1.0, -1.1}, {2.0, 0.0}};
  EXPECT_NEAR(profile_distance(higher, b), 0.1, 1e-14);
  // The same polyline with more points.
  const Profile finer{{-1.0, 0.0}, {0.0, 0.0}, {0.25, -0.25}, {1.0, -1.0}, {1.5, -0.5}, {2.0, 0.0}};
  EXPECT_NEAR(profile_distance(finer, b), 0.0, 1e-14);
  // No common support: sqrt(1 + 1). Shifted by half its width: int b^2 = 2/3; the overlap of the squares by
  // int_0^1 (x - (1 - x))^2 dx = 1/3 and 1/3 on either side.
  const Profile away{{5.0, 0.0}, {6.0, -1.0}, {7.0, 0.0}};
  EXPECT_NEAR(profile_distance(away, b), std::sqrt(2.0), 1e-14);
  const Profile shifted{{1.0, 0.0}, {2.0, -1.0}, {3.0, 0.0}};
  EXPECT_NEAR(profile_distance(shifted, b), std::sqrt(1.5), 1e-14);
}

TEST(ProfileDistance, KnowsProfilesThatEndInAStep) {
  // -1 on [0, 1] and on [0, 2]: int (a - b)^2 = 1, int b^2 = 2.
  const Profile a{{0.0, -1.0}, {1.0, -1.0}}, b{{0.0, -1.0}, {2.0, -1.0}};
  EXPECT_NEAR(profile_distance(a, b), std::sqrt(0.5), 1e-14);
}

TEST(ProfileDistance, OfFlatSections) {
  const Profile flat{{0.0, 0.0}, {1.0, 0.0}}, worn{{0.0, 0.0}, {1.0, -1.0}};
  EXPECT_EQ(profile_distance(flat, flat), 0.0);
  EXPECT_EQ(profile_distance({}, flat), 0.0);
  EXPECT_TRUE(std::isinf(profile_distance(worn, flat)));
  EXPECT_EQ(profile_distance(flat, worn), 1.0);
}

}  // namespace
}  // namespace abradem::study
