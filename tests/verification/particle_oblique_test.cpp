// SPDX-License-Identifier: BSD-3-Clause
// Oblique and spinning impacts: Chung & Ooi (2011) tests 4, 5, 7 and 8. Tolerances and measured errors:
// docs/verification/particles.md. Spin and patch speed: v_patch = v_x - omega_y R, the centre moving along
// +x.
#include <gtest/gtest.h>

#include <numbers>

#include "support/reference_data.h"
#include "support/scene_builder.h"

namespace abradem::test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double kGrossSlip = 0.005, kStick = 0.03;
constexpr int kStepsPerContact = 1000;

const Elastic kAlOxide{380e9, 0.23, 4000.0}, kSteel{208e9, 0.3, 7850.0}, kPolyethylene{1e9, 0.4, 1400.0};
const Elastic kAlAlloy{70e9, 0.33, 2700.0}, kCopper{120e9, 0.35, 8900.0};

double mass_of(const Elastic& m, double R) { return m.density * 4.0 / 3.0 * pi * R * R * R; }

struct Rebound {
  double v_x, v_n, spin, patch;  ///< after the impact [m/s, m/s, rad/s, m/s]
  double energy;                 ///< kinetic energy after / before
};

/// A sphere of material m meets the floor at v_n (down) and v_t (along x), with a spin about y.
Rebound bounce(const Floor& floor, const Elastic& m, double R, double v_n, double v_t, double spin,
               const Meeting& meeting, int steps = kStepsPerContact) {
  const HertzImpact hertz(m.E / (1.0 - m.nu * m.nu), R, mass_of(m, R), v_n);
  simulation::Simulation run =
      SceneBuilder()
          .material("sphere", m)
          .rigid("wall", m)
          .meeting("sphere", "wall", meeting)
          .sphere("sphere", R, {0.0, 0.0, R}, {v_t, 0.0, -v_n}, {0.0, spin, 0.0})
          .floor(floor, "wall", std::sqrt(R * hertz.overlap), 1.3 * v_t * hertz.duration)
          .time(hertz.duration / steps, 20.0 * hertz.duration)
          .build();
  const double before = run.kinetic_energy();
  const bool ended =
      run_impact(run, [R](const simulation::Simulation& s) { return s.particles().position[0].z - R; }).ended;
  EXPECT_TRUE(ended);
  const Vec3 v = run.particles().velocity[0], w = run.particles().spin[0];
  return {v.x, v.z, w.y, v.x - w.y * R, run.kinetic_energy() / before};
}

/// Test 4: |v| = 3.9 m/s at 5 to 85 degrees from the normal. Gross slip against the hard sphere, stick
/// against an independent integration of the same spring. Angles are compared through their tangents; a spin
/// below a tenth of that of gross slip, a small difference of large impulses, is compared with that tenth (5
/// degrees only).
TEST(ChungOoi4, ObliqueImpactsLeaveAsTheyShould) {
  constexpr double R = 2.5e-3, speed = 3.9, e = 0.98, mu = 0.092;
  WorstError slip("gross_slip"), stick("stick"), gain("energy_gain");
  for (const ReferenceRow& row : reference_rows("chung_ooi_test4_oblique.csv"))
    for (const Floor& floor : floors()) {
      SCOPED_TRACE(row.at("angle_deg") + " degrees, " + floor.name);
      const double angle = std::stod(row.at("angle_deg")) * pi / 180.0;
      const double v_t = speed * std::sin(angle), v_n = speed * std::cos(angle);
      const Rebound out = bounce(floor, kAlOxide, R, v_n, v_t, 0.0, {e, mu, 0.0});
      const bool gross = row.at("gross_slip") == "1";
      const std::string kind = gross ? "_analytic" : "_hm_integrator";
      const double tolerance = gross ? kGrossSlip : kStick;
      WorstError& worst = gross ? slip : stick;
      const double spin = -std::stod(row.at(gross ? "omega_analytic_rad_s" : "omega_hm_integrator_rad_s"));
      const double spin_scale = std::max(spin, 0.1 * 2.5 * mu * (1.0 + e) * v_n / R);
      const double rebound = std::stod(row.at("patch_rebound_deg" + kind)) * pi / 180.0;
      EXPECT_LT(worst.note(relative_error(out.v_x / v_t, std::stod(row.at("et" + kind)))), tolerance);
      EXPECT_LT(worst.note(std::abs(out.spin - spin) / spin_scale), tolerance);
      EXPECT_LT(worst.note(relative_error(out.patch / out.v_n, std::tan(rebound))), tolerance);
      gain.note(out.energy - 1.0);
      EXPECT_LT(out.energy, 1.0);
    }
}

