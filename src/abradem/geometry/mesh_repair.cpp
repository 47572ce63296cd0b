// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/geometry/mesh_repair.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "abradem/core/random.h"
#include "abradem/geometry/mesh_check.h"
#include "abradem/geometry/mesh_edges.h"

namespace abradem::geometry {

namespace {

std::size_t at(Index i) noexcept { return static_cast<std::size_t>(i); }

/// Chained hash table from cells of space to the vertices in them; different cells may share a chain.
class CellTable {
 public:
  explicit CellTable(std::size_t count) : heads_(std::bit_ceil(count + 16), -1), next_(count, -1) {}
  Index& head(std::uint64_t x, std::uint64_t y, std::uint64_t z) noexcept {
    return heads_[core::splitmix64(x ^ core::splitmix64(y ^ core::splitmix64(z))) & (heads_.size() - 1)];
  }
  Index& next(Index i) noexcept { return next_[at(i)]; }

 private:
  std::vector<Index> heads_, next_;
};

/// For each vertex the lowest one with the same coordinates.
std::vector<Index> equal_vertices(std::span<const Vec3> vertices) {
  CellTable table(vertices.size());
  std::vector<Index> same(vertices.size());
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x + 0.0); };  // -0 is 0
  for (Index i = 0; i < static_cast<Index>(vertices.size()); ++i) {
    const Vec3& p = vertices[at(i)];
    Index& head = table.head(bits(p.x), bits(p.y), bits(p.z));
    Index found = head;
    while (found >= 0 && !(vertices[at(found)] == p)) found = table.next(found);
    same[at(i)] = found >= 0 ? found : i;
    if (found < 0) table.next(i) = std::exchange(head, i);
  }
  return same;
}

/// For each vertex that `same` keeps, the lowest kept one within the tolerance; written into `same`.
void merge_near_vertices(std::span<const Vec3> vertices, double tolerance, std::vector<Index>& same) {
  const double cell = 2.0 * tolerance;
  CellTable table(vertices.size());
  const auto number = [&](double x) { return static_cast<std::int64_t>(std::floor(x / cell)); };
  const auto key = [](std::int64_t x) { return static_cast<std::uint64_t>(x); };
  for (Index i = 0; i < static_cast<Index>(vertices.size()); ++i) {
    if (same[at(i)] != i) continue;
    const Vec3& p = vertices[at(i)];
    Index found = -1;
    for (std::int64_t x = number(p.x - tolerance); x <= number(p.x + tolerance); ++x)
      for (std::int64_t y = number(p.y - tolerance); y <= number(p.y + tolerance); ++y)
        for (std::int64_t z = number(p.z - tolerance); z <= number(p.z + tolerance); ++z)
          for (Index j = table.head(key(x), key(y), key(z)); j >= 0; j = table.next(j))
            if (norm2(vertices[at(j)] - p) <= tolerance * tolerance && (found < 0 || j < found)) found = j;
    if (found >= 0) {
      same[at(i)] = found;
    } else {
      Index& head = table.head(key(number(p.x)), key(number(p.y)), key(number(p.z)));
      table.next(i) = std::exchange(head, i);
    }
  }
}

/// Removes the vertices for which keep is 0; every triangle must refer to kept ones only.
Index compact_vertices(TriangleMesh& mesh, const std::vector<char>& keep) {
  std::vector<Index> new_number(mesh.vertices.size(), -1);
  Index kept = 0;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (!keep[i]) continue;
    mesh.vertices[at(kept)] = mesh.vertices[i];
    new_number[i] = kept++;
  }
  const Index removed = mesh.vertex_count() - kept;
  mesh.vertices.resize(at(kept));
  for (Triangle& t : mesh.triangles)
    for (Index& v : t) v = new_number[at(v)];
  return removed;
}

bool degenerate(const TriangleMesh& mesh, const Triangle& t) noexcept {
  return triangle_quality(mesh.vertices[at(t[0])], mesh.vertices[at(t[1])], mesh.vertices[at(t[2])]) <
         kDegenerateQuality;
}

/// Removes later triangles on the same three vertices as an earlier one.
Index drop_duplicate_triangles(TriangleMesh& mesh) {
  CellTable table(mesh.triangles.size());
  const auto sorted = [](Triangle t) { return std::ranges::sort(t), t; };
  const auto key = [](Index i) { return static_cast<std::uint64_t>(i); };
  std::vector<Triangle> kept;
  kept.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    const Triangle s = sorted(t);
    Index& head = table.head(key(s[0]), key(s[1]), key(s[2]));
    Index found = head;
    while (found >= 0 && sorted(kept[at(found)]) != s) found = table.next(found);
    if (found >= 0) continue;
    const auto number = static_cast<Index>(kept.size());
    table.next(number) = std::exchange(head, number);
    kept.push_back(t);
  }
  const auto removed = static_cast<Index>(mesh.triangles.size() - kept.size());
  mesh.triangles = std::move(kept);
  return removed;
}

