// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abradem/geometry/triangle_mesh.h"

namespace abradem::geometry::zoo {

/// Axis-parallel box from the origin, 12 triangles, normals outward: volume a b c, area 2 (ab + bc + ca).
inline TriangleMesh box(double a, double b, double c) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.push_back({(i & 1) ? a : 0.0, (i & 2) ? b : 0.0, (i & 4) ? c : 0.0});
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

/// The same triangles, each with its own three vertices.
inline TriangleMesh unshared(const TriangleMesh& mesh) {
  TriangleMesh soup;
  for (const Triangle& t : mesh.triangles) {
    const Index first = soup.vertex_count();
    for (const Index v : t) soup.vertices.push_back(mesh.vertices[static_cast<std::size_t>(v)]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

}  // namespace abradem::geometry::zoo
