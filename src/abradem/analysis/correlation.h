// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "abradem/analysis/normality.h"

/// How much neighbouring values of a series know of each other, and how many of them count.
///                                                                              docs/theory/statistics.md
namespace abradem::analysis {

/// Whether the last value has the first for a neighbour, as sections round a circle do.
enum class Ends { joined, open };

/// r_k = sum (x_i - mean)(x_{i+k} - mean) / sum (x_i - mean)^2 for k = 0 … n/2 (joined; i + k counted round
/// the circle) or 0 … n-1 (open; the sum over the n - k pairs). Empty without scatter (kRoundOffScatter).
/// @throws InputError when a value is not finite
[[nodiscard]] std::vector<double> autocorrelation(std::span<const double> values, Ends ends);

/// In steps from one value to the next.
struct Correlation {
  std::vector<double> r{};  ///< autocorrelation(); empty when there is none to speak of
  double noise_band = 0.0;  ///< 1.96/sqrt(n): |r_k| of independent values stays below it 19 times in 20
  double length = std::numeric_limits<double>::quiet_NaN();  ///< lag at which r falls to 1/e, linear between
  double time =
      std::numeric_limits<double>::quiet_NaN();  ///< 1 + 2 sum r_k while r_k > 0: values per independent one
  double effective_count = std::numeric_limits<double>::quiet_NaN();  ///< n / time, at most n
  /// First lag with |r_k| <= 1.96 sqrt((1 + 2 sum_{j<k} r_j^2)/n), the band of an r_k beyond the correlation
  /// [bartlett1946]; 0 when there is none.
  int independent_step = 0;
};
/// @throws InputError when a value is not finite
[[nodiscard]] Correlation correlation(std::span<const double> values, Ends ends);

/// Length along the track of a distance counted in sections [m]: sections are 2 pi radius / count apart.
[[nodiscard]] double along_track(double sections, std::int64_t count, double track_radius) noexcept;

/// Indices of floor(n/step) values, as evenly spread as can be and at least `step` apart (also from the last
/// to the first when the ends are joined).   @throws InputError when step < 1
[[nodiscard]] std::vector<std::size_t> thinned(std::size_t n, int step);

/// The tests of normality on all values and on those that are left after thinning to independent ones.
struct ThinnedNormality {
  Correlation correlation;
  Normality all, independent;
};
/// @throws InputError when a value is not finite
[[nodiscard]] ThinnedNormality test_thinned_normality(std::span<const double> values, Ends ends);

}  // namespace abradem::analysis
