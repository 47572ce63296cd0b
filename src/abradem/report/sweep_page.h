// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "abradem/report/page.h"
#include "abradem/report/sweep_table.h"

namespace abradem::report {

/// What stands above the figures.
struct SweepSummary {
  std::string title;     ///< of the case
  std::string design;    ///< "a grid of 2 keys", "a Latin hypercube of 3 keys, seed 1"
  std::string command;   ///< of the program that made it; may be empty
  double seconds = 0.0;  ///< of all runs together
};

/// Each result against each factor, and all runs in a table. Runs without results appear in the table alone.
[[nodiscard]] Page sweep_page(const SweepSummary& summary, const SweepTable& table);

/// Each result against each factor: one figure per result, one panel per factor.
/// @param id_prefix goes before the figures' ids, for pages that show several sweeps
[[nodiscard]] std::vector<Figure> main_effects(const SweepTable& table, const std::string& id_prefix = {});
/// All runs, their values and their main results.
[[nodiscard]] DataTable runs_table(const SweepTable& table, const std::string& id = "runs");

}  // namespace abradem::report
