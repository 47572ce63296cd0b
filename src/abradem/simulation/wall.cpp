// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/simulation/wall.h"

#include <fmt/core.h>

#include "abradem/core/error.h"
#include "abradem/geometry/generators.h"

namespace abradem::simulation {

void place(geometry::TriangleMesh& mesh, const MeshSetup& setup) noexcept {
  if (setup.rotation != Vec3{}) {
    const geometry::Pose x = geometry::rotation_pose({1.0, 0.0, 0.0}, {}, setup.rotation.x, 0.0),
                         y = geometry::rotation_pose({0.0, 1.0, 0.0}, {}, setup.rotation.y, 0.0),
                         z = geometry::rotation_pose({0.0, 0.0, 1.0}, {}, setup.rotation.z, 0.0);
    for (Vec3& p : mesh.vertices) p = z.turn(y.turn(x.turn(p)));
  }
  for (Vec3& p : mesh.vertices) p += setup.position;
}

geometry::TriangleMesh generate_mesh(const MeshSetup& mesh, std::uint64_t seed) {
  geometry::TriangleMesh made;
  switch (mesh.shape) {
    case MeshShape::annulus:
      made = geometry::make_annulus(mesh.inner, mesh.outer, mesh.size, seed);
      break;
    case MeshShape::disc:
      made = geometry::make_disc(mesh.outer, mesh.size, seed);
      break;
    case MeshShape::plate:
      made = geometry::make_plate(mesh.length, mesh.width, mesh.size, seed);
      break;
    case MeshShape::file:
      throw InputError(
          fmt::format("mesh file '{}': no reader was given; pass a MeshSource that reads files", mesh.file));
    case MeshShape::plane:
      throw InputError("an analytic plane has no mesh");
  }
  place(made, mesh);
  return made;
}

Wall::Wall(const WallSetup& setup, int material, const MeshSource& source, std::uint64_t seed)
    : setup_(setup), material_(material) {
  setup_.motion.axis = normalized(setup_.motion.axis);
  for (MotionSetup& m : setup_.carried_by) m.axis = normalized(m.axis);
  for (std::size_t k = 0; k < setup_.motions(); ++k)
    if (const auto problem = problem_of_table(setup_.motion_at(k)))
      throw InputError(fmt::format("wall '{}', row {} of the table of its motion: {}", setup.name,
                                   problem->row + 1, problem->what));
  setup_.mesh.normal = normalized(setup_.mesh.normal);
  if (setup.mesh.shape == MeshShape::plane) return;
  try {
    surface_.emplace(source(setup.mesh, seed));
  } catch (const GeometryError& e) {
    throw GeometryError(fmt::format("wall '{}': {}", setup.name, e.what()));
  }
  grid_ = geometry::TriangleGrid(surface_->mesh());
}

contact::SurfaceView Wall::view() const noexcept {
  return {surface_->mesh(), grid_, surface_->revision(), surface_->odometer(), surface_->deepest_sink()};
}

}  // namespace abradem::simulation
