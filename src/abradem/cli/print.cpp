// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/cli/print.h"

#include <fmt/core.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "abradem/core/error.h"

namespace abradem::cli {

void print_result(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    throw IoError(
        fmt::format("the result cannot be written to the standard output: {}", std::strerror(errno)));
}

void print_raw(std::string_view text) noexcept {
  // A message that cannot be written has nobody to complain to; and a run goes on without a reader.
  if (std::fwrite(text.data(), 1, text.size(), stderr) != text.size()) std::clearerr(stderr);
}

void print_message(std::string_view line) { print_raw(fmt::format("{}\n", line)); }

}  // namespace abradem::cli
