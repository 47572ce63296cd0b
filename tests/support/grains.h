// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "abradem/simulation/simulation.h"

/// Particles in numbers for the tests.
namespace abradem::test {

using namespace simulation;

/// While it lives, on one thread: small beds wait more for other threads than these can do, above all where
/// tests run side by side.
class OneThread {
 public:
  OneThread() : before_(omp_get_max_threads()) { omp_set_num_threads(1); }
  ~OneThread() { omp_set_num_threads(before_); }
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;

 private:
  int before_;
};

inline WallSetup plane(const std::string& name, const Vec3& point, const Vec3& normal,
                       const std::string& material = "grain") {
  WallSetup wall;
  wall.name = name;
  wall.material = material;
  wall.mesh.shape = MeshShape::plane;
  wall.mesh.position = point;
  wall.mesh.normal = normal;
  return wall;
}

/// A square mesh, its middle at the origin, its normal up. @param size of its triangles [m]
inline WallSetup plate(const std::string& name, const std::string& material, double side, double size) {
  WallSetup wall;
  wall.name = name;
  wall.material = material;
  wall.mesh.shape = MeshShape::plate;
  wall.mesh.length = wall.mesh.width = side;
  wall.mesh.size = size;
  return wall;
}

inline MotionSetup oscillation(const Vec3& amplitude, double frequency) {
  MotionSetup motion;
  motion.kind = MotionKind::oscillation;
  motion.amplitude = amplitude;
  motion.frequency = frequency;
  return motion;
}

/// Grains of one material, in an open box [0, side] x [0, side] where side > 0.
inline simulation::Setup grains(double restitution, double friction, double side) {
  Setup setup;
  setup.materials = {{"grain", 2500.0, 1e7, 0.25, {}}};
  setup.contacts = {{"grain", "grain", restitution, friction, 0.0}};
  if (side > 0.0)
    setup.walls = {plane("left", {0, 0, 0}, {1, 0, 0}), plane("right", {side, 0, 0}, {-1, 0, 0}),
                   plane("front", {0, 0, 0}, {0, 1, 0}), plane("back", {0, side, 0}, {0, -1, 0})};
  setup.insertions.resize(1);
  setup.insertions[0].name = "grains";
  setup.insertions[0].material = "grain";
  setup.output.every = {1.0, false};
  setup.run.end = {1.0, false};
  setup.run.time_step = {0.2, true};
  return setup;
}

/// A jittered lattice, `across` by `across` on the ground, each with a random velocity.
inline std::vector<PlacedSphere> lattice(std::size_t count, std::size_t across, double R, double pitch,
                                         double speed) {
  core::RandomStream random(5);
  std::vector<PlacedSphere> spheres;
  const double play = 0.45 * (pitch - 2.0 * R);
  for (std::size_t i = 0; i < count; ++i) {
    const auto place = [&](std::size_t k) {
      return (static_cast<double>(k) + 0.5) * pitch + random.uniform(-play, play);
    };
    const auto any = [&] { return random.uniform(-speed, speed); };
    const Vec3 p{place(i % across), place(i / across % across), place(i / across / across)};
    spheres.push_back({p, R, {any(), any(), any()}});
  }
  return spheres;
}

/// Sum of mass times velocity of all particles in numbers [kg m/s].
inline Vec3 momentum(const simulation::Simulation& run) {
  Vec3 sum;
  for (const contact::SphereRow& s : run.bulk()->spheres().row) sum += s.velocity() / s.inverse_mass;
  return sum;
}

/// Volume fraction of the spheres within a box, by points on a lattice.
inline double fraction_within(const contact::Spheres& spheres, const Vec3& low, const Vec3& high,
                              double pitch) {
  const auto n = [&](double a, double b) { return static_cast<std::size_t>((b - a) / pitch); };
  const std::size_t nx = n(low.x, high.x), ny = n(low.y, high.y), nz = n(low.z, high.z);
  std::vector<char> filled(nx * ny * nz, 0);
  for (const contact::SphereRow& s : spheres.row) {
    const auto first = [&](double x, double l) {
      return static_cast<std::ptrdiff_t>(std::ceil((x - s.radius - l) / pitch));
    };
    const auto last = [&](double x, double l) {
      return static_cast<std::ptrdiff_t>(std::floor((x + s.radius - l) / pitch));
    };
    for (auto i = std::max<std::ptrdiff_t>(0, first(s.x, low.x));
         i <= std::min<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(nx) - 1, last(s.x, low.x)); ++i)
      for (auto j = std::max<std::ptrdiff_t>(0, first(s.y, low.y));
           j <= std::min<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(ny) - 1, last(s.y, low.y)); ++j)
        for (auto k = std::max<std::ptrdiff_t>(0, first(s.z, low.z));
             k <= std::min<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(nz) - 1, last(s.z, low.z)); ++k) {
          const Vec3 p =
              low + pitch * Vec3{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
          if (norm2(p - s.position()) < s.radius * s.radius)
            filled[(static_cast<std::size_t>(i) * ny + static_cast<std::size_t>(j)) * nz +
                   static_cast<std::size_t>(k)] = 1;
        }
  }
  std::size_t count = 0;
  for (const char f : filled) count += f != 0;
  return static_cast<double>(count) / static_cast<double>(filled.size());
}

