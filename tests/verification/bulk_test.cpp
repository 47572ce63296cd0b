// SPDX-License-Identifier: BSD-3-Clause
// Particles in numbers. docs/verification/bulk.md
#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "support/grains.h"

namespace abradem::test {
namespace {

using namespace simulation;

TEST(Bulk, ClosedSystemKeepsMomentumAndEnergy) {
  // A gas of elastic grains without friction, of two sizes, in empty space.
  simulation::Setup setup = grains(1.0, 0.0, 0.0);
  setup.insertions[0].placed = lattice(1000, 10, 3e-3, 6.15e-3, 0.3);
  for (std::size_t k = 0; k < 1000; k += 3) setup.insertions[0].placed[k].radius = 2e-3;
  Simulation run(setup);
  double scale = 0.0;
  for (const contact::SphereRow& s : run.bulk()->spheres().row) scale += norm(s.velocity()) / s.inverse_mass;
  const Vec3 p = momentum(run);
  const double energy = run.kinetic_energy();
  std::uint64_t most = 0;
  for (int k = 0; k < 600; ++k) {
    run.step();
    if (k % 20 == 0) most = std::max(most, run.bulk_state().pair_contacts);
  }
  const BulkState end = run.bulk_state();
  EXPECT_GT(most, 100u);                              // they do meet
  EXPECT_LT(norm(momentum(run) - p) / scale, 1e-13);  // action is reaction
  const double error = std::abs(end.kinetic_energy + end.elastic_energy - energy) / energy;
  EXPECT_LT(error, 2e-3);  // second order in the step, of which an impact takes some tens
  RecordProperty("energy_error", std::to_string(error));
}

/// Two grains of two insertions, of different material and size, meet head-on without damping: Hertz's
/// overlap and time with E_eff, R_eff and m_eff of the pair, and the velocities of an elastic impact.
TEST(Bulk, GrainsOfTwoMaterialsMeetAsHertzSays) {
  simulation::Setup setup = grains(1.0, 0.0, 0.0);
  setup.walls = {plane("floor", {0, 0, -1}, {0, 0, 1})};
  setup.materials.push_back({"ore", 4500.0, 3e7, 0.35, {}});
  setup.contacts.push_back({"ore", "grain", 1.0, 0.0, 0.0});
  setup.contacts.push_back({"ore", "ore", 0.1, 0.9, 0.1});  // none of theirs
  const double R1 = 3e-3, R2 = 2e-3, v = 0.2;
  setup.insertions[0].placed = {{{0, 0, 0}, R1, {v, 0, 0}}};
  setup.insertions.push_back(setup.insertions[0]);
  setup.insertions[1].name = "ore";
  setup.insertions[1].material = "ore";
  setup.insertions[1].placed = {{{R1 + R2 + 1e-6, 0, 0}, R2, {}}};
  setup.run.time_step = {0.01, true};
  Simulation run(setup);
  const auto speed = [&](int id) {
    const contact::Spheres& s = run.bulk()->spheres();
    return s.row[s.id[0] == id ? 0 : 1].vx;
  };
  double deepest = 0.0;
  int steps = 0;
  while (run.bulk_state().pair_contacts == 0) run.step();
  for (; run.bulk_state().pair_contacts > 0; run.step(), ++steps)
    deepest = std::max(deepest, run.bulk_state().elastic_energy);
  const auto mass = [](double density, double R) {
    return density * 4.0 / 3.0 * std::numbers::pi * R * R * R;
  };
  const double m1 = mass(2500.0, R1), m2 = mass(4500.0, R2), m = m1 * m2 / (m1 + m2), R = R1 * R2 / (R1 + R2);
  const double E = 1.0 / ((1.0 - 0.25) / (2.0 * 1e7) + (1.0 - 0.35) / (2.0 * 3e7));  // (1 - nu^2) / E of each
  const double overlap = std::pow(15.0 * m * v * v / (16.0 * E * std::sqrt(R)), 0.4);
  EXPECT_NEAR(deepest / (0.5 * m * v * v), 1.0, 1e-3);
  EXPECT_NEAR(steps * run.time_step() / (2.9432751 * overlap / v), 1.0, 1e-2);  // some 250 steps
  RecordProperty("energy_error", std::to_string(1e6 * (deepest / (0.5 * m * v * v) - 1.0)) + "e-6");
  RecordProperty("time_error", std::to_string(steps * run.time_step() / (2.9432751 * overlap / v) - 1.0));
  RecordProperty("speed_error", std::to_string(1e6 * (speed(0) / v - (m1 - m2) / (m1 + m2))) + "e-6");
  EXPECT_NEAR(speed(0) / v, (m1 - m2) / (m1 + m2), 1e-4);
  EXPECT_NEAR(speed(1) / v, 2.0 * m1 / (m1 + m2), 1e-4);
}

TEST(Bulk, FrictionAndDampingOnlyTakeEnergy) {
  simulation::Setup setup = grains(0.5, 0.5, 0.0);
  setup.contacts[0].rolling_friction = 0.02;
  setup.insertions[0].placed = lattice(1000, 10, 3e-3, 6.3e-3, 0.3);
  Simulation run(setup);
  double before = run.kinetic_energy();
  for (int k = 0; k < 15; ++k) {
    for (int m = 0; m < 40; ++m) run.step();
    const BulkState s = run.bulk_state();
    EXPECT_LT(s.kinetic_energy + s.elastic_energy, before * 1.001);
    before = s.kinetic_energy + s.elastic_energy;
  }
  EXPECT_LT(before, 0.6 * Simulation(setup).kinetic_energy());
}

TEST(Bulk, FrictionlessGrainsPackAtRandomCloseDensity) {
  const OneThread alone;
  Simulation run(bed(0.0, 1.0));
  for (int k = 0; k < 8000; ++k) run.step();
  const BulkState s = run.bulk_state();
  const double packed = fraction_of_bed(run);
  EXPECT_GT(packed, 0.635);
  EXPECT_LT(packed, 0.645);
  RecordProperty("fraction", std::to_string(packed));
  RecordProperty("contacts_per_grain", std::to_string(2.0 * static_cast<double>(s.pair_contacts) / 4096.0));
  // The floor and nothing else carries the weight.
  const double weight = s.mass * 9.81;
  double sum = 0.0;
  for (int k = 0; k < 200; ++k) run.step(), sum -= run.bulk_force_on_wall(4).z;
  EXPECT_NEAR(sum / 200.0 / weight, 1.0, 0.01);
}

/// Some thousand grains on a plate that shakes, wears and changes its shape, fed in number and at a rate.
simulation::Setup shaken_plate() {
  simulation::Setup setup = grains(0.4, 0.4, 0.0);
  for (WallSetup& wall : setup.walls) wall.material = "steel";
  setup.materials.push_back({"steel", 7900.0, 78e9, 0.3, {}});
  setup.contacts.push_back({"grain", "steel", 0.5, 0.4, 0.01});
  setup.wear = {{"grain", "steel", 1e-9}};
  WallSetup shaken = plate("plate", "steel", 0.3, 4e-3);
  shaken.motion = oscillation({4e-3, 1e-3, 0.5e-3}, 40.0);
  shaken.contact = ContactRule::resolved;
  shaken.deformation = DeformationRule::conserving;
  setup.walls.push_back(shaken);
  setup.run.gravity = {0, 0, -9.81};
  setup.insertions[0].placed = lattice(3000, 32, 3e-3, 6.03e-3, 0.2);
  for (PlacedSphere& s : setup.insertions[0].placed) s.position -= Vec3{0.1, 0.1, 0.0};
  InsertionSetup feed;
  feed.name = "feed";
  feed.material = "grain";
  feed.size.kind = SizeKind::lognormal;
  feed.size.mean = 3e-3, feed.size.sd = 0.3e-3, feed.size.low = 2e-3, feed.size.high = 4e-3;
  feed.volume.low = {-0.1, -0.1, 0.03};
  feed.volume.high = {0.1, 0.1, 0.06};
  feed.mass = 0.1;
  feed.mass_rate = 3.0;
  feed.velocity = {0, 0, -1.0};
  setup.insertions.push_back(feed);
  setup.domain = DomainSetup{{-0.14, -0.14, -0.05}, {0.14, 0.14, 0.2}, Outside::remove};
  setup.run.end = {0.024, false};
  setup.output.every = {0.012, false};
  return setup;
}

TEST(Bulk, WearOnAMovingDeformingWallIsAllAccountedForOnAnyNumberOfThreads) {
  const int before = omp_get_max_threads();
  std::uint64_t hash = 0;
  for (const int threads : {1, 2, 3}) {
    omp_set_num_threads(threads);
    Simulation run(shaken_plate());
    while (!run.finished()) run.advance();
    const Ledger ledger = run.ledger();
    const BulkState s = run.bulk_state();
    EXPECT_GT(s.inserted, 3050u);
    EXPECT_EQ(s.present + s.removed, s.inserted);
    EXPECT_GT(
        std::ranges::count_if(run.walls()[0].surface().element_volume(), [](double v) { return v > 0.0; }),
        500);
    EXPECT_GT(ledger.law, 0.0);
    EXPECT_LT(ledger.residual, 1e-9);
    RecordProperty("residual", std::to_string(1e12 * ledger.residual) + "e-12");
    if (hash == 0) hash = run.state_hash();
    EXPECT_EQ(run.state_hash(), hash) << threads << " threads";
  }
  omp_set_num_threads(before);
}

/// A smooth bed on a plate that slides to and fro under it: V = alpha W 4 A a cycle, which is h = alpha p L
/// for the mean.
TEST(Bulk, ABedWearsThePlateThatSlidesUnderIt) {
  const OneThread alone;
  constexpr double R = 3e-3, side = 10 * 2.06 * R, amplitude = 2e-3, frequency = 25.0, alpha = 1e-9;
  simulation::Setup setup = grains(0.3, 0.0, 0.0);
  WallSetup floor = plate("plate", "grain", side + 6.0 * R, 4e-3);
  floor.mesh.position = {0.5 * side, 0.5 * side, 0.0};
  floor.motion = oscillation({amplitude, 0.0, 0.0}, frequency);
  floor.contact = ContactRule::automatic;
  floor.deformation = DeformationRule::conserving;
  setup.walls = {floor};
  setup.wear = {{.abrader = "grain", .worn = "grain", .wear_coefficient = alpha}};
  setup.run.gravity = {0.0, 0.0, -9.81};
  setup.run.time_step = {1.0 / frequency / 1250.0, false};  // 32 us, a fifth of the Rayleigh time
  setup.insertions[0].placed = lattice(500, 10, R, 2.06 * R, 0.1);
  setup.domain = DomainSetup{{0, 0, -1}, {side, side, 1}, Outside::stop, Periodic::xy};
  Simulation run(setup);
  while (run.steps() < 10 * 1250) run.step();
  const double before = run.law_volume();
  while (run.steps() < 15 * 1250) run.step();
  const double weight = run.bulk_state().mass * 9.81, expected = alpha * weight * 4.0 * amplitude * 5.0;
  const double error = (run.law_volume() - before) / expected - 1.0;
  EXPECT_LT(std::abs(error), 0.005);
  EXPECT_LT(run.ledger().residual, 1e-9);
  RecordProperty("error", std::to_string(error));
  RecordProperty("residual", std::to_string(1e12 * run.ledger().residual) + "e-12");
}

/// Ten layers of ten thousand on a plate that shakes, wears and changes its shape at every step.
TEST(Bulk, WearOfAHundredThousandGrainsIsAllAccountedFor) {
  constexpr double R = 1e-3, pitch = 2.02 * R;
  simulation::Setup setup = shaken_plate();
  setup.insertions.resize(1);
  setup.insertions[0].placed = lattice(100'000, 100, R, pitch, 0.2);
  for (PlacedSphere& s : setup.insertions[0].placed) {
    s.position -= Vec3{50 * pitch, 50 * pitch, 0.0};
    s.velocity.z -= 0.2;
  }
  Simulation run(setup);
  for (int k = 0; k < 120; ++k) run.step();
  const Ledger ledger = run.ledger();
  EXPECT_EQ(run.bulk_state().present, 100'000u);
  EXPECT_GT(run.bulk_state().wall_contacts, 300u);
  EXPECT_GT(
      std::ranges::count_if(run.walls()[0].surface().element_volume(), [](double v) { return v > 0.0; }),
      3000);
  EXPECT_GT(ledger.law, 0.0);
  EXPECT_LT(ledger.residual, 1e-9);
  RecordProperty("residual", std::to_string(1e12 * ledger.residual) + "e-12");
  RecordProperty("wall_contacts", std::to_string(run.bulk_state().wall_contacts));
}

/// Every contact piles up beside itself what it ploughs aside.
TEST(Bulk, WhatManyGrainsPloughAsideIsAllAccountedForOnAnyNumberOfThreads) {
  const int before = omp_get_max_threads();
  std::uint64_t hash = 0;
  for (const int threads : {1, 2}) {
    omp_set_num_threads(threads);
    simulation::Setup setup = shaken_plate();
    setup.ploughing = PloughingSetup{.removed_fraction = 0.4};
    Simulation run(setup);
    while (!run.finished()) run.advance();
    const Ledger ledger = run.ledger();
    EXPECT_GT(ledger.law, 0.0);
    EXPECT_NEAR(ledger.displaced / (ledger.law + ledger.displaced), 0.6, 1e-9);
    EXPECT_GT(ledger.piled, 0.99 * ledger.displaced);
    EXPECT_LT(ledger.residual, 1e-9);
    EXPECT_NEAR(ledger.kappa, 1.0, 1e-9);
    RecordProperty("residual", std::to_string(1e12 * ledger.residual) + "e-12");
    if (hash == 0) hash = run.state_hash();
    EXPECT_EQ(run.state_hash(), hash) << threads << " threads";
  }
  omp_set_num_threads(before);
}

TEST(Bulk, WhatLiesOnAGateFallsFromTheMomentItIsTakenAway) {
  for (const bool mesh : {false, true}) {
    simulation::Setup setup = grains(0.3, 0.3, 0.0);
    setup.walls = {plane("gate", {0, 0, 0}, {0, 0, 1})};
    if (mesh) {
      setup.walls[0].mesh.shape = MeshShape::plate;
      setup.walls[0].mesh.length = setup.walls[0].mesh.width = 0.1;
      setup.walls[0].mesh.size = 0.02;
      setup.walls[0].contact = ContactRule::resolved;
    }
    setup.walls[0].until = 0.03;
    setup.run.gravity = {0, 0, -9.81};
    setup.insertions[0].placed = {{{0, 0, 3e-3}, 3e-3, {}}};
    ParticleSetup named;
    named.name = "named";
    named.material = "grain";
    named.radius = 3e-3;
    named.position = {0.02, 0, 3e-3};
    setup.particles = {named};
    Simulation run(setup);
    const auto speeds = [&] {
      const auto& spheres = run.bulk()->spheres();
      const auto in_numbers = static_cast<std::size_t>(std::ranges::find(spheres.id, 1) - spheres.id.begin());
      return std::array{spheres.row[in_numbers].vz, run.particles().velocity[0].z};
    };
    while (run.time() < 0.03) run.step();
    for (const double v : speeds()) EXPECT_LT(std::abs(v), 2e-3);
    const auto rest = speeds();
    while (run.time() < 0.06) run.step();
    // The first step without the gate is the one that begins at 0.03 s or just after.
    for (std::size_t k = 0; k < 2; ++k)
      EXPECT_NEAR(speeds()[k] - rest[k], -9.81 * 0.03, 9.81 * 2.0 * run.time_step());
    EXPECT_EQ(norm(run.bulk_force_on_wall(0)), 0.0);
  }
}

TEST(Bulk, GrainOnAMeshMovesAsOnAPlane) {
  // The same grain thrown at an analytic plane and at a coarse mesh, through the engine.
  const auto thrown = [](bool mesh) {
    simulation::Setup setup = grains(0.5, 0.3, 0.0);
    setup.walls = {plane("floor", {0, 0, 0}, {0, 0, 1})};
    if (mesh) {
      setup.walls[0].mesh.shape = MeshShape::plate;
      setup.walls[0].mesh.length = setup.walls[0].mesh.width = 0.1;
      setup.walls[0].mesh.size = 0.02;
      setup.walls[0].contact = ContactRule::resolved;
    }
    setup.insertions[0].placed = {{{1e-3, 2e-3, 3.01e-3}, 3e-3, {0.4, -0.2, -0.5}}};
    Simulation run(setup);
    for (int k = 0; k < 400; ++k) run.step();
    return run.bulk()->spheres().row[0];
  };
  const contact::SphereRow a = thrown(false), b = thrown(true);
  EXPECT_GT(a.vz, 0.2);
  EXPECT_LT(norm(a.velocity() - b.velocity()), 1e-10 * norm(a.velocity()));
  EXPECT_LT(norm(a.spin() - b.spin()), 1e-10 * norm(a.spin()));
}

}  // namespace
}  // namespace abradem::test