/// Test 5: v_n = 5 m/s, v_t = 0.1 to 21 m/s, in the normalised angles tan / mu of the source.
TEST(ChungOoi5, NormalisedReboundsFollowTheReference) {
  constexpr double R = 1e-5, v_n = 5.0, mu = 0.3;
  WorstError slip("gross_slip"), stick("stick"), gain("energy_gain");
  for (const ReferenceRow& row : reference_rows("chung_ooi_test5_vt.csv"))
    for (const Floor& floor : floors()) {
      SCOPED_TRACE(row.at("material") + ", " + row.at("vt_m_s") + " m/s, " + floor.name);
      const Elastic& m = row.at("material") == "steel" ? kSteel : kPolyethylene;
      const Rebound out = bounce(floor, m, R, v_n, std::stod(row.at("vt_m_s")), 0.0, {1.0, mu, 0.0});
      const bool gross = !row.at("norm_omega_gross_slip").empty();
      const double rebound = std::stod(row.at(gross ? "norm_rebound_gross_slip(=nia-7)" : "norm_rebound_hm"));
      const double spin = std::stod(row.at(gross ? "norm_omega_gross_slip" : "norm_rebound_omega_hm"));
      const double tolerance = gross ? kGrossSlip : kStick;
      WorstError& worst = gross ? slip : stick;
      EXPECT_LT(worst.note(relative_error(out.patch / out.v_n / mu, rebound)), tolerance);
      EXPECT_LT(worst.note(relative_error(-out.spin * R / (mu * v_n), spin)), tolerance);
      gain.note(out.energy - 1.0);
      EXPECT_LT(out.energy, 1.0);
    }
}

/// The limit of the law: in a stick impact of an undamped pair the patch speed comes back by a factor that
/// depends on Poisson's ratio alone and exceeds 1 below nu = 0.25 (theory/contact.md). Factors from an
/// independent integration with 6000 steps per contact.
TEST(TangentialSpring, PatchSpeedInStickDependsOnPoissonsRatioAlone) {
  WorstError worst("patch_speed");
  const std::vector<std::pair<double, double>> factors{{0.0, 1.03757}, {0.1, 1.05143}, {0.2, 1.02946},
                                                       {0.25, 1.0},    {0.3, 0.95485}, {0.4, 0.80517},
                                                       {0.5, 0.55304}};
  for (const auto& [nu, factor] : factors)
    for (const double v_t : {0.1, 1.0}) {
      const Rebound out =
          bounce(floors().front(), {208e9, nu, 7850.0}, 1e-5, 5.0, v_t, 0.0, {1.0, 10.0, 0.0});
      EXPECT_LT(worst.note(relative_error(out.patch / v_t, factor)), 0.005) << nu;
    }
}

/// The path of a contact is its elastic displacement plus its plastic slip, step by step, so that wear by
/// slip neither misses nor invents sliding while the load changes.
TEST(TangentialSpring, ElasticAndPlasticPathsAddUp) {
  material::PairProperties pair = material::effective_moduli_on_rigid({2700.0, 26e9, 0.33});
  pair.static_friction = 0.3;
  contact::TangentialHistory history;
  double path = 0.0, slip = 0.0;
  constexpr double dt = 1e-7, R = 1e-3, v = 0.01;
  for (int i = 0; i < 2000; ++i) {
    const double delta = 1e-6 * (1.0 + 0.9 * std::sin(0.05 * i));
    const contact::ContactState state{{0.0, 0.0, 1.0},
                                      contact::hertz_force(pair, R, delta),
                                      contact::contact_radius(R, delta),
                                      1e-5,
                                      {v, 0.0, 0.0}};
    slip += contact::hertz_mindlin(pair, state, dt, history).slip;
    path += v * dt;
  }
  EXPECT_GT(slip, 0.1 * path);
  EXPECT_LT(relative_error(slip + history.s.x, path), 1e-12);
}

