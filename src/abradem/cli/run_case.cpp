// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/cli/run_case.h"

#include "abradem/cli/output_folder.h"
#include "abradem/core/error.h"

namespace abradem::cli {

int run_case(const RunOptions& options) {
  prepare_output_folder(options.output, options.force);
  write_file(options.output / "case.toml", options.case_text);
  write_file(options.output / "case.resolved.toml", options.resolved_text);
  return static_cast<int>(ExitCode::ok);
}

}  // namespace abradem::cli
