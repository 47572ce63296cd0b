// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "abradem/study/design.h"

/// Varied keys as text.                                        docs/reference/sweep.md#values
namespace abradem::io {

/// A number and what stands behind it, as in "0.1 mm" or "20% rayleigh".
struct NumberText {
  double number = 0.0;
  std::string unit;  ///< as written; empty: none
};
/// nullopt where the text does not start with a finite number.
[[nodiscard]] std::optional<NumberText> read_number_text(std::string_view text);

/// Reads `KEY=a,b,c` or `KEY=low..high`. Values are separated by commas outside quotes and brackets. A range
/// may end with `:N`, which takes N values evenly spread over it, and with `:log`; its unit may be given
/// once, at its end. Keys that are whole numbers in the case get whole numbers.
/// @throws InputError with the text and what was expected
[[nodiscard]] study::Factor parse_factor(std::string_view text);
/// The same from a key and its values, one of which may be a range.
[[nodiscard]] study::Factor make_factor(std::string_view key, std::span<const std::string> values);

}  // namespace abradem::io
