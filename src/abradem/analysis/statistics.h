// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

/// Statistics of samples such as the depths of a revolution's sections.            docs/theory/statistics.md
/// Values carry the unit of what is sampled. A number that the sample cannot give (the sd of one value) is
/// NaN.
namespace abradem::analysis {

struct Summary {
  std::int64_t count = 0;
  double mean = std::numeric_limits<double>::quiet_NaN();
  double sd = std::numeric_limits<double>::quiet_NaN();  ///< of the sample, with n - 1; NaN below two values
  double min = std::numeric_limits<double>::quiet_NaN();
  double lower_quartile = std::numeric_limits<double>::quiet_NaN();  ///< as quantile(), p = 1/4
  double median = std::numeric_limits<double>::quiet_NaN();
  double upper_quartile = std::numeric_limits<double>::quiet_NaN();
  double max = std::numeric_limits<double>::quiet_NaN();
};

/// Mean and sd in two passes, quartiles of type 7.   @throws InputError when a value is not finite
[[nodiscard]] Summary summarise(std::span<const double> values);

/// Quantile of type 7 (linear between order statistics, the default of R and NumPy).   [hyndman1996]
/// @param sorted ascending, not empty   @param p in [0, 1]   @throws InputError otherwise (order is not
/// checked)
[[nodiscard]] double quantile(std::span<const double> sorted, double p);

/// Indices, ascending, of the values further than 1.5 interquartile ranges outside the quartiles. [tukey1977]
/// @throws InputError when a value is not finite
[[nodiscard]] std::vector<std::size_t> tukey_outliers(std::span<const double> values);

/// Chi-squared test of the hypothesis that a sample is normal, with mean and sd taken from the sample.
/// The statistic's law under the hypothesis lies between chi-squared with bins - 3 and with bins - 1 degrees
/// of freedom, for the parameters were fitted to the values and not to the counts [chernoff1954]; so two
/// p-values bound the true one. All p are NaN, and df 0, when the test cannot be made: fewer than 20 values,
/// or a scatter of no more than kRoundOffScatter.
struct ChiSquaredNormality {
  double statistic = std::numeric_limits<double>::quiet_NaN();
  int bins = 0;                                         ///< equally probable under the fitted normal
  int df = 0;                                           ///< bins - 3
  double p = std::numeric_limits<double>::quiet_NaN();  ///< with df; the lower bound, the one in the tables
  double p_upper = std::numeric_limits<double>::quiet_NaN();  ///< with df + 2
};

/// Relative to the largest |value|: a smaller sd is taken for arithmetic noise of equal values. Widths
/// measured 22 mm from the axis carry about 1e-14 of it; a depth of 10 um would have to scatter by less than
/// 0.01 pm.
inline constexpr double kRoundOffScatter = 1e-9;

/// Bins of the test for n values: 2 n^(2/5) to the nearest, but no fewer than 5 values expected in each.
[[nodiscard]] int normality_bins(std::int64_t n) noexcept;

/// @throws InputError when a value is not finite
[[nodiscard]] ChiSquaredNormality chi_squared_normality(std::span<const double> values);
/// As above with the number of bins given.   @throws InputError also when bins < 4
[[nodiscard]] ChiSquaredNormality chi_squared_normality(std::span<const double> values, int bins);

/// Mean, sd, smallest and largest of a stream, in one pass and without storing it; Welford's update, which
/// does not lose digits where the scatter is small beside the mean.   [welford1962]; merge: [chan1983]
class RunningStatistics {
 public:
  void add(double value) noexcept {
    ++count_;
    const double from_old_mean = value - mean_;
    mean_ += from_old_mean / static_cast<double>(count_);
    squares_ += from_old_mean * (value - mean_);
    min_ = std::min(min_, value);
    max_ = std::max(max_, value);
  }
  /// As if the other's values had been added after these (to round-off; the order of merges fixes the bits).
  void merge(const RunningStatistics& other) noexcept;

  [[nodiscard]] std::int64_t count() const noexcept { return count_; }
  [[nodiscard]] double mean() const noexcept { return count_ > 0 ? mean_ : kNone; }  ///< NaN when empty
  [[nodiscard]] double sd() const noexcept {  ///< with n - 1; NaN below two values
    return count_ > 1 ? std::sqrt(squares_ / static_cast<double>(count_ - 1)) : kNone;
  }
  [[nodiscard]] double min() const noexcept { return count_ > 0 ? min_ : kNone; }
  [[nodiscard]] double max() const noexcept { return count_ > 0 ? max_ : kNone; }

 private:
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::int64_t count_ = 0;
  double mean_ = 0.0;
  double squares_ = 0.0;  ///< sum of (value - mean)^2
  double min_ = std::numeric_limits<double>::infinity();
  double max_ = -std::numeric_limits<double>::infinity();
};

}  // namespace abradem::analysis
