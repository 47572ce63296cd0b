// SPDX-License-Identifier: BSD-3-Clause
// Fewer seconds than the test: a steady stream, accelerated. docs/verification/wear.md#bulk-acceleration
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "abradem/analysis/depth_map.h"
#include "abradem/analysis/statistics.h"
#include "abradem/study/acceleration.h"
#include "support/cases.h"
#include "support/grains.h"

namespace abradem::test {
namespace {

constexpr double kRadius = kStreamRadius;

/// What a run wore in each of its outputs, and the depths at its end.
struct Worn {
  std::vector<double> volume;                   // per output once the flow has settled [m^3]
  std::vector<double> depth, area;              // of places as wide as a grain [m], [m^2]
  std::array<std::vector<double>, 4> quarters;  // depths worn in each quarter
  Ledger ledger;
};

Worn worn(simulation::Setup setup, int outputs) {
  const OneThread one;
  setup.output.every = {(setup.run.end.value - setup.run.settle.value) / outputs, false};
  simulation::Simulation run(setup);
  Worn out;
  analysis::DepthPlaces places(2.0 * kRadius);
  const wear::WearingSurface& plate = run.walls()[0].surface();
  places.add(plate.reference(), plate.mesh().triangles);
  out.area = places.area();
  out.depth.assign(places.size(), 0.0);
  double before = 0.0;
  while (!run.finished()) {
    run.advance();
    if (run.test_time() <= run.settle_time()) {
      EXPECT_EQ(run.law_volume(), 0.0);
      continue;
    }
    out.volume.push_back(run.law_volume() - before);
    before = run.law_volume();
    const auto made = static_cast<int>(out.volume.size());
    if (made % (outputs / 4) != 0) continue;
    const std::vector<double> depth = places.depths(plate.element_volume());
    std::vector<double>& quarter = out.quarters.at(static_cast<std::size_t>(made / (outputs / 4) - 1));
    quarter = depth;
    for (std::size_t p = 0; p < depth.size(); ++p) quarter[p] -= out.depth[p];
    out.depth = depth;
  }
  out.ledger = run.ledger();
  return out;
}

double distance(const Worn& a, const Worn& b) {
  std::vector<double> difference = a.depth;
  for (std::size_t p = 0; p < difference.size(); ++p) difference[p] -= b.depth[p];
  return analysis::map_size(difference, a.area) / analysis::map_size(b.depth, b.area);
}

double sum(const std::vector<double>& v) {
  double s = 0.0;
  for (const double x : v) s += x;
  return s;
}

/// Three seconds of the test in all, and in a quarter of the time with four times the wear: the same within
/// the noise of the flow, which batches of 0.1 s measure.
TEST(BulkAcceleration, OfASteadyStreamIsTheWholeTestWithinTheNoise) {
  constexpr double kSettle = 0.2, kTest = 3.2;
  const Worn all = worn(stream_on_plate(kSettle, kTest), 32);
  const Worn quarter = worn(study::accelerated(stream_on_plate(kSettle, kTest), 4.0), 8);
  for (const Worn* w : {&all, &quarter}) {
    EXPECT_LT(w->ledger.residual, 1e-9);
    EXPECT_NEAR(w->ledger.kappa, 1.0, 1e-9);
  }
  ASSERT_EQ(all.volume.size(), 32u);
  ASSERT_EQ(quarter.volume.size(), 8u);
  // Of a batch of 0.1 s, relative; the long run has 32 of them, the short one 8.
  const analysis::Summary batch = analysis::summarise(all.volume);
  const double error = batch.sd / batch.mean * std::sqrt(1.0 / 32.0 + 1.0 / 8.0);
  const double volume = std::abs(sum(quarter.volume) / sum(all.volume) - 1.0);
  measured("steady stream, factor 4: volume against the whole test", volume, 3.0 * error);
  EXPECT_LT(volume, 3.0 * error);
  EXPECT_LT(error, 0.05);
  // The maps: the noise of either, independent of each other.
  const double noise = std::hypot(analysis::map_noise(all.quarters, all.area),
                                  analysis::map_noise(quarter.quarters, quarter.area)) /
                       analysis::map_size(all.depth, all.area);
  const double map = distance(quarter, all);
  measured("steady stream, factor 4: depths (L2) over the noise of both", map / noise, 1.3);
  EXPECT_LT(map / noise, 1.3);
  EXPECT_GT(map / noise, 0.7);
}

/// Four spheres in one body, which does not roll, at rest in a smooth corner on a belt: by Archard's law
/// alpha f m g v t, from the moment on at which it has settled.
TEST(BulkAcceleration, OfABodyHeldOnABeltIsArchards) {
  constexpr double kSettle = 0.5, kModelled = 0.1, kFactor = 50.0, kAlpha = 1e-11, kSpeed = 0.5;
  simulation::Setup setup;
  setup.materials = {
      {"ore", 2500.0, 1e7, 0.25, {}}, {"steel", 7850.0, 78e9, 0.3, {}}, {"smooth", 7850.0, 78e9, 0.3, {}}};
  setup.contacts = {
      {"ore", "ore", 0.3, 0.5, 0.0}, {"ore", "steel", 0.3, 0.1, 0.0}, {"ore", "smooth", 0.3, 0.0, 0.0}};
  setup.wear = {{.abrader = "ore", .worn = "steel", .wear_coefficient = kAlpha}};
  ShapeSetup body;
  body.name = "body";
  const double c = kRadius / std::sqrt(2.0);
  body.spheres = {
      {{c, c, c}, kRadius}, {{c, -c, -c}, kRadius}, {{-c, c, -c}, kRadius}, {{-c, -c, c}, kRadius}};
  setup.shapes = {body};
  WallSetup belt = plate("belt", "steel", 40e-3, 2e-3);
  belt.motion.surface_velocity = {kSpeed, 0.0, 0.0};
  belt.contact = ContactRule::automatic;
  belt.deformation = DeformationRule::conserving;
  const double across = std::sqrt(0.5);
  setup.walls = {belt, plane("left", {12e-3, 0, 0}, {-across, across, 0}, "smooth"),
                 plane("right", {12e-3, 0, 0}, {-across, -across, 0}, "smooth")};
  InsertionSetup one;
  one.name = "one";
  one.material = "ore";
  one.shape = "body";
  one.number = 1;
  one.volume.low = {-18e-3, -9e-3, 1e-3};
  one.volume.high = {4e-3, 9e-3, 20e-3};
  setup.insertions = {one};
  setup.run.gravity = {0.0, 0.0, -9.81};
  setup.run.settle = {kSettle, false};
  setup.run.end = setup.output.every = {kSettle + kFactor * kModelled, false};

  const OneThread thread;
  simulation::Simulation run(study::accelerated(setup, kFactor));
  while (!run.finished()) run.advance();
  EXPECT_NEAR(run.time(), kSettle + kModelled, 1e-4);
  EXPECT_NEAR(run.test_time(), kSettle + kFactor * kModelled, 1e-9);
  const double archard = kAlpha * kFactor * run.bulk_state().mass * 9.81 * kSpeed * kModelled;
  const double error = std::abs(run.law_volume() / archard - 1.0);
  measured("a body held on a belt, factor 50: volume against Archard's", error, 1e-5);
  EXPECT_LT(error, 1e-5);
  EXPECT_LT(run.ledger().residual, 1e-9);
}

/// What the program accepts, against the error itself: the whole test modelled.
TEST(BulkAcceleration, ChosenKeepsToItsTolerance) {
  constexpr double kTolerance = 0.3;
  simulation::Setup setup = stream_on_plate(0.2, 3.2);
  setup.wear[0].acceleration.automatic = true;
  setup.wear[0].tolerance = kTolerance;
  const OneThread one;
  const study::AccelerationChoice choice = study::choose_acceleration(setup);
  ASSERT_GT(choice.factor, 1.0);
  EXPECT_TRUE(choice.by_maps);
  EXPECT_FALSE(choice.in_revolutions);
  EXPECT_DOUBLE_EQ(choice.factor * choice.modelled, 3.2);
  EXPECT_LT(choice.error, kTolerance);
  const Worn all = worn(study::accelerated(setup, 1.0), 32);
  const Worn few = worn(study::accelerated(setup, choice.factor), 8);
  const double error = distance(few, all);
  measured("stream, acceleration chosen for 30 %: depths (L2) against the whole test", error, choice.error);
  EXPECT_LT(error, choice.error);
  // Noise alone: the difference of n and 2 n is sqrt(3) of the finer run's.
  for (const study::AccelerationTrial& trial : choice.trials) {
    ASSERT_TRUE(trial.difference.has_value());
    EXPECT_TRUE(trial.noise_limits());
    EXPECT_NEAR(*trial.difference / trial.noise, std::sqrt(3.0), 0.5);
  }
}

}  // namespace
}  // namespace abradem::test
