// SPDX-License-Identifier: BSD-3-Clause
// Ridges of ploughed material: what leaves the groove and is not lost lies beside it.
// docs/verification/groove.md
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <numbers>

#include "abradem/analysis/wall_contours.h"
#include "support/cases.h"
#include "support/grooves.h"

namespace abradem::test {
namespace {

struct Furrow {
  analysis::RidgeSummary sections;
  double left = 0.0, right = 0.0;  ///< ridge areas on either side [m^2]
  simulation::Ledger ledger;
};

constexpr int kSections = 400;

Furrow furrow(const PinOnPlate& pin, double removed_fraction, double ahead = 0.0) {
  simulation::Setup s = pin.setup();
  s.ploughing = simulation::PloughingSetup{.removed_fraction = removed_fraction, .ahead = ahead};
  simulation::Simulation run(s);
  run.advance();
  const wear::WearingSurface& surface = run.walls()[0].surface();
  const auto region = analysis::worn_region(surface.mesh(), surface.reference());
  analysis::StraightCuts cuts;
  // The whole of it: the areas are then volumes, whatever place each pile took along the way.
  const double half_length = pin.amplitude + pin.margin;
  cuts.along = {-half_length, half_length};
  cuts.count = kSections;
  Furrow result;
  result.ledger = run.ledger();
  std::vector<analysis::Contour> contours =
      analysis::cut_contours(surface.mesh(), surface.reference(), region, cuts);
  result.sections = analysis::ridge_summary(contours);
  // Of the sections that meet the groove, as ridge_summary counts them.
  const auto met = static_cast<double>(
      std::ranges::count_if(contours, [](const analysis::Contour& c) { return !c.profile.empty(); }));
  for (const analysis::Contour& c : contours) {
    std::vector<analysis::Contour> half(1);
    std::ranges::copy_if(c.profile, std::back_inserter(half[0].profile),
                         [](const auto& p) { return p.radius > 0.0; });
    result.left += analysis::ridge_summary(half).ridge_area / met;
  }
  result.right = result.sections.ridge_area - result.left;
  return result;
}

struct Case {
  const char* name;
  int passes;
  double wear, removed, bound;  ///< of (ridge area / groove area) / (1 - f) - 1
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name << " f_ab = " << c.removed; }

class Ridges : public testing::TestWithParam<Case> {};

TEST_P(Ridges, HoldWhatLeftTheGrooveAndWasNotLost) {
  const Case c = GetParam();
  PinOnPlate pin;
  pin.passes = c.passes;
  pin.wear_per_pass = c.wear;
  pin.half_width = 0.7e-3;
  pin.amplitude = 1.0e-3;
  pin.increment = 0.06e-3;
  pin.size = 0.025e-3;
  const Furrow f = furrow(pin, c.removed);
  const std::string name = fmt::format("{}, f_ab = {}: ", c.name, c.removed);
  const double ratio = f.sections.ridge_area / f.sections.groove_area / (1.0 - c.removed) - 1.0;
  const double sides = (f.left - f.right) / f.sections.ridge_area;
  const double net = f.ledger.swept - f.ledger.law, groove = f.ledger.law + f.ledger.displaced;
  measured(name + "ridge over groove area against 1 - f_ab", ratio, c.bound);
  measured(name + "left against right ridge", sides, 0.05);
  measured(name + "net volume against what was removed", net / groove, 1e-9);
  measured(name + "ledger", f.ledger.residual, 1e-9);
  EXPECT_LT(std::abs(ratio), c.bound);
  EXPECT_LT(std::abs(sides), 0.05);
  EXPECT_LT(std::abs(net), 1e-9 * groove);
  EXPECT_LT(f.ledger.residual, 1e-9);
  if (c.removed == 0.0) {
    EXPECT_EQ(f.ledger.law, 0.0);
  }
}

// One cycle is two passes over the middle: the second one half as far along counts as the multi-pass
// groove's.
INSTANTIATE_TEST_SUITE_P(OfAShallowGroove, Ridges,
                         testing::Values(Case{"two passes", 2, 0.4e-11, 0.0, 0.03},
                                         Case{"two passes", 2, 0.4e-11, 0.5, 0.03},
                                         Case{"two passes", 2, 0.4e-11, 0.75, 0.03},
                                         Case{"eight passes", 8, 0.1e-11, 0.5, 0.03}));

TEST(Ploughing, NothingIsDifferentWhereAllIsRemoved) {
  PinOnPlate pin;
  simulation::Setup with = pin.setup(), without = pin.setup();
  with.ploughing = simulation::PloughingSetup{.removed_fraction = 1.0};
  simulation::Simulation a(with), b(without);
  a.advance();
  b.advance();
  EXPECT_EQ(a.state_hash(), b.state_hash());
}

TEST(Ploughing, AheadOfTheContactToo) {
  PinOnPlate pin;
  pin.wear_per_pass = 0.4e-11;
  pin.half_width = 0.7e-3;
  pin.increment = 0.06e-3;
  const Furrow f = furrow(pin, 0.5, 0.3);
  measured("ahead = 0.3: ledger", f.ledger.residual, 1e-9);
  EXPECT_LT(f.ledger.residual, 1e-9);
  EXPECT_GT(f.ledger.displaced, 0.0);
}

/// Two pins on a turning ring of a mesh that is not flat at its borders: per contact, and on any wall.
TEST(Ploughing, WithSeveralPinsOnARing) {
  PinOnDisc disc;
  disc.track = 5e-3;
  disc.half_band = 1.2e-3;
  disc.wear_coefficient = 1e-11;
  disc.size = 0.12e-3;
  simulation::Setup s = disc.setup();
  s.ploughing = simulation::PloughingSetup{.removed_fraction = 0.4};
  s.particles.push_back(s.particles[0]);
  s.particles[1].name = "second";
  s.particles[1].position = {-5.2e-3, 0.0, PinOnDisc::kRadius};
  s.contacts.push_back({"iron_ore", "iron_ore", 0.4, 0.5, 0.0});
  s.wear.push_back({"mild_steel", "iron_ore", 1e-13});
  simulation::Simulation run(s);
  run.advance();
  const simulation::Ledger ledger = run.ledger();
  measured("two pins on a ring: ledger", ledger.residual, 1e-9);
  measured("two pins on a ring: tips' ledger", ledger.tip_residual, 1e-9);
  EXPECT_LT(ledger.residual, 1e-9);
  EXPECT_LT(ledger.tip_residual, 1e-9);
  EXPECT_NEAR(ledger.displaced / (ledger.law + ledger.displaced), 0.6, 1e-9);
}

}  // namespace
}  // namespace abradem::test
