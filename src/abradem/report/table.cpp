// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/report/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <numeric>

#include "abradem/core/error.h"
#include "abradem/core/text.h"

namespace abradem::report {
namespace {

using core::trimmed;

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> fields;
  for (std::size_t from = 0;;) {
    const std::size_t comma = line.find(',', from);
    fields.push_back(trimmed(line.substr(from, comma - from)));
    if (comma == std::string_view::npos) return fields;
    from = comma + 1;
  }
}

double number(std::string_view field, const Table& table, std::size_t line, std::size_t column) {
  if (field.empty()) return std::numeric_limits<double>::quiet_NaN();
  double value = 0.0;
  const auto [end, code] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (code != std::errc{} || end != field.data() + field.size()) {
    throw IoError(
        fmt::format("{}:{}: column '{}': '{}' is not a number; expected digits such as 0.0081, or nothing",
                    table.file, line, table.names[column], field.substr(0, 40)));
  }
  return value;
}

std::string read_text(const std::filesystem::path& file) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(file, code)) {
    throw IoError(
        fmt::format("{}: no such file; the report needs it, and every run writes it into its output folder",
                    file.string()));
  }
  std::ifstream stream(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!stream) throw IoError(fmt::format("{}: cannot be read; check its permissions", file.string()));
  return text;
}

void check_columns(const Table& table, std::span<const std::string_view> required) {
  for (const std::string_view name : required) {
    if (std::find(table.names.begin(), table.names.end(), name) == table.names.end()) {
      throw IoError(fmt::format("{}:1: column '{}' is missing; the header has: {}", table.file, name,
                                fmt::join(table.names, ", ")));
    }
  }
}

}  // namespace

const std::vector<double>& Table::operator[](std::string_view name) const {
  for (std::size_t c = 0; c < names.size(); ++c) {
    if (names[c] == name) return columns[c];
  }
  throw IoError(fmt::format("{}: no column '{}'; it has: {}", file, name, fmt::join(names, ", ")));
}

Table read_table(const std::filesystem::path& file, std::span<const std::string_view> required) {
  const std::string text = read_text(file);
  Table table;
  table.file = file.string();
  std::size_t line = 0;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t end = text.find('\n', from);
    // Killed while it was written: of half a number nothing can be said.
    if (end == std::string::npos && !table.names.empty()) break;
    const std::string_view content = trimmed(std::string_view(text).substr(from, end - from));
    from = end == std::string::npos ? text.size() : end + 1;
    ++line;
    if (content.empty()) continue;
    const auto fields = split(content);
    if (table.names.empty()) {
      table.names.assign(fields.begin(), fields.end());
      table.columns.resize(fields.size());
      check_columns(table, required);
      continue;
    }
    if (fields.size() != table.names.size()) {
      throw IoError(
          fmt::format("{}:{}: {} fields where the header names {}; was the run cut off while writing?",
                      table.file, line, fields.size(), table.names.size()));
    }
    for (std::size_t c = 0; c < fields.size(); ++c)
      table.columns[c].push_back(number(fields[c], table, line, c));
  }
  if (table.names.empty()) {
    throw IoError(fmt::format("{}: empty; expected a header with {}", table.file, fmt::join(required, ", ")));
  }
  return table;
}

Table take_rows(const Table& table, std::span<const std::size_t> rows) {
  Table out{table.file, table.names, std::vector<std::vector<double>>(table.columns.size())};
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    out.columns[c].reserve(rows.size());
    for (const std::size_t row : rows) out.columns[c].push_back(table.columns[c][row]);
  }
  return out;
}

Table thin_revolutions(const Table& table, std::size_t max_rows) {
  if (table.rows() <= max_rows) return table;
  const std::vector<double>& revolution = table["revolution"];
  std::vector<double> all = revolution;
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  const std::size_t wanted = std::clamp<std::size_t>(all.size() * max_rows / table.rows(),
                                                     std::min<std::size_t>(2, all.size()), all.size());
  std::vector<double> kept;
  for (std::size_t k = 0; k < wanted; ++k)
    kept.push_back(all[wanted > 1 ? k * (all.size() - 1) / (wanted - 1) : all.size() - 1]);
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < revolution.size(); ++row) {
    if (std::binary_search(kept.begin(), kept.end(), revolution[row])) rows.push_back(row);
  }
  return take_rows(table, rows);
}

Table thin_rows(const Table& table, std::size_t max_rows) {
  if (table.rows() <= max_rows) return table;
  const std::size_t every = (table.rows() + max_rows - 1) / max_rows;
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < table.rows(); row += every) rows.push_back(row);
  return take_rows(table, rows);
}

std::string to_csv(const Table& table) {
  fmt::memory_buffer out;
  fmt::format_to(std::back_inserter(out), "{}\n", fmt::join(table.names, ","));
  for (std::size_t row = 0; row < table.rows(); ++row) {
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      if (c > 0) out.push_back(',');
      const double value = table.columns[c][row];
      if (!std::isnan(value)) fmt::format_to(std::back_inserter(out), "{:.7g}", value);
    }
    out.push_back('\n');
  }
  return fmt::to_string(out);
}

}  // namespace abradem::report
