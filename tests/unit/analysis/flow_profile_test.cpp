// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/analysis/flow_profile.h"

#include <gtest/gtest.h>

#include <cmath>

#include "abradem/core/error.h"
#include "abradem/core/random.h"

namespace abradem::analysis {
namespace {

TEST(FlowProfile, OfAShearFlowIsItsVelocityInTheMiddleOfEachBin) {
  // v = (z, 0, 0) and noise of 0.1 in each component, in a slice about y; only what is near the line counts.
  const FlowLine line{{1.0, 0.0, 0.0}, {1.0, 0.0, 2.0}, 4, 0.25, {0.0, 3.0, 0.0}};
  FlowProfile profile(line);
  core::RandomStream random(3);
  constexpr int kMoments = 50, kEach = 4000;
  for (int m = 0; m < kMoments; ++m) {
    std::vector<Vec3> centres, velocities;
    for (int i = 0; i < kEach; ++i) {
      const Vec3 p{random.uniform(0.0, 2.0), random.uniform(-5.0, 5.0), random.uniform(-0.5, 2.5)};
      const auto noise = [&] { return 0.1 * std::sqrt(3.0) * random.uniform(-1.0, 1.0); };
      centres.push_back(p);
      // Far from the line they stand still: they would be seen.
      velocities.push_back(std::abs(p.x - 1.0) <= 0.25 ? Vec3{p.z + noise(), noise(), noise()}
                                                       : Vec3{-9, 0, 0});
    }
    profile.add(centres, velocities);
  }
  const std::vector<FlowBin> bins = profile.bins();
  ASSERT_EQ(bins.size(), 4u);
  EXPECT_EQ(profile.moments(), 50u);
  for (std::size_t k = 0; k < 4; ++k) {
    const double z = 0.25 + 0.5 * static_cast<double>(k);
    EXPECT_DOUBLE_EQ(bins[k].distance, z);
    EXPECT_EQ(bins[k].middle, (Vec3{1.0, 0.0, z}));
    // An eighth of the width by a sixth of the height: 4167 samples in 50 moments, of a scatter of 0.18.
    EXPECT_NEAR(static_cast<double>(bins[k].samples), 50 * 4000 / 24.0, 500.0);
    EXPECT_NEAR(bins[k].velocity.x, z, 0.012);
    EXPECT_NEAR(bins[k].velocity.y, 0.0, 0.008);
    // Noise, and what v changes by within the bin: 0.5^2 / 12, in one of three components.
    EXPECT_NEAR(bins[k].fluctuation, std::sqrt(0.01 + 0.25 / 36.0), 0.004);
  }
}

TEST(FlowProfile, WithoutADirectionToAverageAlongTakesACylinder) {
  FlowProfile profile({{0, 0, 0}, {1, 0, 0}, 1, 0.1, {}});
  profile.add(
      std::vector<Vec3>{{0.5, 0.06, 0.06}, {0.5, 0.08, 0.08}, {1.0, 0, 0}, {-1e-9, 0, 0}, {0.0, 0, 0}},
      std::vector<Vec3>{{1, 0, 0}, {5, 0, 0}, {5, 0, 0}, {5, 0, 0}, {2, 0, 0}});
  EXPECT_EQ(profile.bins()[0].samples, 2u);
  EXPECT_DOUBLE_EQ(profile.bins()[0].velocity.x, 1.5);
}

TEST(FlowProfile, OfNothingIsNotANumber) {
  FlowProfile profile({{0, 0, 0}, {1, 0, 0}, 2, 0.1, {}});
  EXPECT_EQ(profile.bins()[1].samples, 0u);
  EXPECT_TRUE(std::isnan(profile.bins()[1].velocity.x));
  EXPECT_TRUE(std::isnan(profile.bins()[1].fluctuation));
}

TEST(FlowProfile, RefusesWhatIsNoLine) {
  const auto refused = [](const FlowLine& line) { EXPECT_THROW(FlowProfile{line}, InputError); };
  refused({{1, 1, 1}, {1, 1, 1}, 2, 0.1, {}});
  refused({{0, 0, 0}, {1, 0, 0}, 0, 0.1, {}});
  refused({{0, 0, 0}, {1, 0, 0}, 2, 0.0, {}});
  refused({{0, 0, 0}, {1, 0, 0}, 2, 0.1, {1, 1, 0}});
}

}  // namespace
}  // namespace abradem::analysis
