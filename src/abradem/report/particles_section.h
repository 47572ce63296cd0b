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

}  // namespace abradem::report
