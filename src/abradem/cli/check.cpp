// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "abradem/cli/commands.h"
#include "abradem/cli/print.h"
#include "abradem/cli/summary.h"
#include "abradem/core/error.h"
#include "abradem/io/case_file.h"

namespace abradem::cli {

int check_command(const CheckArguments& arguments) {
  const io::Case read = io::load_case(arguments.path, arguments.overrides);
  for (const std::string& note : read.notes) print_message(note);
  print_message(fmt::format("{}: no errors\n{}", arguments.path, summarize(read.setup)));
  return static_cast<int>(ExitCode::ok);
}

}  // namespace abradem::cli
