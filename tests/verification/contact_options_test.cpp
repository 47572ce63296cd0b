// SPDX-License-Identifier: BSD-3-Clause
// Linear springs, cohesion, rolling friction of type C, torsion: against closed forms and published results.
// docs/verification/particles.md#options
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "abradem/contact/full_law.h"
#include "support/grains.h"
#include "support/reference_data.h"

namespace abradem::test {
namespace {

constexpr double pi = std::numbers::pi, g = 9.81, R = 3e-3, density = 2500.0;
const double m = density * 4.0 / 3.0 * pi * R * R * R;

/// Who meets: two grains in numbers; one and a plane, or a mesh; a named sphere and a plane.
enum class Who { pair, plane, mesh, named };
constexpr Who kAll[]{Who::pair, Who::plane, Who::mesh, Who::named};
constexpr Who kOnFloor[]{Who::plane, Who::mesh, Who::named};
const char* name_of(Who who) {
  constexpr const char* kNames[]{"two grains", "grain on plane", "grain on mesh", "named sphere on plane"};
  return kNames[static_cast<int>(who)];
}

/// A grain of radius R at a height over the floor z = 0, or over another one below it that is at z = -R.
struct Scene {
  Who who;
  simulation::Setup setup;

  Scene(Who who_, double restitution, double friction, double rolling)
      : who(who_), setup(grains(1.0, 0.0, 0.0)) {
    setup.contacts[0].restitution = restitution;
    setup.contacts[0].static_friction = friction;
    setup.contacts[0].rolling_friction = rolling;
    if (who != Who::pair) setup.walls = {plane("floor", {0, 0, 0}, {0, 0, 1})};
    if (who == Who::mesh) {
      setup.walls[0].mesh.shape = MeshShape::plate;
      setup.walls[0].mesh.length = setup.walls[0].mesh.width = 0.1;
      setup.walls[0].mesh.size = 0.05;
      setup.walls[0].contact = ContactRule::resolved;
    }
  }
  ContactSetup& contact() { return setup.contacts[0]; }
  /// Two grains meet with half the speed (spin) each, from both sides.
  Simulation at(double height, const Vec3& velocity, const Vec3& spin, double dt) {
    setup.run.time_step = {dt, false};
    setup.run.end = {1e3, false};
    setup.output.every = {1e3, false};
    const double share = who == Who::pair ? 0.5 : 1.0;
    ParticleSetup sphere;
    sphere.name = "sphere";
    sphere.material = "grain";
    sphere.radius = R;
    sphere.position = {1e-3, 2e-3, R + height};
    sphere.velocity = share * velocity;
    sphere.spin = share * spin;
    setup.particles = {sphere};
    if (who == Who::pair) {
      ParticleSetup other = sphere;
      other.name = "other";
      other.position.z = -R;
      other.velocity = -share * velocity;
      other.spin = -share * spin;
      setup.particles.push_back(other);
    }
    if (who == Who::plane || who == Who::mesh) {
      setup.insertions[0].placed = {{sphere.position, R, sphere.velocity, sphere.spin}};
      setup.particles.clear();
    } else {
      setup.insertions.clear();
    }
    return Simulation(setup);
  }
};

/// Of two equal grains or of one on a wall of its own material.
double effective_modulus() {
  const double E = 2.0 * 1e7 * 1.25;
  return 0.5 * E / (1.0 - 0.25 * 0.25);
}
double effective_radius(Who who) { return who == Who::pair ? 0.5 * R : R; }
double effective_mass(Who who) { return who == Who::pair ? 0.5 * m : m; }

struct State {
  Vec3 x, v, w;
};
/// Of the grain relative to the other body.
State state(const Simulation& run, Who who) {
  if (who == Who::plane || who == Who::mesh) {
    const contact::SphereRow& s = run.bulk()->spheres().row[0];
    return {s.position() - Vec3{0, 0, R}, s.velocity(), s.spin()};
  }
  const Particles& p = run.particles();
  if (who == Who::named) return {p.position[0] - Vec3{0, 0, R}, p.velocity[0], p.spin[0]};
  return {p.position[0] - p.position[1] - Vec3{0, 0, 2.0 * R}, p.velocity[0] - p.velocity[1],
          p.spin[0] - p.spin[1]};
}

/// v(t) of a linear oscillator: exit speed e v, contact pi / omega_d.
TEST(LinearLaw, ReturnsItsRestitutionAfterHalfAPeriod) {
  constexpr double k = 1e4, v = 0.5;
  WorstError exit("exit_speed"), duration("duration");
  for (const Who who : kAll)
    for (const double e : {0.2, 0.6, 1.0}) {
      SCOPED_TRACE(std::string(name_of(who)) + ", e = " + std::to_string(e));
      Scene scene(who, e, 0.3, 0.0);
      scene.contact().law = ContactLaw::linear;
      scene.contact().normal_stiffness = k;
      const double beta = material::damping_ratio(e), omega = std::sqrt(k / effective_mass(who));
      const double expected = pi / (omega * std::sqrt(1.0 - beta * beta)), dt = expected / 2000.0;
      Simulation run = scene.at(0.5 * v * dt, {0, 0, -v}, {}, dt);
      double begin = 0.0, end = 0.0;
      for (int step = 0; step < 2200 && end == 0.0; ++step) {
        run.step();
        const double gap = state(run, who).x.z;
        if (begin == 0.0 && gap < 0.0) begin = run.time() - dt;
        if (begin != 0.0 && gap > 0.0) end = run.time();
      }
      EXPECT_LT(exit.note(std::abs(state(run, who).v.z / v - e)), 0.005);
      EXPECT_LT(duration.note(relative_error(end - begin, expected)), 0.005);
    }
}

/// Johnson, Kendall and Roberts (1971): the pull-off force, and the force where the contact snaps.
TEST(Jkr, PullsOffAtThreeHalvesPiWR) {
  constexpr double w = 0.3;
  material::PairProperties pair;
  pair.E_eff = effective_modulus();
  pair.G_eff = 1e6;
  pair.options.adhesion = w;
  const contact::PairConstants constants = contact::PairConstants::of(pair);
  const double snap = contact::stretch_at_snap(constants, R);
  const auto force = [&](double overlap) {
    contact::ContactChunk c{};
    contact::OptionsChunk o{};
    c.set_constants(0, constants);
    o.set_constants(0, constants);
    c.nz[0] = 1.0, c.overlap[0] = overlap, c.R_eff[0] = R, c.m_eff[0] = m;
    o.a_c[0] = contact::snapping_radius(constants, R);
    o.held[0] = 1.0;
    for (std::size_t k = 1; k < 8; ++k) c.copy(0, k), o.copy(0, k);
    contact::full_law_loop(c, o, 8, 1e-6);
    return c.F_n[0];
  };
  double lowest = 0.0;
  for (int k = 0; k <= 20000; ++k) lowest = std::min(lowest, force(-snap * k / 20000.0));
  const double pull_off = 1.5 * pi * w * R;
  EXPECT_NEAR(lowest / -pull_off, 1.0, 1e-7);
  EXPECT_NEAR(force(-snap * (1.0 - 1e-12)) / -pull_off, 5.0 / 9.0, 1e-5);
  EXPECT_NEAR(force(0.0) / -pull_off, 8.0 / 9.0, 1e-12);
  EXPECT_EQ(force(-snap * (1.0 + 1e-9)), 0.0);
  // The curve itself, by its parameter a: overlap = a^2/R - sqrt(2 pi w a / E), F = 4 E a^3 / 3R - sqrt(8 pi
  // w E a^3).
  const double a_c = contact::snapping_radius(constants, R), E = pair.E_eff;
  for (const double a : {1.05 * a_c, 1.3 * a_c, 2.0 * a_c, 5.0 * a_c, 40.0 * a_c}) {
    const double F = 4.0 * E * a * a * a / (3.0 * R) - std::sqrt(8.0 * pi * w * E * a * a * a);
    EXPECT_NEAR(force(a * a / R - std::sqrt(2.0 * pi * w * a / E)), F, 1e-9 * (pull_off + std::abs(F)));
  }
}

/// Thornton and Ning (1998): elastic spheres stick below V_s = sqrt(14.18 / m (w^5 R^4 / E^2)^(1/3)) and part
/// at sqrt(V^2 - V_s^2) above it.
TEST(Jkr, SticksAndReboundsAsThorntonAndNing) {
  constexpr double w = 0.5, kApart = 1e-5;  // four times the way from zero overlap to the snap
  WorstError worst("rebound");
  for (const Who who : kAll) {
    SCOPED_TRACE(name_of(who));
    const double R_eff = effective_radius(who), E = effective_modulus();
    const double V_s =
        std::sqrt(14.18 / effective_mass(who) * std::cbrt(std::pow(w, 5.0) * std::pow(R_eff, 4.0) / (E * E)));
    for (const double ratio : {0.97, 1.1, 2.0, 5.0}) {
      Scene scene(who, 1.0, 0.4, 0.0);
      scene.contact().cohesion = Cohesion::jkr;
      scene.contact().work_of_adhesion = w;
      const double duration = material::hertz_time(E, R_eff, effective_mass(who), V_s),
                   dt = duration / 4000.0;
      Simulation run = scene.at(0.1 * ratio * V_s * dt, {0, 0, -ratio * V_s}, {}, dt);
      for (int step = 0; step < 30000; ++step) run.step();
      const State end = state(run, who);
      if (ratio < 1.0) {
        EXPECT_LT(std::abs(end.x.z), kApart) << "ratio " << ratio;  // still there
      } else {
        EXPECT_GT(end.x.z, kApart);
        const double expected = std::sqrt(ratio * ratio - 1.0);
        EXPECT_LT(worst.note(std::abs(end.v.z / V_s - expected) / expected), 0.01) << "ratio " << ratio;
      }
    }
  }
}

/// Two bodies that SJKR draws together come to rest where Hertz's force is k_c times the area.
TEST(Sjkr, ComesToRestWhereHertzCarriesTheCohesion) {
  constexpr double k_c = 2e5;
  WorstError worst("overlap");
  for (const Who who : kAll) {
    SCOPED_TRACE(name_of(who));
    const double E = effective_modulus(), R_eff = effective_radius(who);
    double overlap = 1e-6;
    for (int k = 0; k < 200; ++k) {
      const double d = 2.0 * R - overlap, area = who == Who::pair
                                                     ? 0.25 * pi * (4.0 * R * R - d * d)
                                                     : pi * (2.0 * R * overlap - overlap * overlap);
      overlap = std::pow(k_c * area / (4.0 / 3.0 * E * std::sqrt(R_eff)), 2.0 / 3.0);
    }
    Scene scene(who, 0.1, 0.4, 0.0);
    scene.contact().cohesion = Cohesion::sjkr;
    scene.contact().cohesion_energy_density = k_c;
    Simulation run = scene.at(-0.5 * overlap, {}, {}, 2e-6);
    for (int step = 0; step < 20000; ++step) run.step();
    EXPECT_LT(worst.note(relative_error(-state(run, who).x.z, overlap)), 1e-4);
  }
}

/// On the floor under its weight, at Hertz's overlap.
Simulation lying(Scene& scene, double theta, const Vec3& velocity, const Vec3& spin, double dt) {
  scene.setup.run.gravity = {g * std::sin(theta), 0.0, -g * std::cos(theta)};
  material::PairProperties pair;
  pair.E_eff = effective_modulus();
  return scene.at(-contact::hertz_overlap(pair, R, m * g * std::cos(theta)), velocity, spin, dt);
}

/// Type C holds a sphere on a slope below mu_r: it rocks about its place with the frequency of the two
/// springs (x'' = -S/m (x - y), y'' = 5/2 S/m (x - 2 y), the slow one S/m (3 - sqrt(6.5))), and does not
/// creep.
TEST(RollingSpring, HoldsASphereOnASlope) {
  const double theta = 3.0 * pi / 180.0, dt = 4e-6;
  WorstError period("period");
  for (const Who who : kOnFloor) {
    SCOPED_TRACE(name_of(who));
    Scene scene(who, 0.5, 0.8, 0.2);
    scene.contact().rolling_model = RollingModel::epsd2;
    Simulation run = lying(scene, theta, {}, {}, dt);
    material::PairProperties pair;
    pair.E_eff = effective_modulus();
    const double a = std::sqrt(R * contact::hertz_overlap(pair, R, m * g * std::cos(theta)));
    const double G_eff = 1e7 / (2.0 * (2.0 - 0.25)), S = 8.0 * G_eff * a;
    const double expected = 2.0 * pi / std::sqrt((3.0 - std::sqrt(6.5)) * S / m);
    // From turning point to turning point of the spin.
    double before = 0.0, first = 0.0, last = 0.0;
    int turns = 0;
    while (run.time() < 20.0 * expected) {
      run.step();
      const double w = state(run, who).w.y;
      if (before > 0.0 && w <= 0.0) {
        last = run.time() - dt * w / (w - before);
        if (turns++ == 0) first = last;
      }
      before = w;
    }
    ASSERT_GT(turns, 10);
    EXPECT_LT(period.note(relative_error((last - first) / (turns - 1), expected)), 0.01);
    // At most what a frictionless start swings out to: twice the springs' displacements under the weight.
    const double still = m * g * std::sin(theta) / S;
    EXPECT_LT(std::abs(state(run, who).x.x - 1e-3), 2.1 * 2.0 * still);
  }
}

TEST(RollingSpring, RollsOnWhereTheSlopeIsSteeper) {
  const double theta = 20.0 * pi / 180.0, dt = 4e-6, mu_r = 0.1, end = 0.03;
  const double expected = 5.0 / 7.0 * g * (std::sin(theta) - mu_r * std::cos(theta));
  WorstError worst("acceleration");
  for (const Who who : kOnFloor) {
    SCOPED_TRACE(name_of(who));
    Scene scene(who, 0.5, 0.8, mu_r);
    scene.contact().rolling_model = RollingModel::epsd2;
    Simulation run = lying(scene, theta, {}, {}, dt);
    while (run.time() < 0.5 * end) run.step();
    const double v = state(run, who).v.x, t = run.time();
    while (run.time() < end) run.step();
    EXPECT_LT(worst.note(relative_error((state(run, who).v.x - v) / (run.time() - t), expected)), 0.005);
  }
}

/// Spin about the normal: it falls by (2/3) a mu F / I while the circle slides, then the sphere rocks on the
/// spring S a^2 / 2.
TEST(Torsion, StopsASpinAboutTheNormal) {
  constexpr double mu = 0.5, dt = 4e-6;
  WorstError worst("spin"), period("period");
  for (const Who who : kOnFloor) {
    SCOPED_TRACE(name_of(who));
    material::PairProperties pair;
    pair.E_eff = effective_modulus();
    const double a = std::sqrt(R * contact::hertz_overlap(pair, R, m * g));
    const double slowing = 2.0 / 3.0 * a * mu * m * g / (0.4 * m * R * R), w0 = slowing * 0.05;
    Scene scene(who, 0.5, mu, 0.0);
    scene.contact().torsion = Torsion::marshall;
    Simulation run = lying(scene, 0.0, {}, {0, 0, w0}, dt);
    while (run.time() < 0.01) run.step();
    const double w1 = state(run, who).w.z, t1 = run.time();
    while (run.time() < 0.03) run.step();
    EXPECT_LT(worst.note(relative_error(w1 - state(run, who).w.z, slowing * (run.time() - t1))), 0.005);
    const double S = 8.0 * 1e7 / (2.0 * (2.0 - 0.25)) * a;
    const double expected = 2.0 * pi / std::sqrt(0.5 * S * a * a / (0.4 * m * R * R));
    double before = state(run, who).w.z, first = 0.0, last = 0.0;
    for (int crossings = 0; crossings < 3 && run.time() < 0.5;) {
      run.step();
      const double w = state(run, who).w.z;
      if ((before > 0.0) != (w > 0.0)) {
        last = run.time();
        if (crossings++ == 0) first = last;
      }
      before = w;
    }
    EXPECT_LT(period.note(relative_error(last - first, expected)), 0.005);
  }
}

}  // namespace
}  // namespace abradem::test
