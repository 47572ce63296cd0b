// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/simulation/simulation.h"

#include <gtest/gtest.h>
#include <omp.h>

#include "abradem/core/error.h"
#include "support/cases.h"
#include "support/surfaces.h"

namespace abradem::simulation {
namespace {

/// A short run on a narrow ring.
test::PinOnDisc small_case() {
  test::PinOnDisc pin;
  pin.track = 6e-3;
  pin.half_band = 0.9e-3;
  pin.size = 0.2e-3;
  pin.revolutions = 0.02;
  return pin;
}

std::string refusal(const Setup& setup) {
  try {
    Simulation run(setup);
  } catch (const Error& e) {
    return e.what();
  }
  return "accepted";
}

TEST(SetupErrors, AreGivenWithTheReason) {
  using CaseSetup = simulation::Setup;
  const CaseSetup good = small_case().setup();
  EXPECT_EQ(refusal(good), "accepted");
  const auto changed = [&](auto&& change) {
    CaseSetup s = good;
    change(s);
    return refusal(s);
  };
  EXPECT_NE(changed([](CaseSetup& s) { s.walls[0].material = "stone"; }).find("no material named 'stone'"),
            std::string::npos);
  EXPECT_NE(changed([](CaseSetup& s) { s.contacts.clear(); }).find("no [contact.\"iron_ore/mild_steel\"]"),
            std::string::npos);
  EXPECT_NE(
      changed([](CaseSetup& s) { s.particles[0].radius = -1e-3; }).find("radius = -0.001 m; must be > 0"),
      std::string::npos);
  EXPECT_NE(changed([](CaseSetup& s) { s.run.end = {0.0, true}; }).find("must be > 0"), std::string::npos);
  EXPECT_NE(changed([](CaseSetup& s) { s.walls[0].motion.kind = MotionKind::none; }).find("revolutions"),
            std::string::npos);
  EXPECT_NE(changed([](CaseSetup& s) { s.particles[0].guide = Guide::none; }).find("guide"),
            std::string::npos);
  EXPECT_NE(changed([](CaseSetup& s) { s.particles[0].load = {}; }).find("load"), std::string::npos);
  EXPECT_NE(changed([](CaseSetup& s) {
              s.walls[0].motion.rate = 0.0;
              s.run.end = s.output.every = {1.0, false};
            }).find("no wall slides"),
            std::string::npos);
  EXPECT_NE(changed([](CaseSetup& s) {
              s.run.method = Method::dynamic;
              s.run.time_step = {-1e-6, false};
            }).find("time step must be > 0"),
            std::string::npos);
  EXPECT_NE(changed([](CaseSetup& s) { s.walls[0].mesh.shape = MeshShape::file; }).find("no reader"),
            std::string::npos);
  EXPECT_NE(changed([](CaseSetup& s) { s.walls[0].mesh.size = -1.0; }), "accepted");
}

TEST(Run, BalancesTheLoadToTenThousandthsOnARoughDisc) {
  for (const double shear_modulus : {0.1e9, 5e9}) {
    test::PinOnDisc pin = small_case();
    pin.shear_modulus = shear_modulus;
    pin.friction = 0.0;
    pin.deformation = DeformationRule::none;
    pin.size = shear_modulus < 1e9 ? 0.1e-3 : 0.05e-3;
    const simulation::Setup setup = pin.setup();
    Simulation run(setup, [](const MeshSetup& mesh, std::uint64_t seed) {
      geometry::TriangleMesh rough = generate_mesh(mesh, seed);
      test::roughen(rough, 0.5e-6, 3);
      return rough;
    });
    const contact::PairProperties pair =
        material::effective_moduli({4850.0, shear_modulus, 0.24}, {7932.0, 78e9, 0.30});
    contact::PatchEvaluator patches;
    for (int step = 0; step < 60; ++step) {
      const geometry::Pose pose = run.walls()[0].pose_at(run.time());
      run.step();
      const Vec3 c = pose.to_body(run.particles().position[0]);
      double carried = 0.0;
      for (const contact::Patch& patch :
           patches.evaluate(run.contact(0, 0).candidates(), c, pin.kRadius, pair))
        carried += patch.elastic_force * patch.n.z;
      EXPECT_NEAR(carried, pin.kLoad, 1e-4 * pin.kLoad) << "step " << step;
    }
  }
}

TEST(Run, StopsWhereNothingCarriesTheLoad) {
  simulation::Setup s = small_case().setup();
  s.particles[0].position.x = 50e-3;  // beside the disc
  Simulation run(s);
  EXPECT_THROW(run.step(), SimulationError);
}

TEST(Run, StopsWhereTheOverlapIsNoLongerSmall) {
  simulation::Setup s = small_case().setup();
  s.run.method = Method::dynamic;
  s.particles[0].position.z = 0.85 * s.particles[0].radius;
  Simulation run(s);
  EXPECT_THROW(run.step(), SimulationError);
}

TEST(Run, StopsWhereOneUpdateIsTooDeepForTheMesh) {
  test::PinOnDisc pin = small_case();
  pin.wear_coefficient = 1e-6;
  simulation::Setup s = pin.setup();
  s.run.increment = 0.07e-3;  // the program's own is short enough even for that
  Simulation run(s);
  EXPECT_THROW(run.advance(), SimulationError);
}

/// Sliding distance per step that the program chooses, in half-widths of the contact.
double chosen_share(test::PinOnDisc pin, double revolutions) {
  pin.revolutions = revolutions;
  const Simulation run(pin.setup());
  const contact::PairProperties pair =
      material::effective_moduli({4850.0, pin.shear_modulus, 0.24}, {7932.0, 78e9, 0.30});
  const double a = contact::contact_radius(test::PinOnDisc::kRadius,
                                           contact::hertz_overlap(pair, test::PinOnDisc::kRadius, 5.0));
  return run.time_step() * std::numbers::pi * pin.track / a;
}

TEST(Run, TakesLongerIncrementsTheMoreRevolutionsShareTheWear) {
  test::PinOnDisc pin = small_case();
  pin.wear_coefficient = 6.28e-13;
  EXPECT_NEAR(chosen_share(pin, 1.0), 0.2, 0.01);
  EXPECT_NEAR(chosen_share(pin, 12.0), 0.346, 0.01);
  EXPECT_NEAR(chosen_share(pin, 96.0), 0.98, 0.02);     // 8 times as many: the root of 8 as long
  EXPECT_NEAR(chosen_share(pin, 1302.0), 2.0, 0.05);    // the contact's length at most
  pin.contact = simulation::ContactRule::per_triangle;  // its contacts are as small as the elements
  EXPECT_NEAR(chosen_share(pin, 1302.0), 0.2, 0.01);
}

TEST(Run, TakesIncrementsThatWearNoMoreThanTheContactsApproach) {
  test::PinOnDisc pin = small_case();
  pin.wear_coefficient = 25.0 / 0.26285e9;  // alpha E* = 25
  EXPECT_NEAR(chosen_share(pin, 12.0), 0.1, 0.005);
}

TEST(Run, TakesAWholeNumberOfStepsPerOutput) {
  simulation::Setup s = small_case().setup();
  s.run.end = {0.1, true};
  s.output.every = {0.02, true};
  Simulation run(s);
  EXPECT_EQ(run.total_steps(), 5 * run.steps_per_output());
  int outputs = 0;
  while (!run.finished()) {
    ASSERT_TRUE(run.advance());
    ++outputs;
    EXPECT_NEAR(run.revolution(), 0.02 * outputs, 1e-12);
  }
  EXPECT_EQ(outputs, 5);
  EXPECT_EQ(run.steps(), run.total_steps());
}

TEST(Run, PausesWhenTheWatchSaysSo) {
  simulation::Setup s = small_case().setup();
  s.run.method = Method::dynamic;
  s.run.end = {1.0, true};
  s.output.every = {1.0, true};
  s.walls[0].deformation = DeformationRule::none;
  Simulation run(s);
  int looks = 0;
  EXPECT_FALSE(run.advance([&] { return ++looks < 2; }));
  EXPECT_EQ(looks, 2);
  EXPECT_FALSE(run.finished());
}

TEST(Run, CallsTheObserverAfterEveryStep) {
  Simulation run(small_case().setup());
  std::uint64_t calls = 0;
  run.on_step([&](const Simulation& r) {
    ++calls;
    EXPECT_EQ(r.steps(), calls);
    EXPECT_NEAR(r.force_on(0).normal, 5.0, 0.05);
  });
  run.advance();
  EXPECT_EQ(calls, run.total_steps());
}

TEST(Run, GivesTheSameBitsTwice) {
  for (const Method method : {Method::quasi_static, Method::dynamic})
    for (const DeformationRule rule : {DeformationRule::conserving, DeformationRule::paper})
      for (const ContactRule contact :
           {ContactRule::patch, ContactRule::resolved, ContactRule::per_triangle}) {
        test::PinOnDisc pin = small_case();
        pin.method = method;
        pin.deformation = rule;
        pin.contact = contact;
        pin.revolutions = 0.002;
        Simulation a(pin.setup()), b(pin.setup());
        while (!a.finished()) a.step();
        while (!b.finished()) b.step();
        EXPECT_EQ(a.state_hash(), b.state_hash());
        EXPECT_NE(a.state_hash(), Simulation(pin.setup()).state_hash());
      }
}

TEST(Run, GivesTheSameBitsForAnyNumberOfThreads) {
  // Twelve pins on one ring: enough to be shared out.
  test::PinOnDisc one = small_case();
  simulation::Setup s = one.setup();
  s.run.method = Method::dynamic;
  s.run.end = s.output.every = {0.0005, true};
  s.contacts[0].static_friction = 0.3;  // slips soon
  const ParticleSetup pin = s.particles[0];
  s.particles.clear();
  for (int k = 0; k < 12; ++k) {
    ParticleSetup p = pin;
    const double angle = 2.0 * std::numbers::pi * k / 12.0;
    p.name = "pin " + std::to_string(k);
    p.radius = 1.2e-3;
    p.position = {one.track * std::cos(angle), one.track * std::sin(angle), p.radius};
    p.load = {0.0, 0.0, -1.0};
    s.particles.push_back(p);
  }
  s.contacts.push_back({"iron_ore", "iron_ore", 0.4, 0.5, 0.0});
  std::uint64_t first = 0;
  const int before = omp_get_max_threads();
  for (const int threads : {1, 2, 3}) {
    omp_set_num_threads(threads);
    Simulation run(s);
    while (!run.finished()) run.step();
    if (threads == 1) {
      first = run.state_hash();
      EXPECT_GT(run.ledger().law, 0.0);
    }
    EXPECT_EQ(run.state_hash(), first) << threads << " threads";
  }
  omp_set_num_threads(before);
}

TEST(Run, WithoutWearCoefficientLeavesTheMeshBitIdentical) {
  for (const DeformationRule rule : {DeformationRule::conserving, DeformationRule::paper}) {
    test::PinOnDisc pin = small_case();
    pin.wear_coefficient = 0.0;
    pin.deformation = rule;
    Simulation run(pin.setup());
    run.advance();
    const wear::WearingSurface& surface = run.walls()[0].surface();
    EXPECT_TRUE(std::ranges::equal(surface.mesh().vertices, surface.reference()));
    EXPECT_EQ(run.ledger().law, 0.0);
    EXPECT_EQ(run.ledger().residual, 0.0);
  }
}

/// Ended by hand between two updates of the shape: what waits for the next one is no error.
TEST(Run, ClosesItsLedgerBetweenUpdatesOfTheShape) {
  test::PinOnDisc pin = small_case();
  simulation::Setup setup = pin.setup();
  setup.walls[0].deform_every = 7;
  Simulation run(setup);
  for (int k = 0; k < 10; ++k) run.step();
  const Ledger ledger = run.ledger();
  ASSERT_GT(ledger.law, 0.0);
  EXPECT_LT(ledger.swept, 0.9 * ledger.law);
  EXPECT_LT(ledger.residual, 1e-9);
}

TEST(Run, WithoutDeformationBooksWearAndKeepsTheShape) {
  test::PinOnDisc pin = small_case();
  pin.deformation = DeformationRule::none;
  Simulation run(pin.setup());
  run.advance();
  const Ledger ledger = run.ledger();
  EXPECT_NEAR(ledger.law / pin.archard_volume(), 1.0, 1e-6);
  EXPECT_NEAR(ledger.deposited / ledger.law, 1.0, 1e-12);
  EXPECT_EQ(ledger.swept, 0.0);
  EXPECT_TRUE(
      std::ranges::equal(run.walls()[0].surface().mesh().vertices, run.walls()[0].surface().reference()));
}

TEST(Limits, ReportTheRayleighTimeAndTheDampingNumber) {
  simulation::Setup s = small_case().setup();
  s.run.method = Method::dynamic;
  s.run.time_step = {0.2, true};
  Simulation run(s);
  const auto limits = run.limits();
  ASSERT_EQ(limits.size(), 3U);
  EXPECT_NEAR(limits[0].value, 0.2, 0.002);  // shortened to a whole number of steps
  // Rayleigh time of the paper's pin: 71.68 us.
  EXPECT_NEAR(run.time_step(), 0.2 * 71.68e-6, 0.01 * 14.3e-6);
  EXPECT_LT(limits[2].value, 4.0);
  EXPECT_TRUE(Simulation(small_case().setup()).limits().empty());
}

TEST(Duration, InRevolutionsNeedsSomethingThatTurns) {
  EXPECT_EQ(seconds_of({2.0, false}, 0.0), 2.0);
  EXPECT_EQ(seconds_of({2.0, true}, 3.0), 6.0);
  EXPECT_THROW(static_cast<void>(seconds_of({2.0, true}, 0.0)), InputError);
}

}  // namespace
}  // namespace abradem::simulation
