// SPDX-License-Identifier: BSD-3-Clause
// A law written as an expression against the built-in law that it writes out.
// docs/verification/wear.md#expression
#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "abradem/core/error.h"
#include "abradem/io/case_file.h"
#include "abradem/io/insertion_files.h"
#include "abradem/simulation/simulation.h"
#include "support/cases.h"
#include "support/reference_data.h"
#include "support/state.h"

namespace abradem::test {
namespace {

using namespace simulation;
using wear::Mechanism;
using wear::WearMap;

std::size_t at(Mechanism m) { return static_cast<std::size_t>(m); }

core::NamedQuantity constant(const std::string& name, std::string_view text) {
  const core::Quantity q = core::parse_quantity(text);
  return {name, q.value, q.dimension};
}

void add_expression(WearSetup& w, const std::string& text, std::vector<core::NamedQuantity> constants) {
  w.laws.push_back(WearLaw::expression);
  w.expression = text;
  w.constants = std::move(constants);
}

/// The ready chute, its first wall a plate of its own (`patch`, `resolved` and both at once by size), or a
/// plane.
simulation::Setup chute(double size, bool plane) {
  simulation::Setup setup = io::read_case(ABRADEM_SOURCE_DIR "/cases/transfer-chute.toml",
                                          std::vector<std::string>{"run.end=0.1 s"});
  WallSetup& wall = setup.walls[0];
  wall.mesh.shape = plane ? MeshShape::plane : MeshShape::plate;
  if (plane) wall.deformation = DeformationRule::none;
  wall.mesh.length = 0.6;
  wall.mesh.width = 0.3;
  wall.mesh.size = size;
  setup.walls.resize(1);
  return setup;
}

struct Written {
  Mechanism law;
  WearLaw built_in;
  const char* expression;
};
const Written kWritten[]{
    {Mechanism::archard, WearLaw::archard, "k * Fn * slip"},
    {Mechanism::shear_work, WearLaw::shear_work, "C * shear_work"},
    {Mechanism::impact_energy, WearLaw::impact_energy, "C * normal_work + C * Ft * slip"},
    {Mechanism::finnie, WearLaw::finnie,
     "k * m * v^2 * (6 * sin(angle) <= K * cos(angle) ? (2 * sin(angle) * cos(angle) - 6 / K * "
     "sin(angle)^2) / K : cos(angle)^2 / 6)"}};

/// Grains on a chute that wears: the wall's and each element's volume by the built-in law and by the
/// expression.
TEST(WearExpression, GivesTheVolumesOfTheBuiltInLaws) {
  for (const Written& w : kWritten)
    for (const auto& [size, plane] : {std::pair{10e-3, false}, std::pair{0.0, true}}) {
      SCOPED_TRACE(std::string(w.expression) + (plane ? ", plane" : ""));
      simulation::Setup setup = chute(size, plane);
      setup.output.maps = Maps::on;
      for (WearSetup& pair : setup.wear) {
        pair.laws = {w.built_in};
        pair.wear_coefficient = 1e-9;
        pair.finnie_coefficient = 1e-9;
        pair.shear_work_coefficient = pair.normal_energy_coefficient = pair.shear_energy_coefficient = 2e-9;
        add_expression(pair, w.expression,
                       {constant("k", "1e-9 1/Pa"), constant("C", "2 mm^3/J"), constant("K", "2")});
      }
      Simulation run(setup);
      while (!run.finished()) run.step();
      const wear::MechanismVolumes v = run.law_volumes(0);
      EXPECT_GT(v[at(w.law)], 0.0);
      const double error = relative_error(v[at(Mechanism::expression)], v[at(w.law)]);
      measured(std::string(w.expression).substr(0, 32) + (plane ? ", plane" : ", mesh"), error, 1e-12);
      EXPECT_LT(error, 1e-12);
      if (plane) continue;
      EXPECT_LT(run.ledger().residual, 1e-9);
      double largest = 0.0;
      for (std::size_t t = 0; t < run.map_of(0)->element_count(); ++t) {
        const wear::MechanismVolumes of = run.mapped_volumes(0, t);
        largest = std::max(largest, std::abs(of[at(Mechanism::expression)] - of[at(w.law)]) / v[at(w.law)]);
      }
      EXPECT_LT(largest, 1e-13);
    }
}

/// A pin on a disc that wears: the very bits of Archard's law.
TEST(WearExpression, WearsTheDiscAsArchardDoes) {
  for (const Method method : {Method::dynamic, Method::quasi_static}) {
    PinOnDisc pin;
    pin.method = method;
    pin.track = 6e-3;
    pin.size = 0.2e-3;
    pin.revolutions = method == Method::dynamic ? 0.004 : 0.25;
    const simulation::Setup setup = pin.setup();
    simulation::Setup written = setup;
    written.wear[0].laws.clear();
    add_expression(written.wear[0], "alpha * Fn * slip", {constant("alpha", "6.81e-11 1/Pa")});
    Simulation a(setup), b(written);
    while (!a.finished()) a.step();
    while (!b.finished()) b.step();
    EXPECT_GT(b.ledger().law, 0.0);
    EXPECT_EQ(a.state_hash(), b.state_hash()) << (method == Method::dynamic ? "dynamic" : "quasi_static");
    EXPECT_LT(b.ledger().residual, 1e-9);
    EXPECT_NEAR(b.ledger().kappa, 1.0, 1e-9);
  }
}

/// Eighteen single impacts at 5 … 90 degrees: Finnie's curve.
TEST(WearExpression, LiesOnFinniesCurve) {
  WorstError error("finnie");
  for (const bool plane : {false, true}) {
    simulation::Setup setup = io::read_case(ABRADEM_SOURCE_DIR "/cases/impact-plate.toml", {});
    io::read_insertion_files(setup);
    if (plane)
      setup.walls[0].mesh.shape = MeshShape::plane, setup.walls[0].deformation = DeformationRule::none;
    setup.run.end.value = 14e-6;
    setup.wear[0].laws = {WearLaw::finnie};
    add_expression(setup.wear[0], kWritten[3].expression, {constant("k", "2e-11 1/Pa"), constant("K", "2")});
    Simulation run(setup);
    while (!run.finished()) run.step();
    EXPECT_EQ(run.impacts_on(0).count(), 18u);
    int angles = 0;
    for (const auto& bin : run.impacts_on(0).bins()) {
      if (bin.count == 0 || ++angles == 18) continue;  // nothing at 90 degrees
      EXPECT_GT(bin.expression, 0.0);
      EXPECT_LT(error.note(relative_error(bin.expression, bin.finnie)), 1e-12);
    }
    EXPECT_EQ(angles, 18);
    if (!plane) {
      EXPECT_LT(run.ledger().residual, 1e-9);
    }
  }
}

/// A law of its own kind, on meshes that move and wear: the same bits for any threads, and after being put
/// back.
TEST(WearExpression, IsTheSameForAnyThreadsAndPutBack) {
  simulation::Setup setup = chute(10e-3, false);
  for (WearSetup& w : setup.wear)
    add_expression(w, "k * p_max / E_eff * Fn * slip * (1 + v_slide / v0)",
                   {constant("k", "1e-6 1/Pa"), constant("v0", "1 m/s")});
  std::string first, middle;
  const int threads_before = omp_get_max_threads();
  for (const int threads : {1, 2, 3}) {
    omp_set_num_threads(threads);
    Simulation run(setup);
    while (!run.finished()) {
      run.step();
      if (run.steps() == run.total_steps() * 3 / 4 && middle.empty()) middle = saved(run);
    }
    EXPECT_GT(run.law_volumes(0)[at(Mechanism::expression)], 0.0);
    if (first.empty()) first = saved(run);
    EXPECT_TRUE(saved(run) == first) << threads << " threads";
  }
  omp_set_num_threads(threads_before);
  Simulation again = loaded(setup, middle);
  while (!again.finished()) again.step();
  EXPECT_TRUE(saved(again) == first);
}

/// A modelled revolution stands for several: the volume of an expression counts so many times, as others do.
TEST(WearExpression, IsAccelerated) {
  PinOnDisc pin;
  pin.track = 6e-3;
  pin.size = 0.3e-3;
  simulation::Setup setup = pin.setup();
  setup.walls[0].deformation = DeformationRule::none;
  setup.wear[0].laws.clear();
  add_expression(setup.wear[0], "alpha * Fn * slip", {constant("alpha", "6.81e-11 1/Pa")});
  Simulation whole(setup);
  while (!whole.finished()) whole.step();
  setup.wear[0].acceleration.factor = 4.0;
  Simulation quarter(setup);
  while (!quarter.finished()) quarter.step();
  EXPECT_NEAR(quarter.law_volume() / whole.law_volume(), 1.0, 2e-3);
  EXPECT_LT(quarter.total_steps(), whole.total_steps() / 3);
}

TEST(WearExpression, StopsWhereItIsNoVolume) {
  PinOnDisc pin;
  pin.track = 6e-3;
  simulation::Setup setup = pin.setup();
  setup.wear[0].laws.clear();
  add_expression(setup.wear[0], "alpha * Fn * slip * (1 - v_slide / v0)",
                 {constant("alpha", "6.81e-11 1/Pa"), constant("v0", "5 mm/s")});
  Simulation run(setup);
  try {
    while (!run.finished()) run.step();
    FAIL();
  } catch (const SimulationError& error) {
    const std::string message = error.what();
    EXPECT_TRUE(message.starts_with("step 0, 0 s: wear \"iron_ore/mild_steel\": the expression gives -"))
        << message;
    EXPECT_NE(message.find("where Fn = "), std::string::npos) << message;
  }
}

TEST(WearExpression, AsksForWhatItCannotHave) {
  const auto refused = [](const std::string& text, Method method, bool ploughing) -> std::string {
    PinOnDisc pin;
    pin.method = method;
    simulation::Setup setup = pin.setup();
    setup.wear[0].laws.clear();
    add_expression(setup.wear[0], text, {constant("k", "1e-11 1/Pa")});
    if (ploughing) setup.ploughing = PloughingSetup{.removed_fraction = 0.5};
    try {
      const Simulation run(setup);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_NE(refused("k * m * v^2", Method::quasi_static, false).find("no impacts"), std::string::npos);
  EXPECT_NE(refused("k * normal_work", Method::quasi_static, false).find("use method dynamic"),
            std::string::npos);
  EXPECT_NE(refused("k * Fn * slip", Method::dynamic, true).find("Archard's law"), std::string::npos);
  EXPECT_EQ(refused("k * Fn * slip", Method::quasi_static, false), "accepted");
  EXPECT_EQ(refused("k * normal_work", Method::dynamic, false), "accepted");
}

}  // namespace
}  // namespace abradem::test
