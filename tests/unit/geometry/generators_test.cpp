// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/geometry/generators.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "abradem/core/error.h"

namespace abradem::geometry {
namespace {

constexpr double kInner = 20e-3, kOuter = 24e-3;

struct Measured {
  double quality_min = 1.0, quality_mean = 0.0, edge_mean = 0.0, normal_z_min = 1.0;
  long euler = 0;
  int border_loops = 0;
  int edges_of_three = 0;
  bool consistent = true;    ///< each inner edge is run once each way
  std::vector<int> valence;  ///< triangles around each vertex
  std::vector<char> on_border;
};

Measured measure(const TriangleMesh& mesh) {
  Measured m;
  std::map<std::pair<Index, Index>, int> half_edges;
  m.valence.assign(mesh.vertices.size(), 0);
  m.on_border.assign(mesh.vertices.size(), 0);
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    const Triangle& v = mesh.triangles[static_cast<std::size_t>(t)];
    double squares = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = v[k], b = v[(k + 1) % 3];
      const Vec3 edge =
          mesh.vertices[static_cast<std::size_t>(b)] - mesh.vertices[static_cast<std::size_t>(a)];
      squares += norm2(edge);
      m.edge_mean += norm(edge);
      if (++half_edges[{a, b}] > 1) m.consistent = false;
      ++m.valence[static_cast<std::size_t>(a)];
    }
    const Vec3 area = area_vector(mesh, t);
    m.normal_z_min = std::min(m.normal_z_min, normalized(area).z);
    const double q = 4.0 * std::numbers::sqrt3 * area.z / squares;
    m.quality_min = std::min(m.quality_min, q);
    m.quality_mean += q;
  }
  m.quality_mean /= mesh.triangle_count();
  m.edge_mean /= 3.0 * mesh.triangle_count();
  std::map<Index, Index> border;  // from each border vertex to the next
  long edges = 0;
  for (const auto& [edge, count] : half_edges) {
    const bool open = !half_edges.contains({edge.second, edge.first});
    edges += open || edge.first < edge.second;
    if (!open) continue;
    if (!border.emplace(edge.first, edge.second).second) ++m.edges_of_three;
    m.on_border[static_cast<std::size_t>(edge.first)] = 1;
  }
  while (!border.empty()) {
    ++m.border_loops;
    for (auto it = border.begin(); it != border.end();) {
      const Index next = it->second;
      border.erase(it);
      it = border.find(next);
    }
  }
  m.euler = mesh.vertex_count() - edges + mesh.triangle_count();
  return m;
}

/// FNV-1a over all bits of the mesh.
std::uint64_t fingerprint(const TriangleMesh& mesh) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  const auto mix = [&](std::uint64_t word) { hash = (hash ^ word) * 0x100000001b3ULL; };
  for (const Vec3& v : mesh.vertices)
    for (const double x : {v.x, v.y, v.z}) mix(std::bit_cast<std::uint64_t>(x));
  for (const Triangle& t : mesh.triangles)
    for (const Index i : t) mix(static_cast<std::uint64_t>(i));
  return hash;
}

void expect_flat_and_sound(const TriangleMesh& mesh, const Measured& m, long euler, int loops) {
  EXPECT_TRUE(std::ranges::all_of(mesh.vertices,
                                  [](const Vec3& v) { return std::bit_cast<std::uint64_t>(v.z) == 0; }));
  EXPECT_EQ(m.normal_z_min, 1.0);
  EXPECT_TRUE(m.consistent);
  EXPECT_EQ(m.edges_of_three, 0);
  EXPECT_EQ(m.euler, euler);
  EXPECT_EQ(m.border_loops, loops);
  EXPECT_TRUE(std::ranges::all_of(m.valence, [](int n) { return n > 0; })) << "a vertex without triangles";
}

TEST(Annulus, IsARingOfGoodTrianglesForEverySizeAndSeed) {
  for (const double size : {0.2e-3, 0.3e-3, 0.5e-3, 0.7e-3, 1e-3})
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      SCOPED_TRACE(testing::Message() << "size " << size << " seed " << seed);
      const TriangleMesh mesh = make_annulus(kInner, kOuter, size, seed);
      const Measured m = measure(mesh);
      expect_flat_and_sound(mesh, m, 0, 2);
      EXPECT_GE(m.quality_min, 0.55);
      EXPECT_GE(m.quality_mean, size < 0.6e-3 ? 0.97 : 0.95);
      EXPECT_NEAR(m.edge_mean / size, 1.0, 0.05);
    }
}

