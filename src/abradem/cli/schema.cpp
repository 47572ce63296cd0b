// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/cli/commands.h"
#include "abradem/cli/print.h"
#include "abradem/core/error.h"
#include "abradem/io/case_schema.h"

namespace abradem::cli {

int schema_command(const std::string& format) {
  print_result(format == "md" ? io::case_reference_markdown() : io::case_json_schema());
  return static_cast<int>(ExitCode::ok);
}

}  // namespace abradem::cli
