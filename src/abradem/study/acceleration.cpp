// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/study/acceleration.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "abradem/analysis/depth_map.h"
#include "abradem/core/error.h"
#include "abradem/simulation/insertion.h"
#include "abradem/simulation/wall_motion.h"
#include "abradem/study/trial.h"

namespace abradem::study {

namespace {

using analysis::map_size;
using simulation::Setup;
using simulation::Simulation;
using Profile = std::vector<analysis::ProfilePoint>;

/// While walls wear: revolutions (cycles) of the test, or seconds where nothing turns.
double length_of(const Setup& setup, double period) {
  const simulation::Duration &end = setup.run.end, &settle = setup.run.settle;
  if (end.in_revolutions && period > 0.0 && settle.value == 0.0) return end.value;
  const double seconds = simulation::seconds_of(end, period) - simulation::seconds_of(settle, period);
  return period > 0.0 ? seconds / period : seconds;
}

double tolerance_of(const Setup& setup, bool by_maps) {
  constexpr double kOfProfile = 0.01, kOfMap = 0.1;
  const simulation::WearSetup* first = nullptr;
  for (const simulation::WearSetup& w : setup.wear) {
    if (!w.acceleration.automatic) continue;
    if (first != nullptr && first->tolerance != w.tolerance)
      throw InputError("the wear pairs give different tolerances for one acceleration");
    first = &w;
  }
  if (first == nullptr) throw InputError("no wear pair asks for an acceleration to be chosen");
  return first->tolerance.value_or(by_maps ? kOfMap : kOfProfile);
}

bool deforms(const simulation::WallSetup& wall) {
  return wall.deformation != simulation::DeformationRule::none &&
         wall.mesh.shape != simulation::MeshShape::plane;
}

/// Makes each mesh once for all trials, whatever their seeds.
class Meshes {
 public:
  Meshes(const simulation::MeshSource& source, std::uint64_t seed) : source_(source), seed_(seed) {}
  geometry::TriangleMesh operator()(const simulation::MeshSetup& mesh, std::uint64_t) {
    for (const auto& [setup, made] : made_)
      if (setup == mesh) return made;
    made_.emplace_back(mesh, source_(mesh, seed_));
    return made_.back().second;
  }

 private:
  const simulation::MeshSource& source_;
  std::uint64_t seed_;
  std::vector<std::pair<simulation::MeshSetup, geometry::TriangleMesh>> made_;
};

/// What the comparisons of one case share.
struct Search {
  const Setup& setup;
  const simulation::MeshSource& source;
  const WatchTrial& watch;
  double length;  // of the test, while walls wear
  double period;
};

/// Grooves: the mean section after all the wear in n revolutions.
class Grooves {
 public:
  explicit Grooves(const Search& search) : search_(search) {}

  /// @return why there is no result; empty where there is one
  std::string run(double n) {
    constexpr double kShare = 0.1;  // of an element: the profile is a polyline over elements
    Setup run = accelerated(search_.setup, search_.length / n);
    run.output.every = run.run.end;
    double size = 0.0;
    for (const simulation::WallSetup& w : run.walls)
      if (deforms(w) && size == 0.0) size = w.mesh.size;
    TrialOptions options;
    options.watch = search_.watch;
    coarse_ = std::exchange(fine_, std::nullopt);
    try {
      const Outcome outcome = run_trial(run, search_.source, options);
      if (outcome.contours.empty())
        throw InputError("acceleration = \"auto\" compares grooves, but no wall of the case wears one");
      if (size == 0.0) size = 1e-2 * outcome.width.mean;  // a mesh from a file
      fine_ = mean_profile(outcome.contours, size > 0.0 ? kShare * size : 1e-6);
    } catch (const SimulationError& error) {
      return error.what();
    }
    return {};
  }
  void compare(AccelerationTrial& trial) const {
    if (coarse_ && fine_) trial.difference = profile_distance(*coarse_, *fine_);
  }

 private:
  const Search& search_;
  std::optional<Profile> coarse_, fine_;
};

/// Width of the largest particle [m].
double widest(const Simulation& run) {
  double radius = 0.0;
  for (const double R : run.particles().radius) radius = std::max(radius, R);
  for (const simulation::Inserter& inserter : run.bulk()->inserters())
    radius = std::max(radius, simulation::largest_radius(inserter.setup()));
  return 2.0 * radius;
}

/// Particles in numbers: the depths of all walls that deform, after all the wear in n.
class Maps {
 public:
  explicit Maps(const Search& search) : search_(search) {}

  std::string run(double n) {
    Setup setup = accelerated(search_.setup, search_.length / n);
    const double quarter = 0.25 * search_.length * (search_.period > 0.0 ? search_.period : 1.0);
    setup.output.every = {quarter, false};
    setup.output.maps = simulation::Maps::off;
    setup.run.seed += ++made_;  // the noise of each is its own
    coarse_ = std::exchange(fine_, std::nullopt);
    try {
      fine_ = worn(setup);
    } catch (const SimulationError& error) {
      return error.what();
    }
    return map_size(fine_->depth, places_->area()) > 0.0 ? "" : "nothing was worn";
  }
  void compare(AccelerationTrial& trial) const {
    if (!coarse_ || !fine_) return;
    const std::vector<double>& area = places_->area();
    const double size = map_size(fine_->depth, area);
    if (!(size > 0.0)) return;
    std::vector<double> difference = fine_->depth;
    for (std::size_t p = 0; p < difference.size(); ++p) difference[p] -= coarse_->depth[p];
    trial.difference = map_size(difference, area) / size;
    trial.volume_difference = std::abs(coarse_->volume / fine_->volume - 1.0);
    trial.noise = analysis::map_noise(fine_->quarters, area) / size;
  }

