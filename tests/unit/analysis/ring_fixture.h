// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "abradem/core/vec3.h"
#include "abradem/geometry/triangle_mesh.h"

/// Walls with a groove of known shape, for the tests of the sections.
namespace abradem::analysis::test {

constexpr double kTrack = 22e-3;  ///< [m] radius of the wear track
constexpr double kBall = 3e-3;    ///< [m]

/// Circular segment of radius kBall pressed `depth` below the surface, `across` from the middle of the track.
inline double segment_sink(double across, double depth) {
  if (std::abs(across) >= kBall) return 0.0;
  return std::max(0.0, depth - kBall + std::sqrt(kBall * kBall - across * across));
}
/// Chord of that segment `level` below the surface [m].
inline double segment_width(double depth, double level) {
  const double to_chord = kBall - depth + level;
  return 2.0 * std::sqrt(kBall * kBall - to_chord * to_chord);
}
inline double segment_area(double depth) {
  const double to_chord = kBall - depth;
  return kBall * kBall * std::acos(to_chord / kBall) -
         to_chord * std::sqrt(kBall * kBall - to_chord * to_chord);
}

struct Wall {
  geometry::TriangleMesh mesh;
  std::vector<Vec3> reference;
};

/// Structured grid of n_first by n_second cells, each cut in two; wraps around in the second direction if
/// asked.
inline geometry::TriangleMesh grid(int n_first, int n_second, bool wrap,
                                   const std::function<Vec3(int, int)>& at) {
  geometry::TriangleMesh mesh;
  const int columns = wrap ? n_second : n_second + 1;
  for (int i = 0; i <= n_first; ++i)
    for (int j = 0; j < columns; ++j) mesh.vertices.push_back(at(i, j));
  const auto id = [&](int i, int j) { return i * columns + j % columns; };
  for (int i = 0; i < n_first; ++i)
    for (int j = 0; j < n_second; ++j) {
      mesh.triangles.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      mesh.triangles.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  return mesh;
}

/// Ring of width 2.4 mm around the track with elements of size h; turns (fraction of) a circle from angle 0.
/// The nodes miss the middle of the track by lie * h, so that no symmetry helps.
inline Wall ring(double h, double turns = 1.0, double lie = 0.37) {
  const bool whole = turns >= 1.0;
  const int n_r = static_cast<int>(std::lround(2.4e-3 / h));
  const int n_angle = static_cast<int>(std::lround(2.0 * std::numbers::pi * kTrack * turns / h));
  Wall wall;
  wall.mesh = grid(n_r, n_angle, whole, [&](int i, int j) {
    const double r = kTrack + (i - n_r / 2 + lie) * h;
    const double angle = 2.0 * std::numbers::pi * turns * (j + 0.21) / n_angle;
    return Vec3{r * std::cos(angle), r * std::sin(angle), 0.0};
  });
  wall.reference = wall.mesh.vertices;
  return wall;
}

/// Sinks every vertex by sink(x, y) along -z.
template <typename Sink>
void wear(Wall& wall, Sink sink) {
  for (Vec3& p : wall.mesh.vertices) p.z -= sink(p.x, p.y);
}
inline void wear_track(Wall& wall, double depth) {
  wear(wall, [&](double x, double y) { return segment_sink(std::hypot(x, y) - kTrack, depth); });
}

}  // namespace abradem::analysis::test
