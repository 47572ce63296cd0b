// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/case_units.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "abradem/io/case_motions.h"
#include "abradem/io/case_schema.h"
#include "abradem/simulation/insertion.h"
#include "abradem/simulation/wall_motion.h"

namespace abradem::io {
namespace {

using namespace simulation;

std::string path_of(std::string_view section, std::string_view name) {
  return fmt::format("{}.{}", section, toml_key(name));
}

class Units {
 public:
  Units(const Setup& setup, const Places& places, Problems& problems)
      : setup_(setup), places_(places), problems_(problems) {}

  void check() {
    for (const MaterialSetup& m : setup_.materials) check_material(m, path_of("material", m.name));
    for (const WearSetup& w : setup_.wear) check_wear(w, path_of("wear", w.abrader + "/" + w.worn));
    for (const WallSetup& w : setup_.walls)
      for (std::size_t k = 0; k < w.motions(); ++k)
        check_motion(w, w.motion_at(k), motion_path(w, k, places_));
    for (const ParticleSetup& p : setup_.particles) check_particle(p, path_of("particle", p.name));
    for (const InsertionSetup& i : setup_.insertions) check_insertion(i, path_of("insertion", i.name));
    constexpr double kStrongest = 100.0;  // ten times the Earth's
    if (const double g = norm(setup_.run.gravity); g > kStrongest)
      ask("run.gravity", "gravity is {:.4g} m/s^2, {:.3g} times the Earth's: is it in mm/s^2?", g, g / 9.81);
  }

 private:
  template <typename... T>
  void ask(const std::string& path, fmt::format_string<T...> question, T&&... values) {
    if (places_.good(path))
      problems_.note(places_.of(path), fmt::format(question, std::forward<T>(values)...));
  }

  void check_material(const MaterialSetup& m, const std::string& path) {
    constexpr double kFastest = 15e3;                         // [m/s]; shear waves in diamond: 12.8 km/s
    constexpr double kLightest = 30.0, kDensest = 23e3;       // [kg/m^3] foam; osmium has 22 590
    constexpr double kSoftest = 1e4, kSoftestHardness = 1e6;  // [Pa] jelly; lead has 40 MPa
    if (!places_.good(path)) return;
    const double wave = std::sqrt(m.shear_modulus / m.density);
    if (wave > kFastest) {
      problems_.error(
          places_.of(path + ".density"),
          fmt::format("shear waves would run through '{}' at {:.3g} km/s, faster than through diamond (12.8 "
                      "km/s): is the density, {:.4g} kg/m^3, in g/cm^3 (\"{:.4g} g/cm^3\")? Or is the shear "
                      "modulus, {:.3g} GPa, too large?",
                      m.name, 1e-3 * wave, m.density, m.density, 1e-9 * m.shear_modulus));
    } else if (m.density < kLightest) {
      ask(path + ".density",
          "'{}' has a density of {:.4g} kg/m^3, less than foam: is it in g/cm^3? Then write \"{:.4g} "
          "g/cm^3\"",
          m.name, m.density, m.density);
    } else if (m.density > kDensest) {
      ask(path + ".density",
          "'{}' has a density of {:.4g} kg/m^3, more than any element (osmium, 22 590): is it in another "
          "unit, "
          "or scaled on purpose?",
          m.name, m.density);
    }
    if (m.shear_modulus < kSoftest)
      ask(path + ".shear_modulus",
          "'{}' has a shear modulus of {:.4g} Pa, less than jelly: is it in GPa? Then write \"{:.4g} GPa\"",
          m.name, m.shear_modulus, m.shear_modulus);
    if (m.hardness && *m.hardness < kSoftestHardness)
      ask(path + ".hardness",
          "'{}' has a hardness of {:.4g} Pa, less than any metal: is it in HV? Then write \"{:.4g} HV\"",
          m.name, *m.hardness, *m.hardness);
  }

