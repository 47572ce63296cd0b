// SPDX-License-Identifier: BSD-3-Clause
// The groove of a guided sphere on a wearing elastic half-space: the reference solves the elastic contact
// (FFT, conjugate gradients) and wears by the local law, many passes. docs/verification/wear.md#half-space
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <numbers>

#include "support/cases.h"
#include "support/grooves.h"
#include "support/table.h"

namespace abradem::test {
namespace {

struct Case {
  const char* pin;        // SOFT, STIFF
  int n;                  // state: alpha n of so many laboratory passes at 6.81e-11 1/Pa
  int passes;             // the state is reached in so many passes
  double size;            // of the triangles [m]
  double depth, profile;  // bounds [-]
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.pin << " n=" << c.n << " h=" << 1e3 * c.size << " mm";
}

class HalfSpace : public testing::TestWithParam<Case> {};

TEST_P(HalfSpace, GrooveHasTheDepthAndProfileOfTheReference) {
  const Case c = GetParam();
  const bool stiff = std::string(c.pin) == "STIFF";
  PinOnPlate pin;
  pin.shear_modulus = stiff ? 30e9 : 0.1e9;
  pin.passes = c.passes;
  pin.wear_per_pass = 6.81e-11 * c.n / c.passes;
  pin.size = c.size;
  // The ends of the groove are felt over sqrt(R depth) and a contact: keep the middle clear of them.
  pin.amplitude = stiff ? (c.n > 2 ? 0.8e-3 : 0.4e-3) : 1.2e-3;
  pin.half_width = stiff ? 0.4e-3 : 0.6e-3;
  pin.margin = stiff ? 0.2e-3 : 0.6e-3;
  simulation::Simulation run(pin.setup());
  run.advance();
  ASSERT_TRUE(run.finished());

  const std::string state = fmt::format("i_n{:02d}", c.n);
  const Table profile(stiff ? "halfspace_profile_stiff.csv" : "halfspace_profile_soft.csv");
  std::vector<double> y = profile.numbers("y_mm"), sink = profile.numbers(state);
  for (double& v : y) v *= 1e-3;
  for (double& v : sink) v *= 1e-6;
  const Groove groove = measure_plate(run, stiff ? 0.2e-3 : 0.4e-3, y);
  const double depth = groove.depth / sink.front() - 1.0, l2 = relative_l2(groove.profile, sink);
  const std::string name =
      fmt::format("{} n={} in {} passes, h = {} mm: ", c.pin, c.n, c.passes, 1e3 * c.size);
  measured(name + "depth error", depth, c.depth);
  measured(name + "profile, L2", l2, c.profile);
  EXPECT_LT(std::abs(depth), c.depth);
  EXPECT_LT(l2, c.profile);
  EXPECT_LT(run.ledger().residual, 1e-9);
}

// Pass marks: 1 % in depth, 2 % in profile, at triangles of an eighth of the contact's half-width or finer.
INSTANTIATE_TEST_SUITE_P(
    Converged, HalfSpace,
    testing::Values(Case{"SOFT", 1, 2, 0.05e-3, 0.01, 0.02}, Case{"SOFT", 2, 2, 0.05e-3, 0.01, 0.02},
                    Case{"SOFT", 4, 4, 0.05e-3, 0.01, 0.02}, Case{"SOFT", 8, 8, 0.05e-3, 0.01, 0.02},
                    Case{"SOFT", 12, 12, 0.05e-3, 0.01, 0.02}, Case{"SOFT", 12, 12, 0.025e-3, 0.01, 0.01},
                    Case{"STIFF", 1, 24, 0.0125e-3, 0.01, 0.02}, Case{"STIFF", 2, 24, 0.0125e-3, 0.01, 0.02},
                    Case{"STIFF", 4, 12, 0.025e-3, 0.01, 0.02}, Case{"STIFF", 8, 12, 0.025e-3, 0.01, 0.02},
                    Case{"STIFF", 12, 12, 0.025e-3, 0.01, 0.01}));

// What the paper's mesh of 0.1 mm costs: the stiff pin's first groove is two triangles wide.
INSTANTIATE_TEST_SUITE_P(AtATenthOfAMillimetre, HalfSpace,
                         testing::Values(Case{"SOFT", 1, 2, 0.1e-3, 0.02, 0.06},
                                         Case{"SOFT", 12, 12, 0.1e-3, 0.01, 0.05},
                                         Case{"STIFF", 1, 12, 0.1e-3, 0.03, 0.18},
                                         Case{"STIFF", 12, 12, 0.1e-3, 0.02, 0.06}));

// ---- the laboratory test, unscaled: 1302 passes with increments of two contact half-widths
// ------------------------------------------------------------------------

struct Long {
  const char* pin;
  double size;                        // of the triangles [m]
  double depth, profile, increments;  // bounds: against the reference; between increments [-]
};

void PrintTo(const Long& c, std::ostream* out) { *out << c.pin << " h=" << 1e3 * c.size << " mm"; }

class WholeLaboratoryTest : public testing::TestWithParam<Long> {};

TEST_P(WholeLaboratoryTest, HasTheGrooveOfTheReferenceWhateverTheIncrement) {
  const Long c = GetParam();
  const bool stiff = std::string(c.pin) == "STIFF";
  PinOnPlate pin;
  pin.shear_modulus = stiff ? 30e9 : 0.1e9;
  pin.passes = 1302;
  pin.wear_per_pass = 6.28e-13 * 1302.5 / pin.passes;
  pin.size = c.size;
  pin.amplitude = stiff ? 0.8e-3 : 1.2e-3;
  pin.half_width = stiff ? 0.4e-3 : 0.6e-3;
  pin.margin = stiff ? 0.2e-3 : 0.6e-3;
  const Table profile(stiff ? "halfspace_profile_stiff.csv" : "halfspace_profile_soft.csv");
  std::vector<double> y = profile.numbers("y_mm"), sink = profile.numbers("ii_lab1302.5");
  for (double& v : y) v *= 1e-3;
  for (double& v : sink) v *= 1e-6;

  const double a = stiff ? 0.057788e-3 : 0.349796e-3;  // Hertz, as the tables say [m]
  const auto groove = [&](double increment) {
    pin.increment = increment;
    simulation::Simulation run(pin.setup());
    run.advance();
    EXPECT_LT(run.ledger().residual, 1e-9);
    const double taken = 2.0 * std::numbers::pi * pin.amplitude * run.time_step();
    EXPECT_NEAR(taken / (increment > 0.0 ? increment : 2.0 * a), 1.0, 0.01);
    return measure_plate(run, stiff ? 0.2e-3 : 0.4e-3, y);
  };
  const Groove chosen = groove(0.0), reference = groove(stiff ? 0.8 * a : 0.2 * a);
  const std::string name = fmt::format("{} 1302.5 revolutions, h = {} mm: ", c.pin, 1e3 * c.size);
  const double depth = chosen.depth / sink.front() - 1.0, l2 = relative_l2(chosen.profile, sink);
  const double between = relative_l2(chosen.profile, reference.profile);
  measured(name + "depth error", depth, c.depth);
  measured(name + "profile, L2", l2, c.profile);
  measured(name + "profile, chosen increment against a shorter one", between, c.increments);
  EXPECT_LT(std::abs(depth), c.depth);
  EXPECT_LT(l2, c.profile);
  EXPECT_LT(between, c.increments);
  EXPECT_LT(chosen.depth_sd, reference.depth_sd + 2e-3 * sink.front());  // no ripples
}

INSTANTIATE_TEST_SUITE_P(Increments, WholeLaboratoryTest,
                         testing::Values(Long{"SOFT", 0.05e-3, 0.01, 0.02, 1e-3},
                                         Long{"STIFF", 0.05e-3, 0.01, 0.02, 1e-3}));

TEST(HalfSpace, OverlapFootprintIsTooShallowForASoftPin) {
  const auto depth = [](simulation::Footprint footprint) {
    PinOnPlate pin;
    pin.passes = 12;
    pin.footprint = footprint;
    simulation::Simulation run(pin.setup());
    run.advance();
    return measure_plate(run, 0.4e-3).depth;
  };
  const double hertz = depth(simulation::Footprint::hertz), overlap = depth(simulation::Footprint::overlap);
  measured("soft pin, 12 passes: depth, overlap against hertz footprint", overlap / hertz - 1.0, -0.15);
  EXPECT_LT(overlap / hertz, 0.85);
  EXPECT_GT(overlap / hertz, 0.75);
}

TEST(HalfSpace, TwelvePassesOnTheRingGiveTheGrooveOfThePlate) {
  PinOnDisc ring;
  ring.friction = 0.0;
  ring.revolutions = 12.0;
  ring.track = 11e-3;
  ring.half_band = 0.6e-3;
  ring.size = 0.1e-3;
  PinOnPlate plate;
  plate.passes = 12;
  plate.size = 0.1e-3;
  simulation::Simulation a(ring.setup()), b(plate.setup());
  while (!a.finished()) a.advance();
  b.advance();
  const double ratio = measure_ring(a, ring.track).depth / measure_plate(b, 0.4e-3).depth;
  measured("soft pin, 12 passes, h = 0.1 mm: depth, ring against plate", ratio - 1.0, 0.01);
  EXPECT_NEAR(ratio, 1.0, 0.01);
}

}  // namespace
}  // namespace abradem::test
