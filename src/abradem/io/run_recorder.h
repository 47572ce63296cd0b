// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "abradem/analysis/revolution_row.h"
#include "abradem/analysis/statistics.h"
#include "abradem/io/csv.h"
#include "abradem/io/vtp.h"
#include "abradem/io/wear_tables.h"
#include "abradem/simulation/simulation.h"

namespace abradem::io {

/// Writes a run's tables and frames while it goes: revolutions, contours, profiles and force in tables/, a
/// frame of each wall and of the particles per output in vtk/, and the index series.pvd.
/// docs/reference/output.md
///
/// The first wall that deforms is the one whose contours are cut; the first particle with a load, else the
/// first, the one whose forces are recorded.
class RunRecorder {
 public:
  /// Attaches itself to the simulation's steps; must outlive them. @throws IoError
  RunRecorder(simulation::Simulation& run, std::filesystem::path folder);

  /// One output: a row of every table and, where they are asked for, a frame. @throws IoError
  /// @param last no other follows
  void output(bool last);
  /// Completes the tables; also what a failed or interrupted run has. @throws IoError
  void close();

  [[nodiscard]] const std::optional<analysis::RevolutionRow>& last() const noexcept { return last_; }
  [[nodiscard]] const simulation::Ledger& ledger() const noexcept { return ledger_; }

 private:
  void observe(const simulation::Simulation& run);
  [[nodiscard]] std::vector<analysis::Contour> cut_contours() const;
  void write_frame();
  void write_spheres(const std::filesystem::path& path) const;
  void write_bulk();
  void write_elements() const;

  simulation::Simulation& run_;
  std::filesystem::path folder_;
  std::optional<std::size_t> worn_wall_;
  std::size_t watched_particle_ = 0;
  std::uint64_t force_stride_ = 1;
  WearTables tables_;
  CsvWriter force_;
  std::optional<CsvWriter> bulk_;
  analysis::RunningStatistics normal_force_;
  std::vector<PvdEntry> frames_;
  int frame_ = 0;
  simulation::Ledger ledger_;
  std::optional<analysis::RevolutionRow> last_;
};

}  // namespace abradem::io
