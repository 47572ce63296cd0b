// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace abradem::report {

/// A table of numbers with named columns, as the CSV files of a run hold it; units are in the names.
struct Table {
  std::string file;  ///< where it came from, for messages
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;  ///< columns[c][row]; NaN where a field is empty

  [[nodiscard]] std::size_t rows() const noexcept { return columns.empty() ? 0 : columns.front().size(); }
  /// @throws IoError when there is no such column
  [[nodiscard]] const std::vector<double>& operator[](std::string_view name) const;
};

/// Reads a comma-separated file whose first line names the columns. Fields are numbers; an empty field or
/// "nan" is NaN. More columns than required are welcome, in any order. A last row without its end, of a run
/// that was killed, is left out.
/// @throws IoError when the file is missing or unreadable, a required column is missing, a row has another
///         number of fields than the header, or a field is not a number (with file, line and column)
[[nodiscard]] Table read_table(const std::filesystem::path& file, std::span<const std::string_view> required);

/// The rows listed, in that order.
[[nodiscard]] Table take_rows(const Table& table, std::span<const std::size_t> rows);

/// Keeps whole revolutions (column `revolution`), evenly spread and with the first and the last, so that at
/// most about max_rows rows remain (always at least two revolutions). Returns the table itself when it is
/// small.
[[nodiscard]] Table thin_revolutions(const Table& table, std::size_t max_rows);

/// Keeps every k-th row, so that at most max_rows remain.
[[nodiscard]] Table thin_rows(const Table& table, std::size_t max_rows);

/// The table as CSV with 7 significant digits; NaN as an empty field.
[[nodiscard]] std::string to_csv(const Table& table);

}  // namespace abradem::report
