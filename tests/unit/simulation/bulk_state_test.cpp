// SPDX-License-Identifier: BSD-3-Clause
// A run with particles in numbers that is saved and put back goes on to the same bits.
#include <gtest/gtest.h>

#include <algorithm>

#include "abradem/core/error.h"
#include "support/grains.h"
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
  WallSetup plate = test::plate("plate", "steel", 16e-3, 2e-3);
  plate.motion = test::oscillation({1e-3, 0.0, 0.2e-3}, 40.0);
  plate.contact = contact;
  plate.deform_every = 3;
  setup.walls = {plate, test::plane("side", {-9e-3, 0.0, 0.0}, {1.0, 0.0, 0.0}, "steel")};
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

/// The plate turns, rides on a table that turns it about `axis` and begins again and again, and all that is
/// shaken.
void move_in_three_ways(Setup& setup, const Vec3& axis) {
  MotionSetup turn, ride;
  turn.kind = MotionKind::rotation;
  turn.rate = 3.0;
  ride.kind = MotionKind::table;
  ride.axis = axis;
  ride.after = TableEnd::repeat;
  ride.rows = {{0.0, {}, 0.0}, {3.1e-3, {0.4e-3, 0.0, 0.1e-3}, 0.01}, {7.3e-3, {}, -0.01}, {11e-3, {}, 0.0}};
  setup.walls[0].carried_by = {ride, setup.walls[0].motion};
  setup.walls[0].motion = turn;
}

TEST(BulkState, OnAWallOfCombinedMotionsGoesOnToTheSameBits) {
  simulation::Setup setup = feed_on_a_shaking_plate(ContactRule::resolved);
  move_in_three_ways(setup, {0.0, 1.0, 0.0});
  test::expect_same_bits_from_anywhere(setup, 900);
  test::expect_same_bits_on_other_threads(setup, 700, 1400);
}

/// Grains in a box that hop by a hundredth of their radius on a plate which turns under them, shakes and
/// wears: they sleep and wake beside triangles that were listed before, and meanwhile the wear moves these by
/// more and less than what MeshCandidates tolerates of patches.
simulation::Setup hopping_on_a_turning_plate(ContactRule contact) {
  constexpr double R = 1e-3, pitch = 2.02 * R, half = 6 * pitch;
  simulation::Setup setup = test::grains(0.7, 0.4, 0.0);
  setup.insertions[0].placed = test::lattice(144, 12, R, pitch, 0.01);
  for (PlacedSphere& s : setup.insertions[0].placed) s.position -= Vec3{half, half, 0.02 * R};
  setup.wear = {{.abrader = "grain", .worn = "grain", .wear_coefficient = 3e-5}};
  WallSetup plate = test::plate("plate", "grain", 40e-3, 0.5e-3);
  plate.motion.kind = MotionKind::rotation;
  plate.motion.rate = 5.0;
  plate.carried_by = {test::oscillation({0.0, 0.0, 8e-6}, 1000.0)};
  plate.contact = contact;
  plate.deformation = DeformationRule::conserving;
  setup.walls = {
      plate, test::plane("left", {-half, 0, 0}, {1, 0, 0}), test::plane("right", {half, 0, 0}, {-1, 0, 0}),
      test::plane("front", {0, -half, 0}, {0, 1, 0}), test::plane("back", {0, half, 0}, {0, -1, 0})};
  setup.run.gravity = {0.0, 0.0, -100.0};
  return setup;
}

std::size_t asleep(const Simulation& run) {
  return static_cast<std::size_t>(
      std::ranges::count_if(run.bulk()->walls().meshes(),
                            [](const BulkWalls::NearMesh& m) { return !m.awake || m.way.any > 0.0; }));
}

TEST(BulkState, WhereSpheresSleepBesideAWallThatWearsGoesOnToTheSameBits) {
  for (const ContactRule contact : {ContactRule::resolved, ContactRule::automatic}) {
    const simulation::Setup setup = hopping_on_a_turning_plate(contact);
    Simulation whole(setup);
    std::vector<std::string> states;
    for (const std::uint64_t from : {361, 722, 1083}) {
      finish(whole, from);
      EXPECT_GT(asleep(whole), 70u) << "step " << from;
      states.push_back(saved(whole));
    }
    finish(whole, 1200);
    EXPECT_GT(whole.ledger().law, 0.0);
    for (const std::string& state : states) {
      Simulation run = loaded(setup, state);
      const std::uint64_t from = run.steps();
      finish(run, 1200);
      // Not all that is saved: what a sphere that sleeps knows of the wall is from when it was last awake.
      EXPECT_EQ(run.state_hash(), whole.state_hash()) << "from step " << from;
      EXPECT_EQ(run.ledger().swept, whole.ledger().swept) << "from step " << from;
      EXPECT_EQ(run.ledger().paper, whole.ledger().paper) << "from step " << from;
    }
  }
}

