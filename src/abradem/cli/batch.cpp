// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/cli/batch.h"

#include <fmt/core.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <deque>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "abradem/cli/child_processes.h"
#include "abradem/cli/output_folder.h"
#include "abradem/cli/path_lock.h"
#include "abradem/cli/progress.h"
#include "abradem/cli/stop_signals.h"
#include "abradem/core/error.h"
#include "abradem/core/version.h"
#include "abradem/io/atomic_file.h"
#include "abradem/io/case_file.h"
#include "abradem/io/case_problems.h"
#include "abradem/io/checkpoint.h"
#include "abradem/io/run_record.h"
#include "abradem/report/manifest.h"

namespace abradem::cli {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr const char* kManifest = "batch.json";

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::string hex(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

/// "'0001', '0002' and 38 more".
std::string some_of(const std::vector<std::string>& names) {
  constexpr std::size_t kNamed = 3;
  const std::size_t shown = names.size() <= kNamed + 1 ? names.size() : kNamed;
  std::string text;
  for (std::size_t i = 0; i < shown; ++i) {
    if (i > 0) text += i + 1 == names.size() ? " and " : ", ";
    text += fmt::format("'{}'", names[i]);
  }
  if (shown < names.size()) text += fmt::format(" and {} more", names.size() - shown);
  return text;
}

bool is_empty_or_missing(const fs::path& folder) {
  std::error_code error;
  return !fs::exists(folder, error) || fs::is_empty(folder, error);
}

/// Whether a folder holds files, at any depth, and none of them says that it is ours. Empty folders may have
/// been made for us beforehand, and another process may just be writing the manifest.
bool is_of_others(const fs::path& folder) {
  std::error_code error;
  bool files = false;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end && !files;
       entry.increment(error))
    files = !entry->is_directory() && !entry->path().filename().string().starts_with(kManifest);
  return files && !fs::exists(folder / kManifest, error);
}

/// What lies in a job's folder.
struct Found {
  JobResult result;
  bool settled = false;       ///< nothing is to be gained by running it again
  bool no_run = false;        ///< files of something else, or of a run that another process just begins
  bool other_inputs = false;  ///< a run of another case, or of this one with other values
};

/// The same inputs give the same failure, unless it was the machine that failed.
bool fails_again(int exit_code) {
  return exit_code == static_cast<int>(ExitCode::unphysical) ||
         exit_code == static_cast<int>(ExitCode::geometry) || exit_code == static_cast<int>(ExitCode::input);
}

Found look_at(const PreparedJob& prepared, const fs::path& folder, bool repeat_failed) {
  Found found;
  found.result.name = prepared.job.name;
  found.result.folder = folder;
  if (is_empty_or_missing(folder)) return found;
  std::error_code ignored;
  if (!fs::exists(folder / "case.resolved.toml", ignored)) {
    found.no_run = true;
    return found;
  }
  report::Manifest run;
  try {
    run = report::read_manifest(folder / "run.json");
  } catch (const IoError&) {  // killed before it was written
    found.result.status = JobStatus::interrupted;
    found.other_inputs = read_file(folder / "case.resolved.toml") != io::resolved_case(prepared.setup);
    return found;
  }
  found.other_inputs = run.inputs_hash != hex(prepared.inputs_hash);
  if (found.other_inputs || run.version != core::version() || run.commit != core::commit()) return found;
  found.result.exit_code = run.exit_code;
  found.result.message = run.error;
  found.result.seconds = run.wall_seconds;
  found.result.status = run.status == "completed" ? JobStatus::completed
                        : run.status == "failed"  ? JobStatus::failed
                                                  : JobStatus::interrupted;
  found.settled = found.result.status == JobStatus::completed ||
                  (found.result.status == JobStatus::failed && fails_again(run.exit_code) && !repeat_failed);
  return found;
}

/// Ended by someone's wish, before it could write a record.
bool is_stop(int exit_code) {
  return exit_code == 128 + SIGINT || exit_code == 128 + SIGTERM || exit_code == 128 + SIGHUP;
}

/// The last lines a child said, without what is no error.
std::string error_in(const std::string& said) {
  std::string text;
  for (std::size_t at = 0; at < said.size();) {
    const std::size_t end = std::min(said.find('\n', at), said.size());
    const std::string line = said.substr(at, end - at);
    if (!line.empty() && !line.starts_with("warning:")) text += (text.empty() ? "" : "\n") + line;
    at = end + 1;
  }
  constexpr std::string_view kPrefix = "abradem: error: ";
  if (text.starts_with(kPrefix)) text.erase(0, kPrefix.size());
  return text;
}

/// Is there a checkpoint of these inputs by this program to go on from? Then the run is the same as one that
/// was never stopped.
bool can_go_on(const PreparedJob& prepared, const fs::path& folder) {
  const std::optional<io::Checkpoint> checkpoint = io::newest_checkpoint(folder);
  return checkpoint && checkpoint->inputs_hash == prepared.inputs_hash &&
         checkpoint->version == core::version() && checkpoint->commit == core::commit();
}

class Batch {
 public:
  Batch(const BatchOptions& options, std::span<const PreparedJob> jobs);
  BatchResult run();

