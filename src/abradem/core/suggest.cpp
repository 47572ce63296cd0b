// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/core/suggest.h"

#include <algorithm>
#include <vector>

namespace abradem::core {
namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  // Optimal string alignment: three rows of the usual table, so that a swap can look back two rows.
  const std::size_t width = b.size() + 1;
  std::vector<std::size_t> two_back(width), previous(width), current(width);
  for (std::size_t j = 0; j < width; ++j) previous[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    current[0] = i;
    for (std::size_t j = 1; j < width; ++j) {
      const std::size_t replace = previous[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      current[j] = std::min({previous[j] + 1, current[j - 1] + 1, replace});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        current[j] = std::min(current[j], two_back[j - 2] + 1);
    }
    std::swap(two_back, previous);
    std::swap(previous, current);
  }
  return previous[b.size()];
}

std::string nearest_spelling(std::string_view word, std::span<const std::string_view> candidates) {
  const std::size_t limit = std::max<std::size_t>(1, (word.size() + 1) / 3);
  std::size_t best = limit + 1;
  std::string_view nearest;
  const std::string folded = lower(word);
  for (const std::string_view candidate : candidates) {
    const std::size_t distance = edit_distance(folded, lower(candidate));
    // A one-letter word is one edit from every other; only its case may be wrong.
    if (distance < best && (word.size() > 1 || distance == 0)) {
      best = distance;
      nearest = candidate;
    }
  }
  // "friction" for "static_friction": too many edits, but plain to a person.
  constexpr std::size_t kTelling = 4;
  if (nearest.empty() && word.size() >= kTelling)
    for (const std::string_view candidate : candidates)
      if (lower(candidate).find(folded) != std::string::npos) return std::string(candidate);
  return std::string(nearest);
}

}  // namespace abradem::core
