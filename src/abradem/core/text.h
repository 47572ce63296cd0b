// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace abradem::core {

/// Without blanks, tabs and line ends at either end.
[[nodiscard]] constexpr std::string_view trimmed(std::string_view text) noexcept {
  constexpr std::string_view kBlank = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

}  // namespace abradem::core
