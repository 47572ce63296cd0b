// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/study/design.h"

#include <fmt/core.h>

#include <algorithm>
#include <boost/random/sobol.hpp>
#include <cmath>
#include <numeric>
#include <utility>

#include "abradem/core/error.h"
#include "abradem/core/random.h"

namespace abradem::study {
namespace {

void check_range(const std::string& key, const Range& range) {
  const auto refuse = [&](const char* why) {
    throw InputError(fmt::format("{}: the range {:g}..{:g}{}{} {}", key, range.low, range.high,
                                 range.unit.empty() ? "" : " ", range.unit, why));
  };
  if (!std::isfinite(range.low) || !std::isfinite(range.high)) refuse("is not finite");
  if (!(range.low < range.high)) refuse("is empty: give the lower end first");
  if (range.logarithmic && range.low <= 0.0) refuse("cannot be logarithmic: its lower end must be > 0");
}

void check_factors(std::span<const Factor> factors) {
  if (factors.empty()) throw InputError("nothing varies: name at least one key and its values");
  for (std::size_t i = 0; i < factors.size(); ++i) {
    const Factor& factor = factors[i];
    for (std::size_t j = 0; j < i; ++j)
      if (factors[j].key == factor.key)
        throw InputError(fmt::format("'{}' is varied twice; give all its values at once", factor.key));
    if (factor.range)
      check_range(factor.key, *factor.range);
    else if (factor.values.empty())
      throw InputError(fmt::format("'{}' has no values to take", factor.key));
  }
}

void check_listed(std::span<const Factor> factors) {
  check_factors(factors);
  for (const Factor& factor : factors)
    if (factor.range)
      throw InputError(
          fmt::format("'{}' is given a range, of which a grid or list cannot know how many values to take; "
                      "give their number or list them",
                      factor.key));
}

void check_count(std::size_t count) {
  if (count == 0 || count > kMostPoints)
    throw InputError(fmt::format("a design of {} runs; there can be 1 to {}", count, kMostPoints));
}

void check_count(int count) { check_count(static_cast<std::size_t>(std::max(0, count))); }

/// The value that far along the range; x in [0, 1].
std::string value_in(const Range& range, double x) {
  double value = range.logarithmic ? range.low * std::pow(range.high / range.low, x)
                                   : range.low + (range.high - range.low) * x;
  // The rounding of the last step must not leave the range.
  value = std::clamp(value, range.low, range.high);
  const std::string number =
      range.whole ? fmt::format("{:.0f}", std::round(value)) : fmt::format("{:.6g}", value);
  return range.unit.empty() ? number : fmt::format("{} {}", number, range.unit);
}

class PointMaker {
 public:
  explicit PointMaker(std::span<const Factor> factors) : factors_(factors) {}

  void add(std::vector<std::string> values) {
    Point point;
    point.name = fmt::format("{:04}", points_.size() + 1);
    for (std::size_t f = 0; f < factors_.size(); ++f)
      point.overrides.push_back(fmt::format("{}={}", factors_[f].key, values[f]));
    point.values = std::move(values);
    points_.push_back(std::move(point));
  }
  [[nodiscard]] std::vector<Point> take() { return std::move(points_); }

 private:
  std::span<const Factor> factors_;
  std::vector<Point> points_;
};

/// Points of the unit cube, factors together, as runs.
std::vector<Point> from_cube(std::span<const Factor> factors, const std::vector<std::vector<double>>& cube) {
  PointMaker maker(factors);
  for (const std::vector<double>& u : cube) {
    std::vector<std::string> values;
    for (std::size_t f = 0; f < factors.size(); ++f) values.push_back(value_at(factors[f], u[f]));
    maker.add(std::move(values));
  }
  return maker.take();
}

}  // namespace

std::string value_at(const Factor& factor, double u) {
  if (factor.range) return value_in(*factor.range, u);
  const auto n = factor.values.size();
  return factor.values[std::min(n - 1, static_cast<std::size_t>(u * static_cast<double>(n)))];
}

std::vector<std::string> spread(const Range& range, int count) {
  check_range("a range of values", range);
  if (count < 2)
    throw InputError(fmt::format("{} values of a range; it takes two at least, its ends", count));
  check_count(count);
  std::vector<std::string> values;
  for (int i = 0; i < count; ++i) values.push_back(value_in(range, i / (count - 1.0)));
  return values;
}

std::vector<Point> grid(std::span<const Factor> factors) {
  check_listed(factors);
  std::size_t count = 1;
  for (const Factor& factor : factors) {
    count *= factor.values.size();
    check_count(count);
  }
  PointMaker maker(factors);
  for (std::size_t k = 0; k < count; ++k) {
    std::vector<std::string> values(factors.size());
    std::size_t rest = k;
    for (std::size_t f = factors.size(); f-- > 0; rest /= factors[f].values.size())
      values[f] = factors[f].values[rest % factors[f].values.size()];
    maker.add(std::move(values));
  }
  return maker.take();
}

std::vector<Point> list(std::span<const Factor> factors) {
  check_listed(factors);
  const std::size_t count = factors.front().values.size();
  check_count(count);
  for (const Factor& factor : factors)
    if (factor.values.size() != count)
      throw InputError(fmt::format("in a list all keys have equally many values; '{}' has {}, '{}' has {}",
                                   factors.front().key, count, factor.key, factor.values.size()));
  PointMaker maker(factors);
  for (std::size_t k = 0; k < count; ++k) {
    std::vector<std::string> values;
    for (const Factor& factor : factors) values.push_back(factor.values[k]);
    maker.add(std::move(values));
  }
  return maker.take();
}

std::vector<Point> latin_hypercube(std::span<const Factor> factors, int count, std::uint64_t seed) {
  check_factors(factors);
  check_count(count);
  const auto n = static_cast<std::size_t>(count);
  std::vector<std::vector<double>> cube(n, std::vector<double>(factors.size()));
  std::vector<std::size_t> part(n);
  for (std::size_t f = 0; f < factors.size(); ++f) {
    core::RandomStream random(seed, f);
    std::iota(part.begin(), part.end(), std::size_t{0});
    for (std::size_t i = n; i-- > 1;)  // Fisher and Yates
      std::swap(part[i], part[static_cast<std::size_t>(random.uniform() * static_cast<double>(i + 1))]);
    for (std::size_t i = 0; i < n; ++i)
      cube[i][f] = (static_cast<double>(part[i]) + random.uniform()) / static_cast<double>(n);
  }
  return from_cube(factors, cube);
}

std::vector<Point> sobol(std::span<const Factor> factors, int count, std::uint64_t skip) {
  check_factors(factors);
  check_count(count);
  constexpr std::size_t kMostFactors = boost::random::default_sobol_table::max_dimension;
  if (factors.size() > kMostFactors)
    throw InputError(fmt::format("Sobol's sequence is known for up to {} factors; these are {}", kMostFactors,
                                 factors.size()));
  std::vector<std::vector<double>> cube(static_cast<std::size_t>(count), std::vector<double>(factors.size()));
  boost::random::sobol sequence(factors.size());
  std::uint64_t number = skip;
  if (skip > 0) sequence.seed(skip - 1);  // the engine leaves out the first point, the origin
  for (std::vector<double>& u : cube) {
    if (number++ == 0) continue;
    for (double& x : u) x = core::unit_interval(sequence());
  }
  return from_cube(factors, cube);
}

}  // namespace abradem::study
