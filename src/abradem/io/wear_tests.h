// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "abradem/study/wear_law.h"

namespace abradem::io {

/// Reads wear tests of one or several materials, one test per row.   docs/reference/calibrate.md#many-tests
/// Columns, with their units: force (or load, normal_force); distance (or sliding_distance); volume (or
/// wear_volume), or else mass_loss and density; material, where there are several. Others are passed over.
/// @return the materials in the order in which they first appear
/// @throws IoError with file, line and column for what is missing, no number, or not positive
[[nodiscard]] std::vector<study::WearTests> read_wear_tests(const std::filesystem::path& path);

}  // namespace abradem::io
