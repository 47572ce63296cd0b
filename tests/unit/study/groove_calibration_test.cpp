// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/study/groove_calibration.h"

#include <gtest/gtest.h>

#include <cmath>

#include "abradem/analysis/wall_contours.h"
#include "abradem/core/error.h"
#include "support/cases.h"

namespace abradem::study {
namespace {

constexpr GrooveParameters kKnown{4e-11, 0.02, 0.6};

/// A stiff pin on a small ring, a few passes with long increments: quick, and a groove with a worn pin and
/// ridges.
simulation::Setup small_case() {
  test::PinOnDisc pin{
      .shear_modulus = 30e9, .track = 2.2e-3, .half_band = 0.6e-3, .size = 0.05e-3, .revolutions = 4.0};
  simulation::Setup s = pin.setup();
  s.run.increment = 15e-6;
  s.output.every = s.run.end;
  s.wear.front().wear_coefficient = kKnown[0];
  return s;
}

/// The case with what a run at the known parameters gives as its measurement; scatters relative.
simulation::Setup measured_case(double volume_sd, double depth_range, double width_range) {
  simulation::Setup s = small_case();
  simulation::Simulation run(with_groove_parameters(s, 0, kKnown));
  run.advance();
  double depth = 0.0, width = 0.0;
  const auto contours = analysis::wall_contours(run.walls()[0], s.output.contours);
  for (const analysis::Contour& c : contours)
    depth += c.depth / static_cast<double>(contours.size()),
        width += c.width / static_cast<double>(contours.size());
  const double V = run.ledger().law;
  s.measurement = simulation::MeasurementSetup{};
  s.measurement->wear_volume = simulation::MeanSd{V, volume_sd * V};
  s.measurement->depth = simulation::Range{depth * (1.0 - depth_range), depth * (1.0 + depth_range)};
  s.measurement->width = simulation::Range{width * (1.0 - width_range), width * (1.0 + width_range)};
  // Begin elsewhere.
  s.wear.front().wear_coefficient = 3e-11;
  return s;
}

TEST(GrooveCalibration, RecoversTheParametersThatMadeTheData) {
  const GrooveCalibration r =
      calibrate_groove(measured_case(0.02, 0.05, 0.05), simulation::generate_mesh, {.revolutions = 4.0});
  EXPECT_TRUE(r.inside);
  EXPECT_FALSE(r.at_limit);
  EXPECT_NEAR(r.calibrated.parameters[0] / kKnown[0], 1.0, 0.02);
  EXPECT_NEAR(r.calibrated.parameters[1] / kKnown[1], 1.0, 0.15);
  EXPECT_NEAR(r.calibrated.parameters[2], kKnown[2], 0.03);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT(r.low[i], kKnown[i]);
    EXPECT_GT(r.high[i], kKnown[i]);
    EXPECT_LT(std::abs(r.residual[i]), 0.5);
  }
  EXPECT_TRUE(undetermined(r).empty());
}

TEST(GrooveCalibration, SaysWhatTheMeasurementDoesNotTell) {
  // A depth and a width known to a factor say nothing of the ridges.
  const GrooveCalibration r =
      calibrate_groove(measured_case(0.02, 0.95, 0.95), simulation::generate_mesh, {.revolutions = 4.0});
  const std::vector<std::string> open{"pin-to-disc ratio", "removed fraction"};
  EXPECT_EQ(undetermined(r), open);
  EXPECT_LT(r.high[0] / r.low[0], 1.2);  // the volume tells the coefficient all the same
}

TEST(GrooveCalibration, NeedsVolumeDepthAndWidth) {
  simulation::Setup s = measured_case(0.02, 0.02, 0.02);
  s.measurement->width.reset();
  EXPECT_THROW((void)calibrate_groove(s, simulation::generate_mesh, {.revolutions = 4.0}), InputError);
}

}  // namespace
}  // namespace abradem::study
