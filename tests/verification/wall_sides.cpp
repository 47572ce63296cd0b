// SPDX-License-Identifier: BSD-3-Clause
// Thin sheets that are hit from both sides, and closed boxes. docs/verification/walls.md#sides
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/cases.h"
#include "support/surfaces.h"

namespace abradem::test {
namespace {

using namespace simulation;

/// A ball of 1 mm that flies from `from` with `velocity`, alone or as one of an insertion; where it is after
/// `end`.
struct Flight {
  Vec3 position, velocity, spin;
};
Flight fly(const TriangleMesh& mesh, Sides sides, bool in_numbers, const Vec3& from, const Vec3& velocity,
           bool plane = false) {
  SphereOnMesh s;
  s.radius = 1e-3;
  s.contact = ContactRule::resolved;
  s.friction = 0.4;
  s.restitution = 0.7;
  s.position = from;
  s.velocity = velocity;
  s.time_step = 1e-6;
  s.end = 0.01;
  simulation::Setup setup = s.setup();
  setup.walls[0].sides = sides;
  if (plane) setup.walls[0].mesh.shape = MeshShape::plane;
  setup.contacts.push_back({"ball", "ball", 0.5, 0.4, 0.0});
  if (in_numbers) {
    InsertionSetup balls;
    balls.name = "balls";
    balls.material = "ball";
    balls.volume.shape = VolumeShape::file;
    balls.placed = {{from, s.radius, velocity}};
    setup.insertions = {balls};
    setup.particles.clear();
  }
  Simulation run(setup, [&](const MeshSetup&, std::uint64_t) { return mesh; });
  while (!run.finished()) run.step();
  if (!in_numbers) return {run.particles().position[0], run.particles().velocity[0], run.particles().spin[0]};
  const contact::SphereRow& row = run.bulk()->spheres().row[0];
  return {row.position(), row.velocity(), row.spin()};
}

TEST(Sheet, IsHitFromBothSidesAsAPlane) {
  const TriangleMesh sheet = jittered_plate(40e-3, 40e-3, 8e-3, 0.2);
  const Vec3 from{0.7e-3, 0.3e-3, 3e-3}, velocity{0.3, 0.1, -1.0};
  const auto mirrored = [](const Vec3& v) { return Vec3{v.x, v.y, -v.z}; };
  const Flight plane = fly(sheet, Sides::front, false, from, velocity, true);
  EXPECT_GT(plane.velocity.z, 0.5);
  for (const bool in_numbers : {false, true}) {
    const Flight above = fly(sheet, Sides::both, in_numbers, from, velocity);
    const Flight below = fly(sheet, Sides::both, in_numbers, mirrored(from), mirrored(velocity));
    const double front = norm(above.velocity - plane.velocity),
                 behind = norm(mirrored(below.velocity) - plane.velocity),
                 spin = norm(Vec3{-below.spin.x, -below.spin.y, below.spin.z} - plane.spin) * 1e-3;
    measured("sheet, hit in front: velocity against a plane [m/s]", front, 1e-10);
    measured("sheet, hit from behind", behind, 1e-10);
    EXPECT_LT(front, 1e-10);
    EXPECT_LT(behind, 1e-10);
    EXPECT_LT(spin, 1e-10);
    // The surface of a solid is not met from within.
    const Flight within =
        fly(sheet, Sides::front, in_numbers, mirrored(from) * 2.0, mirrored(velocity) * 0.01);
    EXPECT_EQ(within.velocity, mirrored(velocity) * 0.01);
  }
}

TEST(Sheet, TurnsBackWhatMeetsItsBorder) {
  const TriangleMesh sheet = jittered_plate(40e-3, 40e-3, 8e-3, 0.0);
  // In the sheet's plane, and a little above and below it.
  for (const double z : {0.0, 0.1e-3, -0.1e-3}) {
    const Flight ball = fly(sheet, Sides::both, false, {22e-3, 0.3e-3, z}, {-0.5, 0.0, 0.0});
    EXPECT_GT(ball.velocity.x, 0.3) << z;
    EXPECT_TRUE(z == 0.0 ? std::abs(ball.velocity.z) < 1e-12 : ball.velocity.z * z > 0.0) << z;
  }
}

TEST(Sheet, TakesTheResolvedRuleAlone) {
  SphereOnMesh s;
  s.mesh = jittered_plate(40e-3, 40e-3, 8e-3, 0.0);
  s.position = {0, 0, 5e-3};
  simulation::Setup setup = s.setup();
  setup.walls[0].sides = Sides::both;
  EXPECT_THROW(Simulation(setup, [&](const MeshSetup&, std::uint64_t) { return s.mesh; }), InputError);
}

/// Elastic spheres in a box with its normals inwards: none leaves, energy stays, and what they lose of their
/// momentum is what the walls take up.
TEST(ClosedBox, KeepsItsGas) {
  TriangleMesh box = box_mesh(6e-3, 4);
  for (auto& [a, b, c] : box.triangles) std::swap(b, c);
  for (const ContactRule rule : {ContactRule::patch, ContactRule::resolved, ContactRule::automatic}) {
    SphereOnMesh s;
    s.contact = rule;
    s.restitution = 1.0;
    s.time_step = 1e-6;
    s.end = 0.05;
    simulation::Setup setup = s.setup();
    setup.contacts.push_back({"ball", "ball", 1.0, 0.0, 0.0});
    setup.particles.clear();
    InsertionSetup gas;
    gas.name = "gas";
    gas.material = "ball";
    gas.volume.shape = VolumeShape::file;
    core::RandomStream random(5);
    for (int i = 0; i < 64; ++i)
      gas.placed.push_back(
          {{(i % 4 - 1.5) * 2.6e-3, (i / 4 % 4 - 1.5) * 2.6e-3, (i / 16 - 1.5) * 2.6e-3},
           0.8e-3 + 0.1e-3 * (i % 3),
           {random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5)}});
    setup.insertions = {gas};
    Simulation run(setup, [&](const MeshSetup&, std::uint64_t) { return box; });
    const auto momentum = [&] {
      Vec3 p;
      for (const contact::SphereRow& row : run.bulk()->spheres().row) p += row.velocity() / row.inverse_mass;
      return p;
    };
    run.step();
    const Vec3 first = momentum();
    const double energy = run.kinetic_energy() + run.bulk_state().elastic_energy;
    double gross = 0.0, worst = 0.0;
    Vec3 taken;
    std::size_t at_walls = 0;
    while (!run.finished()) {
      run.step();
      const Vec3 impulse = run.load_on_wall(0).force * run.time_step();
      taken += impulse;
      gross += norm(impulse);
      at_walls += run.bulk_state().wall_contacts;
    }
    ASSERT_EQ(run.bulk()->spheres().size(), 64U);
    for (const contact::SphereRow& row : run.bulk()->spheres().row) {
      const Vec3 p = row.position();
      worst = std::max({worst, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    EXPECT_GT(at_walls, 1000U);
    EXPECT_LT(worst, 6e-3 - 0.7e-3);
    // Elastic energy at walls is not in the sum: free flight is waited for by taking the mean of many.
    const double lost = (run.kinetic_energy() + run.bulk_state().elastic_energy) / energy - 1.0;
    const char* name = rule == ContactRule::patch      ? "closed box, patch: energy"
                       : rule == ContactRule::resolved ? "closed box, resolved: energy"
                                                       : "closed box, auto: energy";
    measured(name, lost, 0.01);
    measured("… momentum that spheres lose and walls take up, of the sum of impulses",
             norm(first - momentum() - taken) / gross, 1e-12);
    EXPECT_NEAR(lost, 0.0, 0.01);
    EXPECT_LT(norm(first - momentum() - taken) / gross, 1e-12);
  }
}

/// A ball that falls onto each face, edge and corner of a solid box leaves it outwards.
TEST(ClosedBox, IsASolidFromOutside) {
  const TriangleMesh box = box_mesh(6e-3, 2);
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j)
      for (int k = -1; k <= 1; ++k) {
        if (i == 0 && j == 0 && k == 0) continue;
        const Vec3 n = normalized(Vec3{1.0 * i, 1.0 * j, 1.0 * k});
        const Vec3 foot = 6e-3 * Vec3{1.0 * i, 1.0 * j, 1.0 * k};
        const Flight ball = fly(box, Sides::front, true, foot + 2e-3 * n, -0.5 * n);
        EXPECT_NEAR(dot(ball.velocity, n) / (0.7 * 0.5), 1.0, 0.02) << i << j << k;
        EXPECT_LT(norm(ball.velocity - dot(ball.velocity, n) * n), 1e-10) << i << j << k;
      }
}

}  // namespace
}  // namespace abradem::test
