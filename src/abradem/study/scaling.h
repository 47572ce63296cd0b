// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

/// What it costs to let one modelled revolution stand for several of a test.    docs/theory/scaling.md
namespace abradem::study {

/// The largest scaling factor that keeps to a tolerance, from runs of the same wear.
struct LargestFactor {
  double factor = 1.0;     ///< revolutions of the test per modelled one
  bool at_least = false;   ///< it is the largest that was run, and even that keeps to the tolerance
  bool less_than = false;  ///< it is the smallest that was run, and even that does not
};
/// Between runs errors are interpolated, in logarithms. Where an error falls back below the tolerance at a
/// larger factor, the first crossing counts.
/// @param factors ascending, > 1   @param errors of each against the unscaled run, > 0   @param tolerance > 0
/// @throws InputError otherwise, or when sizes differ or there are none
[[nodiscard]] LargestFactor largest_factor(std::span<const double> factors, std::span<const double> errors,
                                           double tolerance);

}  // namespace abradem::study
