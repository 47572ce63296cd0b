// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "abradem/analysis/revolution_row.h"
#include "abradem/analysis/statistics.h"
#include "abradem/io/csv.h"
#include "abradem/io/groove_tables.h"
#include "abradem/io/normality_table.h"
#include "abradem/io/vtp.h"
#include "abradem/io/wall_tables.h"
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
  /// How far the record has come: what a run that goes on needs to add to it without losing or doubling a
  /// row.
  struct State {
    WearTablePositions tables;
    GrooveTablePositions groove_tables;
    WallTablePositions wall_tables;
    std::uint64_t force_table = 0, normality_table = 0, particle_table = 0;  ///< bytes
    analysis::RunningStatistics normal_force;
    std::vector<PvdEntry> frames;
    int frame = 0;
    std::uint64_t outputs_until = 0;  ///< step of the last output
    simulation::Ledger ledger;
    std::optional<analysis::RevolutionRow> last;

    template <typename Self, typename Archive>
    static void visit(Self& self, Archive& archive) {
      archive("tables", self.tables)("groove_tables", self.groove_tables);
      archive("wall_tables", self.wall_tables)("force_table", self.force_table);
      archive("normality_table", self.normality_table)("particle_table", self.particle_table);
      archive("normal_force", self.normal_force);
      archive("frames", self.frames)("frame", self.frame)("outputs_until", self.outputs_until);
      archive("ledger", self.ledger)("last", self.last);
    }
  };

  /// Attaches itself to the simulation's steps; must outlive them. @throws IoError
  RunRecorder(simulation::Simulation& run, std::filesystem::path folder);
  /// Goes on with the record of a run that has been put back: rows and frames after `state` are dropped.
  /// @throws IoError when the folder holds less than that
  RunRecorder(simulation::Simulation& run, std::filesystem::path folder, State state);

  /// One output: a row of every table and, where they are asked for, a frame. @throws IoError
  /// @param last no other follows
  void output(bool last);
  /// Is an output due at this step that has not been made?
  [[nodiscard]] bool output_due() const noexcept;
  [[nodiscard]] State state() const;
  /// Brings all rows onto the disk. @throws IoError
  void sync();
  /// Completes the tables; also what a failed or interrupted run has. @throws IoError
  void close();

  [[nodiscard]] const std::optional<analysis::RevolutionRow>& last() const noexcept { return state_.last; }
  [[nodiscard]] const simulation::Ledger& ledger() const noexcept { return state_.ledger; }

 private:
  void observe(const simulation::Simulation& run);
  [[nodiscard]] std::vector<analysis::Contour> cut_contours() const;
  static void keep_some_profiles(std::vector<analysis::Contour>& contours);
  void write_frame();
  void write_spheres(const std::filesystem::path& path) const;
  void write_clumps(const std::filesystem::path& path) const;
  void write_particles();

  simulation::Simulation& run_;
  std::filesystem::path folder_;
  std::optional<std::size_t> worn_wall_;
  std::size_t watched_particle_ = 0;
  std::uint64_t force_stride_ = 1;
  State state_;  // its table positions: where the record was taken up
  WearTables tables_;
  GrooveTables groove_;
  WallTables loads_;
  std::optional<NormalityTable> normality_;
  CsvWriter force_;
  std::optional<CsvWriter> particles_;                  // where particles come in numbers
  std::vector<std::optional<VtpTriangles>> triangles_;  // of each wall, once it has a frame
};

}  // namespace abradem::io
