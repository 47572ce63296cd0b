// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "abradem/simulation/setup.h"
#include "abradem/simulation/simulation.h"

/// How many revolutions are enough to stand for those of a test.                docs/theory/scaling.md
namespace abradem::study {

/// One comparison: the whole wear in n revolutions against the same in 2 n.
struct AccelerationTrial {
  double revolutions = 0.0;          ///< 2 n, of the finer run
  std::optional<double> difference;  ///< of the mean profiles, relative L2 [-]; nothing where a run failed

  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("revolutions", self.revolutions)("difference", self.difference);
  }
};

struct AccelerationChoice {
  double factor = 1.0;       ///< revolutions of the test per modelled one
  double revolutions = 0.0;  ///< modelled
  double tolerance = 0.0;    ///< asked for [-]
  double error = 0.0;        ///< accepted: the last difference; 0 where nothing is accelerated [-]
  std::vector<AccelerationTrial> trials;

  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("factor", self.factor)("revolutions", self.revolutions)("tolerance", self.tolerance)(
        "error", self.error)("trials", self.trials);
  }
};

/// Does a wear pair leave its acceleration to be chosen?
[[nodiscard]] bool wants_acceleration(const simulation::Setup& setup) noexcept;

/// Chooses the acceleration of a setup whose wear pairs say `automatic`: makes the whole wear in n = 4, 8,
/// 16, … revolutions until doubling n changes the profile of the groove, averaged over its sections, by less
/// than the tolerance; the finer of the last two counts. The error of n revolutions falls as 1/n, so that the
/// difference between n and 2 n is that of the finer run. A trial that goes unphysical counts as different.
/// Where not even half the revolutions of the test would do, the factor is 1.
/// @param watch called now and then; where it returns false, Interrupted is thrown
/// @param tried called after each comparison
/// @throws InputError when nothing turns or oscillates, no wall deforms, or several tolerances are given
[[nodiscard]] AccelerationChoice choose_acceleration(
    const simulation::Setup& setup, const simulation::MeshSource& given = simulation::generate_mesh,
    const std::function<bool()>& watch = {}, const std::function<void(const AccelerationTrial&)>& tried = {});

/// The setup with one acceleration in all its wear pairs.
[[nodiscard]] simulation::Setup accelerated(simulation::Setup setup, double factor);

}  // namespace abradem::study
