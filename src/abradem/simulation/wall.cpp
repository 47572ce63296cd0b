// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/simulation/wall.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "abradem/core/error.h"
#include "abradem/geometry/generators.h"

namespace abradem::simulation {

using std::numbers::pi;

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
  for (Vec3& p : made.vertices) p += mesh.position;
  return made;
}

Wall::Wall(const WallSetup& setup, int material, const MeshSource& source, std::uint64_t seed)
    : setup_(setup), material_(material) {
  setup_.motion.axis = normalized(setup_.motion.axis);
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

geometry::Pose Wall::pose_at(double time) const noexcept {
  const MotionSetup& m = setup_.motion;
  geometry::Pose pose;
  switch (m.kind) {
    case MotionKind::none:
      break;
    case MotionKind::rotation:
      return geometry::rotation_pose(m.axis, m.center, m.rate * time, m.rate);
    case MotionKind::translation:
      pose.shift = time * m.velocity;
      pose.velocity = m.velocity;
      break;
    case MotionKind::oscillation: {
      const double omega = 2.0 * pi * m.frequency;
      pose.shift = std::sin(omega * time) * m.amplitude;
      pose.velocity = omega * std::cos(omega * time) * m.amplitude;
      break;
    }
  }
  return pose;
}

std::optional<double> Wall::period() const noexcept {
  const MotionSetup& m = setup_.motion;
  if (m.kind == MotionKind::rotation && m.rate != 0.0) return 2.0 * pi / std::abs(m.rate);
  if (m.kind == MotionKind::oscillation && m.frequency > 0.0) return 1.0 / m.frequency;
  return std::nullopt;
}

}  // namespace abradem::simulation
