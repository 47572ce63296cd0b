// SPDX-License-Identifier: BSD-3-Clause
// Named particles: where they are, and what presses them.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "abradem/contact/hertz_mindlin.h"
#include "abradem/io/case_checker.h"

namespace abradem::io {

using namespace simulation;

namespace {

/// How far the point under the particle's centre is outside a flat shape [m]; <= 0: above it.
double distance_outside(const MeshSetup& m, const Vec3& at) {
  const Vec3 r = at - m.position;
  const double radius = std::hypot(r.x, r.y);
  switch (m.shape) {
    case MeshShape::annulus:
      return std::max(m.inner - radius, radius - m.outer);
    case MeshShape::disc:
      return radius - m.outer;
    case MeshShape::plate:
      return std::max(std::abs(r.x) - 0.5 * m.length, std::abs(r.y) - 0.5 * m.width);
    case MeshShape::plane:
    case MeshShape::file:
      return -1.0;
  }
  return -1.0;
}

std::string ring_hint(const WallSetup& wall) {
  if (wall.mesh.shape != MeshShape::annulus) return {};
  return fmt::format(", a ring from {} to {}", readable(wall.mesh.inner), readable(wall.mesh.outer));
}

std::string inside_message(const ParticleSetup& p, const WallSetup& wall, double height) {
  if (height <= 0.0)
    return fmt::format(
        "the centre of '{}' is {} below the surface of wall '{}'; put it one radius, {}, above", p.name,
        readable(-height), wall.name, readable(p.radius));
  return fmt::format(
      "'{}' starts {} deep in wall '{}', {:.0f} % of its radius; more than 10 % is no contact but a "
      "mistake: put its centre one radius, {}, above the surface",
      p.name, readable(p.radius - height), wall.name, 100.0 * (p.radius - height) / p.radius,
      readable(p.radius));
}

}  // namespace

void Checker::check_particle(const ParticleSetup& p) {
  const std::string path = path_of("particle", p.name);
  if (!p.shape.empty()) {
    check_named_clump(p, path);
    return;
  }
  if (p.radius == 0.0 && good(path + ".radius")) {
    error(path, fmt::format("missing key 'radius' in [{}]: Radius of the sphere. Example: radius = \"3 mm\"",
                            path));
    return;
  }
  if (p.rotation != Vec3{})
    error(path + ".rotation",
          fmt::format("'{}' is a sphere: a rotation is for a particle with a shape", p.name));
  if (p.guide == Guide::vertical && norm2(p.spin) > 0.0)
    error(path + ".spin",
          fmt::format("the guide of '{}' blocks its spin; leave spin out, or set guide = \"none\"", p.name));
  if (p.guide == Guide::vertical && good(path) && norm2(p.load) == 0.0 && norm2(setup_.run.gravity) == 0.0)
    note(path, fmt::format("nothing presses '{}' down: it has no load, and the run has no gravity", p.name));
  if (good(path)) check_load(p, path);
  if (!good(path + ".radius") || !good(path + ".position")) return;
  constexpr double kLargestPin = 1.0;
  if (p.guide == Guide::vertical && p.radius > kLargestPin)
    error(path + ".radius",
          fmt::format("'{}' has a radius of {}; a bare number is in metres: was \"{:.4g} mm\" meant?", p.name,
                      readable(p.radius), p.radius));
  else
    check_placement(p, path);
}

/// What is free among particles in numbers, and has a name.
void Checker::check_named_clump(const ParticleSetup& p, const std::string& path) {
  const auto refuse = [&](const char* key, bool given) {
    if (given)
      error(fmt::format("{}.{}", path, key),
            fmt::format("'{}' has a shape, and moves freely: a {} is for a sphere", p.name, key));
  };
  refuse("guide", p.guide != Guide::none);
  refuse("load", p.load != Vec3{});
  if (setup_.run.method == Method::quasi_static && good("run.method"))
    error(path + ".shape", "method = \"quasi_static\" balances guided spheres; a clump needs \"dynamic\"");
}

/// Does the load, shared by all walls, leave the particle in what Hertz's law holds for?
void Checker::check_load(const ParticleSetup& p, const std::string& path) {
  constexpr double kDeepest = 0.1;
  const auto material_named = [&](const std::string& name) {
    return std::ranges::find(setup_.materials, name, &MaterialSetup::name);
  };
  const auto own = material_named(p.material);
  const double share = norm(p.load) / static_cast<double>(setup_.walls.size());
  double least = std::numeric_limits<double>::infinity();
  for (const WallSetup& wall : setup_.walls) {
    const auto other = material_named(wall.material);
    if (own == setup_.materials.end() || other == setup_.materials.end()) return;
    least = std::min(
        least, contact::hertz_overlap(
                   material::effective_moduli({own->density, own->shear_modulus, own->poisson_ratio},
                                              {other->density, other->shear_modulus, other->poisson_ratio}),
                   p.radius, share));
  }
  if (setup_.walls.empty() || least <= kDeepest * p.radius) return;
  const std::string_view why =
      "more than a tenth of its radius, where Hertz's law of contact ends; check the load (N) and the "
      "shear moduli (Pa)";
  if (std::isfinite(least))
    note(path + ".load",
         fmt::format("the load would press '{}' {} deep into the wall, {}", p.name, readable(least), why));
  else
    error(path + ".load", fmt::format("the load would press '{}' through the wall, {}", p.name, why));
}

void Checker::check_placement(const ParticleSetup& p, const std::string& path) {
  constexpr double kDeepest = 0.1;   // overlap over radius beyond which Hertz contact means nothing
  constexpr double kFarthest = 0.5;  // gap over radius beyond which a pin is not meant to be
  const bool guided = p.guide == Guide::vertical;
  const WallSetup* nearest = nullptr;  // the flat wall under the pin, or the one closest to be
  double nearest_outside = 0.0, nearest_gap = 0.0;
  bool unknown = setup_.walls.empty();
  for (const WallSetup& wall : setup_.walls) {
    const std::string mesh = path_of("wall", wall.name) + ".mesh";
    if (!good(mesh) || unusable_.contains(wall.name) || !lies_flat(wall)) {
      unknown = true;  // its shape is known only once the file is read
      continue;
    }
    if (guided && is_generated(wall.mesh.shape)) {
      const std::string why = implausible_extent(wall, p.name, p.radius);
      if (!why.empty()) {
        error(mesh, why);
        return;
      }
    }
    const bool plane = wall.mesh.shape == MeshShape::plane;
    const double height =
        dot(p.position - wall.mesh.position, plane ? wall.mesh.normal : Vec3{0.0, 0.0, 1.0});
    const double outside = distance_outside(wall.mesh, p.position);
    const double gap = height - p.radius;
    const bool behind = height <= -p.radius && !plane && !guided;  // a free sphere may be under a plate
    if (outside <= 0.0 && gap < -kDeepest * p.radius && !behind) {
      error(path + ".position", inside_message(p, wall, height));
      return;
    }
    if (nearest == nullptr || std::max(outside, 0.0) < std::max(nearest_outside, 0.0) ||
        (outside <= 0.0 && nearest_outside <= 0.0 && gap < nearest_gap)) {
      nearest = &wall;
      nearest_outside = outside;
      nearest_gap = gap;
    }
  }
  if (!guided || unknown || nearest == nullptr) return;
  if (nearest_outside > 0.0)
    error(path + ".position",
          fmt::format("'{}' is not above any wall: it misses wall '{}' by {} sideways{}", p.name,
                      nearest->name, readable(nearest_outside), ring_hint(*nearest)));
  else if (nearest_gap > kFarthest * p.radius)
    error(path + ".position",
          fmt::format(
              "'{}' hangs {} above wall '{}'; its guide only lets it drop: put its centre one radius, {}, "
              "above the surface",
              p.name, readable(nearest_gap), nearest->name, readable(p.radius)));
}

}  // namespace abradem::io