/// A layer of 1296 grains on a shaken tray that wears: two blocks of spheres, and enough of them beside a
/// mesh to be shared out among threads.
inline simulation::Setup tray() {
  constexpr double R = 1e-3;
  constexpr std::size_t kAcross = 36;
  simulation::Setup setup = grains(0.5, 0.4, 0.0);
  setup.insertions[0].placed = lattice(kAcross * kAcross, kAcross, R, 2.1 * R, 0.2);
  setup.wear = {{.abrader = "grain", .worn = "grain", .wear_coefficient = 1e-10}};
  WallSetup tray = plate("tray", "grain", 90e-3, 6e-3);
  tray.mesh.position = {38e-3, 38e-3, 0.0};
  tray.motion = oscillation({0.5e-3, 0.0, 0.2e-3}, 100.0);
  tray.contact = ContactRule::resolved;
  setup.walls = {tray, plane("end", {0, 0, 0}, {1, 0, 0})};
  setup.run.gravity = {0.0, 0.0, -9.81};
  setup.run.end = setup.output.every = {2e-3, false};
  return setup;
}

constexpr double kStreamRadius = 4e-3;

/// A stream that falls on a tilted plate, slides off it, wears it and is taken out.
/// @param settle until nothing wears   @param wearing how long the test goes on then [s]
inline simulation::Setup stream_on_plate(double settle, double wearing) {
  simulation::Setup setup;
  setup.materials = {{"ore", 2700.0, 1e7, 0.25, {}}, {"steel", 7850.0, 78e9, 0.3, {}}};
  setup.contacts = {{"ore", "ore", 0.4, 0.5, 0.05}, {"ore", "steel", 0.4, 0.4, 0.05}};
  setup.wear = {{.abrader = "ore", .worn = "steel", .wear_coefficient = 2e-7}};
  WallSetup slope = plate("plate", "steel", 60e-3, 4e-3);
  slope.mesh.rotation = {0.0, 0.7, 0.0};
  slope.contact = ContactRule::automatic;
  slope.deformation = DeformationRule::conserving;
  slope.deform_every = 20;
  setup.walls = {slope};
  InsertionSetup feed;
  feed.name = "feed";
  feed.material = "ore";
  feed.size.radius = kStreamRadius;
  feed.volume.low = {-20e-3, -12e-3, 35e-3};
  feed.volume.high = {0.0, 12e-3, 55e-3};
  feed.velocity = {0.0, 0.0, -1.0};
  feed.mass = 1000.0;
  feed.mass_rate = 0.5;
  setup.insertions = {feed};
  setup.domain = DomainSetup{.low = {-60e-3, -60e-3, -60e-3}, .high = {60e-3, 60e-3, 60e-3}};
  setup.run.gravity = {0.0, 0.0, -9.81};
  setup.run.settle = {settle, false};
  setup.run.end = {settle + wearing, false};
  setup.run.seed = 3;
  return setup;
}

constexpr double kBedRadius = 3e-3, kBedSide = 16 * 2.06 * kBedRadius;

/// A box with 4096 grains of kBedRadius on a lattice, `stretch` times as high, about to fall on its floor.
inline simulation::Setup bed(double friction, double stretch) {
  simulation::Setup setup = grains(0.3, friction, kBedSide);
  setup.walls.push_back(plane("floor", {0, 0, 0}, {0, 0, 1}));
  setup.run.gravity = {0, 0, -9.81};
  setup.insertions[0].placed = lattice(4096, 16, kBedRadius, 2.06 * kBedRadius, 0.3);
  for (simulation::PlacedSphere& s : setup.insertions[0].placed) s.position.z *= stretch;
  return setup;
}

/// Volume fraction inside the bed. Walls put their neighbours into layers: within seven radii of them the
/// fraction goes up and down.
inline double fraction_of_bed(const simulation::Simulation& run) {
  constexpr double R = kBedRadius, wall = 7.0 * R;
  return fraction_within(run.bulk()->spheres(), {wall, wall, wall},
                         {kBedSide - wall, kBedSide - wall, 18 * R}, 0.1 * R);
}

}  // namespace abradem::test
