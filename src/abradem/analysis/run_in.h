// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "abradem/analysis/normality.h"

/// Where a run-in ends and a steady state begins, in a series with one value per revolution.
///                                                                              docs/theory/statistics.md
namespace abradem::analysis {

struct RunInOptions {
  double confidence = 0.95;  ///< of every interval; 1 - confidence is the level of every test
  int resamples = 1000;      ///< of the permutation test, and of the bootstrap
  std::uint64_t seed = 1;    ///< of both
  int shortest = 4;          ///< values a steady part must have at least, >= 3
  double drift_tolerance =
      0.01;  ///< [-] change over the steady part, relative to its level, that counts as none
};

/// The series as a straight ramp that passes into a level at a revolution K [hinkley1971],
///   y = level + slope min(x - K, 0) + noise,
/// by least squares, K among the revolutions of the series. Behind K the part must be steady: a drift whose
/// interval holds 0, or that changes the level by no more than the tolerance. Where it is not, because the
/// level is reached along a curve, K moves on to the first revolution behind which the drift is shown to be
/// that small (its whole interval).
struct RunIn {
  enum class State {
    too_short,   ///< fewer than shortest + 3 values: no verdict
    from_start,  ///< nothing distinguishes the series from a level, or all of it lies within the tolerance
    found,       ///< the series changes until K, and is steady behind it
    not_steady,  ///< the series changes, and no part at its end is shown to be steady
  };
  State state = State::too_short;
  double revolution = std::numeric_limits<double>::quiet_NaN();  ///< K, first of the steady part, where found
  double low = std::numeric_limits<double>::quiet_NaN();  ///< interval of K, by bootstrap of the residuals
  double high = std::numeric_limits<double>::quiet_NaN();
  double p = std::numeric_limits<double>::quiet_NaN();  ///< share of shuffled series that a ramp fits as well
  double level = std::numeric_limits<double>::quiet_NaN();  ///< mean of the part behind K (or of all)
  double level_low = std::numeric_limits<double>::quiet_NaN(),
         level_high = level_low;                            ///< Student's interval
  double drift = std::numeric_limits<double>::quiet_NaN();  ///< slope of that part, per revolution
  double drift_low = std::numeric_limits<double>::quiet_NaN(),
         drift_high = drift_low;  ///< Student's interval
};
/// @param revolutions ascending   @param values one for each, such as an increment of volume
/// @throws InputError when sizes differ, revolutions do not ascend, a value is not finite, an option is out
/// of
///         range
[[nodiscard]] RunIn find_run_in(std::span<const double> revolutions, std::span<const double> values,
                                const RunInOptions& options = {});

/// [yan2022]'s rule: the first revolution from which on to the last every p of depth and of width is above
/// the level. Nothing when the last one fails already. A p of NaN fails. The rule tells that tests found
/// nothing; how much that is worth depends on how many revolutions it rests on.
struct NormalFrom {
  std::optional<double> revolution;
  int lasting = 0;  ///< revolutions from there to the end
};
/// @throws InputError when sizes differ
[[nodiscard]] NormalFrom normal_from(std::span<const double> revolutions, std::span<const double> depth_p,
                                     std::span<const double> width_p, double level = 0.05);

/// The same rule's answer for every number of bins of the chi-squared test: samples[k] are the depths
/// (widths) of the sections of revolutions[k].
struct NormalFromByBins {
  std::vector<int> bins{};
  std::vector<NormalFrom> found{};  ///< one for each
  double share_found = 0.0;         ///< of the numbers of bins with an answer
};
/// @throws InputError when sizes differ, a value is not finite, or unless 4 <= fewest <= most
[[nodiscard]] NormalFromByBins normal_from_by_bins(std::span<const double> revolutions,
                                                   std::span<const std::vector<double>> depths,
                                                   std::span<const std::vector<double>> widths,
                                                   Binning binning, int fewest, int most,
                                                   double level = 0.05);

}  // namespace abradem::analysis
