// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/study/acceleration.h"

#include <gtest/gtest.h>

#include "abradem/core/error.h"
#include "abradem/study/trial.h"
#include "support/cases.h"
#include "support/grains.h"
#include "support/says.h"
#include "support/state.h"

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
  const AccelerationChoice choice =
      study::choose_acceleration(setup, simulation::generate_mesh, {},
                                 [&](const study::AccelerationTrial&, const AccelerationChoice&) { ++told; });
  ASSERT_GT(choice.factor, 1.0);
  EXPECT_DOUBLE_EQ(choice.factor * choice.modelled, 96.0);
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
    return study::choose_acceleration(setup).modelled;
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
  EXPECT_THROW((void)study::choose_acceleration(setup, simulation::generate_mesh,
                                                [](const simulation::Simulation&) { return false; }),
               Interrupted);
  setup.walls[0].deformation = simulation::DeformationRule::none;
  EXPECT_THROW((void)study::choose_acceleration(setup), InputError);
}

/// A tenth of a second to settle, eight tenths of wear.
simulation::Setup stream_to_accelerate() {
  simulation::Setup setup = stream_on_plate(0.1, 0.8);
  setup.wear[0].acceleration.automatic = true;
  setup.output.every = {0.1, false};
  return setup;
}

template <typename F>
std::string refusal(const F& refused) {
  try {
    refused();
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing was refused";
}

TEST(Settling, WearsNothingAndIsNotAccelerated) {
  simulation::Setup setup = study::accelerated(stream_to_accelerate(), 16.0);
  setup.run.end = {0.1 + 16.0 * 0.05, false};
  setup.output.every = {0.4, false};
  simulation::Simulation run(setup);
  EXPECT_TRUE(run.settling());
  EXPECT_TRUE(run.advance());  // one output where it ends, although 0.4 s are not over
  EXPECT_FALSE(run.settling());
  EXPECT_GT(run.bulk_state().wall_contacts, 0u);
  EXPECT_EQ(run.test_time(), 0.1);
  EXPECT_NEAR(run.time(), 0.1, run.time_step());
  EXPECT_EQ(run.output_intervals(), 1.0);
  EXPECT_EQ(run.law_volume(), 0.0);
  EXPECT_EQ(run.walls()[0].surface().deposited_volume(), 0.0);
  ASSERT_NE(run.map_of(0), nullptr);
  for (std::size_t t = 0; t < run.map_of(0)->element_count(); ++t)
    EXPECT_FALSE(run.map_of(0)->total(t).touched());
  EXPECT_TRUE(run.map_of(0)->layers()[0].regions[0].sliding.entries().empty());
  EXPECT_TRUE(run.advance());
  EXPECT_NEAR(run.test_time(), 0.5, 1e-9);
  EXPECT_NEAR(run.time(), 0.125, run.time_step());
  EXPECT_EQ(run.output_intervals(), 2.0);
  EXPECT_TRUE(run.advance());
  EXPECT_TRUE(run.finished());
  EXPECT_NEAR(run.test_time(), 0.9, 1e-9);
  EXPECT_EQ(run.output_intervals(), 3.0);
  EXPECT_GT(run.law_volume(), 0.0);
}

TEST(Settling, HasItsOwnOutputs) {
  simulation::Setup setup = study::accelerated(stream_to_accelerate(), 1.0);
  setup.run.end = {0.15, false};
  setup.output.every = {0.04, false};
  simulation::Simulation run(setup);
  std::vector<double> times;
  while (!run.finished()) run.advance(), times.push_back(run.test_time());
  ASSERT_EQ(times.size(), 5u);
  const double expected[]{0.04, 0.08, 0.1, 0.14, 0.15};
  for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(times[k], expected[k], run.time_step());
}

/// Without wear in the settling time the flow is the same: the same grains at the same places.
TEST(Settling, DoesNotChangeTheFlow) {
  simulation::Setup setup = study::accelerated(stream_to_accelerate(), 1.0);
  setup.wear[0].wear_coefficient = 0.0;
  setup.run.end = {0.2, false};
  simulation::Simulation settled(setup);
  setup.run.settle = {};
  simulation::Simulation straight(setup);
  while (!settled.finished()) settled.advance();
  while (!straight.finished()) straight.advance();
  EXPECT_EQ(settled.time_step(), straight.time_step());
  EXPECT_EQ(settled.state_hash(), straight.state_hash());
}

TEST(Settling, GoesOnToTheSameBitsFromAnywhere) {
  simulation::Setup setup = study::accelerated(stream_to_accelerate(), 16.0);
  setup.output.every = {0.02, false};
  const simulation::Simulation run(setup);
  const auto settles = static_cast<std::uint64_t>(0.1 / run.time_step());
  ASSERT_LT(settles, run.total_steps());
  expect_same_bits_from_anywhere(setup, std::min(2 * settles, run.total_steps()));
}

TEST(Settling, MustEndBeforeTheRun) {
  simulation::Setup setup = study::accelerated(stream_to_accelerate(), 2.0);
  setup.run.settle = setup.run.end;
  EXPECT_TRUE(contains(refusal([&] { (void)simulation::Simulation(setup); }), "before the run's end"));
  setup.run.settle = {-0.1, false};
  EXPECT_THROW((void)simulation::Simulation(setup), InputError);
  setup.run.settle = {1.0, true};
  EXPECT_THROW((void)simulation::Simulation(setup), InputError);
  setup.run.settle = {};
  setup.run.end = {1e6, false};
  EXPECT_TRUE(contains(refusal([&] { (void)simulation::Simulation(study::accelerated(setup, 1e12)); }),
                       "more than output.every"));
}

TEST(Acceleration, OfManyParticlesComparesMaps) {
  simulation::Setup setup = stream_to_accelerate();
  setup.wear[0].tolerance = 10.0;
  std::size_t looks = 0;
  const AccelerationChoice choice = study::choose_acceleration(
      setup, simulation::generate_mesh, [&](const simulation::Simulation&) { return ++looks > 0; });
  ASSERT_EQ(choice.trials.size(), 1u);
  EXPECT_TRUE(choice.by_maps);
  EXPECT_FALSE(choice.in_revolutions);
  EXPECT_DOUBLE_EQ(choice.modelled, 0.2);  // twice as long as it settles
  EXPECT_NEAR(choice.factor, 4.0, 1e-12);
  EXPECT_EQ(choice.error, choice.trials[0].difference);
  EXPECT_GT(choice.trials[0].noise, 0.0);
  EXPECT_GT(looks, 0u);
}

/// A grain on a tray that shakes: cycles are counted, from four of them on, and no time to settle is asked
/// for.
TEST(Acceleration, OfManyParticlesOnWhatOscillatesCountsCycles) {
  simulation::Setup setup = stream_to_accelerate();
  simulation::WallSetup& tray = setup.walls[0];
  tray.mesh.rotation = {};
  tray.motion.kind = simulation::MotionKind::oscillation;
  tray.motion.amplitude = {0.5e-3, 0.0, 0.0};
  tray.motion.frequency = 200.0;
  setup.insertions[0].mass_rate.reset();
  setup.insertions[0].mass.reset();
  setup.insertions[0].number = 1;
  setup.insertions[0].velocity = {};
  setup.insertions[0].volume.low.z = 0.1e-3;
  setup.insertions[0].volume.high.z = 9e-3;
  setup.run.settle = {0.05, false};
  setup.run.end = {0.05 + 0.32, false};  // 64 cycles of 5 ms
  setup.wear[0].tolerance = 1e6;
  const AccelerationChoice choice = study::choose_acceleration(setup);
  EXPECT_TRUE(choice.by_maps);
  EXPECT_TRUE(choice.in_revolutions);
  ASSERT_EQ(choice.trials.size(), 1u);
  EXPECT_TRUE(choice.trials[0].difference) << choice.trials[0].failure;
  EXPECT_EQ(choice.modelled, 8.0);
  EXPECT_NEAR(choice.factor, 8.0, 1e-12);
}

TEST(Acceleration, OfManyParticlesWhereToleranceIsNeverMetIsNone) {
  simulation::Setup setup = stream_to_accelerate();
  setup.wear[0].tolerance = 1e-6;
  const AccelerationChoice choice = study::choose_acceleration(setup);
  EXPECT_EQ(choice.factor, 1.0);
  EXPECT_DOUBLE_EQ(choice.modelled, 0.8);
  EXPECT_EQ(choice.trials.size(), 2u);  // of 0.2 and 0.4 s
  EXPECT_GT(study::length_for(choice.trials.back(), 1e-6), 0.8);
}

/// So much wear in a step that the mesh turns over: it counts as different, and says why.
TEST(Acceleration, OfManyParticlesThatGoesUnphysicalCountsAsDifferent) {
  simulation::Setup setup = stream_to_accelerate();
  setup.wear[0].wear_coefficient = 1e-3;
  setup.wear[0].tolerance = 10.0;
  const AccelerationChoice choice = study::choose_acceleration(setup);
  EXPECT_EQ(choice.factor, 1.0);
  ASSERT_FALSE(choice.trials.empty());
  EXPECT_FALSE(choice.trials[0].difference);
  EXPECT_TRUE(contains(choice.trials[0].failure, "too deep for the mesh")) << choice.trials[0].failure;
}

TEST(Acceleration, OfManyParticlesOnWhatDoesNotWearIsSaidToBe) {
  simulation::Setup setup = stream_to_accelerate();
  setup.wear[0].wear_coefficient = 0.0;
  const AccelerationChoice choice = study::choose_acceleration(setup);
  EXPECT_EQ(choice.factor, 1.0);
  EXPECT_EQ(choice.trials.at(0).failure, "nothing was worn");
  setup.run.settle = {};
  EXPECT_TRUE(contains(refusal([&] { (void)study::choose_acceleration(setup); }), "give run.settle"));
  setup = stream_to_accelerate();
  setup.walls[0].deformation = simulation::DeformationRule::none;
  EXPECT_TRUE(
      contains(refusal([&] { (void)study::choose_acceleration(setup); }), "no wall changes its shape"));
}

/// Noise counts three times in the mean square of a difference: it falls as the root of the length.
TEST(Acceleration, SaysWhatLimitsAndHowFarItIs) {
  study::AccelerationTrial trial{.modelled = 2.0, .difference = 0.2, .failure = {}, .noise = 0.1};
  EXPECT_TRUE(trial.noise_limits());
  EXPECT_DOUBLE_EQ(study::length_for(trial, 0.1), 8.0);
  EXPECT_TRUE(contains(study::what_limits(trial), "mostly the flow's noise, 10 %"));
  trial.noise = 0.05;
  EXPECT_FALSE(trial.noise_limits());
  EXPECT_DOUBLE_EQ(study::length_for(trial, 0.1), 4.0);
  EXPECT_TRUE(contains(study::what_limits(trial), "mostly the steps of the shape"));
}

}  // namespace
}  // namespace abradem::test
