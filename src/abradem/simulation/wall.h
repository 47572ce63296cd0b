// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <functional>
#include <optional>

#include "abradem/contact/mesh_candidates.h"
#include "abradem/geometry/pose.h"
#include "abradem/geometry/triangle_grid.h"
#include "abradem/simulation/setup.h"
#include "abradem/simulation/wall_motion.h"
#include "abradem/wear/wearing_surface.h"

namespace abradem::simulation {

/// Supplies the mesh of a wall in its own frame [m]; files are the business of whoever calls.
using MeshSource = std::function<geometry::TriangleMesh(const MeshSetup&, std::uint64_t seed)>;

/// Turns and shifts a mesh to where the case puts it.
void place(geometry::TriangleMesh& mesh, const MeshSetup& setup) noexcept;

/// Meshes the generated shapes, in their places. @throws InputError for `file` and `plane`, which have none
[[nodiscard]] geometry::TriangleMesh generate_mesh(const MeshSetup& mesh, std::uint64_t seed);

/// A wall: a surface in its own frame that wears, and a rigid motion that carries it. Particles are brought
/// into the wall's frame, contact is done there and forces are carried back, so that turning a disc of a
/// million triangles costs nothing.
class Wall {
 public:
  Wall(const WallSetup& setup, int material, const MeshSource& source, std::uint64_t seed);

  [[nodiscard]] const WallSetup& setup() const noexcept { return setup_; }
  [[nodiscard]] int material() const noexcept { return material_; }
  /// Triangulated, or an analytic plane through setup().mesh.position?
  [[nodiscard]] bool is_plane() const noexcept { return !surface_; }
  [[nodiscard]] wear::WearingSurface& surface() noexcept { return *surface_; }
  [[nodiscard]] const wear::WearingSurface& surface() const noexcept { return *surface_; }
  [[nodiscard]] contact::SurfaceView view() const noexcept;

  /// Pose at a time. Closed form of the time, so that it never drifts.
  [[nodiscard]] geometry::Pose pose_at(double time) const noexcept {
    return pose_of(setup_, setup_.motions(), time);
  }
  /// Does its surface run over it, as a belt does?
  [[nodiscard]] bool is_belt() const noexcept { return setup_.motion.surface_velocity != Vec3{}; }
  /// Velocity of the belt where the wall's normal is n, in the wall's frame: along the surface, at its full
  /// speed.
  [[nodiscard]] Vec3 belt_velocity(const Vec3& n) const noexcept {
    const Vec3& s = setup_.motion.surface_velocity;
    const Vec3 along = s - dot(s, n) * n;
    const double speed2 = norm2(along);
    return speed2 > 0.0 ? along * std::sqrt(norm2(s) / speed2) : Vec3{};
  }
  /// Is it still there at this time [s]? (See WallSetup::until.)
  [[nodiscard]] bool present(double time) const noexcept { return !setup_.until || time < *setup_.until; }
  /// Does it wear by |v_t| dt, whether a contact sticks or slips? Ours wear by the plastic slip. The paper's
  /// rules wear by the speed (eq. 5): their springs begin anew on every element, so what they call slip would
  /// come short.
  [[nodiscard]] bool wears_by_speed() const noexcept {
    return setup_.deformation == DeformationRule::paper || setup_.contact == ContactRule::per_triangle;
  }
  /// Must contacts remember how they began, for laws that wear by impacts?
  void watch_impacts() noexcept { watches_impacts_ = true; }
  [[nodiscard]] bool watches_impacts() const noexcept { return watches_impacts_; }
  /// Time of one turn or one cycle [s]; none for a wall that does neither.
  [[nodiscard]] std::optional<double> period() const noexcept { return period_of(setup_); }

 private:
  WallSetup setup_;
  int material_;
  std::optional<wear::WearingSurface> surface_;
  geometry::TriangleGrid grid_;
  bool watches_impacts_ = false;
};

}  // namespace abradem::simulation
