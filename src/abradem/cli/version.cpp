// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/core/version.h"

#include <fmt/core.h>

#include "abradem/cli/commands.h"

namespace abradem::cli {

std::string version_text() {
  return fmt::format("abradem {}\ncommit {}\ncompiler {}\nflags {}", core::version(), core::commit(),
                     core::compiler(), core::compiler_flags());
}

}  // namespace abradem::cli
