// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/cli/run_case.h"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <chrono>

#include "abradem/cli/mesh_loader.h"
#include "abradem/cli/output_folder.h"
#include "abradem/cli/print.h"
#include "abradem/cli/progress.h"
#include "abradem/cli/stop_signals.h"
#include "abradem/core/error.h"
#include "abradem/io/atomic_file.h"
#include "abradem/io/case_file.h"
#include "abradem/io/insertion_files.h"
#include "abradem/io/placement.h"
#include "abradem/io/run_record.h"
#include "abradem/io/run_recorder.h"
#include "abradem/report/report.h"
#include "abradem/study/acceleration.h"

namespace abradem::cli {

namespace {

using Clock = std::chrono::steady_clock;
using simulation::Simulation;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void announce(const Simulation& run, RunLog& log) {
  for (const simulation::Wall& wall : run.walls())
    if (!wall.is_plane())
      log.line(fmt::format("wall '{}': {} triangles, mean edge {:.4g} mm", wall.setup().name,
                           wall.surface().mesh().triangle_count(),
                           1e3 * geometry::mean_edge_length(wall.surface().mesh())));
  if (!run.setup().insertions.empty())
    log.line(fmt::format("{} particles in numbers at the start", run.bulk_state().present));
  log.line(fmt::format("{} steps of {:.4g} s, {} per output", run.total_steps(), run.time_step(),
                       run.steps_per_output()));
}

void report_limits(const std::vector<simulation::StabilityLimit>& limits, RunLog& log,
                   std::vector<std::string>* warnings) {
  for (const simulation::StabilityLimit& limit : limits) {
    log.line(fmt::format("stability: {} = {:.4g}, limit {:.4g}{}", limit.name, limit.value, limit.limit,
                         limit.ok() ? "" : "  EXCEEDED"));
    if (!limit.ok() && warnings != nullptr) {
      warnings->push_back(
          fmt::format("{} is {:.4g}, above its limit of {:.4g}: the contact may chatter; take a "
                      "shorter time_step",
                      limit.name, limit.value, limit.limit));
      log.warning(warnings->back());
    }
  }
}

/// Adds the time of its life to a sum, also when an exception ends it.
class Stopwatch {
 public:
  explicit Stopwatch(double& sum) : sum_(sum), start_(Clock::now()) {}
  ~Stopwatch() { sum_ += seconds_since(start_); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& sum_;
  Clock::time_point start_;
};

/// Steps to the end, with an output whenever one is due. @return false when a signal ended it early
bool run_to_end(Simulation& run, io::RunRecorder& recorder, Progress& progress, double& stepping_seconds) {
  while (!run.finished()) {
    bool due = false;
    {
      const Stopwatch stopwatch(stepping_seconds);
      due = run.advance([&] {
        progress.update(run);
        return !StopSignals::requested();
      });
    }
    if (due || StopSignals::requested()) {
      recorder.output(run.finished() || StopSignals::requested());
      progress.output(run, recorder);
    }
    if (StopSignals::requested() && !run.finished()) return false;
  }
  return true;
}

void run_steps(Simulation& run, io::RunRecorder& recorder, RunLog& log, io::RunRecord& record) {
  Progress progress(log);
  try {
    if (!run_to_end(run, recorder, progress, record.stepping_seconds)) {
      record.status = "interrupted";
      record.exit_code = static_cast<int>(ExitCode::interrupted);
    }
  } catch (const SimulationError& e) {
    // What was computed up to the last output stays; the state that failed is not a result.
    record.status = "failed";
    record.exit_code = static_cast<int>(ExitCode::unphysical);
    record.error = e.what();
  }
  progress.finish();
}

void complete_record(io::RunRecord& record, const Simulation& run, const io::RunRecorder& recorder,
                     RunLog& log) {
  record.steps = run.steps();
  record.state_hash = run.state_hash();
  record.ledger = recorder.ledger();
  record.last = recorder.last();
  record.limits = run.limits();
  report_limits(record.limits, log, &record.warnings);
  const auto warn = [&](std::string text) {
    log.warning(text);
    record.warnings.push_back(std::move(text));
  };
  if (run.bulk())
    for (const simulation::Inserter& inserter : run.bulk()->inserters())
      if (inserter.waiting())
        warn(fmt::format(
            "insertion '{}': its volume was full at the last try after {} particles; what comes in lags "
            "behind its mass_rate",
            inserter.setup().name, inserter.inserted()));
  if (record.ledger.residual > 1e-9)
    warn(fmt::format("the ledger does not close: residual {:.3g}", record.ledger.residual));
  for (const simulation::WearSetup& wear : run.setup().wear)
    if (std::ranges::none_of(run.setup().walls, [&](const auto& wall) { return wall.material == wear.worn; }))
      warn(fmt::format("[wear.\"{}/{}\"] has no effect: no wall is made of {}, and particles do not wear",
                       wear.abrader, wear.worn, wear.worn));
  if (record.status == "completed" && run.law_volume() == 0.0 &&
      std::ranges::any_of(run.setup().wear, [](const auto& wear) { return wear.wear_coefficient > 0.0; }))
    warn("a wear coefficient is given, but nothing was worn: does a wall slide under a particle?");
}

/// The disk is full or gone, in the middle of a run: says so in the manifest, if that can still be written.
void try_to_record_failure(io::RunRecord& record, const RunOptions& options, const Simulation& run,
                           const IoError& error) noexcept {
  try {
    record.status = "failed";
    record.exit_code = static_cast<int>(error.code());
    record.error = error.what();
    record.steps = run.steps();
    record.state_hash = run.state_hash();
    io::write_file_atomically(options.output / "run.json", io::to_json(record, options.setup));
  } catch (...) {
    // The first error is the one to be told.
  }
}

/// Finds how many revolutions stand for those of the test, and says so.
study::AccelerationChoice choose_acceleration(const simulation::Setup& setup, RunLog& log) {
  const study::AccelerationChoice choice = study::choose_acceleration(
      setup, MeshLoader(setup), [] { return !StopSignals::requested(); },
      [&](const study::AccelerationTrial& trial) {
        log.line(trial.difference
                     ? fmt::format("acceleration: {:g} revolutions, profile differs by {:.3g} % from {:g}",
                                   trial.revolutions, 100.0 * *trial.difference, 0.5 * trial.revolutions)
                     : fmt::format("acceleration: {:g} revolutions cannot be told from {:g}, which went "
                                   "unphysical",
                                   trial.revolutions, 0.5 * trial.revolutions));
      });
  log.line(choice.factor > 1.0
               ? fmt::format("acceleration: {:g} revolutions, each for {:.4g} of the test; error accepted "
                             "{:.2g} % of the profile, tolerance {:.2g} %",
                             choice.revolutions, choice.factor, 100.0 * choice.error,
                             100.0 * choice.tolerance)
               : std::string("acceleration: none keeps to the tolerance; every revolution is modelled"));
  return choice;
}

}  // namespace

int run_case(const RunOptions& options) {
  const Clock::time_point start = Clock::now();
  if (options.threads > 0) omp_set_num_threads(options.threads);
  // Everything that can be refused is refused before the folder exists.
  const std::uint64_t inputs_hash = io::inputs_hash(options.setup);
  simulation::Setup given = options.setup;
  io::read_insertion_files(given);
  simulation::Setup setup = given;
  const bool choose = study::wants_acceleration(setup);
  if (choose) setup = study::accelerated(setup, 1.0);
  Simulation run(setup, MeshLoader(setup));
  io::refuse_misplaced_particles(run);

  const StopSignals signals;
  OutputFolder folder(options.output, options.force);
  io::write_file_atomically(options.output / "case.toml", options.case_text);
  RunLog log(options.output / "run.log", options.quiet);
  log.line(fmt::format("{} -> {}", options.case_path.string(), options.output.string()));
  io::RunRecord record;
  if (choose) {
    record.acceleration = choose_acceleration(given, log);
    setup = study::accelerated(setup, record.acceleration->factor);
    run = Simulation(setup, MeshLoader(setup));
  }
  io::write_file_atomically(options.output / "case.resolved.toml",
                            choose ? io::resolved_case(setup) : options.resolved_text);
  announce(run, log);

  record.threads = omp_get_max_threads();
  record.inputs_hash = inputs_hash;
  report_limits(run.limits(), log, nullptr);
  io::RunRecorder recorder(run, options.output);
  folder.keep();
  std::string json;
  try {
    run_steps(run, recorder, log, record);
    recorder.close();
    complete_record(record, run, recorder, log);
    record.wall_seconds = seconds_since(start);
    json = io::to_json(record, setup);
    io::write_file_atomically(options.output / "run.json", json);
    if (options.report) report::write_report(options.output);
  } catch (const IoError& error) {
    try_to_record_failure(record, options, run, error);
    throw;
  }

  summarise(record, log);
  if (options.report) log.line(fmt::format("report: {}", (options.output / "report.html").string()));
  if (options.json) print_result(json);
  return record.exit_code;
}

}  // namespace abradem::cli
