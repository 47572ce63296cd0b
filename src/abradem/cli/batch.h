// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "abradem/simulation/setup.h"

/// Many runs of one case, each a process of its own, with what it needs to be broken off and gone on with at
/// any time.                                                              docs/reference/sweep.md#the-folder
namespace abradem::cli {

/// One run of the case.
struct Job {
  std::string name;                    ///< its folder is <output>/runs/<name>; a '/' makes groups
  std::vector<std::string> overrides;  ///< "KEY=VALUE", as of --set
};

struct BatchOptions {
  std::filesystem::path case_path;
  std::filesystem::path output;          ///< runs/<name>/, batch.json and batch.log go into it
  std::vector<std::string> run_options;  ///< further options of `abradem run` for every job
  int at_a_time = 0;                     ///< runs going on together; 0: as many as there are cores
  bool force = false;    ///< runs of other inputs that lie in the way are replaced, and failed ones repeated
  bool quiet = false;    ///< no progress, only warnings and errors
  bool collect = false;  ///< run nothing, only see what is there
  /// The only job to run, from 0; the manifest then is left to whoever collects. Any number of processes may
  /// work on one folder in this way, each on another job.
  std::optional<std::size_t> only;
};

/// A job whose case has been read and found good.
struct PreparedJob {
  Job job;
  simulation::Setup setup;
  std::uint64_t inputs_hash = 0;  ///< io::inputs_hash()
};

enum class JobStatus {
  missing,      ///< not run yet
  completed,    ///< run.json says so
  failed,       ///< run.json says so; `message` tells why
  interrupted,  ///< broken off; goes on from its checkpoint next time
};
[[nodiscard]] std::string_view name_of(JobStatus status) noexcept;

struct JobResult {
  std::string name;
  std::filesystem::path folder;  ///< with run.json, tables/ …; of jobs with equal inputs the first one's
  JobStatus status = JobStatus::missing;
  int exit_code = 0;
  std::string message;  ///< why it failed
  double seconds = 0.0;
};

struct BatchResult {
  std::vector<JobResult> jobs;  ///< in the order given
  int started = 0;              ///< runs made just now; the others were there
  bool interrupted = false;
  /// 130 when interrupted, else that of the first failed job, else 130 when a run was stopped on its own,
  /// else 0.
  [[nodiscard]] int exit_code() const noexcept;
  [[nodiscard]] std::size_t count(JobStatus status) const noexcept;
};

/// Reads the case once per job, without its [study].
/// @throws InputError with all that is wrong with any of them, each problem once with the names of its jobs;
///         or when two jobs have one name
[[nodiscard]] std::vector<PreparedJob> prepare_jobs(const std::filesystem::path& case_path,
                                                    std::span<const Job> jobs);

/// Runs every job that is not settled, as a process `abradem run … --threads 1 --no-study --no-report
/// --quiet`. A job is settled when its folder holds a completed run, or one that went unphysical, of the same
/// inputs by the same program (version and commit); jobs with equal inputs are run once. A failed job does
/// not stop the others. batch.json says how things stand and is never half-written; after Ctrl-C, a kill or a
/// full disk the same call goes on where it stopped.
/// @throws InputError when the folder holds something else, or runs of other inputs and `force` is not given;
///         or while another process works on it. Nothing has been touched then.
/// @throws IoError when something cannot be written (a full disk): no further job is started
BatchResult run_batch(const BatchOptions& options, std::span<const PreparedJob> jobs);
BatchResult run_batch(const BatchOptions& options, std::span<const Job> jobs);

}  // namespace abradem::cli
