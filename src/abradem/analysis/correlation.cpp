// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/analysis/correlation.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "abradem/analysis/statistics.h"
#include "abradem/core/error.h"

namespace abradem::analysis {

std::vector<double> autocorrelation(std::span<const double> values, Ends ends) {
  const Summary s = summarise(values);
  if (!(s.sd > kRoundOffScatter * std::max(std::abs(s.min), std::abs(s.max)))) return {};
  const std::size_t n = values.size();
  std::vector<double> z;  // in units of sd: squares of tiny numbers would underflow
  for (const double x : values) z.push_back((x - s.mean) / s.sd);
  const std::size_t lags = ends == Ends::joined ? n / 2 + 1 : n;
  std::vector<double> r(lags);
  for (std::size_t k = 0; k < lags; ++k) {
    const std::size_t pairs = ends == Ends::joined ? n : n - k;
    for (std::size_t i = 0; i < pairs; ++i) r[k] += z[i] * z[i + k < n ? i + k : i + k - n];
  }
  const double squares = r[0];
  for (double& r_k : r) r_k /= squares;
  return r;
}

Correlation correlation(std::span<const double> values, Ends ends) {
  Correlation c{.r = autocorrelation(values, ends)};
  if (c.r.empty()) return c;
  const auto n = static_cast<double>(values.size());
  c.noise_band = 1.96 / std::sqrt(n);

  for (std::size_t k = 1; k < c.r.size() && std::isnan(c.length); ++k)
    if (c.r[k] <= 1.0 / std::numbers::e)
      c.length = static_cast<double>(k - 1) + (c.r[k - 1] - 1.0 / std::numbers::e) / (c.r[k - 1] - c.r[k]);

  c.time = 1.0;
  for (std::size_t k = 1; k < c.r.size() && c.r[k] > 0.0; ++k) {
    const bool opposite =
        ends == Ends::joined && 2 * k == values.size();  // the one lag without a mirror image
    c.time += (opposite ? 1.0 : 2.0) * c.r[k];
  }
  c.effective_count = n / c.time;

  double squares = 1.0;  // 1 + 2 sum r_j^2 below k
  for (std::size_t k = 1; k < c.r.size() && c.independent_step == 0; ++k) {
    if (std::abs(c.r[k]) <= c.noise_band * std::sqrt(squares)) c.independent_step = static_cast<int>(k);
    squares += 2.0 * c.r[k] * c.r[k];
  }
  return c;
}

double along_track(double sections, std::int64_t count, double track_radius) noexcept {
  return sections * 2.0 * std::numbers::pi * track_radius / static_cast<double>(count);
}

std::vector<std::size_t> thinned(std::size_t n, int step) {
  if (step < 1)
    throw InputError(fmt::format("statistics: thinning to every value {}; at least 1 is needed", step));
  const std::size_t kept = n / static_cast<std::size_t>(step);
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < kept; ++i) indices.push_back(i * n / kept);
  return indices;
}

ThinnedNormality test_thinned_normality(std::span<const double> values, Ends ends) {
  ThinnedNormality out{correlation(values, ends), test_normality(values), {}};
  if (out.correlation.independent_step < 1) return out;
  std::vector<double> kept;
  for (const std::size_t i : thinned(values.size(), out.correlation.independent_step))
    kept.push_back(values[i]);
  out.independent = test_normality(kept);
  return out;
}

}  // namespace abradem::analysis
