// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/cli/checkpointing.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "abradem/cli/stop_signals.h"
#include "abradem/core/archive.h"
#include "abradem/core/error.h"
#include "abradem/core/version.h"
#include "abradem/io/atomic_file.h"

namespace abradem::cli {

namespace {

double between(std::chrono::steady_clock::time_point from, std::chrono::steady_clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

}  // namespace

RunInputs inputs_of(const simulation::Simulation& run, std::string resolved_case) {
  RunInputs inputs{std::move(resolved_case), {}, {}, {}, {}};
  for (const simulation::Wall& wall : run.walls())
    if (!wall.is_plane())
      inputs.meshes.push_back({{wall.surface().reference().begin(), wall.surface().reference().end()},
                               wall.surface().mesh().triangles});
  for (const simulation::InsertionSetup& i : run.setup().insertions)
    inputs.insertions.push_back({i.placed, i.turns, i.size.radii, i.size.shares});
  for (const simulation::ShapeSetup& shape : run.setup().shapes)
    inputs.shapes.push_back(shape.fit ? ShapeInputs{shape.fit->fit, shape.fit->solid} : ShapeInputs{});
  for (const simulation::WallSetup& wall : run.setup().walls) {
    auto& tables = inputs.motions.emplace_back();
    for (std::size_t k = 0; k < wall.motions(); ++k) tables.push_back(wall.motion_at(k).rows);
  }
  return inputs;
}

Checkpoints::Checkpoints(std::filesystem::path folder, const simulation::Simulation& run,
                         io::RunRecorder& recorder, io::RunRecord& record, RunLog& log,
                         const RunInputs& inputs)
    : folder_(std::move(folder)),
      run_(run),
      recorder_(recorder),
      record_(record),
      log_(log),
      earlier_seconds_(record.wall_seconds) {
  core::ArchiveWriter archive;
  RunInputs::visit(inputs, archive);
  inputs_ = archive.take();
  note();
}

double Checkpoints::seconds() const { return earlier_seconds_ + between(start_, Clock::now()); }

void Checkpoints::note() {
  const Clock::time_point begin = Clock::now();
  core::ArchiveWriter archive;
  const RunState state{seconds(), record_.stepping_seconds, record_.resumed, record_.acceleration,
                       recorder_.state()};
  RunState::visit(state, archive);
  run_.save(archive);
  copy_ = {core::version(), core::commit(), record_.inputs_hash, run_.steps(), inputs_ + archive.bytes()};
  noted_ = Clock::now();
  cost_ = between(begin, noted_);
}

/// The copy becomes a file, and run.json says so.
void Checkpoints::write(bool running) {
  recorder_.sync();
  const std::filesystem::path file = io::write_checkpoint(folder_, copy_);
  saved_steps_ = copy_.steps;
  record_.checkpoint = file.lexically_relative(folder_).generic_string();
  record_.checkpoint_steps = copy_.steps;
  if (!running) return;
  io::RunRecord now = record_;
  now.status = "running";
  now.wall_seconds = seconds();
  now.steps = run_.steps();
  now.state_hash = run_.state_hash();
  now.ledger = recorder_.ledger();
  now.last = recorder_.last();
  now.limits = run_.limits();
  io::write_file_atomically(folder_ / "run.json", io::to_json(now, run_.setup()));
}

bool Checkpoints::save(bool running) {
  saved_ = Clock::now();
  try {
    note();
    write(running);
    return true;
  } catch (const IoError& error) {
    log_.warning(fmt::format("no checkpoint was written: {}; the run goes on", error.what()));
  } catch (const std::bad_alloc&) {
    log_.warning("no checkpoint was written: out of memory; the run goes on");
  }
  return false;
}

void Checkpoints::look() {
  constexpr double kShortest = 1.0, kShare = 0.01;  // of the time goes into copies in memory
  const Clock::time_point now = Clock::now();
  const double every = run_.setup().output.checkpoint_every;
  if (StopSignals::take_checkpoint_request()) {
    if (save()) log_.line(fmt::format("checkpoint of step {}, as asked for", run_.steps()));
  } else if (every > 0.0 && between(saved_, now) >= every) {
    if (save()) log_.record(fmt::format("checkpoint of step {}", run_.steps()));
  } else if (between(noted_, now) >= std::max(kShortest, cost_ / kShare)) {
    note();
  }
}

void Checkpoints::save_last_good() noexcept {
  try {
    if (copy_.steps != saved_steps_) write(false);
  } catch (const std::exception& error) {
    log_.warning(fmt::format("the last good state could not be kept: {}", error.what()));
  }
}

}  // namespace abradem::cli
