// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "abradem/report/page.h"
#include "abradem/report/run_folder.h"

namespace abradem::report {

/// Where the walls of a run that kept maps wear most, how fast, how long a liner lasts, and what wore them.
/// @return nothing for a run without maps
[[nodiscard]] std::optional<PageSection> wear_map_section(const RunFolder& run);

/// The figure of the walls in 3D: its HTML, what the page's script must know (JSON), and its arrays.
struct WearMapFigure {
  std::string html, facts, data;
};
/// @param number of the figure   @return HTML of no figure, and null, where there is no map to show
[[nodiscard]] WearMapFigure wear_map_figure(const RunFolder& run, int number);

}  // namespace abradem::report