 private:
  void look_around();
  void prepare_folder() const;
  void start_next();
  void take_in(const ChildProcesses::Ended& ended);
  void record_failure(std::size_t job, int exit_code, const std::string& message) const;
  void share_results();
  void write_manifest(std::string_view status) const;
  [[nodiscard]] std::string_view end_status() const;
  void report_progress(bool at_once);
  [[nodiscard]] fs::path folder_of(std::size_t job) const {
    return options_.output / "runs" / jobs_[job].job.name;
  }
  [[nodiscard]] JobResult& result_of(std::size_t job) { return result_.jobs[job]; }

  const BatchOptions& options_;
  std::span<const PreparedJob> jobs_;
  BatchResult result_;
  std::deque<std::size_t> waiting_;
  std::map<std::uint64_t, std::size_t> first_with_;  // inputs → the job that is run for them
  std::size_t to_run_ = 0, ended_ = 0;
  bool stopping_ = false;
  std::string disk_trouble_;
  ChildProcesses children_;
  Clock::time_point start_ = Clock::now(), shown_ = start_, saved_ = start_;
  std::optional<RunLog> log_;
};

/// Refuses what can be refused without reading a run.
Batch::Batch(const BatchOptions& options, std::span<const PreparedJob> jobs)
    : options_(options), jobs_(jobs) {
  std::error_code error;
  if (fs::exists(options.output, error) && !fs::is_directory(options.output, error))
    throw InputError(
        fmt::format("output folder '{}' is a file; choose another with -o", options.output.string()));
  if (is_of_others(options.output))
    throw InputError(
        fmt::format("output folder '{}' holds files that are not of a sweep; choose another with -o",
                    options.output.string()));
  if (options.collect && !fs::exists(options.output / kManifest, error))
    throw InputError(fmt::format("folder '{}' holds no runs to collect", options.output.string()));
}

/// Sees what is there and what is to be done; touches nothing. The folders looked at must be locked: another
/// process could just be beginning its run in one.
void Batch::look_around() {
  std::vector<std::string> others;
  for (std::size_t j = 0; j < jobs_.size(); ++j) {
    const bool is_first = first_with_.try_emplace(jobs_[j].inputs_hash, j).second;
    if (options_.only && *options_.only != j) {
      result_.jobs.push_back({jobs_[j].job.name, folder_of(j), JobStatus::missing, 0, {}, 0.0});
      continue;
    }
    Found found = look_at(jobs_[j], folder_of(j), options_.force);
    if (found.no_run && !options_.collect)
      throw InputError(fmt::format(
          "folder '{}' is in the way: it holds files that are not of a run; choose another with -o",
          folder_of(j).string()));
    if (found.other_inputs) others.push_back(jobs_[j].job.name);
    if ((is_first || options_.only) && !found.settled && !options_.collect) waiting_.push_back(j);
    result_.jobs.push_back(std::move(found.result));
  }
  to_run_ = waiting_.size();
  if (!others.empty() && !options_.force && !options_.collect)
    throw InputError(
        fmt::format("folder '{}' holds runs of other inputs under the names {}; choose another with -o, or "
                    "add --force to "
                    "replace them (finished runs of the same inputs are kept)",
                    options_.output.string(), some_of(others)));
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw IoError(fmt::format("cannot create the output folder '{}': {}", folder.string(), error.message()));
}

void Batch::prepare_folder() const {
  for (const std::size_t j : waiting_) make_folder(folder_of(j));
  std::error_code ignored;
  if (!options_.only || !fs::exists(options_.output / kManifest, ignored)) write_manifest("running");
}

void Batch::start_next() {
  const std::size_t j = waiting_.front();
  waiting_.pop_front();
  std::error_code ignored;
  // What failed by the physics and is asked for again begins anew.
  const bool go_on = !(result_of(j).status == JobStatus::failed && fails_again(result_of(j).exit_code)) &&
                     can_go_on(jobs_[j], folder_of(j));
  fs::remove(folder_of(j) / "run.json", ignored);  // what is found there afterwards is new
  if (go_on) {
    children_.start(j, {"resume", folder_of(j).string(), "--threads", "1", "--quiet", "--no-report"});
    ++result_.started;
    return;
  }
  std::vector<std::string> arguments{"run",         options_.case_path.string(),
                                     "-o",          folder_of(j).string(),
                                     "--threads",   "1",
                                     "--force",     "--quiet",
                                     "--no-report", "--no-study"};
  arguments.insert(arguments.end(), options_.run_options.begin(), options_.run_options.end());
  for (const std::string& assignment : jobs_[j].job.overrides) {
    arguments.emplace_back("--set");
    arguments.push_back(assignment);
  }
  children_.start(j, arguments);
  ++result_.started;
}

/// A run that left no record of its failure gets one, so that whoever collects knows.
void Batch::record_failure(std::size_t j, int exit_code, const std::string& message) const {
  io::RunRecord record;
  record.status = "failed";
  record.exit_code = exit_code;
  record.error = message;
  record.inputs_hash = jobs_[j].inputs_hash;
  if (!fails_again(exit_code) && can_go_on(jobs_[j], folder_of(j))) {  // what it has is worth keeping
    io::write_file_atomically(folder_of(j) / "run.json", io::to_json(record, jobs_[j].setup));
    return;
  }
  OutputFolder folder(folder_of(j), true);
  io::write_file_atomically(folder_of(j) / "case.resolved.toml", io::resolved_case(jobs_[j].setup));
  io::write_file_atomically(folder_of(j) / "run.json", io::to_json(record, jobs_[j].setup));
  folder.keep();
}

void Batch::take_in(const ChildProcesses::Ended& ended) {
  const std::size_t j = ended.number;
  const std::string& name = jobs_[j].job.name;
  ++ended_;
  std::string message = error_in(ended.said);
  if (ended.exit_code == static_cast<int>(ExitCode::io)) {
    result_of(j) = {name, folder_of(j), JobStatus::failed, ended.exit_code, message, 0.0};
    if (disk_trouble_.empty()) disk_trouble_ = fmt::format("run '{}': {}", name, message);
    waiting_.clear();
    return;
  }
  Found found = look_at(jobs_[j], folder_of(j), false);
  const auto fail = [&](ExitCode code, const std::string& why) {
    record_failure(j, static_cast<int>(code), why);
    found.result = {name, folder_of(j), JobStatus::failed, static_cast<int>(code), why, 0.0};
  };
  if (found.other_inputs) {
    // What it found is no result of this sweep.
    fail(ExitCode::io, "the case file or a mesh changed while the runs were going on");
  } else if (ended.exit_code != 0 && found.result.exit_code != ended.exit_code && !is_stop(ended.exit_code)) {
    if (ended.exit_code > 128)
      message = fmt::format("ended by signal {}{}", ended.exit_code - 128,
                            ended.exit_code - 128 == SIGKILL ? " (out of memory?)" : "");
    fail(static_cast<ExitCode>(ended.exit_code), message);
  }
  result_of(j) = std::move(found.result);
  const JobResult& result = result_of(j);
  std::error_code ignored;  // many complete runs do not need the room of many checkpoints
  if (result.status == JobStatus::completed) fs::remove_all(folder_of(j) / "restart", ignored);
  if (result.status == JobStatus::failed)
    log_->warning(fmt::format("run '{}' failed: {}", name, result.message));
  else
    log_->record(fmt::format("run '{}' {} in {:.2f} s", name, name_of(result.status), result.seconds));
}

/// Jobs with equal inputs have one run, unless they have their own.
void Batch::share_results() {
  for (std::size_t j = 0; j < jobs_.size(); ++j) {
    const JobResult& first = result_of(first_with_.at(jobs_[j].inputs_hash));
    JobResult& own = result_of(j);
    if (own.status == JobStatus::completed || own.status == JobStatus::failed) continue;
    own = first;
    own.name = jobs_[j].job.name;
  }
}

void Batch::write_manifest(std::string_view status) const {
  using Json = nlohmann::ordered_json;
  Json runs = Json::array();
  for (std::size_t j = 0; j < jobs_.size(); ++j) {
    const JobResult& r = result_.jobs[j];
    Json run{{"name", r.name},
             {"folder", fs::relative(r.folder, options_.output).generic_string()},
             {"status", name_of(r.status)},
             {"exit_code", r.exit_code},
             {"seconds", r.seconds},
             {"inputs_hash", hex(jobs_[j].inputs_hash)},
             {"set", jobs_[j].job.overrides}};
    if (!r.message.empty()) run["error"] = r.message;
    runs.push_back(std::move(run));
  }
  Json json{{"status", status},
            {"case", options_.case_path.string()},
            {"version", core::version()},
            {"commit", core::commit()}};
  for (const JobStatus s :
       {JobStatus::completed, JobStatus::failed, JobStatus::interrupted, JobStatus::missing})
    json[std::string(name_of(s))] = result_.count(s);
  json["runs"] = std::move(runs);
  io::write_file_atomically(options_.output / kManifest,
                            json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

void Batch::report_progress(bool at_once) {
  const double interval = log_->on_terminal() ? 0.1 : 10.0;
  if (!at_once && seconds_since(shown_) < interval) return;
  shown_ = Clock::now();
  share_results();
  const std::size_t failed = result_.count(JobStatus::failed);
  std::string text =
      fmt::format("{} of {} runs done, {} running", result_.count(JobStatus::completed) + failed,
                  jobs_.size(), children_.running());
  if (failed > 0) text += fmt::format(", {} failed", failed);
  if (ended_ > 0 && ended_ < to_run_ && !stopping_)
    text +=
        fmt::format(", {} left", clock_time(seconds_since(start_) * static_cast<double>(to_run_ - ended_) /
                                            static_cast<double>(ended_)));
  if (log_->on_terminal())
    log_->status(text);
  else
    log_->line(text);
}

std::string_view Batch::end_status() const {
  if (stopping_) return "interrupted";
  if (!disk_trouble_.empty()) return "stopped";
  if (result_.count(JobStatus::completed) == jobs_.size()) return "completed";
  return result_.count(JobStatus::failed) > 0 ? "failed" : "incomplete";
}

BatchResult Batch::run() {
  if (options_.collect) {
    look_around();
    share_results();
    write_manifest(end_status());
    return std::move(result_);
  }
  const StopSignals signals;
  make_folder(options_.output);
  const PathLock lock(options_.output, options_.only ? PathLock::Kind::shared : PathLock::Kind::exclusive);
  std::optional<PathLock> own_lock;
  if (options_.only) {
    make_folder(folder_of(*options_.only));
    own_lock.emplace(folder_of(*options_.only), PathLock::Kind::exclusive);
  }
  look_around();
  prepare_folder();
  // Processes that share the folder do not share its log; where nothing is done it stays as it is.
  log_.emplace(options_.only || to_run_ == 0 ? fs::path("/dev/null") : options_.output / "batch.log",
               options_.quiet);
  const int at_a_time = options_.at_a_time > 0
                            ? options_.at_a_time
                            : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  if (to_run_ > 0) {
    log_->line(fmt::format("{}: {} of {} runs to do, {} at a time -> {}", options_.case_path.string(),
                           to_run_, jobs_.size(), at_a_time, options_.output.string()));
  }
  while (!waiting_.empty() || children_.running() > 0) {
    if (StopSignals::requested() && !stopping_) {
      stopping_ = true;
      waiting_.clear();
      children_.stop();
    }
    while (!waiting_.empty() && children_.running() < static_cast<std::size_t>(at_a_time)) start_next();
    report_progress(false);
    for (const ChildProcesses::Ended& ended : children_.wait(100)) take_in(ended);
    if (!options_.only && seconds_since(saved_) > 1.0) {
      saved_ = Clock::now();
      if (disk_trouble_.empty()) write_manifest("running");
    }
  }
  result_.interrupted = stopping_;
  if (!options_.only) share_results();
  if (to_run_ > 0) report_progress(true);
  log_->clear_status();
  try {
    if (!options_.only) write_manifest(end_status());
  } catch (const IoError& error) {
    if (disk_trouble_.empty()) disk_trouble_ = error.what();
  }
  if (!disk_trouble_.empty())
    throw IoError(
        fmt::format("{}; the same command again goes on from here, finished runs are kept", disk_trouble_));
  return std::move(result_);
}

}  // namespace

std::string_view name_of(JobStatus status) noexcept {
  switch (status) {
    case JobStatus::missing:
      return "missing";
    case JobStatus::completed:
      return "completed";
    case JobStatus::failed:
      return "failed";
    case JobStatus::interrupted:
      return "interrupted";
  }
  return {};
}

int BatchResult::exit_code() const noexcept {
  if (interrupted) return static_cast<int>(ExitCode::interrupted);
  for (const JobResult& job : jobs)
    if (job.status == JobStatus::failed) return job.exit_code;
  return static_cast<int>(count(JobStatus::interrupted) > 0 ? ExitCode::interrupted : ExitCode::ok);
}

std::size_t BatchResult::count(JobStatus status) const noexcept {
  return static_cast<std::size_t>(std::ranges::count(jobs, status, &JobResult::status));
}

std::vector<PreparedJob> prepare_jobs(const fs::path& case_path, std::span<const Job> jobs) {
  std::vector<PreparedJob> prepared;
  std::set<std::string> names;
  std::vector<std::pair<std::string, std::vector<std::string>>> problems;  // what, and where
  for (const Job& job : jobs) {
    if (!names.insert(job.name).second) throw InputError(fmt::format("two runs are called '{}'", job.name));
    try {
      io::Case read = io::load_single_run(case_path, job.overrides);
      const std::uint64_t hash = io::inputs_hash(read.setup);
      prepared.push_back({job, std::move(read.setup), hash});
    } catch (const io::CaseError& error) {
      const auto known = std::ranges::find(problems, error.what(), &decltype(problems)::value_type::first);
      if (known == problems.end())
        problems.push_back({error.what(), {job.name}});
      else
        known->second.push_back(job.name);
    }
  }
  if (problems.empty()) return prepared;
  std::string text;
  constexpr std::size_t kShown = 10;
  for (std::size_t i = 0; i < std::min(kShown, problems.size()); ++i) {
    const auto& [what, where] = problems[i];
    text += fmt::format("{}{} {}:\n{}", i == 0 ? "" : "\n",
                        where.size() == jobs.size() ? "every run, from"
                        : where.size() == 1         ? "run"
                                                    : "runs",
                        where.size() == jobs.size() ? fmt::format("'{}' on", where.front()) : some_of(where),
                        what);
  }
  if (problems.size() > kShown) text += fmt::format("\n… and {} more", problems.size() - kShown);
  throw InputError(text);
}

BatchResult run_batch(const BatchOptions& options, std::span<const PreparedJob> jobs) {
  return Batch(options, jobs).run();
}

BatchResult run_batch(const BatchOptions& options, std::span<const Job> jobs) {
  const std::vector<PreparedJob> prepared = prepare_jobs(options.case_path, jobs);
  return run_batch(options, prepared);
}

}  // namespace abradem::cli