/// For each triangle the neighbours across manifold edges: their number and whether they agree.
struct Agreement {
  Index triangle;
  bool same_orientation;
};
std::vector<std::vector<Agreement>> manifold_neighbours(const TriangleMesh& mesh) {
  std::vector<std::vector<Agreement>> neighbours(mesh.triangles.size());
  const std::vector<Side> sides = sorted_sides(mesh);
  for (std::size_t i = 0; i < sides.size();) {
    const auto edge = sides_of_edge(sides, i);
    i += edge.size();
    if (edge.size() != 2) continue;
    const bool same = edge[0].forward != edge[1].forward;
    neighbours[at(edge[0].triangle)].push_back({edge[1].triangle, same});
    neighbours[at(edge[1].triangle)].push_back({edge[0].triangle, same});
  }
  return neighbours;
}

/// Flips the minority of each component; a surface with one side only (Möbius) keeps its contradictions.
Index orient_consistently(TriangleMesh& mesh) {
  const auto neighbours = manifold_neighbours(mesh);
  std::vector<signed char> turned(mesh.triangles.size(), -1);  // against the first of its component
  std::vector<Index> component;
  Index flipped = 0;
  for (Index first = 0; first < mesh.triangle_count(); ++first) {
    if (turned[at(first)] >= 0) continue;
    turned[at(first)] = 0;
    component.assign(1, first);
    Index turned_count = 0;
    for (std::size_t i = 0; i < component.size(); ++i) {
      const Index t = component[i];
      for (const Agreement& n : neighbours[at(t)]) {
        if (turned[at(n.triangle)] >= 0) continue;
        turned[at(n.triangle)] =
            static_cast<signed char>(n.same_orientation ? turned[at(t)] : 1 - turned[at(t)]);
        turned_count += turned[at(n.triangle)];
        component.push_back(n.triangle);
      }
    }
    const bool flip_the_turned = 2 * static_cast<std::size_t>(turned_count) <= component.size();
    for (const Index t : component) {
      if ((turned[at(t)] == 1) != flip_the_turned) continue;
      std::swap(mesh.triangles[at(t)][1], mesh.triangles[at(t)][2]);
      ++flipped;
    }
  }
  return flipped;
}

bool is_closed(const TriangleMesh& mesh) {
  const std::vector<Side> sides = sorted_sides(mesh);
  for (std::size_t i = 0; i < sides.size(); i += 2) {
    const auto edge = sides_of_edge(sides, i);
    if (edge.size() != 2 || edge[0].forward == edge[1].forward) return false;
  }
  return !sides.empty();
}

}  // namespace

Index weld_vertices(TriangleMesh& mesh, double relative_tolerance) {
  std::vector<Index> same = equal_vertices(mesh.vertices);
  const double tolerance = relative_tolerance * mean_edge_length(mesh);
  double largest = 0.0;
  for (const Vec3& v : mesh.vertices)
    largest = std::max({largest, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  // Below the spacing of doubles only equal coordinates are near.
  if (tolerance > 1e-16 * largest) merge_near_vertices(mesh.vertices, tolerance, same);
  std::vector<char> keep(mesh.vertices.size(), 0);
  for (std::size_t i = 0; i < same.size(); ++i) keep[i] = same[i] == static_cast<Index>(i);
  for (Triangle& t : mesh.triangles)
    for (Index& v : t)
      while (same[at(v)] != v) v = same[at(v)];  // equal to one that is near another
  return compact_vertices(mesh, keep);
}

Index drop_unused_vertices(TriangleMesh& mesh) {
  std::vector<char> used(mesh.vertices.size(), 0);
  for (const Triangle& t : mesh.triangles)
    for (const Index v : t) used[at(v)] = 1;
  return compact_vertices(mesh, used);
}

RepairRecord repair_mesh(TriangleMesh& mesh) {
  RepairRecord record;
  record.welded_vertices = weld_vertices(mesh);
  record.degenerate_triangles = static_cast<Index>(
      std::erase_if(mesh.triangles, [&](const Triangle& t) { return degenerate(mesh, t); }));
  record.duplicate_triangles = drop_duplicate_triangles(mesh);
  record.flipped_triangles = orient_consistently(mesh);
  if (is_closed(mesh) && signed_volume(mesh) < 0.0) {
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
    record.turned_outward = true;
  }
  record.unused_vertices = drop_unused_vertices(mesh);
  return record;
}

}  // namespace abradem::geometry
