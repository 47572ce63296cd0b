// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace abradem::test {

/// A comma-separated table: lines that begin with # are skipped, then one line of names, then the rows. Names
/// may be quoted.
class Table {
 public:
  explicit Table(const std::string& file) {
    std::ifstream in(std::string(ABRADEM_SOURCE_DIR) + "/tests/verification/data/" + file);
    if (!in) throw std::runtime_error("cannot read " + file);
    for (std::string line; std::getline(in, line);) {
      if (line.empty() || line[0] == '#') continue;
      if (names_.empty())
        names_ = split(line);
      else
        rows_.push_back(split(line));
    }
  }
  [[nodiscard]] std::size_t rows() const { return rows_.size(); }
  [[nodiscard]] std::string text(std::size_t row, const std::string& column) const {
    return rows_.at(row).at(index(column));
  }
  [[nodiscard]] double number(std::size_t row, const std::string& column) const {
    return std::stod(text(row, column));
  }
  [[nodiscard]] std::vector<double> numbers(const std::string& column) const {
    std::vector<double> values;
    for (std::size_t r = 0; r < rows(); ++r) values.push_back(number(r, column));
    return values;
  }

 private:
  [[nodiscard]] std::size_t index(const std::string& column) const {
    const auto found = std::ranges::find(names_, column);
    if (found == names_.end()) throw std::runtime_error("no column " + column);
    return static_cast<std::size_t>(found - names_.begin());
  }
  static std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> fields{""};
    bool quoted = false;
    for (const char c : line) {
      if (c == '"')
        quoted = !quoted;
      else if (c == ',' && !quoted)
        fields.emplace_back();
      else if (c != '\r')
        fields.back() += c;
    }
    return fields;
  }
  std::vector<std::string> names_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace abradem::test
