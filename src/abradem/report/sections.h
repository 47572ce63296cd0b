// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "abradem/report/run_folder.h"

/// The parts of the page that are text: they are in the file as HTML, readable without a script.
namespace abradem::report {

/// The case's title; "Run in <folder>" when the run states none. Not escaped.
[[nodiscard]] std::string page_title(const RunFolder& run);

/// One sentence: what wore, by how much, and whether the volumes add up.
[[nodiscard]] std::string verdict(const RunFolder& run);

/// Wear volume, depth, width, kappa, ledger residual and status, with the laboratory's values beside ours.
[[nodiscard]] std::string verdict_cards(const RunFolder& run);

[[nodiscard]] std::string ledger_table(const RunFolder& run);
[[nodiscard]] std::string limits_and_warnings(const RunFolder& run);
[[nodiscard]] std::string inputs(const RunFolder& run);
[[nodiscard]] std::string record_table(const RunFolder& run);

}  // namespace abradem::report
