// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "abradem/report/page.h"
#include "abradem/report/run_folder.h"

namespace abradem::report {

/// The particles of a run that has them in numbers: how many, the mass that leaves and its rate, contacts,
/// energies.
/// @return nothing for a run without
[[nodiscard]] std::optional<PageSection> particles_section(const RunFolder& run);

/// What has left a run per time, on average since the last output before the first left.
struct Outflow {
  double rate = 0.0;   ///< [kg/s]
  double since = 0.0;  ///< [s]
};
/// @param particles columns time_s and removed_mass_kg   @return nothing where nothing has left, or did from
/// the start
[[nodiscard]] std::optional<Outflow> mean_outflow(const Table& particles);

}  // namespace abradem::report
