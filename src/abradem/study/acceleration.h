// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "abradem/simulation/setup.h"
#include "abradem/simulation/simulation.h"

/// How many revolutions or seconds are enough to stand for those of a test.     docs/theory/scaling.md
namespace abradem::study {

/// One comparison: the whole wear in n revolutions (seconds) against the same in 2 n.
struct AccelerationTrial {
  double modelled = 0.0;             ///< 2 n, of the finer run, while walls wear: revolutions, or [s]
  std::optional<double> difference;  ///< of the profiles or the maps, relative L2 [-]; nothing where none is
  std::string failure;               ///< why there is none
  double volume_difference = 0.0;    ///< of maps: of the volume in all, relative [-]
  double noise = 0.0;                ///< of maps: the flow's in the finer one, relative L2 [-]

  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("modelled", self.modelled)("difference", self.difference)("failure", self.failure);
    archive("volume_difference", self.volume_difference)("noise", self.noise);
  }
  /// Of maps: is the greater part of the difference the flow's noise, rather than the steps of the shape?
  [[nodiscard]] bool noise_limits() const noexcept;
};

struct AccelerationChoice {
  double factor = 1.0;          ///< revolutions (seconds) of the test per modelled one
  double modelled = 0.0;        ///< while walls wear: revolutions, or [s]
  bool in_revolutions = false;  ///< else in seconds
  bool by_maps = false;         ///< else by the profile of the groove
  double tolerance = 0.0;       ///< asked for [-]
  double error = 0.0;           ///< accepted: the last difference; 0 where nothing is accelerated [-]
  std::vector<AccelerationTrial> trials;

  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("factor", self.factor)("modelled", self.modelled)("in_revolutions", self.in_revolutions);
    archive("by_maps", self.by_maps)("tolerance", self.tolerance)("error", self.error);
    archive("trials", self.trials);
  }
};

/// "mostly the flow's noise, 3.1 % of the longer run", or that it is mostly the steps of the shape.
[[nodiscard]] std::string what_limits(const AccelerationTrial& trial);

/// Does a wear pair leave its acceleration to be chosen?
[[nodiscard]] bool wants_acceleration(const simulation::Setup& setup) noexcept;

/// Called now and then while a trial runs; where it returns false, Interrupted is thrown.
using WatchTrial = std::function<bool(const simulation::Simulation&)>;

/// Called after each comparison, which is the last of the choice's trials.
using TrialMade = std::function<void(const AccelerationTrial&, const AccelerationChoice&)>;

/// Chooses the acceleration of a setup whose wear pairs say `automatic`: makes the whole wear in n, 2 n,
/// 4 n, … revolutions (from n = 4) or, where nothing turns, seconds (from n = the time in which the flow
/// settles) until doubling n changes the result by less than the tolerance; the finer of the last two counts.
///   - One particle: the result is the profile of its groove, averaged over the sections. The error of n
///     revolutions falls as 1/n, so that the difference between n and 2 n is that of the finer run.
///   - Particles in numbers: the map of depths of all walls that deform, averaged over places as wide as the
///     largest particle. Each trial draws its own random numbers; the difference holds the noise of both.
/// A trial that goes unphysical counts as different. Where not even half the length of the test would do, the
/// factor is 1.
/// @throws InputError when nothing turns and no time to settle is given, no wall deforms, or several
/// tolerances are given
[[nodiscard]] AccelerationChoice choose_acceleration(
    const simulation::Setup& setup, const simulation::MeshSource& given = simulation::generate_mesh,
    const WatchTrial& watch = {}, const TrialMade& tried = {});

/// The setup with one acceleration in all its wear pairs.
[[nodiscard]] simulation::Setup accelerated(simulation::Setup setup, double factor);

/// How much would have to be modelled for a tolerance, by a trial of maps that came short of it: noise falls
/// as the root of the length, the error of the steps as the length.
[[nodiscard]] double length_for(const AccelerationTrial& trial, double tolerance) noexcept;

}  // namespace abradem::study
