// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "abradem/geometry/triangle_mesh.h"

namespace abradem::io {

struct VtpField {
  int components = 1;
  std::vector<double> values;  ///< components * tuples
};

/// A triangulated surface as a .vtp file holds it: coordinates in the file's unit (Abradem
/// writes metres), arrays by name.
struct VtpSurface {
  geometry::TriangleMesh mesh;
  std::map<std::string, VtpField> point_data, cell_data;
};

/// Reads an XML PolyData file (VTK file format 0.1, 1.0 or 2.0) with one piece: ascii, binary or appended
/// (base64 or raw) arrays, zlib or uncompressed, little endian. Polygons must be triangles; vertices, lines
/// and strips are passed over.
/// @throws IoError when the file is missing, damaged or of a kind named above as unsupported; the message
///         names the file and what was found
[[nodiscard]] VtpSurface read_vtp(const std::filesystem::path& file);
/// The same from memory. @param name what messages call it
[[nodiscard]] VtpSurface parse_vtp(std::string text, const std::string& name);

/// One file of a ParaView collection.
struct SeriesFrame {
  double time = 0.0;  ///< as written [s]
  std::string part;
  std::filesystem::path file;  ///< the collection's folder joined
};

/// Reads a .pvd collection, in the order of the file.
/// @throws IoError when it is missing, is not a collection or an entry names no file
[[nodiscard]] std::vector<SeriesFrame> read_pvd(const std::filesystem::path& file);
/// The same from memory. @param file where the text is from
[[nodiscard]] std::vector<SeriesFrame> parse_pvd(std::string text, const std::filesystem::path& file);

}  // namespace abradem::io
