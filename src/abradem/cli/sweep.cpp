// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>

#include "abradem/cli/batch.h"
#include "abradem/cli/commands.h"
#include "abradem/cli/output_folder.h"
#include "abradem/cli/print.h"
#include "abradem/cli/sweep_export.h"
#include "abradem/core/error.h"
#include "abradem/core/version.h"
#include "abradem/io/atomic_file.h"
#include "abradem/io/factor_text.h"
#include "abradem/report/page.h"
#include "abradem/report/seed_section.h"
#include "abradem/report/sweep_page.h"
#include "abradem/study/design.h"

namespace abradem::cli {
namespace {

namespace fs = std::filesystem;

std::string key_of(const std::string& assignment) { return assignment.substr(0, assignment.find('=')); }

std::vector<study::Factor> read_factors(const SweepArguments& arguments) {
  std::vector<study::Factor> factors;
  for (const std::string& text : arguments.vary) factors.push_back(io::parse_factor(text));
  for (const std::string& assignment : arguments.overrides)
    for (const study::Factor& factor : factors)
      if (key_of(assignment) == factor.key)
        throw InputError(fmt::format("'{}' is both set and varied; give it once", factor.key));
  return factors;
}

std::vector<study::Point> make_design(const SweepArguments& a, const std::vector<study::Factor>& factors) {
  const bool sampled = a.design == "lhs" || a.design == "sobol";
  if (sampled && a.samples == 0)
    throw InputError(fmt::format("--design {} needs --samples N, the number of runs", a.design));
  if (!sampled && a.samples > 0)
    throw InputError(
        "--samples counts only with --design lhs or sobol; a grid or list has as many runs as its "
        "values make");
  if (a.seed && a.design != "lhs") throw InputError("--seed counts only with --design lhs");
  if (a.design == "list") return study::list(factors);
  if (a.design == "lhs") return study::latin_hypercube(factors, a.samples, a.seed.value_or(1));
  if (a.design == "sobol") return study::sobol(factors, a.samples);
  return study::grid(factors);
}

std::string describe(const SweepArguments& a, std::size_t keys) {
  const std::string of = fmt::format(" of {} key{}", keys, keys == 1 ? "" : "s");
  if (a.design == "list") return "List" + of;
  if (a.design == "lhs") return fmt::format("Latin hypercube{}, seed {}", of, a.seed.value_or(1));
  if (a.design == "sobol") return "Sobol sequence" + of;
  return "Grid" + of;
}

/// summary.csv and the page, from what lies in the runs' folders.
void write_summary(const SweepArguments& arguments, const fs::path& output,
                   const std::vector<study::Factor>& factors, const std::vector<study::Point>& points,
                   const std::vector<PreparedJob>& jobs, const BatchResult& result) {
  std::vector<std::string> keys;
  for (const study::Factor& factor : factors) keys.push_back(factor.key);
  std::vector<report::SweepRun> runs;
  report::SweepSummary summary{.title = jobs.front().setup.title,
                               .design = describe(arguments, factors.size()),
                               .command = {},
                               .seconds = 0.0};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const JobResult& job = result.jobs[i];
    runs.push_back(
        {points[i].name, std::string(name_of(job.status)), points[i].values, job.folder, job.message});
    summary.seconds += job.seconds;
  }
  summary.command = fmt::format("abradem {} ({}): abradem sweep {}", core::version(), core::commit(),
                                sweep_command_line(arguments));
  const report::SweepTable table = report::make_sweep_table(keys, runs);
  io::write_file_atomically(output / "summary.csv", report::to_csv(table));
  report::Page page = report::sweep_page(summary, table);
  if (std::optional<report::PageSection> seeds = report::seed_section(table, runs))
    page.sections.insert(page.sections.begin() + 1, std::move(*seeds));  // behind the main effects
  report::write_page(output, page);
}

}  // namespace

int sweep_command(const SweepArguments& arguments) {
  const std::vector<study::Factor> factors = read_factors(arguments);
  const std::vector<study::Point> points = make_design(arguments, factors);
  std::vector<Job> jobs;
  for (const study::Point& point : points) {
    jobs.push_back({point.name, arguments.overrides});
    jobs.back().overrides.insert(jobs.back().overrides.end(), point.overrides.begin(), point.overrides.end());
  }
  const std::vector<PreparedJob> prepared = prepare_jobs(arguments.case_path, jobs);

  BatchOptions options;
  options.case_path = arguments.case_path;
  options.output = sweep_output(arguments);
  options.at_a_time = arguments.jobs;
  options.force = arguments.force;
  options.quiet = arguments.quiet;
  options.collect = arguments.collect;
  if (arguments.only > 0) {
    if (static_cast<std::size_t>(arguments.only) > jobs.size())
      throw InputError(fmt::format("--case {}: there are {} runs", arguments.only, jobs.size()));
    options.only = static_cast<std::size_t>(arguments.only) - 1;
  }
  if (!arguments.export_format.empty()) {
    export_sweep(arguments, points);
    return static_cast<int>(ExitCode::ok);
  }

  const BatchResult result = run_batch(options, prepared);
  if (options.only) {
    const JobResult& job = result.jobs[*options.only];
    if (arguments.json) print_result(read_file(job.folder / "run.json"));
    return result.interrupted ? result.exit_code() : job.exit_code;
  }
  if (!result.interrupted) {
    write_summary(arguments, options.output, factors, points, prepared, result);
    const std::size_t left = result.count(JobStatus::missing) + result.count(JobStatus::interrupted);
    if (left > 0) print_message(fmt::format("warning: {} of {} runs are not done", left, points.size()));
    if (!arguments.quiet)
      print_message(fmt::format(
          "{} of {} runs completed{}\ntable: {}\nreport: {}", result.count(JobStatus::completed),
          points.size(),
          result.count(JobStatus::failed) > 0 ? fmt::format(", {} failed", result.count(JobStatus::failed))
                                              : "",
          (options.output / "summary.csv").string(), (options.output / "report.html").string()));
  } else if (!arguments.quiet) {
    print_message(
        fmt::format("interrupted: {} of {} runs completed; the same command again goes on from here",
                    result.count(JobStatus::completed), points.size()));
  }
  if (arguments.json) print_result(read_file(options.output / "batch.json"));
  return result.exit_code();
}

}  // namespace abradem::cli
