// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "abradem/report/page.h"
#include "abradem/report/run_folder.h"

namespace abradem::report {

/// What the walls bear and lose: forces, torques and power over time, volumes by law, erosion against angle.
/// @return nothing for a run of one groove worn by Archard's law, whose own figures say all that
[[nodiscard]] std::optional<PageSection> walls_section(const RunFolder& run);

}  // namespace abradem::report
