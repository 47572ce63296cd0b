// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/study/wear_law.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "abradem/core/error.h"

namespace abradem::study {

namespace {

using analysis::Estimate;
using analysis::LinearModel;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Relative: forces (distances) that differ by less are the same, set values being written with a few digits.
constexpr double kSameSetting = 1e-9;
/// 1 - r^2 of ln F and ln s below which one is a function of the other for all that the tests can tell: the
/// exponents' errors are then more than a thousand times those of a crossed design.
constexpr double kCollinear = 1e-6;

void check(const WearTests& tests, double confidence) {
  const auto fail = [&](const std::string& what) {
    throw InputError(tests.material.empty() ? what : fmt::format("material '{}': {}", tests.material, what));
  };
  if (tests.volume.size() != tests.force.size() || tests.volume.size() != tests.distance.size())
    fail(fmt::format("{} volumes, {} forces and {} distances", tests.volume.size(), tests.force.size(),
                     tests.distance.size()));
  if (!(confidence > 0.0 && confidence < 1.0))
    fail(fmt::format("confidence {}; expected a number between 0 and 1", confidence));
  if (tests.volume.size() < 3)
    fail(fmt::format("{} tests; a law and its scatter need 3 or more", tests.volume.size()));
  for (const auto& [name, values] : {std::pair{"volume", &tests.volume}, std::pair{"force", &tests.force},
                                     std::pair{"distance", &tests.distance}})
    for (const double x : *values)
      if (!(x > 0.0 && std::isfinite(x)))
        fail(fmt::format("a {} of {}; a power law needs positive values", name, x));
}

std::vector<double> logarithms(std::span<const double> values) {
  std::vector<double> out;
  for (const double x : values) out.push_back(std::log(x));
  return out;
}

double mean(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Sums of squares and products about the means.
struct Spread {
  double ff = 0.0, ss = 0.0, fs = 0.0;
};
Spread spread(std::span<const double> f, std::span<const double> s) {
  const double f0 = mean(f), s0 = mean(s);
  Spread out;
  for (std::size_t i = 0; i < f.size(); ++i) {
    out.ff += (f[i] - f0) * (f[i] - f0);
    out.ss += (s[i] - s0) * (s[i] - s0);
    out.fs += (f[i] - f0) * (s[i] - s0);
  }
  return out;
}

bool varies(std::span<const double> logs) {
  const auto [low, high] = std::ranges::minmax(logs);
  return high - low > kSameSetting;
}

Identifiable identifiable(std::span<const double> f, std::span<const double> s) {
  const bool force = varies(f), distance = varies(s);
  if (!force || !distance)
    return force ? Identifiable::force : distance ? Identifiable::distance : Identifiable::neither;
  const Spread x = spread(f, s);
  return 1.0 - x.fs * x.fs / (x.ff * x.ss) < kCollinear ? Identifiable::combined : Identifiable::both;
}

int columns_of(Identifiable what) {
  return what == Identifiable::both ? 3 : what == Identifiable::neither ? 1 : 2;
}

/// The row of the model at ln(F/F_0), ln(s/s_0).
std::vector<double> row(Identifiable what, double f, double s) {
  switch (what) {
    case Identifiable::both:
      return {1.0, f, s};
    case Identifiable::force:
    case Identifiable::combined:
      return {1.0, f};
    case Identifiable::distance:
      return {1.0, s};
    case Identifiable::neither:
      break;
  }
  return {1.0};
}

/// The tests in logarithms, about the means of all of them.
struct Logs {
  std::vector<double> v, f, s;
  [[nodiscard]] std::vector<double> rows(Identifiable what) const {
    std::vector<double> x;
    for (std::size_t i = 0; i < v.size(); ++i)
      for (const double value : row(what, f[i], s[i])) x.push_back(value);
    return x;
  }
  [[nodiscard]] Logs without(std::span<const std::size_t> left_out) const {
    Logs out;
    for (std::size_t i = 0; i < v.size(); ++i) {
      if (std::ranges::find(left_out, i) != left_out.end()) continue;
      out.v.push_back(v[i]);
      out.f.push_back(f[i]);
      out.s.push_back(s[i]);
    }
    return out;
  }
};

LinearModel fit(const Logs& logs, Identifiable what, double confidence) {
  return analysis::fit_linear_model(logs.rows(what), columns_of(what), logs.v, true, confidence);
}

/// Tests of the same force and distance, in the order of their first.
std::vector<std::vector<std::size_t>> levels(const Logs& logs) {
  std::vector<std::vector<std::size_t>> out;
  for (std::size_t i = 0; i < logs.v.size(); ++i) {
    const auto same = std::ranges::find_if(out, [&](const auto& level) {
      return std::abs(logs.f[level.front()] - logs.f[i]) <= kSameSetting &&
             std::abs(logs.s[level.front()] - logs.s[i]) <= kSameSetting;
    });
    if (same == out.end())
      out.push_back({i});
    else
      same->push_back(i);
  }
  return out;
}

/// @param predict ln V of a left-out test by the tests that remain; NaN where they do not suffice
template <class Predict>
CrossValidation cross_validate(const Logs& logs, const std::vector<std::vector<std::size_t>>& folds,
                               const Predict& predict) {
  CrossValidation out{.folds = static_cast<int>(folds.size()),
                      .predicted = std::vector<double>(logs.v.size(), kNan)};
  double relative = 0.0, squares = 0.0;
  for (const std::vector<std::size_t>& fold : folds) {
    const Logs rest = logs.without(fold);
    for (const std::size_t i : fold) {
      const double ln_volume = predict(rest, i), error = ln_volume - logs.v[i];
      out.predicted[i] = std::exp(ln_volume);
      relative += std::expm1(error) * std::expm1(error);
      squares += error * error;
    }
  }
  const auto n = static_cast<double>(logs.v.size());
  out.relative_error = std::sqrt(relative / n);
  out.log_error = std::sqrt(squares / n);
  return out;
}

CrossValidation validate_power(const Logs& logs, Identifiable what,
                               const std::vector<std::vector<std::size_t>>& folds) {
  return cross_validate(logs, folds, [&](const Logs& rest, std::size_t i) {
    // What remains must still tell the same exponents.
    if (rest.v.size() < static_cast<std::size_t>(columns_of(what)) || rest.v.empty() ||
        (what != Identifiable::neither && identifiable(rest.f, rest.s) != what))
      return kNan;
    return fit(rest, what, 0.95).mean_at(row(what, logs.f[i], logs.s[i])).value;
  });
}

CrossValidation validate_archard(const Logs& logs, const std::vector<std::vector<std::size_t>>& folds) {
  return cross_validate(logs, folds, [&](const Logs& rest, std::size_t i) {
    if (rest.v.empty()) return kNan;
    double sum = 0.0;
    for (std::size_t k = 0; k < rest.v.size(); ++k) sum += rest.v[k] - rest.f[k] - rest.s[k];
    return sum / static_cast<double>(rest.v.size()) + logs.f[i] + logs.s[i];
  });
}

/// An interval of ln x as one of x.
Estimate exponential(const Estimate& e) { return {std::exp(e.value), std::exp(e.low), std::exp(e.high)}; }

Estimate coefficient(const LinearModel& m, std::size_t j) { return {m.coefficients[j], m.low[j], m.high[j]}; }

void take_exponents(WearLawFit& r, const Logs& logs) {
  const double ln_force = std::log(r.force), ln_distance = std::log(r.distance);
  switch (r.identifiable) {
    case Identifiable::both:
      r.p = coefficient(r.model, 1);
      r.q = coefficient(r.model, 2);
      r.k = exponential(r.model.mean_at(row(r.identifiable, -ln_force, -ln_distance)));
      break;
    case Identifiable::force:
      r.p = coefficient(r.model, 1);
      r.k = exponential(r.model.mean_at(row(r.identifiable, -ln_force, 0.0)));
      break;
    case Identifiable::distance:
      r.q = coefficient(r.model, 1);
      r.k = exponential(r.model.mean_at(row(r.identifiable, 0.0, -ln_distance)));
      break;
    case Identifiable::combined: {
      const Spread x = spread(logs.f, logs.s);
      r.slope = x.fs / x.ff;
      r.combined = coefficient(r.model, 1);
      break;
    }
    case Identifiable::neither:
      break;
  }
}

/// Archard's alpha, and the F-test of its exponents against those of the fit.
void compare_with_archard(WearLawFit& r, const Logs& logs) {
  std::vector<double> ln_alpha, ones(logs.v.size(), 1.0);
  for (std::size_t i = 0; i < logs.v.size(); ++i) ln_alpha.push_back(logs.v[i] - logs.f[i] - logs.s[i]);
  const LinearModel simple = analysis::fit_linear_model(ones, 1, ln_alpha, true, r.confidence);
  const double unit = r.force * r.distance;
  r.archard = exponential(coefficient(simple, 0));
  for (double* x : {&r.archard.value, &r.archard.low, &r.archard.high}) *x /= unit;
  r.archard_residual_sd = simple.residual_sd;
  for (std::size_t i = 0; i < logs.v.size(); ++i)
    r.archard_fitted.push_back(r.archard.value * r.tests.force[i] * r.tests.distance[i]);
  if (r.identifiable != Identifiable::neither)
    r.against_archard = analysis::compare_nested(analysis::squared_error(simple), simple.df,
                                                 analysis::squared_error(r.model), r.df);
}

/// Is the power law itself enough: against the scatter of repeats, and against a bend.
void test_power_law(WearLawFit& r, const Logs& logs, const std::vector<std::vector<std::size_t>>& groups) {
  const double sse = analysis::squared_error(r.model);
  double pure = 0.0;
  for (const std::vector<std::size_t>& group : groups) {
    double middle = 0.0;
    for (const std::size_t i : group) middle += logs.v[i] / static_cast<double>(group.size());
    for (const std::size_t i : group) pure += (logs.v[i] - middle) * (logs.v[i] - middle);
  }
  const int pure_df = static_cast<int>(logs.v.size() - groups.size());
  if (pure_df > 0 && pure_df < r.df) r.lack_of_fit = analysis::compare_nested(sse, r.df, pure, pure_df);

  if (r.identifiable == Identifiable::neither) return;
  const int columns = columns_of(r.identifiable);
  std::vector<double> x;
  for (std::size_t i = 0; i < logs.v.size(); ++i) {
    const std::vector<double> linear = row(r.identifiable, logs.f[i], logs.s[i]);
    x.insert(x.end(), linear.begin(), linear.end());
    for (std::size_t j = 1; j < linear.size(); ++j) x.push_back(linear[j] * linear[j]);
  }
  // Two levels of a factor have no bend: the squares then depend on the other columns.
  try {
    const LinearModel bent = analysis::fit_linear_model(x, 2 * columns - 1, logs.v, true);
    r.curvature = analysis::compare_nested(sse, r.df, analysis::squared_error(bent), bent.df);
  } catch (const InputError&) {
    r.curvature.reset();
  }
}

}  // namespace

WearLawFit fit_wear_law(const WearTests& tests, double confidence) {
  check(tests, confidence);
  WearLawFit r;
  r.tests = tests;
  r.confidence = confidence;
  Logs logs{logarithms(tests.volume), logarithms(tests.force), logarithms(tests.distance)};
  const double ln_force = mean(logs.f), ln_distance = mean(logs.s);
  r.force = std::exp(ln_force);
  r.distance = std::exp(ln_distance);
  for (double& f : logs.f) f -= ln_force;
  for (double& s : logs.s) s -= ln_distance;
  r.identifiable = identifiable(logs.f, logs.s);
  if (r.identifiable == Identifiable::both) {
    const Spread x = spread(logs.f, logs.s);
    r.variance_inflation = 1.0 / (1.0 - x.fs * x.fs / (x.ff * x.ss));
  }

  const std::vector<double> x = logs.rows(r.identifiable);
  const int columns = columns_of(r.identifiable);
  r.model = analysis::fit_linear_model(x, columns, logs.v, true, confidence);
  r.df = r.model.df;
  r.residual_sd = r.model.residual_sd;
  r.r_squared = r.model.r_squared;
  r.residuals = analysis::diagnose_residuals(r.model, x, columns);
  r.volume = exponential(r.model.mean_at(row(r.identifiable, 0.0, 0.0)));
  for (std::size_t i = 0; i < logs.v.size(); ++i)
    r.fitted.push_back(std::exp(logs.v[i] - r.model.residuals[i]));
  take_exponents(r, logs);
  compare_with_archard(r, logs);

  const std::vector<std::vector<std::size_t>> groups = levels(logs);
  test_power_law(r, logs, groups);
  std::vector<std::vector<std::size_t>> singles;
  for (std::size_t i = 0; i < logs.v.size(); ++i) singles.push_back({i});
  r.one_out = validate_power(logs, r.identifiable, singles);
  r.one_out_archard = validate_archard(logs, singles);
  r.level_out = validate_power(logs, r.identifiable, groups);
  r.level_out_archard = validate_archard(logs, groups);
  return r;
}

std::optional<analysis::FTest> common_exponents(std::span<const WearLawFit> fits) {
  if (fits.size() < 2) return std::nullopt;
  const Identifiable what = fits.front().identifiable;
  if (what == Identifiable::neither ||
      std::ranges::any_of(fits, [&](const WearLawFit& f) { return f.identifiable != what; }))
    return std::nullopt;
  // One column of ones per material, then the shared columns.
  const std::size_t shared = static_cast<std::size_t>(columns_of(what)) - 1;
  std::vector<double> x, y;
  double sse = 0.0;
  int df = 0;
  for (std::size_t m = 0; m < fits.size(); ++m) {
    const WearTests& t = fits[m].tests;
    for (std::size_t i = 0; i < t.volume.size(); ++i) {
      for (std::size_t c = 0; c < fits.size(); ++c) x.push_back(c == m ? 1.0 : 0.0);
      const std::vector<double> r =
          row(what, std::log(t.force[i] / fits[m].force), std::log(t.distance[i] / fits[m].distance));
      x.insert(x.end(), r.begin() + 1, r.end());
      y.push_back(std::log(t.volume[i]));
    }
    sse += analysis::squared_error(fits[m].model);
    df += fits[m].df;
  }
  const LinearModel common = analysis::fit_linear_model(x, static_cast<int>(fits.size() + shared), y, true);
  return analysis::compare_nested(analysis::squared_error(common), common.df, sse, df);
}

}  // namespace abradem::study
