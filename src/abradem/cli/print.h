// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace abradem::cli {

/// Writes a result to stdout, whole. @throws IoError when that fails (a full disk behind a redirection)
void print_result(std::string_view text);

/// Writes a line for a person to stderr.
void print_message(std::string_view line);

}  // namespace abradem::cli