TEST(Annulus, IsGoodAtATwentiethOfAMillimetre) {
  const TriangleMesh mesh = make_annulus(23e-3, kOuter, 0.05e-3, 1);
  const Measured m = measure(mesh);
  expect_flat_and_sound(mesh, m, 0, 2);
  EXPECT_GE(m.quality_min, 0.55);
  EXPECT_GE(m.quality_mean, 0.98);
  EXPECT_NEAR(m.edge_mean / 0.05e-3, 1.0, 0.02);
}

TEST(Annulus, BorderNodesLieOnTheCirclesAndTheOthersBetween) {
  const TriangleMesh mesh = make_annulus(kInner, kOuter, 0.4e-3, 7);
  const Measured m = measure(mesh);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const double r = norm(mesh.vertices[v]);
    if (m.on_border[v])
      EXPECT_LT(std::min(std::abs(r / kInner - 1.0), std::abs(r / kOuter - 1.0)), 4e-16);
    else
      EXPECT_TRUE(r > kInner + 0.1e-3 && r < kOuter - 0.1e-3) << r;
  }
}

TEST(Annulus, AreaConvergesWithTheSquareOfTheSize) {
  const double exact = std::numbers::pi * (kOuter * kOuter - kInner * kInner);
  // A polygon of n sides inscribed in a circle lacks 2 pi^2 / (3 n^2) of its area; with n = 2 pi r / h both
  // circles lack pi h^2 / 6, so the ring's lack cancels and only rounding of n and order h^4 are left.
  for (const double size : {0.8e-3, 0.4e-3, 0.2e-3})
    EXPECT_NEAR(total_area(make_annulus(kInner, kOuter, size, 1)), exact, 0.02 * size * size);
  const double disc = std::numbers::pi * kInner * kInner;
  for (const double size : {2e-3, 1e-3, 0.5e-3})
    EXPECT_NEAR((disc - total_area(make_disc(kInner, size, 1))) / (std::numbers::pi * size * size / 6.0), 1.0,
                0.03);
}

TEST(Annulus, MostInnerNodesHaveFiveToSevenTriangles) {
  const TriangleMesh mesh = make_annulus(kInner, kOuter, 0.3e-3, 3);
  const Measured m = measure(mesh);
  double inner = 0, ordinary = 0, six = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (m.on_border[v]) continue;
    ++inner;
    ordinary += m.valence[v] >= 5 && m.valence[v] <= 7;
    six += m.valence[v] == 6;
  }
  EXPECT_GT(ordinary / inner, 0.99);
  EXPECT_LT(six / inner, 0.95) << "a lattice, not an unstructured mesh";
}

TEST(Annulus, FavoursNoDirectionAlongTheTrack) {
  // Edges measured against the track's tangent, folded by the six-fold symmetry of a lattice: the mean of
  // exp(6 i angle) is 1 for rows along the track; for G independent grains it is about 1/sqrt(G). The band
  // holds about 70 grains here.
  const TriangleMesh mesh = make_annulus(kInner, kOuter, 0.15e-3, 1);
  double c = 0.0, s = 0.0, n = 0.0;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 a = mesh.vertices[static_cast<std::size_t>(t[k])];
      const Vec3 b = mesh.vertices[static_cast<std::size_t>(t[(k + 1) % 3])];
      const Vec3 middle = 0.5 * (a + b), edge = b - a;
      if (std::abs(norm(middle) - 22e-3) > 0.6e-3) continue;
      const double angle = 6.0 * (std::atan2(edge.y, edge.x) - std::atan2(middle.y, middle.x));
      c += std::cos(angle), s += std::sin(angle), n += 1.0;
    }
  EXPECT_GT(n, 1e4);
  EXPECT_LT(std::hypot(c, s) / n, 2.5 / std::sqrt(70.0));
}

TEST(Generators, SameSeedSameBitsOtherSeedOtherMesh) {
  // The value pins the bits across compilers, optimisation levels and machines.
  EXPECT_EQ(fingerprint(make_annulus(kInner, kOuter, 0.5e-3, 1)), 0xe59bbd9ff046a8a7ULL);
  EXPECT_EQ(fingerprint(make_annulus(kInner, kOuter, 0.5e-3, 9)),
            fingerprint(make_annulus(kInner, kOuter, 0.5e-3, 9)));
  EXPECT_NE(fingerprint(make_annulus(kInner, kOuter, 0.5e-3, 1)),
            fingerprint(make_annulus(kInner, kOuter, 0.5e-3, 2)));
}

TEST(Generators, NeighboursAreNearInMemory) {
  const TriangleMesh mesh = make_annulus(kInner, kOuter, 0.1e-3, 1);
  double far = 0.0;
  for (const Triangle& t : mesh.triangles)
    far += std::abs(t[1] - t[0]) > 2000 || std::abs(t[2] - t[0]) > 2000;
  EXPECT_LT(far / mesh.triangle_count(), 0.05);
}

