// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abradem/simulation/setup.h"

namespace abradem::io {

/// Reads the files that the insertions of a case name: places (columns x_mm, y_mm, z_mm, radius_mm) and
/// tables of sizes (radius_mm, share); fits spheres to the meshes of its shapes. @throws IoError for a file
/// that cannot be read, InputError for what is in it, GeometryError for a mesh that is not closed
void read_insertion_files(simulation::Setup& setup);

}  // namespace abradem::io
