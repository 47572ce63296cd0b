// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace abradem::cli {

/// Writes a result to stdout, whole. @throws IoError when that fails (a full disk behind a redirection)
void print_result(std::string_view text);

/// Writes text for a person to stderr as it is; a failure is not reported.
void print_raw(std::string_view text) noexcept;
/// As print_raw, and ends the line.
void print_message(std::string_view line);

}  // namespace abradem::cli