/// A number of particles that is shared out among threads, on a plate that wears and moves, sides periodic.
struct Together {
  std::string name;
  ContactRule rule = ContactRule::resolved;
  bool clumps = false;
  Cohesion cohesion = Cohesion::none;
  bool combined_motions = false;
};

void PrintTo(const Together& t, std::ostream* out) { *out << t.name; }

class BulkTogether : public testing::TestWithParam<Together> {};

TEST_P(BulkTogether, GivesTheSameBitsOnOneTwoAndThreeThreads) {
  const Together& together = GetParam();
  simulation::Setup setup = clumps_on_a_shaking_plate();
  setup.particles.clear();
  setup.walls.resize(1);
  WallSetup& plate = setup.walls[0];
  plate.mesh.length = plate.mesh.width = 60e-3;
  plate.mesh.size = 1e-3;  // of the size of the contacts' width in part of the impacts
  plate.contact = together.rule;
  plate.deformation = DeformationRule::conserving;
  if (together.combined_motions)
    move_in_three_ways(setup, {0.0, 0.0, 1.0});  // as flat as space repeats itself
  setup.insertions.resize(1);
  InsertionSetup& grains = setup.insertions[0];
  grains.number = together.clumps ? 350 : 900;
  if (together.clumps) grains.shape = "grain";
  grains.velocity = {0.2, 0.1, -1.0};
  grains.volume.low = {-20e-3, -20e-3, 1.4e-3};
  grains.volume.high = {20e-3, 20e-3, 7e-3};
  setup.domain = DomainSetup{{-20e-3, -20e-3, -20e-3}, {20e-3, 20e-3, 40e-3}, Outside::remove, Periodic::xy};
  for (ContactSetup& pair : setup.contacts) {
    pair.cohesion = together.cohesion;
    pair.work_of_adhesion = together.cohesion == Cohesion::jkr ? 0.05 : 0.0;
    pair.cohesion_energy_density = together.cohesion == Cohesion::sjkr ? 2e4 : 0.0;
  }
  const int before = omp_get_max_threads();
  std::string first;
  for (const int threads : {1, 2, 3}) {
    omp_set_num_threads(threads);
    Simulation run(setup);
    finish(run, 702);  // the shape follows every third
    if (threads == 1) first = saved(run);
    EXPECT_TRUE(saved(run) == first) << threads << " threads";
    EXPECT_GT(run.bulk_state().pair_contacts, 10u);
    EXPECT_GT(
        std::ranges::count_if(run.walls()[0].surface().element_volume(), [](double v) { return v > 0.0; }),
        150);
    const Ledger ledger = run.ledger();
    EXPECT_GT(ledger.law, 0.0);
    EXPECT_LT(ledger.residual, 1e-9);
  }
  omp_set_num_threads(before);
}

INSTANTIATE_TEST_SUITE_P(
    Every, BulkTogether,
    testing::Values(Together{"spheres_resolved", ContactRule::resolved, false, Cohesion::none, true},
                    Together{"spheres_auto", ContactRule::automatic, false, Cohesion::none, true},
                    Together{"spheres_patch", ContactRule::patch, false, Cohesion::none, false},
                    Together{"spheres_resolved_jkr", ContactRule::resolved, false, Cohesion::jkr, true},
                    Together{"spheres_auto_sjkr", ContactRule::automatic, false, Cohesion::sjkr, true},
                    Together{"clumps_auto", ContactRule::automatic, true, Cohesion::none, true},
                    Together{"clumps_resolved_jkr", ContactRule::resolved, true, Cohesion::jkr, true},
                    Together{"clumps_resolved_sjkr", ContactRule::resolved, true, Cohesion::sjkr, true}),
    [](const auto& instance) { return instance.param.name; });

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
