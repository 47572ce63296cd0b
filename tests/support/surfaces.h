// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "abradem/contact/mesh_candidates.h"
#include "abradem/core/random.h"
#include "abradem/geometry/triangle_grid.h"
#include "abradem/geometry/triangle_mesh.h"

/// Meshes of known shape, for the tests of walls and wear.
namespace abradem::test {

using geometry::Index;
using geometry::Triangle;
using geometry::TriangleMesh;

/// Height of a surface over the plane [m].
using Height = std::function<double(double x, double y)>;

/// Rectangle [-length/2, length/2] x [-width/2, width/2] of near-square cells of size h, each cut in two by
/// an alternating diagonal; inner vertices shifted in the plane by up to `jitter` h, then lifted to `height`.
inline TriangleMesh jittered_plate(double length, double width, double h, double jitter,
                                   std::uint64_t seed = 1, const Height& height = {}) {
  const int nx = std::max(1, static_cast<int>(std::lround(length / h)));
  const int ny = std::max(1, static_cast<int>(std::lround(width / h)));
  const double dx = length / nx, dy = width / ny;
  core::RandomStream random(seed);
  TriangleMesh mesh;
  for (int i = 0; i <= nx; ++i)
    for (int j = 0; j <= ny; ++j) {
      Vec3 p{-0.5 * length + i * dx, -0.5 * width + j * dy, 0.0};
      const double sx = random.uniform(-jitter, jitter) * dx, sy = random.uniform(-jitter, jitter) * dy;
      if (i > 0 && i < nx) p.x += sx;
      if (j > 0 && j < ny) p.y += sy;
      if (height) p.z = height(p.x, p.y);
      mesh.vertices.push_back(p);
    }
  const auto id = [ny](int i, int j) { return i * (ny + 1) + j; };
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j) {
      const Index a = id(i, j), b = id(i + 1, j), c = id(i + 1, j + 1), d = id(i, j + 1);
      if ((i + j) % 2 == 0) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
      } else {
        mesh.triangles.push_back({a, b, d});
        mesh.triangles.push_back({b, c, d});
      }
    }
  return mesh;
}

/// Adds white noise of the given standard deviation to every height.
inline void roughen(TriangleMesh& mesh, double sd, std::uint64_t seed) {
  core::RandomStream random(seed, 7);
  for (Vec3& p : mesh.vertices) {
    const double u = std::max(random.uniform(), 1e-300), v = random.uniform();
    p.z += sd * std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::numbers::pi * v);
  }
}

/// Sphere of `radius` about the origin: an octahedron, each face split `levels` times into four.
inline TriangleMesh sphere_mesh(double radius, int levels) {
  TriangleMesh mesh;
  mesh.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<Index, Index>, Index> middle;
    const auto mid = [&](Index a, Index b) {
      const auto key = std::minmax(a, b);
      const auto [found, added] = middle.try_emplace(key, mesh.vertex_count());
      if (added)
        mesh.vertices.push_back(normalized(mesh.vertices[static_cast<std::size_t>(a)] +
                                           mesh.vertices[static_cast<std::size_t>(b)]));
      return found->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const Index ab = mid(a, b), bc = mid(b, c), ca = mid(c, a);
      for (const Triangle& t :
           {Triangle{a, ab, ca}, Triangle{ab, b, bc}, Triangle{ca, bc, c}, Triangle{ab, bc, ca}})
        finer.push_back(t);
    }
    mesh.triangles = std::move(finer);
  }
  for (Vec3& p : mesh.vertices) p *= radius;
  return mesh;
}

/// Closed box [-half, half]^3 with n x n cells on each face, normals outwards; vertices welded.
inline TriangleMesh box_mesh(double half, int n) {
  TriangleMesh mesh;
  std::map<std::array<int, 3>, Index> ids;
  const auto vertex = [&](const std::array<int, 3>& p) {
    const auto [found, added] = ids.try_emplace(p, mesh.vertex_count());
    if (added) mesh.vertices.push_back(Vec3{half * p[0] / n, half * p[1] / n, half * p[2] / n});
    return found->second;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {-1, 1})
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const auto corner = [&](int a, int b) {
            std::array<int, 3> p{};
            p[static_cast<std::size_t>(axis)] = side * n;
            p[static_cast<std::size_t>((axis + 1) % 3)] = 2 * (i + a) - n;
            p[static_cast<std::size_t>((axis + 2) % 3)] = 2 * (j + b) - n;
            return vertex(p);
          };
          const Index a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
          if (side > 0) {
            mesh.triangles.push_back({a, b, c});
            mesh.triangles.push_back({a, c, d});
          } else {
            mesh.triangles.push_back({a, c, b});
            mesh.triangles.push_back({a, d, c});
          }
        }
  return mesh;
}

/// A mesh with what contact needs of it, and the candidates of one sphere.
struct Scene {
  explicit Scene(TriangleMesh m) : mesh(std::move(m)), grid(mesh) {}

  contact::MeshCandidates& candidates_at(const Vec3& c, double reach, const Vec3& axis = {},
                                         const contact::CandidateSkin& skin = {}) {
    candidates.update({mesh, grid, 1, 0.0, 0.0}, c, axis, reach, skin);
    return candidates;
  }

  TriangleMesh mesh;
  geometry::TriangleGrid grid;
  contact::MeshCandidates candidates;
};

}  // namespace abradem::test
