// SPDX-License-Identifier: BSD-3-Clause
// Normal impacts: Chung & Ooi (2011) tests 1, 2 and 3. Tolerances and measured errors:
// docs/verification/particles.md
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "support/reference_data.h"
#include "support/scene_builder.h"

namespace abradem::test {
namespace {

constexpr double kOverlapAndForce = 0.005, kDuration = 0.01, kExitSpeed = 0.001;
constexpr int kStepsPerContact = 1000;

nlohmann::json chung_ooi(const char* test) {
  std::ifstream in(data_file("chung_ooi_2011.json"));
  return nlohmann::json::parse(in).at("tests").at(test);
}

Elastic elastic(const nlohmann::json& m) { return {m.at("E"), m.at("nu"), m.at("rho")}; }

double mass_of(const Elastic& m, double R) { return m.density * 4.0 / 3.0 * std::numbers::pi * R * R * R; }

double height_above_floor(const simulation::Simulation& run) {
  return run.particles().position[0].z - run.particles().radius[0];
}

/// A sphere dropped on the floor at speed v; the closed-form impact sets step and mesh.
simulation::Simulation drop(const Floor& floor, const Elastic& m, double R, double v,
                            const Meeting& meeting) {
  const HertzImpact hertz(m.E / (1.0 - m.nu * m.nu), R, mass_of(m, R), v);
  return SceneBuilder()
      .material("sphere", m)
      .rigid("wall", m)
      .meeting("sphere", "wall", meeting)
      .sphere("sphere", R, {0.0, 0.0, R}, {0.0, 0.0, -v})
      .floor(floor, "wall", std::sqrt(R * hertz.overlap))
      .time(hertz.duration / kStepsPerContact, 20.0 * hertz.duration)
      .build();
}

/// Two equal spheres against the closed form of Hertz. Measured: force 9e-7, duration 2e-6, exit 3e-10.
TEST(ChungOoi1, EqualSpheresMeetAsHertzSays) {
  const nlohmann::json test = chung_ooi("1");
  WorstError overlap("overlap"), force("force"), duration("duration"), exit("exit");
  for (const char* name : {"glass", "limestone"}) {
    SCOPED_TRACE(name);
    const nlohmann::json& data = test.at(name);
    const double R = data.at("R"), v = 0.5 * data.at("v_rel").get<double>(),
                 reference = data.at("t_contact_s");
    simulation::Simulation run = SceneBuilder()
                                     .material("sphere", elastic(data))
                                     .meeting("sphere", "sphere", {1.0, 0.35, 0.0})
                                     .sphere("sphere", R, {0.0, 0.0, R}, {0.0, 0.0, -v})
                                     .sphere("sphere", R, {0.0, 0.0, -R}, {0.0, 0.0, v})
                                     .time(reference / kStepsPerContact, 2.0 * reference)
                                     .build();
    const Impact impact = run_impact(run, [R](const simulation::Simulation& s) {
      return s.particles().position[0].z - s.particles().position[1].z - 2.0 * R;
    });
    ASSERT_TRUE(impact.ended);
    EXPECT_LT(overlap.note(relative_error(impact.overlap, data.at("delta_max_m"))), kOverlapAndForce);
    EXPECT_LT(force.note(relative_error(impact.force, data.at("F_max_N"))), kOverlapAndForce);
    EXPECT_LT(duration.note(relative_error(impact.duration, reference)), kDuration);
    EXPECT_LT(exit.note(relative_error(run.particles().velocity[0].z, v)), kExitSpeed);
  }
}

/// A sphere on a rigid plane against the closed form of Hertz, on every floor.
TEST(ChungOoi2, SphereMeetsARigidPlaneAsHertzSays) {
  const nlohmann::json test = chung_ooi("2");
  WorstError overlap("overlap"), force("force"), duration("duration"), exit("exit");
  for (const char* name : {"al_alloy", "mg_alloy"})
    for (const Floor& floor : floors()) {
      SCOPED_TRACE(std::string(name) + ", " + floor.name);
      const nlohmann::json& data = test.at(name);
      const double v = data.at("v");
      simulation::Simulation run = drop(floor, elastic(data), data.at("R"), v, {1.0, 0.35, 0.0});
      const Impact impact = run_impact(run, height_above_floor);
      ASSERT_TRUE(impact.ended);
      EXPECT_LT(overlap.note(relative_error(impact.overlap, data.at("delta_max_m"))), kOverlapAndForce);
      EXPECT_LT(force.note(relative_error(impact.force, data.at("F_max_N"))), kOverlapAndForce);
      EXPECT_LT(duration.note(relative_error(impact.duration, data.at("t_contact_s"))), kDuration);
      EXPECT_LT(exit.note(relative_error(run.particles().velocity[0].z, v)), kExitSpeed);
    }
}

/// The speed ratio is the restitution asked for. A force clipped at zero in the tail before release would
/// give 0.325, 0.472, 0.632 and 0.808 for 0.2, 0.4, 0.6 and 0.8.
TEST(ChungOoi3, RestitutionComesBack) {
  const nlohmann::json test = chung_ooi("3");
  WorstError worst("restitution");
  for (const char* name : {"al_oxide", "cast_iron"})
    for (const Floor& floor : floors())
      for (const double e : {0.2, 0.4, 0.6, 0.8, 1.0}) {
        SCOPED_TRACE(std::string(name) + ", " + floor.name + ", e = " + std::to_string(e));
        simulation::Simulation run = drop(floor, elastic(test.at(name)), 2.5e-3, 3.9, {e, 0.0, 0.0});
        ASSERT_TRUE(run_impact(run, height_above_floor).ended);
        EXPECT_LT(worst.note(relative_error(run.particles().velocity[0].z / 3.9, e)), 0.01);
      }
}

/// Hertz with the damper of Tsuji et al. (1992) has no scale of speed: over four decades the restitution
/// stays.
TEST(ChungOoi3, RestitutionDoesNotDependOnTheSpeed) {
  const Elastic al_oxide = elastic(chung_ooi("3").at("al_oxide"));
  WorstError worst("restitution");
  for (const double v : {1e-3, 1e-1, 10.0}) {
    simulation::Simulation run = drop(floors().front(), al_oxide, 2.5e-3, v, {0.5, 0.0, 0.0});
    ASSERT_TRUE(run_impact(run, height_above_floor).ended);
    EXPECT_LT(worst.note(relative_error(run.particles().velocity[0].z / v, 0.5)), 0.01);
  }
}

}  // namespace
}  // namespace abradem::test
