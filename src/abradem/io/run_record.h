// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "abradem/analysis/revolution_row.h"
#include "abradem/simulation/simulation.h"
#include "abradem/study/acceleration.h"

namespace abradem::io {

/// The record of a run, as it stands in run.json. Keys: docs/reference/output.md.
struct RunRecord {
  std::string status = "completed";  ///< running, completed, interrupted or failed
  int exit_code = 0;
  std::string error;  ///< message of a failed run
  int threads = 1;
  double wall_seconds = 0.0;      ///< of the whole run, output included
  double stepping_seconds = 0.0;  ///< of the steps alone
  std::uint64_t steps = 0;
  std::uint64_t state_hash = 0;
  std::uint64_t inputs_hash = 0;  ///< inputs_hash() of the setup
  simulation::Ledger ledger;
  std::optional<analysis::RevolutionRow> last;
  /// What each wall lost, in the order of the case.
  struct Wall {
    std::string name;
    bool by_laws = false;          ///< does any wall wear by another law than Archard's?
    wear::MechanismVolumes law{};  ///< [m^3]
    std::uint64_t impacts = 0;
    std::optional<double> thickness = {};  ///< of the liner [m]
  };
  std::vector<Wall> walls;
  std::vector<simulation::StabilityLimit> limits;
  std::vector<std::string> warnings;
  std::optional<study::AccelerationChoice> acceleration;  ///< where the case left it to be chosen
  int resumed = 0;                                        ///< how often the run was taken up again
  std::string checkpoint;  ///< file of the last one, relative to the folder; empty: none
  std::uint64_t checkpoint_steps = 0;
};

/// What the tables' column `revolution` counts: "revolution" or "cycle" of the first wall that turns or
/// oscillates, "output" where none does.
[[nodiscard]] std::string counted(const simulation::Setup& setup);

/// Hash of all that decides about a run's results but the program itself: every key of the resolved case and
/// the bytes of the mesh files it names. A file that cannot be read counts as empty.
[[nodiscard]] std::uint64_t inputs_hash(const simulation::Setup& setup);

/// Puts down what each wall lost.
void record_walls(RunRecord& record, const simulation::Simulation& run);

/// The record as JSON text.
[[nodiscard]] std::string to_json(const RunRecord& record, const simulation::Setup& setup);

}  // namespace abradem::io
