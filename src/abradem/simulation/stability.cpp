// SPDX-License-Identifier: BSD-3-Clause
// How far the time step is from the limits of the explicit scheme. docs/theory/time-step.md
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "abradem/core/error.h"
#include "abradem/simulation/simulation.h"

namespace abradem::simulation {

namespace {

/// Of a mass M on parallel contacts: their stiffnesses and damping coefficients as the scheme sees them.
struct Scheme {
  double g = 0.0;  ///< (sum of c) dt / M
  double W = 0.0;  ///< (sum of S) dt^2 / M

  /// Symplectic Euler is stable while this is below 4.
  [[nodiscard]] double number() const noexcept { return 2.0 * g + W; }
  /// What a small disturbance is multiplied by in one step, at most: the larger root of
  /// lambda^2 - (2 - g - W) lambda + (1 - g).
  [[nodiscard]] double growth() const noexcept {
    const double t = 2.0 - g - W, d = 1.0 - g, inside = 0.25 * t * t - d;
    return inside > 0.0 ? 0.5 * std::abs(t) + std::sqrt(inside) : std::sqrt(d);
  }
};

Scheme scheme_of(double stiffness, double damping, double mass, double dt) noexcept {
  return {damping * dt / mass, stiffness * dt * dt / mass};
}

/// The longest step that is stable: 2 c dt + S dt^2 = 4 M.
double stable_step(double stiffness, double damping, double mass) noexcept {
  return 4.0 * mass / (damping + std::sqrt(damping * damping + 4.0 * stiffness * mass));
}

}  // namespace

/// Above the limit a disturbance grows from step to step, until the contact opens: the forces are then those
/// of the scheme and not of the contact. A peak of few steps is none; what grows a thousandfold is.
void Simulation::watch_stability() {
  if (setup_.run.method == Method::quasi_static) return;
  if (bulk_) worst_damping_ = std::max(worst_damping_, bulk_->worst_stability());
  const double kLargestGrowth = std::log(1e3);
  for (std::size_t p = 0; p < particles_.size(); ++p) {
    double stiffness = 0.0, damping = 0.0;
    std::size_t contacts = 0;
    for (std::size_t w = 0; w < walls_.size(); ++w) {
      const auto& properties = pair(particles_.material[p], walls_[w].material());
      for (const SphereWall::Touch& t : sphere_walls_[p * walls_.size() + w].touches()) {
        const double S = contact::step_stiffness(properties, t.a);
        stiffness += S;
        damping += contact::step_damping(properties, S, particles_.mass[p]);
        ++contacts;
      }
    }
    if (contacts == 0) continue;
    const Scheme scheme = scheme_of(stiffness, damping, particles_.mass[p], dt_);
    worst_damping_ = std::max(worst_damping_, scheme.number());
    // Stable steps let it decay again; never below what it began with.
    if (scheme.number() > 4.0 || growth_[p] > 0.0)
      growth_[p] = std::max(0.0, growth_[p] + std::log(scheme.growth()));
    if (growth_[p] < kLargestGrowth || setup_.run.stability == Stability::warn) continue;
    throw SimulationError(fmt::format(
        "particle '{}', step {}, {:.6g} s: the time step is too long: 2g + W = {:.4g} with {} contacts of "
        "together {:.4g} N/m and {:.4g} N s/m, stable below 4; a disturbance has grown a thousandfold. Take "
        "run.time_step below {:.3g} s{}; run.stability = \"warn\" goes on nevertheless",
        particles_.name[p], steps_, time(), scheme.number(), contacts, stiffness, damping,
        stable_step(stiffness, damping, particles_.mass[p]),
        contacts > 1 ? ", or contact = \"patch\", where the triangles share one damper" : ""));
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
      const double S = contact::step_stiffness(properties, contact::contact_radius(R, overlap));
      if (steps_ == 0)
        number =
            std::max(number, scheme_of(S, contact::step_damping(properties, S, mass), mass, dt_).number());
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
