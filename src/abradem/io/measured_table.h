// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "abradem/core/units.h"

/// Tables that a person, a spreadsheet or an instrument wrote: what `analyse` and `calibrate` read.
///                                                                     docs/reference/measured-tables.md
namespace abradem::io {

/// A header line that names the columns with their units, then one line per row. Commas, semicolons or tabs
/// separate; a point is the decimal mark; lines that begin with # and empty lines are passed over; fields may
/// be quoted. A column is looked up by its name without the unit: "force_N", "force [N]" and "Force (N)" are
/// all "force".
class MeasuredTable {
 public:
  /// @throws IoError with file, line and column when there is no such file, no header, a column twice or
  /// without a name, a row of another length, or a quote that does not end
  explicit MeasuredTable(const std::filesystem::path& path);

  [[nodiscard]] const std::string& file() const noexcept { return file_; }
  [[nodiscard]] std::size_t rows() const noexcept { return lines_.size(); }
  [[nodiscard]] std::size_t line(std::size_t row) const { return lines_.at(row); }
  [[nodiscard]] const std::vector<std::string>& header() const noexcept { return header_; }

  /// Number of the column that has one of these names; nothing where there is none.
  /// @throws IoError when two columns have one
  [[nodiscard]] std::optional<std::size_t> find(std::span<const std::string_view> names) const;

  /// The column's values in SI units.
  /// @param names of which the column has one   @param dimension that its unit must have
  /// @param gaps may a field be "nan", as our tables have what does not exist? Then it is NaN.
  /// @throws IoError when there is no such column, its unit is missing or of another dimension, or a field is
  /// not one finite number
  [[nodiscard]] std::vector<double> quantities(std::span<const std::string_view> names,
                                               const core::Dimension& dimension, bool gaps = false) const;
  /// The column's fields as they stand, without the quotes.   @throws IoError when there is no such column
  [[nodiscard]] std::vector<std::string> texts(std::span<const std::string_view> names) const;

  /// "file:line:column: what", the place being that of a field.
  [[nodiscard]] std::string at(std::size_t row, std::size_t column, std::string_view what) const;

 private:
  struct Field {
    std::string text;
    std::size_t column = 1;  ///< of its first character in its line, from 1
  };
  [[nodiscard]] std::vector<Field> split(const std::string& line, std::size_t number) const;
  void read_header(const std::string& line, std::size_t number);
  [[nodiscard]] std::size_t require(std::span<const std::string_view> names,
                                    const core::Dimension& dimension) const;

  std::string file_;
  char separator_ = ',';
  std::size_t header_line_ = 0;
  std::vector<std::string> header_, names_, units_;  ///< as written; its name and its unit ("" without)
  std::vector<std::size_t> header_columns_;
  std::vector<std::vector<Field>> fields_;
  std::vector<std::size_t> lines_;
};

}  // namespace abradem::io
