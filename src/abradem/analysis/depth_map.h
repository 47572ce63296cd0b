// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <span>
#include <vector>

#include "abradem/geometry/triangle_mesh.h"

/// Depths of wear on a length that means something: averaged over places about a particle wide.
///                                                                     docs/theory/scaling.md#bulk
namespace abradem::analysis {

/// The elements of some surfaces, gathered into places: those of one surface whose unworn centres lie in one
/// cell of a cubic grid and that face alike (by the largest component of their normals), so that the two
/// faces of a thin bar are not averaged.
class DepthPlaces {
 public:
  /// @param width of a cell [m]   @throws InputError unless it is > 0
  explicit DepthPlaces(double width);
  /// One more surface, unworn [m].
  void add(std::span<const Vec3> vertices, std::span<const geometry::Triangle> triangles);

  [[nodiscard]] std::size_t size() const noexcept { return area_.size(); }
  /// Of each place [m^2].
  [[nodiscard]] const std::vector<double>& area() const noexcept { return area_; }
  /// Mean depth of each place [m]: what its elements lost over their area.
  /// @param volumes of the elements of all surfaces, in the order of `add` [m^3]
  [[nodiscard]] std::vector<double> depths(std::span<const double> volumes) const;

 private:
  double width_;
  int surfaces_ = 0;
  std::map<std::array<long, 5>, std::size_t> number_;  // of (surface, direction, cell)
  std::vector<std::size_t> of_element_;
  std::vector<double> area_;
};

/// Root of the mean square over the area [m]: (sum A h^2 / sum A)^(1/2). 0 where there is no area.
[[nodiscard]] double map_size(std::span<const double> depths, std::span<const double> area);

/// Of a map that was worn in four equal parts of time, the part that is noise [m]: h1 - h2 - h3 + h4 has the
/// variance of their sum where they are independent, and nothing of a rate that rises or falls steadily.
[[nodiscard]] double map_noise(const std::array<std::vector<double>, 4>& quarters,
                               std::span<const double> area);

}  // namespace abradem::analysis
