// SPDX-License-Identifier: BSD-3-Clause
// What the integration conserves, and how its error falls with the time step. docs/verification/particles.md
#include <gtest/gtest.h>

#include <array>
#include <numbers>

#include "support/reference_data.h"
#include "support/scene_builder.h"

namespace abradem::test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double R = 0.01;
const Elastic kGlass{48e9, 0.2, 2800.0};

double mass_of(const Elastic& m) { return m.density * 4.0 / 3.0 * pi * R * R * R; }

/// Two glass spheres of radius 10 mm that meet at 45 degrees to their line of centres, 20 m/s along it.
SceneBuilder oblique_pair(const Meeting& meeting) {
  return SceneBuilder()
      .material("glass", kGlass)
      .meeting("glass", "glass", meeting)
      .sphere("glass", R, {0.0, 0.0, R}, {10.0, 3.0, -10.0}, {100.0, -50.0, 30.0})
      .sphere("glass", R, {0.0, 0.0, -R}, {-10.0, -3.0, 10.0}, {20.0, 70.0, -40.0});
}

HertzImpact hertz() {
  return {kGlass.E / (2.0 * (1.0 - kGlass.nu * kGlass.nu)), R / 2.0, mass_of(kGlass) / 2.0, 20.0};
}

double gap(const simulation::Simulation& run) {
  return norm(run.particles().position[0] - run.particles().position[1]) - 2.0 * R;
}

Vec3 linear_momentum(const simulation::Simulation& run) {
  const auto& p = run.particles();
  return p.mass[0] * p.velocity[0] + p.mass[1] * p.velocity[1];
}

Vec3 angular_momentum(const simulation::Simulation& run) {
  const auto& p = run.particles();
  Vec3 sum;
  for (std::size_t i = 0; i < p.size(); ++i)
    sum += p.mass[i] * (cross(p.position[i], p.velocity[i]) + 0.4 * p.radius[i] * p.radius[i] * p.spin[i]);
  return sum;
}

/// Without friction and damping the pair keeps its energy; measured 1e-9 at 1000 steps per contact.
TEST(TwoSpheres, KeepTheirEnergyWithoutDamping) {
  simulation::Simulation run =
      oblique_pair({1.0, 0.0, 0.0}).time(hertz().duration / 1000.0, 2.0 * hertz().duration).build();
  const double before = run.kinetic_energy();
  ASSERT_TRUE(run_impact(run, gap).ended);
  WorstError energy("energy");
  EXPECT_LT(energy.note(relative_error(run.kinetic_energy(), before)), 1e-6);
}

/// Action is reaction: linear momentum to round-off whatever friction and damping. Angular momentum to the
/// size of the overlap beside the radius, because both lever arms are R although the centres are 2 R - delta
/// apart; the error is exactly the sum of delta n x F_t dt.
TEST(TwoSpheres, KeepTheirMomentum) {
  simulation::Simulation run =
      oblique_pair({0.7, 0.35, 0.05}).time(hertz().duration / 1000.0, 2.0 * hertz().duration).build();
  const Vec3 before = angular_momentum(run);
  const double scale = run.particles().mass[0] * 10.0;
  Vec3 explained;
  double deepest = 0.0, exchanged = 0.0;
  double now = gap(run);
  WorstError linear("linear"), angular("angular"), unexplained("unexplained");
  do {
    const Vec3 n = normalized(run.particles().position[0] - run.particles().position[1]);
    const double delta = std::max(0.0, -now);
    run.step();
    const Vec3 F = run.particles().force[0];
    explained += cross(-delta * n, F - dot(F, n) * n) * run.time_step();
    exchanged += R * norm(F - dot(F, n) * n) * run.time_step();
    deepest = std::max(deepest, delta);
    EXPECT_LT(linear.note(norm(linear_momentum(run)) / scale), 1e-13);
    now = gap(run);
  } while (now < 0.0 && !run.finished());
  ASSERT_GE(now, 0.0);
  const Vec3 error = angular_momentum(run) - before;
  EXPECT_LT(angular.note(norm(error) / exchanged), deepest / R);
  EXPECT_GT(norm(error), 0.0);
  EXPECT_LT(unexplained.note(norm(error - explained) / norm(error)), 1e-6);
}

/// Place of the first sphere after 0.8 of a Hertz contact time, in n steps.
Vec3 place_in_contact(const Meeting& meeting, int n) {
  const double end = 0.8 * hertz().duration;
  simulation::Simulation run = oblique_pair(meeting).time(end / n, end).build();
  for (int i = 0; i < n; ++i) run.step();
  return run.particles().position[0];
}

/// Order of convergence from three steps, each half of the one before.
double order_of(const Meeting& meeting, int n) {
  const std::array<Vec3, 3> x{place_in_contact(meeting, n), place_in_contact(meeting, 2 * n),
                              place_in_contact(meeting, 4 * n)};
  return std::log2(norm(x[0] - x[1]) / norm(x[1] - x[2]));
}

/// Second order for elastic impacts, as symplectic Euler started at the first touch is leapfrog.
TEST(Integrator, IsOfSecondOrderForAnElasticContact) {
  WorstError order("order");
  EXPECT_NEAR(order.note(order_of({1.0, 0.0, 0.0}, 200)), 2.0, 0.1);
}

/// First order with damping and friction: the damper and the spring see the speed of half a step ago.
TEST(Integrator, IsOfFirstOrderWithDampingAndFriction) {
  WorstError damped("damped"), frictional("frictional");
  EXPECT_NEAR(damped.note(order_of({0.7, 0.0, 0.0}, 200)), 1.0, 0.1);
  EXPECT_NEAR(frictional.note(order_of({0.7, 10.0, 0.0}, 200)), 1.0, 0.1);
}

}  // namespace
}  // namespace abradem::test
