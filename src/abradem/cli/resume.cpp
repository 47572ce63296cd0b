// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>
#include <omp.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "abradem/cli/checkpointing.h"
#include "abradem/cli/commands.h"
#include "abradem/cli/mesh_loader.h"
#include "abradem/cli/output_folder.h"
#include "abradem/cli/path_lock.h"
#include "abradem/cli/print.h"
#include "abradem/cli/run_case.h"
#include "abradem/cli/stop_signals.h"
#include "abradem/core/archive.h"
#include "abradem/core/error.h"
#include "abradem/core/version.h"
#include "abradem/io/atomic_file.h"
#include "abradem/io/case_file.h"
#include "abradem/io/case_motions.h"
#include "abradem/io/checkpoint.h"
#include "abradem/io/insertion_files.h"
#include "abradem/report/manifest.h"

namespace abradem::cli {
namespace {

namespace fs = std::filesystem;
using simulation::Simulation;

/// The case of a run with what may be changed on the way.
struct ChangedCase {
  simulation::Setup setup;
  std::string text;  ///< resolved
  bool changed = false;
};

ChangedCase change(const std::string& resolved, const fs::path& folder,
                   const std::vector<std::string>& overrides) {
  const std::string name = (folder / "case.resolved.toml").string();
  const simulation::Setup before = io::parse_case(resolved, name, folder, {}, io::NamedFiles::kept).setup;
  ChangedCase now{io::parse_case(resolved, name, folder, overrides, io::NamedFiles::kept).setup, resolved,
                  false};
  simulation::Setup same = now.setup;
  same.run.end = before.run.end;
  same.output.checkpoint_every = before.output.checkpoint_every;
  if (same != before)
    throw InputError(
        "a run that goes on can change run.end and output.checkpoint_every, nothing else; for another case "
        "start a new run");
  now.changed = now.setup != before;
  if (now.changed) now.text = io::resolved_case(now.setup);
  return now;
}

/// A run put back, with its recorder.
struct Resumed {
  CarryOut how;
  ChangedCase changed;
  std::unique_ptr<Simulation> run;
  std::unique_ptr<io::RunRecorder> recorder;
};

/// @throws IoError when the checkpoint does not fit this program, or the folder not the checkpoint
Resumed put_back(const io::Checkpoint& checkpoint, const fs::path& folder,
                 const std::vector<std::string>& overrides) {
  core::ArchiveReader archive(checkpoint.state);
  RunInputs inputs;
  RunInputs::visit(inputs, archive);
  RunState state;
  RunState::visit(state, archive);

  Resumed resumed;
  resumed.changed = change(inputs.resolved_case, folder, overrides);
  auto mesh = inputs.meshes.begin();
  const auto next_mesh = [&](const simulation::MeshSetup&, std::uint64_t) -> geometry::TriangleMesh {
    archive.require(mesh != inputs.meshes.end(), "comes after too few meshes");
    for (const geometry::Triangle& t : mesh->triangles)
      for (const geometry::Index v : t)
        archive.require(v >= 0 && v < mesh->vertex_count(), "comes after a mesh that is none");
    return *mesh++;
  };
  simulation::Setup setup = resumed.changed.setup;
  archive.require(inputs.shapes.size() == setup.shapes.size(), "comes after other shapes");
  for (std::size_t i = 0; i < setup.shapes.size(); ++i) {
    if (!setup.shapes[i].fit) continue;
    setup.shapes[i].fit->fit = inputs.shapes[i].fit;
    setup.shapes[i].fit->solid = inputs.shapes[i].solid;
  }
  setup = simulation::clumps_in_numbers(std::move(setup));  // as the run has them
  archive.require(inputs.insertions.size() == setup.insertions.size(), "comes after other insertions");
  for (std::size_t i = 0; i < setup.insertions.size(); ++i) {
    setup.insertions[i].placed = inputs.insertions[i].placed;
    setup.insertions[i].turns = inputs.insertions[i].turns;
    archive.require(setup.insertions[i].turns.empty() ||
                        setup.insertions[i].turns.size() == setup.insertions[i].placed.size(),
                    "comes after turns of other particles");
    setup.insertions[i].size.radii = inputs.insertions[i].radii;
    setup.insertions[i].size.shares = inputs.insertions[i].shares;
  }
  archive.require(inputs.motions.size() == setup.walls.size(), "comes after other walls");
  for (std::size_t w = 0; w < setup.walls.size(); ++w) {
    simulation::WallSetup& wall = setup.walls[w];
    archive.require(inputs.motions[w].size() == wall.motions(), "comes after other motions");
    wall.motion.rows = inputs.motions[w][0];
    for (std::size_t k = 1; k < wall.motions(); ++k) wall.carried_by[k - 1].rows = inputs.motions[w][k];
  }
  resumed.run = std::make_unique<Simulation>(setup, next_mesh);
  resumed.run->load(archive);
  archive.require(archive.at_end(), "should be the last");
  if (resumed.run->total_steps() < resumed.run->steps())
    throw InputError("run.end lies before the step at which the run would be taken up");
  resumed.recorder = std::make_unique<io::RunRecorder>(*resumed.run, folder, state.recorder);

  io::RunRecord& record = resumed.how.record;
  record.wall_seconds = state.wall_seconds;
  record.stepping_seconds = state.stepping_seconds;
  record.resumed = state.resumed + 1;
  record.acceleration = state.acceleration;
  record.inputs_hash =
      resumed.changed.changed ? io::inputs_hash(resumed.changed.setup) : checkpoint.inputs_hash;
  return resumed;
}

/// From the newest checkpoint that fits; those that do not are named. Nothing where there is no checkpoint.
std::optional<Resumed> from_checkpoint(const fs::path& folder, const std::vector<std::string>& overrides,
                                       RunLog& log) {
  std::vector<std::string> refused;
  for (const fs::path& file : io::checkpoint_files(folder)) {
    try {
      const io::Checkpoint checkpoint = io::read_checkpoint(file);
      const bool other = checkpoint.version != core::version() || checkpoint.commit != core::commit();
      const std::string by = fmt::format("abradem {} ({})", checkpoint.version, checkpoint.commit);
      std::optional<Resumed> resumed;
      try {
        resumed = put_back(checkpoint, folder, overrides);
      } catch (const IoError& why) {
        throw IoError(fmt::format("checkpoint '{}'{}: {}", file.string(),
                                  other ? fmt::format(", which {} wrote and this program, abradem {} ({}), "
                                                      "does not understand",
                                                      by, core::version(), core::commit())
                                        : "",
                                  why.what()));
      }
      for (const std::string& line : refused) log.warning(line);
      if (other)
        log.warning(
            fmt::format("the checkpoint was written by {}: results may differ from those of a run "
                        "that was never stopped",
                        by));
      log.line(fmt::format("going on from step {} ({})", checkpoint.steps, file.string()));
      // Later ones were passed over: they are of no use, and must not be taken for newer than what follows.
      for (const fs::path& later : io::checkpoint_files(folder))
        if (later > file) fs::remove(later);
      return resumed;
    } catch (const IoError& why) {
      refused.emplace_back(why.what());
    }
  }
  if (refused.empty()) return std::nullopt;
  std::string text;
  for (const std::string& line : refused) text += (text.empty() ? "" : "\n") + line;
  throw IoError(text);
}

/// The run was ended before its first checkpoint: from its beginning.
Resumed from_start(const fs::path& folder, const std::vector<std::string>& overrides, RunLog& log) {
  log.line("there is no checkpoint: from the beginning");
  Resumed resumed;
  resumed.changed = change(read_file(folder / "case.resolved.toml"), folder, overrides);
  simulation::Setup setup = resumed.changed.setup;
  io::read_insertion_files(setup);
  io::read_motion_files(setup);
  resumed.run = std::make_unique<Simulation>(setup, MeshLoader(setup));
  resumed.recorder = std::make_unique<io::RunRecorder>(*resumed.run, folder);
  resumed.how.record.inputs_hash = io::inputs_hash(resumed.changed.setup);
  resumed.how.record.resumed = 1;
  return resumed;
}

void refuse_other_folders(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(folder / "batch.json", error))
    throw InputError(
        fmt::format("'{}' holds many runs; the command that made it goes on with them when it "
                    "is given again",
                    folder.string()));
  if (!fs::is_regular_file(folder / "case.resolved.toml", error))
    throw InputError(
        fmt::format("'{}' is not the folder of a run: it has no case.resolved.toml", folder.string()));
}

}  // namespace

