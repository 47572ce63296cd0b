// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

/// Least squares by QR, with what its numbers are worth.                       docs/theory/statistics.md
/// Intervals are Student's and assume independent errors of equal scatter. Values of a sum that grows (the
/// volume after n revolutions) have errors that are not independent: every one carries those before it. Their
/// R^2 is then close to 1 whatever the law, and their intervals are too narrow; fit_increments is the way.
namespace abradem::analysis {

/// A value and the interval around it.
struct Estimate {
  double value = std::numeric_limits<double>::quiet_NaN();
  double low = std::numeric_limits<double>::quiet_NaN();
  double high = std::numeric_limits<double>::quiet_NaN();
};

/// y = X b + noise for any columns X.
struct LinearModel {
  std::vector<double> coefficients{};         ///< b, one per column
  std::vector<double> errors{};               ///< standard errors; NaN without degrees of freedom
  std::vector<double> low{}, high{};          ///< Student's intervals of the coefficients
  std::vector<double> p{};                    ///< two-sided, that a coefficient is 0
  std::vector<double> residuals{};            ///< y - X b
  std::vector<double> unscaled_covariance{};  ///< (X^T X)^-1, row by row
  double residual_sd = std::numeric_limits<double>::quiet_NaN();  ///< sqrt(SSE / df)
  double r_squared =
      std::numeric_limits<double>::quiet_NaN();         ///< 1 - SSE/SST; SST about the mean, or about 0
  double t = std::numeric_limits<double>::quiet_NaN();  ///< Student's quantile of the intervals
  double confidence = 0.95;
  int df = 0;  ///< values - columns

  /// The model at a row of X, with the interval of its mean (confidence band).   @throws InputError for
  /// another number of columns
  [[nodiscard]] Estimate mean_at(std::span<const double> row) const;
  /// With the interval of one more measurement there (prediction band).
  [[nodiscard]] Estimate prediction_at(std::span<const double> row) const;
};

/// By Householder QR with column pivoting on columns scaled to equal length.
/// @param x row by row, y.size() rows   @param columns >= 1
/// @param with_constant the model holds a constant: R^2 is then about the mean, as usual; else about 0
/// @throws InputError when sizes differ, a value is not finite, there are fewer rows than columns, the
/// columns
///         depend on each other, or confidence is not in (0, 1)
[[nodiscard]] LinearModel fit_linear_model(std::span<const double> x, int columns, std::span<const double> y,
                                           bool with_constant, double confidence = 0.95);

struct FitOptions {
  int degree = 1;               ///< 1 … 6
  bool through_origin = false;  ///< no constant: the curve passes (0, 0)
  double confidence = 0.95;     ///< of every interval
};

/// y = b_0 + b_1 x + b_2 x^2 …
struct PolynomialFit {
  FitOptions options{};
  std::vector<double> coefficients{};  ///< by ascending power, degree + 1 of them; b_0 = 0 through the origin
  std::vector<double> errors{}, low{}, high{},
      p{};  ///< as in LinearModel; of a b_0 that was not fitted: 0, 0, 0, NaN
  double residual_sd = std::numeric_limits<double>::quiet_NaN();
  double r_squared = std::numeric_limits<double>::quiet_NaN();
  int df = 0;
  LinearModel model{};  ///< in powers of (x - centre)/scale; centre is 0 through the origin
  double centre = 0.0, scale = 1.0;

  [[nodiscard]] double operator()(double x) const noexcept;
  [[nodiscard]] Estimate mean_at(double x) const;        ///< confidence band
  [[nodiscard]] Estimate prediction_at(double x) const;  ///< prediction band
};
/// @throws InputError as fit_linear_model, and for a degree out of range
[[nodiscard]] PolynomialFit fit_polynomial(std::span<const double> x, std::span<const double> y,
                                           const FitOptions& options = {});

/// The law of a sum that grows, V(n) = V_0 + b_1 (n - n_0) + b_2 (n^2 - n_0^2), from its increments
///   dV_i = b_1 (n_i - n_{i-1}) + b_2 (n_i^2 - n_{i-1}^2) + noise of variance sigma^2 (n_i - n_{i-1}),
/// which are independent where the sum's values are not. No constant is fitted: nothing is worn at the start.
struct IncrementFit {
  int degree = 1;
  double start = 0.0, start_value = 0.0;                             ///< n_0, V_0
  std::vector<double> coefficients{}, errors{}, low{}, high{}, p{};  ///< of b_1, b_2 (index 0 is b_1)
  double residual_sd =
      std::numeric_limits<double>::quiet_NaN();  ///< sigma, of an increment over one unit of n
  double r_squared =
      std::numeric_limits<double>::quiet_NaN();  ///< of the increments' variation about their mean rate
  int df = 0;
  LinearModel model{};

  [[nodiscard]] double operator()(double n) const noexcept;  ///< V(n)
  [[nodiscard]] Estimate mean_at(double n) const;            ///< of the law, confidence band
  [[nodiscard]] Estimate prediction_at(
      double n) const;  ///< of V(n) itself, which strays from the law by sigma sqrt(n - n_0)
  [[nodiscard]] double rate(double n) const noexcept;  ///< dV/dn
};
/// @param n ascending, from the first value after the start   @param sums V(n)   @param degree 1 or 2
/// @throws InputError as fit_linear_model, when n does not ascend from start, or degree is neither
[[nodiscard]] IncrementFit fit_increments(std::span<const double> n, std::span<const double> sums, int degree,
                                          double confidence = 0.95, double start = 0.0,
                                          double start_value = 0.0);

}  // namespace abradem::analysis
