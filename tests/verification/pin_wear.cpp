// SPDX-License-Identifier: BSD-3-Clause
// The worn tip of a guided sphere: against the closed form of a sphere on a hard disc, and its groove against
// an elastic half-space. docs/verification/groove.md
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <numbers>

#include "support/cases.h"
#include "support/grooves.h"
#include "support/table.h"

namespace abradem::test {
namespace {

using std::numbers::pi;

/// A sphere that wears and rubs to and fro on a hard plate.
simulation::Setup hard_plate(double R, double load, double pin_coefficient, double cycles, bool plane,
                             simulation::ContactRule rule, double size) {
  PinOnPlate pin;
  pin.shear_modulus = 100e9;
  pin.amplitude = 0.5e-3;
  simulation::Setup s = pin.setup();
  s.materials[1].shear_modulus = 100e9;
  s.wear = {{"iron_ore", "mild_steel", 0.0}, {"mild_steel", "iron_ore", pin_coefficient}};
  s.particles[0].radius = R;
  s.particles[0].position = {0.0, 0.0, R};
  s.particles[0].load = {0.0, 0.0, -load};
  simulation::WallSetup& wall = s.walls[0];
  wall.deformation = simulation::DeformationRule::none;
  wall.contact = rule;
  wall.mesh.length = 1.6e-3;
  wall.mesh.width = 0.5e-3;
  wall.mesh.size = size;
  if (plane) wall.mesh.shape = simulation::MeshShape::plane;
  s.run.end = {cycles, true};
  s.output.every = s.run.end;
  s.run.increment = 20e-6;
  return s;
}

struct HardDisc {
  const char* name;
  bool plane;
  simulation::ContactRule rule;
  double size;
};
void PrintTo(const HardDisc& c, std::ostream* out) { *out << c.name; }

class SphereOnHardDisc : public testing::TestWithParam<HardDisc> {};

TEST_P(SphereOnHardDisc, HasTheFlatOfTheClosedForm) {
  const HardDisc c = GetParam();
  const Table table("giwm_sphere_pin.csv");
  const std::vector<double> load = table.numbers("load_N"), way = table.numbers("distance_m"),
                            volume = table.numbers("V_mm3"), height = table.numbers("h_exact_um");
  constexpr double R = 0.794e-3, kCycles = 10.0, kWay = kCycles * 4.0 * 0.5e-3;  // of the cosine's speed
  for (std::size_t i = 0; i < load.size(); ++i) {
    // One load of the table on the plane, its middle on meshes.
    if (load[i] != 0.4 || (!c.plane && way[i] != 10.0)) continue;
    // The same product of coefficient and distance in a shorter way.
    const double alpha = 1e-14 * way[i] / kWay;
    simulation::Simulation run(hard_plate(R, load[i], alpha, kCycles, c.plane, c.rule, c.size));
    run.advance();
    ASSERT_TRUE(run.finished());
    const simulation::Ledger ledger = run.ledger();
    const wear::WearingTip& tip = *run.tip(0);
    const std::string name = fmt::format("{}, {} N, {} m: ", c.name, load[i], way[i]);
    measured(name + "tip's ledger", ledger.tip_residual, 1e-9);
    EXPECT_LT(ledger.tip_residual, 1e-9);
    const double V = 1e9 * tip.removed_volume() / volume[i] - 1.0;
    const double h = 1e6 * tip.deepest() / height[i] - 1.0;
    const double a = std::sqrt(R * 2.0 * 1e-6 * height[i]);
    const double flat = tip.flat(0.0).along_s / (2.0 * a) - 1.0;
    measured(name + "volume", V, 0.01);
    measured(name + "height worn off", h, 0.02);
    measured(name + "length of the flat", flat, 0.1);
    EXPECT_LT(std::abs(flat), 0.1);
    EXPECT_LT(std::abs(V), 0.01);
    EXPECT_LT(std::abs(h), 0.02);
  }
}
INSTANTIATE_TEST_SUITE_P(
    Floors, SphereOnHardDisc,
    testing::Values(
        HardDisc{"analytic plane", true, simulation::ContactRule::patch, 0.0},
        HardDisc{"patch, triangles 0.03 mm", false, simulation::ContactRule::patch, 0.03e-3},
        HardDisc{"patch, triangles 0.2 mm", false, simulation::ContactRule::patch, 0.2e-3},
        HardDisc{"resolved, triangles 0.05 mm", false, simulation::ContactRule::resolved, 0.05e-3},
        HardDisc{"per_triangle, triangles 0.05 mm", false, simulation::ContactRule::per_triangle, 0.05e-3}));

/// The laboratory's groove with a stiff pin that wears, in a few passes on a plate.
struct WornPin {
  double ratio = 0.002;  ///< pin's coefficient / disc's
  double depth, width;   ///< half-space [m]
  double bound = 0.03;
  double size = 0.025e-3;
};
void PrintTo(const WornPin& c, std::ostream* out) { *out << "ratio " << c.ratio; }

class WornPinGroove : public testing::TestWithParam<WornPin> {};

TEST_P(WornPinGroove, IsThatOfTheHalfSpace) {
  const WornPin c = GetParam();
  PinOnPlate pin;
  pin.shear_modulus = 30e9;
  pin.passes = 12;
  pin.wear_per_pass = 6.28e-13 * 1302.5 / 12.0;
  pin.size = c.size;
  pin.amplitude = 0.9e-3;
  pin.half_width = 0.5e-3;
  pin.margin = 0.4e-3;
  simulation::Setup s = pin.setup();
  // The pin slides the laboratory's track in each pass, which the plate's is a part of.
  const double track = 2.0 * pi * 22e-3, pass = 2.0 * pin.amplitude;
  s.wear.push_back({"mild_steel", "iron_ore", c.ratio * pin.wear_per_pass * track / pass});
  simulation::Simulation run(s);
  run.advance();
  const Groove groove = measure_plate(run, 0.2e-3);
  const double depth = groove.depth / c.depth - 1.0, width = groove.width / c.width - 1.0;
  const std::string name = fmt::format("pin to disc {}: ", c.ratio);
  measured(name + "depth against the half-space", depth, c.bound);
  measured(name + "width against the half-space", width, c.bound);
  EXPECT_LT(std::abs(depth), c.bound);
  EXPECT_LT(std::abs(width), c.bound);
  EXPECT_LT(run.ledger().residual, 1e-9);
  EXPECT_LT(run.ledger().tip_residual, 1e-9);
}
INSTANTIATE_TEST_SUITE_P(Ratios, WornPinGroove,
                         testing::Values(WornPin{0.001, 10.3e-6, 0.60e-3}, WornPin{0.002, 9.7e-6, 0.64e-3},
                                         WornPin{0.005, 8.7e-6, 0.71e-3, 0.04}));

/// A flat ten times as long as the first contact: which of its places is the deepest changes all the time.
TEST(WornPin, GroovesUnderPointContactsAsUnderPatches) {
  PinOnPlate pin;
  pin.shear_modulus = 30e9;
  pin.passes = 8;
  pin.wear_per_pass = 6.28e-13 * 1302.5 / pin.passes;
  pin.size = 0.1e-3;
  pin.amplitude = 0.9e-3;
  pin.half_width = 0.9e-3;
  pin.margin = 0.8e-3;
  pin.friction = 1.0;
  Groove groove[2];
  for (const auto rule : {simulation::ContactRule::patch, simulation::ContactRule::resolved}) {
    simulation::Setup s = pin.setup();
    s.walls[0].contact = rule;
    s.wear.push_back({"mild_steel", "iron_ore", 3.3});
    s.wear[1].wear_coefficient *= pin.wear_per_pass;
    simulation::Simulation run(s);
    run.advance();
    ASSERT_TRUE(run.finished());
    EXPECT_LT(run.ledger().residual, 1e-9);
    EXPECT_LT(run.ledger().tip_residual, 1e-9);
    EXPECT_GT(run.tip(0)->flat(0.0).along_s, 1.0e-3);
    groove[rule == simulation::ContactRule::resolved] = measure_plate(run, 0.2e-3);
  }
  const double depth = groove[1].depth / groove[0].depth - 1.0,
               width = groove[1].width / groove[0].width - 1.0;
  measured("large flat, resolved against patch: depth", depth, 0.05);
  measured("large flat, resolved against patch: width", width, 0.05);
  EXPECT_LT(std::abs(depth), 0.05);
  EXPECT_LT(std::abs(width), 0.05);
}

}  // namespace
}  // namespace abradem::test
