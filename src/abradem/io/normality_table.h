// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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
  /// @param ends how the sections follow each other   @throws IoError when the file cannot be created
  NormalityTable(const std::filesystem::path& folder, analysis::Ends ends);
  /// @throws IoError
  void add(double revolution, std::span<const analysis::Contour> contours);
  /// @throws IoError
  void close() { table_.close(); }

 private:
  analysis::Ends ends_;
  CsvWriter table_;
};

}  // namespace abradem::io
