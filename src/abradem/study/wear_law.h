// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "abradem/analysis/regression.h"
#include "abradem/analysis/residuals.h"

/// Does Archard's law hold for wear tests at several loads and distances, and which power law does?
///                                                           docs/theory/calibration.md#many-tests-at-once
namespace abradem::study {

/// Tests of one material. Arrays of equal length.
struct WearTests {
  std::string material{};
  std::vector<double> volume{};    ///< worn [m^3], > 0
  std::vector<double> force{};     ///< normal [N], > 0
  std::vector<double> distance{};  ///< slid [m], > 0
};

/// What the design of the tests lets one find.
enum class Identifiable {
  both,      ///< p and q
  force,     ///< p; all distances are equal
  distance,  ///< q; all forces are equal
  combined,  ///< p + b q alone: ln s = a + b ln F throughout
  neither,   ///< all tests have the same force and distance
};

/// Prediction of tests that were left out of the fit, fold by fold.
struct CrossValidation {
  int folds = 0;
  std::vector<double> predicted{};  ///< of each test by the fit without its fold [m^3]; NaN where none is
  /// sqrt(mean((predicted/measured - 1)^2)); NaN when any fold cannot be fitted.
  double relative_error = std::numeric_limits<double>::quiet_NaN();
  double log_error = std::numeric_limits<double>::quiet_NaN();  ///< rms of ln(predicted/measured)
};

/// ln V = ln V_0 + p ln(F/F_0) + q ln(s/s_0) + noise, by least squares with QR, beside Archard's
/// V = alpha F s (p = q = 1), fitted in the same logarithms.
struct WearLawFit {
  WearTests tests;
  double confidence = 0.95;
  Identifiable identifiable = Identifiable::neither;
  double force = 0.0, distance = 0.0;          ///< F_0, s_0: geometric means of the tests [N], [m]
  analysis::Estimate volume;                   ///< V_0, the law at F_0 and s_0 [m^3]
  std::optional<analysis::Estimate> p, q;      ///< exponents; none where the tests cannot tell
  double slope = 0.0;                          ///< b, of `combined`
  std::optional<analysis::Estimate> combined;  ///< p + b q
  /// The law at F = 1 N and s = 1 m [m^3] where both exponents are found; at F = 1 N and s_0 (F_0 and 1 m)
  /// where only one is.
  std::optional<analysis::Estimate> k;
  double residual_sd = std::numeric_limits<double>::quiet_NaN();  ///< of ln V
  double r_squared = std::numeric_limits<double>::quiet_NaN();
  double variance_inflation = 1.0;  ///< of p and q by their correlation, 1/(1 - r^2)
  int df = 0;
  std::vector<double> fitted{};  ///< [m^3]
  analysis::LinearModel model;   ///< in 1, ln(F/F_0), ln(s/s_0), as far as they are identifiable
  analysis::ResidualDiagnostics residuals;

  analysis::Estimate archard;  ///< alpha [1/Pa], geometric mean of V/(F s) with its interval
  double archard_residual_sd = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> archard_fitted{};  ///< [m^3]
  analysis::FTest against_archard;       ///< small p: exponents of 1 do not explain the tests
  /// Tests of equal force and distance tell the noise alone; small p: no power law explains the rest.
  std::optional<analysis::FTest> lack_of_fit;
  std::optional<analysis::FTest> curvature;  ///< of a parabola in ln F (ln s); small p: no power law

  /// Each test left out in turn; all tests of one force and distance left out together.
  CrossValidation one_out, one_out_archard, level_out, level_out_archard;

  [[nodiscard]] bool archard_rejected() const noexcept { return against_archard.p < 1.0 - confidence; }
};

/// @throws InputError when arrays differ in length, a value is not positive, there are fewer than 3 tests, or
/// the confidence is not in (0, 1)
[[nodiscard]] WearLawFit fit_wear_law(const WearTests& tests, double confidence = 0.95);

/// The F-test of common exponents (each material with its own k) against exponents of each material's own.
/// Nothing for fewer than two materials, or when they do not share what is identifiable.
[[nodiscard]] std::optional<analysis::FTest> common_exponents(std::span<const WearLawFit> fits);

}  // namespace abradem::study
