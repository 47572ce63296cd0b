// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/study/calibration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "abradem/core/error.h"
#include "support/cases.h"

namespace abradem::study {
namespace {

simulation::Setup measured_case() {
  simulation::Setup s = test::PinOnDisc{.track = 6e-3, .half_band = 0.9e-3, .size = 0.3e-3}.setup();
  s.measurement = simulation::MeasurementSetup{};
  s.measurement->wear_volume = simulation::MeanSd{1e-11, 1e-12};
  return s;
}

template <typename Change>
std::string refusal(Change&& change, const CalibrationOptions& options = {}) {
  simulation::Setup s = measured_case();
  change(s);
  try {
    (void)calibrate(s, simulation::generate_mesh, options);
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

testing::AssertionResult says(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "'" << part << "' is not in: " << text;
}

TEST(Passes, InterpolatesThroughTheOrigin) {
  const std::vector<double> x{1.0, 2.0, 4.0}, y{2.0, 3.0, 5.0};
  EXPECT_DOUBLE_EQ(passes(x, y, 1.0), 0.5);
  EXPECT_DOUBLE_EQ(passes(x, y, 2.0), 1.0);
  EXPECT_DOUBLE_EQ(passes(x, y, 4.5), 3.5);
  EXPECT_EQ(passes(x, y, 0.0), 0.0);
  EXPECT_TRUE(std::isnan(passes(x, y, 5.1)));
}

TEST(PublishedFits, ReachTheMeasuredVolume) {
  // Eq. 17 by hand: 0.011 n^2 + 0.098 n + 0.08 = 0.565 has the root (-0.098 + sqrt(0.098^2 + 4 0.011 0.485))
  // / 0.022.
  const PublishedFit& last = published_fits().back();
  EXPECT_EQ(last.equation, 17);
  EXPECT_NEAR(last.revolutions(0.565e-9), (-0.098 + std::sqrt(0.009604 + 0.02134)) / 0.022, 1e-12);
  for (const PublishedFit& fit : published_fits()) {
    const double n = fit.revolutions(0.565e-9);
    EXPECT_NEAR(fit.a0 + fit.a1 * n + fit.a2 * n * n, 0.565, 1e-12);
  }
}

TEST(CalibratedPair, IsTheOneThatCanWearAWall) {
  simulation::Setup s = measured_case();
  s.wear.insert(s.wear.begin(), {"mild_steel", "iron_ore", 1e-12});  // no wall is made of ore
  EXPECT_EQ(calibrated_pair(s, ""), 1u);
  EXPECT_EQ(calibrated_pair(s, "iron_ore/mild_steel"), 1u);
  EXPECT_THROW((void)calibrated_pair(s, "mild_steel/iron_ore"), InputError);
  s.wear.erase(s.wear.begin() + 1);
  EXPECT_THROW((void)calibrated_pair(s, ""), InputError);
}

TEST(CalibratedPair, MustBeNamedWhereThereAreSeveral) {
  simulation::Setup s = measured_case();
  s.materials.push_back({"coke", 1000.0, 1e9, 0.3, {}});
  s.particles.push_back(s.particles[0]);
  s.particles.back().material = "coke";
  s.wear.push_back({"coke", "mild_steel", 1e-12});
  EXPECT_EQ(calibrated_pair(s, "coke/mild_steel"), 1u);
  try {
    (void)calibrated_pair(s, "");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_TRUE(says(e.what(), "iron_ore/mild_steel, coke/mild_steel"));
  }
}

TEST(Calibration, RefusesWhatItCannotUse) {
  using simulation::Setup;
  EXPECT_TRUE(says(refusal([](Setup& s) { s.measurement.reset(); }), "needs a measured volume"));
  EXPECT_TRUE(says(refusal([](Setup& s) { s.measurement->wear_volume->mean = 0.0; }), "measured volume"));
  EXPECT_TRUE(says(refusal([](Setup& s) { s.walls[0].motion = {}; }), "turns or oscillates"));
  EXPECT_TRUE(says(refusal([](Setup&) {}, {.coverage = 1.0}), "coverage = 1"));
  EXPECT_TRUE(says(refusal([](Setup&) {}, {.coefficients = {-1.0}}), "must be > 0"));
  EXPECT_TRUE(
      says(refusal([](Setup& s) { s.wear[0].wear_coefficient = 0.0; }, {.unknown = Unknown::revolutions}),
           "wear_coefficient = 0"));
}

TEST(Calibration, IsInterruptedByItsWatcher) {
  EXPECT_THROW((void)calibrate(measured_case(), simulation::generate_mesh,
                               {.watch = [](const std::string& doing, double) { return doing != "ridge"; }}),
               Interrupted);
}

}  // namespace
}  // namespace abradem::study
