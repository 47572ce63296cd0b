// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "abradem/io/vtp_read.h"

namespace abradem::report {

/// The walls of a run that kept maps, with what each element suffered, cut down to what a page can show.
struct WearMapView {
  struct Wall {
    std::string name;
    std::size_t first_vertex = 0, vertices = 0, first_triangle = 0, triangles = 0;
    std::size_t mesh_triangles = 0;  ///< of the whole wall
  };
  struct Quantity {
    std::string key, title;      ///< name in the frames; with its unit
    std::vector<double> values;  ///< of each triangle
  };
  std::vector<Wall> walls;
  std::vector<float> x_mm, y_mm, z_mm;
  std::vector<std::int32_t> i, j, k;  ///< vertices, counted through all walls
  std::vector<Quantity> quantities;   ///< those that any wall has more than zero of
};

/// One wall's last frame.
struct WallFrame {
  std::string name;
  std::filesystem::path file;
};

/// @return nothing where no frame has a map   @throws IoError for damaged frames
[[nodiscard]] std::optional<WearMapView> wear_map_view(const std::vector<WallFrame>& frames,
                                                       std::size_t max_triangles = 60000);

}  // namespace abradem::report
