// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

/// Published values that a study compares with, one JSON file. docs/reference/study.md#published-values
namespace abradem::report {

/// One value, range, list or trend that somebody states.
struct PublishedClaim {
  std::string id;          ///< "V17"
  std::string quantity;    ///< what it is about, in words
  std::string conditions;  ///< may be empty
  std::string unit, where;
  std::string kind;        ///< setup, experiment, claim, or figure (what a figure shows, not a number)
  std::string rule;        ///< by which it is judged; docs/reference/study.md#verdicts
  std::string shown;       ///< "Fig. 7", "Table 3"; empty: in none
  double tolerance = 0.0;  ///< of the rule; its meaning depends on the rule
  std::string words;       ///< a value in words ("decreasing"); else empty
  std::vector<double>
      numbers;  ///< a value in numbers: one, a range, a list; of a fit constant, linear, quadratic, R2
};

struct PublishedValues {
  std::string source;
  std::vector<PublishedClaim> claims;
  /// Nothing where there is no claim of that id.
  [[nodiscard]] const PublishedClaim* find(std::string_view id) const noexcept;
};

/// @throws IoError when it is missing, is no JSON, or a key is missing or of another kind (naming file, claim
/// and key);
///         when two claims have one id
[[nodiscard]] PublishedValues read_published(const std::filesystem::path& file);

}  // namespace abradem::report
