// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/analysis/statistics.h"

#include <fmt/core.h>

#include <boost/math/special_functions/gamma.hpp>
#include <numbers>

#include "abradem/core/error.h"

namespace abradem::analysis {

namespace {

void check_finite(std::span<const double> values) {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i]))
      throw InputError(fmt::format("statistics: value {} of {} is {}; only finite values have a mean", i,
                                   values.size(), values[i]));
}

double standard_normal_cdf(double z) noexcept { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

/// Probability that a chi-squared variable with df degrees of freedom exceeds x.
double chi_squared_tail(double x, int df) { return boost::math::gamma_q(0.5 * df, 0.5 * x); }

std::vector<double> sorted_copy(std::span<const double> values) {
  std::vector<double> sorted(values.begin(), values.end());
  std::ranges::sort(sorted);
  return sorted;
}

}  // namespace

double quantile(std::span<const double> sorted, double p) {
  if (sorted.empty())
    throw InputError("statistics: quantile of an empty sample; at least one value is needed");
  if (!(p >= 0.0 && p <= 1.0))
    throw InputError(fmt::format("statistics: quantile at p = {}; p lies between 0 and 1", p));
  const double position = p * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (position - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

Summary summarise(std::span<const double> values) {
  check_finite(values);
  Summary s;
  s.count = static_cast<std::int64_t>(values.size());
  if (values.empty()) return s;
  const auto n = static_cast<double>(values.size());
  const double first = values.front();  // sums of differences: equal values have exactly their value as mean
  double sum = 0.0;
  for (const double x : values) sum += x - first;
  s.mean = first + sum / n;
  if (values.size() > 1) {
    double squares = 0.0;
    for (const double x : values) squares += (x - s.mean) * (x - s.mean);
    s.sd = std::sqrt(squares / (n - 1.0));
  }
  const std::vector<double> sorted = sorted_copy(values);
  s.min = sorted.front();
  s.lower_quartile = quantile(sorted, 0.25);
  s.median = quantile(sorted, 0.5);
  s.upper_quartile = quantile(sorted, 0.75);
  s.max = sorted.back();
  return s;
}

std::vector<std::size_t> tukey_outliers(std::span<const double> values) {
  const Summary s = summarise(values);
  std::vector<std::size_t> outliers;
  const double reach = 1.5 * (s.upper_quartile - s.lower_quartile);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (values[i] < s.lower_quartile - reach || values[i] > s.upper_quartile + reach) outliers.push_back(i);
  return outliers;
}

int normality_bins(std::int64_t n) noexcept {
  const auto rule = static_cast<std::int64_t>(std::lround(2.0 * std::pow(static_cast<double>(n), 0.4)));
  return static_cast<int>(std::min(rule, n / 5));
}

ChiSquaredNormality chi_squared_normality(std::span<const double> values) {
  const int bins = normality_bins(static_cast<std::int64_t>(values.size()));
  if (bins >= 4) return chi_squared_normality(values, bins);
  check_finite(values);
  return {.bins = bins};
}

ChiSquaredNormality chi_squared_normality(std::span<const double> values, int bins) {
  if (bins < 4)
    throw InputError(
        fmt::format("statistics: chi-squared test with {} bins; mean and sd are fitted, so at least 4 "
                    "are needed",
                    bins));
  const Summary s = summarise(values);
  ChiSquaredNormality test{.bins = bins};
  const double largest = std::max(std::abs(s.min), std::abs(s.max));
  if (!(s.sd > kRoundOffScatter * largest)) return test;
  std::vector<std::int64_t> observed(static_cast<std::size_t>(bins));
  for (const double x : values) {
    const double u = standard_normal_cdf((x - s.mean) / s.sd);
    ++observed[static_cast<std::size_t>(std::min(bins - 1, static_cast<int>(u * bins)))];
  }
  const double expected = static_cast<double>(values.size()) / bins;
  test.statistic = 0.0;
  for (const std::int64_t o : observed) {
    const double excess = static_cast<double>(o) - expected;
    test.statistic += excess * excess / expected;
  }
  test.df = bins - 3;
  test.p = chi_squared_tail(test.statistic, test.df);
  test.p_upper = chi_squared_tail(test.statistic, test.df + 2);
  return test;
}

void RunningStatistics::merge(const RunningStatistics& other) noexcept {
  if (other.count_ == 0) return;
  if (count_ == 0) {
    *this = other;
    return;
  }
  const auto n = static_cast<double>(count_), m = static_cast<double>(other.count_);
  const double apart = other.mean_ - mean_;
  mean_ += apart * (m / (n + m));
  squares_ += other.squares_ + apart * apart * (n * m / (n + m));
  count_ += other.count_;
  min_ = std::min(min_, other.min_);
  max_ = std::max(max_, other.max_);
}

}  // namespace abradem::analysis
