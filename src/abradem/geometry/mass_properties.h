// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "abradem/geometry/quaternion.h"
#include "abradem/geometry/triangle_mesh.h"

namespace abradem::geometry {

struct Ball {
  Vec3 centre;          ///< [m]
  double radius = 0.0;  ///< [m]
  bool operator==(const Ball&) const = default;

  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("centre", self.centre)("radius", self.radius);
  }
};

/// Of a body of density 1.
struct MassProperties {
  double volume = 0.0;  ///< [m^3]
  Vec3 centre;          ///< [m]
  Vec3 moments;         ///< I_xx, I_yy, I_zz about the centre [m^5]
  Vec3 products;        ///< I_yz, I_zx, I_xy: the tensor's other elements, such as -int y z dV [m^5]
  bool operator==(const MassProperties&) const = default;

  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("volume", self.volume)("centre", self.centre)("moments", self.moments);
    archive("products", self.products);
  }
};

/// Of the solid within a closed mesh; exact (sum over the tetrahedra from one point to the triangles).
[[nodiscard]] MassProperties mass_properties(const TriangleMesh& mesh);

/// Of the union of balls, overlaps counted once. Sections across z are unions of discs, whose moments are
/// integrals along their outer arcs (Green); between the balls' ends z is integrated by Gauss's rule in
/// panels of at most 1/`panels` of the height. Error with 64: some 1e-6.
/// O(panels * balls^2).
[[nodiscard]] MassProperties mass_properties(std::span<const Ball> balls, int panels = 64);

/// Moments of inertia along the axes in which the tensor is diagonal, ascending [m^5], and the rotation that
/// takes the axes x, y, z to these.
struct PrincipalAxes {
  Vec3 moments;
  Quaternion turn;
};
[[nodiscard]] PrincipalAxes principal_axes(const MassProperties& body);

}  // namespace abradem::geometry
