// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "abradem/io/csv.h"
#include "abradem/simulation/simulation.h"

/// What each wall bears and loses: tables/walls.csv, and where one wears by another law than Archard's
/// tables/wear_by_law.csv, tables/impacts.csv and tables/erosion.csv.          docs/reference/output.md
namespace abradem::io {

/// How far the tables have come, in bytes of each.
struct WallTablePositions {
  std::uint64_t loads = 0, laws = 0;

  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("loads", self.loads)("laws", self.laws);
  }
};

/// Walls are numbered from 0, in the order of the case.
class WallTables {
 public:
  /// @param folder of the run; tables/ exists   @param from what to keep of tables that are there
  /// @throws IoError
  WallTables(const simulation::Simulation& run, const std::filesystem::path& folder,
             const WallTablePositions& from = {});
  /// Is a row of loads due at this step?
  [[nodiscard]] bool due(std::uint64_t step) const noexcept { return step % stride_ == 0; }
  /// A row of loads for every wall.
  void add_loads(const simulation::Simulation& run, double revolution);
  /// One output.
  void add(const simulation::Simulation& run, double revolution);
  [[nodiscard]] WallTablePositions positions() const noexcept;
  /// Brings all rows into the files.   @throws IoError
  void flush();
  /// … and the files onto the disk.
  void sync();
  /// Completes the tables and writes those of the end.   @throws IoError
  void close(const simulation::Simulation& run);

 private:
  std::filesystem::path tables_;
  std::uint64_t stride_ = 1;
  CsvWriter loads_;
  std::optional<CsvWriter> laws_;
};

}  // namespace abradem::io
