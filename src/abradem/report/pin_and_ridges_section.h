// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "abradem/report/page.h"
#include "abradem/report/run_folder.h"

namespace abradem::report {

/// The worn pin and the ridges of a run: ledgers, the tip's profile and flat, ridges and displaced volumes.
/// @return nothing for a run in which no pin wears and nothing is ploughed
[[nodiscard]] std::optional<PageSection> pin_and_ridges_section(const RunFolder& run);

}  // namespace abradem::report