TEST(Annulus, WorksFromATinyHoleToASingleRowOfTriangles) {
  for (const auto& [inner, outer, size] :
       {std::tuple{20e-3, 24e-3, 4e-3}, std::tuple{20e-3, 24e-3, 2e-3}, std::tuple{0.01e-3, 5e-3, 1e-3},
        std::tuple{1e-3, 2e-3, 1e-3}, std::tuple{1.0, 1.001, 1e-3}, std::tuple{20e-3, 20.3e-3, 0.3e-3}}) {
    SCOPED_TRACE(testing::Message() << inner << " " << outer << " " << size);
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      const TriangleMesh mesh = make_annulus(inner, outer, size, seed);
      expect_flat_and_sound(mesh, measure(mesh), 0, 2);
    }
  }
}

TEST(Disc, IsOneSheetOfGoodTriangles) {
  for (const double size : {0.1e-3, 0.3e-3, 1e-3, 5e-3})
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      SCOPED_TRACE(testing::Message() << "size " << size << " seed " << seed);
      const TriangleMesh mesh = make_disc(5e-3, size, seed);
      const Measured m = measure(mesh);
      expect_flat_and_sound(mesh, m, 1, 1);
      EXPECT_GE(m.quality_min, 0.55);
      if (size < 0.5e-3) {
        EXPECT_GE(m.quality_mean, 0.97);
      }
      if (size < 2e-3) {
        EXPECT_NEAR(m.edge_mean / size, 1.0, 0.05);
      }
    }
}

TEST(Plate, IsOneSheetWithItsExactArea) {
  for (const double size : {0.1e-3, 0.25e-3, 1e-3, 4e-3})
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      SCOPED_TRACE(testing::Message() << "size " << size << " seed " << seed);
      const TriangleMesh mesh = make_plate(10e-3, 4e-3, size, seed);
      const Measured m = measure(mesh);
      expect_flat_and_sound(mesh, m, 1, 1);
      EXPECT_NEAR(total_area(mesh), 40e-6, 40e-6 * 1e-13);
      EXPECT_GE(m.quality_min, 0.55);
      if (size < 0.5e-3) {
        EXPECT_GE(m.quality_mean, 0.97);
      }
      if (size < 2e-3) {
        EXPECT_NEAR(m.edge_mean / size, 1.0, 0.05);
      }
      const BoundingBox box = bounding_box(mesh.vertices);
      EXPECT_EQ(box.low, (Vec3{-5e-3, -2e-3, 0.0}));
      EXPECT_EQ(box.high, (Vec3{5e-3, 2e-3, 0.0}));
    }
}

TEST(Generators, RefuseSizesThatCannotBeMeshed) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                   inf = std::numeric_limits<double>::infinity();
  for (const double bad : {0.0, -1e-3, nan, inf}) {
    EXPECT_THROW((void)make_annulus(bad, kOuter, 1e-3, 1), InputError) << bad;
    EXPECT_THROW((void)make_annulus(kInner, bad, 1e-3, 1), InputError) << bad;
    EXPECT_THROW((void)make_annulus(kInner, kOuter, bad, 1), InputError) << bad;
    EXPECT_THROW((void)make_disc(bad, 1e-3, 1), InputError) << bad;
    EXPECT_THROW((void)make_disc(kInner, bad, 1), InputError) << bad;
    EXPECT_THROW((void)make_plate(bad, 1e-2, 1e-3, 1), InputError) << bad;
    EXPECT_THROW((void)make_plate(1e-2, bad, 1e-3, 1), InputError) << bad;
    EXPECT_THROW((void)make_plate(1e-2, 1e-2, bad, 1), InputError) << bad;
  }
  EXPECT_THROW((void)make_annulus(kOuter, kInner, 1e-3, 1), InputError);
  EXPECT_THROW((void)make_annulus(kInner, kInner, 1e-3, 1), InputError);
  EXPECT_THROW((void)make_annulus(kInner, kOuter, 4.1e-3, 1), InputError);
  EXPECT_THROW((void)make_disc(kInner, 21e-3, 1), InputError);
  EXPECT_THROW((void)make_plate(1e-2, 2e-3, 3e-3, 1), InputError);
  try {
    (void)make_annulus(kInner, kOuter, 1e-7, 1);
    FAIL() << "a mesh of 10^11 triangles was accepted";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("choose a size of 3.6e-06 m or more"), std::string::npos)
        << e.what();
  }
}

}  // namespace
}  // namespace abradem::geometry
