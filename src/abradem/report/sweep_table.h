// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "abradem/study/design.h"

/// The table of many runs, one row each.                              docs/reference/sweep.md#summarycsv
namespace abradem::report {

/// What one run of a sweep was given, and where it is.
struct SweepRun {
  std::string name, status;
  std::vector<std::string> values;  ///< of each factor, as written
  std::filesystem::path folder;
  std::string message = {};  ///< why it failed
};

/// A column of text, and of numbers where every field is one.
struct SweepColumn {
  std::string title;              ///< with the unit: "wall.disc.mesh.size [mm]", "depth_mean_mm"
  std::vector<std::string> text;  ///< one field per run
  std::vector<double> number;     ///< the same as numbers; empty for words and vectors; NaN: none
  bool logarithmic = false;       ///< a factor that spans more than a decade in even ratios
};

struct SweepTable {
  std::vector<std::string> names, status, messages;
  std::vector<SweepColumn> factors;
  std::vector<SweepColumn>
      results;  ///< the last row of each run's revolutions.csv, kappa, steps; of particles
};

/// Reads each run's run.json. A run without one, or that did not come to its first output, has nan in its
/// results. Nothing in the table depends on where, when or in which order the runs were made.
[[nodiscard]] SweepTable make_sweep_table(const std::vector<std::string>& keys,
                                          const std::vector<SweepRun>& runs);

/// One header line, one line per run. Fields with a comma, a quote or a line break are quoted.
[[nodiscard]] std::string to_csv(const SweepTable& table);

}  // namespace abradem::report
