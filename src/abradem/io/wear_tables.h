// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "abradem/analysis/contour.h"
#include "abradem/analysis/revolution_row.h"
#include "abradem/io/csv.h"

/// The tables of a run's worn wall, in millimetres, newtons and degrees.   docs/reference/output.md
namespace abradem::io {

/// The columns of revolutions.csv, and a row's values in their order and units.
[[nodiscard]] const std::vector<std::string>& revolution_columns();
[[nodiscard]] std::array<double, 18> revolution_values(const analysis::RevolutionRow& row);

/// revolutions.csv, contours.csv and profiles.csv of one wall. They appear in the folder when closed, each
/// whole.
class WearTables {
 public:
  /// @param folder exists   @throws IoError when a file cannot be created
  explicit WearTables(const std::filesystem::path& folder);

  /// One output: its row, and its contours (cut around an axis) as measures and as polylines.   @throws
  /// IoError
  void add(const analysis::RevolutionRow& row, std::span<const analysis::Contour> contours);

  /// @throws IoError
  void close();

 private:
  CsvWriter revolutions_, contours_, profiles_;
};

}  // namespace abradem::io
