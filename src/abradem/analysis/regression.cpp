// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/analysis/regression.h"

#include <fmt/core.h>

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "abradem/analysis/normality.h"
#include "abradem/core/error.h"

namespace abradem::analysis {

namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

void check_numbers(std::span<const double> values, const char* what) {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i]))
      throw InputError(fmt::format("fit: {} {} of {} is {}; only finite values can be fitted", what, i,
                                   values.size(), values[i]));
}

/// x^T (X^T X)^-1 x: the variance of the model there, in units of residual_sd^2.
double leverage(const LinearModel& m, std::span<const double> row) {
  const auto size = static_cast<Eigen::Index>(m.coefficients.size());
  if (row.size() != m.coefficients.size())
    throw InputError(fmt::format("fit: a row of {} values for {} columns", row.size(), size));
  const Eigen::Map<const Eigen::VectorXd> x(row.data(), size);
  return x.dot(Eigen::Map<const Matrix>(m.unscaled_covariance.data(), size, size) * x);
}

/// @param of_one_more variance of what is estimated about the model, in units of residual_sd^2
Estimate estimate(const LinearModel& m, std::span<const double> row, double of_one_more) {
  const double reach = m.t * m.residual_sd * std::sqrt(of_one_more + leverage(m, row));
  double value = 0.0;
  for (std::size_t j = 0; j < row.size(); ++j) value += m.coefficients[j] * row[j];
  return {value, value - reach, value + reach};
}

double two_sided_p(double coefficient, double error, int df) {
  if (df < 1 || !(error > 0.0)) return kNan;  // an exact fit: there is no noise to compare with
  const boost::math::students_t student(df);
  return 2.0 * cdf(complement(student, std::abs(coefficient / error)));
}

}  // namespace

Estimate LinearModel::mean_at(std::span<const double> row) const { return estimate(*this, row, 0.0); }
Estimate LinearModel::prediction_at(std::span<const double> row) const { return estimate(*this, row, 1.0); }

LinearModel fit_linear_model(std::span<const double> x, int columns, std::span<const double> y,
                             bool with_constant, double confidence) {
  check_numbers(x, "x");
  check_numbers(y, "y");
  if (columns < 1 || x.size() != y.size() * static_cast<std::size_t>(columns))
    throw InputError(fmt::format("fit: {} numbers in {} columns for {} values; {} are needed", x.size(),
                                 columns, y.size(),
                                 y.size() * static_cast<std::size_t>(std::max(columns, 0))));
  if (y.size() < static_cast<std::size_t>(columns))
    throw InputError(
        fmt::format("fit: {} values for {} coefficients; at least as many are needed", y.size(), columns));
  if (!(confidence > 0.0 && confidence < 1.0))
    throw InputError(fmt::format("fit: confidence {}; it lies between 0 and 1, such as 0.95", confidence));

  const auto n = static_cast<Eigen::Index>(y.size()), k = static_cast<Eigen::Index>(columns);
  const Eigen::Map<const Matrix> X(x.data(), n, k);
  const Eigen::Map<const Eigen::VectorXd> Y(y.data(), n);
  // Columns of equal length: powers of x differ by orders of magnitude, and the rank is judged by size.
  Eigen::VectorXd lengths = X.colwise().norm();
  for (Eigen::Index j = 0; j < k; ++j)
    if (lengths[j] == 0.0) lengths[j] = 1.0;
  const Eigen::MatrixXd scaled = X * lengths.cwiseInverse().asDiagonal();
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(scaled);
  if (qr.rank() < k)
    throw InputError(
        fmt::format("fit: only {} of {} columns are independent of each other; take values at more different "
                    "places, or fit fewer coefficients",
                    qr.rank(), columns));
  const Eigen::VectorXd b = lengths.cwiseInverse().asDiagonal() * qr.solve(Y);
  const Eigen::VectorXd residuals = Y - X * b;

  LinearModel m;
  m.confidence = confidence;
  m.df = static_cast<int>(n - k);
  m.coefficients.assign(b.begin(), b.end());
  m.residuals.assign(residuals.begin(), residuals.end());
  // (X^T X)^-1 = L^-1 P R^-1 R^-T P^T L^-1 with L the lengths and P the pivots.
  const Eigen::MatrixXd R_inverse =
      qr.matrixR().topLeftCorner(k, k).triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(k, k));
  const Eigen::MatrixXd root = lengths.cwiseInverse().asDiagonal() * (qr.colsPermutation() * R_inverse);
  const Matrix covariance = root * root.transpose();
  m.unscaled_covariance.assign(covariance.data(), covariance.data() + covariance.size());

  const double squares = residuals.squaredNorm();
  const double total = with_constant ? (Y.array() - Y.mean()).matrix().squaredNorm() : Y.squaredNorm();
  // Values equal to round-off have no variation that could be explained.
  if (std::sqrt(total) > kRoundOffScatter * Y.norm()) m.r_squared = 1.0 - squares / total;
  if (m.df > 0) {
    m.residual_sd = std::sqrt(squares / m.df);
    m.t = quantile(boost::math::students_t(m.df), 0.5 + 0.5 * confidence);
  }
  for (Eigen::Index j = 0; j < k; ++j) {
    const double error = m.residual_sd * std::sqrt(covariance(j, j));
    m.errors.push_back(error);
    m.low.push_back(b[j] - m.t * error);
    m.high.push_back(b[j] + m.t * error);
    m.p.push_back(two_sided_p(b[j], error, m.df));
  }
  return m;
}

