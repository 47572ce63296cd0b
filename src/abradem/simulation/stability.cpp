// SPDX-License-Identifier: BSD-3-Clause
// How far the time step is from the limits of the explicit scheme. docs/theory/time-step.md
#include <algorithm>
#include <cmath>

#include "abradem/simulation/simulation.h"

namespace abradem::simulation {

namespace {

/// Symplectic Euler of a mass M on parallel contacts of stiffness S and damping c each is stable while
/// 2 g + W < 4, with g = (sum of c) dt / M and W = (sum of S) dt^2 / M.
double damped_number(double stiffness, double damping, double mass, double dt) noexcept {
  return 2.0 * damping * dt / mass + stiffness * dt * dt / mass;
}

}  // namespace

void Simulation::watch_stability() {
  if (bulk_) worst_damping_ = std::max(worst_damping_, bulk_->worst_stability());
  for (std::size_t p = 0; p < particles_.size(); ++p) {
    double stiffness = 0.0, damping = 0.0;
    for (std::size_t w = 0; w < walls_.size(); ++w) {
      const auto& properties = pair(particles_.material[p], walls_[w].material());
      for (const SphereWall::Touch& t : sphere_walls_[p * walls_.size() + w].touches()) {
        const double S = contact::normal_stiffness(properties, t.a);
        stiffness += S;
        damping += contact::damping_coefficient(properties, S, particles_.mass[p]);
      }
    }
    worst_damping_ = std::max(worst_damping_, damped_number(stiffness, damping, particles_.mass[p], dt_));
  }
}

std::vector<StabilityLimit> Simulation::limits() const {
  if (setup_.run.method == Method::quasi_static) return {};
  double rayleigh = 0.0, hertz = 0.0, number = worst_damping_;
  for (std::size_t p = 0; p < particles_.size(); ++p) {
    const auto& m = materials_[static_cast<std::size_t>(particles_.material[p])];
    const double R = particles_.radius[p], mass = particles_.mass[p];
    rayleigh = std::max(rayleigh, dt_ / material::rayleigh_time(m, R));
    for (const Wall& wall : walls_) {
      const auto& properties = pair(particles_.material[p], wall.material());
      const double load = norm(particles_.load[p]) + mass * norm(setup_.run.gravity);
      const double overlap = contact::hertz_overlap(properties, R, load);
      // Speed towards the wall at the start, or what the load gives over its own Hertz overlap.
      const double given = norm(setup_.particles[p].velocity);
      const double speed = given > 0.0 ? given : std::sqrt(2.0 * load * overlap / mass);
      if (speed > 0.0) hertz = std::max(hertz, dt_ / material::hertz_time(properties.E_eff, R, mass, speed));
      const double S = contact::normal_stiffness(properties, contact::contact_radius(R, overlap));
      if (steps_ == 0)
        number =
            std::max(number, damped_number(S, contact::damping_coefficient(properties, S, mass), mass, dt_));
    }
  }
  for (const InsertionSetup& i : setup_.insertions) {
    const auto m =
        std::ranges::find(setup_.materials, i.material, &MaterialSetup::name) - setup_.materials.begin();
    rayleigh = std::max(
        rayleigh, dt_ / material::rayleigh_time(materials_[static_cast<std::size_t>(m)], smallest_radius(i)));
  }
  return {{"time step / Rayleigh time", rayleigh, 0.4, "-"},
          {"time step / Hertz impact time", hertz, 0.1, "-"},
          {steps_ == 0 ? "contact damping and stiffness, one contact at the load (2g + W)"
                       : "contact damping and stiffness, worst step (2g + W)",
           number, 4.0, "-"}};
}

}  // namespace abradem::simulation
