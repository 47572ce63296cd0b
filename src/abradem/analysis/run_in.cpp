// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/analysis/run_in.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "abradem/analysis/regression.h"
#include "abradem/analysis/statistics.h"
#include "abradem/core/error.h"
#include "abradem/core/random.h"

namespace abradem::analysis {

namespace {

void check(std::span<const double> x, std::span<const double> y, const RunInOptions& o) {
  if (x.size() != y.size())
    throw InputError(
        fmt::format("run-in: {} revolutions for {} values; one for each is needed", x.size(), y.size()));
  check_finite(x);
  check_finite(y);
  for (std::size_t i = 1; i < x.size(); ++i)
    if (!(x[i] > x[i - 1]))
      throw InputError(
          fmt::format("run-in: revolution {} follows {}; revolutions must ascend", x[i], x[i - 1]));
  if (!(o.confidence > 0.0 && o.confidence < 1.0))
    throw InputError(fmt::format("run-in: confidence {}; it lies between 0 and 1", o.confidence));
  if (o.resamples < 1 || o.shortest < 3)
    throw InputError(fmt::format("run-in: {} resamples and a steady part of {} values; at least 1 and 3",
                                 o.resamples, o.shortest));
}

/// Least squares of the ramp and level for every K = x_j, j = 1 … n-1, at once. What depends on x alone is
/// kept, so that a resample costs O(n).
class RampAndLevel {
 public:
  explicit RampAndLevel(std::span<const double> x)
      : x_(x.begin(), x.end()), u_mean_(x.size()), u_squares_(x.size()) {
    const auto n = static_cast<double>(x_.size());
    for (std::size_t j = 1; j < x_.size(); ++j) {
      double sum = 0.0, squares = 0.0;  // of u = min(x - K, 0)
      for (std::size_t i = 0; i < j; ++i) {
        const double u = x_[i] - x_[j];
        sum += u;
        squares += u * u;
      }
      u_mean_[j] = sum / n;
      u_squares_[j] = squares - sum * sum / n;
    }
  }

  struct Fit {
    std::size_t j = 1;
    double slope = 0.0;
    double explained = -1.0;  ///< squares that the ramp explains
  };
  /// The K that explains most.   @param y with a mean of 0
  [[nodiscard]] Fit best(std::span<const double> y) const {
    Fit best;
    double sum = 0.0, moment = 0.0;  // of y and of (x - x_0) y before j
    for (std::size_t j = 1; j < x_.size(); ++j) {
      sum += y[j - 1];
      moment += (x_[j - 1] - x_[0]) * y[j - 1];
      const double uy = moment - (x_[j] - x_[0]) * sum;  // sum of (u - mean) y, for y has mean 0
      if (const double explained = uy * uy / u_squares_[j]; explained > best.explained)
        best = {j, uy / u_squares_[j], explained};
    }
    return best;
  }
  [[nodiscard]] double at(const Fit& fit, std::size_t i) const {
    return fit.slope * (std::min(x_[i] - x_[fit.j], 0.0) - u_mean_[fit.j]);
  }

