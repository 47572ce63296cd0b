// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <span>

#include "abradem/analysis/contour.h"
#include "abradem/io/csv.h"
#include "abradem/simulation/simulation.h"

/// What a run that ploughs or wears its pins writes besides: tables/ridges.csv, tables/tip.csv,
/// tables/tip_profile.csv and vtk/tip_NAME.vtp.                                  docs/reference/output.md
namespace abradem::io {

class GrooveTables {
 public:
  /// @param folder of the run; tables/ exists   @throws IoError
  GrooveTables(const simulation::Simulation& run, std::filesystem::path folder);
  /// One output. @param contours with all their profiles
  void add(const simulation::Simulation& run, const simulation::Ledger& ledger, double revolution,
           std::span<const analysis::Contour> contours);
  /// Completes the tables and writes each tip as it is: its surface and its sections through the middle.
  void close(const simulation::Simulation& run);

 private:
  std::filesystem::path folder_;
  std::optional<CsvWriter> ridges_, tips_;
};

}  // namespace abradem::io
