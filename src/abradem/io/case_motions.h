// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "abradem/io/case_checks.h"

namespace abradem::io {

/// Reads the tables that the motions of a case take from files (time_s and any of x_mm, y_mm, z_mm,
/// angle_deg).
/// @throws IoError for a file that cannot be read, InputError for what is in it, with its line
void read_motion_files(simulation::Setup& setup);

/// Where the k-th motion of a wall was written.
[[nodiscard]] std::string motion_path(const simulation::WallSetup& wall, std::size_t k, const Places& places);

/// Adds what is wrong with the motions of walls: tables that are missing, given twice or out of order.
void check_motions(const simulation::Setup& setup, const Places& places, Problems& problems);

}  // namespace abradem::io
