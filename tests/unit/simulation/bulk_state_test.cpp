// SPDX-License-Identifier: BSD-3-Clause
// A run with particles in numbers that is saved and put back goes on to the same bits.
#include <gtest/gtest.h>

#include "abradem/core/error.h"
#include "support/state.h"

namespace abradem::simulation {
namespace {

using test::finish;
using test::loaded;
using test::saved;

/// Named particles and particles in numbers that come in at a rate, roll over a shaking plate that wears,
/// over a plane and over each other, and are lost over an edge.
simulation::Setup feed_on_a_shaking_plate(ContactRule contact) {
  Setup setup;
  setup.materials = {{"grain", 2500.0, 1e7, 0.25, {}}, {"steel", 7900.0, 1e9, 0.3, {}}};
  setup.contacts = {{"grain", "grain", 0.5, 0.5, 0.02}, {"grain", "steel", 0.5, 0.4, 0.01}};
  setup.wear = {{.abrader = "grain", .worn = "steel", .wear_coefficient = 1e-10}};
  WallSetup plate;
  plate.name = "plate";
  plate.material = "steel";
  plate.mesh.shape = MeshShape::plate;
  plate.mesh.length = plate.mesh.width = 16e-3;
  plate.mesh.size = 2e-3;
  plate.motion.kind = MotionKind::oscillation;
  plate.motion.amplitude = {1e-3, 0.0, 0.2e-3};
  plate.motion.frequency = 40.0;
  plate.contact = contact;
  plate.deform_every = 3;
  WallSetup side;
  side.name = "side";
  side.material = "steel";
  side.mesh.shape = MeshShape::plane;
  side.mesh.position = {-9e-3, 0.0, 0.0};
  side.mesh.normal = {1.0, 0.0, 0.0};
  setup.walls = {plate, side};
  ParticleSetup named;
  named.name = "ball";
  named.material = "grain";
  named.radius = 1.5e-3;
  named.position = {0.0, 0.0, 1.5e-3};
  setup.particles = {named};
  for (const char* name : {"first", "second"}) {
    InsertionSetup i;
    i.name = name;
    i.material = "grain";
    i.size.kind = SizeKind::uniform;
    i.size.low = 0.6e-3;
    i.size.high = 1.0e-3;
    i.volume.low = {-8e-3, -8e-3, 0.3e-3};
    i.volume.high = {8e-3, 8e-3, 6e-3};
    i.velocity = {0.3, 0.0, -0.5};
    setup.insertions.push_back(i);
  }
  setup.insertions[0].number = 120;
  setup.insertions[1].mass = 1.0;
  setup.insertions[1].mass_rate = 0.2;
  setup.domain = DomainSetup{{-12e-3, -9e-3, -5e-3}, {8e-3, 9e-3, 20e-3}, Outside::remove};
  setup.run.gravity = {1.0, 0.0, -9.81};
  setup.run.end = {0.05, false};
  setup.run.time_step = {0.2, true};
  setup.output.every = {0.01, false};
  return setup;
}

TEST(BulkState, GoesOnToTheSameBits) {
  for (const ContactRule contact : {ContactRule::resolved, ContactRule::patch}) {
    const simulation::Setup setup = feed_on_a_shaking_plate(contact);
    test::expect_same_bits_from_anywhere(setup, 800);
    Simulation run(setup);
    finish(run, 800);
    EXPECT_GT(run.bulk_state().removed, 0u);
    EXPECT_GT(run.bulk_state().inserted, 130u);
    EXPECT_GT(run.bulk_state().wall_contacts, 2u);
    EXPECT_GT(run.bulk()->list().rebuilds(), 5u);
  }
}

/// What comes in at a rate is clumps, most of those at the start are spheres; some of both leave.
simulation::Setup clumps_on_a_shaking_plate() {
  simulation::Setup setup = feed_on_a_shaking_plate(ContactRule::resolved);
  setup.shapes = {
      {"grain", {{{0, 0, 0}, 1e-3}, {{1e-3, 0, 0}, 0.7e-3}, {{0.2e-3, 0.9e-3, 0.3e-3}, 0.8e-3}}, {}}};
  setup.insertions[0].number = 60;
  setup.insertions[1].shape = "grain";
  return setup;
}

TEST(BulkState, OfClumpsGoesOnToTheSameBits) {
  const simulation::Setup setup = clumps_on_a_shaking_plate();
  test::expect_same_bits_from_anywhere(setup, 1200);
  Simulation run(setup);
  finish(run, 1200);
  EXPECT_GT(run.bulk_state().removed, 0u);
  EXPECT_GT(run.bulk()->clumps().size(), 10u);
  EXPECT_LT(run.bulk()->clumps().clumps().front().id, run.bulk()->clumps().clumps().back().id);
  test::expect_same_bits_on_other_threads(setup, 700, 1400);
}

/// Enough of them to be shared out among threads, over a border where space repeats itself.
TEST(BulkState, OfManyClumpsIsTheSameOnOtherThreads) {
  simulation::Setup setup = clumps_on_a_shaking_plate();
  setup.particles.clear();
  setup.walls[0].mesh.length = setup.walls[0].mesh.width = 30e-3;
  setup.walls.resize(1);
  setup.insertions.erase(setup.insertions.begin());
  setup.insertions[0].number = 400;
  setup.insertions[0].mass = {};
  setup.insertions[0].mass_rate = {};
  setup.insertions[0].volume.high.z = 20e-3;
  setup.domain = DomainSetup{{-9e-3, -9e-3, -5e-3}, {9e-3, 9e-3, 25e-3}, Outside::remove, Periodic::xy};
  test::expect_same_bits_on_other_threads(setup, 100, 400);
}

TEST(BulkState, GoesOnOnOtherThreads) {
  const simulation::Setup setup = feed_on_a_shaking_plate(ContactRule::resolved);
  test::expect_same_bits_on_other_threads(setup, 700, 1400);
}

class DamagedBulkState : public testing::TestWithParam<bool> {};

TEST_P(DamagedBulkState, IsRefusedOrCanBeSteppedOn) {
  const simulation::Setup setup =
      GetParam() ? clumps_on_a_shaking_plate() : feed_on_a_shaking_plate(ContactRule::resolved);
  Simulation run(setup);
  finish(run, 600);
  const std::string good = saved(run);
  core::RandomStream random(4, 1);
  for (int i = 0; i < 200; ++i) {
    std::string bad = good;
    bad[static_cast<std::size_t>(random.uniform() * static_cast<double>(bad.size()))] ^=
        static_cast<char>(1 << (i % 8));
    try {
      Simulation fresh(setup);
      core::ArchiveReader archive(bad);
      fresh.load(archive);
      fresh.step();
    } catch (const Error&) {
    }
  }
}

INSTANTIATE_TEST_SUITE_P(SpheresAndClumps, DamagedBulkState, testing::Bool());

}  // namespace
}  // namespace abradem::simulation
