// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/analysis/depth_map.h"

#include <fmt/core.h>

#include <cmath>

#include "abradem/core/error.h"

namespace abradem::analysis {

namespace {

/// Which way a normal points most: ±1, ±2, ±3 for the axes.
long direction_of(const Vec3& n) {
  const double x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
  if (x >= y && x >= z) return n.x < 0.0 ? -1 : 1;
  if (y >= z) return n.y < 0.0 ? -2 : 2;
  return n.z < 0.0 ? -3 : 3;
}

}  // namespace

DepthPlaces::DepthPlaces(double width) : width_(width) {
  if (!(width > 0.0) || !std::isfinite(width))
    throw InputError(fmt::format("a map of depths: places {} m wide; must be > 0", width));
}

void DepthPlaces::add(std::span<const Vec3> vertices, std::span<const geometry::Triangle> triangles) {
  for (const geometry::Triangle& t : triangles) {
    const auto at = [&](std::size_t k) { return vertices[static_cast<std::size_t>(t[k])]; };
    const Vec3 area = 0.5 * cross(at(1) - at(0), at(2) - at(0));
    const Vec3 centre = (at(0) + at(1) + at(2)) * (1.0 / 3.0);
    const auto cell = [&](double x) { return std::lround(std::floor(x / width_)); };
    const std::array<long, 5> key{surfaces_, direction_of(area), cell(centre.x), cell(centre.y),
                                  cell(centre.z)};
    const std::size_t place = number_.try_emplace(key, area_.size()).first->second;
    if (place == area_.size()) area_.push_back(0.0);
    area_[place] += norm(area);
    of_element_.push_back(place);
  }
  ++surfaces_;
}

std::vector<double> DepthPlaces::depths(std::span<const double> volumes) const {
  if (volumes.size() != of_element_.size())
    throw InputError(
        fmt::format("a map of depths: {} volumes for {} elements", volumes.size(), of_element_.size()));
  std::vector<double> depth(area_.size(), 0.0);
  for (std::size_t e = 0; e < volumes.size(); ++e) depth[of_element_[e]] += volumes[e];
  for (std::size_t p = 0; p < depth.size(); ++p)
    if (area_[p] > 0.0) depth[p] /= area_[p];
  return depth;
}

double map_size(std::span<const double> depths, std::span<const double> area) {
  double sum = 0.0, all = 0.0;
  for (std::size_t p = 0; p < depths.size(); ++p) {
    sum += area[p] * depths[p] * depths[p];
    all += area[p];
  }
  return all > 0.0 ? std::sqrt(sum / all) : 0.0;
}

double map_noise(const std::array<std::vector<double>, 4>& quarters, std::span<const double> area) {
  std::vector<double> contrast(area.size());
  for (std::size_t p = 0; p < contrast.size(); ++p)
    contrast[p] = quarters[0][p] - quarters[1][p] - quarters[2][p] + quarters[3][p];
  return map_size(contrast, area);
}

}  // namespace abradem::analysis
