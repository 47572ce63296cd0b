// SPDX-License-Identifier: BSD-3-Clause
// Spheres in numbers against the same spheres by name, whose impacts, slides and rolls are compared with
// closed forms and Chung & Ooi's reference. docs/verification/bulk.md#coverage
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "support/grains.h"
#include "support/reference_data.h"

namespace abradem::test {
namespace {

constexpr double pi = std::numbers::pi, R = 5e-3;

struct Floor {
  std::string name;
  bool mesh = false;
  ContactRule rule = ContactRule::resolved;
  double size = 0.0;
};

const Floor kFloors[]{{"plane"},
                      {"resolved", true, ContactRule::resolved, 20e-3},
                      {"patch", true, ContactRule::patch, 0.3e-3},
                      {"auto", true, ContactRule::automatic, 0.8e-3}};

/// One sphere above or on a floor of another material.
simulation::Setup scene(const Floor& floor, const ContactSetup& pair, const Vec3& velocity, double height,
                        const Vec3& spin = {}) {
  simulation::Setup setup = grains(1.0, 0.0, 0.0);
  setup.materials.push_back({"wall", 7800.0, 1e8, 0.3, {}});
  setup.contacts.push_back(pair);
  setup.contacts.back().first = "grain", setup.contacts.back().second = "wall";
  setup.walls = {plane("floor", {0, 0, 0}, {0, 0, 1})};
  setup.walls[0].material = "wall";
  if (floor.mesh) {
    setup.walls[0].mesh.shape = MeshShape::plate;
    setup.walls[0].mesh.length = 60e-3;
    setup.walls[0].mesh.width = 24e-3;
    setup.walls[0].mesh.size = floor.size;
    setup.walls[0].contact = floor.rule;
  }
  setup.insertions[0].placed = {{{0.3e-3, 0.2e-3, R + height}, R, velocity, spin}};
  setup.run.time_step = {4e-6, false};
  return setup;
}

/// Runs the sphere in numbers and by name; the largest difference of places over R, velocities over `speed`,
/// spins over speed/R.
double difference(simulation::Setup setup, double end, double speed) {
  const OneThread alone;
  const auto run_to_end = [&](const simulation::Setup& s) {
    Simulation run(s);
    while (run.time() < end) run.step();
    return run;
  };
  const Simulation numbers = run_to_end(setup);
  ParticleSetup named;
  named.name = "sphere";
  named.material = "grain";
  named.radius = R;
  named.position = setup.insertions[0].placed[0].position;
  named.velocity = setup.insertions[0].placed[0].velocity;
  named.spin = setup.insertions[0].placed[0].spin;
  setup.particles = {named};
  setup.insertions.clear();
  const Simulation one = run_to_end(setup);
  const contact::SphereRow& s = numbers.bulk()->spheres().row[0];
  EXPECT_NE(s.velocity(), named.velocity);  // something happened
  return std::max({norm(s.position() - one.particles().position[0]) / R,
                   norm(s.velocity() - one.particles().velocity[0]) / speed,
                   norm(s.spin() - one.particles().spin[0]) * R / speed});
}

TEST(InNumbers, ImpactsAreThoseOfASphereWithAName) {
  for (const Floor& floor : kFloors) {
    double worst = 0.0;
    for (const double e : {0.2, 0.6, 1.0})
      for (const double degrees : {0.0, 10.0, 30.0, 60.0, 85.0}) {
        const double a = degrees * pi / 180.0, v = 0.5;
        const ContactSetup pair{"", "", e, 0.3, 0.0};
        worst = std::max(
            worst, difference(scene(floor, pair, {v * std::sin(a), 0.0, -v * std::cos(a)}, 10e-6), 6e-3, v));
      }
    // The sums over the triangles of a patch have the order in which its list was gathered.
    EXPECT_LT(worst, floor.rule == ContactRule::patch ? 1e-6 : 1e-9) << floor.name;
    RecordProperty(floor.name, std::to_string(1e12 * worst) + "e-12");
  }
}

/// As Chung & Ooi's test 6, also obliquely, and about the normal, which torsion alone can feel.
TEST(InNumbers, ImpactsWithSpinAreThoseOfASphereWithAName) {
  for (const Floor& floor : kFloors) {
    double worst = 0.0;
    for (const Torsion torsion : {Torsion::none, Torsion::marshall})
      for (const RollingModel model : {RollingModel::constant, RollingModel::epsd2})
        for (const Vec3& spin : {Vec3{0, 80, 0}, Vec3{0, 0, 120}, Vec3{30, -60, 90}})
          for (const double v_t : {0.0, 0.2}) {
            ContactSetup pair{"", "", 0.5, 0.3, 0.05};
            pair.torsion = torsion;
            pair.rolling_model = model;
            worst = std::max(worst, difference(scene(floor, pair, {v_t, 0.0, -0.3}, 10e-6, spin), 6e-3, 0.3));
          }
    EXPECT_LT(worst, floor.rule == ContactRule::patch ? 1e-6 : 1e-9) << floor.name;
    RecordProperty(floor.name, std::to_string(1e12 * worst) + "e-12");
  }
}

/// Chung & Ooi's test 6: gross slip gives v_t = mu (1 + e) v_n whatever the spin.
TEST(InNumbers, SpinningSpheresLeaveInGrossSlipAsLawsOfImpactSay) {
  constexpr double v_n = 0.2, e = 0.5, mu = 0.4;
  WorstError worst("gross_slip");
  for (const Floor& floor : kFloors)
    for (const double spin : {175.0, 280.0, 350.0}) {  // with the source's ratios of spin R to v_n
      simulation::Setup setup = scene(floor, {"", "", e, mu, 0.0}, {0.0, 0.0, -v_n}, 10e-6, {0.0, spin, 0.0});
      Simulation run(setup);
      while (run.time() < 6e-3) run.step();
      const contact::SphereRow& s = run.bulk()->spheres().row[0];
      ASSERT_GT(s.velocity().z, 0.0);
      EXPECT_LT(worst.note(relative_error(s.velocity().x, mu * (1.0 + e) * v_n)), 0.01) << floor.name;
      EXPECT_LT(worst.note(relative_error(s.spin().y, spin - 2.5 * mu * (1.0 + e) * v_n / R)), 0.01)
          << floor.name;
    }
}

TEST(InNumbers, SlidesAndRollsAreThoseOfASphereWithAName) {
  for (const Floor& floor : kFloors) {
    double worst = 0.0;
    for (const RollingModel model : {RollingModel::constant, RollingModel::epsd2})
      for (const double rolling : {0.0, 0.05, 0.5})
        for (const double degrees : {0.0, 10.0, 40.0}) {  // slip to roll; rolls or rests; slides
          const double a = degrees * pi / 180.0;
          ContactSetup pair{"", "", 0.5, 0.2, rolling};
          pair.rolling_model = model;
          simulation::Setup setup = scene(floor, pair, {degrees == 0.0 ? 0.1 : 0.0, 0.0, 0.0}, 0.0);
          setup.run.gravity = {9.81 * std::sin(a), 0.0, -9.81 * std::cos(a)};
          worst = std::max(worst, difference(setup, 0.03, 0.1));
        }
    EXPECT_LT(worst, 1e-9) << floor.name;
    RecordProperty(floor.name, std::to_string(1e12 * worst) + "e-12");
  }
}

}  // namespace
}  // namespace abradem::test
