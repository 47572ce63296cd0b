// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "abradem/geometry/triangle_mesh.h"

namespace abradem::geometry {

struct Point2 {
  double x = 0.0, y = 0.0;
};

/// A growing triangulation of a convex polygon in the plane, kept Delaunay by edge flips.
///
/// It starts as a fan from one inner point to the corners of the polygon; further points are inserted one by
/// one (walk to the triangle, split it in three, flip what is no longer Delaunay [Lawson 1977]). A flip is
/// done only when the in-circle determinant is positive beyond round-off and both new triangles keep a
/// positive area, so the triangulation stays valid and the flips end. Edges of the polygon are never flipped.
/// All triangles are counter-clockwise. Coordinates should be of the order of the spacing (not 1e-4 m).
class Delaunay {
 public:
  /// @param points   all points that will ever be used, by index; those of the fan are used at once
  /// @param polygon  corners of the convex hull, counter-clockwise; collinear corners are allowed
  /// @param centre   index of a point strictly inside the polygon
  Delaunay(std::vector<Point2> points, std::span<const Index> polygon, Index centre);

  /// Adds a point strictly inside the polygon. Cheap when near the one added before.
  void insert(Index point);

  /// Removes all triangles that touch a point (a hole). Its former neighbours get open edges there.
  void erase_star(Index point);

  /// Orders triangles by their smallest vertex, so that neighbours are near in memory.
  void sort_triangles();

  /// Moves each point that `is_free` by `amount` times the way to the area-weighted mean of the middles of
  /// the edges opposite to it, takes back what would make a triangle smaller than 1 % of its neighbours'
  /// size, then restores the Delaunay property.
  void smooth(double amount, std::span<const char> is_free);

  /// Flips all edges that are not locally Delaunay, until none is left.
  void restore_delaunay();

  [[nodiscard]] const std::vector<Point2>& points() const noexcept { return points_; }
  [[nodiscard]] const std::vector<Triangle>& triangles() const noexcept { return triangles_; }
  /// Twice the smallest signed area; positive in a valid triangulation.
  [[nodiscard]] double smallest_doubled_area() const noexcept;

 private:
  [[nodiscard]] Index locate(Point2 p) const;
  bool flip_if_needed(Index t, std::size_t k);
  void legalize();
  void relink(Index t, Index from, Index to) noexcept;

  std::vector<Point2> points_;
  std::vector<Triangle> triangles_;
  std::vector<Triangle> neighbours_;  ///< across the edge from vertex k to vertex k + 1; -1: open
  std::vector<Index> pending_;        ///< triangles whose edges wait for the flip test
  Index last_ = 0;                    ///< where the next walk starts
};

}  // namespace abradem::geometry
