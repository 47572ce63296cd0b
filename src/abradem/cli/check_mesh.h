// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace abradem::cli {

/// `abradem check MESH`: reads a mesh, repairs what is safe in memory (as a run does), and prints on stdout
/// one table with what it is like and the verdict. The file is not changed.
/// @param unit metres per unit of length in the file   @param json print one JSON object instead
/// @returns 0 when a run can use the mesh, 3 when not
/// @throws Error (IoError, GeometryError, InputError) when it cannot be read
int check_mesh_command(const std::string& path, double unit, bool json);

}  // namespace abradem::cli
