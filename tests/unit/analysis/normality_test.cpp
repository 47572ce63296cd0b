// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/analysis/normality.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "abradem/core/error.h"
#include "abradem/core/random.h"

// Reference values: SciPy 1.10.1 (shapiro, anderson, norm, chisquare). Its shapiro computes in single
// precision.

namespace abradem::analysis {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kSinglePrecision = 2e-6;  // of W; its p follows with 1e-4

/// The values that split the normal distribution into n equal parts, at their middles.
std::vector<double> normal_scores(int n, double mean, double sd) {
  const boost::math::normal normal(mean, sd);
  std::vector<double> values;
  for (int i = 0; i < n; ++i) values.push_back(quantile(normal, (i + 0.5) / n));
  return values;
}

TEST(ChiSquaredNormality, TakesBinsByTheRule) {
  EXPECT_EQ(normality_bins(360), 21);   // 2 * 360^0.4 = 21.06
  EXPECT_EQ(normality_bins(1000), 32);  // 31.70
  EXPECT_EQ(normality_bins(30), 6);     // 7.80, but 5 in each
  EXPECT_EQ(normality_bins(0), 0);
}

TEST(ChiSquaredNormality, OfAHandExampleIsExact) {
  // Mean 0, squares 19 * 1, so sd = 1: ten values of +a and ten of -a with a = sqrt(19 / 20) = 0.975.
  // Quartiles of the normal are at +-0.674: bins hold 10, 0, 0, 10 where 5 are expected each.
  std::vector<double> values(10, std::sqrt(19.0 / 20.0));
  values.insert(values.end(), 10, -std::sqrt(19.0 / 20.0));
  const ChiSquaredNormality test = chi_squared_normality(values);
  EXPECT_EQ(test.bins, 4);
  EXPECT_EQ(test.df, 1);
  EXPECT_DOUBLE_EQ(test.statistic, 20.0);
  // chi-squared with 1 df: P = erfc(sqrt(x/2)); with 3 df: erfc(sqrt(x/2)) + sqrt(2x/pi) exp(-x/2).
  const double p1 = std::erfc(std::sqrt(10.0)), p3 = p1 + std::sqrt(40.0 / std::acos(-1.0)) * std::exp(-10.0);
  EXPECT_NEAR(test.p / p1, 1.0, 1e-12);
  EXPECT_NEAR(test.p_upper / p3, 1.0, 1e-12);
}

TEST(ChiSquaredNormality, PassesNormalQuantilesWhereverTheyLie) {
  for (const double sd : {1.0, 3e-7, 0.2e-6}) {
    const ChiSquaredNormality test = chi_squared_normality(normal_scores(360, 10e-6, sd));
    EXPECT_EQ(test.bins, 21);
    EXPECT_EQ(test.df, 18);
    EXPECT_GT(test.p, 0.999);
    EXPECT_GE(test.p_upper, test.p);
  }
}

TEST(ChiSquaredNormality, RefusesUniformAndSkewedSamples) {
  std::vector<double> uniform, skewed;
  for (int i = 0; i < 360; ++i) {
    uniform.push_back(1e-5 * (i + 0.5) / 360);
    skewed.push_back(-1e-6 * std::log((i + 0.5) / 360));
  }
  const ChiSquaredNormality flat = chi_squared_normality(uniform);
  EXPECT_LT(flat.p_upper, 0.01);
  EXPECT_LT(flat.p, flat.p_upper);
  EXPECT_LT(chi_squared_normality(skewed).p_upper, 1e-10);
}

TEST(ChiSquaredNormality, DoesNotDependOnUnits) {
  std::vector<double> metres, micrometres;
  for (int i = 0; i < 200; ++i) {
    micrometres.push_back(10.0 + std::sin(1.0 * i * i));
    metres.push_back(1e-6 * micrometres.back());
  }
  EXPECT_NEAR(chi_squared_normality(metres).p, chi_squared_normality(micrometres).p, 1e-12);
}

TEST(ChiSquaredNormality, GivesNoVerdictWhereThereIsNone) {
  const auto no_verdict = [](const ChiSquaredNormality& t) {
    return std::isnan(t.p) && std::isnan(t.p_upper) && std::isnan(t.statistic) && t.df == 0;
  };
  EXPECT_TRUE(no_verdict(chi_squared_normality({})));
  EXPECT_TRUE(no_verdict(chi_squared_normality(normal_scores(19, 0, 1))));
  EXPECT_FALSE(no_verdict(chi_squared_normality(normal_scores(20, 0, 1))));
  EXPECT_TRUE(no_verdict(chi_squared_normality(std::vector<double>(360, 1e-5))));
  EXPECT_TRUE(no_verdict(chi_squared_normality(std::vector<double>(360, 0.0))));
  EXPECT_TRUE(no_verdict(chi_squared_normality(normal_scores(360, 1e-5, 1e-17))));
  EXPECT_TRUE(no_verdict(chi_squared_normality(std::vector{1.0}, 4)));
  EXPECT_THROW((void)chi_squared_normality(normal_scores(40, 0, 1), 3), InputError);
}

std::vector<double> standard_normal(int n, std::uint64_t stream) {
  const boost::math::normal normal;
  core::RandomStream random(7, stream);
  std::vector<double> values;
  for (int i = 0; i < n; ++i) values.push_back(quantile(normal, random.uniform(1e-12, 1.0)));
  return values;
}

template <class Function>
std::vector<double> sample(int n, Function f) {
  std::vector<double> values;
  for (int i = 0; i < n; ++i) values.push_back(f(static_cast<double>(i)));
  return values;
}
const std::vector<double> kMen{148, 154, 158, 160, 161, 162,
                               166, 170, 182, 195, 236};  // [shapiro1965, sec. 4]
const std::vector<double> kChicks{
    156, 162, 168, 182, 186, 190, 190, 196, 202, 210,   // Bliss 1967, in
    214, 220, 226, 230, 230, 236, 236, 242, 246, 270};  // [dagostino1986, ch. 4]
const std::vector<double> kSines = sample(360, [](double i) { return 10.0 + std::sin(i * i); });
const std::vector<double> kSquares = sample(1000, [](double i) { return std::fmod(i * i, 1009.0); });
const std::vector<double> kMixed =
    sample(60, [](double i) { return std::sin(i) + std::sin(1.7 * i * i) + std::sin(0.3 * i * i * i); });
const std::vector<double> kLogs = sample(200, [](double i) { return std::log(i + 1.0); });

TEST(ChiSquaredNormality, OfEqualWidthPoolsTheTails) {
  struct Known {
    const std::vector<double>& values;
    int bins;
    double statistic, p, p_upper;
  };
  const Known known[] = {{kSines, 10, 60.74928240285783, 1.0694653442818342e-10, 9.612373388118721e-10},
                         {kSquares, 10, 68.2607401374094, 3.316383023538784e-12, 3.335762279087897e-11},
                         {kLogs, 6, 22.17682786864225, 5.993164212793841e-05, 0.0004845814778643019},
                         {kMixed, 8, 2.9821861485838896, 0.7027323570828077, 0.8866452517752353}};
  for (const Known& k : known) {
    const ChiSquaredNormality test = chi_squared_normality(k.values, kEqualWidthBins, Binning::equal_width);
    EXPECT_EQ(test.bins, k.bins);
    EXPECT_EQ(test.df, k.bins - 3);
    EXPECT_NEAR(test.statistic / k.statistic, 1.0, 1e-9);
    EXPECT_NEAR(test.p / k.p, 1.0, 1e-7);
    EXPECT_NEAR(test.p_upper / k.p_upper, 1.0, 1e-7);
  }
  // Ten values expect ten in all: one or two bins are left of them.
  EXPECT_TRUE(std::isnan(chi_squared_normality(kMen, 10, Binning::equal_width).p));
}

TEST(AndersonDarling, AgreesWithSciPyAndTheFormulasOfDAgostinoAndStephens) {
  struct Known {
    const std::vector<double>& values;
    double statistic, adjusted, p;
  };
  // One for each of the four formulas, and one where p is held.
  const Known known[] = {{kMixed, 0.1722982190903437, 0.17455963321591889, 0.9256022955438078},
                         {kChicks, 0.21417425823119984, 0.22341052311742035, 0.8259764080099363},
                         {kMen, 0.9467718795988898, 1.028929769977306, 0.010454024005147534},
                         {kLogs, 8.782672259049406, 8.816101305335412, 2.1436807884022435e-21},
                         {kSines, 10.791324679125694, 10.813993954927332, 3.7649788053884e-24}};
  for (const Known& k : known) {
    const AndersonDarling test = anderson_darling_normality(k.values);
    EXPECT_NEAR(test.statistic / k.statistic, 1.0, 1e-10);
    EXPECT_NEAR(test.adjusted / k.adjusted, 1.0, 1e-10);
    EXPECT_NEAR(test.p / k.p, 1.0, 1e-9);
  }
}

TEST(AndersonDarling, SurvivesAValueFarOutsideTheNormal) {
  // (n - 1)/sqrt(n) = 70 sd: the probability of the last value underflows.
  std::vector<double> values = normal_scores(5000, 0.0, 1.0);
  values.back() = 1e6;
  const AndersonDarling test = anderson_darling_normality(values);
  EXPECT_TRUE(std::isfinite(test.statistic));
  EXPECT_LT(test.p, 1e-20);
}

TEST(ShapiroWilk, AgreesWithSciPyAndThePublishedExample) {
  struct Known {
    std::vector<double> values;
    double W, p;
  };
  const Known known[] = {{kMen, 0.7888147830963135, 0.006703833118081093},  // [shapiro1965] gives 0.79
                         {kChicks, 0.9756584763526917, 0.8667462468147278},
                         {{1.0, 2.0, 4.0}, 0.9642857313156128, 0.6368856430053711},
                         {{1.0, 2.0, 4.0, 7.0, 11.0}, 0.9344339966773987, 0.6269025206565857},
                         {kMixed, 0.987485945224762, 0.7968870997428894},
                         {kLogs, 0.8386658430099487, 1.2508665435916055e-13},
                         {kSines, 0.9003041386604309, 1.2719643894198388e-14},
                         {kSquares, 0.9530718326568604, 2.445120082671638e-17}};
  for (const Known& k : known) {
    const ShapiroWilk test = shapiro_wilk_normality(k.values);
    EXPECT_NEAR(test.statistic, k.W, kSinglePrecision) << k.values.size();
    EXPECT_NEAR(test.p / k.p, 1.0, 1e-3) << k.values.size();
  }
}

TEST(ShapiroWilk, OfThreeValuesIsExact) {
  // Equally spaced values are as normal as three can be; two equal ones are the worst, W = 3/4.
  const ShapiroWilk best = shapiro_wilk_normality(std::vector{1.0, 2.0, 3.0});
  EXPECT_NEAR(best.statistic, 1.0, 1e-15);
  EXPECT_NEAR(best.p, 1.0, 1e-6);
  const ShapiroWilk worst = shapiro_wilk_normality(std::vector{1.0, 1.0, 3.0});
  EXPECT_NEAR(worst.statistic, 0.75, 1e-14);
  EXPECT_NEAR(worst.p, 0.0, 1e-7);
}

TEST(Normality, TestsRejectOneTrueNormalSampleInTwenty) {
  // 2000 samples: the share of p < 0.05 scatters by 0.005. Chi-squared's two p bound the true one.
  constexpr int kSamples = 2000;
  int chi_low = 0, chi_high = 0, width_low = 0, width_high = 0, ad = 0, sw = 0;
  for (int k = 0; k < kSamples; ++k) {
    const Normality test = test_normality(standard_normal(100, static_cast<std::uint64_t>(k)));
    chi_low += test.equiprobable.p < 0.05;
    chi_high += test.equiprobable.p_upper < 0.05;
    width_low += test.equal_width.p < 0.05;
    width_high += test.equal_width.p_upper < 0.05;
    ad += test.anderson_darling.p < 0.05;
    sw += test.shapiro_wilk.p < 0.05;
  }
  const auto share = [](int count) { return static_cast<double>(count) / kSamples; };
  EXPECT_NEAR(share(ad), 0.05, 0.015);
  EXPECT_NEAR(share(sw), 0.05, 0.015);
  EXPECT_GT(share(chi_low), 0.035);
  EXPECT_LT(share(chi_high), 0.065);
  EXPECT_GT(share(width_low), 0.035);
  EXPECT_LT(share(width_high), 0.065);
}

TEST(Normality, DoesNotDependOnUnitsOrOrder) {
  std::vector<double> scaled;
  for (const double v : kMixed) scaled.push_back(1e-7 * v + 22e-3);
  std::ranges::reverse(scaled);
  const Normality a = test_normality(kMixed), b = test_normality(scaled);
  EXPECT_EQ(a.count, 60);
  EXPECT_NEAR(b.equiprobable.p, a.equiprobable.p, 1e-9);
  EXPECT_NEAR(b.equal_width.p / a.equal_width.p, 1.0, 1e-6);
  EXPECT_NEAR(b.anderson_darling.p / a.anderson_darling.p, 1.0, 1e-6);
  EXPECT_NEAR(b.shapiro_wilk.p / a.shapiro_wilk.p, 1.0, 1e-6);
}

TEST(Normality, GivesNoVerdictWhereThereIsNone) {
  EXPECT_TRUE(std::isnan(anderson_darling_normality(std::vector<double>(7, 1.0)).p));
  EXPECT_TRUE(std::isnan(anderson_darling_normality(normal_scores(7, 0, 1)).p));
  EXPECT_FALSE(std::isnan(anderson_darling_normality(normal_scores(8, 0, 1)).p));
  EXPECT_TRUE(std::isnan(shapiro_wilk_normality(normal_scores(2, 0, 1)).p));
  EXPECT_FALSE(std::isnan(shapiro_wilk_normality(normal_scores(5000, 0, 1)).p));
  EXPECT_TRUE(std::isnan(shapiro_wilk_normality(normal_scores(5001, 0, 1)).p));
  const Normality equal = test_normality(std::vector<double>(360, 1e-5));
  EXPECT_TRUE(std::isnan(equal.equal_width.p) && std::isnan(equal.anderson_darling.p) &&
              std::isnan(equal.shapiro_wilk.p) && std::isnan(equal.equiprobable.p));
  const std::vector<double> bad{1.0, 2.0, kNan};
  EXPECT_THROW((void)chi_squared_normality(bad), InputError);
  EXPECT_THROW((void)anderson_darling_normality(bad), InputError);
  EXPECT_THROW((void)shapiro_wilk_normality(bad), InputError);
}

TEST(BinSensitivity, TellsHowOftenTheVerdictHolds) {
  const BinSensitivity normal = bin_sensitivity(normal_scores(360, 0, 1), Binning::equiprobable);
  EXPECT_EQ(normal.bins.front(), 5);
  EXPECT_EQ(normal.bins.back(), 72);
  EXPECT_EQ(normal.share_passing, 1.0);
  // A sample on the edge, normal plus uniform: some numbers of bins find something, others do not.
  std::vector<double> mixed = standard_normal(360, 3);
  for (std::size_t i = 0; i < mixed.size(); ++i) mixed[i] += 6.5 * static_cast<double>(i) / 360.0;
  const BinSensitivity some = bin_sensitivity(mixed, Binning::equal_width, 0.05, 6, 30);
  int passing = 0, verdicts = 0;
  for (std::size_t k = 0; k < some.bins.size(); ++k) {
    const double p = chi_squared_normality(mixed, some.bins[k], Binning::equal_width).p;
    EXPECT_EQ(some.p[k], p);
    passing += p > 0.05;
    verdicts += !std::isnan(p);
    EXPECT_GE(p, some.p_min);
    EXPECT_LE(p, some.p_max);
  }
  EXPECT_GT(passing, 0);
  EXPECT_LT(passing, verdicts);
  EXPECT_DOUBLE_EQ(some.share_passing, static_cast<double>(passing) / verdicts);
  EXPECT_THROW((void)bin_sensitivity(mixed, Binning::equal_width, 0.05, 3, 9), InputError);
}

TEST(SeedSensitivity, CountsTheSamplesThatPass) {
  std::vector<std::vector<double>> samples;
  for (std::uint64_t k = 0; k < 3; ++k) samples.push_back(normal_scores(200, 1.0, 0.1));
  samples.push_back(sample(200, [](double i) { return -std::log((i + 0.5) / 200); }));
  samples.emplace_back();  // without sections: no verdict, and not counted
  const SeedSensitivity s = seed_sensitivity(samples);
  ASSERT_EQ(s.samples.size(), 5u);
  for (const auto* test : {&s.equiprobable, &s.equal_width, &s.anderson_darling, &s.shapiro_wilk}) {
    EXPECT_DOUBLE_EQ(test->share_passing, 0.75);
    EXPECT_LT(test->p_min, 1e-3);
    EXPECT_GT(test->p_median, 0.9);
  }
}

}  // namespace
}  // namespace abradem::analysis
