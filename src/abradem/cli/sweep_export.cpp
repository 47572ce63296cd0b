// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/cli/sweep_export.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "abradem/cli/print.h"
#include "abradem/core/error.h"
#include "abradem/io/atomic_file.h"

namespace abradem::cli {
namespace {

namespace fs = std::filesystem;

/// Options that say what the sweep is, in the form both a shell and this program take; not how it is run.
std::vector<std::string> arguments_of(const SweepArguments& a, const fs::path& case_path,
                                      const fs::path& output) {
  std::vector<std::string> words{case_path.string(), "-o", output.string()};
  const auto add = [&](const char* option, const std::string& value) {
    words.emplace_back(option);
    words.push_back(value);
  };
  for (const std::string& assignment : a.overrides) add("--set", assignment);
  for (const std::string& factor : a.vary) add("--vary", factor);
  if (a.design != "grid") add("--design", a.design);
  if (a.samples > 0) add("--samples", std::to_string(a.samples));
  if (a.seed) add("--seed", std::to_string(*a.seed));
  return words;
}

std::string shell_quoted(const std::string& word) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=,:+@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) {
    if (c == '\'')
      quoted += "'\\''";
    else
      quoted += c;
  }
  return quoted + "'";
}

std::string shell_line(const std::vector<std::string>& words) {
  std::vector<std::string> quoted;
  for (const std::string& word : words) quoted.push_back(shell_quoted(word));
  return fmt::format("{}", fmt::join(quoted, " "));
}

fs::path full(const fs::path& path) { return fs::absolute(path).lexically_normal(); }

fs::path this_program() {
  std::error_code error;
  const fs::path path = fs::read_symlink("/proc/self/exe", error);
  return error ? fs::path("abradem") : path;
}

constexpr const char* kSlurm = R"(#!/bin/bash
# A sweep of {runs} runs as a job array, and a job after it that makes the table and the report of all.
#
#   bash {name}          hands both jobs to Slurm
#
# Change what your cluster needs (partition, account, memory, time) here; ABRADEM names the program there.
set -euo pipefail
export ABRADEM=${{ABRADEM:-{program}}}
limits=(--time=01:00:00 --mem=2G)
mkdir -p {logs}

array=$(sbatch --parsable "${{limits[@]}}" --job-name=abradem --array=1-{runs} --cpus-per-task=1 \
  --output={logs}/%a.log <<'RUN'
#!/bin/bash
exec "$ABRADEM" sweep {command} --case "$SLURM_ARRAY_TASK_ID"
RUN
)
sbatch --parsable "${{limits[@]}}" --job-name=abradem-table --dependency="afterany:${{array%%;*}}" \
  --output={logs}/table.log <<'TABLE'
#!/bin/bash
exec "$ABRADEM" sweep {command} --collect
TABLE
)";

constexpr const char* kSnakemake = R"(# A sweep of {runs} runs as a Snakemake workflow:
#
#   snakemake --cores all --snakefile {name}
#
# ABRADEM names the program where it is not the one that wrote this file.
import os
import shlex

ABRADEM = os.environ.get("ABRADEM", {program})
OUTPUT = {output}
SWEEP = [ABRADEM, "sweep"] + {command}
RUNS = {names}

def sweep(*options):
    return " ".join(shlex.quote(word) for word in [*SWEEP, *options])

# A run whose equations no longer hold (exit code 4), or whose inputs cannot be used (2, 3), has its row in the
# table too.
ACCEPTED = "|| case $? in 2|3|4) ;; *) exit 1 ;; esac"

rule all:
    input: OUTPUT + "/summary.csv"

rule run:
    output: OUTPUT + "/runs/{{name}}/run.json"
    params: command=lambda wildcards: sweep("--quiet", "--case", str(RUNS.index(wildcards.name) + 1))
    shell: "{{params.command}} " + ACCEPTED

rule table:
    input: expand(OUTPUT + "/runs/{{name}}/run.json", name=RUNS)
    output: OUTPUT + "/summary.csv"
    params: command=lambda wildcards: sweep("--quiet", "--collect")
    shell: "{{params.command}} " + ACCEPTED
)";

/// A list or text as Python (and JSON) writes it.
template <typename T>
std::string python(const T& value) {
  return nlohmann::json(value).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

fs::path sweep_output(const SweepArguments& arguments) {
  if (!arguments.output.empty()) return arguments.output;
  return fs::path("out") / (fs::path(arguments.case_path).stem().string() + "-sweep");
}

std::string sweep_command_line(const SweepArguments& arguments) {
  return shell_line(arguments_of(arguments, arguments.case_path, sweep_output(arguments)));
}

void export_sweep(const SweepArguments& arguments, const std::vector<study::Point>& points) {
  const fs::path output = full(sweep_output(arguments));
  const std::vector<std::string> words = arguments_of(arguments, full(arguments.case_path), output);
  const bool slurm = arguments.export_format == "slurm";
  const std::string name = !arguments.export_path.empty() ? arguments.export_path
                           : slurm                        ? "FILE"
                                                          : "Snakefile";
  std::string text;
  if (slurm) {
    text = fmt::format(
        fmt::runtime(kSlurm), fmt::arg("runs", points.size()), fmt::arg("name", name),
        fmt::arg("program", shell_quoted(this_program().string())),
        fmt::arg("logs",
                 shell_quoted((output.parent_path() / (output.filename().string() + "-logs")).string())),
        fmt::arg("command", shell_line(words)));
  } else {
    std::vector<std::string> names;
    for (const study::Point& point : points) names.push_back(point.name);
    text = fmt::format(fmt::runtime(kSnakemake), fmt::arg("runs", points.size()), fmt::arg("name", name),
                       fmt::arg("program", python(this_program().string())),
                       fmt::arg("output", python(output.string())), fmt::arg("command", python(words)),
                       fmt::arg("names", python(names)));
  }
  if (arguments.export_path.empty()) {
    print_result(text);
    return;
  }
  std::error_code error;
  if (fs::exists(arguments.export_path, error) && !arguments.force)
    throw InputError(fmt::format("'{}' exists; add --force to replace it", arguments.export_path));
  io::write_file_atomically(arguments.export_path, text);
  print_message(fmt::format("{} written; next: {} {}", arguments.export_path,
                            slurm ? "bash" : "snakemake --cores all --snakefile", arguments.export_path));
}

}  // namespace abradem::cli
