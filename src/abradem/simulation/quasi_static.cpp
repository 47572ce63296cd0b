// SPDX-License-Identifier: BSD-3-Clause
// Load control: a guided sphere stands where contact and friction carry its load. docs/theory/quasi-static.md
#include <fmt/format.h>

#include <cmath>

#include "abradem/core/error.h"
#include "abradem/simulation/simulation.h"

namespace abradem::simulation {

/// Newton on the height h along the guide: elastic forces plus sliding friction, along the guide, equal the load.
/// The slope is that of Hertz, S_n (n . guide)^2 summed over the contacts.
void Simulation::find_equilibrium(std::size_t p) {
  constexpr double kTolerance = 1e-10;  // of the load: wear is linear in force, so the ledger's error is smaller
  constexpr int kMostSteps = 400;
  const Vec3 guide = particles_.guide[p];
  const double load = norm(particles_.load[p]) + particles_.mass[p] * dot(setup_.run.gravity, guide);
  const double R = particles_.radius[p];

  for (int iteration = 0; iteration < kMostSteps; ++iteration) {
    double carried = 0.0, slope = 0.0, approach = 0.0;
    for (std::size_t w = 0; w < walls_.size(); ++w) {
      const contact::PairProperties& properties = pair(particles_.material[p], walls_[w].material());
      SphereWall& sw = sphere_walls_[p * walls_.size() + w];
      const geometry::Pose& pose = poses_[w];
      const Vec3 v = pose.turn_back(-pose.velocity_at(particles_.position[p]));
      sw.find(walls_[w], pose.to_body(particles_.position[p]), v, R, properties, load, dt_);
      const Vec3 guide_body = pose.turn_back(guide);
      approach = contact::hertz_overlap(properties, R, load);
      for (SphereWall::Touch& t : sw.touches()) {
        const Vec3 v_t = v - dot(v, t.n) * t.n;
        const double speed = norm(v_t);
        t.force.F_n = t.elastic_force;
        t.force.F_t = speed > 0.0 ? v_t * (-properties.static_friction * t.elastic_force / speed) : Vec3{};
        t.force.v_t = speed;
        carried -= dot(t.elastic_force * t.n + t.force.F_t, guide_body);
        const double n_guide = dot(t.n, guide_body);
        slope += contact::normal_stiffness(properties, t.a) * n_guide * n_guide;
      }
    }
    const double excess = carried - load;
    if (std::abs(excess) <= kTolerance * load) return;
    double move = slope > 0.0 ? -excess / slope : approach;  // along the guide; not in contact yet: come closer
    const double most = 0.5 * approach;
    move = std::clamp(move, -most, most);
    particles_.position[p] += move * guide;
  }
  throw SimulationError(fmt::format(
      "particle '{}', step {}: no height was found at which the walls carry its load of {:.4g} N; does it stand "
      "above a wall, less than {:.3g} mm away?",
      particles_.name[p], steps_, load, 1e3 * 0.1 * R));
}

}  // namespace abradem::simulation
