// SPDX-License-Identifier: BSD-3-Clause
// Belts, and what particles do to the walls. docs/verification/walls.md#motion
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "abradem/geometry/generators.h"
#include "abradem/simulation/simulation.h"
#include "support/cases.h"

namespace abradem::test {
namespace {

using namespace simulation;

constexpr double kG = 9.81;

/// A ball at rest on a belt, a mesh or a plane; alone, or as one of an insertion.
simulation::Setup ball_on_belt(bool plane, bool in_numbers) {
  SphereOnMesh scene;
  scene.friction = 0.4;
  scene.shear_modulus = 0.01e9;
  scene.position = {0.0, 0.0, scene.radius};
  scene.gravity = {0.0, 0.0, -kG};
  scene.motion.surface_velocity = {0.5, 0.0, 0.0};
  scene.time_step = 2e-5;
  scene.end = 0.1;
  simulation::Setup setup = scene.setup();
  setup.contacts.push_back({"ball", "ball", 0.4, 0.4, 0.0});
  setup.walls[0].mesh.shape = plane ? MeshShape::plane : MeshShape::plate;
  setup.walls[0].mesh.length = 0.2;
  setup.walls[0].mesh.width = 0.02;
  setup.walls[0].mesh.size = 5e-3;
  setup.walls[0].contact = ContactRule::resolved;
  if (in_numbers) {
    InsertionSetup balls;
    balls.name = "balls";
    balls.material = "ball";
    balls.volume.shape = VolumeShape::file;
    balls.placed = {{scene.position, scene.radius, {}}};
    setup.particles.clear();
    setup.insertions = {balls};
  }
  return setup;
}

struct Motion {
  double v, spin;
};
Motion motion_of(const Simulation& run) {
  if (run.particles().size() > 0) return {run.particles().velocity[0].x, run.particles().spin[0].y};
  const contact::SphereRow& s = run.bulk()->spheres().row[0];
  return {s.velocity().x, s.spin().y};
}

/// Friction speeds the ball up by mu g and spins it back by 5 mu g / 2 R, until its foot keeps up with the
/// belt at 2 U / (7 mu g); then it rolls on at 2/7 of the belt's speed U. While it slips the belt's power is
/// mu m g U.
TEST(Belt, TakesABallAlong) {
  constexpr double U = 0.5, mu = 0.4, R = 3e-3;
  for (const bool plane : {false, true})
    for (const bool in_numbers : {false, true}) {
      SCOPED_TRACE(std::string(plane ? "plane" : "plate") + (in_numbers ? ", in numbers" : ", named"));
      Simulation run(ball_on_belt(plane, in_numbers));
      const double meets = 2.0 * U / (7.0 * mu * kG);
      double settled = 0.0, v = 0.0, power = 0.0, force = 0.0;
      while (!run.finished()) {
        run.step();
        if (settled == 0.0 && run.time() > 0.3 * meets) settled = run.time(), v = motion_of(run).v;
        if (run.time() > 0.3 * meets && run.time() < 0.9 * meets) {
          power = run.load_on_wall(0).power;
          force = -run.load_on_wall(0).force.x;
        }
        if (run.time() < 0.9 * meets || settled < 0.0) continue;
        if (settled > 0.0) {
          EXPECT_NEAR((motion_of(run).v - v) / (run.time() - settled) / (mu * kG), 1.0, 0.01);
          settled = -1.0;
        }
      }
      EXPECT_NEAR(power / (force * U), 1.0, 1e-12);
      EXPECT_NEAR(motion_of(run).v / (2.0 / 7.0 * U), 1.0, 0.01);
      EXPECT_NEAR(motion_of(run).spin * R / (-5.0 / 7.0 * U), 1.0, 0.01);
    }
}

/// At rest the floor carries the weight, and bears its moment about the origin.
TEST(WallLoads, OfABallAtRestAreItsWeightAndItsMoment) {
  for (const bool plane : {false, true})
    for (const bool in_numbers : {false, true}) {
      SCOPED_TRACE(std::string(plane ? "plane" : "plate") + (in_numbers ? ", in numbers" : ", named"));
      simulation::Setup setup = ball_on_belt(plane, in_numbers);
      setup.walls[0].motion = {};
      const Vec3 place{0.02, -0.004, 3e-3};
      if (in_numbers)
        setup.insertions[0].placed[0].position = place;
      else
        setup.particles[0].position = place;
      setup.run.end.value = setup.output.every.value = 0.3;
      Simulation run(setup);
      while (!run.finished()) run.step();
      const double weight = 4850.0 * 4.0 / 3.0 * std::numbers::pi * 27e-9 * kG;
      const Simulation::WallLoad load = run.load_on_wall(0);
      EXPECT_NEAR(load.force.z / -weight, 1.0, 1e-4);
      EXPECT_NEAR(load.torque.x / (-place.y * -weight), -1.0, 1e-3);
      EXPECT_NEAR(load.torque.y / (place.x * weight), 1.0, 1e-3);
      EXPECT_NEAR(load.power, 0.0, 1e-12);
    }
}

/// A ball that rolls to and fro in a turning drum hangs where friction lets it; what the drum's axis feels is
/// the weight times its lever arm plus what speeds the ball up. Over a step: torque = rate of angular
/// momentum.
TEST(WallLoads, TorqueOfADrumBalancesTheBall) {
  SphereOnMesh scene;
  scene.mesh = geometry::make_plate(0.1, 0.02, 5e-3, 1);
  scene.friction = 0.3;
  scene.shear_modulus = 0.01e9;
  scene.position = {0.01, 0.0, scene.radius};
  scene.gravity = {0.0, 0.0, -kG};
  scene.contact = ContactRule::resolved;
  scene.motion.kind = MotionKind::rotation;
  scene.motion.axis = {0.0, 0.0, 1.0};
  scene.motion.rate = 5.0;
  scene.time_step = 2e-5;
  scene.end = 0.05;
  simulation::Setup setup = scene.setup();
  Simulation run(setup, [&](const MeshSetup&, std::uint64_t) { return scene.mesh; });
  const double I = 0.4 * scene.mass() * scene.radius * scene.radius;
  const auto momentum = [&] {
    return scene.mass() * cross(run.particles().position[0], run.particles().velocity[0]).z +
           I * run.particles().spin[0].z;
  };
  double given = 0.0;
  while (!run.finished()) {
    run.step();
    given -= run.load_on_wall(0).torque.z * run.time_step();
  }
  EXPECT_GT(momentum(), 0.0);
  EXPECT_NEAR(given / momentum(), 1.0, 1e-3);
}

}  // namespace
}  // namespace abradem::test
