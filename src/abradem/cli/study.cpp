// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/cli/study.h"

#include <fmt/core.h>

#include <filesystem>

#include "abradem/cli/batch.h"
#include "abradem/cli/output_folder.h"
#include "abradem/cli/print.h"
#include "abradem/cli/summary.h"
#include "abradem/core/error.h"
#include "abradem/io/atomic_file.h"
#include "abradem/report/study_page.h"
#include "abradem/study/variations.h"

namespace abradem::cli {
namespace {

namespace fs = std::filesystem;
using simulation::StudySetup;
using simulation::VariationSetup;

std::vector<Job> jobs_of(const StudySetup& study, const std::vector<study::PlannedRun>& planned,
                         const std::vector<std::string>& user) {
  // [study] itself is no matter of a run.
  std::vector<std::string> kept;
  for (const std::string& assignment : user)
    if (!assignment.starts_with("study")) kept.push_back(assignment);
  std::vector<Job> jobs;
  for (const study::PlannedRun& run : planned)
    jobs.push_back({run.name, study::overrides_of(study.variations[run.variation], run, kept)});
  return jobs;
}

void print_plan(const io::Case& study, const std::vector<study::PlannedRun>& planned,
                const fs::path& output) {
  std::string text = summarize(study.setup) + "\n";
  for (const study::PlannedRun& run : planned) {
    text += "    " + run.name;
    const char* separator = ": ";
    for (const auto& [key, value] : study::varied_in(study.setup.study->variations[run.variation], run)) {
      text += fmt::format("{}{} = {}", separator, key, value);
      separator = ", ";
    }
    text += "\n";
  }
  print_message(text +
                fmt::format("Dry run: nothing was written; the study would write to {}", output.string()));
}

std::vector<report::StudyRun> results_of(const StudySetup& study,
                                         const std::vector<study::PlannedRun>& planned,
                                         const std::vector<PreparedJob>& jobs, const BatchResult& batch) {
  std::vector<report::StudyRun> runs;
  for (std::size_t i = 0; i < planned.size(); ++i) {
    const VariationSetup& variation = study.variations[planned[i].variation];
    const JobResult& result = batch.jobs[i];
    runs.push_back({planned[i].name, variation.name, study::varied_in(variation, planned[i]), jobs[i].setup,
                    result.folder, std::string(name_of(result.status)), result.message, result.seconds});
  }
  return runs;
}

int exit_code_of(const BatchResult& batch) {
  if (batch.interrupted) return static_cast<int>(ExitCode::interrupted);
  for (const JobResult& job : batch.jobs)
    if (job.status == JobStatus::failed && job.exit_code != static_cast<int>(ExitCode::unphysical))
      return job.exit_code;
  return static_cast<int>(ExitCode::ok);
}

}  // namespace

int run_study(const RunArguments& arguments, const io::Case& study) {
  const StudySetup& setup = *study.setup.study;
  const fs::path output = arguments.output.empty() ? fs::path("out") / fs::path(arguments.case_path).stem()
                                                   : fs::path(arguments.output);
  const std::vector<study::PlannedRun> planned = study::plan(setup);
  if (arguments.dry_run) {
    print_result(io::resolved_case(study.setup));
    if (!arguments.quiet) print_plan(study, planned, output);
    return static_cast<int>(ExitCode::ok);
  }

  const std::vector<Job> jobs = jobs_of(setup, planned, arguments.overrides);
  const std::vector<PreparedJob> prepared = prepare_jobs(arguments.case_path, jobs);
  BatchOptions options;
  options.case_path = arguments.case_path;
  options.output = output;
  options.at_a_time = arguments.threads;
  options.force = arguments.force;
  options.quiet = arguments.quiet;
  const BatchResult batch = run_batch(options, prepared);
  io::write_file_atomically(output / "case.toml", study.text);
  io::write_file_atomically(output / "case.resolved.toml", io::resolved_case(study.setup));
  if (batch.interrupted) {
    print_message(fmt::format("interrupted; the same command goes on from here, finished runs are kept in {}",
                              output.string()));
    return exit_code_of(batch);
  }

  const std::vector<report::StudyRun> runs = results_of(setup, planned, prepared, batch);
  const fs::path page = report::write_page(output, report::study_page(study.setup, runs, output));
  if (!arguments.quiet)
    print_message(fmt::format("{} of {} runs completed, {} made now\nreport: {}",
                              batch.count(JobStatus::completed), batch.jobs.size(), batch.started,
                              page.string()));
  if (arguments.json) print_result(read_file(output / "batch.json"));
  return exit_code_of(batch);
}

}  // namespace abradem::cli
