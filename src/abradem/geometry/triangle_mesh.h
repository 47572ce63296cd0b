// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "abradem/core/vec3.h"

namespace abradem::geometry {

using Index = std::int32_t;
using Triangle = std::array<Index, 3>;  ///< vertex indices, counter-clockwise seen from outside the solid

/// A triangulated surface [m]. Normals (right-hand rule) point out of the solid. Plain data: what depends on
/// the positions is computed by the functions below or kept by whoever moves the vertices.
struct TriangleMesh {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;

  [[nodiscard]] Index vertex_count() const noexcept { return static_cast<Index>(vertices.size()); }
  [[nodiscard]] Index triangle_count() const noexcept { return static_cast<Index>(triangles.size()); }

  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("vertices", self.vertices)("triangles", self.triangles);
  }
};

/// Area vector of one triangle [m^2]: half the cross product of its edges; along the outward normal.
[[nodiscard]] inline Vec3 area_vector(const TriangleMesh& mesh, Index t) noexcept {
  const Triangle& v = mesh.triangles[static_cast<std::size_t>(t)];
  const Vec3& a = mesh.vertices[static_cast<std::size_t>(v[0])];
  const Vec3& b = mesh.vertices[static_cast<std::size_t>(v[1])];
  const Vec3& c = mesh.vertices[static_cast<std::size_t>(v[2])];
  return 0.5 * cross(b - a, c - a);
}

/// Compressed rows: row r holds items[start[r]] … items[start[r + 1] - 1].
struct Rows {
  std::vector<Index> start;
  std::vector<Index> items;
  [[nodiscard]] std::span<const Index> operator[](Index row) const noexcept {
    const auto begin = static_cast<std::size_t>(start[static_cast<std::size_t>(row)]);
    const auto end = static_cast<std::size_t>(start[static_cast<std::size_t>(row) + 1]);
    return {items.data() + begin, end - begin};
  }
};

/// Triangles around each vertex, ascending. O(n).
[[nodiscard]] Rows triangles_of_vertices(const TriangleMesh& mesh);

/// For each triangle, the neighbour across edge k (from its vertex k to vertex k+1), or -1 where the edge is
/// open or shared by more than two triangles. O(n).
[[nodiscard]] std::vector<Triangle> neighbours_of_triangles(const TriangleMesh& mesh, const Rows& stars);

/// Total area [m^2].
[[nodiscard]] double total_area(const TriangleMesh& mesh) noexcept;

/// Signed volume enclosed [m^3] (divergence theorem); meaningful for closed surfaces, positive when normals
/// point outwards.
[[nodiscard]] double signed_volume(const TriangleMesh& mesh) noexcept;

struct BoundingBox {
  Vec3 low, high;
};
[[nodiscard]] BoundingBox bounding_box(std::span<const Vec3> points) noexcept;

/// Mean edge length [m]; each triangle counts its three edges.
[[nodiscard]] double mean_edge_length(const TriangleMesh& mesh) noexcept;

}  // namespace abradem::geometry
