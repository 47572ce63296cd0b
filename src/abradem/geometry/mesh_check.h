// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "abradem/geometry/triangle_mesh.h"

namespace abradem::geometry {

/// q = 4 sqrt(3) A / (sum of squared edges): 1 for an equilateral triangle, 0 without area. [-]
[[nodiscard]] double triangle_quality(const Vec3& a, const Vec3& b, const Vec3& c) noexcept;

inline constexpr double kDegenerateQuality = 1e-9;  ///< below: no usable normal
inline constexpr double kSliverQuality =
    0.05;  ///< below: usable, but its height is a small part of its edges

/// What a mesh is like. Counts of defects are 0 in a sound mesh; open edges are the border of a sheet.
struct MeshReport {
  Index triangles = 0, vertices = 0;
  double edge_min = 0.0, edge_mean = 0.0, edge_max = 0.0;  ///< [m]
  double quality_min = 0.0, quality_mean = 0.0;  ///< triangle_quality; degenerate ones left out of the mean
  Index duplicate_vertices = 0;                  ///< that coincide with another within 1e-6 of the mean edge
  Index unused_vertices = 0;                     ///< in no triangle
  Index duplicate_triangles = 0;                 ///< with the same three vertices as another
  Index degenerate_triangles = 0;                ///< quality below kDegenerateQuality
  Index slivers = 0;                             ///< quality below kSliverQuality, not degenerate
  Index open_edges = 0;                          ///< with one triangle
  Index non_manifold_edges = 0;                  ///< with more than two triangles
  Index inconsistent_edges = 0;                  ///< whose two triangles have opposite orientation
  Index border_loops = 0;                        ///< connected rings of open edges
  Index small_holes = 0;  ///< border loops of at most eight edges, small against the surface around
                          ///< them (perimeter^2 < 0.3 area): probably missing triangles
  Vec3 small_hole_place;  ///< centre of the first small hole [m]
  Index components = 0;   ///< sheets or bodies, connected through edges
  BoundingBox box;        ///< of the vertices in use [m]
  double area = 0.0;      ///< [m^2]
  bool closed = false;    ///< no open, non-manifold or inconsistent edge
  double volume = 0.0;    ///< enclosed, signed [m^3]; 0 unless closed
  [[nodiscard]] bool inward() const noexcept { return closed && volume < 0.0; }
  [[nodiscard]] double extent() const noexcept { return norm(box.high - box.low); }  ///< diagonal [m]
};

/// Examines a mesh. O(n log n). Indices must be in range and coordinates finite (the readers see to it).
[[nodiscard]] MeshReport check_mesh(const TriangleMesh& mesh);

/// What one should know before using a mesh as a wall; complete sentences.
struct MeshVerdict {
  std::vector<std::string> errors;    ///< the mesh cannot be used
  std::vector<std::string> warnings;  ///< it can, but look again
  [[nodiscard]] bool usable() const noexcept { return errors.empty(); }
};

/// Judges a report. Errors: no triangles, degenerate or duplicate ones, edges with three triangles or with
/// opposite orientations, small holes, a closed mesh inside out (most of which `repair_mesh` mends: judge
/// what it leaves). With the radius of the particle that is to touch the mesh [m], a mesh smaller than the
/// particle or more than 10^4 times larger is an error: it was probably read in the wrong unit. Without it,
/// less than 0.1 mm or more than 10 m is a warning.
[[nodiscard]] MeshVerdict judge_mesh(const MeshReport& report, std::optional<double> particle_radius = {});

}  // namespace abradem::geometry
