// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/placement.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "abradem/core/error.h"
#include "abradem/geometry/closest_point.h"
#include "abradem/geometry/pose.h"
#include "abradem/io/case_checks.h"

namespace abradem::io {

namespace {

using simulation::Wall;

constexpr double kDeepest = 0.1;   // overlap over radius beyond which Hertz contact means nothing
constexpr double kFarthest = 0.5;  // gap over radius beyond which a pin is not meant to be

std::string mm(double metres) { return fmt::format("{:.4g} mm", 1e3 * metres); }

/// The surface as a particle meets it along its guide.
struct Below {
  double distance = 0.0;     ///< from the centre to the surface [m]
  bool facing_away = false;  ///< the particle sees the back of the surface
};

class MeshSeen {
 public:
  MeshSeen(const Wall& wall, const Vec3& centre) : mesh_(wall.surface().mesh()), centre_(centre) {}

  [[nodiscard]] double distance() const {
    double nearest2 = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const auto v = corners(t);
      nearest2 = std::min(
          nearest2,
          norm2(centre_ - geometry::closest_point_on_triangle(centre_, v.at[0], v.at[1], v.at[2]).point));
    }
    return std::sqrt(nearest2);
  }

  [[nodiscard]] std::optional<Below> along(const Vec3& direction) const {
    std::optional<Below> first;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const auto v = corners(t);
      const auto d = geometry::ray_meets(centre_, direction, v.at);
      if (!d || *d < 0.0 || (first && first->distance <= *d)) continue;
      first = Below{*d, dot(cross(v.at[1] - v.at[0], v.at[2] - v.at[0]), direction) > 0.0};
    }
    return first;
  }

 private:
  struct Corners {
    Vec3 at[3];
  };
  [[nodiscard]] Corners corners(std::size_t t) const {
    const auto& v = mesh_.triangles[t];
    const auto at = [&](std::size_t k) { return mesh_.vertices[static_cast<std::size_t>(v[k])]; };
    return {{at(0), at(1), at(2)}};
  }

  const geometry::TriangleMesh& mesh_;
  Vec3 centre_;
};

std::optional<Below> plane_along(const Wall& wall, const Vec3& centre, const Vec3& direction) {
  const Vec3& n = wall.setup().mesh.normal;
  const double slope = dot(n, direction), height = dot(n, centre - wall.setup().mesh.position);
  if (!(slope < 0.0)) return {};
  return Below{-height / slope, false};
}

/// One particle against all walls.
class Placement {
 public:
  Placement(const simulation::Simulation& run, std::size_t p)
      : run_(run),
        name_(run.particles().name[p]),
        position_(run.particles().position[p]),
        guide_(run.particles().guide[p]),
        R_(run.particles().radius[p]),
        guided_(guide_ != Vec3{}) {}

  void check() const {
    std::optional<Below> nearest;
    const Wall* under = nullptr;
    for (const Wall& wall : run_.walls()) {
      const geometry::Pose pose = wall.pose_at(0.0);
      const Vec3 centre = pose.to_body(position_), direction = pose.turn_back(guide_);
      if (!wall.is_plane()) refuse_overlap(wall, centre, direction);
      if (!guided_) continue;
      const std::optional<Below> below =
          wall.is_plane() ? plane_along(wall, centre, direction) : MeshSeen(wall, centre).along(direction);
      if (below && (!nearest || below->distance < nearest->distance)) nearest = below, under = &wall;
    }
    if (guided_) refuse_bad_drop(nearest, under);
  }

 private:
  void refuse_overlap(const Wall& wall, const Vec3& centre, const Vec3& direction) const {
    const std::string& wall_name = wall.setup().name;
    const MeshSeen mesh(wall, centre);
    if (guided_) {
      const auto box = geometry::bounding_box(wall.surface().mesh().vertices);
      if (const std::string why = implausible_extent(wall_name, norm(box.high - box.low), name_, R_);
          !why.empty())
        throw InputError(why);
      if (const auto above = mesh.along(-direction); above && above->facing_away)
        throw InputError(fmt::format(
            "the centre of '{}' is {} below the surface of wall '{}' (or the mesh's normals point "
            "down); put it one radius, {}, above",
            name_, mm(above->distance), wall_name, mm(R_)));
    }
    const double overlap = R_ - mesh.distance();
    if (overlap > kDeepest * R_)
      throw InputError(fmt::format(
          "'{}' starts {} deep in wall '{}', {:.0f} % of its radius; more than 10 % is no contact but a "
          "mistake: put its centre one radius, {}, above the surface",
          name_, mm(overlap), wall_name, 100.0 * overlap / R_, mm(R_)));
  }

  void refuse_bad_drop(const std::optional<Below>& nearest, const Wall* under) const {
    if (!nearest)
      throw InputError(
          fmt::format("'{}' is not above any wall: nothing lies in the direction its guide lets it go; move "
                      "the particle or the mesh (mesh.position)",
                      name_));
    const std::string& wall_name = under->setup().name;
    if (nearest->facing_away)
      throw InputError(fmt::format(
          "'{}' is inside wall '{}', or sees the back of its triangles, {} away: put its centre one "
          "radius, {}, above the surface, or turn the normals of the mesh round",
          name_, wall_name, mm(nearest->distance), mm(R_)));
    const double gap = nearest->distance - R_;
    if (gap > kFarthest * R_)
      throw InputError(fmt::format(
          "'{}' hangs {} above wall '{}'; its guide only lets it drop: put its centre one radius, "
          "{}, above the surface, or move the mesh (mesh.position)",
          name_, mm(gap), wall_name, mm(R_)));
  }

  const simulation::Simulation& run_;
  const std::string& name_;
  Vec3 position_, guide_;
  double R_;
  bool guided_;
};

}  // namespace

void refuse_misplaced_particles(const simulation::Simulation& run) {
  if (std::ranges::all_of(run.walls(), [](const Wall& w) { return lies_flat(w.setup()); })) return;
  for (std::size_t p = 0; p < run.particles().size(); ++p) Placement(run, p).check();
}

}  // namespace abradem::io
