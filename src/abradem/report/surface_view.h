// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "abradem/geometry/triangle_mesh.h"

/// The worn surface, cut down to what a page can show.
namespace abradem::report {

/// Triangles around the worn track: reference positions, unit normals and worn depth of each vertex.
struct SurfaceView {
  std::vector<float> x_mm, y_mm, z_mm;
  std::vector<float> nx, ny, nz;  ///< outward, of the unworn surface
  std::vector<float> depth_um;    ///< along the normal, positive where material is gone
  std::vector<std::int32_t> i, j, k;
  bool resampled = false;  ///< on a regular grid, because the band has more triangles than the limit
};

/// Depth on a regular grid: angle against radius for a track around the z axis, otherwise x against y.
struct WearMap {
  bool polar = false;
  double u_first = 0.0, u_step = 0.0;  ///< angle [deg], or x [mm]; of cell centres
  double v_first = 0.0, v_step = 0.0;  ///< radius [mm], or y [mm]
  int u_count = 0, v_count = 0;
  std::vector<float> depth_um;  ///< [v * u_count + u]; NaN where there is no surface
};

struct WornSurface {
  SurfaceView view;
  WearMap map;
  double max_depth_um = 0.0;
  std::size_t mesh_triangles = 0;  ///< of the whole wall
};

/// How far each vertex has sunk below the surface before wear, along its normal there [um].
/// @param before,after the same mesh, positions in millimetres
/// @throws IoError when the two have different numbers of vertices or triangles
[[nodiscard]] std::vector<double> sunk_um(const geometry::TriangleMesh& before,
                                          const geometry::TriangleMesh& after);

/// Keeps the worn band of a wall: where the depth exceeds 1 % of the largest, widened by a third of its width
/// on each side. A band of more than max_triangles is resampled.
/// @param before the surface before wear, positions in millimetres   @param depth_um of each vertex
/// @return nothing when the wall has not worn (largest depth below 1e-6 um) or has no triangle
[[nodiscard]] std::optional<WornSurface> worn_surface(const geometry::TriangleMesh& before,
                                                      const std::vector<double>& depth_um,
                                                      std::size_t max_triangles = 100000);

}  // namespace abradem::report
