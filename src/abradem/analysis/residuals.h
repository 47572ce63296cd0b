// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "abradem/analysis/normality.h"
#include "abradem/analysis/regression.h"

/// Whether a linear model is the right one: its simplification, and what it leaves over.
///                                                                   docs/theory/statistics.md
namespace abradem::analysis {

/// The F-test of a simpler model inside a richer one: F = ((SSE_s - SSE_r)/(df_s - df_r)) / (SSE_r/df_r).
/// Under the simpler one, with independent normal errors of equal scatter, it is Fisher's.
struct FTest {
  double statistic = std::numeric_limits<double>::quiet_NaN();
  double p = std::numeric_limits<double>::quiet_NaN();
  int df_simpler = 0;  ///< df_s - df_r: what the richer model has more
  int df_error = 0;    ///< df_r
};
/// NaN where nothing is left over to compare with (df_r < 1, or SSE_r is round-off beside SSE_s).
/// @throws InputError unless df_s > df_r >= 0
[[nodiscard]] FTest compare_nested(double sse_simpler, int df_simpler, double sse_richer, int df_richer);

/// Sum of the squared residuals.
[[nodiscard]] double squared_error(const LinearModel& model) noexcept;

struct ResidualDiagnostics {
  std::vector<double> leverage{};     ///< diagonal of the hat matrix, x_i^T (X^T X)^-1 x_i
  std::vector<double> studentised{};  ///< externally: e_i over its sd from a fit without value i; NaN without
  std::size_t outlier = 0;            ///< index of the largest |studentised|
  /// That the largest of n is as far out by chance: Student's p times n [Bonferroni], at most 1.
  double outlier_p = std::numeric_limits<double>::quiet_NaN();
  AndersonDarling anderson_darling;  ///< of the residuals
  ShapiroWilk shapiro_wilk;
  /// That the scatter does not depend on the columns: n R^2 of e^2 on X, chi-squared with (columns - 1)
  /// [koenker1981].
  double equal_scatter_p = std::numeric_limits<double>::quiet_NaN();
};
/// @param x, columns of the fit; the first column is the constant
/// @throws InputError when sizes differ
[[nodiscard]] ResidualDiagnostics diagnose_residuals(const LinearModel& model, std::span<const double> x,
                                                     int columns);

}  // namespace abradem::analysis
