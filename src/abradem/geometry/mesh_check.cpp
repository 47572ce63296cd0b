// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/geometry/mesh_check.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "abradem/geometry/mesh_edges.h"
#include "abradem/geometry/mesh_repair.h"

namespace abradem::geometry {

namespace {

std::size_t at(Index i) noexcept { return static_cast<std::size_t>(i); }

/// Disjoint sets with path halving; the lowest member stands for its set.
class Groups {
 public:
  explicit Groups(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  Index find(Index i) noexcept {
    while (parent_[at(i)] != i) i = parent_[at(i)] = parent_[at(parent_[at(i)])];
    return i;
  }
  void join(Index a, Index b) noexcept {
    a = find(a), b = find(b);
    parent_[at(std::max(a, b))] = std::min(a, b);
  }

 private:
  std::vector<Index> parent_;
};

void measure_triangles(const TriangleMesh& mesh, MeshReport& report) {
  double edge_sum = 0.0, quality_sum = 0.0, edge_min = INFINITY, quality_min = INFINITY;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 &a = mesh.vertices[at(t[0])], &b = mesh.vertices[at(t[1])], &c = mesh.vertices[at(t[2])];
    for (const double edge : {norm(b - a), norm(c - b), norm(a - c)}) {
      edge_sum += edge;
      edge_min = std::min(edge_min, edge);
      report.edge_max = std::max(report.edge_max, edge);
    }
    const double quality = triangle_quality(a, b, c);
    quality_min = std::min(quality_min, quality);
    if (quality < kDegenerateQuality) {
      ++report.degenerate_triangles;
      continue;
    }
    quality_sum += quality;
    report.slivers += quality < kSliverQuality;
  }
  if (mesh.triangles.empty()) return;
  const Index good = report.triangles - report.degenerate_triangles;
  report.edge_min = edge_min;
  report.edge_mean = edge_sum / (3.0 * report.triangles);
  report.quality_min = quality_min;
  report.quality_mean = good > 0 ? quality_sum / good : 0.0;
}

void count_duplicates(const TriangleMesh& mesh, MeshReport& report) {
  TriangleMesh copy = mesh;
  report.duplicate_vertices = weld_vertices(copy);
  std::vector<Triangle> sorted = mesh.triangles;
  for (Triangle& t : sorted) std::ranges::sort(t);
  std::ranges::sort(sorted);
  for (std::size_t i = 1; i < sorted.size(); ++i) report.duplicate_triangles += sorted[i] == sorted[i - 1];
}

struct Loop {
  Index edges = 0, triangle = 0;
  double perimeter = 0.0;
  Vec3 sum;
};

/// Edges of all kinds, components, border loops.
void measure_edges(const TriangleMesh& mesh, MeshReport& report) {
  const std::vector<Side> sides = sorted_sides(mesh);
  Groups components(mesh.triangles.size()), borders(mesh.vertices.size());
  std::vector<Side> open;
  for (std::size_t i = 0; i < sides.size();) {
    const auto edge = sides_of_edge(sides, i);
    i += edge.size();
    for (const Side& s : edge) components.join(edge[0].triangle, s.triangle);
    report.non_manifold_edges += edge.size() > 2;
    report.inconsistent_edges += edge.size() == 2 && edge[0].forward == edge[1].forward;
    if (edge.size() != 1) continue;
    open.push_back(edge[0]);
    borders.join(edge[0].low, edge[0].high);
  }
  report.open_edges = static_cast<Index>(open.size());
  report.closed = report.triangles > 0 && open.empty() && report.non_manifold_edges == 0 &&
                  report.inconsistent_edges == 0;

  std::vector<double> component_area(mesh.triangles.size(), 0.0);
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    report.components += components.find(t) == t;
    component_area[at(components.find(t))] += norm(area_vector(mesh, t));
  }
  std::vector<Loop> loops(mesh.vertices.size());
  for (const Side& s : open) {
    Loop& loop = loops[at(borders.find(s.low))];
    const Vec3 &a = mesh.vertices[at(s.low)], &b = mesh.vertices[at(s.high)];
    ++loop.edges;
    loop.triangle = s.triangle;
    loop.perimeter += norm(b - a);
    loop.sum += 0.5 * (a + b);
  }
  for (const Loop& loop : loops) {
    report.border_loops += loop.edges > 0;
    if (loop.edges == 0 || loop.edges > 8) continue;
    if (loop.perimeter * loop.perimeter > 0.3 * component_area[at(components.find(loop.triangle))]) continue;
    if (report.small_holes++ == 0) report.small_hole_place = loop.sum / loop.edges;
  }
}

std::string in_mm(double metres) { return fmt::format("{:.4g} mm", 1e3 * metres); }

/// "1 triangle has", "3 triangles have".
std::string counted(Index n, const char* one, const char* many) {
  return n == 1 ? fmt::format("1 {}", one) : fmt::format("{} {}", n, many);
}

void judge_scale(const MeshReport& report, std::optional<double> particle_radius, MeshVerdict& verdict) {
  const double extent = report.extent();
  if (particle_radius) {
    const double ratio = extent / *particle_radius;
    if (ratio < 1.0 || ratio > 1e4)
      verdict.errors.push_back(
          fmt::format("The mesh measures {} across, {:.2g} times the radius of the particle ({}): it was "
                      "probably read in the wrong "
                      "unit. Is the file in {}? State its unit.",
                      in_mm(extent), ratio, in_mm(*particle_radius), ratio < 1.0 ? "metres" : "millimetres"));
  } else if (extent < 1e-4 || extent > 10.0) {
    verdict.warnings.push_back(fmt::format("The mesh measures {} across: is the file in {}? State its unit.",
                                           in_mm(extent), extent < 1e-4 ? "metres" : "millimetres"));
  }
}

}  // namespace