namespace {

/// The powers of the model at x.
std::vector<double> powers(const PolynomialFit& fit, double x) {
  std::vector<double> row;
  const double u = (x - fit.centre) / fit.scale;
  double power = 1.0;
  for (int j = 0; j <= fit.options.degree; ++j, power *= u)
    if (j > 0 || !fit.options.through_origin) row.push_back(power);
  return row;
}

/// Matrix that turns coefficients of ((x - centre)/scale)^j into those of x^i, both by ascending power.
Eigen::MatrixXd to_plain_powers(int degree, double centre, double scale) {
  Eigen::MatrixXd T = Eigen::MatrixXd::Zero(degree + 1, degree + 1);
  T(0, 0) = 1.0;
  for (int j = 1; j <= degree; ++j)  // multiply by (x - centre)/scale
    for (int i = 0; i <= j; ++i) {
      const double from_lower = i > 0 ? T(i - 1, j - 1) : 0.0;
      T(i, j) = (from_lower - centre * T(i, j - 1)) / scale;
    }
  return T;
}

}  // namespace

double PolynomialFit::operator()(double x) const noexcept {
  double value = 0.0;
  const double u = (x - centre) / scale;
  for (std::size_t j = model.coefficients.size(); j-- > 0;) value = value * u + model.coefficients[j];
  return options.through_origin ? value * u : value;
}
Estimate PolynomialFit::mean_at(double x) const { return model.mean_at(powers(*this, x)); }
Estimate PolynomialFit::prediction_at(double x) const { return model.prediction_at(powers(*this, x)); }

PolynomialFit fit_polynomial(std::span<const double> x, std::span<const double> y,
                             const FitOptions& options) {
  if (options.degree < 1 || options.degree > 6)
    throw InputError(fmt::format("fit: degree {}; 1 to 6 can be fitted", options.degree));
  if (x.size() != y.size() || x.empty())
    throw InputError(fmt::format("fit: {} places for {} values; one for each is needed", x.size(), y.size()));
  check_numbers(x, "x");
  PolynomialFit fit{.options = options};
  // Centred on the data the powers are nearly independent; a curve through the origin has its centre there.
  const auto [low, high] = std::ranges::minmax(x);
  if (!options.through_origin) fit.centre = 0.5 * (low + high);
  fit.scale = std::max(std::abs(low - fit.centre), std::abs(high - fit.centre));
  if (fit.scale == 0.0) fit.scale = 1.0;
  std::vector<double> rows;
  for (const double x_i : x) {
    const std::vector<double> row = powers(fit, x_i);
    rows.insert(rows.end(), row.begin(), row.end());
  }
  const int fixed = options.through_origin ? 1 : 0, fitted = options.degree + 1 - fixed;
  fit.model = fit_linear_model(rows, fitted, y, !options.through_origin, options.confidence);
  fit.residual_sd = fit.model.residual_sd;
  fit.r_squared = fit.model.r_squared;
  fit.df = fit.model.df;

  const Eigen::MatrixXd T =
      to_plain_powers(options.degree, fit.centre, fit.scale).bottomRightCorner(fitted, fitted);
  const Eigen::VectorXd b = T * Eigen::Map<const Eigen::VectorXd>(fit.model.coefficients.data(), fitted);
  const Eigen::MatrixXd covariance =
      T * Eigen::Map<const Matrix>(fit.model.unscaled_covariance.data(), fitted, fitted) * T.transpose();
  if (options.through_origin) {
    for (std::vector<double>* of : {&fit.coefficients, &fit.errors, &fit.low, &fit.high}) of->push_back(0.0);
    fit.p.push_back(kNan);
  }
  for (int j = 0; j < fitted; ++j) {
    const double error = fit.residual_sd * std::sqrt(covariance(j, j));
    fit.coefficients.push_back(b[j]);
    fit.errors.push_back(error);
    fit.low.push_back(b[j] - fit.model.t * error);
    fit.high.push_back(b[j] + fit.model.t * error);
    fit.p.push_back(two_sided_p(b[j], error, fit.df));
  }
  return fit;
}

