// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/case_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <optional>
#include <set>
#include <vector>

#include "abradem/contact/hertz_mindlin.h"
#include "abradem/core/suggest.h"
#include "abradem/core/units.h"
#include "abradem/io/case_motions.h"
#include "abradem/io/case_schema.h"
#include "abradem/simulation/insertion.h"
#include "abradem/simulation/wall_motion.h"

namespace abradem::io {
namespace {

using namespace simulation;

std::string mm(double metres) { return fmt::format("{:.4g} mm", 1e3 * metres); }
/// A length in the unit a person would choose.
std::string readable(double metres) {
  return std::abs(metres) < 1.0 ? mm(metres) : fmt::format("{:.4g} m", metres);
}

std::string path_of(std::string_view section, std::string_view name) {
  return fmt::format("{}.{}", section, toml_key(name));
}

bool is_generated(MeshShape shape) {
  return shape == MeshShape::annulus || shape == MeshShape::disc || shape == MeshShape::plate;
}

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

class Checker {
 public:
  Checker(const Setup& setup, const Places& places, Problems& problems)
      : setup_(setup), places_(places), problems_(problems) {}

  void run() {
    for (const MaterialSetup& m : setup_.materials) materials_.insert(m.name);
    check_names();
    check_contact_pairs();
    check_wear_pairs();
    check_wear_laws();
    check_ploughing();
    check_regions();
    for (const WallSetup& wall : setup_.walls) check_wall(wall);
    for (const ParticleSetup& particle : setup_.particles) check_particle(particle);
    check_shapes();
    check_insertions();
    check_run();
    check_acceleration();
    check_measurement();
    check_published();
  }

 private:
  void error(const std::string& path, std::string message) {
    problems_.error(places_.of(path), std::move(message));
  }
  void note(const std::string& path, std::string message) {
    problems_.note(places_.of(path), std::move(message));
  }
  [[nodiscard]] bool good(const std::string& path) const { return places_.good(path); }

  // ---- names
  // -------------------------------------------------------------------------------------------------

  bool check_material(const std::string& name, const std::string& path) {
    if (materials_.contains(name)) return true;
    const std::vector<std::string_view> known(materials_.begin(), materials_.end());
    const std::string nearest = core::nearest_spelling(name, known);
    error(path, nearest.empty() ? fmt::format("no material '{}'; add [{}], or use one of: {}", name,
                                              path_of("material", name), fmt::join(known, ", "))
                                : fmt::format("no material '{}'; did you mean '{}'?", name, nearest));
    return false;
  }

  void check_names() {
    if (!good("material") && materials_.empty()) return;
    const auto check_pair = [&](std::string_view section, const std::string& a, const std::string& b) {
      const std::string path = path_of(section, a + "/" + b);
      check_material(a, path);
      if (b != a) check_material(b, path);
    };
    for (const ContactSetup& c : setup_.contacts) check_pair("contact", c.first, c.second);
    for (const WearSetup& w : setup_.wear) check_pair("wear", w.abrader, w.worn);
    const auto check_user = [&](const std::string& path, const std::string& material) {
      if (good(path)) check_material(material, path);
    };
    for (const WallSetup& w : setup_.walls) check_user(path_of("wall", w.name) + ".material", w.material);
    for (const ParticleSetup& p : setup_.particles)
      check_user(path_of("particle", p.name) + ".material", p.material);
    for (const InsertionSetup& i : setup_.insertions)
      check_user(path_of("insertion", i.name) + ".material", i.material);
  }

  // ---- pairs
  // -------------------------------------------------------------------------------------------------

  [[nodiscard]] bool has_contact(const std::string& a, const std::string& b) const {
    return std::ranges::any_of(setup_.contacts, [&](const ContactSetup& c) {
      return (c.first == a && c.second == b) || (c.first == b && c.second == a);
    });
  }

  void require_contact(const std::string& a, const std::string& b, const std::string& path,
                       const std::string& who) {
    if (!good("contact") || !materials_.contains(a) || !materials_.contains(b) || has_contact(a, b)) return;
    if (!reported_.insert({std::min(a, b), std::max(a, b)}).second) return;
    error(path, fmt::format("{} can touch, but the case has no contact pair for their materials; add [{}]",
                            who, path_of("contact", a + "/" + b)));
  }

