// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/wear/wearing_tip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "abradem/core/error.h"

namespace abradem::wear {
namespace {

constexpr double kR = 3e-3, kCell = 10e-6;
const Vec3 kUp{0.0, 0.0, 1.0}, kDown{0.0, 0.0, -1.0};

/// Presses on the plane z = 0 from a height, by the overlap.
WearingTip::Contact contact_of(const WearingTip& tip, double deepest) {
  const contact::Tip frame{&tip.shape(), {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, kDown};
  return {.field = {{}, kR, deepest, frame, {}, {}}, .frame = frame, .d_e = 0.0};
}

void wear_on_plane(WearingTip& tip, double overlap, double volume) {
  tip.press_on_plane(contact_of(tip, overlap), kR - overlap, kUp, kR * kDown);
  tip.wear(volume);
}

TEST(WearingTip, IsASphereAtFirst) {
  const WearingTip tip(kR, kCell);
  EXPECT_EQ(tip.removed_volume(), 0.0);
  EXPECT_EQ(tip.deepest(), 0.0);
  EXPECT_EQ(tip.flat(0.0).along_s, 0.0);
}

TEST(WearingTip, LosesTheVolumeExactlyAndOnlyUnderTheContact) {
  WearingTip tip(kR, kCell);
  double law = 0.0;
  for (int k = 1; k <= 200; ++k) {
    const double volume = 1e-16 * k;
    wear_on_plane(tip, 2e-6, volume);
    law += volume;
  }
  EXPECT_NEAR(tip.deposited_volume() / law, 1.0, 1e-14);
  EXPECT_NEAR(tip.removed_volume() / law, 1.0, 1e-12);
  // Beyond the circle in which an overlap of 2 um touches nothing is gone.
  const double a = std::sqrt(2.0 * kR * 2e-6);
  for (std::size_t k = 0; k < tip.shape().recession.size(); ++k)
    if (std::hypot(tip.s_of(k), tip.t_of(k)) > a) {
      EXPECT_EQ(tip.recession_of(k), 0.0);
    }
}

TEST(WearingTip, IsTheSameToAllSides) {
  WearingTip tip(kR, kCell);
  for (int k = 0; k < 20; ++k) wear_on_plane(tip, 2e-6, 1e-14);
  const contact::TipShape& shape = tip.shape();
  const auto r = [&](int i, int j) { return shape.recession[shape.index(i, j)]; };
  for (int i = 0; i <= shape.half; ++i)
    for (int j = 0; j <= i; ++j)
      for (const double other : {r(-i, j), r(i, -j), r(j, i), r(-j, -i)})
        ASSERT_NEAR(other, r(i, j), 1e-12 * tip.deepest()) << i << ' ' << j;
  EXPECT_NEAR(tip.flat(1e-9).along_s, tip.flat(1e-9).along_t, 1e-12);
}

TEST(WearingTip, AFlatCutOffTheSphereHasTheCapsVolume) {
  // Pressed by the overlap again and again it becomes the plane: V = pi h^2 (R - h/3).
  WearingTip tip(kR, kCell);
  const double h = 10e-6, V = std::numbers::pi * h * h * (kR - h / 3.0);
  for (int k = 0; k < 400; ++k) wear_on_plane(tip, h + 1e-7, V / 400.0);
  EXPECT_NEAR(tip.deepest() / h, 1.0, 0.03);
  EXPECT_NEAR(tip.flat(1e-8).along_s / (2.0 * std::sqrt(2.0 * kR * h)), 1.0, 0.05);
}

TEST(WearingTip, KeepsItsVolumeWhenItsMapGrowsAndBecomesCoarser) {
  WearingTip tip(kR, kCell);
  double law = 0.0;
  for (int k = 0; k < 60; ++k) {
    wear_on_plane(tip, (1.0 + k) * 1e-6, 1e-13);
    law += 1e-13;
  }
  EXPECT_GT(tip.shape().cell, kCell);
  EXPECT_NEAR(tip.removed_volume() / law, 1.0, 1e-12);
}

TEST(WearingTip, NothingChangesWithoutVolume) {
  WearingTip tip(kR, kCell);
  wear_on_plane(tip, 2e-6, 0.0);
  EXPECT_EQ(tip.shape().revision, 0u);
}

TEST(WearingTip, RefusesAContactThatItsMapCannotShow) {
  WearingTip tip(kR, 0.1e-3);
  const Vec3 side{1.0, 0.0, 0.0};
  EXPECT_THROW(tip.press_on_plane(contact_of(tip, 1e-6), kR - 1e-6, -side, kR * side), SimulationError);
}

}  // namespace
}  // namespace abradem::wear
