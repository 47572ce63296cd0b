// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "abradem/analysis/contour.h"

namespace abradem::analysis {

/// What is taken for the unworn surface of a measured section.      docs/theory/contours.md#measured-sections
enum class Baseline {
  none,  ///< height 0, as it was measured
  mean,  ///< the mean height of the shoulders
  line,  ///< the straight line through the shoulders
};

struct Levelled {
  std::vector<ProfilePoint> profile;  ///< heights above the baseline
  double offset = 0.0;                ///< of the baseline at the middle of the section [m]
  double tilt = 0.0;                  ///< its slope [-]
  double roughness = 0.0;             ///< rms height of the shoulders above the baseline, Rq [m]
  std::size_t shoulder_points = 0;    ///< that the baseline rests on
};

/// Subtracts the baseline, least squares (QR) through the two shoulders: the points within `shoulder` of
/// either end. The shoulders must be unworn, or the baseline lies too low.
/// @param profile by ascending radius   @param shoulder [m], > 0
/// @throws InputError when the shoulders meet, or hold fewer than two points each
[[nodiscard]] Levelled level(std::span<const ProfilePoint> profile, Baseline baseline, double shoulder);

}  // namespace abradem::analysis
