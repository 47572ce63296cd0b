// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/study/trial.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "abradem/analysis/wall_contours.h"
#include "abradem/core/error.h"

namespace abradem::study {

namespace {

using analysis::Contour;
using analysis::ProfilePoint;
using simulation::Simulation;

analysis::Summary summary_of(std::span<const Contour> contours, double Contour::*measure) {
  std::vector<double> values;
  values.reserve(contours.size());
  for (const Contour& c : contours) values.push_back(c.*measure);
  return analysis::summarise(values);
}

/// Sections of the worn wall as it is now.
std::vector<Contour> sections(const Simulation& run) {
  const auto worn = analysis::worn_wall(run.walls());
  return worn ? analysis::wall_contours(run.walls()[*worn], run.setup().output.contours)
              : std::vector<Contour>{};
}

/// Brings the outcome to the state of an output.
void record(Outcome& outcome, Simulation& run, bool cut) {
  const simulation::Ledger ledger = run.ledger();
  outcome.revolutions = run.revolution();
  outcome.ledger = ledger;
  outcome.volumes = {ledger.law, ledger.swept, ledger.paper};
  outcome.steps = run.steps();
  if (cut) {
    outcome.contours = sections(run);
    outcome.depth = summary_of(outcome.contours, &Contour::depth);
    outcome.width = summary_of(outcome.contours, &Contour::width);
    outcome.area = summary_of(outcome.contours, &Contour::area);
  }
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  outcome.history.push_back({outcome.revolutions, outcome.volumes, cut ? outcome.depth.mean : kNone,
                             cut ? outcome.width.mean : kNone});
}

/// Height of a section at a radius; 0 beyond its ends.   @param from where to begin to look, moved on
double height_at(std::span<const ProfilePoint> profile, double radius, std::size_t& from) {
  while (from < profile.size() && profile[from].radius < radius) ++from;
  if (from == profile.size()) return 0.0;
  const ProfilePoint& right = profile[from];
  if (right.radius == radius) return right.height;
  if (from == 0) return 0.0;
  const ProfilePoint& left = profile[from - 1];
  return std::lerp(left.height, right.height, (radius - left.radius) / (right.radius - left.radius));
}

}  // namespace

Outcome run_trial(const simulation::Setup& setup, const simulation::MeshSource& source,
                  const TrialOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  Simulation run(setup, source);
  Outcome outcome;
  bool enough = false;
  try {
    while (!run.finished() && !enough) {
      const bool due = run.advance([&] { return !options.watch || options.watch(run); });
      if (!due || (options.watch && !options.watch(run)))
        throw Interrupted(fmt::format("interrupted at step {} of {}", run.steps(), run.total_steps()));
      record(outcome, run, options.sections_in_history || run.finished());
      enough = options.enough && options.enough(outcome.history.back());
    }
    if (enough && !options.sections_in_history && !run.finished()) {
      outcome.history.pop_back();
      record(outcome, run, true);
    }
  } catch (const SimulationError& error) {
    if (!options.keep_failed) throw;
    outcome.failure = error.what();
  }
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return outcome;
}

std::vector<ProfilePoint> mean_profile(std::span<const Contour> contours, double step) {
  if (!(step > 0.0) || !std::isfinite(step))
    throw InputError(fmt::format("mean_profile: step = {} m; must be > 0", step));
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Contour& c : contours)
    if (!c.profile.empty()) {
      low = std::min(low, c.profile.front().radius);
      high = std::max(high, c.profile.back().radius);
    }
  if (low > high) return {};
  const double first = std::floor(low / step), last = std::ceil(high / step);
  if (last - first > 1e7)
    throw InputError(
        fmt::format("mean_profile: a step of {} m is too fine for sections {} m wide", step, high - low));
  std::vector<ProfilePoint> mean;
  for (double k = first; k <= last; ++k) mean.push_back({k * step, 0.0});
  for (const Contour& c : contours) {
    std::size_t from = 0;
    for (ProfilePoint& p : mean) p.height += height_at(c.profile, p.radius, from);
  }
  for (ProfilePoint& p : mean) p.height /= static_cast<double>(contours.size());
  return mean;
}

double profile_distance(std::span<const ProfilePoint> a, std::span<const ProfilePoint> b) {
  std::vector<double> radii;
  for (const auto& profile : {a, b})
    for (const ProfilePoint& p : profile) radii.push_back(p.radius);
  std::ranges::sort(radii);
  const auto repeated = std::ranges::unique(radii);
  radii.erase(repeated.begin(), repeated.end());

  // Between two neighbouring radii both are straight: the integral of a straight line's square is
  // length (f0^2 + f0 f1 + f1^2) / 3. An end that is not at height 0 is a step there, of no width.
  const auto within = [](std::span<const ProfilePoint> profile, double low, double high) {
    return !profile.empty() && profile.front().radius <= low && high <= profile.back().radius;
  };
  double difference = 0.0, size = 0.0;
  std::size_t from_a = 0, from_b = 0;
  for (std::size_t i = 0; i + 1 < radii.size(); ++i) {
    const double low = radii[i], high = radii[i + 1];
    const auto ends = [&](std::span<const ProfilePoint> profile, std::size_t& from) {
      if (!within(profile, low, high)) return std::pair(0.0, 0.0);
      const double left = height_at(profile, low, from);
      return std::pair(left, height_at(profile, high, from));
    };
    const auto [a0, a1] = ends(a, from_a);
    const auto [b0, b1] = ends(b, from_b);
    const auto square = [&](double f0, double f1) {
      return (high - low) * (f0 * f0 + f0 * f1 + f1 * f1) / 3.0;
    };
    difference += square(a0 - b0, a1 - b1);
    size += square(b0, b1);
  }
  if (difference == 0.0) return 0.0;
  return std::sqrt(difference / size);
}

}  // namespace abradem::study