double triangle_quality(const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
  const double squares = norm2(b - a) + norm2(c - b) + norm2(a - c);
  return squares > 0.0 ? 2.0 * std::numbers::sqrt3 * norm(cross(b - a, c - a)) / squares : 0.0;
}

MeshReport check_mesh(const TriangleMesh& mesh) {
  MeshReport report;
  report.triangles = mesh.triangle_count();
  report.vertices = mesh.vertex_count();
  measure_triangles(mesh, report);
  count_duplicates(mesh, report);
  measure_edges(mesh, report);
  TriangleMesh used = mesh;
  report.unused_vertices = drop_unused_vertices(used);
  if (!used.vertices.empty()) report.box = bounding_box(used.vertices);
  report.area = total_area(mesh);
  if (report.closed) report.volume = signed_volume(mesh);
  return report;
}

MeshVerdict judge_mesh(const MeshReport& report, std::optional<double> particle_radius) {
  MeshVerdict verdict;
  const auto error = [&](Index count, const char* one, const char* many, const char* advice) {
    if (count > 0) verdict.errors.push_back(counted(count, one, many) + advice);
  };
  const auto warning = [&](Index count, const char* one, const char* many, const char* advice) {
    if (count > 0) verdict.warnings.push_back(counted(count, one, many) + advice);
  };
  if (report.triangles == 0) {
    verdict.errors.push_back("The mesh has no triangles.");
    return verdict;
  }
  error(report.degenerate_triangles, "triangle has", "triangles have", " no area.");
  error(report.duplicate_triangles, "triangle is", "triangles are", " there twice.");
  error(report.non_manifold_edges, "edge has", "edges have",
        " more than two triangles: separate the parts that meet there.");
  error(report.inconsistent_edges, "edge lies", "edges lie",
        " between triangles that face opposite ways: orient them alike.");
  if (report.inward()) verdict.errors.push_back("The closed mesh is inside out: turn its normals outward.");
  if (report.small_holes > 0) {
    const Vec3 p = report.small_hole_place;
    verdict.errors.push_back(fmt::format(
        "{} (the first near x = {}, y = {}, z = {}): triangles are probably missing; close it where the mesh "
        "was made.",
        counted(report.small_holes, "small hole", "small holes"), in_mm(p.x), in_mm(p.y), in_mm(p.z)));
  }
  warning(report.slivers, "triangle is", "triangles are",
          " very thin (quality below 0.05): wear will be uneven there.");
  warning(report.duplicate_vertices, "vertex coincides", "vertices coincide", " with another.");
  warning(report.components - 1, "further part is", "further parts are", " not connected to the first.");
  judge_scale(report, particle_radius, verdict);
  return verdict;
}

}  // namespace abradem::geometry
