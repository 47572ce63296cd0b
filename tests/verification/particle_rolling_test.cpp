// SPDX-License-Identifier: BSD-3-Clause
// A sphere that slides, rolls and stops on a plane. Tolerances and measured errors:
// docs/verification/particles.md
#include <gtest/gtest.h>

#include <numbers>

#include "support/reference_data.h"
#include "support/scene_builder.h"

namespace abradem::test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double g = 9.81, R = 5e-3, kTimeStep = 4e-6;
constexpr double kSlipToRoll = 0.01, kRolling = 0.005;
const Elastic kSoft{1e7, 0.3, 2500.0};

/// A sphere that lies on the floor under gravity tilted by theta about y, at its Hertz overlap.
simulation::Simulation lying(const Floor& floor, double theta, const Meeting& meeting, double travel,
                             double end, const Vec3& velocity = {}, const Vec3& spin = {}) {
  const double m = kSoft.density * 4.0 / 3.0 * pi * R * R * R;
  material::PairProperties pair;
  pair.E_eff = kSoft.E / (1.0 - kSoft.nu * kSoft.nu);
  const double overlap = contact::hertz_overlap(pair, R, m * g * std::cos(theta));
  return SceneBuilder()
      .material("sphere", kSoft)
      .rigid("wall", kSoft)
      .meeting("sphere", "wall", meeting)
      .sphere("sphere", R, {0.0, 0.0, R - overlap}, velocity, spin)
      .floor(floor, "wall", std::sqrt(R * overlap), travel)
      .gravity({g * std::sin(theta), 0.0, -g * std::cos(theta)})
      .time(kTimeStep, end)
      .build();
}

void run_to_end(simulation::Simulation& run) {
  while (!run.finished()) run.step();
}

struct Acceleration {
  double linear, angular;  ///< along x [m/s^2], about y [rad/s^2]
};

/// Means over the second half of a run from rest: the start, in which the spring takes up its load, stays
/// out.
Acceleration acceleration_of_second_half(simulation::Simulation& run) {
  while (run.steps() < run.total_steps() / 2) run.step();
  const double v = run.particles().velocity[0].x, w = run.particles().spin[0].y, t = run.time();
  run_to_end(run);
  const double passed = run.time() - t;
  return {(run.particles().velocity[0].x - v) / passed, (run.particles().spin[0].y - w) / passed};
}

/// A sliding sphere rolls after t = 2 v0 / (7 mu g), at 5/7 v0.
TEST(SlipToRoll, EndsWhenAndAsRigidBodiesDo) {
  constexpr double v0 = 0.1;
  WorstError time("end_of_slip"), speed("speed"), spin("spin");
  for (const double mu : {0.2, 0.5})
    for (const Floor& floor : floors()) {
      SCOPED_TRACE(std::string(floor.name) + ", mu = " + std::to_string(mu));
      const double t_s = 2.0 * v0 / (7.0 * mu * g);
      simulation::Simulation run =
          lying(floor, 0.0, {0.5, mu, 0.0}, 1.5 * v0 * t_s, 1.5 * t_s, {v0, 0.0, 0.0});
      double last_slip = 0.0;
      while (!run.finished()) {
        run.step();
        const auto& touches = run.contact(0, 0).touches();
        ASSERT_EQ(touches.size(), 1u);
        if (touches.front().force.slip > 0.0) last_slip = run.time();
      }
      EXPECT_LT(time.note(relative_error(last_slip, t_s)), kSlipToRoll);
      EXPECT_LT(speed.note(relative_error(run.particles().velocity[0].x, 5.0 / 7.0 * v0)), kSlipToRoll);
      EXPECT_LT(spin.note(relative_error(run.particles().spin[0].y * R, 5.0 / 7.0 * v0)), kSlipToRoll);
    }
}

/// tan theta <= 3.5 mu: rolls, a = 5/7 g sin theta.
TEST(Incline, RollsWhereFrictionHolds) {
  WorstError worst("acceleration");
  const double theta = 20.0 * pi / 180.0, a = 5.0 / 7.0 * g * std::sin(theta), end = 0.03;
  for (const Floor& floor : floors()) {
    SCOPED_TRACE(floor.name);
    simulation::Simulation run = lying(floor, theta, {0.5, 0.5, 0.0}, 0.6 * a * end * end, end);
    EXPECT_LT(worst.note(relative_error(acceleration_of_second_half(run).linear, a)), kRolling);
  }
}

