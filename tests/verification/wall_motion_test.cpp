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

MotionSetup turning(const Vec3& axis, double rate) {
  MotionSetup m;
  m.kind = MotionKind::rotation;
  m.axis = axis;
  m.rate = rate;
  return m;
}

/// Where a ball that is taken along by a plate goes; the plate as one motion or as several that are the same.
Vec3 taken_along(const std::vector<MotionSetup>& motions, bool in_numbers) {
  simulation::Setup setup = ball_on_belt(false, in_numbers);
  setup.walls[0].mesh.width = 0.2;
  setup.walls[0].motion = motions.front();
  setup.walls[0].carried_by.assign(motions.begin() + 1, motions.end());
  setup.run.end.value = setup.output.every.value = 0.2;
  Simulation run(setup);
  while (!run.finished()) run.step();
  return in_numbers ? run.bulk()->spheres().row[0].position() : run.particles().position[0];
}

TEST(Motions, OfTheSamePathMoveABallAlike) {
  constexpr Vec3 z{0, 0, 1}, far{0.03, 0.01, 0};
  MotionSetup whole = turning(z, 3.0), part = turning(z, 1.2), rest = turning(z, 1.8), table;
  for (MotionSetup* m : {&whole, &part, &rest, &table}) m->center = far;
  table.kind = MotionKind::table;
  for (int r = 0; r <= 4; ++r) table.rows.push_back({0.06 * r, {}, 0.18 * r});
  MotionSetup shift, first, second;
  shift.kind = first.kind = MotionKind::translation;
  shift.velocity = {0.1, 0.02, 0};
  first.velocity = {0.1, 0, 0};
  second.kind = MotionKind::table;
  second.rows = {{0.0, {}, 0.0}, {0.07, {0, 0.0014, 0}, 0.0}, {0.4, {0, 0.008, 0}, 0.0}};
  for (const bool in_numbers : {false, true}) {
    SCOPED_TRACE(in_numbers ? "in numbers" : "named");
    const Vec3 turned = taken_along({whole}, in_numbers), shifted = taken_along({shift}, in_numbers);
    EXPECT_GT(norm(turned), 5e-3);
    const double by_two = norm(taken_along({part, rest}, in_numbers) - turned);
    const double by_table = norm(taken_along({table}, in_numbers) - turned);
    const double by_shifts = norm(taken_along({first, second}, in_numbers) - shifted);
    measured("a turn as two that carry each other: way of a ball [m]", by_two, 1e-11);
    measured("a turn as a table", by_table, 1e-11);
    measured("a shift as a shift and a table", by_shifts, 1e-11);
    EXPECT_LT(by_two, 1e-11);
    EXPECT_LT(by_table, 1e-11);
    EXPECT_LT(by_shifts, 1e-11);
  }
}

/// Particles look for walls again when they or the walls may have moved by the skin: what a wall can do in
/// that time must never be more than its bound.
TEST(Motions, NoWallComesCloserFasterThanItsBound) {
  MotionSetup rocking;
  rocking.kind = MotionKind::table;
  rocking.axis = {0, 1, 0};
  rocking.center = {-0.05, 0, 0};
  rocking.after = TableEnd::repeat;
  rocking.rows = {{0.0, {}, 0.0}, {0.02, {0, 0, 2e-3}, 0.03}, {0.05, {0, 1e-3, 0}, -0.02}, {0.06, {}, 0.0}};
  MotionSetup shaking;
  shaking.kind = MotionKind::oscillation;
  shaking.amplitude = {0, 0, 0.5e-3};
  shaking.frequency = 40.0;
  for (const bool plane : {false, true}) {
    simulation::Setup setup = ball_on_belt(plane, true);
    setup.walls[0].mesh.width = 0.2;
    setup.walls[0].motion = turning({0, 0, 1}, 4.0);
    setup.walls[0].carried_by = {rocking, shaking};
    setup.insertions[0].placed.clear();
    for (int i = -2; i <= 2; ++i)
      for (int j = -2; j <= 2; ++j)
        setup.insertions[0].placed.push_back({{0.016 * i, 0.016 * j, 4e-3}, 3e-3, {}});
    setup.run.end.value = setup.output.every.value = 0.15;
    Simulation run(setup);
    double worst = 0.0;
    while (!run.finished()) {
      run.step();
      const geometry::Pose pose = run.walls()[0].pose_at(run.time() - run.time_step());
      const BulkWalls& walls = run.bulk()->walls();
      for (const contact::SphereRow& s : run.bulk()->spheres().row)
        worst = std::max(worst, norm(pose.velocity_at(s.position())) / walls.fastest_wall());
    }
    measured(
        plane ? "largest speed of a wall over its bound, plane" : "largest speed of a wall over its bound",
        worst, 1.0);
    EXPECT_LE(worst, 1.0);
    EXPECT_GT(worst, 0.3);
  }
}

/// A chute: a plate turned by the keys of its placement is the plane that it stands for.
TEST(Placement, ATurnedPlateIsAnInclinedPlane) {
  constexpr double slope = 30.0 * std::numbers::pi / 180.0;
  const Vec3 n{std::sin(slope), 0.0, std::cos(slope)}, at{0.1, 0.0, 0.05};
  Vec3 end[2];
  for (const bool plane : {false, true}) {
    simulation::Setup setup = ball_on_belt(plane, false);
    setup.walls[0].motion = {};
    setup.contacts[0].static_friction = 0.0;
    setup.walls[0].mesh.length = 0.4;
    setup.walls[0].mesh.position = at;
    setup.walls[0].mesh.normal = n;
    if (!plane) setup.walls[0].mesh.rotation = {0.0, slope, 0.0};
    setup.particles[0].position = at + (3e-3 - 1e-8) * n;
    setup.run.end.value = setup.output.every.value = 0.2;
    Simulation run(setup);
    while (!run.finished()) run.step();
    end[plane ? 1 : 0] = run.particles().position[0];
    const Vec3 way = run.particles().position[0] - setup.particles[0].position;
    EXPECT_NEAR(dot(way, {std::cos(slope), 0, -std::sin(slope)}) / (0.5 * kG * std::sin(slope) * 0.04), 1.0,
                1e-3);
  }
  measured("plate turned by 30 degrees against a plane: end of a slide [m]", norm(end[0] - end[1]), 1e-12);
  EXPECT_LT(norm(end[0] - end[1]), 1e-12);
}

/// About x, then y, then z, axes that stay.
TEST(Placement, TurnsAboutFixedAxesInTheirOrder) {
  geometry::TriangleMesh mesh;
  mesh.vertices = {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 1, 2}};
  MeshSetup setup;
  constexpr double quarter = 0.5 * std::numbers::pi;
  setup.rotation = {quarter, quarter, quarter};
  setup.position = {5, 0, 0};
  place(mesh, setup);
  // y -> z (about x) -> x (about y) -> y (about z); x -> x -> -z -> -z; z -> -y -> -y -> x.
  EXPECT_LT(norm(mesh.vertices[0] - Vec3{5, 1, 0}), 1e-15);
  EXPECT_LT(norm(mesh.vertices[1] - Vec3{5, 0, -1}), 1e-15);
  EXPECT_LT(norm(mesh.vertices[2] - Vec3{6, 0, 0}), 1e-15);
}

}  // namespace
}  // namespace abradem::test