  void check_contact_pairs() {
    for (std::size_t i = 0; i < setup_.contacts.size(); ++i) {
      const ContactSetup& c = setup_.contacts[i];
      for (std::size_t j = 0; j < i; ++j) {
        const ContactSetup& d = setup_.contacts[j];
        if (c.first == d.second && c.second == d.first)
          error(path_of("contact", c.first + "/" + c.second),
                fmt::format("this pair is already given as [{}]; the order of the names makes no difference",
                            path_of("contact", d.first + "/" + d.second)));
      }
    }
    const auto& particles = setup_.particles;
    for (std::size_t i = 0; i < particles.size(); ++i) {
      const ParticleSetup& p = particles[i];
      for (const WallSetup& w : setup_.walls)
        require_contact(p.material, w.material, path_of("wall", w.name) + ".material",
                        fmt::format("particle '{}' and wall '{}'", p.name, w.name));
      // Two pins in their holders never meet.
      for (std::size_t j = 0; j < i; ++j)
        if (p.guide == Guide::none || particles[j].guide == Guide::none)
          require_contact(particles[j].material, p.material, path_of("particle", p.name) + ".material",
                          fmt::format("particles '{}' and '{}'", particles[j].name, p.name));
    }
  }

  void check_insertion_pairs(const InsertionSetup& insertion) {
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

  void check_shapes() {
    for (const ShapeSetup& shape : setup_.shapes) {
      const std::string path = path_of("shape", shape.name);
      if (!good(path)) continue;
      if (shape.spheres.empty() == !shape.fit)
        error(path, shape.fit ? "has both spheres and a fit; give one of them"
                              : "needs spheres = [{ position = …, radius = … }, …], or a fit to a mesh file");
      if (std::ranges::none_of(setup_.insertions,
                               [&](const InsertionSetup& i) { return i.shape == shape.name; }) &&
          good("insertion"))
        note(path, "no insertion uses this shape");
    }
    std::vector<std::string_view> known;
    for (const ShapeSetup& shape : setup_.shapes) known.emplace_back(shape.name);
    for (const InsertionSetup& i : setup_.insertions) {
      const std::string path = path_of("insertion", i.name) + ".shape";
      if (i.shape.empty() || !good(path) || !good("shape") ||
          std::ranges::find(known, i.shape) != known.end())
        continue;
      const std::string nearest = core::nearest_spelling(i.shape, known);
      error(path, nearest.empty() ? fmt::format("no shape '{}'; add [{}]", i.shape, path_of("shape", i.shape))
                                  : fmt::format("no shape '{}'; did you mean '{}'?", i.shape, nearest));
    }
  }

  void check_insertions() {
    if (setup_.particles.empty() && setup_.insertions.empty() && good("particle") && good("insertion"))
      error("", "the case has no particles: add a [particle.NAME], or an [insertion.NAME] for many");
    for (const InsertionSetup& i : setup_.insertions) {
      check_insertion_pairs(i);
      const std::string path = path_of("insertion", i.name);
      if (i.volume.shape != VolumeShape::file) check_drawn(i, path);
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

  /// An insertion whose spheres are drawn at random.
  void check_face(const InsertionSetup& i, const std::string& path) {
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
  void check_drawn(const InsertionSetup& i, const std::string& path) {
    const SizeSetup& size = i.size;
    if (size.kind == SizeKind::single && !(size.radius > 0.0) && i.shape.empty() &&
        good(path + ".size.radius"))
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

  void check_wear_pairs() {
    if (!good("wear")) return;
    bool deforms = false;
    for (const WallSetup& wall : setup_.walls) {
      if (wall.deformation == DeformationRule::none) continue;
      deforms = true;
      const std::string path = path_of("wall", wall.name);
      std::set<std::string> asked;
      std::vector<std::string> abraders;
      for (const ParticleSetup& p : setup_.particles) abraders.push_back(p.material);
      for (const InsertionSetup& i : setup_.insertions) abraders.push_back(i.material);
      for (const std::string& abrader : abraders) {
        if (!materials_.contains(abrader) || !materials_.contains(wall.material)) continue;
        const bool known = std::ranges::any_of(
            setup_.wear, [&](const WearSetup& w) { return w.abrader == abrader && w.worn == wall.material; });
        if (known || !asked.insert(abrader).second) continue;
        error(
            path + ".deformation",
            fmt::format(
                "wall '{}' changes its shape, but the case does not say how '{}' wears '{}'; add [{}] (with "
                "wear_coefficient = 0 for no wear), or set deformation = \"none\"",
                wall.name, abrader, wall.material, path_of("wear", abrader + "/" + wall.material)));
      }
    }
    if (!setup_.wear.empty() && !deforms && !setup_.walls.empty() && good("wall"))
      note(
          "wear",
          "wear is counted, but no wall changes its shape; set deformation = \"conserving\" on the wall that "
          "wears");
  }

  /// What laws beside Archard's ask of the rest of the case.
  void check_wear_laws() {
    if (!good("wear") || !good("material")) return;
    for (const WearSetup& w : setup_.wear) {
      const std::string path = path_of("wear", w.abrader + "/" + w.worn);
      const auto has = [&](WearLaw law) { return std::ranges::find(w.laws, law) != w.laws.end(); };
      if (w.laws == std::vector{WearLaw::archard}) continue;
      const auto worn = std::ranges::find(setup_.materials, w.worn, &MaterialSetup::name);
      if (has(WearLaw::oka) && worn != setup_.materials.end() && !worn->hardness)
        error(path + ".law",
              fmt::format("Oka's law needs the hardness of '{}': add hardness = \"143 HV\" to [{}]", w.worn,
                          path_of("material", w.worn)));
      if (has(WearLaw::impact_energy) && w.normal_energy_coefficient == 0.0 &&
          w.shear_energy_coefficient == 0.0)
        error(path + ".law",
              "impact_energy needs a normal_energy_coefficient or a shear_energy_coefficient above 0");
      if (setup_.run.method == Method::quasi_static && good("run.method") &&
          (has(WearLaw::finnie) || has(WearLaw::oka) || has(WearLaw::impact_energy)))
        error(path + ".law", "a balance of forces has no impacts: set run.method = \"dynamic\"");
      if (setup_.ploughing && setup_.ploughing->removed_fraction < 1.0)
        error(path + ".law", "[ploughing] shares out what Archard's law removes; use law = \"archard\"");
      for (const ParticleSetup& p : setup_.particles)
        if (p.guide != Guide::none && p.material == w.worn)
          error(path + ".law",
                fmt::format("the tip of '{}' wears by Archard's law alone; use law = \"archard\"", p.name));
    }
  }

  void check_regions() {
    if (!good("region")) return;
    if (setup_.regions.size() > 1000)
      error("region", fmt::format("{} regions; at most 1000 are possible", setup_.regions.size()));
    for (const RegionSetup& region : setup_.regions) {
      const std::string path = path_of("region", region.name);
      const auto wall = std::ranges::find(setup_.walls, region.wall, &WallSetup::name);
      if (wall == setup_.walls.end() && good("wall")) {
        std::vector<std::string_view> known;
        for (const WallSetup& w : setup_.walls) known.push_back(w.name);
        const std::string nearest = core::nearest_spelling(region.wall, known);
        error(path + ".wall",
              nearest.empty()
                  ? fmt::format("no wall '{}'; the case has: {}", region.wall, fmt::join(known, ", "))
                  : fmt::format("no wall '{}'; did you mean '{}'?", region.wall, nearest));
      } else if (wall != setup_.walls.end() && wall->mesh.shape == MeshShape::plane) {
        error(path + ".wall", fmt::format("wall '{}' is a plane, which has no elements", region.wall));
      }
      const Vec3 e = region.high - region.low;
      if (good(path + ".low") && good(path + ".high") && !(e.x > 0.0 && e.y > 0.0 && e.z > 0.0))
        error(path + ".high", "every coordinate of high must be above that of low");
      const bool named_as_wall =
          std::ranges::find(setup_.walls, region.name, &WallSetup::name) != setup_.walls.end();
      if (named_as_wall) error(path, "has the name of a wall, under which the rest of that wall is counted");
    }
  }

  void check_ploughing() {
    if (!setup_.ploughing || setup_.ploughing->removed_fraction == 1.0 || !good("wall")) return;
    if (setup_.output.maps == simulation::Maps::on)
      error("output.maps", "what [ploughing] moves aside has no map; use maps = \"off\"");
    for (const WallSetup& wall : setup_.walls)
      if (wall.deformation == DeformationRule::paper)
        error(
            path_of("wall", wall.name) + ".deformation",
            "the deformation rule paper moves whole elements inwards and has no ridges; with [ploughing] use "
            "deformation = \"conserving\"");
  }

  // ---- walls
  // -------------------------------------------------------------------------------------------------

  void check_wall(const WallSetup& wall) {
    const std::string path = path_of("wall", wall.name);
    if (good(path + ".mesh") && !check_mesh(wall, path + ".mesh")) unusable_.insert(wall.name);
    if (wall.mesh.shape == MeshShape::plane && good(path + ".mesh") &&
        wall.deformation != DeformationRule::none)
      error(path + ".deformation",
            fmt::format("wall '{}' is an analytic plane, which has no nodes to move; use a plate or a disc",
                        wall.name));
    if (wall.sides == Sides::both && wall.mesh.shape == MeshShape::plane)
      error(
          path + ".sides",
          fmt::format("wall '{}' is an analytic plane, with a half space behind it; of a sheet use a plate, "
                      "a disc or a file",
                      wall.name));
    else if (wall.sides == Sides::both &&
             (wall.contact != ContactRule::resolved || wall.deformation != DeformationRule::none))
      error(path + ".sides",
            fmt::format(
                "wall '{}' is touched from both sides, which takes contact = \"resolved\" and "
                "deformation = \"none\": a sheet of one layer has no solid behind it that a patch could "
                "overlap or wear take away",
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
  bool check_mesh(const WallSetup& wall, const std::string& path) {
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

  void check_mesh_file(const MeshSetup& m, const std::string& path) {
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

  // ---- particles
  // ---------------------------------------------------------------------------------------------

  void check_particle(const ParticleSetup& p) {
    const std::string path = path_of("particle", p.name);
    if (p.guide == Guide::vertical && norm2(p.spin) > 0.0)
      error(
          path + ".spin",
          fmt::format("the guide of '{}' blocks its spin; leave spin out, or set guide = \"none\"", p.name));
    if (p.guide == Guide::vertical && good(path) && norm2(p.load) == 0.0 && norm2(setup_.run.gravity) == 0.0)
      note(path,
           fmt::format("nothing presses '{}' down: it has no load, and the run has no gravity", p.name));
    if (good(path)) check_load(p, path);
    if (!good(path + ".radius") || !good(path + ".position")) return;
    constexpr double kLargestPin = 1.0;
    if (p.guide == Guide::vertical && p.radius > kLargestPin)
      error(path + ".radius",
            fmt::format("'{}' has a radius of {}; a bare number is in metres: was \"{:.4g} mm\" meant?",
                        p.name, readable(p.radius), p.radius));
    else
      check_placement(p, path);
  }

  /// Does the load, shared by all walls, leave the particle in what Hertz's law holds for?
  void check_load(const ParticleSetup& p, const std::string& path) {
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

  /// How far the point under the particle's centre is outside a flat shape [m]; <= 0: above it.
  static double distance_outside(const MeshSetup& m, const Vec3& at) {
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

  void check_placement(const ParticleSetup& p, const std::string& path) {
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

  static std::string ring_hint(const WallSetup& wall) {
    if (wall.mesh.shape != MeshShape::annulus) return {};
    return fmt::format(", a ring from {} to {}", readable(wall.mesh.inner), readable(wall.mesh.outer));
  }

  static std::string inside_message(const ParticleSetup& p, const WallSetup& wall, double height) {
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

  // ---- run
  // ---------------------------------------------------------------------------------------------------

  void check_run() {
    const bool turns = counts_revolutions(setup_) || !good("wall");
    constexpr std::string_view kNothingTurns =
        "revolutions cannot be counted: no wall has a motion of kind rotation or oscillation; give a time "
        "such as "
        "\"24 s\"";
    if (!turns && setup_.run.end.in_revolutions && good("run.end"))
      error("run.end", std::string(kNothingTurns));
    if (!turns && setup_.output.every.in_revolutions && places_.given("output.every") && good("output.every"))
      error("output.every", std::string(kNothingTurns));
    if (setup_.run.end.in_revolutions == setup_.output.every.in_revolutions && good("run.end") &&
        good("output") && setup_.output.every.value > setup_.run.end.value && places_.given("output.every"))
      note("output.every", "is longer than the run: only the start and the end will be written");
    if (setup_.run.increment && setup_.run.method == Method::dynamic && good("run.method"))
      note("run.increment", "counts only with method = \"quasi_static\"; a dynamic run takes time_step");
    if (setup_.run.method == Method::quasi_static) check_quasi_static();
  }

  void check_quasi_static() {
    if (!good("particle") || !good("wall")) return;
    for (const ParticleSetup& p : setup_.particles) {
      const std::string path = path_of("particle", p.name);
      if (p.guide == Guide::none)
        error(path,
              fmt::format(
                  "method = \"quasi_static\" balances the load of guided particles, and '{}' is free; set "
                  "guide = \"vertical\", or run.method = \"dynamic\"",
                  p.name));
      else if (!(p.load.z < 0.0))
        error(path + ".load",
              fmt::format("method = \"quasi_static\" needs a load that presses '{}' down, such as load = "
                          "\"5 N\"",
                          p.name));
    }
    if (std::ranges::all_of(setup_.walls,
                            [](const WallSetup& w) { return leading_motion(w).kind == MotionKind::none; }))
      error("run.method", "method = \"quasi_static\" steps along a sliding distance, but no wall moves");
  }

  void check_acceleration() {
    if (!good("wear")) return;
    for (const WearSetup& w : setup_.wear) {
      const std::string path = path_of("wear", w.abrader + "/" + w.worn);
      const WearSetup& first = setup_.wear.front();
      if (w.acceleration != first.acceleration)
        error(path + ".acceleration",
              fmt::format("every wear pair must have the same acceleration, and [{}] has another: they "
                          "shorten one and the same run",
                          path_of("wear", first.abrader + "/" + first.worn)));
      else if (w.acceleration.automatic && w.tolerance != first.tolerance)
        error(path + ".tolerance", fmt::format("every wear pair must have the same tolerance, and [{}] has "
                                               "another: one acceleration is chosen for the run",
                                               path_of("wear", first.abrader + "/" + first.worn)));
      if (!w.acceleration.automatic && w.acceleration.factor == 1.0) continue;
      if (!counts_revolutions(setup_) && good("wall"))
        error(path + ".acceleration",
              "acceleration leaves out revolutions, but no wall has a motion of kind rotation or "
              "oscillation");
    }
  }

  void check_measurement() {
    if (!setup_.measurement) return;
    const auto check = [&](const std::optional<Range>& range, const std::string& path) {
      if (range && good(path) && range->low > range->high)
        error(path + ".low", fmt::format("the smallest value, {}, is above the largest, {}", mm(range->low),
                                         mm(range->high)));
    };
    check(setup_.measurement->depth, "measurement.depth");
    check(setup_.measurement->width, "measurement.width");
  }

  void check_published() {
    if (!setup_.study || !good("study")) return;
    const StudySetup& study = *setup_.study;
    if (study.page == StudyPage::paper && study.published.empty())
      error("study.page",
            "page = \"paper\" compares with published values: name their file, published = "
            "\"claims.json\"");
    std::error_code ignored;
    if (!study.published.empty() && !std::filesystem::is_regular_file(study.published, ignored))
      error("study.published", fmt::format("there is no file '{}' (relative names start at the folder of the "
                                           "case file)",
                                           study.published));
  }

  const Setup& setup_;
  const Places& places_;
  Problems& problems_;
  std::set<std::string> materials_;
  std::set<std::string> unusable_;  // walls whose shape is wrong
  std::set<std::pair<std::string, std::string>> reported_;
};

}  // namespace

Place Places::of(std::string path) const {
  while (true) {
    if (const auto found = places_.find(path); found != places_.end()) return found->second;
    const std::size_t dot = path.rfind('.');
    if (dot == std::string::npos) return {};
    path.resize(dot);
  }
}

bool Places::good(const std::string& path) const {
  const auto found = wrong_.lower_bound(path);
  for (auto it = found; it != wrong_.end() && it->first.starts_with(path); ++it)
    if (it->first.size() == path.size() || it->first[path.size()] == '.' || it->first[path.size()] == '[')
      return false;
  return true;
}

void check_case(const Setup& setup, const Places& places, Problems& problems) {
  Checker(setup, places, problems).run();
  check_motions(setup, places, problems);
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

bool counts_revolutions(const Setup& setup) noexcept {
  return std::ranges::any_of(setup.walls, [](const WallSetup& w) { return cyclic_motion(w) != nullptr; });
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
