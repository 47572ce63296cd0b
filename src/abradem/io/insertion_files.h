// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abradem/simulation/setup.h"

namespace abradem::io {

/// Reads the files that the insertions of a case name: places (columns x_mm, y_mm, z_mm, radius_mm) and
/// tables of sizes (radius_mm, share). @throws IoError for a file that cannot be read, InputError for what is
/// in it
void read_insertion_files(simulation::Setup& setup);

}  // namespace abradem::io