/// tan theta > 3.5 mu: slides, a = g (sin theta - mu cos theta), while the spin grows by 2.5 mu g cos theta t
/// / R.
TEST(Incline, SlidesWhereFrictionDoesNotHold) {
  constexpr double mu = 0.1, end = 0.02;
  WorstError worst("acceleration"), spin("spin");
  const double theta = 40.0 * pi / 180.0, a = g * (std::sin(theta) - mu * std::cos(theta));
  for (const Floor& floor : floors()) {
    SCOPED_TRACE(floor.name);
    simulation::Simulation run = lying(floor, theta, {0.5, mu, 0.0}, 0.6 * a * end * end, end);
    const Acceleration measured = acceleration_of_second_half(run);
    EXPECT_LT(worst.note(relative_error(measured.linear, a)), kRolling);
    EXPECT_LT(spin.note(relative_error(measured.angular, 2.5 * mu * g * std::cos(theta) / R)), kRolling);
  }
}

/// With rolling resistance: a = 5/7 g (sin theta - mu_r cos theta).
TEST(Incline, RollingResistanceTakesItsShare) {
  constexpr double end = 0.03;
  WorstError worst("acceleration");
  const double theta = 20.0 * pi / 180.0;
  for (const double mu_r : {0.05, 0.2})
    for (const Floor& floor : floors()) {
      SCOPED_TRACE(std::string(floor.name) + ", mu_r = " + std::to_string(mu_r));
      const double a = 5.0 / 7.0 * g * (std::sin(theta) - mu_r * std::cos(theta));
      simulation::Simulation run = lying(floor, theta, {0.5, 0.8, mu_r}, 0.6 * a * end * end, end);
      EXPECT_LT(worst.note(relative_error(acceleration_of_second_half(run).linear, a)), kRolling);
    }
}

/// mu_r >= tan theta: rests. What remains is compared with the way of a sphere that rolls freely: the
/// displacement of the tangential spring, and a creep at 2.5 g sin theta dt, the speed that the weight gives
/// in one step before the resistance takes it away.
TEST(Incline, RestsWhereRollingResistanceHolds) {
  constexpr double end = 0.03;
  WorstError worst("way");
  const double theta = 10.0 * pi / 180.0, free_way = 0.5 * 5.0 / 7.0 * g * std::sin(theta) * end * end;
  for (const Floor& floor : floors()) {
    SCOPED_TRACE(floor.name);
    simulation::Simulation run = lying(floor, theta, {0.5, 0.8, 0.2}, 0.0, end);
    run_to_end(run);
    EXPECT_LT(worst.note(std::abs(run.particles().position[0].x) / free_way), kRolling);
    EXPECT_LT(std::abs(run.particles().velocity[0].x), 1.01 * 2.5 * g * std::sin(theta) * run.time_step());
  }
}

/// Spinning in place against rolling resistance alone: omega = omega0 - 5 mu_r g t / (2 R), then rest.
TEST(SpinDown, IsLinearAndEndsAtRest) {
  constexpr double mu_r = 0.1, w0 = 20.0, end = 0.03;
  WorstError worst("spin");
  for (const Floor& floor : floors()) {
    SCOPED_TRACE(floor.name);
    simulation::Simulation run = lying(floor, 0.0, {0.5, 0.0, mu_r}, 0.0, 2.0 * end, {}, {0.0, w0, 0.0});
    while (run.steps() < run.total_steps() / 2) run.step();
    const double expected = w0 - 5.0 * mu_r * g * run.time() / (2.0 * R);
    EXPECT_LT(worst.note(relative_error(run.particles().spin[0].y, expected)), kRolling);
    run_to_end(run);
    EXPECT_LT(std::abs(run.particles().spin[0].y), 1e-12 * w0);
  }
}

}  // namespace
}  // namespace abradem::test
