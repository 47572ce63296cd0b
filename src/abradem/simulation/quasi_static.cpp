// SPDX-License-Identifier: BSD-3-Clause
// Load control: a guided sphere stands where contact and friction carry its load. docs/theory/quasi-static.md
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "abradem/core/error.h"
#include "abradem/simulation/simulation.h"

namespace abradem::simulation {

/// Finds the height h along the guide at which elastic forces plus sliding friction carry the load. Secant
/// steps inside a bracket; the first step takes Hertz's stiffness times the ratio found at the last increment
/// (a conforming groove is stiffer than the flat it began as). Where the force jumps over the load (a contact
/// begins) the bracket closes around the jump. The forces found are scaled to carry the load exactly, which
/// is what one more step would do to them.
void Simulation::find_equilibrium(std::size_t p) {
  constexpr double kTolerance = 1e-4;      // of the load, at the height found, before the forces are scaled
  constexpr double kStiffnessError = 0.2;  // of a stiffness once measured, at most: what a move leaves over
  constexpr int kMostSteps = 400;
  const Vec3 guide = particles_.guide[p];
  const double load = norm(particles_.load[p]) + particles_.mass[p] * dot(setup_.run.gravity, guide);
  const double R = particles_.radius[p];
  double h = 0.0;                                                      // of this search [m], along the guide
  double low = -std::numeric_limits<double>::infinity(), high = -low;  // too light at low, too heavy at high
  double last_h = 0.0, last_excess = 0.0, last_width = high;
  bool has_last = false, was_jump = false;

  for (int iteration = 0; iteration < kMostSteps; ++iteration) {
    double carried = 0.0, slope = 0.0, approach = 0.0;
    for (std::size_t w = 0; w < walls_.size(); ++w) {
      const contact::PairProperties& properties = pair(particles_.material[p], walls_[w].material());
      SphereWall& sw = sphere_walls_[p * walls_.size() + w];
      const geometry::Pose& pose = poses_[w];
      const Vec3 v = pose.turn_back(-pose.velocity_at(particles_.position[p]));
      const Vec3 c = pose.to_body(particles_.position[p]);
      sw.prepare(walls_[w], c, v, R, properties, load, dt_);
      sw.find(walls_[w], c, R, properties);
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
        slope += t.weight * contact::normal_stiffness(properties, t.a) * n_guide * n_guide;
      }
    }
    const double excess = carried - load;
    (excess < 0.0 ? low : high) = h;
    constexpr double kNarrow = 1e-9;  // of the Hertz approach
    const bool jump = high - low <= kNarrow * approach;
    double move = approach;  // not in contact yet: come closer
    if (slope > 0.0) {
      if (has_last && last_excess != excess) {
        const double secant = (excess - last_excess) / (h - last_h);
        if (secant > 0.0) stiffness_ratio_[p] = std::clamp(secant / slope, 0.1, 10.0);
      }
      const bool measured = stiffness_ratio_[p] > 0.0;
      move = -excess / (slope * (measured ? stiffness_ratio_[p] : 1.0));
      last_h = h, last_excess = excess, has_last = true;
      const double left = (measured ? kStiffnessError : 1.0) * std::abs(excess);
      // What decides a jump (which of two equal places is the deepest) may go by round-off of the height.
      if (left <= kTolerance * load || (jump && (excess > 0.0 || was_jump))) {
        particles_.position[p] += (jump ? 0.0 : move) * guide;
        for (std::size_t w = 0; w < walls_.size(); ++w)
          for (SphereWall::Touch& t : sphere_walls_[p * walls_.size() + w].touches()) {
            t.force.F_n *= load / carried;
            t.force.F_t = t.force.F_t * (load / carried);
          }
        return;
      }
    }
    move = std::clamp(move, -0.5 * approach, 0.5 * approach);
    double next = h + move;
    // Beside a jump secant steps creep along one side; halving gets across.
    const bool creeping = iteration % 4 == 3 && high - low > 0.5 * last_width;
    if (iteration % 4 == 3) last_width = high - low;
    if (next <= low || next >= high || creeping) next = 0.5 * (low + high);
    if (jump) next = high;
    was_jump = jump;
    particles_.position[p] += (next - h) * guide;
    h = next;
  }
  throw SimulationError(fmt::format(
      "particle '{}', step {}, {:.6g} s: no height was found at which the walls carry its load of "
      "{:.4g} N. Has it slid off the wall? It must stand over a wall during the whole run, and "
      "start on it or less than {:.3g} mm above",
      particles_.name[p], steps_, time(), load, 1e3 * 0.1 * R));
}

}  // namespace abradem::simulation
