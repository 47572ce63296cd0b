// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "abradem/contact/mesh_candidates.h"
#include "abradem/core/vec3.h"

/// The worn end of a sphere that cannot spin.                                        docs/theory/pin-wear.md
namespace abradem::contact {

/// How far the surface of a sphere stands back from the sphere along the axis of the map, on a square lattice
/// over the plane across that axis; s and t are the coordinates in that plane. Linear between the lattice's
/// points, zero outside.
struct TipShape {
  double cell = 0.0;              ///< distance of the lattice's points [m]
  int half = 0;                   ///< points from the middle to an edge
  std::vector<double> recession;  ///< along the axis [m]; row by row along s, (2 half + 1)^2
  std::uint64_t revision = 0;     ///< changes with the shape; 0: as new

  [[nodiscard]] int side() const noexcept { return 2 * half + 1; }
  /// Place of the point (i, j) in `recession`, both counted from the middle.
  [[nodiscard]] std::size_t index(int i, int j) const noexcept {
    const int column = i + half, row = j + half;
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(side()) +
           static_cast<std::size_t>(column);
  }
  [[nodiscard]] double at(double s, double t) const noexcept {
    const double inverse = 1.0 / cell, x = s * inverse + half, y = t * inverse + half, end = 2.0 * half;
    if (!(x >= 0.0 && x < end && y >= 0.0 && y < end)) return 0.0;
    const int i = static_cast<int>(x), j = static_cast<int>(y);
    const double a = x - i, b = y - j;
    const double* row = recession.data() + static_cast<std::ptrdiff_t>(j) * side() + i;
    return (1.0 - b) * ((1.0 - a) * row[0] + a * row[1]) +
           b * ((1.0 - a) * row[side()] + a * row[side() + 1]);
  }
};

/// The excess 1 - |x - c|^2 / R^2 of a point as a worn sphere sees it: that of the point pushed out along the
/// axis by the recession r there, which is 0 on the worn surface.  @param z (x - c) . axis [m]
[[nodiscard]] inline double worn_excess(double excess, double r, double z, double R) noexcept {
  return excess - r * (2.0 * z + r) / (R * R);
}

/// A worn end as a wall sees it: the map and where its axes point in the wall's frame. Without a shape, or
/// with one as new, the sphere is a sphere.
struct Tip {
  const TipShape* shape = nullptr;
  Vec3 u, v, axis;  ///< of s, of t, and from the centre to the middle of the map; orthonormal

  [[nodiscard]] bool worn() const noexcept { return shape != nullptr && shape->revision > 0; }
  /// Recession over a point at an offset from the centre [m].
  [[nodiscard]] double recession(const Vec3& offset) const noexcept {
    return dot(offset, axis) > 0.0 ? shape->at(dot(offset, u), dot(offset, v)) : 0.0;
  }
  /// The excess of that point, from that of the sphere as new.
  [[nodiscard]] double excess(double raw, const Vec3& offset, double R) const noexcept {
    return worn_excess(raw, recession(offset), dot(offset, axis), R);
  }
  /// Overlap with that point; R - |offset| of the sphere as new [m].
  [[nodiscard]] double overlap(const Vec3& offset, double R) const noexcept {
    return R - norm(worn() ? offset + recession(offset) * axis : offset);
  }
  /// Unit normal of the worn surface at the place of the map over that point, into the sphere: the gradient
  /// of |offset + r axis|, r's slope taken over two cells.
  [[nodiscard]] Vec3 inward_normal(const Vec3& offset) const noexcept {
    const Vec3 pushed = offset + recession(offset) * axis;
    const double s = dot(offset, u), t = dot(offset, v), cell = shape->cell;
    const double slope_s = (shape->at(s + cell, t) - shape->at(s - cell, t)) / (2.0 * cell);
    const double slope_t = (shape->at(s, t + cell) - shape->at(s, t - cell)) / (2.0 * cell);
    return -normalized(pushed + dot(pushed, axis) * (slope_s * u + slope_t * v));
  }
};

/// Corrects the excess of candidate nodes for a worn tip. A sphere that moves along the axis of its tip meets
/// each node at the same place of the map, so the recessions of one search are looked up once.
class TipCorrection {
 public:
  /// @param raw excess of a sphere as new, of each candidate node, padded   @param worn receives the tip's
  void apply(const MeshCandidates& candidates, const Vec3& c, double R, const Tip& tip,
             std::span<const double> raw, std::span<double> worn);

  /// What was looked up and for what, for core/archive.h: a sphere that comes back to within round-off of
  /// where it was is not looked up again.
  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("recession", self.recession_)("revision", self.revision_)("gathering", self.gathering_);
    archive("s", self.s_)("t", self.t_)("u", self.u_);
  }
  void restore(const Tip& tip) noexcept { shape_ = tip.shape; }

 private:
  std::vector<double> recession_;  // at each node [m]
  const TipShape* shape_ = nullptr;
  std::uint64_t revision_ = 0, gathering_ = 0;
  double s_ = 0.0, t_ = 0.0;  // of the centre when last looked up [m]
  Vec3 u_;
};

}  // namespace abradem::contact