 private:
  std::vector<double> x_, u_mean_, u_squares_;
};

std::size_t draw(core::RandomStream& random, std::size_t count) {
  return std::min(count - 1, static_cast<std::size_t>(random.uniform() * static_cast<double>(count)));
}

/// Share of shuffled series, the one itself counted, that a ramp explains as well: exact for exchangeable
/// noise.
double permutation_p(const RampAndLevel& model, std::vector<double> y, double explained,
                     const RunInOptions& o) {
  core::RandomStream random(o.seed, 0);
  int as_well = 1;
  for (int r = 0; r < o.resamples; ++r) {
    for (std::size_t i = y.size(); i-- > 1;) std::swap(y[i], y[draw(random, i + 1)]);
    if (model.best(y).explained >= explained) ++as_well;
  }
  return static_cast<double>(as_well) / (o.resamples + 1);
}

/// Indices of K between which the bootstrap finds it.
std::pair<std::size_t, std::size_t> bootstrap_interval(const RampAndLevel& model, std::span<const double> y,
                                                       const RampAndLevel::Fit& fit, const RunInOptions& o) {
  const std::size_t n = y.size();
  std::vector<double> residuals(n), again(n);
  // Three numbers were fitted, which has made the residuals too small.
  const double widened = std::sqrt(static_cast<double>(n) / static_cast<double>(n - 3));
  for (std::size_t i = 0; i < n; ++i) residuals[i] = widened * (y[i] - model.at(fit, i));
  core::RandomStream random(o.seed, 1);
  std::vector<std::size_t> found;
  for (int r = 0; r < o.resamples; ++r) {
    for (std::size_t i = 0; i < n; ++i) again[i] = model.at(fit, i) + residuals[draw(random, n)];
    const double mean = std::accumulate(again.begin(), again.end(), 0.0) / static_cast<double>(n);
    for (double& v : again) v -= mean;
    found.push_back(model.best(again).j);
  }
  std::ranges::sort(found);
  const double outside = 0.5 * (1.0 - o.confidence) * static_cast<double>(found.size());
  const auto cut = std::min(static_cast<std::size_t>(outside), (found.size() - 1) / 2);
  return {found[cut], found[found.size() - 1 - cut]};
}

/// Level and drift of the values from index `from` on.
void describe_part(RunIn& r, std::span<const double> x, std::span<const double> y, std::size_t from,
                   double confidence) {
  const auto part_x = x.subspan(from), part_y = y.subspan(from);
  const std::vector<double> ones(part_y.size(), 1.0);
  const LinearModel level = fit_linear_model(ones, 1, part_y, true, confidence);
  r.level = level.coefficients[0];
  r.level_low = level.low[0];
  r.level_high = level.high[0];
  const PolynomialFit line = fit_polynomial(part_x, part_y, {.confidence = confidence});
  r.drift = line.coefficients[1];
  r.drift_low = line.low[1];
  r.drift_high = line.high[1];
}

}  // namespace

RunIn find_run_in(std::span<const double> revolutions, std::span<const double> values,
                  const RunInOptions& options) {
  const std::span<const double> x = revolutions;
  check(x, values, options);
  RunIn r;
  const std::size_t n = x.size(), shortest = static_cast<std::size_t>(options.shortest);
  if (n < shortest + 3) return r;
  const Summary s = summarise(values);
  r.state = RunIn::State::from_start;
  describe_part(r, x, values, 0, options.confidence);
  if (!(s.sd > kRoundOffScatter * std::max(std::abs(s.min), std::abs(s.max)))) {
    r.p = 1.0;  // equal values: every order of them is the same
    return r;
  }
  std::vector<double> y;  // in units of the scatter
  for (const double v : values) y.push_back((v - s.mean) / s.sd);

  const RampAndLevel model(x);
  const RampAndLevel::Fit fit = model.best(y);
  // A shuffle that explains the same to round-off explains as well.
  r.p = permutation_p(model, y, fit.explained * (1.0 - 1e-12), options);
  if (r.p > 1.0 - options.confidence) return r;
  if (s.max - s.min <= options.drift_tolerance * std::abs(r.level)) return r;  // seen, and too small to count

  r.state = RunIn::State::not_steady;
  const auto [low, high] = bootstrap_interval(model, y, fit, options);
  const std::size_t last = n - shortest;      // where a steady part can begin at the latest
  if (high > last || fit.j > last) return r;  // a ramp to the end cannot be excluded
  for (std::size_t j = fit.j; j <= last; ++j) {
    describe_part(r, x, values, j, options.confidence);
    const double length = x[n - 1] - x[j], change = options.drift_tolerance * std::abs(r.level);
    const bool no_drift = r.drift_low <= 0.0 && r.drift_high >= 0.0;
    const bool small = std::abs(r.drift) * length <= change;
    const bool shown_small = std::max(std::abs(r.drift_low), std::abs(r.drift_high)) * length <= change;
    if (j == fit.j ? no_drift || small : shown_small) {
      r.state = RunIn::State::found;
      r.revolution = x[j];
      r.low = std::min(x[low], x[j]);
      r.high = std::max(x[high], x[j]);
      return r;
    }
  }
  describe_part(r, x, values, fit.j, options.confidence);
  return r;
}

NormalFrom normal_from(std::span<const double> revolutions, std::span<const double> depth_p,
                       std::span<const double> width_p, double level) {
  if (revolutions.size() != depth_p.size() || revolutions.size() != width_p.size())
    throw InputError(fmt::format("run-in: {} revolutions for {} p of depth and {} of width; one for each",
                                 revolutions.size(), depth_p.size(), width_p.size()));
  NormalFrom out;
  for (std::size_t k = revolutions.size(); k-- > 0;) {
    if (!(depth_p[k] > level && width_p[k] > level)) break;
    out.revolution = revolutions[k];
    ++out.lasting;
  }
  return out;
}

NormalFromByBins normal_from_by_bins(std::span<const double> revolutions,
                                     std::span<const std::vector<double>> depths,
                                     std::span<const std::vector<double>> widths, Binning binning, int fewest,
                                     int most, double level) {
  if (fewest > most)
    throw InputError(fmt::format("run-in: from {} to {} bins; give the smaller number first", fewest, most));
  NormalFromByBins out;
  int found = 0;
  for (int bins = fewest; bins <= most; ++bins) {
    const auto p_of = [&](std::span<const std::vector<double>> samples) {
      std::vector<double> p;
      for (const std::vector<double>& values : samples)
        p.push_back(chi_squared_normality(values, bins, binning).p);
      return p;
    };
    out.bins.push_back(bins);
    out.found.push_back(normal_from(revolutions, p_of(depths), p_of(widths), level));
    found += out.found.back().revolution ? 1 : 0;
  }
  out.share_found = static_cast<double>(found) / static_cast<double>(out.bins.size());
  return out;
}

}  // namespace abradem::analysis
