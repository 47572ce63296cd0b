// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

/// Whether runs give what somebody else states: the rules by which published results are compared with ours.
/// Pure functions of numbers; what cannot be found (NaN) is not reproduced.
///                                                                  docs/reference/study.md#verdicts
namespace abradem::study {

enum class Verdict {
  reproduced,
  trend_only,  ///< the direction or the order of size is right, the number is not
  not_reproduced
};

/// The worse of two.
[[nodiscard]] Verdict worse(Verdict a, Verdict b) noexcept;
/// Of several parts of one thing: reproduced where all are, not reproduced where none is even in trend.
/// @throws InputError when there are none
[[nodiscard]] Verdict together(std::span<const Verdict> parts);

/// What still counts as the right order of size: a factor of 2 either way.
inline constexpr double kTrendFactor = 2.0;

/// A number: reproduced within a relative tolerance, trend only within kTrendFactor of it (and of its sign).
[[nodiscard]] Verdict judge_value(double theirs, double ours, double tolerance) noexcept;

/// Ends of an interval.
struct Interval {
  double low = 0.0, high = 0.0;
};
/// A range: reproduced where both ends are within a relative tolerance, trend only where the ranges overlap.
[[nodiscard]] Verdict judge_range(Interval theirs, Interval ours, double tolerance) noexcept;
/// A number against a range: reproduced inside, trend only within kTrendFactor of the nearer end.
[[nodiscard]] Verdict judge_inside(Interval theirs, double ours) noexcept;

/// p-values against a level, one by one: reproduced where all fall on the same side of it, trend only where
/// all but a fifth do.   @throws InputError when sizes differ or there are none
[[nodiscard]] Verdict judge_p_values(std::span<const double> theirs, std::span<const double> ours,
                                     double level);

/// A curve, at the same places: reproduced where all values are within a relative tolerance; trend only where
/// all are within kTrendFactor and the curve steepens, flattens or is straight (mean slopes of its halves
/// within 2 %) as theirs does.
/// @throws InputError when sizes differ, there are fewer than 4 places, or they do not ascend
[[nodiscard]] Verdict judge_curve(std::span<const double> x, std::span<const double> theirs,
                                  std::span<const double> ours, double tolerance);

enum class Trend { rising, falling };
/// A trend: reproduced where every value goes on from the one before it, trend only where most do and the
/// last lies on the right side of the first.   @throws InputError for fewer than 2 values
[[nodiscard]] Verdict judge_trend(std::span<const double> y, Trend trend);

/// Growth, from the exponent p of y = c x^p fitted by least squares to the logarithms.
/// Linear: reproduced for |p - 1| <= tolerance; slowing: reproduced for 0 < p < 1 - tolerance. Trend only
/// where y grows at all.
enum class Growth { linear, slowing };
/// @throws InputError when sizes differ or there are fewer than 2 places; values must be positive, else NaN
[[nodiscard]] double growth_exponent(std::span<const double> x, std::span<const double> y);
[[nodiscard]] Verdict judge_growth(double exponent, Growth growth, double tolerance) noexcept;

}  // namespace abradem::study
