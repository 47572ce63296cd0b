// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/analysis/normality.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <numbers>

#include "abradem/analysis/statistics.h"
#include "abradem/core/error.h"

namespace abradem::analysis {

namespace {

constexpr double kExpected = 5.0;  // values a bin must expect for chi-squared to be its law, as is customary

double standard_normal_cdf(double z) noexcept { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

/// log of the probability that a standard normal variable is below z, also where that probability underflows.
double log_standard_normal_cdf(double z) noexcept {
  if (z > -30.0) return std::log(standard_normal_cdf(z));
  // Asymptotic series of the tail; its next term, 3/z^4, is 4e-6 of a log that is -450 or less.
  return -0.5 * z * z - std::log(-z * std::sqrt(2.0 * std::numbers::pi)) + std::log1p(-1.0 / (z * z));
}

/// Probability that a chi-squared variable with df degrees of freedom exceeds x.
double chi_squared_tail(double x, int df) { return boost::math::gamma_q(0.5 * df, 0.5 * x); }

bool scatters(const Summary& s) noexcept {
  return s.sd > kRoundOffScatter * std::max(std::abs(s.min), std::abs(s.max));
}

std::vector<double> sorted_copy(std::span<const double> values) {
  std::vector<double> sorted(values.begin(), values.end());
  std::ranges::sort(sorted);
  return sorted;
}

template <std::size_t N>
double polynomial(const std::array<double, N>& coefficients, double x) noexcept {
  double value = 0.0;
  for (std::size_t i = N; i-- > 0;) value = value * x + coefficients[i];
  return value;
}

struct Bins {
  std::vector<double> observed, expected;
};

/// What all numbers of bins have in common.
struct Sample {
  std::span<const double> values;
  Summary summary;
  std::vector<double>
      u;  ///< values by the fitted normal's distribution function; for equiprobable bins alone
};

Sample sample(std::span<const double> values, Binning binning) {
  Sample out{values, summarise(values), {}};
  if (binning == Binning::equiprobable && scatters(out.summary))
    for (const double x : values)
      out.u.push_back(standard_normal_cdf((x - out.summary.mean) / out.summary.sd));
  return out;
}

Bins equiprobable_bins(const Sample& sample, int bins) {
  const double expected = static_cast<double>(sample.values.size()) / bins;
  Bins out{std::vector<double>(static_cast<std::size_t>(bins)),
           std::vector<double>(static_cast<std::size_t>(bins), expected)};
  for (const double u : sample.u)
    ++out.observed[static_cast<std::size_t>(std::min(bins - 1, static_cast<int>(u * bins)))];
  return out;
}

/// Joins the outermost bin to its neighbour while it expects too few.
void pool_low_tail(Bins& bins) {
  while (bins.expected.size() > 1 && bins.expected.front() < kExpected) {
    bins.expected[1] += bins.expected[0];
    bins.observed[1] += bins.observed[0];
    bins.expected.erase(bins.expected.begin());
    bins.observed.erase(bins.observed.begin());
  }
}

Bins equal_width_bins(const Sample& sample, int bins) {
  const auto& [values, s, u] = sample;
  const double width = (s.max - s.min) / bins;
  Bins out{std::vector<double>(static_cast<std::size_t>(bins)), {}};
  for (const double x : values)
    ++out.observed[static_cast<std::size_t>(std::clamp(static_cast<int>((x - s.min) / width), 0, bins - 1))];
  double below = 0.0;  // the first and the last bin reach to infinity
  for (int j = 1; j <= bins; ++j) {
    const double up_to = j < bins ? standard_normal_cdf((s.min + j * width - s.mean) / s.sd) : 1.0;
    out.expected.push_back(static_cast<double>(values.size()) * (up_to - below));
    below = up_to;
  }
  for (int end = 0; end < 2; ++end) {
    pool_low_tail(out);
    std::ranges::reverse(out.expected);
    std::ranges::reverse(out.observed);
  }
  return out;
}

ChiSquaredNormality chi_squared_of(const Sample& sample, int bins, Binning binning) {
  ChiSquaredNormality test{.bins = bins};
  if (!scatters(sample.summary)) return test;
  const Bins counted =
      binning == Binning::equiprobable ? equiprobable_bins(sample, bins) : equal_width_bins(sample, bins);
  test.bins = static_cast<int>(counted.observed.size());
  if (test.bins < 4) return test;
  test.statistic = 0.0;
  for (std::size_t j = 0; j < counted.observed.size(); ++j) {
    const double excess = counted.observed[j] - counted.expected[j];
    test.statistic += excess * excess / counted.expected[j];
  }
  test.df = test.bins - 3;
  test.p = chi_squared_tail(test.statistic, test.df);
  test.p_upper = chi_squared_tail(test.statistic, test.df + 2);
  return test;
}

void check_bins(int bins) {
  if (bins < 4)
    throw InputError(
        fmt::format("statistics: chi-squared test with {} bins; mean and sd are fitted, so at least 4 "
                    "are needed",
                    bins));
}

}  // namespace

int normality_bins(std::int64_t n) noexcept {
  const auto rule = static_cast<std::int64_t>(std::lround(2.0 * std::pow(static_cast<double>(n), 0.4)));
  return static_cast<int>(std::min(rule, n / static_cast<std::int64_t>(kExpected)));
}

ChiSquaredNormality chi_squared_normality(std::span<const double> values) {
  const int bins = normality_bins(static_cast<std::int64_t>(values.size()));
  if (bins >= 4) return chi_squared_normality(values, bins);
  check_finite(values);
  return {.bins = bins};
}

ChiSquaredNormality chi_squared_normality(std::span<const double> values, int bins, Binning binning) {
  check_bins(bins);
  return chi_squared_of(sample(values, binning), bins, binning);
}

AndersonDarling anderson_darling_normality(std::span<const double> values) {
  const Summary s = summarise(values);
  if (values.size() < 8 || !scatters(s)) return {};
  const std::vector<double> x = sorted_copy(values);
  const auto n = static_cast<double>(x.size());
  AndersonDarling test;
  double sum = 0.0;  // A^2 = -n - (1/n) sum (2i - 1) (ln F(x_i) + ln(1 - F(x_{n+1-i})))
  for (std::size_t i = 0; i < x.size(); ++i)
    sum += (2.0 * static_cast<double>(i) + 1.0) *
           (log_standard_normal_cdf((x[i] - s.mean) / s.sd) +
            log_standard_normal_cdf((s.mean - x[x.size() - 1 - i]) / s.sd));
  test.statistic = -n - sum / n;
  const double a = test.adjusted = test.statistic * (1.0 + 0.75 / n + 2.25 / (n * n));
  // Beyond 10, outside what the formulas were fitted to, p is held at its value there.
  if (a <= 0.2)
    test.p = 1.0 - std::exp(-13.436 + 101.14 * a - 223.73 * a * a);
  else if (a <= 0.34)
    test.p = 1.0 - std::exp(-8.318 + 42.796 * a - 59.938 * a * a);
  else if (a < 0.6)
    test.p = std::exp(0.9177 - 4.279 * a - 1.38 * a * a);
  else
    test.p = std::exp(1.2937 - 5.709 * std::min(a, 10.0) + 0.0186 * std::min(a, 10.0) * std::min(a, 10.0));
  return test;
}

namespace {

/// Royston's weights a_i of the order statistics, for the upper half (largest first); the lower half has them
/// with the other sign. They approximate m / |m| corrected at the two ends, m the expected order statistics.
std::vector<double> shapiro_wilk_weights(std::size_t n) {
  if (n == 3) return {std::numbers::sqrt2 / 2.0};
  const boost::math::normal normal;
  std::vector<double> m;
  double squares = 0.0;
  for (std::size_t i = 1; i <= n / 2; ++i) {
    m.push_back(-quantile(normal, (static_cast<double>(i) - 0.375) / (static_cast<double>(n) + 0.25)));
    squares += 2.0 * m.back() * m.back();
  }
  const double u = 1.0 / std::sqrt(static_cast<double>(n)), norm = std::sqrt(squares);
  const double first =
      m[0] / norm + polynomial<6>({0.0, 0.221157, -0.147981, -2.07119, 4.434685, -2.706056}, u);
  std::vector<double> a(m.size());
  std::size_t corrected = 1;
  double rest = (squares - 2.0 * m[0] * m[0]) / (1.0 - 2.0 * first * first);
  if (n > 5) {
    const double second =
        m[1] / norm + polynomial<6>({0.0, 0.042981, -0.293762, -1.752461, 5.682633, -3.582633}, u);
    corrected = 2;
    a[1] = second;
    rest = (squares - 2.0 * m[0] * m[0] - 2.0 * m[1] * m[1]) /
           (1.0 - 2.0 * first * first - 2.0 * second * second);
  }
  a[0] = first;
  for (std::size_t i = corrected; i < m.size(); ++i) a[i] = m[i] / std::sqrt(rest);
  return a;
}

/// Probability of a smaller W; 1 - W is given, for it has the digits.
double shapiro_wilk_p(double one_minus_W, std::size_t count) {
  const auto n = static_cast<double>(count);
  if (count == 3) {  // exact
    const double W = std::max(0.75, 1.0 - one_minus_W);
    return 6.0 / std::numbers::pi * (std::asin(std::sqrt(W)) - std::asin(std::sqrt(0.75)));
  }
  double y = std::log(one_minus_W), mean = 0.0, sd = 1.0;
  if (count <= 11) {
    const double gamma = 0.459 * n - 2.273;
    if (y >= gamma) return 0.0;
    y = -std::log(gamma - y);
    mean = polynomial<4>({0.544, -0.39978, 0.025054, -6.714e-4}, n);
    sd = std::exp(polynomial<4>({1.3822, -0.77857, 0.062767, -0.0020322}, n));
  } else {
    const double log_n = std::log(n);
    mean = polynomial<4>({-1.5861, -0.31082, -0.083751, 0.0038915}, log_n);
    sd = std::exp(polynomial<3>({-0.4803, -0.082676, 0.0030302}, log_n));
  }
  return standard_normal_cdf((mean - y) / sd);
}

}  // namespace

ShapiroWilk shapiro_wilk_normality(std::span<const double> values) {
  const Summary s = summarise(values);
  const std::size_t n = values.size();
  if (n < 3 || n > 5000 || !scatters(s)) return {};
  const std::vector<double> x = sorted_copy(values), a = shapiro_wilk_weights(n);
  double weighted = 0.0, squares_of_a = 0.0;  // in units of sd: squares of tiny numbers would underflow
  for (std::size_t i = 0; i < a.size(); ++i) {
    weighted += a[i] * ((x[n - 1 - i] - x[i]) / s.sd);
    squares_of_a += 2.0 * a[i] * a[i];
  }
  // W = (sum a_i x_i)^2 / (sum a_i^2 sum (x_i - mean)^2), from 1 - W as a difference of squares.
  const double norm = std::sqrt(squares_of_a * (static_cast<double>(n) - 1.0));
  const double one_minus_W = std::max((norm - weighted) * (norm + weighted) / (norm * norm), 0.0);
  return {1.0 - one_minus_W, one_minus_W > 0.0 ? shapiro_wilk_p(one_minus_W, n) : 1.0};
}

Normality test_normality(std::span<const double> values) {
  return {.count = static_cast<std::int64_t>(values.size()),
          .equiprobable = chi_squared_normality(values),
          .equal_width = chi_squared_normality(values, kEqualWidthBins, Binning::equal_width),
          .anderson_darling = anderson_darling_normality(values),
          .shapiro_wilk = shapiro_wilk_normality(values)};
}

BinSensitivity bin_sensitivity(std::span<const double> values, Binning binning, double level, int fewest,
                               int most) {
  if (most == 0) most = static_cast<int>(values.size() / static_cast<std::size_t>(kExpected));
  check_bins(fewest);
  BinSensitivity out{.binning = binning};
  const Sample all = sample(values, binning);
  int verdicts = 0, passing = 0;
  for (int bins = fewest; bins <= most; ++bins) {
    const double p = chi_squared_of(all, bins, binning).p;
    out.bins.push_back(bins);
    out.p.push_back(p);
    if (std::isnan(p)) continue;
    ++verdicts;
    passing += p > level ? 1 : 0;
    out.p_min = std::fmin(out.p_min, p);
    out.p_max = std::fmax(out.p_max, p);
  }
  if (verdicts > 0) out.share_passing = static_cast<double>(passing) / verdicts;
  return out;
}

SeedSensitivity seed_sensitivity(std::span<const std::vector<double>> samples, double level) {
  SeedSensitivity out;
  for (const std::vector<double>& values : samples) out.samples.push_back(test_normality(values));
  const auto over_samples = [&](const auto& p_of) {
    std::vector<double> p;
    for (const Normality& n : out.samples)
      if (!std::isnan(p_of(n))) p.push_back(p_of(n));
    if (p.empty()) return SeedSensitivity::Test{};
    const auto passing = std::ranges::count_if(p, [level](double one) { return one > level; });
    const Summary s = summarise(p);
    return SeedSensitivity::Test{static_cast<double>(passing) / static_cast<double>(p.size()), s.min,
                                 s.median, s.max};
  };
  out.equiprobable = over_samples([](const Normality& n) { return n.equiprobable.p; });
  out.equal_width = over_samples([](const Normality& n) { return n.equal_width.p; });
  out.anderson_darling = over_samples([](const Normality& n) { return n.anderson_darling.p; });
  out.shapiro_wilk = over_samples([](const Normality& n) { return n.shapiro_wilk.p; });
  return out;
}

}  // namespace abradem::analysis
