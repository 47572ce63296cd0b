// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "abradem/simulation/simulation.h"

/// Small scenes for the tests: a few lines from materials and spheres to a Simulation. SI.
namespace abradem::test {

/// An elastic material by Young's modulus, as the literature gives it.
struct Elastic {
  double E = 0.0;        ///< [Pa]
  double nu = 0.0;       ///< [-]
  double density = 0.0;  ///< [kg/m^3]
};

/// How two materials meet.
struct Meeting {
  double restitution = 1.0, static_friction = 0.0, rolling_friction = 0.0;
};

/// One way to make the flat floor z = 0: analytic, or triangles of a size given in contact radii.
struct Floor {
  const char* name;
  bool analytic = true;
  simulation::ContactRule rule = simulation::ContactRule::patch;
  double triangle = 0.0;  ///< edge length / contact radius
};

inline constexpr double kOneTriangle = 0.0;

/// Every floor that a plane case is run on: triangles larger and smaller than the contact, each contact rule.
/// `per_triangle` is one contact only well inside one triangle, so its floor is one triangle.
inline const std::vector<Floor>& floors() {
  using simulation::ContactRule;
  static const std::vector<Floor> all{
      {"analytic plane", true, ContactRule::patch, 0.0},
      {"patch, triangles 12 a", false, ContactRule::patch, 12.0},
      {"patch, triangles a/3", false, ContactRule::patch, 1.0 / 3.0},
      {"resolved, triangles 12 a", false, ContactRule::resolved, 12.0},
      {"resolved, triangles a/3", false, ContactRule::resolved, 1.0 / 3.0},
      {"per_triangle, one triangle", false, ContactRule::per_triangle, kOneTriangle}};
  return all;
}

class SceneBuilder {
 public:
  SceneBuilder& material(const std::string& name, const Elastic& m) {
    setup_.materials.push_back({name, m.density, m.E / (2.0 * (1.0 + m.nu)), m.nu, {}});
    return *this;
  }
  /// A wall material that is practically rigid beside m: a million times stiffer.
  SceneBuilder& rigid(const std::string& name, const Elastic& m) {
    return material(name, {1e6 * m.E, m.nu, m.density});
  }
  SceneBuilder& meeting(const std::string& a, const std::string& b, const Meeting& m) {
    setup_.contacts.push_back({a, b, m.restitution, m.static_friction, m.rolling_friction});
    return *this;
  }
  SceneBuilder& sphere(const std::string& material_name, double R, const Vec3& position,
                       const Vec3& velocity = {}, const Vec3& spin = {}) {
    simulation::ParticleSetup p;
    p.name = "sphere " + std::to_string(setup_.particles.size() + 1);
    p.material = material_name;
    p.radius = R;
    p.position = position;
    p.velocity = velocity;
    p.spin = spin;
    setup_.particles.push_back(p);
    return *this;
  }
  /// The floor z = 0, normal +z. @param a contact radius to be expected [m]
  /// @param travel how far the sphere goes along +x from the origin [m]
  SceneBuilder& floor(const Floor& f, const std::string& material_name, double a, double travel = 0.0) {
    simulation::WallSetup wall;
    wall.name = "floor";
    wall.material = material_name;
    wall.contact = f.rule;
    if (f.analytic) {
      wall.mesh.shape = simulation::MeshShape::plane;
    } else if (f.triangle == kOneTriangle) {
      wall.mesh.shape = simulation::MeshShape::file;  // made by one_triangle below
      wall.mesh.size = travel + 6.0 * a;
    } else {
      wall.mesh.shape = simulation::MeshShape::plate;
      wall.mesh.size = f.triangle * a;
      const double margin = f.triangle > 1.0 ? 3.0 * wall.mesh.size : 3.0 * a;
      wall.mesh.length = travel + 2.0 * margin;
      wall.mesh.width = 2.0 * margin;
      wall.mesh.position = {0.5 * travel, 0.0, 0.0};
    }
    setup_.walls.push_back(wall);
    return *this;
  }
  SceneBuilder& gravity(const Vec3& g) {
    setup_.run.gravity = g;
    return *this;
  }
  SceneBuilder& time(double dt, double end) {
    setup_.run.time_step = {dt, false};
    setup_.run.end = {end, false};
    setup_.output.every = {end, false};
    return *this;
  }
  [[nodiscard]] simulation::Simulation build() const { return simulation::Simulation(setup_, make_floor); }

 private:
  /// One equilateral triangle whose inscribed circle, about the origin, has the mesh's size as its radius.
  static geometry::TriangleMesh make_floor(const simulation::MeshSetup& mesh, std::uint64_t seed) {
    if (mesh.shape != simulation::MeshShape::file) return simulation::generate_mesh(mesh, seed);
    const double r = mesh.size, half = std::sqrt(3.0) * r;
    return {{{-half, -r, 0.0}, {half, -r, 0.0}, {0.0, 2.0 * r, 0.0}}, {{0, 1, 2}}};
  }

  simulation::Setup setup_;
};

/// What an impact leaves behind.
struct Impact {
  double overlap = 0.0;   ///< largest [m]
  double force = 0.0;     ///< largest component along z on the first sphere [N]
  double duration = 0.0;  ///< of the contact, end interpolated between steps [s]
  bool ended = false;
};

/// Steps until the gap, which starts at 0 and closes, opens again. @param gap (Simulation) -> distance [m]
template <typename Gap>
Impact run_impact(simulation::Simulation& run, Gap&& gap) {
  Impact result;
  double before = gap(run);
  while (!run.finished()) {
    run.step();
    const double after = gap(run);
    result.overlap = std::max(result.overlap, -after);
    result.force = std::max(result.force, std::abs(run.particles().force[0].z));
    if (before < 0.0 && after >= 0.0) {
      result.duration = run.time() - run.time_step() * after / (after - before);
      result.ended = true;
      return result;
    }
    before = after;
  }
  return result;
}

/// Hertz impact of a mass m_eff at speed v [Chung & Ooi 2011]: largest overlap, largest force, duration.
struct HertzImpact {
  double overlap, force, duration;
  HertzImpact(double E_eff, double R_eff, double m_eff, double v) {
    const double k = 4.0 / 3.0 * E_eff * std::sqrt(R_eff);
    overlap = std::pow(5.0 * m_eff * v * v / (4.0 * k), 0.4);
    force = k * overlap * std::sqrt(overlap);
    duration = 2.943275184324706 * overlap / v;
  }
};

}  // namespace abradem::test
