// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/analysis/half_space_groove.h"

#include <gtest/gtest.h>

#include <cmath>

#include "abradem/core/error.h"

namespace abradem::analysis {
namespace {

// The published model's pin on steel: R = 3 mm, 5 N, E* = 0.26285 GPa.
constexpr PressedSphere kSoft{3e-3, 5.0, 2.6285e8};

TEST(PressedSphere, HasTheHertzContact) {
  EXPECT_NEAR(kSoft.half_width(), 0.349796e-3, 1e-9);
  EXPECT_NEAR(kSoft.approach(), 40.785749e-6, 1e-11);
  // F = (4/3) E* sqrt(R) d^(3/2)
  EXPECT_NEAR(4.0 / 3.0 * kSoft.effective_modulus * std::sqrt(3e-3) * std::pow(kSoft.approach(), 1.5), 5.0,
              1e-12);
}

// tests/verification/data/halfspace_states.csv: alpha n [1/Pa], depth [um].
TEST(HalfSpaceDepth, IsWithinItsErrorOfTheSolutions) {
  struct State {
    double wear, depth_um;
  };
  const PressedSphere stiff{3e-3, 5.0, 5.8296e10};
  const auto deviation = [](const PressedSphere& pin, const State& s) {
    const double W = groove_number(s.wear, pin.effective_modulus);
    return half_space_depth(W) * pin.approach() * 1e6 / s.depth_um - 1.0;
  };
  for (const State& s : {State{6.81e-11, 0.7235},
                         {1.362e-10, 1.4346},
                         {2.724e-10, 2.8209},
                         {5.448e-10, 5.4616},
                         {8.172e-10, 7.9467}})
    EXPECT_LT(std::abs(deviation(kSoft, s)), kHalfSpaceDepthError + 1e-4) << s.wear;
  for (const State& s : {State{6.81e-11, 2.1543},
                         {1.362e-10, 3.4663},
                         {2.724e-10, 5.5409},
                         {5.448e-10, 8.8272},
                         {8.172e-10, 11.5812}})
    EXPECT_LT(std::abs(deviation(stiff, s)), kHalfSpaceDepthError + 1e-4) << s.wear;
}

TEST(HalfSpaceDepth, HasTheTwoLimits) {
  EXPECT_DOUBLE_EQ(half_space_depth(0.0), 0.0);
  EXPECT_NEAR(half_space_depth(1e-6) / thin_wear_depth(1e-6), 1.0, 1e-6);
  EXPECT_NEAR(half_space_depth(1e6) / rigid_sphere_depth(1e6), 1.0, 1e-6);
  for (double W = 1e-3; W < 1e3; W *= 3.0) {
    EXPECT_LT(half_space_depth(W), thin_wear_depth(W));
    EXPECT_LT(half_space_depth(W), rigid_sphere_depth(W));
  }
}

TEST(RigidSphereDepth, IsThatOfTheSegment) {
  // A = (4/3) sqrt(2 R) d^(3/2) = alpha n F, in metres.
  const double wear = 8.172e-10, W = groove_number(wear, kSoft.effective_modulus);
  const double depth = rigid_sphere_depth(W) * kSoft.approach();
  EXPECT_NEAR(4.0 / 3.0 * std::sqrt(2.0 * kSoft.radius) * std::pow(depth, 1.5) / (wear * kSoft.force), 1.0,
              1e-12);
  EXPECT_NEAR(depth, 11.61e-6, 0.01e-6);
}

TEST(RigidFrom, IsWhereTheCurveIsThatCloseToTheRigidSphere) {
  for (const double deviation : {0.01, 0.05, 0.2}) {
    const double W = rigid_from(deviation);
    EXPECT_NEAR(1.0 - half_space_depth(W) / rigid_sphere_depth(W), deviation, 1e-12);
  }
  EXPECT_THROW((void)rigid_from(0.0), InputError);
  EXPECT_THROW((void)rigid_from(0.5), InputError);
}

}  // namespace
}  // namespace abradem::analysis
