// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

#include "abradem/analysis/contour.h"
#include "abradem/io/csv.h"
#include "abradem/simulation/simulation.h"

/// What a run that ploughs or wears its pins writes besides: tables/ridges.csv, tables/tip.csv,
/// tables/tip_profile.csv and vtk/tip_NAME.vtp.                                  docs/reference/output.md
namespace abradem::io {

/// How far the tables have come, in bytes of each.
struct GrooveTablePositions {
  std::uint64_t ridges = 0, tips = 0;

  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("ridges", self.ridges)("tips", self.tips);
  }
};

class GrooveTables {
 public:
  /// @param folder of the run; tables/ exists   @param from what to keep of tables that are there
  /// @throws IoError
  GrooveTables(const simulation::Simulation& run, std::filesystem::path folder,
               const GrooveTablePositions& from = {});
  /// One output. @param contours with all their profiles
  void add(const simulation::Simulation& run, const simulation::Ledger& ledger, double revolution,
           std::span<const analysis::Contour> contours);
  [[nodiscard]] GrooveTablePositions positions() const noexcept;
  /// Brings all rows into the files.   @throws IoError
  void flush();
  /// … and the files onto the disk.
  void sync();
  /// Completes the tables and writes each tip as it is: its surface and its sections through the middle.
  void close(const simulation::Simulation& run);

 private:
  std::filesystem::path folder_;
  std::optional<CsvWriter> ridges_, tips_;
};

}  // namespace abradem::io
