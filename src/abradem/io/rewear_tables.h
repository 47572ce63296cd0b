// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "abradem/analysis/rewear.h"

namespace abradem::io {

/// Reads wear_integrals.csv and impact_spectrum.csv of a run.
/// @throws InputError where the run kept no maps, IoError where they are damaged
[[nodiscard]] analysis::Recorded read_recorded_wear(const std::filesystem::path& tables);

/// The wear of each element, in the columns of wear.csv.   @throws IoError
void write_reworn_elements(const std::filesystem::path& path, const analysis::Reworn& reworn);
/// … and of each region.   @throws IoError
void write_reworn_regions(const std::filesystem::path& path, const analysis::Reworn& reworn);

}  // namespace abradem::io