int resume_command(const ResumeArguments& arguments) {
  const fs::path folder = arguments.folder;
  refuse_other_folders(folder);
  if (arguments.threads > 0) omp_set_num_threads(arguments.threads);
  const StopSignals signals;
  const PathLock lock(folder / "run.log", PathLock::Kind::exclusive);
  report::Manifest before;
  std::error_code error;
  if (fs::exists(folder / "run.json", error)) before = report::read_manifest(folder / "run.json");
  if (before.status == "completed" &&
      !change(read_file(folder / "case.resolved.toml"), folder, arguments.overrides).changed) {
    if (!arguments.quiet)
      print_message(fmt::format("'{}' is complete; --set run.end=… lets it go on further", folder.string()));
    if (arguments.json) print_result(read_file(folder / "run.json"));
    return static_cast<int>(ExitCode::ok);
  }

  for (const char* part : {".", "tables", "vtk", "restart"}) io::remove_temporaries(folder / part);
  RunLog log(folder / "run.log", arguments.quiet, true);
  if (before.status == "failed" && before.exit_code == static_cast<int>(ExitCode::unphysical))
    log.warning("the run had gone unphysical, and with the same case it will again: " + before.error);
  std::optional<Resumed> resumed = from_checkpoint(folder, arguments.overrides, log);
  if (!resumed) resumed = from_start(folder, arguments.overrides, log);
  if (resumed->changed.changed)
    io::write_file_atomically(folder / "case.resolved.toml", resumed->changed.text);
  announce_run(*resumed->run, log);
  resumed->how.folder = folder;
  resumed->how.resolved_text = resumed->changed.text;
  resumed->how.report = !arguments.no_report;
  resumed->how.json = arguments.json;
  return carry_out(*resumed->run, *resumed->recorder, log, resumed->how);
}

}  // namespace abradem::cli
