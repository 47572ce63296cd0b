// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/analysis/wall_contours.h"

#include <fmt/core.h>

#include <numbers>

#include "abradem/core/error.h"

namespace abradem::analysis {

using simulation::MotionKind;

std::optional<std::size_t> worn_wall(std::span<const simulation::Wall> walls) {
  for (std::size_t w = 0; w < walls.size(); ++w)
    if (!walls[w].is_plane() && walls[w].setup().deformation != simulation::DeformationRule::none) return w;
  return std::nullopt;
}

std::vector<Contour> wall_contours(const simulation::Wall& wall, int count) {
  if (wall.is_plane())
    throw InputError(fmt::format("wall '{}' is an analytic plane: it has no contours", wall.setup().name));
  const geometry::TriangleMesh& mesh = wall.surface().mesh();
  const auto reference = wall.surface().reference();
  const auto region = worn_region(mesh, reference);
  const simulation::MotionSetup& motion = leading_motion(wall.setup());
  if (motion.kind == MotionKind::rotation)
    return cut_contours(mesh, reference, region,
                        RotaryCuts{.axis = motion.axis, .center = motion.center, .count = count});

  // The groove runs along the motion; heights count along the wall's mean normal.
  Vec3 normal;
  for (geometry::Index t = 0; t < mesh.triangle_count(); ++t) normal += area_vector(mesh, t);
  const Vec3 direction = motion.kind == MotionKind::translation ? motion.velocity : motion.amplitude;
  if (norm2(direction) == 0.0 || norm2(normal) == 0.0) return {};
  const auto extent = worn_extent(mesh, reference, region, {}, direction);
  if (!extent) return {};
  std::vector<Contour> contours =
      cut_contours(mesh, reference, region,
                   StraightCuts{.axis = normal, .direction = direction, .count = count, .along = *extent});
  const double length = extent->high - extent->low;
  for (Contour& c : contours)
    c.angle = length > 0.0 ? 2.0 * std::numbers::pi * (c.angle - extent->low) / length : 0.0;
  return contours;
}

}  // namespace abradem::analysis
