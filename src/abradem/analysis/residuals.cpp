// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/analysis/residuals.h"

#include <fmt/core.h>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "abradem/core/error.h"

namespace abradem::analysis {

namespace {

/// Relative: a smaller sum of squares is what arithmetic leaves of an exact fit.
constexpr double kRoundOff = 1e-20;

/// x^T C x.
double quadratic_form(std::span<const double> c, std::span<const double> x) noexcept {
  double sum = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = 0; j < x.size(); ++j) sum += x[i] * c[i * x.size() + j] * x[j];
  return sum;
}

double equal_scatter_p(const LinearModel& model, std::span<const double> x, int columns) {
  if (columns < 2 || model.df < 2) return std::numeric_limits<double>::quiet_NaN();
  std::vector<double> squares;
  for (const double e : model.residuals) squares.push_back(e * e);
  const double r_squared = fit_linear_model(x, columns, squares, true).r_squared;
  if (!std::isfinite(r_squared)) return r_squared;
  const double statistic = static_cast<double>(squares.size()) * std::max(0.0, r_squared);
  return cdf(complement(boost::math::chi_squared(columns - 1), statistic));
}

}  // namespace

FTest compare_nested(double sse_simpler, int df_simpler, double sse_richer, int df_richer) {
  if (df_richer < 0 || df_simpler <= df_richer)
    throw InputError(fmt::format(
        "F-test: {} degrees of freedom of the simpler model, {} of the richer; the simpler has more",
        df_simpler, df_richer));
  FTest test{.df_simpler = df_simpler - df_richer, .df_error = df_richer};
  if (df_richer < 1 || !(sse_richer > kRoundOff * sse_simpler)) return test;
  test.statistic = std::max(0.0, sse_simpler - sse_richer) / test.df_simpler / (sse_richer / df_richer);
  test.p = cdf(complement(boost::math::fisher_f(test.df_simpler, test.df_error), test.statistic));
  return test;
}

double squared_error(const LinearModel& model) noexcept {
  double sum = 0.0;
  for (const double e : model.residuals) sum += e * e;
  return sum;
}

ResidualDiagnostics diagnose_residuals(const LinearModel& model, std::span<const double> x, int columns) {
  const std::size_t n = model.residuals.size(), k = model.coefficients.size();
  if (columns < 1 || k != static_cast<std::size_t>(columns) || x.size() != n * k)
    throw InputError(
        fmt::format("residuals: {} values of x for {} residuals and {} coefficients", x.size(), n, k));
  ResidualDiagnostics d;
  const double sse = squared_error(model);
  double largest = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double h = quadratic_form(model.unscaled_covariance, x.subspan(i * k, k));
    const double e = model.residuals[i];
    d.leverage.push_back(h);
    // The sum of squares without value i is SSE - e^2/(1 - h), in closed form.
    const double without = (sse - e * e / (1.0 - h)) / (model.df - 1);
    const bool known = model.df > 1 && 1.0 - h > 1e-12 && without > 0.0;
    d.studentised.push_back(known ? e / std::sqrt(without * (1.0 - h))
                                  : std::numeric_limits<double>::quiet_NaN());
    if (known && std::abs(d.studentised.back()) > largest) {
      largest = std::abs(d.studentised.back());
      d.outlier = i;
    }
  }
  if (largest > 0.0)
    d.outlier_p = std::min(
        1.0, 2.0 * static_cast<double>(n) * cdf(complement(boost::math::students_t(model.df - 1), largest)));
  if (n > 0) {
    d.anderson_darling = anderson_darling_normality(model.residuals);
    d.shapiro_wilk = shapiro_wilk_normality(model.residuals);
  }
  d.equal_scatter_p = equal_scatter_p(model, x, columns);
  return d;
}

}  // namespace abradem::analysis
