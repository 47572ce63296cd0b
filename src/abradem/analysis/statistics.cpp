// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/analysis/statistics.h"

#include <fmt/core.h>

#include "abradem/core/error.h"

namespace abradem::analysis {

namespace {

std::vector<double> sorted_copy(std::span<const double> values) {
  std::vector<double> sorted(values.begin(), values.end());
  std::ranges::sort(sorted);
  return sorted;
}

}  // namespace

void check_finite(std::span<const double> values) {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i]))
      throw InputError(fmt::format("statistics: value {} of {} is {}; only finite values have a mean", i,
                                   values.size(), values[i]));
}

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
