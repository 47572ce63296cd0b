// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abradem/simulation/setup.h"

namespace abradem::io {

/// Reads the files that the insertions of a case name: places (columns x, y, z, radius or diameter, and
/// velocities and spins) and tables of sizes (radius or diameter; share or mass_share); fits spheres to the
/// meshes of its shapes.
/// @throws IoError with file and place for what is in a table, GeometryError for a mesh that is not closed
void read_insertion_files(simulation::Setup& setup);

}  // namespace abradem::io
