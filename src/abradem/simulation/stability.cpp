// SPDX-License-Identifier: BSD-3-Clause
// How far the time step is from the limits of the explicit scheme. docs/theory/time-step.md
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "abradem/core/error.h"
#include "abradem/simulation/simulation.h"
#include "abradem/simulation/stability.h"

namespace abradem::simulation {

namespace {

Scheme scheme_of(double stiffness, double damping, double mass, double dt) noexcept {
  return {damping * dt / mass, stiffness * dt * dt / mass};
}

}  // namespace

/// Above the limit a disturbance grows from step to step, until the contact opens: the forces are then those
/// of the scheme and not of the contact. A peak of few steps is none; what grows a thousandfold is.
void Simulation::watch_stability() {
  if (setup_.run.method == Method::quasi_static) return;
  if (bulk_) {
    bulk_->watch_stability(surroundings(), steps_, setup_.run.stability);
    worst_damping_ = std::max(worst_damping_, bulk_->worst_stability());
  }
  for (std::size_t p = 0; p < particles_.size(); ++p) {
    double stiffness = 0.0, damping = 0.0;
    std::size_t contacts = 0;
    for (std::size_t w = 0; w < walls_.size(); ++w) {
      const auto& properties = pair(particles_.material[p], walls_[w].material());
      for (const SphereWall::Touch& t : sphere_walls_[p * walls_.size() + w].touches()) {
        const double S = contact::step_stiffness(properties, t.a);
        stiffness += t.weight * S;
        damping += t.weight * contact::step_damping(properties, S, particles_.mass[p]);
        ++contacts;
      }
    }
    if (contacts == 0) continue;
    const Scheme scheme = scheme_of(stiffness, damping, particles_.mass[p], dt_);
    worst_damping_ = std::max(worst_damping_, scheme.number());
    // Stable steps let it decay again; never below what it began with.
    if (scheme.number() > Scheme::kLimit || growth_[p] > 0.0)
      growth_[p] = std::max(0.0, growth_[p] + std::log(scheme.growth()));
    if (growth_[p] < kLargestGrowth || setup_.run.stability == Stability::warn) continue;
    throw SimulationError(fmt::format(
        "particle '{}', step {}, {:.6g} s: the time step is too long: 2g + W = {:.4g} with {} contacts of "
        "together {:.4g} N/m and {:.4g} N s/m, stable below 4; a disturbance has grown a thousandfold. Take "
        "run.time_step below {:.3g} s{}; run.stability = \"warn\" goes on nevertheless",
        particles_.name[p], steps_, time(), scheme.number(), contacts, stiffness, damping,
        scheme.stable_step(dt_),
        contacts > 1 ? ", or contact = \"patch\", where the triangles share one damper" : ""));
  }
}

/// Of the smallest spheres of an insertion, that meet each other and the walls with the largest speed met,
/// before the run that which they are given.
Simulation::InsertionLimits Simulation::limits_of(const Inserter& inserter) const {
  const InsertionSetup& i = inserter.setup();
  InsertionLimits limits;
  const auto index_of = [this](const std::string& name) {
    return static_cast<int>(std::ranges::find(setup_.materials, name, &MaterialSetup::name) -
                            setup_.materials.begin());
  };
  const int m = index_of(i.material);
  const material::Material& material = materials_[static_cast<std::size_t>(m)];
  const double R = smallest_radius(i);
  const double mass = material.density * 4.0 / 3.0 * std::numbers::pi * R * R * R;
  limits.rayleigh = dt_ / material::rayleigh_time(material, inserter.smallest_sphere());
  double speed = std::max(norm(i.velocity), bulk_->fastest());
  for (const PlacedSphere& s : i.placed) speed = std::max(speed, norm(s.velocity));
  if (speed == 0.0) return limits;
  const auto meet = [&](const contact::PairProperties& properties, double R_eff, double m_eff) {
    if (!(properties.E_eff > 0.0)) return;  // they cannot meet
    limits.hertz = std::max(limits.hertz, dt_ / material::hertz_time(properties.E_eff, R_eff, m_eff, speed));
    // Where all of m v^2 / 2 is in the contact: (8/15) E sqrt(R) overlap^(5/2).
    const double overlap =
        std::pow(15.0 * m_eff * speed * speed / (16.0 * properties.E_eff * std::sqrt(R_eff)), 0.4);
    const double S = contact::step_stiffness(properties, contact::contact_radius(R_eff, overlap));
    const double c = contact::step_damping(properties, S, m_eff);
    limits.number = std::max(limits.number, scheme_of(S, c, m_eff, dt_).number());
  };
  for (const InsertionSetup& other : setup_.insertions)
    meet(pair(m, index_of(other.material)), 0.5 * R, 0.5 * mass);
  for (const Wall& wall : walls_) meet(pair(m, wall.material()), R, mass);
  return limits;
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
  for (std::size_t k = 0; k < setup_.insertions.size(); ++k) {
    const InsertionLimits met = limits_of(bulk_->inserters()[k]);
    rayleigh = std::max(rayleigh, met.rayleigh);
    hertz = std::max(hertz, met.hertz);
    if (steps_ == 0) number = std::max(number, met.number);
  }
  return {{"time step / Rayleigh time", rayleigh, 0.4, "-"},
          {"time step / Hertz impact time", hertz, 0.1, "-"},
          {steps_ == 0 ? "contact damping and stiffness, one contact at the load or in an impact (2g + W)"
                       : "contact damping and stiffness, worst step (2g + W)",
           number, Scheme::kLimit, "-"}};
}

}  // namespace abradem::simulation
