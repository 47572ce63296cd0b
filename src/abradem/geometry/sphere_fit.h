// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "abradem/geometry/mass_properties.h"

namespace abradem::geometry {

/// Balls in the place of a solid, and how well they stand for it.
struct SphereFit {
  std::vector<Ball> balls;
  double growth = 0.0;        ///< by which the inscribed balls were all made larger [m]
  double volume_error = 0.0;  ///< of the union's volume, relative to the solid's [-]
  double deepest = 0.0;   ///< largest distance from the solid's surface to the union, where it is bare [m]
  double furthest = 0.0;  ///< largest distance that a ball reaches out of the solid [m]
  bool operator==(const SphereFit&) const = default;

  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("balls", self.balls)("growth", self.growth)("volume_error", self.volume_error);
    archive("deepest", self.deepest)("furthest", self.furthest);
  }
};

/// At most `count` balls for the solid within a closed mesh. Candidates are the maximal inscribed balls on a
/// grid of 48 cells along the longest side: those that no neighbour's ball contains, an image of the medial
/// axis. The greedy rule of the set-covering problem takes one after the other that covers the most of what
/// is bare [Li, Xu & Meng 2015, 10.1016/j.powtec.2015.08.026; Yuan 2019, 10.1007/s10035-019-0868-1]. Then
/// all are made larger by the same length until their union has the solid's volume. Deterministic.
/// The mesh is closed, its normals point outwards, and it is not thinner than three cells everywhere.
/// @throws GeometryError when no cell lies inside
[[nodiscard]] SphereFit fit_spheres(const TriangleMesh& mesh, int count);

}  // namespace abradem::geometry