double IncrementFit::operator()(double n) const noexcept {
  double value = start_value + coefficients[0] * (n - start);
  if (degree == 2) value += coefficients[1] * (n - start) * (n + start);
  return value;
}
double IncrementFit::rate(double n) const noexcept {
  return coefficients[0] + (degree == 2 ? 2.0 * coefficients[1] * n : 0.0);
}

namespace {
Estimate grown(const IncrementFit& fit, double n, double of_one_more) {
  std::vector<double> row{n - fit.start};
  if (fit.degree == 2) row.push_back((n - fit.start) * (n + fit.start));
  const Estimate e = estimate(fit.model, row, of_one_more);
  return {fit.start_value + e.value, fit.start_value + e.low, fit.start_value + e.high};
}
}  // namespace

Estimate IncrementFit::mean_at(double n) const { return grown(*this, n, 0.0); }
Estimate IncrementFit::prediction_at(double n) const { return grown(*this, n, std::abs(n - start)); }

IncrementFit fit_increments(std::span<const double> n, std::span<const double> sums, int degree,
                            double confidence, double start, double start_value) {
  if (degree != 1 && degree != 2)
    throw InputError(
        fmt::format("fit: increments of degree {}; 1 (constant rate) or 2 (linear rate)", degree));
  if (n.size() != sums.size())
    throw InputError(
        fmt::format("fit: {} places for {} values; one for each is needed", n.size(), sums.size()));
  check_numbers(n, "n");
  check_numbers(sums, "sum");
  IncrementFit fit{.degree = degree, .start = start, .start_value = start_value};
  // Divided by sqrt(dn) the increments have equal scatter. Constant rate: sqrt(dn), which takes the place of
  // the constant in R^2.
  std::vector<double> rows, y;
  double last_n = start, last_sum = start_value;
  for (std::size_t i = 0; i < n.size(); ++i) {
    const double dn = n[i] - last_n;
    if (!(dn > 0.0))
      throw InputError(fmt::format("fit: place {} is {} after {}; places must ascend", i, n[i], last_n));
    rows.push_back(std::sqrt(dn));
    if (degree == 2) rows.push_back(std::sqrt(dn) * (n[i] + last_n));
    y.push_back((sums[i] - last_sum) / std::sqrt(dn));
    last_n = n[i];
    last_sum = sums[i];
  }
  fit.model = fit_linear_model(rows, degree, y, false, confidence);
  const LinearModel& m = fit.model;
  fit.coefficients = m.coefficients;
  fit.errors = m.errors;
  fit.low = m.low;
  fit.high = m.high;
  fit.p = m.p;
  fit.residual_sd = m.residual_sd;
  fit.df = m.df;
  if (!n.empty()) {
    const double mean_rate = (last_sum - start_value) / (last_n - start);
    double total = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < y.size(); ++i) {
      const double from_mean = y[i] - mean_rate * rows[i * static_cast<std::size_t>(degree)];
      total += from_mean * from_mean;
      squares += m.residuals[i] * m.residuals[i];
    }
    if (std::sqrt(total) >
        kRoundOffScatter * Eigen::Map<const Eigen::VectorXd>(y.data(), std::ssize(y)).norm())
      fit.r_squared = 1.0 - squares / total;
  }
  fit.model.r_squared = fit.r_squared;
  return fit;
}

}  // namespace abradem::analysis
