// SPDX-License-Identifier: BSD-3-Clause
// Each watchdog stops a run that is made to trigger it, within a bounded number of steps, and says why.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "abradem/core/archive.h"
#include "abradem/core/error.h"
#include "abradem/simulation/simulation.h"
#include "support/cases.h"
#include "support/says.h"

namespace abradem::simulation {
namespace {

using test::says;

simulation::Setup small_case(Method method = Method::dynamic) {
  test::PinOnDisc pin;
  pin.track = 6e-3;
  pin.half_band = 0.9e-3;
  pin.size = 0.2e-3;
  pin.method = method;
  return pin.setup();
}

/// A free ball that is shot at the disc.
simulation::Setup shot(double speed) {
  simulation::Setup s = small_case();
  s.particles[0].guide = Guide::none;
  s.particles[0].load = {};
  s.particles[0].position.z += 0.2e-3;
  s.particles[0].velocity = {0.0, 0.0, -speed};
  return s;
}

/// Steps until it stops. @return the message; empty when it did not within so many steps
std::string stopped(Simulation& run, int steps) {
  try {
    for (int i = 0; i < steps; ++i) run.step();
  } catch (const SimulationError& error) {
    return error.what();
  }
  return {};
}

TEST(Watchdog, NotANumberStopsInTheSameStep) {
  for (const int what : {0, 1, 2}) {
    Simulation run(shot(1.0));
    Vec3& of = what == 0   ? run.particles().position[0]
               : what == 1 ? run.particles().velocity[0]
                           : run.particles().spin[0];
    EXPECT_EQ(stopped(run, 3), "");
    of.x = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(says(stopped(run, 1), {"particle 'pin', step 3", "no longer a number"})) << what;
  }
}

TEST(Watchdog, NotANumberStopsABalanceInTheSameIncrement) {
  Simulation run(small_case(Method::quasi_static));
  EXPECT_EQ(stopped(run, 3), "");
  run.particles().position[0].z = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(says(stopped(run, 1), {"particle 'pin'", "step 3"}));
  EXPECT_EQ(run.steps(), 3U);
}

TEST(Watchdog, WearThatIsNoNumberStopsInTheSameStep) {
  for (const Method method : {Method::quasi_static, Method::dynamic}) {
    simulation::Setup s = small_case(method);
    s.wear[0].wear_coefficient = std::numeric_limits<double>::quiet_NaN();
    s.particles[0].position.z = 0.99 * s.particles[0].radius;  // in contact from the start
    Simulation run(s);
    EXPECT_TRUE(says(stopped(run, 2), {"wall 'disc', step ", "no longer a number"}));
  }
}

TEST(Watchdog, ExplodingEnergyStopsInTheSameStep) {
  Simulation run(shot(1e-3));
  EXPECT_EQ(stopped(run, 3), "");
  run.particles().velocity[0] = {0.0, 0.0, 15.0};  // slow enough to be followed step by step
  EXPECT_TRUE(
      says(stopped(run, 1), {"particle 'pin', step 3", "its energy explodes", "J at 15 m/s", "Shorten"}));
}

TEST(Watchdog, NoEnergyOfABallThatBouncesOrIsThrownIsTakenForAnExplosion) {
  for (const double speed : {1e-6, 1e-2, 3.0}) {
    Simulation run(shot(speed));
    EXPECT_EQ(stopped(run, 2000), "") << speed;
  }
  // Started as deep in the disc as it may, with nothing else to give it energy.
  simulation::Setup deep = shot(0.0);
  deep.particles[0].position.z = 0.905 * deep.particles[0].radius;
  Simulation run(deep);
  EXPECT_EQ(stopped(run, 200), "");
}

TEST(Watchdog, TooDeepAnOverlapIsNamedWithTheTriangle) {
  for (const ContactRule rule : {ContactRule::patch, ContactRule::resolved, ContactRule::per_triangle}) {
    simulation::Setup s = shot(20.0);
    s.walls[0].contact = rule;
    s.run.time_step = {2e-6, false};
    // The many springs of per_triangle stop any ball in time: it starts too deep.
    if (rule == ContactRule::per_triangle) s.particles[0].position.z = 0.85 * s.particles[0].radius;
    Simulation run(s);
    const std::string message = stopped(run, 200);
    EXPECT_TRUE(says(message, {"particle 'pin'", "overlap with wall 'disc', triangle ",
                               "more than a tenth of its "
                               "radius of 3 mm",
                               " N. ", "Shorten"}));
    // Long before its centre could come to the other side.
    EXPECT_GT(run.particles().position[0].z, 0.8 * run.particles().radius[0]);
  }
}

TEST(Watchdog, WhatIsFastEnoughToPassThroughAWallIsStoppedBefore) {
  Simulation run(shot(400.0));
  EXPECT_TRUE(says(stopped(run, 1), {"it moves", "in one step, more than a tenth of its radius"}));
  EXPECT_EQ(run.steps(), 0U);
}

TEST(Watchdog, AWallThatIsFastEnoughToPassThroughAParticleIsStoppedBefore) {
  simulation::Setup s = shot(0.0);
  s.particles[0].position = {6e-3, 0.0, 0.1};
  s.walls[0].motion.kind = MotionKind::translation;
  s.walls[0].motion.velocity = {0.0, 0.0, 3000.0};
  s.run.end = s.output.every = {1.0, false};
  Simulation run(s);
  EXPECT_TRUE(says(stopped(run, 1), {"particle 'pin', step 0", "wall 'disc' moves past it by ",
                                     "in one step, more than its radius"}));
}

TEST(Watchdog, TwoBallsInOneAnotherStopTheRun) {
  simulation::Setup s = shot(0.0);
  s.particles.push_back(s.particles[0]);
  s.particles[1].name = "other";
  s.particles[1].position.z += 1.85 * s.particles[0].radius;
  s.contacts.push_back({"iron_ore", "iron_ore", 0.4, 0.5, 0.0});
  Simulation run(s);
  EXPECT_TRUE(says(stopped(run, 1),
                   {"particle 'pin' at (", "step 0, 0 s", "overlap with particle 'other' is 0.45 mm"}));
}

TEST(Watchdog, AGuidedParticleThatLeftItsWallsStopsTheRun) {
  simulation::Setup s = small_case();
  s.particles[0].position.x = 50e-3;
  Simulation run(s);
  EXPECT_TRUE(says(stopped(run, 5000), {"it has left the walls"}));
}

/// A pin at rest on a plane, its load carried.
simulation::Setup at_rest(double time_step, Stability stability = Stability::stop) {
  simulation::Setup s = small_case();
  s.walls[0].mesh = {};
  s.walls[0].mesh.shape = MeshShape::plane;
  s.walls[0].motion = {};
  s.wear.clear();
  const contact::PairProperties pair = material::effective_moduli(
      {s.materials[0].density, s.materials[0].shear_modulus, s.materials[0].poisson_ratio},
      {s.materials[1].density, s.materials[1].shear_modulus, s.materials[1].poisson_ratio});
  s.particles[0].position.z -= contact::hertz_overlap(pair, test::PinOnDisc::kRadius, test::PinOnDisc::kLoad);
  s.run.end = s.output.every = {1.0, false};
  s.run.time_step = {time_step, false};
  s.run.stability = stability;
  return s;
}

// 2 c dt + S dt^2 = 4 M at the pin's load, by hand: M = 5.4852e-4 kg, S = 1.8389e5 N/m, c = 5.1343 N s/m.
constexpr double kStableStep = 8.482e-5;

TEST(Watchdog, ADisturbanceDiesOutBelowTheLimitOfTheStepAndStopsTheRunAboveIt) {
  const double rest = at_rest(1e-6).particles[0].position.z, disturbance = 1e-11;
  Simulation below(at_rest(0.99 * kStableStep));
  below.particles().position[0].z += disturbance;
  EXPECT_EQ(stopped(below, 5000), "");
  EXPECT_NEAR(below.particles().position[0].z, rest, 1e-3 * disturbance);

  Simulation above(at_rest(1.01 * kStableStep));
  above.particles().position[0].z += disturbance;
  EXPECT_TRUE(says(stopped(above, 2000),
                   {"particle 'pin', step ", "the time step is too long: 2g + W = 4.0", "1 contacts",
                    "run.time_step below 8.48e-05 s", "run.stability = \"warn\""}));
  EXPECT_GT(std::abs(above.particles().position[0].z - rest), 100.0 * disturbance);
  EXPECT_LT(std::abs(above.particles().position[0].z - rest), 1e4 * disturbance);
}

TEST(Watchdog, TheLimitOfTheStepIsAWarningWhereTheCaseSaysSo) {
  Simulation run(at_rest(1.02 * kStableStep, Stability::warn));
  EXPECT_EQ(stopped(run, 3000), "");
  EXPECT_FALSE(run.limits().back().ok());
}

TEST(Watchdog, ShortPeaksAboveTheLimitAreNoInstability) {
  // An impact whose deepest steps are above the limit, and the rest of it below.
  simulation::Setup s = shot(3.0);
  s.run.time_step = {6.8e-5, false};
  Simulation run(s);
  EXPECT_EQ(stopped(run, 40), "");
  EXPECT_GT(run.limits().back().value, 4.0);
}

TEST(Watchdog, ManyTrianglesThatEachHoldTheSphereAreTooMuchForTheStep) {
  simulation::Setup s = small_case();
  s.walls[0].mesh.size = 0.05e-3;
  s.walls[0].contact = ContactRule::per_triangle;
  Simulation run(s);
  EXPECT_TRUE(says(stopped(run, 500), {"the time step is too long", "contact = \"patch\""}));
  s.walls[0].contact = ContactRule::patch;
  Simulation patch(s);
  EXPECT_EQ(stopped(patch, 500), "");
}

TEST(Watchdog, ATriangleThatTurnsOverStopsTheRun) {
  // A sheet with a skirt: the pin wears the rim inwards, over the nodes behind it.
  simulation::Setup s = small_case(Method::quasi_static);
  s.walls[0].mesh.shape = MeshShape::plate;
  s.walls[0].motion = {};
  s.walls[0].motion.kind = MotionKind::oscillation;
  s.walls[0].motion.amplitude = {1e-3, 0.0, 0.0};
  s.walls[0].motion.frequency = 1.0;
  s.wear[0].wear_coefficient = 1.6e-11;  // little in a step, or the guard of steps too deep comes first
  s.run.increment = 0.05e-3;
  s.particles[0].position = {0.0, 0.0, s.particles[0].radius};
  s.run.end = s.output.every = {200.0, true};
  const auto sheet = [](const MeshSetup&, std::uint64_t) {
    geometry::TriangleMesh mesh;
    constexpr int n = 60;
    constexpr double edge = 0.1e-3, height = 0.1e-3;
    for (int i = 0; i <= n; ++i) {
      const double x = (i - n / 2) * edge;
      mesh.vertices.insert(mesh.vertices.end(), {{x, edge, 0.0}, {x, 0.0, 0.0}, {x, 0.0, -height}});
    }
    for (std::int32_t i = 0; i < n; ++i) {
      const std::int32_t a = 3 * i;
      for (const std::int32_t row : {0, 1}) {
        mesh.triangles.push_back({a + row, a + row + 1, a + row + 4});
        mesh.triangles.push_back({a + row, a + row + 4, a + row + 3});
      }
    }
    return mesh;
  };
  Simulation run(s, sheet);
  EXPECT_TRUE(
      says(stopped(run, 200000), {"wall 'disc', step ", "wear turned over triangle ", "Lower the wear"}));
}

TEST(Watchdog, BooksThatDoNotCloseStopTheRunAtTheNextOutput) {
  simulation::Setup s = small_case(Method::quasi_static);
  s.run.end = {0.02, true};
  s.output.every = {0.01, true};
  Simulation run(s);
  while (run.steps() < run.steps_per_output() / 2) run.step();
  core::ArchiveWriter saved;
  run.save(saved);
  // One part in a million of the law's volume is lost, in a copy of the state.
  std::string bytes = saved.bytes();
  const double law = run.law_volume(), less = law * (1.0 - 1e-6);
  char pattern[sizeof law];
  std::memcpy(pattern, &law, sizeof law);
  const std::size_t at = bytes.find(std::string(pattern, sizeof law));
  ASSERT_NE(at, std::string::npos);
  bytes.replace(at, sizeof less, std::string(reinterpret_cast<const char*>(&less), sizeof less));
  Simulation wrong(s);
  core::ArchiveReader archive(bytes);
  wrong.load(archive);
  EXPECT_TRUE(says(stopped(wrong, static_cast<int>(run.steps_per_output())),
                   {"the ledger does not close", "mm^3", "residual"}));
  EXPECT_EQ(wrong.steps(), run.steps_per_output());
  EXPECT_EQ(stopped(run, static_cast<int>(run.steps_per_output())), "");
}

TEST(Watchdog, WearSmallerThanTheRoundingOfTheNodesIsNoFault) {
  simulation::Setup s = small_case(Method::quasi_static);
  s.walls[0].mesh.position.z = 0.1;
  s.particles[0].position.z += 0.1;
  s.wear[0].wear_coefficient = 1e-18;
  s.run.end = s.output.every = {0.02, true};
  Simulation run(s);
  EXPECT_EQ(stopped(run, static_cast<int>(run.total_steps())), "");
  EXPECT_GT(run.ledger().residual, 1e-9);
}

}  // namespace
}  // namespace abradem::simulation
