// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
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

/// How far the tables have come, in bytes of each.
struct WearTablePositions {
  std::uint64_t revolutions = 0, contours = 0, profiles = 0;

  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("revolutions", self.revolutions)("contours", self.contours)("profiles", self.profiles);
  }
};

/// revolutions.csv, contours.csv and profiles.csv of one wall. They grow with the run.
class WearTables {
 public:
  /// @param folder exists   @param from what to keep of tables that are there
  /// @throws IoError when a file cannot be created, or holds less than that
  explicit WearTables(const std::filesystem::path& folder, const WearTablePositions& from = {});

  /// One output: its row, and its contours (cut around an axis) as measures and as polylines.   @throws
  /// IoError
  void add(const analysis::RevolutionRow& row, std::span<const analysis::Contour> contours);

  [[nodiscard]] WearTablePositions positions() const noexcept;
  /// Brings all rows into the files.   @throws IoError
  void flush();
  /// … and the files onto the disk.
  void sync();
  /// @throws IoError
  void close();

 private:
  CsvWriter revolutions_, contours_, profiles_;
};

}  // namespace abradem::io
