// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/geometry/mesh_edges.h"

#include <algorithm>
#include <tuple>

namespace abradem::geometry {

std::vector<Side> sorted_sides(const TriangleMesh& mesh) {
  // Bucketed by the lower vertex, then each short bucket is sorted.
  std::vector<std::size_t> start(mesh.vertices.size() + 1, 0);
  const auto for_each_side = [&](auto&& use) {
    for (Index t = 0; t < mesh.triangle_count(); ++t) {
      const Triangle& v = mesh.triangles[static_cast<std::size_t>(t)];
      for (std::size_t k = 0; k < 3; ++k) {
        const Index a = v[k], b = v[(k + 1) % 3];
        if (a != b) use(Side{std::min(a, b), std::max(a, b), t, a < b});
      }
    }
  };
  for_each_side([&](const Side& s) { ++start[static_cast<std::size_t>(s.low) + 1]; });
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) start[v + 1] += start[v];
  std::vector<Side> sides(start.back());
  std::vector<std::size_t> next(start.begin(), start.end() - 1);
  for_each_side([&](const Side& s) { sides[next[static_cast<std::size_t>(s.low)]++] = s; });
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    std::sort(sides.begin() + static_cast<std::ptrdiff_t>(start[v]),
              sides.begin() + static_cast<std::ptrdiff_t>(start[v + 1]), [](const Side& a, const Side& b) {
                return std::tie(a.high, a.triangle, a.forward) < std::tie(b.high, b.triangle, b.forward);
              });
  return sides;
}

std::span<const Side> sides_of_edge(std::span<const Side> sides, std::size_t begin) noexcept {
  std::size_t end = begin;
  while (end < sides.size() && sides[end].low == sides[begin].low && sides[end].high == sides[begin].high)
    ++end;
  return sides.subspan(begin, end - begin);
}

}  // namespace abradem::geometry
