// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "abradem/analysis/contour.h"

namespace abradem::io {

/// A section as a table holds it.
struct ReadSection {
  std::string name;         ///< where it came from: file, and what tells it from the others there
  double revolution = 0.0;  ///< NaN where the table has none
  double angle = 0.0;       ///< [rad]; NaN where the table has none
  std::vector<analysis::ProfilePoint> profile;  ///< by ascending radius
};

/// Reads sections of a groove, one point per row.                    docs/reference/analyse.md#the-table
/// Columns, with their units: radius (or x, position, distance); height (or z); where there are several
/// sections revolution, angle, section, by which rows of one section follow each other. A run's
/// tables/profiles.csv is such a table.
/// @throws IoError with file, line and column for what is missing, no number, or out of order
[[nodiscard]] std::vector<ReadSection> read_profiles(const std::filesystem::path& path);

}  // namespace abradem::io
