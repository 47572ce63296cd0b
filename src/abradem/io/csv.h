// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Tables of numbers as comma-separated text: one header line, a point as decimal mark, lines end in \n.
/// A column's name ends with its unit (depth_mm); a dimensionless one has none. Numbers have the fewest
/// digits that read back to the same double; what does not exist is written nan.
namespace abradem::io {

/// Writes a table row by row. The rows go to a temporary file beside the target, which takes its name at
/// close(): a reader finds the old table or the whole new one. Without close() nothing stays behind.
///
/// A table that grows with a run stands under its own name from the start: whole rows are added to it, so
/// that a reader finds whole rows at any time, also after the program was killed.
class CsvWriter {
 public:
  /// A table that grows; `from`: bytes of it to keep, as position() gave them, or 0 to begin it anew.
  struct Growing {
    std::uint64_t from = 0;
  };
  /// @throws as the other; IoError also when the file is shorter than what is to be kept of it
  CsvWriter(std::filesystem::path path, std::vector<std::string> columns, Growing growing);

  /// @param columns names: not empty, unique, of letters, digits and _
  /// @throws InputError for other names, IoError when the file cannot be created
  CsvWriter(std::filesystem::path path, std::vector<std::string> columns);
  ~CsvWriter();
  CsvWriter(const CsvWriter&) = delete;
  CsvWriter& operator=(const CsvWriter&) = delete;

  /// @throws InputError when the number of values is not that of the columns, IoError when the disk is full
  void row(std::span<const double> values);
  void row(std::initializer_list<double> values) {
    row(std::span<const double>(values.begin(), values.size()));
  }
  /// Bytes of the table so far, rows not yet in the file included.
  [[nodiscard]] std::uint64_t position() const noexcept { return written_ + waiting_.size(); }
  /// A growing table: brings all rows into the file.   @throws IoError when the disk is full
  void flush();
  /// … and the file onto the disk.
  void sync();
  /// Completes the table. Call once, after which no row can follow.   @throws IoError
  void close();

 private:
  [[noreturn]] void fail(const char* doing, int error);
  void discard() noexcept;

  std::filesystem::path path_, temporary_;  // temporary_ is empty for a growing table
  std::vector<std::string> columns_;
  std::FILE* file_ = nullptr;
  std::string line_, waiting_;  // waiting_: whole rows
  std::uint64_t written_ = 0;
};

/// A whole table in memory.
struct CsvTable {
  std::vector<std::string> columns;
  std::vector<double> values;  ///< row by row

  [[nodiscard]] std::size_t rows() const noexcept {
    return columns.empty() ? 0 : values.size() / columns.size();
  }
  [[nodiscard]] std::span<const double> row(std::size_t r) const noexcept {
    return {values.data() + r * columns.size(), columns.size()};
  }
  /// One column's values.   @throws InputError listing the columns when there is none of that name
  [[nodiscard]] std::vector<double> column(std::string_view name) const;
};

/// The bytes of a file of numbers.   @throws IoError when there is none, or it cannot be read
[[nodiscard]] std::string read_csv_text(const std::filesystem::path& path);

/// Reads what CsvWriter writes, and refuses all else: no file, no header, names that CsvWriter refuses, a row
/// of another length, a field that is not one number, a last line without its end (a file cut short).
/// @throws IoError with file, line and column
[[nodiscard]] CsvTable read_csv(const std::filesystem::path& path);
/// The same from memory. @param name what messages call it
[[nodiscard]] CsvTable parse_csv(std::string_view text, const std::string& name);

}  // namespace abradem::io
