// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/cli/run_case.h"

#include <fmt/core.h>
#include <omp.h>

#include <algorithm>
#include <chrono>

#include "abradem/analysis/wall_contours.h"
#include "abradem/cli/checkpointing.h"
#include "abradem/cli/mesh_loader.h"
#include "abradem/cli/output_folder.h"
#include "abradem/cli/path_lock.h"
#include "abradem/cli/print.h"
#include "abradem/cli/progress.h"
#include "abradem/cli/stop_signals.h"
#include "abradem/core/error.h"
#include "abradem/io/atomic_file.h"
#include "abradem/io/case_file.h"
#include "abradem/io/case_motions.h"
#include "abradem/io/insertion_files.h"
#include "abradem/io/placement.h"
#include "abradem/io/run_record.h"
#include "abradem/io/run_recorder.h"
#include "abradem/report/report.h"
#include "abradem/study/acceleration.h"

namespace abradem::cli {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using simulation::Simulation;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double modelled_end(const Simulation& run) {
  return static_cast<double>(run.total_steps()) * run.time_step();
}

void announce(const Simulation& run, RunLog& log) {
  for (const simulation::Wall& wall : run.walls())
    if (!wall.is_plane())
      log.line(fmt::format("wall '{}': {} triangles, mean edge {:.4g} mm", wall.setup().name,
                           wall.surface().mesh().triangle_count(),
                           1e3 * geometry::mean_edge_length(wall.surface().mesh())));
  for (const simulation::ShapeSetup& shape : run.setup().shapes)
    log.line(fmt::format("shape '{}': {}", shape.name, io::shape_text(shape)));
  for (const simulation::InsertionSetup& i : run.setup().insertions)
    if (!i.volume.run.empty())
      log.line(
          fmt::format("insertion '{}': {} particles as left by '{}'", i.name, i.placed.size(), i.volume.run));
  if (!run.setup().insertions.empty())
    log.line(fmt::format("{} particles in numbers at the start", run.bulk_state().present));
  log.line(fmt::format("{} steps of {:.4g} s, {} per output", run.total_steps(), run.time_step(),
                       run.steps_per_output()));
  if (run.settle_time() > 0.0)
    log.line(fmt::format("the flow settles for {:.4g} s, in which nothing wears", run.settle_time()));
  if (run.acceleration() > 1.0)
    log.line(fmt::format("{:.4g} s are modelled{}, each for {:.4g} s of the test",
                         modelled_end(run) - run.settle_time(), run.settle_time() > 0.0 ? " then" : "",
                         run.acceleration()));
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

/// Steps to the end, with an output whenever one is due. A checkpoint is of the moment before an output: what
/// goes on from it makes the output again. @return false when a signal ended it early
bool run_to_end(Simulation& run, io::RunRecorder& recorder, Checkpoints& checkpoints, Progress& progress,
                double& stepping_seconds) {
  while (!run.finished() || recorder.output_due()) {
    if (!recorder.output_due()) {
      const Stopwatch stopwatch(stepping_seconds);
      run.advance([&] {
        progress.update(run);
        checkpoints.look();
        return !StopSignals::requested();
      });
    }
    const bool stop = StopSignals::requested();
    if (run.finished() || stop)
      checkpoints.save(false);
    else
      checkpoints.look();
    if (recorder.output_due() || stop) {
      recorder.output(run.finished() || stop);
      progress.output(run, recorder);
    }
    if (stop && !run.finished()) return false;
  }
  return true;
}

void run_steps(Simulation& run, io::RunRecorder& recorder, Checkpoints& checkpoints, RunLog& log,
               io::RunRecord& record) {
  Progress progress(log);
  try {
    if (!run_to_end(run, recorder, checkpoints, progress, record.stepping_seconds)) {
      record.status = "interrupted";
      record.exit_code = static_cast<int>(ExitCode::interrupted);
    }
  } catch (const SimulationError& e) {
    // What was computed up to the last output stays; the state that failed is not a result.
    record.status = "failed";
    record.exit_code = static_cast<int>(ExitCode::unphysical);
    record.error = e.what();
    checkpoints.save_last_good();
  }
  progress.finish();
}

/// What a groove of few triangles is worth, or nothing where it has enough.  docs/theory/meshes.md#how-fine
std::string coarse_groove(const Simulation& run, const analysis::RevolutionRow& row) {
  constexpr double kEnough = 5.0, kAdvised = 8.0;  // triangles across the groove
  constexpr double kClear = 1e-6;                  // [m]; a shallower groove has no width yet
  const auto wall = analysis::worn_wall(run.walls());
  // Sections say something of one groove, not of what a stream of particles wears.
  if (!wall || !(row.depth_mean >= kClear) || !run.setup().insertions.empty()) return {};
  const double edge = geometry::mean_edge_length(run.walls()[*wall].surface().mesh());
  if (row.width_mean >= kEnough * edge) return {};
  return fmt::format(
      "the groove is {:.1f} triangles wide, fewer than {:g}: its depth comes out too low and its width too "
      "large. Make the triangles of wall '{}' smaller until it is {:g} wide",
      row.width_mean / edge, kEnough, run.walls()[*wall].setup().name, kAdvised);
}

/// Streams that dry up while each second stands for many.
void warn_of_dry_streams(const Simulation& run, io::RunRecord& record, RunLog& log) {
  if (!(run.acceleration() > 1.0) || !run.bulk()) return;
  for (const simulation::Inserter& inserter : run.bulk()->inserters()) {
    const simulation::InsertionSetup& i = inserter.setup();
    if (!i.mass_rate || !i.mass) continue;
    const double until = i.start + *i.mass / *i.mass_rate;
    if (until >= modelled_end(run)) continue;
    record.warnings.push_back(
        fmt::format("insertion '{}' ends after {:.4g} s, and {:.4g} s are modelled, each for {:.4g} s of the "
                    "test: the wear is that of a stream that dries up. Give it more mass",
                    i.name, until, modelled_end(run), run.acceleration()));
    log.warning(record.warnings.back());
  }
}

void complete_record(io::RunRecord& record, const Simulation& run, const io::RunRecorder& recorder,
                     RunLog& log) {
  record.steps = run.steps();
  record.state_hash = run.state_hash();
  record.ledger = recorder.ledger();
  record.last = recorder.last();
  io::record_walls(record, run);
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
  if (record.ledger.residual > run.ledger_tolerance(record.ledger))
    warn(fmt::format("the ledger does not close: residual {:.3g}", record.ledger.residual));
  for (const simulation::WearSetup& wear : run.setup().wear)
    if (std::ranges::none_of(run.setup().walls,
                             [&](const auto& wall) { return wall.material == wear.worn; }) &&
        std::ranges::none_of(run.setup().particles, [&](const auto& particle) {
          return particle.material == wear.worn && particle.guide != simulation::Guide::none;
        }))
      warn(
          fmt::format("[wear.\"{}/{}\"] has no effect: no wall is made of {}, and only guided particles wear",
                      wear.abrader, wear.worn, wear.worn));
  if (record.ledger.tip_residual > run.ledger_tolerance(record.ledger))
    warn(fmt::format("the pin's ledger does not close: residual {:.3g}", record.ledger.tip_residual));
  if (record.status == "completed" && run.law_volume() == 0.0 && run.plane_volume() == 0.0 &&
      (run.wears_by_laws() ||
       std::ranges::any_of(run.setup().wear, [](const auto& wear) { return wear.wear_coefficient > 0.0; })))
    warn("a wear coefficient is given, but nothing was worn: does a wall slide under a particle?");
  if (record.last)
    if (std::string coarse = coarse_groove(run, *record.last); !coarse.empty()) warn(std::move(coarse));
}

/// The disk is full or gone, or memory, in the middle of a run: says so in the manifest, if that can still be
/// written.
void try_to_record_failure(io::RunRecord& record, const fs::path& folder, const Simulation& run,
                           const Error& error) noexcept {
  try {
    record.status = "failed";
    record.exit_code = static_cast<int>(error.code());
    record.error = error.what();
    record.steps = run.steps();
    record.state_hash = run.state_hash();
    io::write_file_atomically(folder / "run.json", io::to_json(record, run.setup()));
  } catch (...) {
    // The first error is the one to be told.
  }
}

/// A length of what is modelled.
std::string_view unit_of(const study::AccelerationChoice& choice) {
  return choice.in_revolutions ? "revolutions" : "s";
}
std::string modelled(double length, const study::AccelerationChoice& choice) {
  return fmt::format("{:.4g} {}", length, unit_of(choice));
}

/// A comparison of two trials as a line of the log.
std::string trial_text(const study::AccelerationTrial& trial, const study::AccelerationChoice& choice) {
  const std::string fine = modelled(trial.modelled, choice), coarse = modelled(0.5 * trial.modelled, choice);
  if (!trial.difference)
    return fmt::format("acceleration: {} cannot be compared with {}: {}", fine, coarse, trial.failure);
  if (!choice.by_maps)
    return fmt::format("acceleration: {}, profile differs by {:.3g} % from {}", fine,
                       100.0 * *trial.difference, coarse);
  std::string text = fmt::format(
      "acceleration: {}, depths differ by {:.3g} % from {}, the volume by {:.2g} %: {}", fine,
      100.0 * *trial.difference, coarse, 100.0 * trial.volume_difference, study::what_limits(trial));
  if (*trial.difference >= choice.tolerance)
    text += fmt::format(". {:.2g} % will take about {:.2g} {}", 100.0 * choice.tolerance,
                        study::length_for(trial, choice.tolerance), unit_of(choice));
  return text;
}

/// Finds how many revolutions or seconds stand for those of the test, and says so.
study::AccelerationChoice choose_acceleration(const simulation::Setup& setup, RunLog& log) {
  std::optional<Progress> progress;
  std::uint64_t steps = 0;
  const auto watch = [&](const Simulation& trial) {
    if (!progress || trial.steps() < steps) progress.emplace(log, "trial: ");
    steps = trial.steps();
    progress->update(trial);
    return !StopSignals::requested();
  };
  study::AccelerationChoice choice = study::choose_acceleration(
      setup, MeshLoader(setup), watch,
      [&](const study::AccelerationTrial& trial, const study::AccelerationChoice& so_far) {
        log.line(trial_text(trial, so_far));
      });
  if (choice.factor > 1.0)
    log.line(
        fmt::format("acceleration: {}, each for {:.4g} of the test; error accepted {:.2g} % of the {}, "
                    "tolerance {:.2g} %",
                    modelled(choice.modelled, choice), choice.factor, 100.0 * choice.error,
                    choice.by_maps ? "depths" : "profile", 100.0 * choice.tolerance));
  else
    log.line(
        fmt::format("acceleration: {}; all of the test, {}, is modelled",
                    choice.trials.empty() ? "the test is too short for one" : "none keeps to the tolerance",
                    modelled(choice.modelled, choice)));
  return choice;
}

}  // namespace

int carry_out(Simulation& run, io::RunRecorder& recorder, RunLog& log, const CarryOut& how) {
  io::RunRecord record = how.record;
  record.threads = omp_get_max_threads();
  std::string json;
  try {
    warn_of_dry_streams(run, record, log);
    Checkpoints checkpoints(how.folder, run, recorder, record, log, inputs_of(run, how.resolved_text));
    run_steps(run, recorder, checkpoints, log, record);
    recorder.close();
    complete_record(record, run, recorder, log);
    record.wall_seconds = checkpoints.seconds();
    json = io::to_json(record, run.setup());
    io::write_file_atomically(how.folder / "run.json", json);
    if (how.report) report::write_report(how.folder);
  } catch (const IoError& error) {
    try_to_record_failure(record, how.folder, run, error);
    throw;
  } catch (const std::bad_alloc&) {
    try_to_record_failure(record, how.folder, run, Error(ExitCode::internal, "out of memory"));
    throw;
  }

  summarise(record, log);
  if (record.status != "completed" && !record.checkpoint.empty())
    log.line(fmt::format("{}: step {} in {}; `abradem resume {}` goes on from it",
                         record.status == "failed" ? "last good state" : "checkpoint",
                         record.checkpoint_steps, record.checkpoint, how.folder.string()));
  if (how.report) log.line(fmt::format("report: {}", (how.folder / "report.html").string()));
  if (how.json) print_result(json);
  return record.exit_code;
}

void announce_run(const Simulation& run, RunLog& log) {
  announce(run, log);
  report_limits(run.limits(), log, nullptr);
}

int run_case(const RunOptions& options) {
  const Clock::time_point start = Clock::now();
  if (options.threads > 0) omp_set_num_threads(options.threads);
  // Everything that can be refused is refused before the folder exists.
  CarryOut how{.folder = options.output,
               .resolved_text = options.resolved_text,
               .record = {},
               .report = options.report,
               .json = options.json};
  simulation::Setup given = options.setup;
  const std::vector<std::string> notes = io::read_insertion_files(given);
  io::read_motion_files(given);
  simulation::Setup setup = given;
  const bool choose = study::wants_acceleration(setup);
  if (choose) setup = study::accelerated(setup, 1.0);
  Simulation run(setup, MeshLoader(setup));
  io::refuse_misplaced_particles(run);
  how.record.inputs_hash =
      io::inputs_hash(options.setup);  // reads the meshes, which may be refused for their size

  const StopSignals signals;
  OutputFolder folder(options.output, options.force);
  // First, for it tells the folder of a run from others, whatever ends the run from here on.
  io::write_file_atomically(options.output / "case.resolved.toml", how.resolved_text);
  io::write_file_atomically(options.output / "case.toml", options.case_text);
  RunLog log(options.output / "run.log", options.quiet);
  const PathLock lock(options.output / "run.log", PathLock::Kind::exclusive);
  log.line(fmt::format("{} -> {}", options.case_path.string(), options.output.string()));
  for (const std::string& note : notes) log.line(note);
  if (choose) {
    how.record.acceleration = choose_acceleration(given, log);
    setup = study::accelerated(setup, how.record.acceleration->factor);
    run = Simulation(setup, MeshLoader(setup));
    how.resolved_text = io::resolved_case(setup);
    io::write_file_atomically(options.output / "case.resolved.toml", how.resolved_text);
  }
  announce_run(run, log);
  io::RunRecorder recorder(run, options.output);
  folder.keep();
  how.record.wall_seconds = seconds_since(start);
  return carry_out(run, recorder, log, how);
}

}  // namespace abradem::cli
