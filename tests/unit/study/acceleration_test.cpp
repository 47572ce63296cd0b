// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/study/acceleration.h"

#include <gtest/gtest.h>

#include "abradem/core/error.h"
#include "abradem/study/trial.h"
#include "support/cases.h"

namespace abradem::test {
namespace {

using study::AccelerationChoice;

/// A short straight track rubbed to and fro: cheap, and with a groove that depends on its passes.
simulation::Setup rubbing(int cycles, double wear_in_all) {
  PinOnPlate pin;
  pin.passes = 2 * cycles;
  pin.wear_per_pass = wear_in_all / pin.passes;
  pin.amplitude = 0.6e-3;
  pin.size = 0.1e-3;
  simulation::Setup s = pin.setup();
  s.output.contours = 60;
  return s;
}

constexpr double kWear = 8.17e-10;  // [1/Pa] in all: of the laboratory test

double profile_error(const simulation::Setup& a, const simulation::Setup& b) {
  const auto profile = [](const simulation::Setup& s) {
    return study::mean_profile(study::run_trial(s).contours, 1e-5);
  };
  return study::profile_distance(profile(a), profile(b));
}

TEST(Acceleration, IsTheSameAsMoreWearInFewerRevolutions) {
  simulation::Simulation scaled(study::accelerated(rubbing(24, kWear), 8.0));
  simulation::Simulation few(rubbing(3, kWear));
  while (!scaled.finished()) scaled.advance();
  while (!few.finished()) few.advance();
  EXPECT_EQ(scaled.steps(), few.steps());
  EXPECT_NEAR(scaled.law_volume() / few.law_volume(), 1.0, 1e-12);
  EXPECT_LT(scaled.ledger().residual, 1e-9);
}

TEST(Acceleration, CountsTheRevolutionsAndTheTimeOfTheTest) {
  simulation::Setup setup = study::accelerated(rubbing(24, kWear), 8.0);
  setup.output.every = {8.0, true};
  simulation::Simulation run(setup);
  EXPECT_TRUE(run.advance());
  EXPECT_NEAR(run.revolution(), 8.0, 1e-9);
  EXPECT_NEAR(run.test_time(), 8.0, 1e-9);  // cycles of 1 s
  EXPECT_NEAR(run.time(), 1.0, 1e-9);
  while (!run.finished()) run.advance();
  EXPECT_NEAR(run.revolution(), 24.0, 1e-9);
}

TEST(Acceleration, PutsOutputsOnWholeModelledRevolutions) {
  simulation::Setup setup = study::accelerated(rubbing(24, kWear), 8.0);
  setup.output.every = {1.0, true};
  simulation::Simulation run(setup);
  EXPECT_TRUE(run.advance());
  EXPECT_NEAR(run.time(), 1.0, 1e-9);
}

TEST(Acceleration, ChosenKeepsToItsTolerance) {
  simulation::Setup setup = rubbing(96, kWear);
  setup.wear[0].acceleration = {1.0, true};
  setup.wear[0].tolerance = 0.01;
  std::size_t told = 0;
  const AccelerationChoice choice = study::choose_acceleration(
      setup, simulation::generate_mesh, {}, [&](const study::AccelerationTrial&) { ++told; });
  ASSERT_GT(choice.factor, 1.0);
  EXPECT_DOUBLE_EQ(choice.factor * choice.revolutions, 96.0);
  EXPECT_EQ(choice.trials.size(), told);
  EXPECT_LT(choice.error, 0.01);
  const double error =
      profile_error(study::accelerated(setup, choice.factor), study::accelerated(setup, 1.0));
  measured("acceleration chosen for 1 %: profile against the whole test", error, 0.01);
  EXPECT_LT(error, 0.01);
}

TEST(Acceleration, StricterToleranceTakesMoreRevolutions) {
  simulation::Setup setup = rubbing(96, kWear);
  const auto revolutions = [&](double tolerance) {
    setup.wear[0].acceleration = {1.0, true};
    setup.wear[0].tolerance = tolerance;
    return study::choose_acceleration(setup).revolutions;
  };
  const double loose = revolutions(0.05), strict = revolutions(0.0001);
  EXPECT_GT(strict, loose);
  EXPECT_EQ(revolutions(1e-9), 96.0);
}

TEST(Acceleration, OfFewRevolutionsIsNone) {
  simulation::Setup setup = rubbing(8, kWear);
  setup.wear[0].acceleration = {1.0, true};
  const AccelerationChoice choice = study::choose_acceleration(setup);
  EXPECT_EQ(choice.factor, 1.0);
  EXPECT_EQ(choice.error, 0.0);
  EXPECT_TRUE(choice.trials.empty());
}

TEST(Acceleration, ThatCannotBeIsRefused) {
  simulation::Setup setup = rubbing(24, kWear);
  EXPECT_THROW((void)study::choose_acceleration(setup), InputError);  // nobody asks
  setup.wear[0].acceleration = {1.0, true};
  EXPECT_THROW(simulation::Simulation{setup}, InputError);
  EXPECT_THROW(simulation::Simulation{study::accelerated(setup, 0.5)}, InputError);
  EXPECT_THROW((void)study::choose_acceleration(setup, simulation::generate_mesh, [] { return false; }),
               Interrupted);
  setup.walls[0].deformation = simulation::DeformationRule::none;
  EXPECT_THROW((void)study::choose_acceleration(setup), InputError);
}

}  // namespace
}  // namespace abradem::test
