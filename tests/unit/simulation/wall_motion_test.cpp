// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/simulation/wall_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "abradem/core/error.h"
#include "abradem/core/random.h"
#include "abradem/simulation/wall.h"

namespace abradem::simulation {
namespace {

using std::numbers::pi;

MotionSetup rotation(const Vec3& axis, const Vec3& center, double rate) {
  MotionSetup m;
  m.kind = MotionKind::rotation;
  m.axis = normalized(axis);
  m.center = center;
  m.rate = rate;
  return m;
}

MotionSetup oscillation(const Vec3& amplitude, double frequency) {
  MotionSetup m;
  m.kind = MotionKind::oscillation;
  m.amplitude = amplitude;
  m.frequency = frequency;
  return m;
}

MotionSetup translation(const Vec3& velocity) {
  MotionSetup m;
  m.kind = MotionKind::translation;
  m.velocity = velocity;
  return m;
}

/// A ride that shifts and turns at once, and comes back.
MotionSetup ride(TableEnd after) {
  MotionSetup m;
  m.kind = MotionKind::table;
  m.axis = normalized(Vec3{0.2, 1.0, -0.1});
  m.center = {0.05, 0.0, 0.02};
  m.rows = {{0.1, {}, 0.0},
            {0.3, {0.02, 0.0, -0.01}, 0.4},
            {0.35, {0.02, 0.0, -0.01}, 0.4},
            {0.8, {-0.01, 0.03, 0.0}, -0.7},
            {1.0, {}, 0.0}};
  m.after = after;
  return m;
}

WallSetup wall_with(std::vector<MotionSetup> motions) {
  WallSetup wall;
  wall.motion = motions.front();
  wall.carried_by.assign(motions.begin() + 1, motions.end());
  return wall;
}

std::vector<WallSetup> walls() {
  MotionSetup rocking = ride(TableEnd::repeat);
  rocking.axis = {0.0, 1.0, 0.0};
  return {wall_with({ride(TableEnd::hold)}),
          wall_with({ride(TableEnd::repeat)}),
          wall_with({rotation({0, 0, 1}, {0.1, 0, 0}, 3.0), rotation({1, 2, 0}, {0, 0.1, 0}, -1.3)}),
          wall_with({rotation({0, 1, 0}, {}, 2.0), rocking, oscillation({0, 0, 3e-3}, 7.0)}),
          wall_with({{}, oscillation({1e-3, 0, 2e-3}, 25.0)}),
          wall_with({translation({0.1, 0.2, 0}), oscillation({0, 0, 4e-3}, 5.0),
                     rotation({0, 0, 1}, {0.02, 0, 0}, 1.0)})};
}

/// Fourth-order differences of where a material point is.
TEST(WallMotion, VelocityIsTheDerivativeOfThePose) {
  core::RandomStream random(1, 0);
  const auto coordinate = [&] { return 0.4 * random.uniform() - 0.2; };
  double worst = 0.0;
  for (const WallSetup& wall : walls())
    for (int sample = 0; sample < 400; ++sample) {
      const double t = 2.2 * random.uniform(), h = 1e-4;
      bool kink = false;  // of a table, near which the path is not smooth
      for (std::size_t k = 0; k < wall.motions(); ++k)
        for (const MotionRow& row : wall.motion_at(k).rows)
          for (const double period : {0.0, 0.9, 1.8})
            kink = kink || std::abs(t - period - row.time) < 3.0 * h;
      if (kink) continue;
      const Vec3 point{coordinate(), coordinate(), coordinate()};
      const auto at = [&](double time) { return pose_of(wall, wall.motions(), time).to_world(point); };
      const Vec3 v = (8.0 * (at(t + h) - at(t - h)) - (at(t + 2 * h) - at(t - 2 * h))) / (12.0 * h);
      const geometry::Pose pose = pose_of(wall, wall.motions(), t);
      worst = std::max(worst, norm(pose.velocity_at(at(t)) - v));
      EXPECT_NEAR(norm(pose.to_body(at(t)) - point), 0.0, 1e-15);
    }
  EXPECT_LT(worst, 1e-6);  // [m/s], of up to 0.9
}

/// What the search for contacts and the watch of energies take for granted.
TEST(WallMotion, LimitsAreNeverExceeded) {
  for (const WallSetup& wall : walls())
    for (std::size_t k = 0; k < wall.motions(); ++k) {
      const MotionSetup& m = wall.motion_at(k);
      const MotionLimits most = limits_of(m);
      double speed = 0.0, rate = 0.0;
      for (int i = 0; i < 20000; ++i) {
        const geometry::Pose pose = pose_of(m, 1.1e-4 * i);
        speed = std::max(speed, norm(pose.velocity));
        rate = std::max(rate, norm(pose.spin));
        ASSERT_LE(norm(pose.velocity), most.speed * (1.0 + 1e-12));
        ASSERT_LE(norm(pose.spin), most.rate * (1.0 + 1e-12));
        ASSERT_LE(norm(pose.shift), most.displacement * (1.0 + 1e-12));
      }
      EXPECT_GE(speed, 0.99 * most.speed);  // and no looser than they need be
      EXPECT_GE(rate, 0.99 * most.rate);
    }
}

TEST(WallMotion, MotionsAreAppliedOneAfterTheOther) {
  // A quarter turn, then a quarter turn about another axis: the point is carried by both.
  const WallSetup wall =
      wall_with({rotation({0, 0, 1}, {}, 0.5 * pi), rotation({1, 0, 0}, {0, 0, 1}, 0.5 * pi)});
  const Vec3 x = pose_of(wall, 2, 1.0).to_world({1, 0, 0});
  EXPECT_NEAR(norm(x - Vec3{0, 1, 2}), 0.0, 1e-15);  // (1,0,0) -> (0,1,0) -> about (0,0,1): (0,1,2)
}

TEST(WallMotion, ATableHoldsItsFirstRowAndItsLastOrRepeats) {
  const WallSetup once = wall_with({ride(TableEnd::hold)}), again = wall_with({ride(TableEnd::repeat)});
  for (const double t : {0.0, 0.05, 1.0, 7.0}) {
    const geometry::Pose pose = pose_of(once, 1, t);
    EXPECT_EQ(pose.shift, Vec3{}) << t;
    EXPECT_EQ(pose.velocity, Vec3{}) << t;
    EXPECT_EQ(pose.spin, Vec3{}) << t;
  }
  for (const double t : {0.2, 0.33, 0.7, 0.95}) {
    const geometry::Pose first = pose_of(again, 1, t), later = pose_of(again, 1, t + 3 * 0.9);
    EXPECT_NEAR(norm(first.shift - later.shift), 0.0, 1e-14);
    EXPECT_NEAR(norm(first.spin - later.spin), 0.0, 1e-14);
  }
  EXPECT_NEAR(pose_of(once, 1, 0.2).shift.x, 0.01, 1e-15);
  EXPECT_NEAR(pose_of(once, 1, 0.2).velocity.x, 0.1, 1e-15);
  EXPECT_NEAR(norm(pose_of(once, 1, 0.2).spin), 2.0, 1e-12);
}

TEST(WallMotion, CountsTheFirstThatTurnsOrOscillates) {
  const auto all = walls();
  EXPECT_EQ(period_of(all[0]), std::nullopt);
  EXPECT_DOUBLE_EQ(*period_of(all[3]), pi);
  EXPECT_DOUBLE_EQ(*period_of(all[4]), 0.04);
  EXPECT_DOUBLE_EQ(*period_of(all[5]), 0.2);
  EXPECT_EQ(leading_motion(all[4]).kind, MotionKind::oscillation);
}

TEST(WallMotion, RefusesTablesThatAreNone) {
  const auto problem = [](auto&& change) {
    MotionSetup m = ride(TableEnd::repeat);
    change(m);
    const auto found = problem_of_table(m);
    return found ? found->what : std::string();
  };
  EXPECT_EQ(problem([](MotionSetup&) {}), "");
  EXPECT_EQ(problem([](MotionSetup& m) { m.rows.back().angle = -4.0 * pi; }), "");
  EXPECT_NE(problem([](MotionSetup& m) { m.rows.clear(); }), "");
  EXPECT_NE(problem([](MotionSetup& m) { m.rows[2].time = 0.3; }).find("ascend: 0.3 s comes after 0.3 s"),
            std::string::npos);
  EXPECT_NE(problem([](MotionSetup& m) { m.rows.back().angle = 1.0; }).find("57.3 degrees away"),
            std::string::npos);
  EXPECT_NE(problem([](MotionSetup& m) { m.rows[1].angle = NAN; }), "");
  MotionSetup bad = ride(TableEnd::hold);
  bad.rows[1].time = 0.0;
  EXPECT_THROW(Wall(wall_with({{}, bad}), 0, generate_mesh, 1), InputError);
}

}  // namespace
}  // namespace abradem::simulation
