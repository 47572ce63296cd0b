// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "abradem/report/run_folder.h"

namespace abradem::report {

/// The report of a run as one HTML page: text, figures, the data behind them and the code that draws them. It
/// opens from a file and loads nothing. Long tables are thinned to what a figure can show; the page says so.
[[nodiscard]] std::string make_page(const RunFolder& run);

/// Reads a run's output folder and writes its report.html, whole or not at all (a temporary file is renamed).
/// @return the path of the page
/// @throws IoError when a file of the run is missing or damaged (see read_run_folder), or the page cannot be
///         written
std::filesystem::path write_report(const std::filesystem::path& run_folder);

}  // namespace abradem::report
