// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/study/verdict.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "abradem/core/error.h"

namespace abradem::study {
namespace {

void check_sizes(std::span<const double> a, std::span<const double> b, std::size_t fewest) {
  if (a.size() != b.size()) throw InputError(fmt::format("{} values to compare with {}", a.size(), b.size()));
  if (a.size() < fewest) throw InputError(fmt::format("{} values; expected {} at least", a.size(), fewest));
}

bool within_factor(double theirs, double ours) noexcept {
  const double ratio = ours / theirs;
  return ratio >= 1.0 / kTrendFactor && ratio <= kTrendFactor;
}

bool close(double theirs, double ours, double tolerance) noexcept {
  return std::abs(ours - theirs) <= tolerance * std::abs(theirs);
}

/// From the mean slope of the second half over that of the first: 1 where the curve steepens, -1 where it
/// flattens, 0 where it is straight to kStraight.
int bend(std::span<const double> x, std::span<const double> y) {
  constexpr double kStraight = 0.02;
  const std::size_t last = x.size() - 1, middle = last / 2;
  const double ratio =
      (y[last] - y[middle]) / (x[last] - x[middle]) / ((y[middle] - y[0]) / (x[middle] - x[0]));
  return ratio > 1.0 + kStraight ? 1 : ratio < 1.0 - kStraight ? -1 : 0;
}

}  // namespace

Verdict worse(Verdict a, Verdict b) noexcept { return std::max(a, b); }

Verdict together(std::span<const Verdict> parts) {
  if (parts.empty()) throw InputError("no part to judge the whole by");
  const auto is = [&](Verdict v) { return std::ranges::count(parts, v); };
  if (is(Verdict::reproduced) == std::ssize(parts)) return Verdict::reproduced;
  return is(Verdict::not_reproduced) == std::ssize(parts) ? Verdict::not_reproduced : Verdict::trend_only;
}

Verdict judge_value(double theirs, double ours, double tolerance) noexcept {
  if (close(theirs, ours, tolerance)) return Verdict::reproduced;
  return within_factor(theirs, ours) ? Verdict::trend_only : Verdict::not_reproduced;
}

Verdict judge_range(Interval theirs, Interval ours, double tolerance) noexcept {
  if (close(theirs.low, ours.low, tolerance) && close(theirs.high, ours.high, tolerance))
    return Verdict::reproduced;
  return ours.low <= theirs.high && ours.high >= theirs.low ? Verdict::trend_only : Verdict::not_reproduced;
}

Verdict judge_inside(Interval theirs, double ours) noexcept {
  if (ours >= theirs.low && ours <= theirs.high) return Verdict::reproduced;
  return within_factor(ours < theirs.low ? theirs.low : theirs.high, ours) ? Verdict::trend_only
                                                                           : Verdict::not_reproduced;
}

Verdict judge_p_values(std::span<const double> theirs, std::span<const double> ours, double level) {
  check_sizes(theirs, ours, 1);
  std::size_t same = 0;
  for (std::size_t k = 0; k < theirs.size(); ++k)
    same += !std::isnan(ours[k]) && (theirs[k] > level) == (ours[k] > level);
  if (same == theirs.size()) return Verdict::reproduced;
  return 5 * same >= 4 * theirs.size() ? Verdict::trend_only : Verdict::not_reproduced;
}

Verdict judge_curve(std::span<const double> x, std::span<const double> theirs, std::span<const double> ours,
                    double tolerance) {
  check_sizes(x, theirs, 4);
  check_sizes(theirs, ours, 4);
  bool all_close = true, all_within = true;
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (k > 0 && !(x[k] > x[k - 1])) throw InputError("places of a curve do not ascend");
    all_close = all_close && close(theirs[k], ours[k], tolerance);
    all_within = all_within && within_factor(theirs[k], ours[k]);
  }
  if (all_close) return Verdict::reproduced;
  return all_within && bend(x, theirs) == bend(x, ours) ? Verdict::trend_only : Verdict::not_reproduced;
}

Verdict judge_trend(std::span<const double> y, Trend trend) {
  if (y.size() < 2) throw InputError(fmt::format("{} values show no trend; expected 2 at least", y.size()));
  const double sign = trend == Trend::rising ? 1.0 : -1.0;
  std::size_t good = 0;
  for (std::size_t k = 1; k < y.size(); ++k) good += sign * (y[k] - y[k - 1]) > 0.0;
  if (good == y.size() - 1) return Verdict::reproduced;
  return 2 * good > y.size() - 1 && sign * (y.back() - y.front()) > 0.0 ? Verdict::trend_only
                                                                        : Verdict::not_reproduced;
}

double growth_exponent(std::span<const double> x, std::span<const double> y) {
  check_sizes(x, y, 2);
  double mean_x = 0.0, mean_y = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (!(x[k] > 0.0 && y[k] > 0.0)) return std::numeric_limits<double>::quiet_NaN();
    mean_x += std::log(x[k]) / static_cast<double>(x.size());
    mean_y += std::log(y[k]) / static_cast<double>(x.size());
  }
  double xx = 0.0, xy = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double dx = std::log(x[k]) - mean_x;
    xx += dx * dx;
    xy += dx * (std::log(y[k]) - mean_y);
  }
  return xy / xx;
}

Verdict judge_growth(double exponent, Growth growth, double tolerance) noexcept {
  const bool fits = growth == Growth::linear ? std::abs(exponent - 1.0) <= tolerance
                                             : exponent > 0.0 && exponent < 1.0 - tolerance;
  if (fits) return Verdict::reproduced;
  return exponent > 0.0 ? Verdict::trend_only : Verdict::not_reproduced;
}

}  // namespace abradem::study
