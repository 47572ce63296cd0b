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

/// Triangles packed as they stand in a file: the same in every frame of a series, so packed once.
class VtpTriangles {
 public:
  explicit VtpTriangles(std::span<const geometry::Triangle> triangles);
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] const std::string& corners() const noexcept { return corners_; }
  [[nodiscard]] const std::string& ends() const noexcept { return ends_; }

 private:
  std::size_t size_;
  std::string corners_, ends_;  // compressed
};

/// Writes a mesh for ParaView: VTK XML PolyData, zlib-compressed, points in double precision and in metres.
/// The file appears whole or not at all.
/// @param point_data  one tuple per vertex   @param cell_data  one tuple per triangle
/// @throws IoError when it cannot be written   @throws std::invalid_argument when an array has another length
void write_vtp(const std::filesystem::path& path, std::span<const Vec3> vertices,
               const VtpTriangles& triangles, std::span<const VtpArray> point_data = {},
               std::span<const VtpArray> cell_data = {});
/// The same of a mesh that is written once.
inline void write_vtp(const std::filesystem::path& path, const geometry::TriangleMesh& mesh,
                      std::span<const VtpArray> point_data = {}, std::span<const VtpArray> cell_data = {}) {
  write_vtp(path, mesh.vertices, VtpTriangles(mesh.triangles), point_data, cell_data);
}

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
