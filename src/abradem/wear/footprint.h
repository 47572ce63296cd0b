// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "abradem/contact/mesh_candidates.h"
#include "abradem/contact/tip_shape.h"

namespace abradem::wear {

/// How the wear of one contact falls on the surface under it.
///
/// Where the surface is fine against the footprint: the load of each node, pressure times its share of area
/// (`at_node`). The depth worn is then the pressure at the node itself, with no smearing over its neighbours.
/// Elsewhere: for each of the first `count` candidate triangles the moments of the pressure with the shape
/// functions of its three vertices (`at0` … `at2`), integrated over parts of the triangle.
struct FootprintShares {
  bool nodal = false;
  std::span<const double> at_node;  ///< of the first candidate nodes; the others have no load
  std::size_t count = 0;
  std::span<const double> at0, at1, at2;  ///< per candidate triangle, or per triangle given
  double total = 0.0;                     ///< sum of all
};

/// The overlapped surface of one patch as the footprints see it; per candidate
/// triangle unless said.
struct OverlapField {
  std::span<const double> excess;  ///< 1 - |x - c|^2 / R^2 of each candidate node, padded
  double R = 0.0;                  ///< [m]
  double deepest = 0.0;            ///< largest overlap g in the patch [m]
  /// A worn tip: `excess` is its own, `raw` that of the sphere as new (empty: it is as new).
  contact::Tip tip{};
  std::span<const double> raw{};
  Vec3 c{};  ///< the sphere's centre [m]
};

/// The ball of a sphere as new over a surface.
struct Ball {
  Vec3 c;                ///< its centre [m]
  double R = 0.0;        ///< [m]
  double deepest = 0.0;  ///< largest overlap g under it [m]
};

/// Distributes wear by a pressure that depends on the local overlap g alone. docs/theory/wear.md#footprint
class FootprintIntegrator {
 public:
  /// Hertz: weight sqrt(max(0, d_e - 2 (g_max - g))), the pressure of an elastic half-space pressed by the
  /// approach d_e; only differences of g enter, so the height of the ball does not matter.
  /// @param by_elements the rule that moves the surface wants the loads of elements, not of nodes
  /// @param mask triangles of the patch (0: not); empty: all   @return valid until the next call
  const FootprintShares& hertz(const contact::MeshCandidates& candidates, const OverlapField& field,
                               double d_e, bool by_elements, std::span<const char> mask = {});
  /// Overlap: weight max(0, g), a bed of springs.
  const FootprintShares& overlap(const contact::MeshCandidates& candidates, const OverlapField& field,
                                 bool by_elements, std::span<const char> mask = {});

  /// The same on triangles by themselves.
  const FootprintShares& hertz(std::span<const contact::CandidateTriangle> triangles, const Ball& ball,
                               double d_e);
  const FootprintShares& overlap(std::span<const contact::CandidateTriangle> triangles, const Ball& ball);

 private:
  template <typename Weight>
  const FootprintShares& integrate(std::span<const contact::CandidateTriangle> triangles, const Ball& ball,
                                   double cut, const Weight& weight);
  template <typename Weight>
  const FootprintShares& integrate(const contact::MeshCandidates& candidates, const OverlapField& field,
                                   double cut, double reach, bool by_elements, std::span<const char> mask,
                                   const Weight& weight);
  [[nodiscard]] static double bound(const contact::MeshCandidates& candidates, const OverlapField& field,
                                    std::size_t t) noexcept;
  const FootprintShares& share_out(std::size_t count) noexcept;
  template <typename Weight>
  void subdivide(const contact::MeshCandidates& candidates, const OverlapField& field, std::size_t t,
                 const Weight& weight);
  void choose_points(int parts);

  /// Centroids of parts^2 equal parts of any triangle: barycentric coordinates of vertices 1 and 2, and the
  /// share of the triangle's area; padded with points of no share.
  struct Points {
    int parts = 0;
    std::vector<double> b1, b2, share, e, w;
  } points_;
  std::vector<contact::CandidateTriangle> under_;
  FootprintShares shares_;
  std::vector<double> at_node_, at0_, at1_, at2_;
};

}  // namespace abradem::wear
