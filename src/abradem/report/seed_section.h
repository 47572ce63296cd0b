// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "abradem/report/page.h"
#include "abradem/report/sweep_table.h"

namespace abradem::report {

/// How much the verdicts on normality owe to the seed of the mesh: for a sweep that varies run.seed, the tests on
/// the sections of the last output of every run, and the revolution from which the paper's rule takes the wear for
/// steady. Runs that differ in other keys as well are kept apart.        docs/theory/statistics.md#the-seed
/// Nothing where run.seed does not vary, or fewer than two completed runs differ in it alone.
/// @throws IoError when a table of a completed run is damaged
[[nodiscard]] std::optional<PageSection> seed_section(const SweepTable& table, const std::vector<SweepRun>& runs);

}  // namespace abradem::report
