// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

/// Tests of the hypothesis that a sample is normal, with mean and sd taken from the sample.
///                                                                              docs/theory/statistics.md
/// They assume independent values; neighbouring sections of a groove are not (correlation.h). Where a test
/// cannot be made (too few values, a scatter of no more than kRoundOffScatter) its numbers are NaN. No result
/// depends on the unit of the values.
namespace abradem::analysis {

/// Relative to the largest |value|: a smaller sd is taken for arithmetic noise of equal values. Widths
/// measured 22 mm from the axis carry about 1e-14 of it; a depth of 10 um would have to scatter by less than
/// 0.01 pm.
inline constexpr double kRoundOffScatter = 1e-9;

/// The chi-squared test. The statistic's law under the hypothesis lies between chi-squared with bins - 3 and
/// with bins - 1 degrees of freedom, for the parameters were fitted to the values and not to the counts
/// [chernoff1954]; so two p-values bound the true one.
struct ChiSquaredNormality {
  double statistic = std::numeric_limits<double>::quiet_NaN();
  int bins = 0;                                         ///< that were counted in, after any pooling
  int df = 0;                                           ///< bins - 3; 0 when there is no verdict
  double p = std::numeric_limits<double>::quiet_NaN();  ///< with df; the lower bound, the one in the tables
  double p_upper = std::numeric_limits<double>::quiet_NaN();  ///< with df + 2
};

/// How the values are put into bins.
enum class Binning {
  equiprobable,  ///< every bin holds the same share of the fitted normal
  equal_width,   ///< from the smallest to the largest value; the tails pooled until they expect 5 values
};

/// Equiprobable bins for n values: 2 n^(2/5) to the nearest, but no fewer than 5 values expected in each.
[[nodiscard]] int normality_bins(std::int64_t n) noexcept;
/// What the histograms of such work commonly show, and a reading of [yan2022], which does not state its bins.
inline constexpr int kEqualWidthBins = 10;

/// With normality_bins.   @throws InputError when a value is not finite
[[nodiscard]] ChiSquaredNormality chi_squared_normality(std::span<const double> values);
/// With a given number of bins; for equal_width the number before pooling. No verdict when fewer than 4
/// remain.
/// @throws InputError also when bins < 4
[[nodiscard]] ChiSquaredNormality chi_squared_normality(std::span<const double> values, int bins,
                                                        Binning binning = Binning::equiprobable);

/// The Anderson-Darling test, for 8 values or more. p by the formulas of [dagostino1986, table 4.9], which
/// hold down to 4e-24; what lies below is given as that.
struct AndersonDarling {
  double statistic = std::numeric_limits<double>::quiet_NaN();  ///< A^2
  double adjusted = std::numeric_limits<double>::quiet_NaN();   ///< A^2 (1 + 0.75/n + 2.25/n^2)
  double p = std::numeric_limits<double>::quiet_NaN();
};
/// O(n log n)   @throws InputError when a value is not finite
[[nodiscard]] AndersonDarling anderson_darling_normality(std::span<const double> values);

/// The Shapiro-Wilk test by Royston's approximation [royston1995, AS R94], for 3 to 5000 values.
struct ShapiroWilk {
  double statistic = std::numeric_limits<double>::quiet_NaN();  ///< W, at most 1
  double p = std::numeric_limits<double>::quiet_NaN();
};
/// O(n log n)   @throws InputError when a value is not finite
[[nodiscard]] ShapiroWilk shapiro_wilk_normality(std::span<const double> values);

/// All tests on one sample.
struct Normality {
  std::int64_t count = 0;
  ChiSquaredNormality equiprobable;  ///< with normality_bins
  ChiSquaredNormality equal_width;   ///< with kEqualWidthBins
  AndersonDarling anderson_darling;
  ShapiroWilk shapiro_wilk;
};
/// @throws InputError when a value is not finite
[[nodiscard]] Normality test_normality(std::span<const double> values);

/// The p of one chi-squared test for many numbers of bins: how much a verdict owes to their choice.
struct BinSensitivity {
  Binning binning = Binning::equiprobable;
  std::vector<int> bins{};  ///< as asked for, ascending
  std::vector<double> p{};  ///< ChiSquaredNormality::p for each; NaN without verdict
  double p_min = std::numeric_limits<double>::quiet_NaN(), p_max = p_min;
  double share_passing = std::numeric_limits<double>::quiet_NaN();  ///< of the verdicts with p > level
};
/// From `fewest` to `most` bins; by default from 5 to the number that leaves 5 values in each.
/// @throws InputError when a value is not finite, or unless 4 <= fewest
[[nodiscard]] BinSensitivity bin_sensitivity(std::span<const double> values, Binning binning,
                                             double level = 0.05, int fewest = 5, int most = 0);

/// The verdicts over several samples of the same thing, such as runs that differ in the mesh's seed alone:
/// the share of samples in which each test finds nothing (p > level), and the range of each p.
struct SeedSensitivity {
  struct Test {
    double share_passing = std::numeric_limits<double>::quiet_NaN();  ///< of the verdicts
    double p_min = std::numeric_limits<double>::quiet_NaN();
    double p_median = std::numeric_limits<double>::quiet_NaN();
    double p_max = std::numeric_limits<double>::quiet_NaN();
  };
  std::vector<Normality> samples{};
  Test equiprobable, equal_width, anderson_darling, shapiro_wilk;
};
/// @throws InputError when a value is not finite
[[nodiscard]] SeedSensitivity seed_sensitivity(std::span<const std::vector<double>> samples,
                                               double level = 0.05);

}  // namespace abradem::analysis
