// SPDX-License-Identifier: BSD-3-Clause
// Particles in numbers, and what they look like.
#include <fmt/core.h>

#include <algorithm>
#include <vector>

#include "abradem/core/suggest.h"
#include "abradem/io/case_checker.h"
#include "abradem/io/run_particles.h"
#include "abradem/simulation/insertion.h"

namespace abradem::io {

using namespace simulation;

void Checker::check_insertion_pairs(const InsertionSetup& insertion) {
  const std::string path = path_of("insertion", insertion.name) + ".material";
  require_contact(insertion.material, insertion.material, path,
                  fmt::format("particles of insertion '{}'", insertion.name));
  for (const WallSetup& w : setup_.walls)
    require_contact(insertion.material, w.material, path_of("wall", w.name) + ".material",
                    fmt::format("particles of insertion '{}' and wall '{}'", insertion.name, w.name));
  for (const ParticleSetup& p : setup_.particles)
    require_contact(insertion.material, p.material, path,
                    fmt::format("particles of insertion '{}' and particle '{}'", insertion.name, p.name));
  for (const InsertionSetup& other : setup_.insertions)
    if (&other < &insertion)
      require_contact(other.material, insertion.material, path,
                      fmt::format("particles of insertions '{}' and '{}'", other.name, insertion.name));
}

void Checker::check_shapes() {
  for (const ShapeSetup& shape : setup_.shapes) {
    const std::string path = path_of("shape", shape.name);
    if (!good(path)) continue;
    if (shape.spheres.empty() == !shape.fit)
      error(path, shape.fit ? "has both spheres and a fit; give one of them"
                            : "needs spheres = [{ position = …, radius = … }, …], or a fit to a mesh file");
    const auto has_it = [&](const auto& user) { return user.shape == shape.name; };
    if (std::ranges::none_of(setup_.insertions, has_it) && std::ranges::none_of(setup_.particles, has_it) &&
        good("insertion") && good("particle"))
      note(path, "no insertion and no particle uses this shape");
  }
  std::vector<std::string_view> known;
  for (const ShapeSetup& shape : setup_.shapes) known.emplace_back(shape.name);
  const auto check_user = [&](const std::string& path, const std::string& shape) {
    if (shape.empty() || !good(path) || !good("shape") || std::ranges::find(known, shape) != known.end())
      return;
    const std::string nearest = core::nearest_spelling(shape, known);
    error(path, nearest.empty() ? fmt::format("no shape '{}'; add [{}]", shape, path_of("shape", shape))
                                : fmt::format("no shape '{}'; did you mean '{}'?", shape, nearest));
  };
  for (const InsertionSetup& i : setup_.insertions)
    check_user(path_of("insertion", i.name) + ".shape", i.shape);
  for (const ParticleSetup& p : setup_.particles) check_user(path_of("particle", p.name) + ".shape", p.shape);
}

void Checker::check_insertions() {
  if (setup_.particles.empty() && setup_.insertions.empty() && good("particle") && good("insertion"))
    error("", "the case has no particles: add a [particle.NAME], or an [insertion.NAME] for many");
  for (const InsertionSetup& i : setup_.insertions) {
    check_insertion_pairs(i);
    const std::string path = path_of("insertion", i.name);
    if (!gives_places(i.volume.shape)) check_drawn(i, path);
    if (i.volume.shape == VolumeShape::run) check_left(i, path);
  }
  if (setup_.domain && good("domain")) {
    const Vec3 e = setup_.domain->high - setup_.domain->low;
    if (!(e.x > 0.0 && e.y > 0.0 && e.z > 0.0))
      error("domain.high", "every coordinate of high must be above that of low");
  }
  if (!setup_.insertions.empty() && setup_.run.method == Method::quasi_static && good("run.method"))
    error("run.method",
          "method = \"quasi_static\" balances guided particles; with an [insertion] use \"dynamic\"");
}

/// An insertion of what another run left.
void Checker::check_left(const InsertionSetup& i, const std::string& path) {
  const auto refuse = [&](const char* key, bool given) {
    if (given)
      error(fmt::format("{}.{}", path, key),
            fmt::format("'{}' does not count here: what a run left comes in as it was there", key));
  };
  refuse("number", i.number > 0);
  refuse("mass", i.mass.has_value());
  refuse("mass_rate", i.mass_rate.has_value());
  refuse("velocity", i.velocity != Vec3{});
  refuse("spin", i.spin != Vec3{});
  refuse("size", places_.given(path + ".size"));
  if (i.volume.run.empty() || places_.files_kept() || !good(path + ".volume.run")) return;
  if (const std::string why = why_no_run(i.volume.run); !why.empty()) error(path + ".volume.run", why);
}

/// An insertion whose spheres are drawn at random.
void Checker::check_face(const InsertionSetup& i, const std::string& path) {
  const Vec3 e = i.volume.high - i.volume.low;
  const double d = 2.0 * simulation::largest_radius(i.size);
  const int flat = (e.x == 0.0) + (e.y == 0.0) + (e.z == 0.0);
  const auto wide = [d](double x) { return x == 0.0 || x >= d; };
  if (flat != 1)
    error(path + ".volume", "a face has low and high equal along one axis, and apart along the others");
  else if (!wide(e.x) || !wide(e.y) || !wide(e.z))
    error(path + ".volume", fmt::format("is too small for one sphere of {:.4g} mm radius", 500.0 * d));
  const Vec3& v = i.velocity;
  const double through = e.x == 0.0 ? v.x : e.y == 0.0 ? v.y : v.z;
  if (flat == 1 && through == 0.0)
    error(path + ".velocity", "what comes in through a face needs a velocity away from it");
  if (!i.mass_rate) error(path + ".volume", "through a face particles come at a mass_rate");
}

void Checker::check_drawn(const InsertionSetup& i, const std::string& path) {
  const SizeSetup& size = i.size;
  if (size.kind == SizeKind::single && !(size.radius > 0.0) && i.shape.empty() && good(path + ".size.radius"))
    error(path, "needs a size, such as size = { radius = \"3 mm\" }");
  if (good(path + ".number") && good(path + ".mass") && (i.number == 0) == !i.mass)
    error(path, i.mass ? "has both a number and a mass; give one of them"
                       : "needs a number or a mass of particles to bring in");
  const bool bounded =
      size.kind == SizeKind::uniform || size.kind == SizeKind::normal || size.kind == SizeKind::lognormal;
  if (bounded && !(size.low <= size.high) && good(path + ".size"))
    error(path + ".size.high", "must not be below low");
  if (bounded && size.kind != SizeKind::uniform && (size.mean < size.low || size.mean > size.high) &&
      good(path + ".size"))
    error(path + ".size.mean", "must lie between low and high, or next to none would be kept");
  if (!good(path + ".volume")) return;
  const double R = simulation::largest_radius(size);
  const VolumeSetup& v = i.volume;
  const Vec3 e = v.high - v.low;
  if (v.shape == VolumeShape::face) {
    check_face(i, path);
    return;
  }
  const bool fits = v.shape == VolumeShape::box ? std::min({e.x, e.y, e.z}) >= 2.0 * R
                                                : v.radius >= R && norm(v.top - v.base) >= 2.0 * R;
  if (fits) return;
  constexpr double kSlip = 100.0;  // nearly the thousand of another unit
  const double width = v.shape == VolumeShape::box ? std::min({e.x, e.y, e.z}) : norm(v.top - v.base);
  error(path + ".volume", fmt::format("is too small for one sphere of {:.4g} mm radius{}", 1e3 * R,
                                      width > 0.0 && 2.0 * R > kSlip * width
                                          ? ": are the sizes in millimetres? A bare number is in metres"
                                          : ""));
}

}  // namespace abradem::io