/// A sphere that spins backwards on the floor: gross slip gives v_t = mu (1 + e) v_n whatever the spin.
TEST(ChungOoi6, SpinningSphereInGrossSlip) {
  constexpr double R = 0.1, v_n = 0.2, e = 0.5, mu = 0.4;
  WorstError worst("gross_slip");
  for (const Floor& floor : floors())
    for (const double spin : {8.75, 14.0, 17.5}) {
      SCOPED_TRACE(std::string(floor.name) + ", spin " + std::to_string(spin));
      const Rebound out = bounce(floor, kAlAlloy, R, v_n, 0.0, spin, {e, mu, 0.0});
      EXPECT_LT(worst.note(relative_error(out.v_x, mu * (1.0 + e) * v_n)), 0.01);
      EXPECT_LT(worst.note(relative_error(out.spin, spin - 2.5 * mu * (1.0 + e) * v_n / R)), 0.01);
    }
}

/// Test 7: two equal spheres whose surfaces do not slip where they meet keep their spins.
TEST(ChungOoi7, EqualSurfaceSpeedsKeepTheirSpins) {
  constexpr double R = 0.1, v = 0.2;
  WorstError spin("spin"), normal("normal"), tangential("tangential");
  for (const Elastic& m : {kAlAlloy, kCopper})
    for (const double w : {0.175, 1.75, 17.5}) {
      const HertzImpact hertz(m.E / (2.0 * (1.0 - m.nu * m.nu)), R / 2.0, mass_of(m, R) / 2.0, 2.0 * v);
      simulation::Simulation run = SceneBuilder()
                                       .material("sphere", m)
                                       .meeting("sphere", "sphere", {0.5, 0.4, 0.0})
                                       .sphere("sphere", R, {0.0, 0.0, R}, {0.0, 0.0, -v}, {w, 0.0, 0.0})
                                       .sphere("sphere", R, {0.0, 0.0, -R}, {0.0, 0.0, v}, {-w, 0.0, 0.0})
                                       .time(hertz.duration / kStepsPerContact, 5.0 * hertz.duration)
                                       .build();
      ASSERT_TRUE(run_impact(run, [](const simulation::Simulation& s) {
                    return s.particles().position[0].z - s.particles().position[1].z - 2.0 * R;
                  }).ended);
      for (std::size_t i : {std::size_t{0}, std::size_t{1}}) {
        EXPECT_LT(spin.note(relative_error(run.particles().spin[i].x, i == 0 ? w : -w)), 1e-6);
        EXPECT_LT(normal.note(relative_error(std::abs(run.particles().velocity[i].z), 0.5 * v)), 0.01);
        EXPECT_LT(tangential.note(std::abs(run.particles().velocity[i].y)), 1e-9);  // [m/s], beside 0.2
      }
    }
}

/// Test 8: a spinning sphere on one of five times its radius and 1000 times its density, at rest. Gross slip.
TEST(ChungOoi8, SpinningSphereOnAHeavyOneInGrossSlip) {
  constexpr double R = 0.1, v = 0.2, e = 0.5, mu = 0.4;
  WorstError worst("gross_slip");
  for (const Elastic& m : {Elastic{140e9, 0.33, 2700.0}, Elastic{2.5e9, 0.4, 1000.0}})
    for (const double spin : {8.75, 10.5, 14.0, 17.5}) {
      const HertzImpact hertz(m.E / (2.0 * (1.0 - m.nu * m.nu)), R * 5.0 / 6.0, mass_of(m, R), v);
      simulation::Simulation run =
          SceneBuilder()
              .material("light", m)
              .material("heavy", {m.E, m.nu, 1000.0 * m.density})
              .meeting("light", "heavy", {e, mu, 0.0})
              .sphere("light", R, {0.0, 0.0, 6.0 * R}, {0.0, 0.0, -v}, {0.0, spin, 0.0})
              .sphere("heavy", 5.0 * R, {})
              .time(hertz.duration / kStepsPerContact, 5.0 * hertz.duration)
              .build();
      ASSERT_TRUE(run_impact(run, [](const simulation::Simulation& s) {
                    return norm(s.particles().position[0] - s.particles().position[1]) - 6.0 * R;
                  }).ended);
      EXPECT_LT(worst.note(relative_error(run.particles().velocity[0].x, mu * (1.0 + e) * v)), 0.01) << spin;
      EXPECT_LT(worst.note(relative_error(run.particles().spin[0].y, spin - 2.5 * mu * (1.0 + e) * v / R)),
                0.01)
          << spin;
    }
}

}  // namespace
}  // namespace abradem::test
