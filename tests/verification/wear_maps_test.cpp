// SPDX-License-Identifier: BSD-3-Clause
// Maps and spectra of what a wall suffers, against closed forms. docs/verification/wear.md#maps
#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "abradem/core/error.h"
#include "abradem/geometry/generators.h"
#include "abradem/io/case_file.h"
#include "abradem/simulation/simulation.h"
#include "support/cases.h"
#include "support/reference_data.h"
#include "support/state.h"

namespace abradem::test {
namespace {

using namespace simulation;
using wear::WearMap;

WearMap::Element sum_of(const WearMap& map) {
  WearMap::Element sum;
  for (std::size_t t = 0; t < map.element_count(); ++t) sum += map.total(t);
  return sum;
}

/// A ball on a plate of fine (patch) or coarse (resolved) triangles.
SphereOnMesh on_plate(double edge, ContactRule contact) {
  SphereOnMesh scene;
  scene.mesh = geometry::make_plate(20e-3, 8e-3, edge, 1);
  scene.contact = contact;
  scene.restitution = 0.6;
  scene.shear_modulus = 1e9;
  scene.position = {-3e-3, 0.0, scene.radius + 1e-6};
  scene.time_step = 1e-7;
  scene.end = 3e-4;
  return scene;
}

Simulation mapped(const SphereOnMesh& scene) {
  simulation::Setup setup = scene.setup();
  setup.wear = {{"ball", "wall", 1e-12}};
  setup.output.maps = Maps::on;
  Simulation run(setup, [&](const MeshSetup&, std::uint64_t) { return scene.mesh; });
  while (!run.finished()) run.step();
  return run;
}

/// Head on: one impact, its kinetic energy, what the damper takes, and the pressure of Hertz.
TEST(WearMaps, OfOneImpact) {
  WorstError normal("normal"), pressure("pressure");
  for (const auto& [edge, contact] :
       {std::pair{0.02e-3, ContactRule::patch}, std::pair{0.2e-3, ContactRule::patch},
        std::pair{3e-3, ContactRule::resolved}}) {
    SphereOnMesh scene = on_plate(edge, contact);
    if (edge < 0.1e-3) scene.mesh = geometry::make_plate(1e-3, 1e-3, edge, 1), scene.position.x = 0.0;
    constexpr double kSpeed = 0.5;
    scene.velocity = {0.0, 0.0, -kSpeed};
    const Simulation run = mapped(scene);
    ASSERT_NE(run.map_of(0), nullptr);
    const WearMap::Element sum = sum_of(*run.map_of(0));
    const double E = 0.5 * scene.mass() * kSpeed * kSpeed;
    EXPECT_EQ(sum.impacts.count, 1u);
    EXPECT_NEAR(sum.impacts.energy() / E, 1.0, 1e-9);
    EXPECT_LT(normal.note(relative_error(sum.normal_work, E * (1.0 - 0.36))), 0.005);
    EXPECT_EQ(sum.shear_work, 0.0);
    const auto& spectra = run.map_of(0)->layers()[0].regions[0];
    ASSERT_EQ(spectra.impacts.entries().size(), 1u);
    const wear::Impact mean = spectra.impacts.entries()[0].sums.mean();
    EXPECT_NEAR(mean.speed / kSpeed, 1.0, 1e-9);
    EXPECT_NEAR(mean.angle, 0.5 * std::numbers::pi, 1e-6);
    if (edge > 0.1e-3) continue;
    // The largest force F: p0 = 3 F / (2 pi a^2) in the middle.
    Simulation again(scene.setup(), [&](const MeshSetup&, std::uint64_t) { return scene.mesh; });
    double F = 0.0;
    while (!again.finished()) again.step(), F = std::max(F, again.force_on(0).normal);
    const double E_eff = 2.0 * 1e9 * 1.24 / (1.0 - 0.24 * 0.24);
    const double a2 = std::pow(3.0 * F * scene.radius / (4.0 * E_eff), 2.0 / 3.0);
    EXPECT_LT(pressure.note(relative_error(sum.peak_pressure, 1.5 * F / (std::numbers::pi * a2))), 0.02);
  }
}

/// Head on by laws beside Hertz-Mindlin: what the damper takes is what the ball has lost; of JKR's also the
/// work of its hysteresis, 7.09 (w^5 R^4 / E^2)^(1/3) [Thornton & Ning 1998], which is not the damper's.
TEST(WearMaps, NormalWorkOfOtherLaws) {
  constexpr double kSpeed = 0.1, kDense = 1e-9, w = 5.0;
  enum class Where { mesh, named_on_plane, grain_on_plane };
  for (const auto& [law, name] : {std::pair{Cohesion::none, "linear"}, std::pair{Cohesion::sjkr, "sjkr"},
                                  std::pair{Cohesion::jkr, "jkr"}})
    for (const double e : {0.5, 0.8}) {
      WorstError error(std::string(name) + ", e = " + std::to_string(e).substr(0, 3));
      for (const Where where : {Where::mesh, Where::named_on_plane, Where::grain_on_plane}) {
        SphereOnMesh scene = on_plate(3e-3, ContactRule::resolved);
        scene.shear_modulus = 0.1e9;
        scene.velocity = {0.0, 0.0, -kSpeed};
        scene.restitution = e;
        scene.end = 8e-4;
        simulation::Setup setup = scene.setup();
        ContactSetup& contact = setup.contacts[0];
        contact.cohesion = law;
        contact.cohesion_energy_density = 2e5;
        contact.work_of_adhesion = w;
        if (law == Cohesion::none) contact.law = ContactLaw::linear, contact.normal_stiffness = 1e5;
        WearSetup wear{.abrader = "ball", .worn = "wall"};
        wear.laws = {WearLaw::impact_energy};
        wear.normal_energy_coefficient = kDense;
        setup.wear = {wear};
        setup.output.maps = Maps::on;
        if (where != Where::mesh) setup.walls[0].mesh.shape = MeshShape::plane;
        if (where == Where::grain_on_plane) {
          InsertionSetup grain;
          grain.name = "grain";
          grain.material = "ball";
          grain.placed = {{scene.position, scene.radius, scene.velocity}};
          setup.insertions = {grain};
          setup.particles.clear();
          setup.contacts.push_back({"ball", "ball", e, 0.0, 0.0});
        }
        Simulation run(setup, [&](const MeshSetup&, std::uint64_t) { return scene.mesh; });
        while (!run.finished()) run.step();
        const double v = where == Where::grain_on_plane ? run.bulk()->spheres().row[0].velocity().z
                                                        : run.particles().velocity[0].z;
        const double m = scene.mass(), energy = 0.5 * m * kSpeed * kSpeed;
        ASSERT_GT(v, 0.0) << name << ": it has not parted";
        double expected = energy - 0.5 * m * v * v;
        if (law == Cohesion::none) expected = energy * (1.0 - e * e);
        if (law == Cohesion::jkr) {
          const double R = scene.radius, E = scene.pair().E_eff;
          expected -= 7.09 * std::cbrt(std::pow(w, 5) * std::pow(R, 4) / (E * E));
        }
        const double lost =
            run.law_volumes(0)[static_cast<std::size_t>(wear::Mechanism::impact_energy)] / kDense;
        EXPECT_LT(error.note(std::abs(lost - expected) / energy), 0.005) << static_cast<int>(where);
        if (where == Where::mesh) {
          EXPECT_NEAR(sum_of(*run.map_of(0)).normal_work / lost, 1.0, 1e-12);
        }
      }
    }
}

/// A slide: the sums over the elements are those of the contact, whatever the mesh.
TEST(WearMaps, OfASlideAddUpToTheContact) {
  constexpr double kMu = 0.2;
  for (const auto& [edge, contact] :
       {std::pair{0.1e-3, ContactRule::patch}, std::pair{0.1e-3, ContactRule::per_triangle},
        std::pair{0.3e-3, ContactRule::resolved}, std::pair{3e-3, ContactRule::resolved},
        std::pair{0.1e-3, ContactRule::automatic}, std::pair{3e-3, ContactRule::automatic}}) {
    SphereOnMesh scene = on_plate(edge, contact);
    scene.guided = true;
    scene.friction = kMu;
    scene.load = {0.0, 0.0, -2.0};
    scene.motion.kind = MotionKind::translation;
    scene.motion.velocity = {-5.0, 0.0, 0.0};
    simulation::Setup setup = scene.setup();
    setup.wear = {{"ball", "wall", 1e-12}};
    setup.output.maps = Maps::on;
    setup.regions = {{"left", "wall", {-10e-3, -4e-3, -1e-3}, {-2.5e-3, 4e-3, 1e-3}}};
    Simulation run(setup, [&](const MeshSetup&, std::uint64_t) { return scene.mesh; });
    double force_sliding = 0.0, work = 0.0, sliding = 0.0;
    while (!run.finished()) {
      run.step();
      for (const SphereWall::Touch& t : run.contact(0, 0).touches()) {
        const double slip =
            contact == ContactRule::per_triangle ? t.force.v_t * run.time_step() : t.force.slip;
        force_sliding += std::max(t.force.F_n, 0.0) * slip;
        work += norm(t.force.F_t) * slip;
        sliding += slip;
      }
    }
    const WearMap& map = *run.map_of(0);
    const WearMap::Element sum = sum_of(map);
    EXPECT_GT(sliding, 1e-3);
    EXPECT_NEAR(sum.force_sliding / force_sliding, 1.0, 1e-12);
    EXPECT_NEAR(sum.shear_work / work, 1.0, 1e-12);
    EXPECT_NEAR(sum.sliding / sliding, 1.0, 1e-12);
    EXPECT_NEAR(1e-12 * sum.force_sliding / run.law_volume(), 1.0, 1e-12);
    // Element by element: what the law took is its coefficient times the sum.
    const auto volume = run.walls()[0].surface().element_volume();
    for (std::size_t t = 0; t < volume.size(); ++t)
      EXPECT_NEAR(run.mapped_volumes(0, t)[0], volume[t], 1e-11 * volume[t] + 1e-14 * run.law_volume());
    // The spectra hold the same sums, by region.
    double by_region[2]{};
    for (std::size_t r = 0; r < 2; ++r)
      for (const auto& [key, s] : map.layers()[0].regions[r].sliding.entries())
        by_region[r] += s.force_sliding;
    EXPECT_NEAR((by_region[0] + by_region[1]) / force_sliding, 1.0, 1e-12);
    EXPECT_GT(by_region[0], 0.0);
    EXPECT_GT(by_region[1], 0.2 * force_sliding);
    EXPECT_EQ(run.regions_of(0), (std::vector<std::string>{"left", "wall"}));
  }
}

simulation::Setup chute() {
  simulation::Setup setup = io::read_case(ABRADEM_SOURCE_DIR "/cases/transfer-chute.toml",
                                          std::vector<std::string>{"run.end=0.12 s"});
  for (WearSetup& w : setup.wear) {
    w.laws = {WearLaw::archard, WearLaw::shear_work, WearLaw::finnie};
    w.shear_work_coefficient = 1e-9;
    w.finnie_coefficient = 1e-9;
  }
  setup.walls[0].mesh.shape = MeshShape::plate;
  setup.walls[0].mesh.length = 0.6;
  setup.walls[0].mesh.width = 0.3;
  setup.walls[0].mesh.size = 10e-3;
  setup.walls.resize(1);
  return setup;
}

/// Two planes at an angle, of triangles between fine and coarse, so that `auto` takes both rules at once and
/// shares each contact: the shares of the map add up all the same, and the wear closes.
TEST(WearMaps, OfContactsThatTwoRulesShare) {
  SphereOnMesh scene = on_plate(0.1e-3, ContactRule::automatic);
  scene.mesh = geometry::make_plate(2e-3, 2e-3, 0.18e-3, 1);
  for (Vec3& x : scene.mesh.vertices) x.z = 0.2 * std::abs(x.x);
  scene.position = {0.0, 0.0, 3.001e-3 * std::sqrt(1.04)};
  scene.friction = 0.3;
  scene.guided = true;
  scene.load = {0.0, 0.0, -4.0};
  scene.motion.kind = MotionKind::translation;
  scene.motion.velocity = {0.0, -0.5, 0.0};
  scene.deformation = DeformationRule::conserving;
  scene.end = 4e-4;
  simulation::Setup setup = scene.setup();
  setup.wear = {{"ball", "wall", 1e-12}};
  setup.output.maps = Maps::on;
  Simulation run(setup, [&](const MeshSetup&, std::uint64_t) { return scene.mesh; });
  double force_sliding = 0.0, work = 0.0, sliding = 0.0;
  int shared = 0, both = 0;
  while (!run.finished()) {
    run.step();
    const auto& touches = run.contact(0, 0).touches();
    for (const SphereWall::Touch& t : touches) {
      force_sliding += std::max(t.force.F_n, 0.0) * t.force.slip;
      work += norm(t.force.F_t) * t.force.slip;
      sliding += t.weight * t.force.slip;
      shared += t.weight < 1.0;
    }
    both += std::ranges::any_of(touches, &SphereWall::Touch::of_point) &&
            !std::ranges::all_of(touches, &SphereWall::Touch::of_point);
  }
  EXPECT_GT(both, 100);
  EXPECT_GT(shared, 200);
  const WearMap::Element sum = sum_of(*run.map_of(0));
  EXPECT_GT(sliding, 1e-5);
  EXPECT_NEAR(sum.force_sliding / force_sliding, 1.0, 1e-12);
  EXPECT_NEAR(sum.shear_work / work, 1.0, 1e-12);
  EXPECT_NEAR(sum.sliding / sliding, 1.0, 1e-12);
  EXPECT_NEAR(1e-12 * sum.force_sliding / run.law_volume(), 1.0, 1e-12);
  const Ledger ledger = run.ledger();
  EXPECT_LT(ledger.residual, 1e-9);
  EXPECT_NEAR(ledger.kappa, 1.0, 1e-9);
}

/// What ploughing moves aside has no map, and a case that asks for one is told so.
TEST(WearMaps, AreRefusedWithPloughing) {
  PinOnDisc pin;
  simulation::Setup setup = pin.setup();
  setup.ploughing = PloughingSetup{.removed_fraction = 0.6};
  setup.output.maps = Maps::on;
  try {
    const Simulation run(setup);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()),
              "output.maps: what [ploughing] moves aside has no map; use maps = \"off\"");
  }
  setup.output.maps = Maps::automatic;
  EXPECT_EQ(Simulation(setup).map_of(0), nullptr);
  setup.ploughing->removed_fraction = 1.0;  // nothing is moved aside
  setup.output.maps = Maps::on;
  EXPECT_NE(Simulation(setup).map_of(0), nullptr);
}

