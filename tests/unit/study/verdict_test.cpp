// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/study/verdict.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "abradem/core/error.h"

namespace abradem::study {
namespace {

using enum Verdict;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(Verdicts, OfANumberAreWithinTheToleranceOrAFactorOfTwo) {
  EXPECT_EQ(judge_value(0.019, 0.0205, 0.1), reproduced);
  EXPECT_EQ(judge_value(0.019, 0.0175, 0.1), reproduced);
  EXPECT_EQ(judge_value(0.019, 0.0153, 0.1), trend_only);
  EXPECT_EQ(judge_value(0.019, 0.039, 0.1), not_reproduced);
  EXPECT_EQ(judge_value(0.019, 0.009, 0.1), not_reproduced);
  EXPECT_EQ(judge_value(0.019, -0.019, 0.1), not_reproduced);
  EXPECT_EQ(judge_value(0.019, kNaN, 0.1), not_reproduced);
}

TEST(Verdicts, OfARangeAskForBothEnds) {
  EXPECT_EQ(judge_range({0.042, 0.07}, {0.045, 0.065}, 0.1), reproduced);
  EXPECT_EQ(judge_range({0.042, 0.07}, {0.045, 0.06}, 0.1), trend_only);
  EXPECT_EQ(judge_range({0.042, 0.07}, {0.026, 0.041}, 0.1), not_reproduced);
  EXPECT_EQ(judge_range({0.042, 0.07}, {0.08, 0.09}, 0.1), not_reproduced);
  EXPECT_EQ(judge_range({0.042, 0.07}, {kNaN, kNaN}, 0.1), not_reproduced);
}

TEST(Verdicts, AgainstAMeasuredRange) {
  EXPECT_EQ(judge_inside({10, 14}, 11.6), reproduced);
  EXPECT_EQ(judge_inside({10, 14}, 10), reproduced);
  EXPECT_EQ(judge_inside({10, 14}, 7.96), trend_only);
  EXPECT_EQ(judge_inside({10, 14}, 27), trend_only);
  EXPECT_EQ(judge_inside({10, 14}, 4.9), not_reproduced);
  EXPECT_EQ(judge_inside({10, 14}, 29), not_reproduced);
  EXPECT_EQ(judge_inside({10, 14}, kNaN), not_reproduced);
}

TEST(Verdicts, OfPValuesCompareSidesOfTheLevel) {
  const std::vector<double> theirs{0, 0, 0, 0, 1.3e-12, 0.03, 0.01, 0.11, 0.33, 0.54};
  std::vector<double> ours{1e-9, 1e-9, 0.04, 0, 0, 0, 0, 0.06, 0.9, 0.2};
  EXPECT_EQ(judge_p_values(theirs, ours, 0.05), reproduced);
  ours[7] = 0.01;
  ours[0] = 0.3;
  EXPECT_EQ(judge_p_values(theirs, ours, 0.05), trend_only);
  ours[8] = kNaN;
  EXPECT_EQ(judge_p_values(theirs, ours, 0.05), not_reproduced);
  EXPECT_THROW((void)judge_p_values(theirs, std::vector<double>(9, 0.5), 0.05), InputError);
}

TEST(Verdicts, OfACurveAskForEveryPlaceThenForSizeAndBend) {
  const std::vector<double> n{1, 2, 3, 4, 5, 6};
  std::vector<double> theirs, close, smaller, linear, tiny;
  for (const double x : n) {
    theirs.push_back(x + 0.2 * x * x);
    close.push_back(1.05 * theirs.back());
    smaller.push_back(0.6 * theirs.back());
    linear.push_back(1.7 * x);
    tiny.push_back(0.4 * theirs.back());
  }
  EXPECT_EQ(judge_curve(n, theirs, close, 0.1), reproduced);
  EXPECT_EQ(judge_curve(n, theirs, smaller, 0.1), trend_only);
  EXPECT_EQ(judge_curve(n, theirs, linear, 0.1), not_reproduced);  // within a factor of two, but straight
  EXPECT_EQ(judge_curve(n, theirs, tiny, 0.1), not_reproduced);
  close[3] = 1.2 * theirs[3];
  EXPECT_NE(judge_curve(n, theirs, close, 0.1), reproduced);
  EXPECT_THROW((void)judge_curve(std::vector<double>{1, 2, 2, 3, 4, 5}, theirs, close, 0.1), InputError);
}

TEST(Verdicts, OfATrendAskForEveryStep) {
  EXPECT_EQ(judge_trend(std::vector{5.0, 4.0, 3.0, 1.0}, Trend::falling), reproduced);
  EXPECT_EQ(judge_trend(std::vector{5.0, 4.0, 4.1, 1.0}, Trend::falling), trend_only);
  EXPECT_EQ(judge_trend(std::vector{5.0, 4.0, 3.0, 1.0}, Trend::rising), not_reproduced);
  EXPECT_EQ(judge_trend(std::vector{1.0, 0.9, 0.8, 2.0}, Trend::rising),
            not_reproduced);  // one step of three
  EXPECT_EQ(judge_trend(std::vector{1.0, 1.0}, Trend::rising), not_reproduced);
  EXPECT_EQ(judge_trend(std::vector{1.0, kNaN}, Trend::rising), not_reproduced);
  EXPECT_THROW((void)judge_trend(std::vector{1.0}, Trend::rising), InputError);
}

TEST(GrowthExponent, IsThatOfAPower) {
  const std::vector<double> x{1, 2, 3, 5, 10};
  std::vector<double> y;
  for (const double v : x) y.push_back(0.3 * std::pow(v, 0.78));
  EXPECT_NEAR(growth_exponent(x, y), 0.78, 1e-12);
  y[2] = 0.0;
  EXPECT_TRUE(std::isnan(growth_exponent(x, y)));
}

TEST(Verdicts, OfGrowth) {
  EXPECT_EQ(judge_growth(0.95, Growth::linear, 0.1), reproduced);
  EXPECT_EQ(judge_growth(0.78, Growth::linear, 0.1), trend_only);
  EXPECT_EQ(judge_growth(-0.2, Growth::linear, 0.1), not_reproduced);
  EXPECT_EQ(judge_growth(0.3, Growth::slowing, 0.1), reproduced);
  EXPECT_EQ(judge_growth(0.95, Growth::slowing, 0.1), trend_only);
  EXPECT_EQ(judge_growth(kNaN, Growth::slowing, 0.1), not_reproduced);
}

TEST(Verdicts, OfAWholeFollowFromItsParts) {
  EXPECT_EQ(together(std::array{reproduced, reproduced}), reproduced);
  EXPECT_EQ(together(std::array{reproduced, not_reproduced}), trend_only);
  EXPECT_EQ(together(std::array{trend_only, trend_only}), trend_only);
  EXPECT_EQ(together(std::array{not_reproduced, not_reproduced}), not_reproduced);
  EXPECT_THROW((void)together({}), InputError);
  EXPECT_EQ(worse(reproduced, trend_only), trend_only);
}

}  // namespace
}  // namespace abradem::study
