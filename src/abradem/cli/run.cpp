// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <filesystem>

#include "abradem/cli/commands.h"
#include "abradem/cli/print.h"
#include "abradem/cli/run_case.h"
#include "abradem/cli/study.h"
#include "abradem/cli/summary.h"
#include "abradem/core/error.h"
#include "abradem/io/case_file.h"

namespace abradem::cli {

int run_command(const RunArguments& arguments) {
  namespace fs = std::filesystem;
  io::Case read = arguments.no_study ? io::load_single_run(arguments.case_path, arguments.overrides)
                                     : io::load_case(arguments.case_path, arguments.overrides);
  if (!arguments.quiet)
    for (const std::string& note : read.notes) print_message(note);
  if (read.setup.study) return run_study(arguments, read);

  RunOptions options;
  options.resolved_text = io::resolved_case(read.setup);
  options.setup = std::move(read.setup);
  options.case_path = arguments.case_path;
  options.case_text = std::move(read.text);
  options.output =
      arguments.output.empty() ? fs::path("out") / options.case_path.stem() : fs::path(arguments.output);
  options.force = arguments.force;
  options.quiet = arguments.quiet;
  options.json = arguments.json;
  options.report = !arguments.no_report;
  options.threads = arguments.threads;
  if (!arguments.dry_run) return run_case(options);

  print_result(options.resolved_text);
  if (!arguments.quiet)
    print_message(fmt::format("{}\nDry run: nothing was written; a run would write to {}",
                              summarize(options.setup), options.output.string()));
  return static_cast<int>(ExitCode::ok);
}

}  // namespace abradem::cli
