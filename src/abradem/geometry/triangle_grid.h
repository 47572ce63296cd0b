// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "abradem/geometry/triangle_mesh.h"

namespace abradem::geometry {

/// Uniform grid over a mesh that answers "which triangles may meet this region".
/// Built once in a wall's own frame: turning the wall costs nothing, and wear that has moved vertices by at
/// most d is covered by asking for a region grown by d. Build O(n); a query costs the cells and triangles
/// near the region, whatever the size of the mesh.
///
/// A triangle smaller than a cell stands in the cell of its centroid; the few larger ones (flat parts of CAD
/// models) stand in every cell that they meet.
class TriangleGrid {
 public:
  TriangleGrid() = default;
  explicit TriangleGrid(const TriangleMesh& mesh);

  /// Visits the triangles (as built) that may meet a region, each once, in an order that depends on the grid
  /// alone.
  /// @param low,high a box around the region [m]
  /// @param may_meet (Vec3 centre, Vec3 half) -> bool: could the region meet something in the box centre +-
  /// half?
  /// @param visit (Index triangle)
  template <typename MayMeet, typename Visit>
  void visit_near(const Vec3& low, const Vec3& high, MayMeet&& may_meet, Visit&& visit) const {
    if (small_.start.empty()) return;
    const CellRange r = cells_of(low - overhang_, high + overhang_);
    std::vector<Index> large;
    for (auto k = r.low[2]; k <= r.high[2]; ++k)
      for (auto j = r.low[1]; j <= r.high[1]; ++j)
        for (auto i = r.low[0]; i <= r.high[0]; ++i) {
          const BoundingBox box = cell_box(i, j, k);
          if (!may_meet(0.5 * (box.low + box.high), 0.5 * (box.high - box.low) + overhang_)) continue;
          const Index cell = cell_index(i, j, k);
          for (const Index t : small_[cell]) visit(t);
          for (const Index t : large_[cell]) large.push_back(t);
        }
    std::sort(large.begin(), large.end());
    large.erase(std::unique(large.begin(), large.end()), large.end());
    for (const Index t : large) visit(t);
  }

  /// Of the mesh as built [m].
  [[nodiscard]] BoundingBox box() const noexcept { return {origin_, top_}; }

 private:
  struct CellRange {
    std::array<std::int32_t, 3> low, high;
  };
  [[nodiscard]] CellRange cells_of(const Vec3& low, const Vec3& high) const noexcept;
  [[nodiscard]] BoundingBox cell_box(std::int32_t i, std::int32_t j, std::int32_t k) const noexcept;
  [[nodiscard]] Index cell_index(std::int32_t i, std::int32_t j, std::int32_t k) const noexcept {
    return (k * count_[1] + j) * count_[0] + i;
  }
  template <typename CellsOf>
  [[nodiscard]] Rows bin(Index items, CellsOf&& cells_of_item) const;

  Vec3 origin_, top_;
  Vec3 overhang_;  // how far small triangles reach beyond the cells of their centroids
  double cell_ = 1.0;
  std::array<std::int32_t, 3> count_{0, 0, 0};
  Rows small_, large_;  // triangles of each cell
};

}  // namespace abradem::geometry
