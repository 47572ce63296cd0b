// SPDX-License-Identifier: BSD-3-Clause
// Each watchdog over particles in numbers stops a run that is made to trigger it, and says why.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <string>

#include "abradem/core/archive.h"
#include "abradem/core/error.h"
#include "abradem/simulation/simulation.h"
#include "support/grains.h"
#include "support/says.h"

namespace abradem::simulation {
namespace {

using test::says;

constexpr double R = 2e-3;

/// Steps until it stops. @return the message; empty when it did not within so many steps
std::string stopped(Simulation& run, int steps) {
  try {
    for (int i = 0; i < steps && !run.finished(); ++i) run.step();
  } catch (const SimulationError& error) {
    return error.what();
  }
  return {};
}

/// Spheres at given places, without gravity.
simulation::Setup placed(const std::vector<PlacedSphere>& spheres, double time_step) {
  simulation::Setup setup = test::grains(0.5, 0.3, 0.0);
  setup.insertions[0].placed = spheres;
  setup.run.end = setup.output.every = {1.0, false};
  setup.run.time_step = {time_step, false};
  return setup;
}

double mass() { return 2500.0 * 4.0 / 3.0 * std::numbers::pi * R * R * R; }

/// A plate in the middle of the volume, and a plane across it: what comes in touches neither, now and later.
TEST(BulkInsertion, LeavesRoomForTheWalls) {
  simulation::Setup setup = placed({}, 5e-6);
  InsertionSetup in = setup.insertions[0];
  in.size.radius = R;
  in.volume.high = {0.05, 0.05, 0.05};
  in.number = 120;
  setup.insertions = {in, in};
  setup.insertions[1].number = 20;
  setup.insertions[1].mass_rate = 20.0 * mass() / 1e-4;
  setup.walls = {test::plane("slope", {0, 0, 0.005}, {0.1, 0, 1}), test::plane("plate", {}, {0, 0, 1})};
  MeshSetup& plate = setup.walls[1].mesh;
  plate.shape = MeshShape::plate;
  plate.length = plate.width = 0.1;
  plate.size = 0.03;
  plate.position = {0.025, 0.025, 0.025};
  plate.rotation = {0, 0.4, 0};
  Simulation run(setup);
  while (run.time() < 1.1e-3) run.step();  // tried anew every millisecond
  const contact::Spheres& spheres = run.bulk()->spheres();
  ASSERT_EQ(spheres.size(), 140u);
  const Vec3 n = normalized(Vec3{0.1, 0, 1}), m{std::sin(0.4), 0, std::cos(0.4)};
  for (const contact::SphereRow& s : spheres.row) {
    EXPECT_GE(dot(s.position() - Vec3{0, 0, 0.005}, n), R);
    EXPECT_GE(std::abs(dot(s.position() - plate.position, m)), R);
  }
}

/// Nothing is put into a closed solid, however large against the particles; the same mesh inside out is a
/// container.
TEST(BulkInsertion, KeepsOutOfSolids) {
  const auto cube = [](double from, double to, bool inside_out) {
    geometry::TriangleMesh mesh;
    for (const double z : {from, to})
      for (const double y : {from, to})
        for (const double x : {from, to}) mesh.vertices.push_back({x, y, z});
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    if (inside_out)
      for (geometry::Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
    return mesh;
  };
  simulation::Setup setup = placed({}, 1e-6);
  InsertionSetup& in = setup.insertions[0];
  in.size.radius = R;
  in.volume.high = {0.05, 0.05, 0.05};
  in.number = 200;
  setup.walls = {test::plane("block", {}, {0, 0, 1})};
  setup.walls[0].mesh.shape = MeshShape::file;
  setup.walls[0].contact = ContactRule::resolved;
  const auto inside = [&](bool inside_out) {
    const Simulation run(setup,
                         [&](const MeshSetup&, std::uint64_t) { return cube(0.01, 0.04, inside_out); });
    const contact::Spheres& spheres = run.bulk()->spheres();
    return std::ranges::count_if(spheres.row, [](const contact::SphereRow& s) {
      const Vec3 p = s.position();
      return std::min({p.x, p.y, p.z}) > 0.01 && std::max({p.x, p.y, p.z}) < 0.04;
    });
  };
  EXPECT_EQ(inside(false), 0);
  EXPECT_GT(inside(true), 10);
  setup.walls[0].sides = Sides::both;  // a container of one layer
  EXPECT_GT(inside(false), 10);
  setup.walls[0].sides = Sides::front;
  setup.insertions[0].volume.low = {0.015, 0.015, 0.015};
  setup.insertions[0].volume.high = {0.035, 0.035, 0.035};
  try {
    static_cast<void>(inside(false));
    FAIL();
  } catch (const InputError& e) {
    EXPECT_TRUE(says(e.what(), {"full after 0 of the 200", "A closed mesh is a solid", "sides = \"both\""}));
  }
}

simulation::Setup with_floor(simulation::Setup setup) {
  setup.walls.push_back(test::plane("floor", {0, 0, 0}, {0, 0, 1}));
  return setup;
}

constexpr double kOverlap = 1e-6;

/// Three spheres at rest, pressed together between two planes.
simulation::Setup column(double time_step, Stability stability = Stability::stop) {
  simulation::Setup setup = placed({}, time_step);
  const double pitch = 2.0 * R - kOverlap;
  for (int k = 0; k < 3; ++k) setup.insertions[0].placed.push_back({{0.0, 0.0, k * pitch}, R, {}});
  // Each plane presses with the force of the pairs.
  const contact::PairProperties pair = material::effective_moduli({2500.0, 1e7, 0.25}, {2500.0, 1e7, 0.25});
  const double force = contact::hertz_force(pair, 0.5 * R, kOverlap);
  const double at_plane = contact::hertz_overlap(pair, R, force);
  setup.walls = {test::plane("below", {0, 0, -(R - at_plane)}, {0, 0, 1}),
                 test::plane("above", {0, 0, 2.0 * pitch + (R - at_plane)}, {0, 0, -1})};
  setup.run.stability = stability;
  return setup;
}

/// Damping coefficient [N s/m] and stiffness [N/m] of a contact.
std::pair<double, double> contact_of(double R_eff, double m_eff, double overlap) {
  const contact::PairProperties p = material::effective_moduli({2500.0, 1e7, 0.25}, {2500.0, 1e7, 0.25});
  const double S = 2.0 * p.E_eff * std::sqrt(R_eff * overlap);
  const double beta = material::damping_ratio(0.5);
  return {2.0 * std::sqrt(5.0 / 6.0) * beta * std::sqrt(S * m_eff), S};
}

/// The largest eigenvalue of M^-1 (2 C dt + K dt^2) of the column, by iteration on its three coordinates.
double column_number(double dt) {
  const auto [c, S] = contact_of(0.5 * R, 0.5 * mass(), kOverlap);
  const contact::PairProperties p = material::effective_moduli({2500.0, 1e7, 0.25}, {2500.0, 1e7, 0.25});
  const auto [cw, Sw] =
      contact_of(R, mass(), contact::hertz_overlap(p, R, contact::hertz_force(p, 0.5 * R, kOverlap)));
  const double inner = (2.0 * c * dt + S * dt * dt) / mass(), wall = (2.0 * cw * dt + Sw * dt * dt) / mass();
  double x[3] = {-1.0, 1.1, -1.2}, number = 0.0;
  for (int k = 0; k < 2000; ++k) {
    const double y[3] = {(wall + inner) * x[0] - inner * x[1], 2.0 * inner * x[1] - inner * (x[0] + x[2]),
                         (wall + inner) * x[2] - inner * x[1]};
    number = std::sqrt(y[0] * y[0] + y[1] * y[1] + y[2] * y[2]);
    for (int i = 0; i < 3; ++i) x[i] = y[i] / number;
  }
  return number;
}

/// The step at which that is 4.
double stable_step() {
  double low = 1e-7, high = 1e-2;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (column_number(middle) < 4.0 ? low : high) = middle;
  }
  return low;
}

TEST(BulkWatchdog, AStepTooLongForPairsStopsTheRunAndAShorterOneDoesNot) {
  // The watch knows the spheres pair by pair: it sees some four fifths of the column's largest eigenvalue.
  Simulation below(column(0.98 * stable_step()));
  EXPECT_EQ(stopped(below, 3000), "");
  Simulation above(column(1.3 * stable_step()));
  EXPECT_TRUE(says(stopped(above, 400), {"particle ", " mm, step ", "the time step is too long: 2g + W = ",
                                         "in its contact with ", "a disturbance has grown a thousandfold",
                                         "Take run.time_step below", "run.stability = \"warn\""}));
  EXPECT_GT(above.limits().back().value, 4.0);
}

TEST(BulkWatchdog, TheAdvisedStepIsStable) {
  Simulation above(column(1.3 * stable_step()));
  const std::string text = stopped(above, 400);
  const std::size_t at = text.find("run.time_step below ");
  ASSERT_NE(at, std::string::npos);
  const double advised = std::stod(text.substr(at + 20));
  EXPECT_GT(advised, 0.8 * stable_step());
  EXPECT_LT(advised, 1.2 * stable_step());
}

TEST(BulkWatchdog, AStepTooLongIsAWarningWhereTheCaseSaysSo) {
  Simulation run(column(1.1 * stable_step(), Stability::warn));
  EXPECT_EQ(stopped(run, 400), "");
  EXPECT_FALSE(run.limits().back().ok());
}

TEST(BulkWatchdog, ShortPeaksInImpactsAreNoInstability) {
  // Two spheres meet head on; at their deepest the step is too long for them, for some steps.
  simulation::Setup setup = placed({{{0, 0, 0}, R, {0.3, 0, 0}}, {{2.02 * R, 0, 0}, R, {-0.3, 0, 0}}}, 0.0);
  setup.run.time_step = {1.6e-4, false};
  Simulation run(setup);
  EXPECT_EQ(stopped(run, 60), "");
  EXPECT_GT(run.limits().back().value, 4.0);
  EXPECT_EQ(run.bulk_state().pair_contacts, 0U);
  EXPECT_LT(run.bulk()->spheres().row[0].vx * run.bulk()->spheres().row[1].vx, 0.0);
}

TEST(BulkWatchdog, LimitsOfAnImpactAreForeseenAndMet) {
  // 0.6 m/s between equal spheres: T_H = 2.87 (m^2 / (R E*^2 v))^(1/5) with half of mass and radius.
  const contact::PairProperties pair = material::effective_moduli({2500.0, 1e7, 0.25}, {2500.0, 1e7, 0.25});
  const double time = material::hertz_time(pair.E_eff, 0.5 * R, 0.5 * mass(), 0.6);
  simulation::Setup setup = placed({{{0, 0, 0}, R, {0.6, 0, 0}}, {{2.1 * R, 0, 0}, R, {}}}, 0.2 * time);
  Simulation run(setup);
  const std::vector<StabilityLimit> before = run.limits();
  EXPECT_NEAR(before[1].value, 0.2, 1e-5);
  EXPECT_FALSE(before[1].ok());
  EXPECT_TRUE(before[2].ok());
  ASSERT_EQ(stopped(run, 30), "");
  EXPECT_NEAR(run.limits()[1].value, 0.2, 1e-5);
  // Foreseen for an impact without damping; met with it, and at whole steps.
  EXPECT_NEAR(0.5 * before[2].value, run.limits()[2].value, 0.15 * before[2].value);
}

TEST(BulkWatchdog, ExplodingEnergyStopsInTheSameStep) {
  simulation::Setup setup =
      with_floor(placed({{{0, 0, 2.0 * R}, R, {}}, {{8.0 * R, 0, 3.0 * R}, R, {}}}, 1e-6));
  setup.run.gravity = {0.0, 0.0, -9.81};
  setup.domain = DomainSetup{{-0.05, -0.05, -0.01}, {0.05, 0.05, 0.05}, Outside::remove};
  Simulation run(setup);
  ASSERT_EQ(stopped(run, 100), "");
  core::ArchiveWriter saved;
  run.save(saved);
  // In a copy of the state one of them has a speed that no fall from the domain's roof gives.
  std::string bytes = saved.bytes();
  const double falls = run.bulk()->spheres().row[1].vz, shot = -60.0;
  std::string pattern(sizeof falls, '\0');
  std::memcpy(pattern.data(), &falls, sizeof falls);
  std::size_t at = bytes.rfind(pattern, bytes.find("radius"));
  at = at == std::string::npos ? bytes.find(pattern) : at;
  ASSERT_NE(at, std::string::npos);
  std::memcpy(bytes.data() + at, &shot, sizeof shot);
  Simulation wrong(setup);
  core::ArchiveReader archive(bytes);
  wrong.load(archive);
  EXPECT_TRUE(says(stopped(wrong, 1), {"particle ", "step 100", "its energy explodes: ", "at 60 m/s",
                                       "a hundred times what its start, gravity and the walls can give it"}));
  EXPECT_EQ(wrong.steps(), 100U);
}

TEST(BulkWatchdog, NoEnergyOfAFallThroughTheDomainOrOfAWallThatHitsIsTakenForAnExplosion) {
  simulation::Setup setup = with_floor(placed({{{0, 0, 0.06}, R, {}}, {{0, 0, 0.6 * R}, 0.5 * R, {}}}, 2e-6));
  setup.run.gravity = {0.0, 0.0, -9.81};
  setup.domain = DomainSetup{{-0.05, -0.05, -0.01}, {0.05, 0.05, 0.07}, Outside::remove};
  setup.walls[0].motion.kind = MotionKind::oscillation;
  setup.walls[0].motion.amplitude = {0.0, 0.0, 1e-3};
  setup.walls[0].motion.frequency = 100.0;
  setup.run.end = {0.25, false};
  Simulation run(setup);
  EXPECT_EQ(stopped(run, 125000), "");
}

TEST(BulkWatchdog, WhatIsFastEnoughToPassThroughAWallIsStoppedBefore) {
  Simulation run(with_floor(placed({{{0, 0, 4.0 * R}, R, {0, 0, -250.0}}}, 1e-6)));
  EXPECT_TRUE(says(stopped(run, 1), {"particle 0 at (", "it moves 0.25 mm in one step, more than a tenth"}));
  EXPECT_EQ(run.steps(), 0U);
}

TEST(BulkWatchdog, AWallThatIsFastEnoughToPassThroughParticlesIsStoppedBefore) {
  simulation::Setup setup = with_floor(placed({{{0, 0, 0.05}, R, {}}}, 1e-6));
  setup.walls[0].motion.kind = MotionKind::translation;
  setup.walls[0].motion.velocity = {0.0, 0.0, 2500.0};
  Simulation run(setup);
  EXPECT_TRUE(says(stopped(run, 1), {"particle 0 at (", "step 0",
                                     "wall 'floor' moves past it by 2.5 mm in one "
                                     "step, more than its radius"}));
}

TEST(BulkWatchdog, TooDeepAnOverlapIsNamedWithTheWall) {
  Simulation plane(with_floor(placed({{{0, 0, 0.89 * R}, R, {}}, {{9.0 * R, 0, 2.0 * R}, R, {}}}, 1e-6)));
  EXPECT_TRUE(says(stopped(plane, 1), {"particle 0 at (", "its overlap with wall 'floor' is 0.2",
                                       "more than a tenth of its radius"}));
  simulation::Setup setup = placed({{{0, 0, 0.89 * R}, R, {}}}, 1e-6);
  setup.walls.push_back(test::plane("floor", {0, 0, 0}, {0, 0, 1}));
  setup.walls[0].mesh.shape = MeshShape::plate;
  setup.walls[0].mesh.length = setup.walls[0].mesh.width = 20e-3;
  setup.walls[0].mesh.size = 4e-3;
  setup.walls[0].contact = ContactRule::resolved;
  Simulation mesh(setup);
  EXPECT_TRUE(says(stopped(mesh, 1),
                   {"particle 0 at (", "its overlap with wall 'floor' is 0.22 mm", "Shorten the time step"}));
  // From behind a mesh whose normals point the other way.
  setup.insertions[0].placed[0].position.z = 0.3 * R;
  Simulation behind(setup);
  EXPECT_TRUE(says(stopped(behind, 1), {"its overlap with wall 'floor' is 1.4 mm",
                                        "Do the normals of its triangles", "sides = \"both\""}));
}

TEST(BulkWatchdog, TwoSpheresInOneAnotherStopTheRun) {
  Simulation run(placed({{{0, 0, 0}, R, {}}, {{1.85 * R, 0, 0}, R, {}}}, 1e-6));
  EXPECT_TRUE(says(stopped(run, 1), {"particle 0 at (", "its overlap with particle 1 is 0.2999 mm"}));
}

}  // namespace
}  // namespace abradem::simulation
