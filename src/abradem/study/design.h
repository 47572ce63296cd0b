// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// Designs of computer experiments: which values the varied keys of a case take in which run.
///                                                                                docs/reference/sweep.md
namespace abradem::study {

/// All values between two ends, which belong to it.
struct Range {
  double low = 0.0, high = 1.0;  ///< in `unit`
  std::string unit;              ///< as a case file writes it; empty: none
  bool logarithmic = false;      ///< equal ratios instead of equal differences; needs 0 < low
  bool whole = false;            ///< whole numbers only
  bool operator==(const Range&) const = default;
};

/// A key of the case and what it takes: the listed values, or a range.
struct Factor {
  std::string key;                  ///< dotted, as for `--set`
  std::vector<std::string> values;  ///< each as it stands after `KEY=`
  std::optional<Range> range;
  bool operator==(const Factor&) const = default;
};

/// One run of a design.
struct Point {
  std::string name;                    ///< its number from 1 in four digits: "0001"
  std::vector<std::string> values;     ///< of each factor, in their order
  std::vector<std::string> overrides;  ///< "KEY=VALUE" of each factor
};

inline constexpr std::size_t kMostPoints = 100'000;

/// The factor's value at 0 <= u < 1: of a range the value that far along it, of n listed values number
/// floor(n u). Ranges are rounded to six significant digits; the rounded text is what runs and what is
/// reported.
[[nodiscard]] std::string value_at(const Factor& factor, double u);

/// `count` values spread evenly over the range, its ends included.
/// @throws InputError when count < 2, or the range is empty or, if logarithmic, not positive
[[nodiscard]] std::vector<std::string> spread(const Range& range, int count);

/// Every listed value with every other; the last factor changes fastest.
/// @throws InputError naming the factor without listed values; for more than kMostPoints points; without
///         factors or with two of one key (so do the other designs)
[[nodiscard]] std::vector<Point> grid(std::span<const Factor> factors);

/// The first values of all factors, then the second, …   @throws InputError when their numbers differ
[[nodiscard]] std::vector<Point> list(std::span<const Factor> factors);

/// Latin hypercube: each factor's range is cut into `count` equal parts, of which each is hit once, at random
/// within the part and in random order. [mckay1979, doi:10.1080/00401706.1979.10489755]  The same seed gives
/// the same points, and a further factor leaves the others' values as they are.
/// @throws InputError as grid()
[[nodiscard]] std::vector<Point> latin_hypercube(std::span<const Factor> factors, int count,
                                                 std::uint64_t seed);

/// Points of Sobol's sequence from number `skip` on, with the direction numbers of Joe and Kuo
/// [doi:10.1137/070709359]. The first point has every factor at its low end. More points leave those before
/// as they are; 2^m from the first on hit each of 2^m equal parts of every factor once.
/// @throws InputError as grid(), or for more factors than there are direction numbers
[[nodiscard]] std::vector<Point> sobol(std::span<const Factor> factors, int count, std::uint64_t skip = 0);

}  // namespace abradem::study
