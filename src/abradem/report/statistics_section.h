// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "abradem/analysis/correlation.h"
#include "abradem/report/page.h"
#include "abradem/report/table.h"

/// What the statistics of a groove have to say, for a run's report and for measured profiles.
///                                                                                docs/theory/statistics.md
namespace abradem::report {

/// A groove from one output to the next. All arrays have one entry per output.
struct GrooveSeries {
  std::string counted = "revolution";  ///< what `revolutions` counts, for the axes
  std::vector<double> revolutions;
  std::vector<std::vector<double>> depths_mm, widths_mm;  ///< of the sections, in their order along the track
  analysis::Ends ends = analysis::Ends::joined;
  /// Radius of the track [mm], to state correlation lengths in mm; NaN: unknown or not round.
  double track_radius_mm = std::numeric_limits<double>::quiet_NaN();
  /// A sum that grows, such as a volume.
  struct Grown {
    std::string name, unit;
    std::vector<double> values;
  };
  std::vector<Grown> grown;
};

/// Depths and widths of each revolution of a table of sections, in the order of the table.
/// @param contours with revolution, depth_mm, width_mm
[[nodiscard]] GrooveSeries groove_series(const Table& contours);

/// Findings in words, the tests of normality per revolution on all and on independent sections, their
/// dependence on the number of bins, the correlation along the track, run-in, and fits of the increments. At
/// most 60 outputs, evenly spread, are looked at.
/// @param id goes before the ids of its tables and figures
[[nodiscard]] PageSection statistics_section(const GrooveSeries& series,
                                             const std::string& id = "statistics");

/// The findings alone.
[[nodiscard]] std::vector<std::string> statistics_findings(const GrooveSeries& series);

}  // namespace abradem::report
