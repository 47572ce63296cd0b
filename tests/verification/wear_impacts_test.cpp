// SPDX-License-Identifier: BSD-3-Clause
// Laws of wear beside Archard's, against closed forms. docs/verification/wear.md#laws
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "abradem/core/archive.h"
#include "abradem/geometry/generators.h"
#include "abradem/io/case_file.h"
#include "abradem/io/insertion_files.h"
#include "abradem/simulation/simulation.h"
#include "support/cases.h"
#include "support/reference_data.h"

namespace abradem::test {
namespace {

using namespace simulation;
using wear::Mechanism;

constexpr double kDegree = std::numbers::pi / 180.0;

std::size_t at(Mechanism m) { return static_cast<std::size_t>(m); }

wear::OkaLaw sio2_on(double hardness_GPa) { return wear::OkaLaw::of_hardness(1e9 * hardness_GPa); }

/// The angle functions, against values computed independently.
TEST(ImpactLaws, FollowThePublishedAngleFunctions) {
  wear::OkaLaw fluent;
  fluent.hardness = 1.8, fluent.n1 = 0.8, fluent.n2 = 1.3;
  for (const ReferenceRow& row : reference_rows("erosion_angle_functions.csv")) {
    const double degrees = std::stod(row.at("angle_deg_from_surface")), angle = degrees * kDegree;
    const auto reference = [&](const char* name) { return std::stod(row.at(name)); };
    // The table has sin 2a - 3 sin^2 a, which is twice f for K = 2.
    EXPECT_NEAR(2.0 * wear::finnie_function(2.0, angle), reference("finnie_K2"), 2e-6) << degrees;
    EXPECT_NEAR(wear::oka_function(fluent, angle), reference("fluent_sand_steel(Hv1.8;n1.8;n2 1.3)"), 1e-5)
        << degrees;
    EXPECT_NEAR(wear::oka_function(sio2_on(0.36), angle), reference("oka2005_SiO2(Hv0.36)"), 1e-5) << degrees;
    EXPECT_NEAR(wear::oka_function(sio2_on(1.18), angle), reference("oka2005_SiO2(Hv1.18)"), 1e-5) << degrees;
    EXPECT_NEAR(wear::oka_function(sio2_on(1.8), angle), reference("oka2005_SiO2(Hv1.8)"), 1e-5) << degrees;
  }
  // Most at tan 2a = 2/3, and both branches meet at tan a = 1/3.
  const double peak = 0.5 * std::atan(2.0 / 3.0), joint = std::atan(1.0 / 3.0);
  EXPECT_NEAR(peak / kDegree, 16.845, 1e-3);
  EXPECT_GT(wear::finnie_function(2.0, peak), wear::finnie_function(2.0, peak + 1e-3));
  EXPECT_GT(wear::finnie_function(2.0, peak), wear::finnie_function(2.0, peak - 1e-3));
  EXPECT_NEAR(wear::finnie_function(2.0, joint - 1e-9), wear::finnie_function(2.0, joint + 1e-9), 1e-9);
}

simulation::Setup impact_plate(bool plane) {
  simulation::Setup setup = io::read_case(ABRADEM_SOURCE_DIR "/cases/impact-plate.toml", {});
  io::read_insertion_files(setup);
  if (plane) {
    setup.walls[0].mesh.shape = MeshShape::plane;
    setup.walls[0].deformation = DeformationRule::none;
  }
  setup.run.end.value = 14e-6;
  return setup;
}

/// Single impacts of the ready case, on its mesh and on a plane: every one strikes once, at its angle and
/// speed.
TEST(ImpactLaws, SingleImpactsLieOnTheCurves) {
  WorstError finnie("finnie"), oka("oka");
  for (const bool plane : {false, true}) {
    Simulation run(impact_plate(plane));
    while (!run.finished()) run.step();
    const wear::Laws& laws = run.wear_laws(0, 1);
    ASSERT_TRUE(laws.finnie && laws.oka);
    EXPECT_EQ(run.impacts_on(0).count(), 18u);
    int angles = 0;
    for (const auto& bin : run.impacts_on(0).bins()) {
      if (bin.count == 0) continue;
      const double angle = kDegree * 5.0 * ++angles;
      EXPECT_EQ(bin.count, 1u);
      EXPECT_NEAR(bin.angle / bin.mass, angle, 1e-8);
      const double m = 2650.0 * 4.0 / 3.0 * std::numbers::pi * std::pow(0.163e-3, 3), v = 40.0;
      EXPECT_NEAR(bin.mass / m, 1.0, 1e-12);
      EXPECT_NEAR(bin.speed / bin.mass / v, 1.0, 1e-8);
      // Written out anew, in the units of the papers: mm^3/kg, GPa, degrees.
      const double s = std::sin(angle), c = std::cos(angle);
      const double f = s / c <= 1.0 / 3.0 ? std::sin(2.0 * angle) - 3.0 * s * s : c * c / 3.0;
      const double by_finnie = 2e-11 * m * v * v * 0.5 * f;
      const double Hv = 143.0 * 9.80665e-3;
      const double E90 = 65.0 * std::pow(Hv, -0.12) * std::pow(v / 104.0, 2.3 * std::pow(Hv, 0.038)) *
                         std::pow(326e-6 / 326e-6, 0.19);
      const double g =
          std::pow(s, 0.71 * std::pow(Hv, 0.14)) * std::pow(1.0 + Hv * (1.0 - s), 2.4 * std::pow(Hv, -0.94));
      if (angles < 18) {
        EXPECT_LT(finnie.note(relative_error(bin.finnie, by_finnie)), 1e-6);
      }
      EXPECT_LT(oka.note(relative_error(bin.oka, 1e-9 * m * E90 * g)), 1e-6);
    }
    EXPECT_EQ(angles, 18);
    const Ledger ledger = run.ledger();
    // Of a plane it stands outside the ledger.
    EXPECT_NEAR(wear::total(run.law_volumes(0)) / (plane ? run.plane_volume() : run.law_volume()), 1.0,
                1e-12);
    EXPECT_EQ(plane ? run.law_volume() : run.plane_volume(), 0.0);
    EXPECT_EQ(ledger.planes, run.plane_volume());
    if (plane) continue;
    EXPECT_LT(ledger.residual, 1e-9);
    EXPECT_NEAR(ledger.kappa, 1.0, 1e-9);
  }
}

/// A pin that slides: the work of friction is mu N s.
TEST(ShearWork, IsForceTimesFrictionTimesWay) {
  for (const Method method : {Method::dynamic, Method::quasi_static}) {
    PinOnDisc pin;
    pin.method = method;
    pin.track = 6e-3;
    pin.size = 0.3e-3;
    pin.revolutions = method == Method::dynamic ? 0.01 : 0.25;
    simulation::Setup setup = pin.setup();
    setup.contacts[0].static_friction = 0.35;
    setup.wear[0].laws = {WearLaw::shear_work};
    setup.wear[0].shear_work_coefficient = 1e-13;
    Simulation run(setup);
    // The pin drops onto the disc and sticks first: what comes after the contact has settled is compared.
    const std::uint64_t settled = method == Method::dynamic ? run.total_steps() / 2 : 0;
    double force = 0.0, from = 0.0;
    std::uint64_t steps = 0;
    while (!run.finished()) {
      if (run.steps() == settled) from = run.law_volume();
      run.step();
      if (run.steps() > settled) force += run.force_on(0).normal, ++steps;
    }
    const double way = 6e-3 * std::numbers::pi * static_cast<double>(steps) * run.time_step();
    const double expected = 1e-13 * 0.35 * (force / static_cast<double>(steps)) * way;
    const double error = (run.law_volume() - from) / expected - 1.0;
    RecordProperty(method == Method::dynamic ? "dynamic" : "quasi_static", std::to_string(error));
    EXPECT_NEAR(error, 0.0, 0.005) << (method == Method::dynamic ? "dynamic" : "quasi_static");
    EXPECT_LT(run.ledger().residual, 1e-9);
    EXPECT_EQ(run.law_volumes(0)[at(Mechanism::archard)], 0.0);
  }
}

SphereOnMesh ball(double v_n, double v_t, double e, double mu) {
  SphereOnMesh scene;
  scene.mesh = geometry::make_plate(20e-3, 4e-3, 0.2e-3, 1);
  scene.restitution = e;
  scene.friction = mu;
  scene.shear_modulus = 1e9;
  scene.position = {-2e-3, 0.0, scene.radius + 1e-6};
  scene.velocity = {v_t, 0.0, -v_n};
  scene.time_step = 1e-7;
  scene.end = 3e-4;
  return scene;
}

Simulation impact(const SphereOnMesh& scene, double k_n, double k_t) {
  simulation::Setup setup = scene.setup();
  WearSetup wear{.abrader = "ball", .worn = "wall"};
  wear.laws = {WearLaw::impact_energy};
  wear.normal_energy_coefficient = k_n;
  wear.shear_energy_coefficient = k_t;
  setup.wear = {wear};
  Simulation run(setup, [&](const MeshSetup&, std::uint64_t) { return scene.mesh; });
  while (!run.finished()) run.step();
  return run;
}

/// Head on: the damper takes m v^2 (1 - e^2) / 2. Oblique, slipping all through: friction takes its impulse
/// J = mu m (1 + e) v_n times the mean speed of the surfaces, v_t - 7 J / (4 m).
TEST(ImpactEnergy, IsWhatTheImpactLoses) {
  WorstError normal("normal"), shear("shear");
  for (const double e : {0.3, 0.6, 0.9}) {
    const SphereOnMesh scene = ball(0.5, 0.0, e, 0.0);
    const double E = 0.5 * scene.mass() * 0.25 * (1.0 - e * e);
    EXPECT_LT(normal.note(relative_error(impact(scene, 1e-9, 0.0).law_volume(), 1e-9 * E)), 0.005);

    constexpr double kMu = 0.1, kNormal = 0.3, kTangential = 1.5;
    const SphereOnMesh sliding = ball(kNormal, kTangential, e, kMu);
    const double m = sliding.mass(), J = kMu * m * (1.0 + e) * kNormal;
    EXPECT_LT(shear.note(relative_error(impact(sliding, 0.0, 1e-9).law_volume(),
                                        1e-9 * J * (kTangential - 1.75 * J / m))),
              0.005);
  }
}

/// What sticks or rolls does no work of friction; what never lifts off strikes once.
TEST(ImpactLaws, RollingWearsNothingAndRestStrikesOnce) {
  SphereOnMesh scene = ball(0.0, 0.2, 0.4, 0.5);
  scene.position.z = scene.radius - 1e-7;
  scene.spin = {0.0, 0.2 / scene.radius, 0.0};
  scene.gravity = {0.0, 0.0, -9.81};
  scene.end = 2e-2;
  scene.time_step = 1e-6;
  simulation::Setup setup = scene.setup();
  WearSetup wear{.abrader = "ball", .worn = "wall"};
  wear.laws = {WearLaw::shear_work, WearLaw::finnie};
  wear.shear_work_coefficient = 1e-9;
  wear.finnie_coefficient = 1e-10;
  setup.wear = {wear};
  Simulation run(setup, [&](const MeshSetup&, std::uint64_t) { return scene.mesh; });
  while (!run.finished()) run.step();
  const double full = 1e-9 * 0.5 * scene.mass() * 9.81 * 0.2 * 2e-2;  // were it to slide all the way
  EXPECT_LT(run.law_volumes(0)[at(Mechanism::shear_work)], 1e-3 * full);
  EXPECT_LE(run.impacts_on(0).count(), 3u);
}

/// Cohesion acts from the first touch on, and the laws count speed and angle at the first touch: they wear
/// the same whether the ball parts or sticks, and a ball that sticks and swings has struck once.
TEST(ImpactLaws, CohesionLeavesAnImpactWhatItIs) {
  constexpr double kSpeed = 0.4, kAngle = 40.0 * kDegree;
  WorstError error("error");
  for (const Cohesion cohesion : {Cohesion::none, Cohesion::sjkr, Cohesion::jkr})
    for (const double strength : {1.0, 100.0}) {
      SphereOnMesh scene = ball(kSpeed * std::sin(kAngle), kSpeed * std::cos(kAngle), 0.5, 0.2);
      scene.contact = ContactRule::resolved;
      scene.end = 2e-3;
      simulation::Setup setup = scene.setup();
      setup.materials[1].hardness = 1.4e9;
      setup.contacts[0].cohesion = cohesion;
      setup.contacts[0].cohesion_energy_density = 1e6 * strength;
      setup.contacts[0].work_of_adhesion = 0.05 * strength;
      WearSetup wear{.abrader = "ball", .worn = "wall"};
      wear.laws = {WearLaw::finnie, WearLaw::oka};
      wear.finnie_coefficient = 1e-10;
      setup.wear = {wear};
      Simulation run(setup, [&](const MeshSetup&, std::uint64_t) { return scene.mesh; });
      while (!run.finished()) run.step();
      EXPECT_EQ(run.impacts_on(0).count(), 1u) << static_cast<int>(cohesion) << ", " << strength;
      const wear::Impact impact{kSpeed, kAngle, scene.mass(), 2.0 * scene.radius};
      const wear::Laws& laws = run.wear_laws(0, 1);
      EXPECT_LT(error.note(relative_error(run.law_volumes(0)[at(Mechanism::finnie)],
                                          wear::finnie_volume(*laws.finnie, impact))),
                1e-9);
      EXPECT_LT(error.note(relative_error(run.law_volumes(0)[at(Mechanism::oka)],
                                          wear::oka_volume(*laws.oka, impact))),
                1e-9);
    }
}

/// A run put back in the middle of its impacts goes on to the same bits and the same account.
TEST(ImpactLaws, ARunPutBackAmidImpactsGoesOnTheSame) {
  for (const bool plane : {false, true}) {
    const simulation::Setup setup = impact_plate(plane);
    Simulation whole(setup);
    std::string saved;
    while (!whole.finished()) {
      whole.step();
      if (whole.time() < 10.1e-6 || !saved.empty()) continue;
      core::ArchiveWriter archive;
      whole.save(archive);
      saved = archive.bytes();
    }
    Simulation again(setup);
    core::ArchiveReader archive(saved);
    again.load(archive);
    while (!again.finished()) again.step();
    EXPECT_EQ(again.state_hash(), whole.state_hash());
    EXPECT_EQ(again.law_volumes(0), whole.law_volumes(0));
    EXPECT_EQ(again.impacts_on(0).count(), whole.impacts_on(0).count());
  }
}

}  // namespace
}  // namespace abradem::test
