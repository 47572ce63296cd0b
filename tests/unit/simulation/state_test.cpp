// SPDX-License-Identifier: BSD-3-Clause
// A run that is saved and put back goes on to the same bits.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "abradem/core/archive.h"
#include "abradem/core/error.h"
#include "abradem/core/random.h"
#include "abradem/simulation/simulation.h"
#include "support/cases.h"
#include "support/state.h"

namespace abradem::simulation {
namespace {

using test::expect_same_bits_from_anywhere;
using test::finish;
using test::loaded;
using test::saved;

test::PinOnDisc small_case() {
  test::PinOnDisc pin;
  pin.track = 6e-3;
  pin.half_band = 0.9e-3;
  pin.size = 0.2e-3;
  return pin;
}

struct Rules {
  Method method;
  ContactRule contact;
  DeformationRule deformation;
};

class AnyRules : public testing::TestWithParam<Rules> {};

TEST_P(AnyRules, GoOnToTheSameBitsFromAnyStep) {
  test::PinOnDisc pin = small_case();
  pin.method = GetParam().method;
  pin.contact = GetParam().contact;
  pin.deformation = GetParam().deformation;
  if (pin.contact == ContactRule::automatic) pin.size = 0.45e-3;  // both rules have a share
  pin.friction = 0.3;                                             // sticks first, slips then
  simulation::Setup setup = pin.setup();
  const bool dynamic = pin.method == Method::dynamic;
  setup.output.every = {dynamic ? 0.001 : 0.01, true};
  if (pin.deformation == DeformationRule::conserving) setup.walls[0].deform_every = 3;
  expect_same_bits_from_anywhere(setup, dynamic ? 1200 : 250);
}

std::vector<Rules> all_rules() {
  std::vector<Rules> rules;
  for (const Method method : {Method::quasi_static, Method::dynamic})
    for (const ContactRule contact :
         {ContactRule::patch, ContactRule::resolved, ContactRule::per_triangle, ContactRule::automatic})
      for (const DeformationRule deformation : {DeformationRule::conserving, DeformationRule::paper})
        rules.push_back({method, contact, deformation});
  return rules;
}
INSTANTIATE_TEST_SUITE_P(State, AnyRules, testing::ValuesIn(all_rules()));

/// Free particles that hit one another, a plane and a worn plate that is not flat, and roll.
TEST(State, OfParticlesThatMeetGoesOnToTheSameBits) {
  test::PinOnDisc pin = small_case();
  pin.method = Method::dynamic;
  simulation::Setup setup = pin.setup();
  setup.contacts.push_back({"iron_ore", "iron_ore", 0.4, 0.5, 0.02});
  setup.run.gravity = {0.0, 0.0, -9.81};
  WallSetup floor;
  floor.name = "floor";
  floor.material = "mild_steel";
  floor.mesh.shape = MeshShape::plane;
  floor.mesh.position = {0.0, 0.0, -0.1e-3};
  setup.walls.push_back(floor);
  setup.particles.clear();
  for (int k = 0; k < 4; ++k) {
    ParticleSetup p;
    p.name = std::string("p").append(std::to_string(k));
    p.material = "iron_ore";
    p.radius = 0.5e-3;
    p.position = {5.8e-3 + 0.2e-3 * k, 0.99e-3 * k, 0.52e-3 + 0.05e-3 * k};
    p.velocity = {0.1, k % 2 == 0 ? 0.4 : -0.4, -0.3};
    p.spin = {30.0 * k, 5.0, -10.0};
    setup.particles.push_back(p);
  }
  setup.output.every = {0.001, true};
  expect_same_bits_from_anywhere(setup, 4000);
}

TEST(State, OfAWornTipAndOfRidgesGoesOnToTheSameBits) {
  for (const Method method : {Method::dynamic, Method::quasi_static}) {
    test::PinOnDisc pin = small_case();
    pin.method = method;
    simulation::Setup setup = pin.setup();
    WearSetup tip = setup.wear[0];
    std::swap(tip.abrader, tip.worn);
    tip.wear_coefficient *= 0.01;
    setup.wear.push_back(tip);
    setup.ploughing = PloughingSetup{};
    setup.ploughing->removed_fraction = 0.6;
    expect_same_bits_from_anywhere(setup, method == Method::dynamic ? 1500 : 300);
  }
}

TEST(State, OfRidgesOfParticlesInNumbersGoesOnToTheSameBits) {
  test::PinOnDisc pin = small_case();
  pin.method = Method::dynamic;
  simulation::Setup setup = pin.setup();
  setup.particles.clear();
  setup.contacts[0].static_friction = 0.05;  // they slip in every impact
  setup.contacts.push_back({"iron_ore", "iron_ore", 0.4, 0.5, 0.02});
  setup.run.gravity = {0.0, 0.0, -9.81};
  setup.ploughing = PloughingSetup{.removed_fraction = 0.6};
  InsertionSetup grains;
  grains.name = "grains";
  grains.material = "iron_ore";
  for (int k = 0; k < 6; ++k)
    grains.placed.push_back(
        {{pin.track, 0.61e-3 * (k - 3), 0.29e-3}, 0.3e-3, {0.05, k % 2 == 0 ? 0.4 : -0.4, -0.3}});
  setup.insertions.push_back(grains);
  setup.output.every = {0.001, true};
  expect_same_bits_from_anywhere(setup, 3000);
}

TEST(State, GoesOnToTheSameBitsOnOtherThreads) {
  test::PinOnDisc pin = small_case();
  pin.method = Method::dynamic;
  simulation::Setup setup = pin.setup();
  const ParticleSetup first = setup.particles[0];
  setup.particles.clear();
  setup.contacts.push_back({"iron_ore", "iron_ore", 0.4, 0.5, 0.0});
  for (int k = 0; k < 12; ++k) {
    ParticleSetup p = first;
    const double angle = 2.0 * std::numbers::pi * k / 12.0;
    p.name = std::string("p").append(std::to_string(k));
    p.radius = 1.2e-3;
    p.position = {pin.track * std::cos(angle), pin.track * std::sin(angle), p.radius};
    p.load = {0.0, 0.0, -1.0};
    setup.particles.push_back(p);
  }
  test::expect_same_bits_on_other_threads(setup, 150, 300);
}

TEST(State, LetsTheEndBeMovedFurther) {
  test::PinOnDisc pin = small_case();
  pin.method = Method::dynamic;
  pin.revolutions = 0.004;
  simulation::Setup longer = pin.setup();
  longer.output.every = {0.001, true};
  simulation::Setup shorter = longer;
  shorter.run.end = {0.002, true};
  Simulation whole(longer), first(shorter);
  while (!first.finished()) first.step();
  Simulation rest = loaded(longer, saved(first));
  while (!rest.finished()) rest.step();
  while (!whole.finished()) whole.step();
  EXPECT_EQ(rest.steps(), whole.steps());
  EXPECT_TRUE(saved(rest) == saved(whole));
}

TEST(State, OfAnotherCaseOrDamagedIsRefusedAndNeverMisread) {
  test::PinOnDisc pin = small_case();
  Simulation run(pin.setup());
  finish(run, 20);
  const std::string good = saved(run);
  const auto refusal = [](const simulation::Setup& setup, const std::string& bytes) -> std::string {
    try {
      Simulation fresh(setup);
      core::ArchiveReader archive(bytes);
      fresh.load(archive);
    } catch (const IoError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_EQ(refusal(pin.setup(), good), "");
  test::PinOnDisc finer = pin;
  finer.size = 0.15e-3;
  EXPECT_NE(refusal(finer.setup(), good).find("'vertices' has another length"), std::string::npos);
  simulation::Setup two = pin.setup();
  two.particles.push_back(two.particles[0]);
  two.particles[1].name = "second";
  two.contacts.push_back({"iron_ore", "iron_ore", 0.4, 0.5, 0.0});
  EXPECT_NE(refusal(two, good).find("'position' has another length"), std::string::npos);
  for (std::size_t length = 0; length < good.size(); length += 1499)
    EXPECT_NE(refusal(pin.setup(), good.substr(0, length)), "") << length;
  // Whatever byte is changed: refused, or a state that can be stepped on from.
  core::RandomStream random(3, 1);
  for (int i = 0; i < 100; ++i) {
    std::string bad = good;
    bad[static_cast<std::size_t>(random.uniform() * static_cast<double>(bad.size()))] ^=
        static_cast<char>(1 << (i % 8));
    try {
      Simulation fresh(pin.setup());
      core::ArchiveReader archive(bad);
      fresh.load(archive);
      fresh.step();
    } catch (const Error&) {
    }
  }
}

}  // namespace
}  // namespace abradem::simulation
