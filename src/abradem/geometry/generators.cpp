// SPDX-License-Identifier: BSD-3-Clause
// docs/theory/meshes.md explains the method and states the quality reached.
#include "abradem/geometry/generators.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "abradem/core/error.h"
#include "abradem/geometry/planar_sampling.h"

namespace abradem::geometry {

namespace {

/// Rows of triangles around vertices number three items per triangle, and meshing needs about 150 bytes each.
constexpr double kMostTriangles = 1e8;
constexpr int kSmoothingPasses = 8;

std::size_t at(Index i) noexcept { return static_cast<std::size_t>(i); }

void require(bool holds, const char* what, double value, const char* rule) {
  if (!holds) throw InputError(fmt::format("cannot mesh: {} is {:g} m; {}", what, value, rule));
}

void require_size(double size, double widest, const char* across, double area) {
  require(std::isfinite(size) && size > 0.0, "the triangle size", size, "expected a positive length");
  if (size > widest * (1.0 + 1e-9))  // 24 mm - 20 mm is a little less than 4 mm
    throw InputError(
        fmt::format("cannot mesh: the triangle size {:g} m is larger than the {} ({:g} m); choose a "
                    "smaller size",
                    size, across, widest));
  const double triangles = area / (0.25 * std::numbers::sqrt3 * size * size);
  if (triangles > kMostTriangles)
    throw InputError(
        fmt::format("cannot mesh: triangles of {:g} m would be about {:.2g} in number; at most {:.0g} are "
                    "possible: choose a size of {:.2g} m or more",
                    size, triangles, kMostTriangles, size * std::sqrt(triangles / kMostTriangles)));
}

/// Meshes a region given in units of `size`, back in metres.
TriangleMesh mesh_region(const PlanarRegion& region, double size, std::uint64_t seed) {
  PlanarSample sample = sample_region(region, seed);
  const bool has_hole = region.inner > 0.0;
  const auto count = static_cast<Index>(sample.points.size());
  std::vector<char> inserted(sample.points.size(), 0);
  for (const Index i : sample.polygon) inserted[at(i)] = 1;
  inserted[at(sample.centre)] = 1;
  Delaunay triangulation(std::move(sample.points), sample.polygon, sample.centre);
  for (const Index i : insertion_order(count, seed))
    if (!inserted[at(i)]) triangulation.insert(i);
  if (has_hole) triangulation.erase_star(sample.centre);
  triangulation.sort_triangles();
  for (int pass = 0; pass < kSmoothingPasses; ++pass) triangulation.smooth(1.0, sample.is_free);
  triangulation.sort_triangles();
  if (!(triangulation.smallest_doubled_area() > 0.0))
    throw GeometryError(
        fmt::format("meshing failed with triangles of {:g} m and seed {}: a triangle has no area; "
                    "choose another size or seed",
                    size, seed));
  TriangleMesh mesh;
  mesh.triangles = triangulation.triangles();
  mesh.vertices.reserve(at(count));
  for (const Point2 p : triangulation.points()) mesh.vertices.push_back({p.x * size, p.y * size, 0.0});
  if (has_hole) mesh.vertices.pop_back();  // the auxiliary centre is the last point
  return mesh;
}

}  // namespace

TriangleMesh make_annulus(double inner, double outer, double size, std::uint64_t seed) {
  require(std::isfinite(inner) && inner > 0.0, "the inner radius", inner, "expected a positive length");
  require(std::isfinite(outer) && outer > 0.0, "the outer radius", outer, "expected a positive length");
  require(outer > inner, "the outer radius", outer, "expected more than the inner radius");
  require_size(size, outer - inner, "width of the ring", std::numbers::pi * (outer * outer - inner * inner));
  return mesh_region({.inner = inner / size, .outer = outer / size}, size, seed);
}

TriangleMesh make_disc(double radius, double size, std::uint64_t seed) {
  require(std::isfinite(radius) && radius > 0.0, "the radius", radius, "expected a positive length");
  require_size(size, radius, "radius of the disc", std::numbers::pi * radius * radius);
  return mesh_region({.outer = radius / size}, size, seed);
}

TriangleMesh make_plate(double length, double width, double size, std::uint64_t seed) {
  require(std::isfinite(length) && length > 0.0, "the length", length, "expected a positive length");
  require(std::isfinite(width) && width > 0.0, "the width", width, "expected a positive length");
  require_size(size, std::min(length, width), "shorter side of the plate", length * width);
  return mesh_region({.half_length = 0.5 * length / size, .half_width = 0.5 * width / size}, size, seed);
}

}  // namespace abradem::geometry
