// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "abradem/simulation/setup.h"

namespace abradem::io {

/// Reads the files that the insertions of a case name: places (columns x, y, z, radius or diameter, and
/// velocities and spins) and tables of sizes (radius or diameter; share or mass_share); fits spheres to the
/// meshes of its shapes; takes what other runs left.
/// @return what is allowed but probably not meant, for a person
/// @throws IoError with file and place for what is in a table, GeometryError for a mesh that is not closed,
/// InputError for a run that left no such particles
std::vector<std::string> read_insertion_files(simulation::Setup& setup);

}  // namespace abradem::io
