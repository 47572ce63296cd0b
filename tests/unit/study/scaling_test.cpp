// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/study/scaling.h"

#include <gtest/gtest.h>

#include <vector>

#include "abradem/core/error.h"

namespace abradem::study {
namespace {

const std::vector<double> kFactors{8, 27, 54, 108};

TEST(LargestFactor, IsInterpolatedInLogarithms) {
  std::vector<double> errors;
  for (const double f : kFactors) errors.push_back(1e-5 * f);  // first order
  const LargestFactor found = largest_factor(kFactors, errors, 4e-4);
  EXPECT_NEAR(found.factor, 40.0, 1e-9);
  EXPECT_FALSE(found.at_least || found.less_than);
}

TEST(LargestFactor, SaysWhereItLiesBeyondTheRuns) {
  const std::vector<double> errors{1e-4, 2e-4, 3e-4, 4e-4};
  EXPECT_TRUE(largest_factor(kFactors, errors, 1e-3).at_least);
  EXPECT_EQ(largest_factor(kFactors, errors, 1e-3).factor, 108.0);
  const LargestFactor below = largest_factor(kFactors, errors, 0.5e-4);
  EXPECT_TRUE(below.less_than);
  EXPECT_EQ(below.factor, 8.0);
}

TEST(LargestFactor, CountsTheFirstCrossing) {
  const std::vector<double> errors{1e-4, 3e-4, 0.5e-4, 4e-4};
  EXPECT_LT(largest_factor(kFactors, errors, 2e-4).factor, 27.0);
}

TEST(LargestFactor, RefusesWhatIsNoSeries) {
  EXPECT_THROW((void)largest_factor({}, {}, 1e-3), InputError);
  EXPECT_THROW((void)largest_factor(std::vector{8.0}, std::vector{0.0}, 1e-3), InputError);
  EXPECT_THROW((void)largest_factor(std::vector{8.0, 8.0}, std::vector{1.0, 2.0}, 1e-3), InputError);
  EXPECT_THROW((void)largest_factor(std::vector{8.0}, std::vector{1.0}, 0.0), InputError);
}

}  // namespace
}  // namespace abradem::study
