// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "abradem/geometry/triangle_mesh.h"

namespace abradem::io {

/// Reads a triangle mesh from a Stereolithography (.stl), Wavefront (.obj) or Stanford (.ply) file; the
/// suffix in any case. ASCII or binary is decided by the content: many binary STL files begin with the word
/// `solid`. All numbers are read in double precision. STL has no shared vertices: they are welded
/// (geometry::weld_vertices). Polygons of OBJ and PLY are cut into fans. Normals, colours, textures and
/// groups are ignored; the orientation is that of the vertex order.
/// @param unit metres per unit of length in the file, e.g. 0.001
/// @returns at least one triangle; all indices in range, all coordinates finite
/// @throws IoError when the file is missing, a directory or unreadable
/// @throws GeometryError when it is empty, truncated, not of its format, or states counts it cannot hold;
///         memory is taken only for what the file's size can pay for
/// @throws InputError when the unit is not a positive number
[[nodiscard]] geometry::TriangleMesh read_mesh(const std::filesystem::path& path, double unit);

/// Writes binary STL in units of `unit` metres. Single precision: seven digits. @throws IoError
void write_stl(const std::filesystem::path& path, const geometry::TriangleMesh& mesh, double unit);

/// Writes binary little-endian PLY with double coordinates in units of `unit` metres. @throws IoError
void write_ply(const std::filesystem::path& path, const geometry::TriangleMesh& mesh, double unit);

}  // namespace abradem::io
