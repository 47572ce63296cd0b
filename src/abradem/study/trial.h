// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "abradem/analysis/contour.h"
#include "abradem/analysis/revolution_row.h"
#include "abradem/analysis/statistics.h"
#include "abradem/simulation/simulation.h"

/// One run of a study: in memory, nothing written.                              docs/theory/calibration.md
namespace abradem::study {

/// The state after one output interval.
struct Milestone {
  double revolutions = 0.0;       ///< of the first wall that turns (cycles: oscillates); 0 where none does
  analysis::WearVolumes volumes;  ///< since the start
  double depth_mean = 0.0, width_mean = 0.0;  ///< [m] over the sections; NaN where none were cut
};

/// What a run came to. Sections are of the first wall that deforms; without one there are none.
struct Outcome {
  double revolutions = 0.0;       ///< made
  analysis::WearVolumes volumes;  ///< at the end
  simulation::Ledger ledger;
  analysis::Summary depth, width;           ///< over the sections [m]
  analysis::Summary area;                   ///< [m^2]
  std::vector<analysis::Contour> contours;  ///< at the end, each with its profile
  std::vector<Milestone> history;           ///< one per output, the last at the end
  std::uint64_t steps = 0;
  double seconds = 0.0;  ///< wall time of steps and sections
  std::string failure;   ///< why the run ended before its time; empty where it did not
};

struct TrialOptions {
  /// Called every few milliseconds; where it returns false the trial ends with Interrupted.
  std::function<bool(const simulation::Simulation&)> watch{};
  /// Called after each output; where it returns true the run has shown enough and ends there.
  std::function<bool(const Milestone&)> enough{};
  /// Sections after every output, for the history's depth and width, not only at the end.
  bool sections_in_history = false;
  /// A run that leaves the range its equations hold in throws; or, where this is set, gives what it had at
  /// its last output and says why it stopped.
  bool keep_failed = false;
};

/// Runs a setup to its end: the same steps, hence the same bits, as `abradem run` on that case.
/// @throws Interrupted when watch says so; InputError, GeometryError for a setup that cannot run;
/// SimulationError when it goes unphysical (but see keep_failed)
[[nodiscard]] Outcome run_trial(const simulation::Setup& setup,
                                const simulation::MeshSource& source = simulation::generate_mesh,
                                const TrialOptions& options = {});

/// The mean section of a groove: heights averaged over the sections at the radii k step (k whole), from the
/// first to the last radius that any section reaches; a section is at height 0 beyond its ends. Empty where
/// no section has a point.   @param step [m], > 0   @throws InputError otherwise
[[nodiscard]] std::vector<analysis::ProfilePoint> mean_profile(std::span<const analysis::Contour> contours,
                                                               double step);

/// Relative distance of two sections, sqrt(int (a - b)^2 dr / int b^2 dr), exact for the polylines, which are
/// at height 0 beyond their ends. Infinite where b is flat and a is not; 0 where both are.
/// @param a, b by ascending radius
[[nodiscard]] double profile_distance(std::span<const analysis::ProfilePoint> a,
                                      std::span<const analysis::ProfilePoint> b);

}  // namespace abradem::study
