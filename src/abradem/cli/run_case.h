// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "abradem/cli/progress.h"
#include "abradem/io/run_record.h"
#include "abradem/io/run_recorder.h"
#include "abradem/simulation/setup.h"

namespace abradem::cli {

/// A run that is about to start: the case has been read and found good.
struct RunOptions {
  simulation::Setup setup;
  std::filesystem::path case_path;  ///< as given by the user, for messages and the record
  std::string case_text;            ///< the case file, byte for byte
  std::string resolved_text;        ///< every key with its value, overrides included
  std::filesystem::path output;     ///< folder for everything that comes out
  bool force = false;               ///< an earlier run in that folder may be replaced
  bool quiet = false;               ///< no progress, only warnings and errors
  bool json = false;                ///< run.json to stdout at the end
  bool report = true;               ///< make report.html at the end
  int threads = 0;                  ///< 0: as many as the machine has
};

/// Runs the case and writes its folder. @return the exit code
/// @throws InputError when the folder may not be used; IoError when it cannot be written
int run_case(const RunOptions& options);

/// A run that can be stepped on: its folder is there, its recorder attached.
struct CarryOut {
  std::filesystem::path folder;
  std::string resolved_text;  ///< the case, for checkpoints
  io::RunRecord record;       ///< what is known of it so far; its seconds are those of earlier parts
  bool report = true, json = false;
};
/// Steps it to its end, with outputs and checkpoints, and writes its record. @return the exit code
int carry_out(simulation::Simulation& run, io::RunRecorder& recorder, RunLog& log, const CarryOut& how);
/// Walls, steps and limits, as lines of the log.
void announce_run(const simulation::Simulation& run, RunLog& log);

}  // namespace abradem::cli
