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

/// @throws InputError naming the first value that is not finite
void check_finite(std::span<const double> values);

/// Mean and sd in two passes, quartiles of type 7.   @throws InputError when a value is not finite
[[nodiscard]] Summary summarise(std::span<const double> values);

/// Quantile of type 7 (linear between order statistics, the default of R and NumPy).   [hyndman1996]
/// @param sorted ascending, not empty   @param p in [0, 1]   @throws InputError otherwise (order is not
/// checked)
[[nodiscard]] double quantile(std::span<const double> sorted, double p);

/// Indices, ascending, of the values further than 1.5 interquartile ranges outside the quartiles. [tukey1977]
/// @throws InputError when a value is not finite
[[nodiscard]] std::vector<std::size_t> tukey_outliers(std::span<const double> values);

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

  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("count", self.count_)("mean", self.mean_)("squares", self.squares_)("min", self.min_)("max",
                                                                                                  self.max_);
  }

 private:
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::int64_t count_ = 0;
  double mean_ = 0.0;
  double squares_ = 0.0;  ///< sum of (value - mean)^2
  double min_ = std::numeric_limits<double>::infinity();
  double max_ = -std::numeric_limits<double>::infinity();
};

}  // namespace abradem::analysis
