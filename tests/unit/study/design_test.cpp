// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/study/design.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "abradem/core/error.h"

namespace abradem::study {
namespace {

using Strings = std::vector<std::string>;

Factor listed(const std::string& key, Strings values) {
  return {.key = key, .values = std::move(values), .range = {}};
}
Factor ranged(const std::string& key, Range range) {
  return {.key = key, .values = {}, .range = std::move(range)};
}
Factor unit(const std::string& key) { return ranged(key, {}); }

/// The value of one factor in every point.
std::vector<double> numbers(const std::vector<Point>& points, std::size_t factor) {
  std::vector<double> result;
  for (const Point& p : points) result.push_back(std::stod(p.values[factor]));
  return result;
}

template <typename Design>
std::string complaint(Design design) {
  try {
    (void)design();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no complaint";
}

TEST(Spread, GivesTheEndsAndWhatIsEvenlyBetween) {
  EXPECT_EQ(spread({0.1, 1.0, "mm"}, 10), (Strings{"0.1 mm", "0.2 mm", "0.3 mm", "0.4 mm", "0.5 mm", "0.6 mm",
                                                   "0.7 mm", "0.8 mm", "0.9 mm", "1 mm"}));
  EXPECT_EQ(spread({1e-12, 1e-10, "1/Pa", true}, 3), (Strings{"1e-12 1/Pa", "1e-11 1/Pa", "1e-10 1/Pa"}));
  EXPECT_EQ(spread({1, 4, "", false, true}, 3), (Strings{"1", "3", "4"}));
  EXPECT_EQ(complaint([] {
              return spread({1, 1, "mm"}, 2);
            }),
            "a range of values: the range 1..1 mm is empty: give the lower end first");
  EXPECT_NE(complaint([] { return spread({0, 1, "", true}, 2); }).find("must be > 0"), std::string::npos);
  EXPECT_NE(complaint([] { return spread(Range{}, 1); }).find("its ends"), std::string::npos);
}

TEST(ValueAt, PicksListedValuesInEqualShares) {
  const Factor factor = listed("wall.disc.contact", {"patch", "resolved", "per_triangle"});
  EXPECT_EQ(value_at(factor, 0.0), "patch");
  EXPECT_EQ(value_at(factor, 0.34), "resolved");
  EXPECT_EQ(value_at(factor, std::nextafter(1.0, 0.0)), "per_triangle");
}

TEST(Grid, CrossesAllValuesLastFastest) {
  const std::vector<Factor> factors{listed("a", {"1 mm", "2 mm"}), listed("b.c", {"x", "y", "z"})};
  const std::vector<Point> points = grid(factors);
  ASSERT_EQ(points.size(), 6U);
  EXPECT_EQ(points[0].name, "0001");
  EXPECT_EQ(points[0].overrides, (Strings{"a=1 mm", "b.c=x"}));
  EXPECT_EQ(points[1].values, (Strings{"1 mm", "y"}));
  EXPECT_EQ(points[5].name, "0006");
  EXPECT_EQ(points[5].values, (Strings{"2 mm", "z"}));
}

TEST(List, TakesValuesSideBySide) {
  const std::vector<Factor> factors{listed("a", {"1", "2"}), listed("b", {"x", "y"})};
  const std::vector<Point> points = list(factors);
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[1].overrides, (Strings{"a=2", "b=y"}));
  const std::vector<Factor> uneven{listed("a", {"1", "2"}), listed("b", {"x"})};
  EXPECT_EQ(complaint([&] { return list(uneven); }),
            "in a list all keys have equally many values; 'a' has 2, 'b' has 1");
}

TEST(Designs, RefuseWhatCannotBeMeant) {
  EXPECT_NE(complaint([] { return grid({}); }).find("nothing varies"), std::string::npos);
  const std::vector<Factor> twice{listed("a", {"1"}), listed("a", {"2"})};
  EXPECT_NE(complaint([&] { return grid(twice); }).find("'a' is varied twice"), std::string::npos);
  const std::vector<Factor> empty{listed("a", {})};
  EXPECT_NE(complaint([&] { return sobol(empty, 4); }).find("'a' has no values"), std::string::npos);
  const std::vector<Factor> range{unit("a")};
  EXPECT_NE(complaint([&] { return grid(range); }).find("'a' is given a range"), std::string::npos);
  EXPECT_NE(complaint([&] { return latin_hypercube(range, 0, 1); }).find("a design of 0 runs"),
            std::string::npos);
  EXPECT_NE(complaint([&] { return sobol(range, -1); }).find("a design of 0 runs"), std::string::npos);
  const std::vector<Factor> huge(4, listed("a", Strings(100, "1")));
  std::vector<Factor> named = huge;
  for (std::size_t i = 0; i < named.size(); ++i) named[i].key += std::to_string(i);
  EXPECT_NE(complaint([&] { return grid(named); }).find("there can be 1 to 100000"), std::string::npos);
}

TEST(LatinHypercube, HitsEveryPartOfEveryFactorOnce) {
  constexpr int kCount = 64;
  const std::vector<Factor> factors{unit("a"), unit("b"), unit("c")};
  const std::vector<Point> points = latin_hypercube(factors, kCount, 7);
  ASSERT_EQ(points.size(), 64U);
  for (std::size_t f = 0; f < factors.size(); ++f) {
    std::set<int> parts;
    for (const double u : numbers(points, f)) parts.insert(static_cast<int>(kCount * u));
    EXPECT_EQ(parts.size(), 64U) << "factor " << f;
    EXPECT_EQ(*parts.begin(), 0);
    EXPECT_EQ(*parts.rbegin(), kCount - 1);
  }
  // The order differs from factor to factor: were the columns equal, the correlation would be 1. Its standard
  // deviation under independence is 1/sqrt(63) = 0.126.
  const std::vector<double> a = numbers(points, 0), b = numbers(points, 1);
  double covariance = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) covariance += (a[i] - 0.5) * (b[i] - 0.5) / kCount;
  EXPECT_LT(std::abs(12.0 * covariance), 4 * 0.126);
}

TEST(LatinHypercube, DependsOnTheSeedAlone) {
  const std::vector<Factor> factors{unit("a"), unit("b")};
  const auto values = [&](std::uint64_t seed) { return numbers(latin_hypercube(factors, 10, seed), 0); };
  EXPECT_EQ(values(1), values(1));
  EXPECT_NE(values(1), values(2));
  const std::vector<Factor> more{unit("a"), unit("b"), unit("c")};
  EXPECT_EQ(numbers(latin_hypercube(more, 10, 1), 0), values(1));
  // The same points on every machine; the numbers are those of an independent program (Python).
  EXPECT_EQ(latin_hypercube(factors, 3, 1).front().values, (Strings{"0.0885977", "0.825084"}));
}

TEST(LatinHypercube, FollowsLogarithmicRangesAndUnits) {
  const std::vector<Factor> factors{ranged("alpha", {1e-12, 1e-9, "1/Pa", true})};
  std::vector<double> alpha = numbers(latin_hypercube(factors, 3, 5), 0);
  std::sort(alpha.begin(), alpha.end());
  for (std::size_t i = 0; i < 3; ++i) {  // one in each decade
    EXPECT_GE(alpha[i], std::pow(10.0, -12.0 + static_cast<double>(i)));
    EXPECT_LE(alpha[i], std::pow(10.0, -11.0 + static_cast<double>(i)));
  }
  EXPECT_TRUE(latin_hypercube(factors, 3, 5).front().values.front().ends_with(" 1/Pa"));
}

// The first ten points in three dimensions as printed by Joe and Kuo for their file new-joe-kuo-6.21201
// (https://web.maths.unsw.edu.au/~fkuo/sobol/).
TEST(Sobol, GivesTheKnownPoints) {
  const double known[10][3]{{0, 0, 0},
                            {0.5, 0.5, 0.5},
                            {0.75, 0.25, 0.25},
                            {0.25, 0.75, 0.75},
                            {0.375, 0.375, 0.625},
                            {0.875, 0.875, 0.125},
                            {0.625, 0.125, 0.875},
                            {0.125, 0.625, 0.375},
                            {0.1875, 0.3125, 0.9375},
                            {0.6875, 0.8125, 0.4375}};
  const std::vector<Factor> factors{unit("a"), unit("b"), unit("c")};
  const std::vector<Point> points = sobol(factors, 10);
  ASSERT_EQ(points.size(), 10U);
  for (std::size_t f = 0; f < 3; ++f) {
    const std::vector<double> u = numbers(points, f);
    for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(u[i], known[i][f]) << "point " << i << ", factor " << f;
  }
}

TEST(Sobol, HitsEveryPartOnceAndGoesOnWhereItStopped) {
  constexpr int kCount = 32;
  const std::vector<Factor> factors{unit("a"), unit("b"), unit("c"), unit("d"), unit("e")};
  const std::vector<Point> points = sobol(factors, kCount);
  for (std::size_t f = 0; f < factors.size(); ++f) {
    std::set<int> parts;
    for (const double u : numbers(points, f)) parts.insert(static_cast<int>(kCount * u));
    EXPECT_EQ(parts.size(), 32U) << "factor " << f;
  }
  const std::vector<Point> rest = sobol(factors, kCount - 5, 5);
  for (std::size_t i = 0; i < rest.size(); ++i) EXPECT_EQ(rest[i].values, points[i + 5].values);
  EXPECT_EQ(sobol(factors, 3).back().values, points[2].values);
}

}  // namespace
}  // namespace abradem::study
