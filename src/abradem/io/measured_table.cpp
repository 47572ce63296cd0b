// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/measured_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

#include "abradem/core/error.h"
#include "abradem/core/suggest.h"
#include "abradem/core/text.h"
#include "abradem/io/csv.h"

namespace abradem::io {

namespace {

using core::trimmed;

/// "mm3" and "N/mm2" as units are written in names of columns: a number behind a letter is a power.
std::string with_powers(std::string_view unit) {
  std::string out;
  for (const char c : unit) {
    if (std::isdigit(static_cast<unsigned char>(c)) != 0 && !out.empty() &&
        std::isalpha(static_cast<unsigned char>(out.back())) != 0)
      out += '^';
    out += c;
  }
  return out;
}

bool is_unit(const std::string& text) {
  try {
    return !text.empty() && (text == "-" || core::parse_unit(text).numerator > 0.0);
  } catch (const core::UnitError&) {
    return false;
  }
}

/// Name (lower case, _ for spaces) and unit of a header field.
std::pair<std::string, std::string> name_and_unit(std::string_view field) {
  std::string_view name = field;
  std::string unit;
  for (const char* brackets : {"[]", "()"}) {
    const std::size_t open = field.find(brackets[0]);
    if (open == std::string_view::npos || field.back() != brackets[1]) continue;
    unit = with_powers(trimmed(field.substr(open + 1, field.size() - open - 2)));
    name = trimmed(field.substr(0, open));
  }
  // "velocity_x_m_per_s": m/s, as our own tables have it.
  constexpr std::string_view kPer = "_per_";
  const std::size_t per = name.rfind(kPer);
  if (const std::size_t bar = name.rfind('_', per == std::string_view::npos ? per : per - 1);
      unit.empty() && bar != std::string_view::npos && bar > 0 && per != 0) {
    std::string end = with_powers(name.substr(bar + 1, per == std::string_view::npos ? per : per - bar - 1));
    if (per != std::string_view::npos) end.append("/").append(with_powers(name.substr(per + kPer.size())));
    if (is_unit(end)) {
      unit = std::move(end);
      name = name.substr(0, bar);
    }
  }
  std::string plain(name);
  for (char& c : plain) c = c == ' ' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return {plain, unit};
}

/// The separator that the header has: the first of these that occurs in it.
char separator_of(std::string_view header) noexcept {
  for (const char c : {'\t', ';', ','})
    if (header.find(c) != std::string_view::npos) return c;
  return ',';
}

}  // namespace

MeasuredTable::MeasuredTable(const std::filesystem::path& path) : file_(path.string()) {
  std::string text = read_csv_text(path);
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);  // a byte order mark, as spreadsheets write
  std::size_t number = 0;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t end = std::min(text.find('\n', from), text.size());
    const std::string line = text.substr(from, end - from);
    from = end + 1;
    ++number;
    const std::string_view content = trimmed(line);
    if (content.empty() || content.front() == '#') continue;
    if (header_.empty()) {
      read_header(line, number);
      continue;
    }
    std::vector<Field> fields = split(line, number);
    if (fields.size() != header_.size())
      throw IoError(fmt::format("{}:{}: {} field{} where the header names {} columns", file_, number,
                                fields.size(), fields.size() == 1 ? "" : "s", header_.size()));
    fields_.push_back(std::move(fields));
    lines_.push_back(number);
  }
  if (header_.empty())
    throw IoError(fmt::format("{}: empty; expected a line that names the columns, then the rows", file_));
}

std::vector<MeasuredTable::Field> MeasuredTable::split(const std::string& line, std::size_t number) const {
  std::vector<Field> fields;
  const std::size_t end = line.size() - (line.ends_with('\r') ? 1 : 0);
  for (std::size_t i = 0;;) {
    while (i < end && (line[i] == ' ' || (line[i] == '\t' && separator_ != '\t'))) ++i;
    Field field{.text = {}, .column = i + 1};
    if (i < end && line[i] == '"') {
      for (++i; i < end && (line[i] != '"' || (i + 1 < end && line[i + 1] == '"')); ++i) {
        field.text += line[i];
        if (line[i] == '"') ++i;
      }
      if (i >= end)
        throw IoError(
            fmt::format("{}:{}:{}: the quote that begins here does not end", file_, number, field.column));
      i = std::min(line.find(separator_, i), end);
    } else {
      const std::size_t to = std::min(line.find(separator_, i), end);
      field.text = trimmed(std::string_view(line).substr(i, to - i));
      i = to;
    }
    fields.push_back(std::move(field));
    if (i >= end) return fields;
    ++i;
  }
}