/// With maps or without, on any number of threads: the same bits; and a run put back goes on to the same map.
TEST(WearMaps, ChangeNothingAndAreTheSameForAnyThreads) {
  simulation::Setup setup = chute();
  setup.output.maps = Maps::off;
  Simulation plain(setup);
  while (!plain.finished()) plain.step();
  EXPECT_EQ(plain.map_of(0), nullptr);
  setup.output.maps = Maps::automatic;
  std::string first, middle;
  const int threads_before = omp_get_max_threads();
  for (const int threads : {1, 2, 3}) {
    omp_set_num_threads(threads);
    Simulation run(setup);
    while (!run.finished()) {
      run.step();
      if (run.steps() == run.total_steps() * 3 / 4 && middle.empty()) middle = saved(run);
    }
    EXPECT_EQ(run.state_hash(), plain.state_hash());
    EXPECT_EQ(run.law_volume(), plain.law_volume());
    if (first.empty()) first = saved(run);
    EXPECT_TRUE(saved(run) == first) << threads << " threads";
    const WearMap::Element sum = sum_of(*run.map_of(0));
    EXPECT_GT(sum.impacts.count, 10u);
    EXPECT_EQ(sum.impacts.count, run.impacts_on(0).count());
    EXPECT_NEAR(sum.finnie / run.law_volumes(0)[static_cast<std::size_t>(wear::Mechanism::finnie)], 1.0,
                1e-12);
  }
  omp_set_num_threads(threads_before);
  Simulation again = loaded(setup, middle);
  while (!again.finished()) again.step();
  EXPECT_TRUE(saved(again) == first);
}

TEST(WearMaps, ClassesHoldTheirNumbers) {
  for (const double x : {1e-300, 3e-7, 0.0625, 0.999, 1.0, 1.125, 7.9, 1e20}) {
    const std::uint16_t k = wear::eighth_octave(x);
    EXPECT_LE(wear::low_of_eighth_octave(k), x);
    EXPECT_GT(wear::low_of_eighth_octave(static_cast<std::uint16_t>(k + 1)), x);
    EXPECT_LE(wear::low_of_eighth_octave(static_cast<std::uint16_t>(k + 1)),
              1.125 * wear::low_of_eighth_octave(k));
  }
  EXPECT_EQ(wear::eighth_octave(0.0), 0);
}

}  // namespace
}  // namespace abradem::test
