// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "abradem/simulation/simulation.h"

/// Finding the three numbers behind a groove at once: the disc's wear coefficient, the pin's as a ratio to it
/// and the removed fraction of ploughing, from volume, depth and width; how well the measurement tells them,
/// and what would tell them better.                                        docs/reference/calibrate.md#groove
namespace abradem::study {

inline constexpr std::size_t kGrooveUnknowns = 3;

/// The parameters: wear coefficient [1/Pa], pin's coefficient / disc's, removed fraction.
using GrooveParameters = std::array<double, kGrooveUnknowns>;

/// What a run of the case at some parameters comes to; means over the sections. SI.
struct GrooveState {
  GrooveParameters parameters{};
  double volume = 0.0, depth = 0.0, width = 0.0;  ///< removed; the three that are matched
  double ridge_height = 0.0, ridge_area = 0.0, groove_area = 0.0;
  double flat_along = 0.0, flat_across = 0.0;  ///< of the tip
  double pin_volume = 0.0, pin_mass = 0.0;     ///< lost by the pin
};

/// Something that a laboratory could measure besides.
struct FurtherMeasurement {
  std::string name, unit;
  double value = 0.0, sd = 0.0;  ///< predicted, with the scatter that the parameters' uncertainty gives it
  double precision = 0.1;        ///< relative sd it is assumed to be measured with
  /// Relative sd of each parameter once it is known so well; of the removed fraction the absolute one.
  GrooveParameters sd_after{};
  double volume_left = 1.0;  ///< of the joint uncertainty of the three: its volume after over before
};

struct GrooveCalibration {
  std::array<double, 3> target{}, target_sd{};  ///< volume [m^3], depth, width [m]
  double coverage = 0.95, z = 1.96;
  GrooveState calibrated;
  std::array<double, 3> residual{};  ///< (state - target) / sd
  bool inside = false;               ///< volume within one sd, depth and width within their ranges
  bool at_limit = false;             ///< a parameter has come to the end of its range: the closest point
  GrooveParameters low{}, high{};    ///< intervals
  /// Of ln alpha, ln ratio and the removed fraction.
  std::array<std::array<double, 3>, 3> covariance{}, correlation{};
  /// Directions of these three in which the measurement says least (first) to most; sd along each.
  std::array<std::array<double, 3>, 3> directions{};
  std::array<double, 3> direction_sd{};
  std::vector<FurtherMeasurement> further;  ///< the one that would settle most first
  double revolutions = 0.0;                 ///< of the trials
  int runs = 0;
  std::vector<GrooveState> trials;  ///< in their order
};

struct GrooveCalibrationOptions {
  double coverage = 0.95;
  double revolutions = 12.0;  ///< that the trials model for those of the test
  int most_steps = 8;
  std::string pair{};  ///< "abrader/worn"; empty: the only one
  std::function<bool(const std::string& doing, double fraction)> watch{};
};

/// A case with these parameters: its [wear] pair, the opposite pair and [ploughing].
[[nodiscard]] simulation::Setup with_groove_parameters(simulation::Setup setup, std::size_t pair,
                                                       const GrooveParameters& parameters);

/// Newton's method on the three (Broyden's updates between), each evaluation a run of few revolutions; the
/// derivatives that the intervals are made of are taken anew at the result. A range counts as the limits of a
/// uniform distribution: sd = (high - low) / sqrt(12).
/// @throws InputError where the case has no measured volume, depth and width or no guided particle;
/// SimulationError; Interrupted
[[nodiscard]] GrooveCalibration calibrate_groove(
    const simulation::Setup& setup, const simulation::MeshSource& source = simulation::generate_mesh,
    const GrooveCalibrationOptions& options = {});

/// Parameters that the measurement leaves open: a coefficient or a ratio whose interval spans more than a
/// factor of ten, a removed fraction whose interval is more than half of 0 to 1.
[[nodiscard]] std::vector<std::string> undetermined(const GrooveCalibration& calibration);

}  // namespace abradem::study