  void check_wear(const WearSetup& w, const std::string& path) {
    constexpr double kLargest = 1e-6;  // [1/Pa]: k = 1, every asperity a chip, in a metal of 1 MPa
    if (w.wear_coefficient > kLargest)
      ask(path + ".wear_coefficient",
          "wear_coefficient is {:.4g} 1/Pa, {:.3g} mm^3 per newton and metre; it is k / H and near 1e-13 "
          "1/Pa "
          "for most metals: is this the dimensionless k, still to be divided by the hardness?",
          w.wear_coefficient, 1e9 * w.wear_coefficient);
  }

  /// Fastest that a motion takes the wall along under a particle [m/s].
  [[nodiscard]] double speed(const MotionSetup& motion) const {
    const MotionLimits most = limits_of(motion);
    double arm = 0.0;
    for (const ParticleSetup& p : setup_.particles)
      arm = std::max(arm, norm(cross(motion.axis, p.position - motion.center)));
    return most.speed + most.rate * arm;
  }

  void check_motion(const WallSetup& wall, const MotionSetup& m, const std::string& path) {
    constexpr double kFastest = 100.0;       // [m/s]: a grinding wheel
    constexpr double kFewestDegrees = 10.0;  // of a bare rate: whoever thinks in radians writes 3.14 or 6.28
    constexpr double kWidest = 200.0;        // of an oscillation, in radii
    if (!places_.good(path)) return;
    const double fastest = speed(m);
    if (m.kind == MotionKind::rotation && places_.bare(path + ".rate") && std::abs(m.rate) >= kFewestDegrees)
      ask(path + ".rate",
          "rate = {:.6g} is in rad/s, {:.3g} turns per second: is it in degrees? Write \"{:.6g} deg/s\", or "
          "\"{:.6g} rad/s\"",
          m.rate, std::abs(m.rate) / (2.0 * std::numbers::pi), m.rate, m.rate);
    else if (fastest > kFastest)
      ask(path, "wall '{}' moves at {:.4g} m/s where a particle is: is its motion in {}?", wall.name, fastest,
          m.kind == MotionKind::rotation ? "another unit than rad/s (\"deg/s\", \"rpm\")" : "mm/s");
    if (m.kind != MotionKind::oscillation) return;
    for (const ParticleSetup& p : setup_.particles)
      if (const double width = norm(m.amplitude); p.shape.empty() && width > kWidest * p.radius) {
        ask(path + ".amplitude",
            "wall '{}' goes {:.4g} m to and fro, and '{}' has a radius of {:.4g} mm: is the amplitude in "
            "millimetres? A bare number is in metres",
            wall.name, width, p.name, 1e3 * p.radius);
        return;
      }
  }

  void check_particle(const ParticleSetup& p, const std::string& path) {
    constexpr double kFastest = 100.0;  // [m/s]
    constexpr double kHeaviest = 10e6;  // [Pa], load over cross-section; a laboratory's pin: 0.2 MPa
    constexpr double kEarth = 9.80665;  // [m/s^2]
    if (!places_.good(path)) return;
    if (const double v = norm(p.velocity); v > kFastest)
      ask(path + ".velocity", "'{}' starts at {:.4g} m/s: is its velocity in mm/s?", p.name, v);
    if (!p.shape.empty()) return;
    const double load = norm(p.load), cross_section = std::numbers::pi * p.radius * p.radius;
    if (places_.bare(path + ".load") && load > kHeaviest * cross_section)
      ask(path + ".load",
          "'{}' with a radius of {:.4g} mm is pressed with {:.4g} N, {:.3g} N on each mm^2 of its "
          "cross-section: "
          "is the load in grams? Then write \"{:.4g} N\", or else \"{:.4g} N\"",
          p.name, 1e3 * p.radius, load, 1e-6 * load / cross_section, 1e-3 * kEarth * load, load);
    if (p.guide == Guide::none) check_width(p.name, p.radius, path);
  }

