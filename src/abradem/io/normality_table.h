// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "abradem/analysis/contour.h"
#include "abradem/analysis/groove_statistics.h"
#include "abradem/io/csv.h"

namespace abradem::io {

/// Columns of normality.csv: revolution, then those of `depth_` and of `width_`.
///                                                            docs/reference/output.md#normalitycsv
[[nodiscard]] std::vector<std::string> normality_columns();
/// The columns of one quantity, in their order.
[[nodiscard]] std::vector<double> normality_values(const analysis::SectionStatistics& statistics);

/// normality.csv: the tests of normality on the sections' depths and widths, one row per output.
class NormalityTable {
 public:
  /// @param ends how the sections follow each other   @param from bytes to keep of a table that is there
  /// @throws IoError when the file cannot be created, or holds less than that
  NormalityTable(const std::filesystem::path& folder, analysis::Ends ends, std::uint64_t from = 0);
  /// @throws IoError
  void add(double revolution, std::span<const analysis::Contour> contours);
  [[nodiscard]] std::uint64_t position() const noexcept { return table_.position(); }
  /// Brings all rows into the file.   @throws IoError
  void flush() { table_.flush(); }
  /// … and the file onto the disk.
  void sync() { table_.sync(); }
  /// @throws IoError
  void close() { table_.close(); }

 private:
  analysis::Ends ends_;
  CsvWriter table_;
};

}  // namespace abradem::io
