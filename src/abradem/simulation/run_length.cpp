// SPDX-License-Identifier: BSD-3-Clause
// How long a run is, in which steps it is made, and what it counts.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "abradem/core/error.h"
#include "abradem/simulation/simulation.h"

namespace abradem::simulation {

namespace {

/// How fast a wall slides under a point, for the choice of a sliding increment [m/s]: at the start, or, of
/// motions whose speeds change, the sum of the largest.
double fastest_at(const Wall& wall, const Vec3& point) {
  const WallSetup& setup = wall.setup();
  if (setup.motions() == 1 && setup.motion.kind != MotionKind::table)
    return norm(wall.pose_at(0.0).velocity_at(point));
  double sum = 0.0;
  for (std::size_t k = 0; k < setup.motions(); ++k) {
    const MotionSetup& m = setup.motion_at(k);
    const MotionLimits most = limits_of(m);
    sum += most.speed + most.rate * norm(cross(m.axis, point - m.center));
  }
  return sum;
}

}  // namespace

double seconds_of(const Duration& duration, double period) {
  if (!duration.in_revolutions) return duration.value;
  if (!(period > 0.0))
    throw InputError(
        "a duration is given in revolutions, but no wall turns or oscillates; give it in seconds");
  return duration.value * period;
}

/// Sliding distance per step of `quasi_static`, as shares f of the contact's half-width a [m].
/// docs/theory/quasi-static.md#increment
double Simulation::choose_increment() const {
  constexpr double kShare = 0.2, kOfRoot = 0.1;  // the first resolves the contact in every single pass
  constexpr double kPatch = 2.0;                 // the contact's length: no spot is left out
  constexpr double kSteepest = 2.5;              // of alpha E* f; unstable above 5
  constexpr double kSteepestRidges = 0.75;       // ridges are met by single increments
  const double n = wearing_revolutions();
  double increment = std::numeric_limits<double>::infinity();
  for (std::size_t p = 0; p < particles_.size(); ++p)
    for (const Wall& wall : walls_) {
      const double R = particles_.radius[p];
      const contact::PairProperties& properties = pair(particles_.material[p], wall.material());
      const double a =
          contact::contact_radius(R, contact::hertz_overlap(properties, R, norm(particles_.load[p])));
      // A pass leaves a ripple of ~ f^(3/2) of its own wear, that is f^(3/2) / n of the groove.
      double f = kShare;
      if (wall.setup().contact == ContactRule::patch && wall.setup().deformation != DeformationRule::paper)
        f = std::clamp(kOfRoot * std::sqrt(n), kShare, kPatch);
      const double alpha_E = groove_coefficient(particles_.material[p], wall.material()) * properties.E_eff;
      if (alpha_E > 0.0) f = std::min(f, (ploughs() ? kSteepestRidges : kSteepest) / alpha_E);
      increment = std::min(increment, f * a);
    }
  return increment;
}

void Simulation::choose_time_step() {
  // The case counts revolutions and seconds of the test; once the flow has settled, the model makes fewer.
  const double test_end = seconds_of(setup_.run.end, period_);
  settle_ = seconds_of(setup_.run.settle, period_);
  settling_output_ = seconds_of(setup_.output.every, period_);
  double every = settling_output_ / acceleration_;
  if (!(test_end > 0.0) || !(every > 0.0))
    throw InputError("the run's end and the output's interval must be > 0");
  if (!(settle_ >= 0.0) || settle_ >= test_end)
    throw InputError(fmt::format("run.settle = {:.6g} s; must be >= 0 and before the run's end at {:.6g} s",
                                 settle_, test_end));
  end_ = settle_ + (test_end - settle_) / acceleration_;
  // A groove that is worn in part of the way round is no row of a table.
  if (acceleration_ > 1.0 && period_ > 0.0) every = period_ * std::max(1.0, std::round(every / period_));

  double wanted = setup_.run.time_step.value;
  if (setup_.run.method == Method::quasi_static) {
    if (!setup_.insertions.empty())
      throw InputError("method quasi_static balances guided particles; with an [insertion] use dynamic");
    for (const WallSetup& wall : setup_.walls) {
      if (wall.motion.surface_velocity != Vec3{})
        throw InputError(fmt::format("wall '{}' is a belt; use method dynamic", wall.name));
      if (wall.until)
        throw InputError(fmt::format("wall '{}' goes away on the way; use method dynamic", wall.name));
    }
    double speed = 0.0;
    for (std::size_t p = 0; p < particles_.size(); ++p) {
      if (particles_.guide[p] == Vec3{} || norm(particles_.load[p]) == 0.0)
        throw InputError(fmt::format(
            "method quasi_static: particle '{}' needs guide = \"vertical\" and a load", particles_.name[p]));
      for (const Wall& wall : walls_) speed = std::max(speed, fastest_at(wall, particles_.position[p]));
    }
    if (!(speed > 0.0)) throw InputError("method quasi_static: no wall slides under a particle");
    wanted = setup_.run.increment.value_or(choose_increment()) / speed;
  } else if (setup_.run.time_step.of_rayleigh) {
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t p = 0; p < particles_.size(); ++p)
      shortest = std::min(
          shortest, material::rayleigh_time(materials_[static_cast<std::size_t>(particles_.material[p])],
                                            particles_.radius[p]));
    for (std::size_t k = 0; k < setup_.insertions.size(); ++k) {
      const auto m =
          std::ranges::find(setup_.materials, setup_.insertions[k].material, &MaterialSetup::name) -
          setup_.materials.begin();
      shortest = std::min(shortest, material::rayleigh_time(materials_[static_cast<std::size_t>(m)],
                                                            bulk_->inserters()[k].smallest_sphere()));
    }
    wanted *= shortest;
  }
  if (!(wanted > 0.0) || !std::isfinite(wanted)) throw InputError("the time step must be > 0");
  if (acceleration_ > 1.0 && std::min(every, end_ - settle_) < wanted)
    throw InputError(fmt::format(
        "one time step stands for {:.6g} s of the test, more than {}; take a smaller acceleration{}",
        wanted * acceleration_, every < wanted ? "output.every" : "all of it",
        every < wanted ? ", or write less often" : ""));
  // A whole number of steps per output, so that rows fall on whole revolutions.
  const double first = std::min(every, end_ - settle_);
  const double count = std::max(1.0, std::ceil(first / wanted - 1e-9));
  if (const double steps = std::max(count, end_ / wanted); steps > 1e15)
    throw InputError(
        fmt::format("a time step of {:.3g} s makes {:.3g} steps to {:.3g} s; at most 1e15 are possible",
                    wanted, steps, end_));
  steps_per_output_ = static_cast<std::uint64_t>(count);
  dt_ = first / count;
  count_steps();
}

/// What follows from the time step.
void Simulation::count_steps() {
  constexpr double kMost = 1e15;
  settle_steps_ = static_cast<std::uint64_t>(std::llround(settle_ / dt_));
  total_steps_ = settle_steps_ + static_cast<std::uint64_t>(std::llround((end_ - settle_) / dt_));
  steps_per_settling_output_ =
      static_cast<std::uint64_t>(std::clamp(std::round(settling_output_ / dt_), 1.0, kMost));
}

double Simulation::output_intervals() const noexcept {
  const auto settling = static_cast<double>(steps_per_settling_output_);
  if (steps_ < settle_steps_) return static_cast<double>(steps_) / settling;
  return std::ceil(static_cast<double>(settle_steps_) / settling) +
         static_cast<double>(steps_ - settle_steps_) / static_cast<double>(steps_per_output_);
}

double Simulation::revolution() const noexcept { return period_ > 0.0 ? test_time() / period_ : 0.0; }

}  // namespace abradem::simulation
