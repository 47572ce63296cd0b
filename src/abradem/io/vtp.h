// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "abradem/geometry/triangle_mesh.h"

namespace abradem::io {

/// A named field on points or triangles. Put the unit into the name: "depth_um".
struct VtpArray {
  std::string name;
  std::span<const double> values;  ///< components of the first, then of the second, …
  int components = 1;              ///< 3 for vectors
};

/// Writes a mesh for ParaView: VTK XML PolyData, zlib-compressed, points in double precision and in metres.
/// The file appears whole or not at all.
/// @param point_data  one tuple per vertex   @param cell_data  one tuple per triangle
/// @throws IoError when it cannot be written   @throws std::invalid_argument when an array has another length
void write_vtp(const std::filesystem::path& path, const geometry::TriangleMesh& mesh,
               std::span<const VtpArray> point_data = {}, std::span<const VtpArray> cell_data = {});

/// Writes spheres as points with an array `radius` [m] (ParaView: glyph or point gaussian scaled by it).
/// @param point_data  further arrays, one tuple per sphere
void write_vtp_spheres(const std::filesystem::path& path, std::span<const Vec3> centres,
                       std::span<const double> radii, std::span<const VtpArray> point_data = {});

/// One file of a time series; `part` tells several files of one time apart (walls, spheres).
struct PvdEntry {
  double time = 0.0;  ///< [s]
  std::string file;   ///< relative to the folder of the .pvd file
  int part = 0;

  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("time", self.time)("file", self.file)("part", self.part);
  }
};

/// Writes the index that ParaView opens to show a time series. @throws IoError
void write_pvd(const std::filesystem::path& path, std::span<const PvdEntry> entries);

}  // namespace abradem::io
