// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/geometry/triangle_mesh.h"

#include <algorithm>
#include <limits>

namespace abradem::geometry {

namespace {
std::size_t at(Index i) noexcept { return static_cast<std::size_t>(i); }
}  // namespace

Rows triangles_of_vertices(const TriangleMesh& mesh) {
  Rows rows;
  rows.start.assign(mesh.vertices.size() + 1, 0);
  for (const Triangle& t : mesh.triangles)
    for (const Index v : t) ++rows.start[at(v) + 1];
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) rows.start[v + 1] += rows.start[v];
  rows.items.resize(3 * mesh.triangles.size());
  std::vector<Index> next(rows.start.begin(), rows.start.end() - 1);
  for (Index t = 0; t < mesh.triangle_count(); ++t)
    for (const Index v : mesh.triangles[at(t)]) rows.items[at(next[at(v)]++)] = t;
  return rows;
}

std::vector<Triangle> neighbours_of_triangles(const TriangleMesh& mesh, const Rows& stars) {
  std::vector<Triangle> neighbours(mesh.triangles.size(), Triangle{-1, -1, -1});
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    const Triangle& triangle = mesh.triangles[at(t)];
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = triangle[k], b = triangle[(k + 1) % 3];
      Index found = -1, count = 0;
      for (const Index other : stars[a]) {
        const Triangle& o = mesh.triangles[at(other)];
        if (other != t && std::ranges::find(o, b) != o.end()) found = other, ++count;
      }
      neighbours[at(t)][k] = count == 1 ? found : -1;
    }
  }
  return neighbours;
}

double total_area(const TriangleMesh& mesh) noexcept {
  double area = 0.0;
  for (Index t = 0; t < mesh.triangle_count(); ++t) area += norm(area_vector(mesh, t));
  return area;
}

double signed_volume(const TriangleMesh& mesh) noexcept {
  if (mesh.vertices.empty()) return 0.0;
  const Vec3 origin = mesh.vertices.front();  // near the surface: keeps round-off small far from the origin
  double six_volumes = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[at(t[0])] - origin;
    const Vec3 b = mesh.vertices[at(t[1])] - origin;
    const Vec3 c = mesh.vertices[at(t[2])] - origin;
    six_volumes += dot(a, cross(b, c));
  }
  return six_volumes / 6.0;
}

BoundingBox bounding_box(std::span<const Vec3> points) noexcept {
  constexpr double inf = std::numeric_limits<double>::infinity();
  BoundingBox box{{inf, inf, inf}, {-inf, -inf, -inf}};
  for (const Vec3& p : points) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
  }
  return box;
}

double mean_edge_length(const TriangleMesh& mesh) noexcept {
  double sum = 0.0;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      sum += norm(mesh.vertices[at(t[(k + 1) % 3])] - mesh.vertices[at(t[k])]);
  return mesh.triangles.empty() ? 0.0 : sum / (3.0 * static_cast<double>(mesh.triangles.size()));
}

}  // namespace abradem::geometry