 private:
  struct Worn {
    std::vector<double> depth;                    // of each place, in all [m]
    std::array<std::vector<double>, 4> quarters;  // … in each quarter of the time
    double volume = 0.0;                          // [m^3]
  };

  Worn worn(const Setup& setup) {
    Simulation run(setup, search_.source);
    if (!places_) gather(run);
    Worn out;
    out.depth.assign(places_->size(), 0.0);
    for (std::size_t quarter = 0; quarter < out.quarters.size();) {
      const bool due = run.advance([&] { return !search_.watch || search_.watch(run); });
      if (!due || (search_.watch && !search_.watch(run)))
        throw Interrupted(fmt::format("interrupted at step {} of {}", run.steps(), run.total_steps()));
      if (run.test_time() <= run.settle_time()) continue;
      std::vector<double> depth = depths(run);
      out.quarters[quarter] = depth;
      for (std::size_t p = 0; p < depth.size(); ++p) out.quarters[quarter][p] -= out.depth[p];
      out.depth = std::move(depth);
      ++quarter;
    }
    for (std::size_t p = 0; p < out.depth.size(); ++p) out.volume += places_->area()[p] * out.depth[p];
    return out;
  }
  void gather(const Simulation& run) {
    places_.emplace(widest(run));
    for (const simulation::Wall& wall : run.walls())
      if (deforms(wall.setup())) places_->add(wall.surface().reference(), wall.surface().mesh().triangles);
  }
  [[nodiscard]] std::vector<double> depths(const Simulation& run) const {
    std::vector<double> volumes;
    for (const simulation::Wall& wall : run.walls()) {
      if (!deforms(wall.setup())) continue;
      const auto volume = wall.surface().element_volume();
      volumes.insert(volumes.end(), volume.begin(), volume.end());
    }
    return places_->depths(volumes);
  }

  const Search& search_;
  std::uint64_t made_ = 0;
  std::optional<analysis::DepthPlaces> places_;
  std::optional<Worn> coarse_, fine_;
};

/// Doubles n until the results of n and 2 n agree.
template <typename Results>
void search(const Search& search, double first, AccelerationChoice& choice, const TrialMade& tried) {
  Results results(search);
  std::string failure = results.run(first);
  for (double n = 2.0 * first; n < search.length; n *= 2.0) {
    const std::string coarse = std::exchange(failure, results.run(n));
    AccelerationTrial trial{.modelled = n, .difference = {}, .failure = failure.empty() ? coarse : failure};
    if (trial.failure.empty()) results.compare(trial);
    choice.trials.push_back(trial);
    if (tried) tried(trial, choice);
    if (trial.difference && *trial.difference < choice.tolerance) {
      choice.factor = search.length / n;
      choice.modelled = n;
      choice.error = *trial.difference;
      return;
    }
  }
}

}  // namespace

/// Of the difference's mean square, 3 parts are the noise of the finer run where both are independent.
bool AccelerationTrial::noise_limits() const noexcept {
  return difference && 3.0 * noise * noise > 0.5 * *difference * *difference;
}

std::string what_limits(const AccelerationTrial& trial) {
  return trial.noise_limits()
             ? fmt::format("mostly the flow's noise, {:.2g} % of the longer run", 100.0 * trial.noise)
             : fmt::format("mostly the steps of the shape; the flow's noise is {:.2g} % of the longer run",
                           100.0 * trial.noise);
}

double length_for(const AccelerationTrial& trial, double tolerance) noexcept {
  const double ratio = trial.difference.value_or(0.0) / tolerance;
  return trial.modelled * (trial.noise_limits() ? ratio * ratio : ratio);
}

bool wants_acceleration(const Setup& setup) noexcept {
  return std::ranges::any_of(setup.wear, [](const auto& w) { return w.acceleration.automatic; });
}

Setup accelerated(Setup setup, double factor) {
  for (simulation::WearSetup& w : setup.wear) w.acceleration = {factor, false};
  return setup;
}

AccelerationChoice choose_acceleration(const Setup& setup, const simulation::MeshSource& given,
                                       const WatchTrial& watch, const TrialMade& tried) {
  constexpr double kFewest = 4.0;  // revolutions of the first trial
  AccelerationChoice choice;
  choice.by_maps = !setup.insertions.empty();
  choice.tolerance = tolerance_of(setup, choice.by_maps);
  const double period = simulation::period_of(setup.walls);
  choice.in_revolutions = period > 0.0;
  const double first = choice.in_revolutions ? kFewest : simulation::seconds_of(setup.run.settle, period);
  if (!choice.in_revolutions && !(choice.by_maps && first > 0.0))
    throw InputError(
        choice.by_maps
            ? "acceleration = \"auto\" first models as long as the flow takes to settle; give run.settle"
            : "acceleration = \"auto\" chooses a number of revolutions, but no wall turns or oscillates");
  if (choice.by_maps && std::ranges::none_of(setup.walls, deforms))
    throw InputError("acceleration = \"auto\" compares the shapes of walls, but no wall changes its shape");
  const double length = choice.modelled = length_of(setup, period);
  if (2.0 * first >= length) return choice;
  Meshes meshes(given, setup.run.seed);
  const simulation::MeshSource source = std::ref(meshes);
  const Search how{setup, source, watch, length, period};
  if (choice.by_maps)
    search<Maps>(how, first, choice, tried);
  else
    search<Grooves>(how, first, choice, tried);
  return choice;
}

}  // namespace abradem::study
