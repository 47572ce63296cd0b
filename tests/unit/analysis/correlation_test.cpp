// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/analysis/correlation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "abradem/core/error.h"
#include "abradem/core/random.h"

// Reference values of autocorrelations: NumPy 1.24 (fft and correlate).

namespace abradem::analysis {
namespace {

/// Values i^2 on the circle, smoothed over nine neighbours: r_k = (9 - k)/9 but for chance.
std::vector<double> smoothed(int n) {
  std::vector<double> values;
  for (int j = 0; j < n; ++j) {
    double sum = 0.0;
    for (int k = -4; k <= 4; ++k) {
      const double i = (j + k + n) % n;
      sum += std::sin(i * i);
    }
    values.push_back(sum);
  }
  return values;
}

TEST(Autocorrelation, AgreesWithNumPy) {
  const std::vector<double> values = smoothed(360);
  const std::vector<double> joined = autocorrelation(values, Ends::joined);
  ASSERT_EQ(joined.size(), 181u);
  EXPECT_EQ(joined[0], 1.0);
  EXPECT_NEAR(joined[1], 0.8899368786547175, 1e-10);
  EXPECT_NEAR(joined[2], 0.795840905598648, 1e-10);
  EXPECT_NEAR(joined[9], 0.04176893601718551, 1e-10);
  EXPECT_NEAR(joined[50], -0.03464751569382102, 1e-10);
  EXPECT_NEAR(joined[180], 0.1605491859838621, 1e-10);
  const std::vector<double> open = autocorrelation(values, Ends::open);
  ASSERT_EQ(open.size(), 360u);
  EXPECT_NEAR(open[1], 0.8899312759453127, 1e-10);
  EXPECT_NEAR(open[5], 0.4508524114375771, 1e-10);
  EXPECT_NEAR(open[300], -0.028602271710818885, 1e-10);
}

TEST(Autocorrelation, OfAWaveIsACosine) {
  std::vector<double> wave;
  for (int i = 0; i < 120; ++i) wave.push_back(1e-5 + 1e-7 * std::cos(2 * std::numbers::pi * 3 * i / 120));
  const std::vector<double> r = autocorrelation(wave, Ends::joined);
  for (std::size_t k = 0; k < r.size(); ++k)
    EXPECT_NEAR(r[k], std::cos(2 * std::numbers::pi * 3.0 * static_cast<double>(k) / 120), 1e-10);
  // It does not matter where the circle is begun.
  std::rotate(wave.begin(), wave.begin() + 17, wave.end());
  EXPECT_NEAR(autocorrelation(wave, Ends::joined)[7], r[7], 1e-12);
}

TEST(Autocorrelation, IsEmptyWithoutScatter) {
  EXPECT_TRUE(autocorrelation(std::vector<double>(30, 1e-5), Ends::joined).empty());
  EXPECT_TRUE(autocorrelation({}, Ends::joined).empty());
  EXPECT_TRUE(std::isnan(correlation(std::vector<double>(30, 1e-5), Ends::joined).effective_count));
  const std::vector<double> bad{1.0, std::nan("")};
  EXPECT_THROW((void)autocorrelation(bad, Ends::open), InputError);
}

TEST(Correlation, OfAMovingAverageIsItsWidth) {
  // r_k = 1 - k/9: falls to 1/e at 9 (1 - 1/e) = 5.69, and 1 + 2 sum r_k = 9.
  double time = 0.0, length = 0.0;
  int in_range = 0;
  constexpr int kSeries = 60, n = 2000;
  for (int s = 0; s < kSeries; ++s) {
    core::RandomStream random(5, static_cast<std::uint64_t>(s));
    std::vector<double> noise, values;
    for (int i = 0; i < n; ++i) noise.push_back(random.uniform());
    for (int i = 0; i < n; ++i) {
      double sum = 0.0;
      for (int k = 0; k < 9; ++k) sum += noise[static_cast<std::size_t>((i + k) % n)];
      values.push_back(sum);
    }
    const Correlation c = correlation(values, Ends::joined);
    time += c.time / kSeries;
    length += c.length / kSeries;
    EXPECT_NEAR(c.effective_count * c.time, n, 1e-9 * n);
    in_range += c.independent_step >= 6 && c.independent_step <= 10;
  }
  EXPECT_GE(in_range, kSeries * 9 / 10);
  EXPECT_NEAR(length, 9.0 * (1.0 - 1.0 / std::numbers::e), 0.15);
  EXPECT_GT(time, 8.5);
  EXPECT_LT(time, 10.5);  // chance before the first r_k <= 0 adds a little: on the safe side
}

TEST(Correlation, OfIndependentValuesIsNone) {
  int inside = 0;
  double effective = 0.0;
  for (int s = 0; s < 200; ++s) {
    core::RandomStream random(6, static_cast<std::uint64_t>(s));
    std::vector<double> values;
    for (int i = 0; i < 360; ++i) values.push_back(random.uniform());
    const Correlation c = correlation(values, Ends::joined);
    inside += std::abs(c.r[1]) <= c.noise_band;
    effective += c.effective_count / 200;
    EXPECT_LE(c.effective_count, 360.0);
    EXPECT_LT(c.length, 1.0);
  }
  EXPECT_NEAR(inside / 200.0, 0.95, 0.045);
  EXPECT_GT(effective, 310.0);
}

TEST(Correlation, AlongTheTrack) {
  EXPECT_NEAR(along_track(1.0, 360, 22e-3), 0.3839724e-3, 1e-9);  // one degree at 22 mm
}

TEST(Thinned, KeepsValuesThatAreFarEnoughApart) {
  EXPECT_EQ(thinned(10, 3), (std::vector<std::size_t>{0, 3, 6}));
  EXPECT_EQ(thinned(6, 1), (std::vector<std::size_t>{0, 1, 2, 3, 4, 5}));
  EXPECT_TRUE(thinned(2, 3).empty());
  EXPECT_THROW((void)thinned(5, 0), InputError);
  for (const std::size_t n : {97u, 360u, 361u})
    for (const int step : {2, 7, 11}) {
      const std::vector<std::size_t> kept = thinned(n, step);
      EXPECT_EQ(kept.size(), n / static_cast<std::size_t>(step));
      for (std::size_t i = 0; i < kept.size(); ++i) {
        const std::size_t next = i + 1 < kept.size() ? kept[i + 1] : kept[0] + n;
        EXPECT_GE(next - kept[i], static_cast<std::size_t>(step));
      }
    }
}

TEST(ThinnedNormality, RepairsTheVerdictOnNeighboursThatKnowEachOther) {
  // Normal values, each repeated as a smoothed neighbourhood: all together are rejected too often.
  int rejected_all = 0, rejected_independent = 0;
  constexpr int kSeries = 200, n = 1000;
  for (int s = 0; s < kSeries; ++s) {
    core::RandomStream random(8, static_cast<std::uint64_t>(s));
    std::vector<double> noise, values;
    for (int i = 0; i < n; ++i) {
      double sum = 0.0;
      for (int k = 0; k < 12; ++k) sum += random.uniform();
      noise.push_back(sum);
    }
    for (int i = 0; i < n; ++i) {
      double sum = 0.0;
      for (int k = 0; k < 15; ++k) sum += noise[static_cast<std::size_t>((i + k) % n)];
      values.push_back(sum);
    }
    const ThinnedNormality t = test_thinned_normality(values, Ends::joined);
    rejected_all += t.all.shapiro_wilk.p < 0.05;
    rejected_independent += t.independent.shapiro_wilk.p < 0.05;
    EXPECT_LE(t.independent.count, 125);
    EXPECT_GE(t.independent.count, 20);
  }
  EXPECT_GT(rejected_all, 2 * rejected_independent);
  EXPECT_LT(rejected_independent / static_cast<double>(kSeries), 0.11);
}

}  // namespace
}  // namespace abradem::analysis
