// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/analysis/statistics.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "abradem/core/error.h"

namespace abradem::analysis {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(Summary, OfAHandExample) {
  const std::vector<double> values{9.0, 2.0, 4.0, 4.0, 5.0, 4.0, 7.0, 5.0};  // mean 5, squares 32
  const Summary s = summarise(values);
  EXPECT_EQ(s.count, 8);
  EXPECT_DOUBLE_EQ(s.mean, 5.0);
  EXPECT_DOUBLE_EQ(s.sd, std::sqrt(32.0 / 7.0));
  EXPECT_EQ(s.min, 2.0);
  EXPECT_EQ(s.max, 9.0);
  EXPECT_DOUBLE_EQ(s.lower_quartile, 4.0);
  EXPECT_DOUBLE_EQ(s.median, 4.5);
  EXPECT_DOUBLE_EQ(s.upper_quartile, 5.5);  // position 5.25 of 2 4 4 4 5 5 7 9: 5 + 0.25 * 2
}

TEST(Summary, OfFewValuesSaysNanWhereThereIsNoAnswer) {
  const Summary none = summarise({});
  EXPECT_EQ(none.count, 0);
  EXPECT_TRUE(std::isnan(none.mean) && std::isnan(none.sd) && std::isnan(none.median) &&
              std::isnan(none.max));
  const Summary one = summarise(std::vector{3.5});
  EXPECT_EQ(one.mean, 3.5);
  EXPECT_TRUE(std::isnan(one.sd));
  EXPECT_EQ(one.upper_quartile, 3.5);
}

TEST(Summary, OfEqualValuesHasNoScatterAtAll) {
  const Summary s = summarise(std::vector<double>(361, 0.1));
  EXPECT_EQ(s.mean, 0.1);
  EXPECT_EQ(s.sd, 0.0);
}

TEST(Quantile, OfType7AgreesWithR) {
  // R: quantile(c(1, 2, 4, 8, 16), c(0, .1, .25, .6, .9, 1), type = 7)
  const std::vector<double> values{1, 2, 4, 8, 16};
  const std::array<std::pair<double, double>, 6> known{
      {{0.0, 1.0}, {0.1, 1.4}, {0.25, 2.0}, {0.6, 5.6}, {0.9, 12.8}, {1.0, 16.0}}};
  for (const auto& [p, q] : known) EXPECT_NEAR(quantile(values, p), q, 1e-14) << p;
  EXPECT_THROW((void)quantile({}, 0.5), InputError);
  EXPECT_THROW((void)quantile(values, 1.01), InputError);
  EXPECT_THROW((void)quantile(values, kNan), InputError);
}

TEST(TukeyOutliers, LieBeyondTheFences) {
  // Quartiles 3 and 7 of 1 … 9: fences at -3 and 13, and a value on a fence is inside.
  const std::vector<double> values{1, 2, 3, 4, 5, 6, 7, 8, 9};
  EXPECT_TRUE(tukey_outliers(values).empty());
  const std::vector<double> with{2, 3, 4, 5, 6, 7, 8, 13, 13.01, 5, -60};
  // Sorted: -60 2 3 4 5 5 6 7 8 13 13.01; quartiles 3.5 and 7.5; fences -2.5 and 13.5.
  EXPECT_EQ(tukey_outliers(with), (std::vector<std::size_t>{10}));
  EXPECT_TRUE(tukey_outliers({}).empty());
}

TEST(Statistics, RefuseValuesThatAreNotFinite) {
  const std::vector<double> bad{1.0, 2.0, kNan};
  EXPECT_THROW((void)summarise(bad), InputError);
  EXPECT_THROW((void)tukey_outliers(bad), InputError);
  try {
    (void)summarise(bad);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("value 2 of 3 is nan"), std::string::npos) << e.what();
  }
}

std::vector<double> forces(int n) {  // 5 N with a small ripple on a large offset: what cancels in naive sums
  std::vector<double> values;
  for (int i = 0; i < n; ++i) values.push_back(1e6 + 1e-3 * std::sin(0.37 * i) + 1e-4 * (i % 7));
  return values;
}

TEST(RunningStatistics, AgreesWithTwoPasses) {
  const std::vector<double> values = forces(10000);
  RunningStatistics running;
  for (const double f : values) running.add(f);
  const Summary s = summarise(values);
  EXPECT_EQ(running.count(), 10000);
  EXPECT_NEAR(running.mean() / s.mean, 1.0, 1e-15);
  // Each value carries 1e-10 of round-off beside a scatter of 7e-4.
  EXPECT_NEAR(running.sd() / s.sd, 1.0, 1e-6);
  EXPECT_EQ(running.min(), s.min);
  EXPECT_EQ(running.max(), s.max);
}

TEST(RunningStatistics, MergedPartsAreTheWhole) {
  const std::vector<double> values = forces(999);
  RunningStatistics whole, merged, empty;
  std::array<RunningStatistics, 3> parts;
  for (std::size_t i = 0; i < values.size(); ++i) {
    whole.add(values[i]);
    parts[i < 10 ? 0 : i < 500 ? 1 : 2].add(values[i]);
  }
  merged.merge(empty);
  for (const RunningStatistics& part : parts) merged.merge(part);
  merged.merge(empty);
  EXPECT_EQ(merged.count(), whole.count());
  EXPECT_NEAR(merged.mean() / whole.mean(), 1.0, 1e-15);
  EXPECT_NEAR(merged.sd() / whole.sd(), 1.0, 1e-6);
  EXPECT_EQ(merged.min(), whole.min());
  EXPECT_EQ(merged.max(), whole.max());
}

TEST(RunningStatistics, OfFewValuesSaysNanWhereThereIsNoAnswer) {
  RunningStatistics s;
  EXPECT_TRUE(std::isnan(s.mean()) && std::isnan(s.sd()) && std::isnan(s.min()) && std::isnan(s.max()));
  s.add(-2.0);
  EXPECT_EQ(s.mean(), -2.0);
  EXPECT_EQ(s.max(), -2.0);
  EXPECT_TRUE(std::isnan(s.sd()));
  s.add(4.0);
  EXPECT_DOUBLE_EQ(s.sd(), std::sqrt(18.0));
}

}  // namespace
}  // namespace abradem::analysis
