// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/study/acceleration.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>

#include "abradem/core/error.h"
#include "abradem/study/trial.h"

namespace abradem::study {

namespace {

using simulation::Setup;
using Profile = std::vector<analysis::ProfilePoint>;

/// Revolutions (cycles) of the test.
double revolutions_of(const Setup& setup, const simulation::MeshSource& source) {
  if (setup.run.end.in_revolutions) return setup.run.end.value;
  const simulation::Simulation run(accelerated(setup, 1.0), source);
  if (!run.turns())
    throw InputError(
        "acceleration = \"auto\" chooses a number of revolutions, but no wall turns or oscillates");
  return setup.run.end.value / run.period();
}

double tolerance_of(const Setup& setup) {
  std::optional<double> tolerance;
  for (const simulation::WearSetup& w : setup.wear) {
    if (!w.acceleration.automatic) continue;
    if (tolerance && *tolerance != w.tolerance)
      throw InputError("the wear pairs give different tolerances for one acceleration");
    tolerance = w.tolerance;
  }
  if (!tolerance) throw InputError("no wear pair asks for an acceleration to be chosen");
  return *tolerance;
}

/// The mean section after all the wear in n revolutions; nothing where the run goes unphysical.
std::optional<Profile> groove(const Setup& setup, const simulation::MeshSource& source, double factor,
                              const std::function<bool()>& watch) {
  constexpr double kShare = 0.1;  // of an element: the profile is a polyline over elements
  Setup run = accelerated(setup, factor);
  run.output.every = run.run.end;
  double size = 0.0;
  for (const simulation::WallSetup& w : setup.walls)
    if (w.deformation != simulation::DeformationRule::none && size == 0.0) size = w.mesh.size;
  TrialOptions options;
  options.watch = [&](const simulation::Simulation&) { return !watch || watch(); };
  try {
    const Outcome outcome = run_trial(run, source, options);
    if (outcome.contours.empty())
      throw InputError("acceleration = \"auto\" compares grooves, but no wall of the case wears one");
    if (size == 0.0) size = 1e-2 * outcome.width.mean;  // a mesh from a file
    return mean_profile(outcome.contours, size > 0.0 ? kShare * size : 1e-6);
  } catch (const SimulationError&) {
    return std::nullopt;
  }
}

/// Makes each mesh once for all trials.
class Meshes {
 public:
  explicit Meshes(const simulation::MeshSource& source) : source_(source) {}
  geometry::TriangleMesh operator()(const simulation::MeshSetup& mesh, std::uint64_t seed) {
    for (const auto& [setup, made] : made_)
      if (setup == mesh) return made;
    made_.emplace_back(mesh, source_(mesh, seed));
    return made_.back().second;
  }

 private:
  const simulation::MeshSource& source_;
  std::vector<std::pair<simulation::MeshSetup, geometry::TriangleMesh>> made_;
};

}  // namespace

bool wants_acceleration(const Setup& setup) noexcept {
  return std::ranges::any_of(setup.wear, [](const auto& w) { return w.acceleration.automatic; });
}

Setup accelerated(Setup setup, double factor) {
  for (simulation::WearSetup& w : setup.wear) w.acceleration = {factor, false};
  return setup;
}

AccelerationChoice choose_acceleration(const Setup& setup, const simulation::MeshSource& given,
                                       const std::function<bool()>& watch,
                                       const std::function<void(const AccelerationTrial&)>& tried) {
  constexpr double kFewest = 4.0;  // revolutions of the first trial
  AccelerationChoice choice;
  choice.tolerance = tolerance_of(setup);
  Meshes meshes(given);
  const simulation::MeshSource source = std::ref(meshes);
  const double N = revolutions_of(setup, source);
  choice.revolutions = N;
  if (2.0 * kFewest >= N) return choice;
  std::optional<Profile> coarse = groove(setup, source, N / kFewest, watch);
  for (double n = 2.0 * kFewest; n < N; n *= 2.0) {
    std::optional<Profile> fine = groove(setup, source, N / n, watch);
    AccelerationTrial trial{n, std::nullopt};
    if (coarse && fine) trial.difference = profile_distance(*coarse, *fine);
    choice.trials.push_back(trial);
    if (tried) tried(trial);
    if (trial.difference && *trial.difference < choice.tolerance) {
      choice.factor = N / n;
      choice.revolutions = n;
      choice.error = *trial.difference;
      return choice;
    }
    coarse = std::move(fine);
  }
  return choice;
}

}  // namespace abradem::study