  void check_insertion(const InsertionSetup& i, const std::string& path) {
    constexpr double kFastest = 100.0;  // [m/s]
    if (!places_.good(path)) return;
    if (const double v = norm(i.velocity); v > kFastest)
      ask(path + ".velocity", "particles of '{}' start at {:.4g} m/s: is their velocity in mm/s?", i.name, v);
    if (!i.placed.empty() || gives_places(i.volume.shape)) return;  // sizes and places of a file have units
    const double R = largest_radius(i.size);
    if (!(R > 0.0)) return;
    if (const double v = norm(i.spin) * R; v > kFastest)
      ask(path + ".spin",
          "the surface of particles of '{}' moves at {:.4g} m/s by their spin: is it in deg/s or rpm?",
          i.name, v);
    check_width(i.name, R, path + ".size");
    const auto material = std::ranges::find(setup_.materials, i.material, &MaterialSetup::name);
    if (material != setup_.materials.end()) check_amounts(i, path, R, material->density);
  }

  /// Masses and rates against one of the particles, and against what the volume can take.
  void check_amounts(const InsertionSetup& i, const std::string& path, double R, double density) {
    constexpr double kFilled = 0.3;     // of a volume, at random
    constexpr double kTooFast = 20.0;   // times what falls out of the volume
    constexpr double kEarth = 9.80665;  // [m/s^2]
    constexpr double kSmallest = 1e-9;  // of the volume: a billion spheres would find room in it
    const geometry::BoundingBox box = box_of(i.volume);
    const double volume = volume_of(i.volume), height = norm(box.high - box.low);
    const double one = 4.0 / 3.0 * std::numbers::pi * R * R * R, mass = density * one;
    if (!(volume > 0.0)) return;
    if (one < kSmallest * volume)
      ask(path + ".size",
          "'{}' has particles of at most {:.4g} mm radius in a volume of {:.4g} m^3, room for some {:.1g}: "
          "is one of "
          "them in another unit of length? A bare number is in metres",
          i.name, 1e3 * R, volume, kFilled * volume / one);
    if (i.mass && *i.mass < mass)
      ask(path + ".mass",
          "mass = {:.4g} kg of '{}' is less than one of its largest particles, {:.4g} kg: is it in another "
          "unit, or "
          "are their sizes?",
          *i.mass, i.name, mass);
    else if (i.mass && !i.mass_rate && *i.mass > density * volume)
      ask(path + ".mass",
          "mass = {:.4g} kg of '{}' is {:.3g} times what its volume of {:.4g} m^3 would hold if it were "
          "solid: is it in "
          "grams? Then write \"{:.4g} g\"",
          *i.mass, i.name, *i.mass / (density * volume), volume, *i.mass);
    if (!i.mass_rate) return;
    const double speed = std::max(norm(i.velocity), std::sqrt(2.0 * kEarth * height));
    if (const double most = kFilled * density * volume * speed / height; *i.mass_rate > kTooFast * most)
      ask(path + ".mass_rate",
          "mass_rate = {:.4g} kg/s of '{}' is {:.3g} times what can fall out of its volume, {:.3g} kg/s: is "
          "it in g/s? "
          "Then write \"{:.4g} g/s\"",
          *i.mass_rate, i.name, *i.mass_rate / most, most, *i.mass_rate);
    if (setup_.run.end.in_revolutions) return;
    const double time = setup_.run.end.value - i.start;
    if (time > 0.0 && *i.mass_rate * time < mass)
      ask(path + ".mass_rate",
          "mass_rate = {:.4g} kg/s of '{}' brings in {:.3g} kg until the run ends, less than one of its "
          "largest "
          "particles, {:.3g} kg: is it in another unit?",
          *i.mass_rate, i.name, *i.mass_rate * time, mass);
  }

  /// A free sphere may be small in a large plant, so this is a question only.
  void check_width(const std::string& name, double radius, const std::string& path) {
    for (const WallSetup& wall : setup_.walls) {
      const std::string mesh = path_of("wall", wall.name) + ".mesh";
      if (!places_.good(mesh)) continue;
      const std::string why = implausible_extent(wall, name, radius);
      if (!why.empty()) {
        ask(wall.mesh.shape == MeshShape::file ? path : mesh, "{}", why);
        return;
      }
    }
  }

  const Setup& setup_;
  const Places& places_;
  Problems& problems_;
};

}  // namespace

void check_units(const Setup& setup, const Places& places, Problems& problems) {
  Units(setup, places, problems).check();
}

}  // namespace abradem::io
