// SPDX-License-Identifier: BSD-3-Clause
// A calibration must find the coefficient that a synthetic measurement was made with.
#include "abradem/study/calibration.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/cases.h"

namespace abradem::study {
namespace {

constexpr double kTrue = 6.81e-11;    // [1/Pa]
constexpr double kRevolutions = 3.0;  // of the synthetic test

test::PinOnDisc small_pin() {
  test::PinOnDisc pin;
  pin.track = 6e-3;
  pin.half_band = 0.9e-3;
  pin.size = 0.15e-3;
  pin.revolutions = kRevolutions;
  pin.wear_coefficient = kTrue;
  return pin;
}

/// The case with the outcome of its own run as the measurement, and another coefficient to start from.
struct Synthetic {
  simulation::Setup setup;
  Outcome truth;
};
Synthetic synthetic(simulation::Setup setup, double start) {
  Outcome truth = run_trial(setup);
  const bool paper = setup.walls[0].deformation == simulation::DeformationRule::paper;
  simulation::MeasurementSetup m;
  const double v = paper ? truth.volumes.paper : truth.volumes.law;
  m.wear_volume = simulation::MeanSd{v, 0.1 * v};
  m.depth = simulation::Range{0.95 * truth.depth.mean, 1.05 * truth.depth.mean};
  m.width = simulation::Range{0.95 * truth.width.mean, 1.05 * truth.width.mean};
  m.revolutions = 1302.5;
  setup.measurement = m;
  setup.wear[0].wear_coefficient = start;
  return {setup, std::move(truth)};
}

TEST(Calibration, RecoversAKnownCoefficientWhereWearIsConserving) {
  const Synthetic s = synthetic(small_pin().setup(), 0.3 * kTrue);
  const CalibrationResult r = calibrate(s.setup);
  const double error = r.wear_coefficient.value / kTrue - 1.0;
  test::measured("calibration, conserving: coefficient recovered", std::abs(error), 1e-6);
  EXPECT_LT(std::abs(error), 1e-6);
  EXPECT_TRUE(r.closed_form);
  EXPECT_NEAR(r.calibrated.depth.mean / s.truth.depth.mean, 1.0, 1e-5);
  // The closed form alone: the groove tilts the normals, so V is proportional to alpha n to some 0.1 %.
  test::measured("calibration, conserving: closed form before correction", std::abs(r.first_residual), 5e-3);
  EXPECT_LT(std::abs(r.first_residual), 5e-3);

  // The interval: mean -+ 1.96 sd, sd a tenth of the mean.
  EXPECT_NEAR(r.wear_coefficient.low / kTrue, 1.0 - 0.1959964, 1e-5);
  EXPECT_NEAR(r.wear_coefficient.high / kTrue, 1.0 + 0.1959964, 1e-5);

  // The ridge: pairs with the same product wear the same groove.
  test::measured("calibration, conserving: volume along the ridge", r.ridge_volume_spread, 5e-3);
  EXPECT_LT(r.ridge_volume_spread, 5e-3);
  EXPECT_LT(r.ridge_depth_spread, 2e-2);
  ASSERT_EQ(r.ridge.size(), 4u);

  // Each measured range holds the truth, so what they ask of the product does too.
  ASSERT_TRUE(r.by_depth && r.by_width);
  for (const ProductRange& range : {r.by_volume, *r.by_depth, *r.by_width}) {
    EXPECT_TRUE(range.low_reached && range.high_reached);
    EXPECT_LT(range.low, kTrue * kRevolutions);
    EXPECT_GT(range.high, kTrue * kRevolutions);
  }

  // The table: n = V / (c alpha), and the two scaling factors of the paper.
  ASSERT_EQ(r.pairs.size(), 7u);
  EXPECT_NEAR(r.pairs[0].revolutions.value, kTrue * kRevolutions / 1e-11, 1e-4);
  EXPECT_NEAR(r.pairs[5].scaling_factor, 1302.5 / 12.0, 1e-9);
  EXPECT_NEAR(r.pairs[6].scaling_factor, 162.8125, 1e-9);
  EXPECT_NEAR(r.pairs[6].wear_coefficient.value, kTrue * kRevolutions / 8.0, 1e-16);
}

TEST(Calibration, RecoversTheNumberOfRevolutions) {
  simulation::Setup setup = small_pin().setup();
  Synthetic s = synthetic(setup, kTrue);
  s.setup.run.end = {1.0, true};  // as if it were not known
  const CalibrationResult r =
      calibrate(s.setup, simulation::generate_mesh,
                {.unknown = Unknown::revolutions, .coefficients = {}, .revolutions = {}});
  const double error = r.revolutions.value / kRevolutions - 1.0;
  test::measured("calibration, conserving: revolutions recovered", std::abs(error), 1e-4);
  EXPECT_LT(std::abs(error), 1e-4);
  EXPECT_EQ(r.wear_coefficient.value, kTrue);
  EXPECT_TRUE(r.pairs.empty());
}

TEST(Calibration, RecoversAKnownCoefficientUnderThePapersRule) {
  test::PinOnDisc pin = small_pin();
  pin.contact = simulation::ContactRule::per_triangle;
  pin.deformation = simulation::DeformationRule::paper;
  pin.wear_coefficient = 2e-11;
  const Synthetic s = synthetic(pin.setup(), 1e-11);
  const CalibrationResult r =
      calibrate(s.setup, simulation::generate_mesh, {.coefficients = {2e-11}, .revolutions = {}});
  EXPECT_FALSE(r.closed_form);
  const double error = r.wear_coefficient.value / 2e-11 - 1.0;
  test::measured("calibration, paper's rule: coefficient recovered", std::abs(error), 5e-3);
  EXPECT_LT(std::abs(error), 5e-3);
  EXPECT_LT(std::abs(r.residual), 5e-3);
  // The interval holds the truth and is about as wide as the measurement's.
  EXPECT_NEAR(r.wear_coefficient.low / 2e-11, 0.804, 0.03);
  EXPECT_NEAR(r.wear_coefficient.high / 2e-11, 1.196, 0.03);
  // The other way round: the revolutions for the true coefficient.
  ASSERT_EQ(r.pairs.size(), 1u);
  EXPECT_NEAR(r.pairs[0].revolutions.value / kRevolutions, 1.0, 5e-3);
}

}  // namespace
}  // namespace abradem::study
