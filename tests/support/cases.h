// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <numbers>
#include <string>
#include <utility>

#include "abradem/geometry/triangle_mesh.h"
#include "abradem/simulation/simulation.h"

/// Setups of the tests, as a C++ program would write them.
namespace abradem::test {

/// The pin-on-disc test of [yan2022], Tables 1-2: ball R = 3 mm pressed with 5 N on a track of 22 mm.
struct PinOnDisc {
  double shear_modulus = 0.1e9;        ///< of the pin [Pa]
  double wear_coefficient = 6.81e-11;  ///< [1/Pa]
  double friction = 1.0;
  double track = 22e-3, half_band = 0.8e-3, size = 0.1e-3;  ///< annulus around the track [m]
  double revolutions = 1.0;
  std::uint64_t seed = 1;
  simulation::Method method = simulation::Method::quasi_static;
  simulation::DeformationRule deformation = simulation::DeformationRule::conserving;
  simulation::ContactRule contact = simulation::ContactRule::patch;
  simulation::Footprint footprint = simulation::Footprint::hertz;

  static constexpr double kRadius = 3e-3;  ///< [m]
  static constexpr double kLoad = 5.0;     ///< [N]

  [[nodiscard]] simulation::Setup setup() const {
    simulation::Setup s;
    s.title = "pin on disc";
    s.materials = {{"iron_ore", 4850.0, shear_modulus, 0.24, {}}, {"mild_steel", 7932.0, 78e9, 0.30, {}}};
    s.contacts = {{"iron_ore", "mild_steel", 0.4, friction, 0.0}};
    s.wear = {{"iron_ore", "mild_steel", wear_coefficient}};
    simulation::WallSetup wall;
    wall.name = "disc";
    wall.material = "mild_steel";
    wall.mesh.shape = simulation::MeshShape::annulus;
    wall.mesh.inner = track - half_band;
    wall.mesh.outer = track + half_band;
    wall.mesh.size = size;
    wall.motion.kind = simulation::MotionKind::rotation;
    wall.motion.rate = std::numbers::pi;
    wall.deformation = deformation;
    wall.contact = contact;
    wall.footprint = footprint;
    s.walls = {wall};
    simulation::ParticleSetup pin;
    pin.name = "pin";
    pin.material = "iron_ore";
    pin.radius = kRadius;
    pin.position = {track, 0.0, kRadius};
    pin.guide = simulation::Guide::vertical;
    pin.load = {0.0, 0.0, -kLoad};
    s.particles = {pin};
    s.run.end = {revolutions, true};
    s.output.every = {revolutions < 1.0 ? revolutions : 1.0, true};
    s.run.method = method;
    s.run.seed = seed;
    return s;
  }
  /// alpha F L of the whole run [m^3].
  [[nodiscard]] double archard_volume() const {
    return wear_coefficient * kLoad * 2.0 * std::numbers::pi * track * revolutions;
  }
};

/// The same pin rubbing to and fro on a plate: a straight groove without ends or curvature in its middle, at
/// a fraction of the ring's cost. One cycle is two passes.
struct PinOnPlate {
  double shear_modulus = 0.1e9;
  double wear_per_pass = 6.81e-11;  ///< wear coefficient [1/Pa]
  int passes = 2;                   ///< even
  double amplitude = 1.2e-3, half_width = 0.6e-3, size = 0.05e-3, margin = 0.6e-3;  ///< [m]
  double increment = 0.0;  ///< [m], 0: the program's choice
  double friction = 0.0;   ///< the references know none
  std::uint64_t seed = 1;
  simulation::Method method = simulation::Method::quasi_static;
  simulation::Footprint footprint = simulation::Footprint::hertz;

  [[nodiscard]] simulation::Setup setup() const {
    PinOnDisc pin;
    pin.shear_modulus = shear_modulus;
    pin.wear_coefficient = wear_per_pass;
    pin.friction = friction;
    pin.seed = seed;
    pin.method = method;
    pin.footprint = footprint;
    simulation::Setup s = pin.setup();
    simulation::WallSetup& wall = s.walls[0];
    wall.name = "plate";
    wall.mesh.shape = simulation::MeshShape::plate;
    wall.mesh.length = 2.0 * (amplitude + margin);
    wall.mesh.width = 2.0 * half_width;
    wall.mesh.size = size;
    wall.motion = {};
    wall.motion.kind = simulation::MotionKind::oscillation;
    wall.motion.amplitude = {amplitude, 0.0, 0.0};
    wall.motion.frequency = 1.0;
    s.particles[0].position = {0.0, 0.0, PinOnDisc::kRadius};
    s.run.end = {0.5 * passes, true};
    s.output.every = s.run.end;
    if (increment > 0.0) s.run.increment = increment;
    return s;
  }
};

/// One sphere on one wall made of a given mesh; rigid-body data in SI.
struct SphereOnMesh {
  geometry::TriangleMesh mesh;
  double radius = 3e-3, density = 4850.0, shear_modulus = 0.1e9;
  double restitution = 0.4, friction = 0.0;
  Vec3 position, velocity, spin, load, gravity;
  double time_step = 1e-5, end = 1e-3;
  bool guided = false;
  simulation::ContactRule contact = simulation::ContactRule::patch;
  simulation::DeformationRule deformation = simulation::DeformationRule::none;
  double wear_coefficient = 0.0;
  simulation::MotionSetup motion;

  [[nodiscard]] simulation::Setup setup() const {
    simulation::Setup s;
    // The wall is a thousand times stiffer than any sphere here: rigid.
    s.materials = {{"ball", density, shear_modulus, 0.24, {}},
                   {"wall", 7932.0, 1e3 * shear_modulus, 0.30, {}}};
    s.contacts = {{"ball", "wall", restitution, friction, 0.0}};
    if (wear_coefficient > 0.0) s.wear = {{"ball", "wall", wear_coefficient}};
    simulation::WallSetup wall;
    wall.name = "wall";
    wall.material = "wall";
    wall.mesh.shape = simulation::MeshShape::file;
    wall.contact = contact;
    wall.deformation = deformation;
    wall.motion = motion;
    s.walls = {wall};
    simulation::ParticleSetup ball;
    ball.name = "ball";
    ball.material = "ball";
    ball.radius = radius;
    ball.position = position;
    ball.velocity = velocity;
    ball.spin = spin;
    ball.load = load;
    ball.guide = guided ? simulation::Guide::vertical : simulation::Guide::none;
    s.particles = {ball};
    s.run.end = {end, false};
    s.run.time_step = {time_step, false};
    s.run.gravity = gravity;
    s.output.every = {end, false};
    return s;
  }
  [[nodiscard]] simulation::Simulation run() const {
    return simulation::Simulation(setup(),
                                  [this](const simulation::MeshSetup&, std::uint64_t) { return mesh; });
  }
  [[nodiscard]] double mass() const {
    return density * 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
  }
  [[nodiscard]] contact::PairProperties pair() const {
    return material::effective_moduli({density, shear_modulus, 0.24}, {7932.0, 1e3 * shear_modulus, 0.30});
  }
};

/// Prints a measured number beside its bound, so that the tables of docs/verification can be renewed.
inline void measured(const std::string& what, double value, double bound) {
  std::printf("[ measured ] %-66s %12.4g  (bound %.3g)\n", what.c_str(), value, bound);
}

}  // namespace abradem::test
