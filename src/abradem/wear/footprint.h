// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "abradem/contact/mesh_candidates.h"

namespace abradem::wear {

/// How the wear of one contact falls on the triangles under it: shares that sum to one, and of each share
/// what falls to the triangle's three vertices (the shape functions' moments of the pressure).
struct FootprintShares {
  std::vector<std::int32_t> triangle;  ///< local, in the candidates
  std::vector<double> share;           ///< [-]
  std::vector<double> at0, at1, at2;   ///< parts of the share at the vertices; at0 + at1 + at2 = share
};

/// The overlapped surface of one patch as the footprints see it; all per candidate triangle.
struct OverlapField {
  std::span<const double> e0, e1, e2;  ///< excess 1 - |x - c|^2 / R^2 at the corners
  std::span<const double> bound;       ///< no point of the triangle has a larger excess
  double R = 0.0;                      ///< [m]
  double deepest = 0.0;                ///< largest overlap g in the patch [m]
};

/// Distributes wear by a pressure that depends on the local overlap g alone. docs/theory/wear.md#footprint
class FootprintIntegrator {
 public:
  /// Hertz: weight sqrt(max(0, d_e - 2 (g_max - g))), the pressure of an elastic half-space pressed by the
  /// approach d_e; only differences of g enter, so the height of the ball does not matter.
  const FootprintShares& hertz(const contact::MeshCandidates& candidates, const OverlapField& field,
                               double d_e, std::span<const char> mask = {});
  /// Overlap: weight max(0, g), a bed of springs.
  const FootprintShares& overlap(const contact::MeshCandidates& candidates, const OverlapField& field,
                                 std::span<const char> mask = {});

 private:
  void select(const contact::MeshCandidates& candidates, const OverlapField& field, double cut,
              std::span<const char> mask);
  template <typename Weight>
  void integrate(double reach, const Weight& weight);
  template <typename Weight>
  void subdivide(std::size_t k, int n, const Weight& weight);
  void normalise();

  FootprintShares shares_;
  std::vector<double> e0_, e1_, e2_, l01_, l12_, l20_, area_, w0_, w1_, w2_;  // of the selected, padded
  double longest_ = 0.0;
};

}  // namespace abradem::wear
