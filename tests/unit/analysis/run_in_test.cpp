// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/analysis/run_in.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "abradem/core/error.h"
#include "abradem/core/random.h"

namespace abradem::analysis {
namespace {

std::vector<double> counted(int n) {
  std::vector<double> x;
  for (int i = 1; i <= n; ++i) x.push_back(i);
  return x;
}

/// f at 1 … n with noise of an sd, near enough normal.
template <class Function>
std::vector<double> series(int n, double sd, std::uint64_t stream, Function f) {
  core::RandomStream random(21, stream);
  std::vector<double> y;
  for (int i = 1; i <= n; ++i) {
    double sum = -6.0;
    for (int k = 0; k < 12; ++k) sum += random.uniform();
    y.push_back(f(static_cast<double>(i)) + sd * sum);
  }
  return y;
}

double ramp_to_8(double x) { return 1.0 + 0.2 * std::min(x - 8.0, 0.0); }

TEST(RunIn, WithoutNoiseIsFoundExactly) {
  const RunIn r = find_run_in(counted(20), series(20, 0.0, 0, ramp_to_8));
  EXPECT_EQ(r.state, RunIn::State::found);
  EXPECT_EQ(r.revolution, 8.0);
  EXPECT_EQ(r.low, 8.0);
  EXPECT_EQ(r.high, 8.0);
  EXPECT_NEAR(r.level, 1.0, 1e-12);
  EXPECT_NEAR(r.drift, 0.0, 1e-12);
  EXPECT_LT(r.p, 0.01);
}

TEST(RunIn, ItsIntervalHoldsTheTruthAsOftenAsItSays) {
  constexpr int kSeries = 200;
  int found = 0, held = 0, level_held = 0;
  double width = 0.0;
  for (int s = 0; s < kSeries; ++s) {
    const RunIn r = find_run_in(counted(24), series(24, 0.1, static_cast<std::uint64_t>(s), ramp_to_8),
                                {.resamples = 300});
    if (r.state != RunIn::State::found) continue;
    ++found;
    held += r.low <= 8.0 && 8.0 <= r.high;
    level_held += r.level_low <= 1.0 && 1.0 <= r.level_high;
    width += r.high - r.low;
  }
  EXPECT_GT(found, kSeries * 9 / 10);
  EXPECT_GT(held / static_cast<double>(found), 0.90);
  EXPECT_GT(level_held / static_cast<double>(found), 0.85);
  EXPECT_LT(width / found, 6.0);  // and says something
}

TEST(RunIn, IsNotSeenInNoiseMoreOftenThanItsLevel) {
  constexpr int kSeries = 300;
  int seen = 0;
  for (int s = 0; s < kSeries; ++s)
    seen += find_run_in(counted(20),
                        series(20, 0.1, static_cast<std::uint64_t>(1000 + s), [](double) { return 1.0; }),
                        {.resamples = 199})
                .state != RunIn::State::from_start;
  EXPECT_NEAR(seen / static_cast<double>(kSeries), 0.05, 0.035);
}

TEST(RunIn, OfASeriesThatGoesOnChangingIsNotFound) {
  for (std::uint64_t s = 0; s < 20; ++s) {
    const RunIn r = find_run_in(counted(20), series(20, 0.05, s, [](double x) { return 1.0 - 0.04 * x; }));
    EXPECT_EQ(r.state, RunIn::State::not_steady) << s;
    EXPECT_TRUE(std::isnan(r.revolution));
  }
}

TEST(RunIn, OfAChangeBelowTheToleranceIsNone) {
  // What rounding and a tilting groove leave of a constant rate of wear: a trend of 1e-4, without noise.
  const auto trend = series(12, 0.0, 0, [](double x) { return 0.047 * (1.0 - 1e-5 * x); });
  const RunIn r = find_run_in(counted(12), trend);
  EXPECT_EQ(r.state, RunIn::State::from_start);
  EXPECT_LT(r.p, 0.05);  // and yet it is seen
  EXPECT_EQ(find_run_in(counted(12), trend, {.drift_tolerance = 1e-5}).state, RunIn::State::not_steady);
}

TEST(RunIn, OfACurveEndsWhereTheDriftIsShownToBeSmall) {
  // 1 + exp(-x/3): changes by less than 1 % over what is left from revolution 14 on (exp(-14/3) = 0.0094).
  const RunIn r =
      find_run_in(counted(40), series(40, 0.0, 0, [](double x) { return 1.0 + std::exp(-x / 3.0); }));
  ASSERT_EQ(r.state, RunIn::State::found);
  EXPECT_GE(r.revolution, 8.0);
  EXPECT_LE(r.revolution, 16.0);
  EXPECT_NEAR(r.level, 1.0, 0.01);
}

TEST(RunIn, GivesNoVerdictOnFewValuesOrEqualOnes) {
  EXPECT_EQ(find_run_in(counted(6), series(6, 0.1, 0, ramp_to_8)).state, RunIn::State::too_short);
  const RunIn equal = find_run_in(counted(12), std::vector<double>(12, 0.25));
  EXPECT_EQ(equal.state, RunIn::State::from_start);
  EXPECT_EQ(equal.p, 1.0);
  EXPECT_NEAR(equal.level, 0.25, 1e-15);
}

TEST(RunIn, GivesTheSameBitsAgainAndDoesNotDependOnUnits) {
  const std::vector<double> y = series(24, 0.1, 4, ramp_to_8);
  std::vector<double> scaled;
  for (const double v : y) scaled.push_back(0x1p-30 * v);
  const RunIn a = find_run_in(counted(24), y), b = find_run_in(counted(24), y),
              c = find_run_in(counted(24), scaled);
  EXPECT_EQ(a.p, b.p);
  EXPECT_EQ(a.high, b.high);
  EXPECT_EQ(a.p, c.p);
  EXPECT_EQ(a.low, c.low);
  EXPECT_EQ(a.revolution, c.revolution);
}

TEST(RunIn, RefusesSeriesThatAreNone) {
  const std::vector<double> y(10, 1.0);
  EXPECT_THROW((void)find_run_in(counted(9), y), InputError);
  std::vector<double> x = counted(10);
  std::swap(x[3], x[4]);
  EXPECT_THROW((void)find_run_in(x, y), InputError);
  EXPECT_THROW((void)find_run_in(counted(10), y, {.confidence = 95.0}), InputError);
  EXPECT_THROW((void)find_run_in(counted(10), y, {.shortest = 2}), InputError);
}

TEST(NormalFrom, IsTheFirstRevolutionAfterTheLastFailure) {
  const std::vector<double> n{1, 2, 3, 4, 5}, good(5, 0.4);
  const NormalFrom all = normal_from(n, good, good);
  EXPECT_EQ(all.revolution, 1.0);
  EXPECT_EQ(all.lasting, 5);
  const NormalFrom later =
      normal_from(n, std::vector{0.4, 0.01, 0.3, 0.2, 0.1}, std::vector{0.4, 0.4, 0.04, 0.6, 0.7});
  EXPECT_EQ(later.revolution, 4.0);
  EXPECT_EQ(later.lasting, 2);
  // 'None' where the last revolution fails, or has no p, whatever came before.
  EXPECT_FALSE(normal_from(n, good, std::vector{0.4, 0.4, 0.4, 0.4, 0.05}).revolution);
  EXPECT_FALSE(normal_from(n, std::vector{0.4, 0.4, 0.4, 0.4, std::nan("")}, good).revolution);
  EXPECT_FALSE(normal_from({}, {}, {}).revolution);
  EXPECT_THROW((void)normal_from(n, good, std::vector{0.4}), InputError);
}

TEST(NormalFromByBins, AnswersForEveryNumberOfBins) {
  const std::vector<double> n{1, 2, 3};
  std::vector<std::vector<double>> depths, widths;
  for (std::uint64_t k = 0; k < 3; ++k) {
    depths.push_back(series(360, 1.0, 50 + k, [&](double) { return 0.0; }));
    widths.push_back(series(360, 1.0, 60 + k, [&](double) { return 0.0; }));
  }
  for (double& d : depths[0]) d = d * d;  // chi-squared: no number of bins takes it for normal
  const NormalFromByBins by = normal_from_by_bins(n, depths, widths, Binning::equiprobable, 6, 30, 1e-4);
  ASSERT_EQ(by.bins.size(), 25u);
  EXPECT_EQ(by.share_found, 1.0);
  for (const NormalFrom& f : by.found) {
    EXPECT_EQ(f.revolution, 2.0);
    EXPECT_EQ(f.lasting, 2);
  }
  EXPECT_THROW((void)normal_from_by_bins(n, depths, widths, Binning::equiprobable, 9, 8), InputError);
}

}  // namespace
}  // namespace abradem::analysis
