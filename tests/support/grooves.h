// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "abradem/analysis/contour.h"
#include "abradem/simulation/simulation.h"

/// What the tests measure on a worn ring.
namespace abradem::test {

struct Groove {
  double depth = 0.0, width = 0.0, area = 0.0;  ///< means over the sections [m, m, m^2]
  double width_at_tenth = 0.0;                  ///< opening at a tenth of each section's depth [m]
  double depth_sd = 0.0;                        ///< over the sections [m]
  std::vector<double> profile;                  ///< mean sink at the distances asked for [m]
};

/// Sink of a profile at one radius, linear between its points; 0 outside.
inline double sink_at(const std::vector<analysis::ProfilePoint>& profile, double radius) {
  const auto next = std::ranges::lower_bound(profile, radius, {}, &analysis::ProfilePoint::radius);
  if (next == profile.begin() || next == profile.end()) return 0.0;
  const auto previous = next - 1;
  const double f = (radius - previous->radius) / (next->radius - previous->radius);
  return -((1.0 - f) * previous->height + f * next->height);
}

/// Means over sections through a surface.
/// @param across distances from `middle` at which the mean profile is wanted [m]; both sides are averaged
inline Groove mean_of(std::span<const analysis::Contour> contours, double middle,
                      std::span<const double> across) {
  Groove g;
  g.profile.assign(across.size(), 0.0);
  const double n = static_cast<double>(contours.size());
  for (const analysis::Contour& c : contours) {
    g.depth += c.depth / n;
    g.width += c.width / n;
    g.area += c.area / n;
    g.width_at_tenth += analysis::opening(c.profile, 0.1 * c.depth) / n;
    for (std::size_t i = 0; i < across.size(); ++i)
      g.profile[i] +=
          0.5 * (sink_at(c.profile, middle + across[i]) + sink_at(c.profile, middle - across[i])) / n;
  }
  for (const analysis::Contour& c : contours) g.depth_sd += (c.depth - g.depth) * (c.depth - g.depth) / n;
  g.depth_sd = std::sqrt(g.depth_sd);
  return g;
}

/// Of a ring; the average of both sides cancels the effect of the track's curvature to first order.
inline Groove measure_ring(const simulation::Simulation& run, double track,
                           std::span<const double> across = {}, int sections = 90) {
  const wear::WearingSurface& surface = run.walls()[0].surface();
  const auto region = analysis::worn_region(surface.mesh(), surface.reference());
  analysis::RotaryCuts cuts;
  cuts.count = sections;
  return mean_of(analysis::cut_contours(surface.mesh(), surface.reference(), region, cuts), track, across);
}

/// Of a plate rubbed along x, between -half_length and half_length.
inline Groove measure_plate(const simulation::Simulation& run, double half_length,
                            std::span<const double> across = {}, int sections = 60) {
  const wear::WearingSurface& surface = run.walls()[0].surface();
  const auto region = analysis::worn_region(surface.mesh(), surface.reference());
  analysis::StraightCuts cuts;
  cuts.along = {-half_length, half_length};
  cuts.count = sections;
  return mean_of(analysis::cut_contours(surface.mesh(), surface.reference(), region, cuts), 0.0, across);
}

/// |a - b| / |b| in the root-mean-square sense.
inline double relative_l2(std::span<const double> a, std::span<const double> b) {
  double difference = 0.0, size = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference += (a[i] - b[i]) * (a[i] - b[i]);
    size += b[i] * b[i];
  }
  return std::sqrt(difference / size);
}

}  // namespace abradem::test
