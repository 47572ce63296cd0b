// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "abradem/contact/contact_chunk.h"
#include "abradem/geometry/pose.h"

namespace abradem::contact {

/// A plane in its own frame, and how it moves.
struct MovingPlane {
  Vec3 point, normal;  ///< [m]; unit, towards the spheres
  geometry::Pose pose;
};

/// The spheres near one plane, and what their contacts remember and do. Ascending by sphere.
struct PlaneList {
  std::vector<std::int32_t> sphere, id;  ///< index in the order now; for life
  std::vector<std::uint8_t> touching;
  std::vector<std::uint8_t> fresh;  ///< it touches since this step
  std::vector<SpringRow> spring;    ///< in the plane's frame [m]
  std::vector<SpringRow> torque;    ///< likewise, of contacts with options [N m]
  std::vector<LoadRow> load;        ///< on each sphere, world frame; zero where it does not touch
  std::vector<double> F_n, slip;    ///< normal force [N], plastic sliding of the step [m]
  std::vector<double> lost;         ///< to the normal damper in the step; of contacts with options alone [J]

  /// Finds the spheres within `skin` of the plane, those with id < first_id left out, and carries the springs
  /// over.
  void rebuild(const Spheres& spheres, const MovingPlane& plane, double skin, std::int32_t first_id);
  [[nodiscard]] std::size_t size() const noexcept { return sphere.size(); }

  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("sphere", self.sphere)("id", self.id)("touching", self.touching)("spring", self.spring);
    archive("torque", self.torque)("load", self.load)("F_n", self.F_n)("slip", self.slip);
    archive("fresh", self.fresh);
  }
  /// @return whether what was loaded is a list of some of so many spheres
  [[nodiscard]] bool fits(std::size_t spheres) const;
};

/// Hertz-Mindlin forces of a plane on the spheres of its list; their springs go one step on.
/// @param by_material constants of each material against the plane's; any with options: `options`
/// @return false when a sphere overlaps by more than kDeepest / 2 of its radius
[[nodiscard]] bool plane_forces(const Spheres& spheres, PlaneList& list, const MovingPlane& plane,
                                std::span<const PairConstants> by_material, bool options, double dt);

}  // namespace abradem::contact
