// SPDX-License-Identifier: BSD-3-Clause
// Walls and their shapes.
#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <numbers>

#include "abradem/core/units.h"
#include "abradem/io/case_checker.h"
#include "abradem/simulation/wall_motion.h"

namespace abradem::io {

using namespace simulation;

namespace {

double area(const MeshSetup& m) {
  if (m.shape == MeshShape::plate) return m.length * m.width;
  return std::numbers::pi * (m.outer * m.outer - m.inner * m.inner);
}
double extent(const MeshSetup& m) {
  return m.shape == MeshShape::plate ? std::max(m.length, m.width) : 2.0 * m.outer;
}
/// The smallest width a triangle has to fit into.
double narrowest(const MeshSetup& m) {
  if (m.shape == MeshShape::plate) return std::min(m.length, m.width);
  return m.shape == MeshShape::annulus ? m.outer - m.inner : 2.0 * m.outer;
}

}  // namespace

bool is_generated(MeshShape shape) noexcept {
  return shape == MeshShape::annulus || shape == MeshShape::disc || shape == MeshShape::plate;
}

void Checker::check_wall(const WallSetup& wall) {
  const std::string path = path_of("wall", wall.name);
  if (good(path + ".mesh") && !check_mesh(wall, path + ".mesh")) unusable_.insert(wall.name);
  if (wall.mesh.shape == MeshShape::plane && good(path + ".mesh") &&
      wall.deformation != DeformationRule::none)
    error(path + ".deformation",
          fmt::format("wall '{}' is an analytic plane, which has no nodes to move; use a plate or a disc",
                      wall.name));
  if (wall.sides == Sides::both && wall.mesh.shape == MeshShape::plane)
    error(path + ".sides",
          fmt::format("wall '{}' is an analytic plane, with a half space behind it; of a sheet use a plate, "
                      "a disc or a file",
                      wall.name));
  else if (wall.sides == Sides::both &&
           (wall.contact != ContactRule::resolved || wall.deformation != DeformationRule::none))
    error(
        path + ".sides",
        fmt::format("wall '{}' is touched from both sides, which takes contact = \"resolved\" and "
                    "deformation = \"none\": a sheet of one layer has no solid behind it that a patch could "
                    "overlap or wear take away",
                    wall.name));
  if (wall.mesh.shape != MeshShape::plane && wall.contact != ContactRule::resolved &&
      good(path + ".contact") && good("contact") && adheres(setup_, wall))
    error(path + ".contact",
          fmt::format("JKR contacts with wall '{}' last beyond zero overlap, which only contact = "
                      "\"resolved\" (or an analytic plane) can follow",
                      wall.name));
  if (wall.motion.surface_velocity != Vec3{} && setup_.run.method == Method::quasi_static &&
      good("run.method"))
    error(path + ".motion.surface_velocity",
          fmt::format("wall '{}' is a belt, which quasi_static has no balance for: set run.method = "
                      "\"dynamic\"",
                      wall.name));
  if (wall.motion.surface_velocity != Vec3{} && wall.deformation != DeformationRule::none)
    note(path + ".deformation",
         "the belt's wear is booked where it happens in space, not on the belt that runs through there");
  if (wall.deformation == DeformationRule::paper && wall.deform_every != 1)
    error(path + ".deform_every",
          fmt::format(
              "the deformation rule paper moves the nodes at every step: deform_every must be 1, got {}",
              wall.deform_every));
}

/// @return false when the shape makes no sense, so that nothing can be said about what lies on it
bool Checker::check_mesh(const WallSetup& wall, const std::string& path) {
  const MeshSetup& m = wall.mesh;
  if (m.shape == MeshShape::file && !places_.files_kept()) check_mesh_file(m, path);
  if (!is_generated(m.shape)) return true;
  if (m.shape == MeshShape::annulus && m.outer <= m.inner) {
    error(path + ".outer", fmt::format("the outer radius, {}, must be larger than the inner one, {}",
                                       readable(m.outer), readable(m.inner)));
    return false;
  }
  if (m.size > narrowest(m)) {
    error(path + ".size", fmt::format("triangles of {} do not fit into a shape {} wide; make size smaller",
                                      readable(m.size), readable(narrowest(m))));
    return false;
  }
  constexpr double kMost = 20e6;  // beyond what a workstation's memory is likely to hold
  const double triangles = estimated_triangles(m);
  if (triangles > kMost)
    error(path + ".size",
          fmt::format("triangles of {} on {:.4g} mm^2 would be {:.2g} of them, more than the 2e+07 "
                      "this program takes; make size at least {}",
                      core::format_quantity(m.size, "mm"), 1e6 * area(m), triangles,
                      mm(m.size * std::sqrt(triangles / kMost))));
  return true;
}

void Checker::check_mesh_file(const MeshSetup& m, const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  const fs::file_status status = fs::status(m.file, ignored);
  if (!fs::exists(status)) {
    error(path + ".file",
          fmt::format("mesh file '{}' does not exist (relative names start at the folder of the case "
                      "file)",
                      m.file));
  } else if (fs::is_directory(status)) {
    error(path + ".file", fmt::format("'{}' is a folder; expected a mesh file (.stl, .obj, .ply)", m.file));
  } else {
    std::string suffix = fs::path(m.file).extension().string();
    std::ranges::transform(suffix, suffix.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (suffix != ".stl" && suffix != ".obj" && suffix != ".ply")
      error(path + ".file",
            fmt::format("'{}' has a name that is none of .stl, .obj, .ply, the mesh formats this "
                        "program reads",
                        m.file));
  }
}

double estimated_triangles(const MeshSetup& mesh) noexcept {
  return area(mesh) / (std::numbers::sqrt3 / 4.0 * mesh.size * mesh.size);
}

bool lies_flat(const WallSetup& wall) noexcept {
  if (wall.mesh.shape == MeshShape::file || wall.mesh.rotation != Vec3{}) return false;
  // A table that has not been read says nothing yet.
  for (std::size_t k = 0; k < wall.motions(); ++k)
    if (wall.motion_at(k).kind == MotionKind::table && wall.motion_at(k).rows.empty()) return false;
  const geometry::Pose start = pose_of(wall, wall.motions(), 0.0), still;
  return start.shift == Vec3{} && start.row0 == still.row0 && start.row1 == still.row1;
}

std::string implausible_extent(const WallSetup& wall, std::string_view particle, double radius) {
  if (!is_generated(wall.mesh.shape)) return {};
  return implausible_extent(wall.name, extent(wall.mesh), particle, radius);
}

std::string implausible_extent(std::string_view wall, double extent, std::string_view particle,
                               double radius) {
  constexpr double kMostRadii = 3000.0;  // a 3 mm pin on a disc of 9 m; machines stay a hundred times below
  constexpr double kFewestRadii = 0.05;  // less than the contact itself is wide
  if (extent > kMostRadii * radius)
    return fmt::format(
        "wall '{}' is {} wide and '{}' has a radius of {}: is the wall given in millimetres? A bare number "
        "is in metres; write \"{:.4g} mm\" for its width, or set the unit of its file",
        wall, readable(extent), particle, readable(radius), extent);
  if (extent < kFewestRadii * radius)
    return fmt::format(
        "wall '{}' is {} wide and '{}' has a radius of {}: one of them is in the wrong unit of length", wall,
        readable(extent), particle, readable(radius));
  return {};
}

}  // namespace abradem::io
