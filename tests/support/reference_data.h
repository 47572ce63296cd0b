// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

/// Reference numbers from tests/verification/data, and the errors measured against them.
namespace abradem::test {

inline std::string data_file(const std::string& name) {
  return std::string(ABRADEM_SOURCE_DIR) + "/tests/verification/data/" + name;
}

using ReferenceRow = std::map<std::string, std::string>;  ///< cells by column name

/// The rows of a comma-separated table: '#' comments, a header, then cells.
inline std::vector<ReferenceRow> reference_rows(const std::string& name) {
  std::ifstream in(data_file(name));
  if (!in) throw std::runtime_error("cannot read " + data_file(name));
  std::vector<std::string> header;
  std::vector<ReferenceRow> rows;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::vector<std::string> cells;
    std::stringstream cut(line);
    for (std::string cell; std::getline(cut, cell, ',');) cells.push_back(cell);
    if (header.empty()) {
      header = cells;
      continue;
    }
    cells.resize(header.size());
    ReferenceRow row;
    for (std::size_t i = 0; i < header.size(); ++i) row[header[i]] = cells[i];
    rows.push_back(row);
  }
  return rows;
}

inline double relative_error(double value, double reference) { return std::abs(value / reference - 1.0); }

/// The largest error of a kind. Written into the test's record (`--gtest_output=xml`), where the numbers of
/// docs/verification/particles.md come from.
class WorstError {
 public:
  explicit WorstError(std::string name) : name_(std::move(name)) {}
  WorstError(const WorstError&) = delete;
  WorstError& operator=(const WorstError&) = delete;
  ~WorstError() {
    std::ostringstream text;
    text << worst_;
    testing::Test::RecordProperty(name_, text.str());
  }
  /// Notes an error and returns it. NaN is as bad as can be.
  double note(double error) {
    if (!(error <= worst_)) worst_ = error;
    return error;
  }

 private:
  std::string name_;
  double worst_ = 0.0;
};

}  // namespace abradem::test