void MeasuredTable::read_header(const std::string& line, std::size_t number) {
  separator_ = separator_of(line);
  header_line_ = number;
  for (const Field& field : split(line, number)) {
    if (field.text.empty())
      throw IoError(fmt::format("{}:{}:{}: a column without a name", file_, number, field.column));
    auto [name, unit] = name_and_unit(field.text);
    if (std::ranges::find(header_, field.text) != header_.end())
      throw IoError(
          fmt::format("{}:{}:{}: column '{}' is there twice", file_, number, field.column, field.text));
    header_.push_back(field.text);
    header_columns_.push_back(field.column);
    names_.push_back(std::move(name));
    units_.push_back(std::move(unit));
  }
}

std::optional<std::size_t> MeasuredTable::find(std::span<const std::string_view> names) const {
  std::optional<std::size_t> found;
  for (std::size_t c = 0; c < names_.size(); ++c) {
    if (std::ranges::find(names, names_[c]) == names.end()) continue;
    if (found)
      throw IoError(fmt::format("{}:{}:{}: '{}' and '{}' are both the {}; leave one", file_, header_line_,
                                header_columns_[c], header_[*found], header_[c], names.front()));
    found = c;
  }
  return found;
}

std::size_t MeasuredTable::require(std::span<const std::string_view> names,
                                   const core::Dimension& dimension) const {
  const std::optional<std::size_t> found = find(names);
  if (found) return *found;
  const std::vector<std::string_view> known(names_.begin(), names_.end());
  const std::string near = core::nearest_spelling(names.front(), known);
  const std::string_view example = core::example(dimension);
  const std::string unit(example.empty() ? "" : example.substr(example.find(' ') + 1));
  throw IoError(fmt::format(
      "{}:{}: no column '{}'{}; the header has: {}{}", file_, header_line_, names.front(),
      dimension == core::Dimension{} ? ""
                                     : fmt::format(" with its unit, as in '{} [{}]'", names.front(), unit),
      fmt::join(header_, ", "), near.empty() ? "" : fmt::format("; is it '{}'?", near)));
}

std::vector<double> MeasuredTable::quantities(std::span<const std::string_view> names,
                                              const core::Dimension& dimension, bool gaps) const {
  const std::size_t c = require(names, dimension);
  const auto in_header = [&](const std::string& what) {
    return IoError(
        fmt::format("{}:{}:{}: column '{}' {}", file_, header_line_, header_columns_[c], header_[c], what));
  };
  core::Unit unit;
  if (units_[c].empty() && dimension != core::Dimension{})
    throw in_header(fmt::format("has no unit; write {}, as in '{} [{}]'", core::describe(dimension),
                                header_[c], core::si_unit(dimension)));
  if (!units_[c].empty() && units_[c] != "-") try {
      unit = core::parse_unit(units_[c]);
    } catch (const core::UnitError& error) {
      throw in_header(fmt::format("has the unit '{}': {}", units_[c], error.what()));
    }
  if (unit.dimension != dimension)
    throw in_header(fmt::format("is in '{}'; {} is expected", units_[c], core::describe(dimension)));
  std::vector<double> values;
  for (std::size_t r = 0; r < rows(); ++r) {
    const std::string& text = fields_[r][c].text;
    if (gaps && text == "nan") {
      values.push_back(std::numeric_limits<double>::quiet_NaN());
      continue;
    }
    double number = 0.0;
    const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
    const auto [stop, code] = std::from_chars(begin, text.data() + text.size(), number);
    if (code != std::errc{} || stop != text.data() + text.size() || !std::isfinite(number))
      throw IoError(at(r, c,
                       fmt::format("column '{}': '{}' is not a number; expected digits with a decimal point, "
                                   "such as 0.0081",
                                   header_[c], text.substr(0, 40))));
    values.push_back(unit.exponent >= 0
                         ? number * unit.numerator / unit.denominator * std::pow(10.0, unit.exponent)
                         : number * unit.numerator / unit.denominator / std::pow(10.0, -unit.exponent));
  }
  return values;
}

std::vector<std::string> MeasuredTable::texts(std::span<const std::string_view> names) const {
  const std::size_t c = require(names, {});
  std::vector<std::string> out;
  for (const std::vector<Field>& row : fields_) out.push_back(row[c].text);
  return out;
}

std::string MeasuredTable::at(std::size_t row, std::size_t column, std::string_view what) const {
  return fmt::format("{}:{}:{}: {}", file_, lines_.at(row), fields_.at(row).at(column).column, what);
}

}  // namespace abradem::io
