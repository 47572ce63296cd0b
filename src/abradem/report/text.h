// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

/// Small text tools of the page: escaping, packing, numbers.
namespace abradem::report {

/// Text as HTML shows it, in content and in quoted attributes: & < > " ' become entities, control characters
/// other than tab and newline become U+FFFD.
[[nodiscard]] std::string escape_html(std::string_view text);

/// Text as a JSON string, quotes included; < becomes \u003c, so that it may stand inside a page.
[[nodiscard]] std::string json_string(std::string_view text);

/// A number as JSON: 9 significant digits, null where it is not finite.
[[nodiscard]] std::string json_number(double value);

/// A number for readers: the given significant digits; powers of ten as "3.1 × 10⁻¹²" outside 1e-4 … 1e6;
/// an en dash where it is not finite.
[[nodiscard]] std::string readable(double value, int digits = 4);

/// A p-value for readers: two digits, one and the power of ten below 1e-4; an en dash where there is none.
[[nodiscard]] std::string readable_p(double p);

/// A sentence written for a terminal in ASCII as a page shows it: mm³ for mm^3, µm for um, α for alpha, ± for -+, R² for
/// R2.
[[nodiscard]] std::string typeset(std::string_view text);

/// A whole number with thin spaces between thousands.
[[nodiscard]] std::string readable_count(long long value);

/// The text with its first letter in upper case (ASCII).
[[nodiscard]] std::string capital(std::string text);

/// zlib stream (RFC 1950) of the bytes, best compression that is still quick.
/// @throws IoError when zlib fails (out of memory)
[[nodiscard]] std::string deflate(std::string_view bytes);

[[nodiscard]] std::string base64(std::string_view bytes);

}  // namespace abradem::report
