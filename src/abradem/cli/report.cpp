// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/report/report.h"

#include <fmt/core.h>

#include "abradem/cli/commands.h"
#include "abradem/cli/print.h"
#include "abradem/core/error.h"

namespace abradem::cli {

int report_command(const std::string& folder) {
  print_message(fmt::format("report: {}", report::write_report(folder).string()));
  return static_cast<int>(ExitCode::ok);
}

}  // namespace abradem::cli
