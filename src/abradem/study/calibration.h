// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "abradem/simulation/simulation.h"
#include "abradem/study/trial.h"

/// Finding the wear coefficient, or the number of revolutions, with which a case wears as much as was
/// measured; and what the measurement cannot tell.                              docs/theory/calibration.md
namespace abradem::study {

/// A value with the interval around it; NaN for a bound that was not found.
struct Estimate {
  double value = 0.0, low = 0.0, high = 0.0;
};

enum class Unknown { wear_coefficient, revolutions };

struct CalibrationOptions {
  Unknown unknown = Unknown::wear_coefficient;
  double coverage = 0.95;  ///< of the intervals: mean -+ z sd of a normal distribution
  std::string pair{};      ///< "abrader/worn"; empty: the only one of the case that can wear a wall
  /// The table of pairs: revolutions for each of these coefficients [1/Pa], coefficients for each of these
  /// revolutions. Default: those of [yan2022].
  std::vector<double> coefficients{1e-11, 1.5e-11, 1.7e-11, 2e-11, 5e-11};
  std::vector<double> revolutions{8.0, 12.0};
  /// Told what is being done and how far it is, 0 to 1; false stops with Interrupted. Never called twice at
  /// once, but from any thread.
  std::function<bool(const std::string& doing, double fraction)> watch{};
};

/// A run of the case at a pair of the two unknowns.
struct CalibrationPoint {
  double wear_coefficient = 0.0;   ///< [1/Pa]
  double revolutions = 0.0;        ///< [-] made
  double volume = 0.0;             ///< of the measure that is matched [m^3]
  analysis::Summary depth, width;  ///< over the sections [m]
  /// Of the mean section from that of the calibrated run, relative L2; NaN where there is no section.
  double profile_distance = 0.0;
  std::string failure{};  ///< why it ended before its time; empty where it did not
  [[nodiscard]] double product() const noexcept { return wear_coefficient * revolutions; }
};

/// A row of the table of pairs: one number given, the other found.
struct CalibrationPair {
  Unknown unknown = Unknown::revolutions;
  Estimate wear_coefficient, revolutions;  ///< of the one given all three are equal
  double scaling_factor = 0.0;  ///< revolutions of the test / these; NaN where the test's are unknown
  std::string failure{};        ///< why a bound (NaN) was not found
};

/// Where the wear on the way to a measured number lies: alpha n at which the model gives the lower and the
/// upper end of what was measured [1/Pa].
struct ProductRange {
  double low = 0.0, high = 0.0;
  bool low_reached = true, high_reached = true;  ///< false: beyond `CalibrationResult::curve`
};

struct CalibrationResult {
  std::string abrader, worn;    ///< the pair whose coefficient it is
  simulation::Method method{};  ///< of the trials
  simulation::DeformationRule rule{};
  bool closed_form = false;       ///< the volume is proportional to alpha n, shown by the runs; else a root
  simulation::MeanSd target;      ///< volume to be matched [m^3]
  double coverage = 0.95, z = 0;  ///< intervals are target.mean -+ z target.sd
  Unknown unknown{};
  std::optional<double> test_revolutions;

  Estimate wear_coefficient, revolutions, product;  ///< of what is given all three are equal
  double scaling_factor = 0.0;                      ///< as in CalibrationPair
  CalibrationPoint start;                           ///< the run it began with
  CalibrationPoint calibrated;                      ///< the run at the result
  double first_guess = 0.0;     ///< V = c alpha n with c from the start: coefficient [1/Pa] or revolutions
  double first_residual = 0.0;  ///< of a run there: (volume - target) / target
  double residual = 0.0;        ///< of the run at the result
  int runs = 0;                 ///< made until the result
  std::string failure{};        ///< why a bound (NaN) was not found

  /// Runs with the same alpha n as the calibrated one, and the largest spread among them, (max - min) / mean.
  std::vector<CalibrationPoint> ridge;
  double ridge_volume_spread = 0.0, ridge_depth_spread = 0.0, ridge_width_spread = 0.0,
         ridge_profile_distance = 0.0;

  /// Volume, depth and width along alpha n, from one run that goes on beyond the measured ranges.
  struct CurvePoint {
    double product = 0.0;                           ///< alpha n [1/Pa]
    double volume = 0.0, depth = 0.0, width = 0.0;  ///< SI, means over the sections
  };
  std::vector<CurvePoint> curve;
  std::optional<simulation::Range> measured_depth, measured_width;  ///< [m]
  ProductRange by_volume;
  std::optional<ProductRange> by_depth, by_width;

  std::vector<CalibrationPair> pairs;
};

/// The pair of a case whose coefficient a calibration changes.
/// @throws InputError when there is none, or several and `wanted` ("abrader/worn") does not say which
[[nodiscard]] std::size_t calibrated_pair(const simulation::Setup& setup, const std::string& wanted);

/// Calibrates a case by its [measurement]. The number of revolutions (or the coefficient) of the case is
/// kept.
///
/// The volume matched is the law's where deformation is conserving (or none), and there the closed form
/// V = c alpha n is used: c from one run, confirmed and corrected by further ones. Under the paper's rule it
/// is the paper's measure [yan2022, Eq. 10-12], which grows faster than alpha n: the root is bracketed and
/// found by TOMS 748.
/// @throws InputError when the case has no measured volume, no wall that turns or oscillates, or no wear;
/// SimulationError when no run at all reaches the volume; Interrupted
[[nodiscard]] CalibrationResult calibrate(const simulation::Setup& setup,
                                          const simulation::MeshSource& source = simulation::generate_mesh,
                                          const CalibrationOptions& options = {});

/// Where a rising curve y(x) passes a level, linear between points and through (0, 0); NaN beyond the last.
[[nodiscard]] double passes(std::span<const double> x, std::span<const double> y, double level);

/// A fit of volume against revolutions printed in [yan2022]: y = a0 + a1 n + a2 n^2 [mm^3].
struct PublishedFit {
  int equation;
  double wear_coefficient;  ///< [1/Pa]
  double a0, a1, a2;
  /// Volume after so many revolutions [m^3].
  [[nodiscard]] double volume(double revolutions) const noexcept;
  /// Revolutions at which it reaches a volume [m^3].
  [[nodiscard]] double revolutions(double volume) const noexcept;
};
/// Eq. 13-17.
[[nodiscard]] std::span<const PublishedFit> published_fits() noexcept;

}  // namespace abradem::study
