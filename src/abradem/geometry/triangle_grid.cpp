// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/geometry/triangle_grid.h"

#include <cmath>

namespace abradem::geometry {

namespace {

std::array<Vec3, 3> corners(const TriangleMesh& mesh, Index t) noexcept {
  const Triangle& v = mesh.triangles[static_cast<std::size_t>(t)];
  return {mesh.vertices[static_cast<std::size_t>(v[0])], mesh.vertices[static_cast<std::size_t>(v[1])],
          mesh.vertices[static_cast<std::size_t>(v[2])]};
}

/// Cells a few triangles wide, and no more of them than a few per triangle.
double choose_cell(const TriangleMesh& mesh, const Vec3& extent) noexcept {
  double cell = 2.5 * mean_edge_length(mesh);
  const double budget = 4.0 * static_cast<double>(mesh.triangles.size()) + 64.0;
  const auto cells = [&] {
    return (extent.x / cell + 1.0) * (extent.y / cell + 1.0) * (extent.z / cell + 1.0);
  };
  while (cells() > budget) cell *= 1.26;
  return cell;
}

}  // namespace

TriangleGrid::TriangleGrid(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return;
  const BoundingBox whole = bounding_box(mesh.vertices);
  origin_ = whole.low;
  top_ = whole.high;
  const Vec3 extent = top_ - origin_;
  cell_ = choose_cell(mesh, extent);
  count_ = {static_cast<std::int32_t>(extent.x / cell_) + 1, static_cast<std::int32_t>(extent.y / cell_) + 1,
            static_cast<std::int32_t>(extent.z / cell_) + 1};

  constexpr Index kLarge = -1;
  std::vector<Index> home(mesh.triangles.size(), kLarge);
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    const auto p = corners(mesh, t);
    const Vec3 centroid = (p[0] + p[1] + p[2]) * (1.0 / 3.0);
    const double radius =
        std::sqrt(std::max({norm2(p[0] - centroid), norm2(p[1] - centroid), norm2(p[2] - centroid)}));
    if (radius > cell_) continue;
    for (const Vec3& corner : p) {
      overhang_.x = std::max(overhang_.x, std::abs(corner.x - centroid.x));
      overhang_.y = std::max(overhang_.y, std::abs(corner.y - centroid.y));
      overhang_.z = std::max(overhang_.z, std::abs(corner.z - centroid.z));
    }
    const CellRange r = cells_of(centroid, centroid);
    home[static_cast<std::size_t>(t)] = cell_index(r.low[0], r.low[1], r.low[2]);
  }

  small_ = bin(mesh.triangle_count(), [&](Index t, auto&& into) {
    if (home[static_cast<std::size_t>(t)] != kLarge) into(home[static_cast<std::size_t>(t)]);
  });
  large_ = bin(mesh.triangle_count(), [&](Index t, auto&& into) {
    if (home[static_cast<std::size_t>(t)] != kLarge) return;
    const BoundingBox box = bounding_box(corners(mesh, t));
    const CellRange r = cells_of(box.low, box.high);
    for (auto k = r.low[2]; k <= r.high[2]; ++k)
      for (auto j = r.low[1]; j <= r.high[1]; ++j)
        for (auto i = r.low[0]; i <= r.high[0]; ++i) into(cell_index(i, j, k));
  });
}

/// Counting sort of items into cells: count, accumulate, fill.
template <typename CellsOf>
Rows TriangleGrid::bin(Index items, CellsOf&& cells_of_item) const {
  Rows rows;
  rows.start.assign(static_cast<std::size_t>(count_[0]) * static_cast<std::size_t>(count_[1]) *
                            static_cast<std::size_t>(count_[2]) +
                        1,
                    0);
  for (Index t = 0; t < items; ++t)
    cells_of_item(t, [&](Index c) { ++rows.start[static_cast<std::size_t>(c) + 1]; });
  for (std::size_t c = 1; c < rows.start.size(); ++c) rows.start[c] += rows.start[c - 1];
  rows.items.resize(static_cast<std::size_t>(rows.start.back()));
  std::vector<Index> next(rows.start.begin(), rows.start.end() - 1);
  for (Index t = 0; t < items; ++t)
    cells_of_item(
        t, [&](Index c) { rows.items[static_cast<std::size_t>(next[static_cast<std::size_t>(c)]++)] = t; });
  return rows;
}

TriangleGrid::CellRange TriangleGrid::cells_of(const Vec3& low, const Vec3& high) const noexcept {
  const auto cell = [this](double x, double origin, std::int32_t count) {
    const double c = std::floor((x - origin) / cell_);
    // What is no number goes to the first cell: the state it comes from is refused later in the step.
    return static_cast<std::int32_t>(c > 0.0 ? std::min(c, static_cast<double>(count - 1)) : 0.0);
  };
  return {{cell(low.x, origin_.x, count_[0]), cell(low.y, origin_.y, count_[1]),
           cell(low.z, origin_.z, count_[2])},
          {cell(high.x, origin_.x, count_[0]), cell(high.y, origin_.y, count_[1]),
           cell(high.z, origin_.z, count_[2])}};
}

BoundingBox TriangleGrid::cell_box(std::int32_t i, std::int32_t j, std::int32_t k) const noexcept {
  const Vec3 low = origin_ + Vec3{i * cell_, j * cell_, k * cell_};
  return {
      low,
      {std::min(low.x + cell_, top_.x), std::min(low.y + cell_, top_.y), std::min(low.z + cell_, top_.z)}};
}

}  // namespace abradem::geometry
