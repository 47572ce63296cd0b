// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

/// What the pages of this room have in common.
namespace abradem::report {

/// The places of a template: name and what stands there.
using Places = std::map<std::string, std::string, std::less<>>;

/// Fills the {{name}} places in one pass, so that text of a case is never taken for a place.
/// @throws Error (internal) when the template names a place that is not given
[[nodiscard]] std::string fill(std::string_view page, const Places& places);

/// Bytes for the page's script, packed (zlib, base64) in an element with the id data-<name>.
[[nodiscard]] std::string data_block(std::string_view name, std::string_view bytes);

/// Numbers for such an element, as multiples of a step: differences of neighbours, their bytes sorted by
/// significance, which zlib then packs well. Charts.inflateNumbers reads them; NaN stays NaN.
template <class Number>
[[nodiscard]] std::string pack_numbers(const std::vector<Number>& values, double step) {
  constexpr std::int32_t kMissing = std::numeric_limits<std::int32_t>::min();
  const std::size_t n = values.size();
  std::string bytes(4 * n, '\0');
  std::uint32_t previous = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double multiple = static_cast<double>(values[k]) / step;
    const std::int32_t whole =
        std::isfinite(multiple) ? static_cast<std::int32_t>(std::lround(multiple)) : kMissing;
    const std::uint32_t difference = static_cast<std::uint32_t>(whole) - previous;
    previous = static_cast<std::uint32_t>(whole);
    for (std::size_t b = 0; b < 4; ++b) bytes[b * n + k] = static_cast<char>((difference >> (8 * b)) & 0xffu);
  }
  return bytes;
}

/// The whole page: the shell with its style, the chart library and the tools, around what a page has of its
/// own.
struct PageContent {
  std::string kicker;  ///< what kind of page this is
  std::string title;   ///< plain text
  std::string lead;    ///< plain text: the answer in a sentence
  std::string body;    ///< HTML
  std::string data;    ///< data blocks
  std::string_view script;
};
[[nodiscard]] std::string shell(const PageContent& content);

}  // namespace abradem::report
