// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "abradem/simulation/setup.h"

/// The runs that a study's variations stand for.                docs/reference/case-file.md#studyvariation
namespace abradem::study {

/// One run of a study, by the place of its values in the variation's lists.
struct PlannedRun {
  std::string name;               ///< of its folder, by variation, "mesh_size/03"
  std::size_t variation = 0;      ///< of StudySetup::variations
  std::size_t together = 0;       ///< which of the values that go side by side
  std::vector<std::size_t> vary;  ///< which value of each crossed key
};

/// How many values go side by side: 1 where nothing does.
[[nodiscard]] std::size_t side_by_side(const simulation::VariationSetup& variation) noexcept;

/// How many runs a variation stands for; capped at `most` + 1, so that it cannot overflow.
[[nodiscard]] std::size_t count_runs(const simulation::VariationSetup& variation, std::size_t most) noexcept;

/// Every run, variation by variation: what goes together outermost, the last crossed key fastest.
[[nodiscard]] std::vector<PlannedRun> plan(const simulation::StudySetup& study);

/// The keys by which a run differs from the others of its variation, with its values (TOML text).
[[nodiscard]] std::vector<std::pair<std::string, std::string>> varied_in(
    const simulation::VariationSetup& variation, const PlannedRun& run);

/// KEY=VALUE for every key that the run changes: what its variation sets, then `user` (the overrides given on
/// the command line), then what it varies. The last one counts.
[[nodiscard]] std::vector<std::string> overrides_of(const simulation::VariationSetup& variation,
                                                    const PlannedRun& run,
                                                    const std::vector<std::string>& user);

}  // namespace abradem::study
