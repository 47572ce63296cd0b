// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace abradem::core {

/// Number of single-character edits (insert, delete, replace, swap of neighbours) that turn a into b. O(|a|
/// |b|).
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

/// The candidate a person most likely meant: fewest edits, upper and lower case alike; the first of equals.
/// Empty when none is within about a third of the word's length.
[[nodiscard]] std::string nearest_spelling(std::string_view word,
                                           std::span<const std::string_view> candidates);

}  // namespace abradem::core
