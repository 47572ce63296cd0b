// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/geometry/sphere_fit.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>

#include "abradem/core/error.h"
#include "abradem/core/parallel.h"
#include "abradem/geometry/closest_point.h"

namespace abradem::geometry {

namespace {

constexpr double kCells = 48.0;  // along the longest side
constexpr double kInf = std::numeric_limits<double>::infinity();

struct Corners {
  Vec3 a, b, c;
};
Corners corners_of(const TriangleMesh& mesh, Index t) noexcept {
  const Triangle& v = mesh.triangles[static_cast<std::size_t>(t)];
  const auto at = [&](std::size_t k) { return mesh.vertices[static_cast<std::size_t>(v[k])]; };
  return {at(0), at(1), at(2)};
}

double distance_to(const TriangleMesh& mesh, Index t, const Vec3& p) noexcept {
  const auto [a, b, c] = corners_of(mesh, t);
  return norm(p - closest_point_on_triangle(p, a, b, c).point);
}

/// Distances from the cells inside a closed mesh to its surface; 0 in the others.
class InnerDistance {
 public:
  explicit InnerDistance(const TriangleMesh& mesh) : mesh_(mesh) {
    const BoundingBox box = bounding_box(mesh.vertices);
    const Vec3 e = box.high - box.low;
    cell_ = std::max({e.x, e.y, e.z}) / kCells;
    const auto cells = [&](double length) {
      return static_cast<std::int32_t>(std::ceil(length / cell_)) + 2;
    };
    count_ = {cells(e.x), cells(e.y), cells(e.z)};
    // Off the lattice that the mesh's own vertices may lie on.
    low_ = box.low - cell_ * Vec3{0.8819660, 0.8541020, 0.8284271};
    distance_.assign(at(count_[0]) * at(count_[1]) * at(count_[2]), 0.0);
    mark_inside();
    measure();
  }
  [[nodiscard]] double cell() const noexcept { return cell_; }
  [[nodiscard]] const std::array<std::int32_t, 3>& count() const noexcept { return count_; }
  [[nodiscard]] Vec3 place(std::int32_t i, std::int32_t j, std::int32_t k) const noexcept {
    return low_ + cell_ * Vec3{i + 0.5, j + 0.5, k + 0.5};
  }
  [[nodiscard]] double of(std::int32_t i, std::int32_t j, std::int32_t k) const noexcept {
    return distance_[index(i, j, k)];
  }

 private:
  static std::size_t at(std::int32_t i) noexcept { return static_cast<std::size_t>(i); }
  [[nodiscard]] std::size_t index(std::int32_t i, std::int32_t j, std::int32_t k) const noexcept {
    return (at(k) * at(count_[1]) + at(j)) * at(count_[0]) + at(i);
  }

  /// Twice the area of p with the edge u v in the plane z; of v u exactly the opposite.
  static double side(const Vec3& u, const Vec3& v, const Vec3& p) noexcept {
    const bool turned = v.x < u.x || (v.x == u.x && v.y < u.y);
    const Vec3 &f = turned ? v : u, &g = turned ? u : v;
    const double s = (g.x - f.x) * (p.y - f.y) - (g.y - f.y) * (p.x - f.x);
    return turned ? -s : s;
  }

  /// Along each column of cells: how often the surface has been entered, by the crossings below.
  void mark_inside() {
    std::vector<int> winding(distance_.size(), 0);
    for (Index t = 0; t < mesh_.triangle_count(); ++t) {
      const auto [a, b, c] = corners_of(mesh_, t);
      const auto first = [&](double x, double low) {
        return std::max(0, static_cast<std::int32_t>(std::ceil((x - low) / cell_ - 0.5)));
      };
      const auto last = [&](double x, double low, std::int32_t n) {
        return std::min(n - 1, static_cast<std::int32_t>(std::floor((x - low) / cell_ - 0.5)));
      };
      const double area = side(a, b, c);
      if (area == 0.0) continue;  // upright: no column crosses it
      for (auto j = first(std::min({a.y, b.y, c.y}), low_.y);
           j <= last(std::max({a.y, b.y, c.y}), low_.y, count_[1]); ++j)
        for (auto i = first(std::min({a.x, b.x, c.x}), low_.x);
             i <= last(std::max({a.x, b.x, c.x}), low_.x, count_[0]); ++i) {
          const Vec3 p = place(i, j, 0);
          const double u = side(b, c, p), v = side(c, a, p), w = side(a, b, p);
          const bool within = area > 0.0 ? u > 0.0 && v > 0.0 && w > 0.0 : u < 0.0 && v < 0.0 && w < 0.0;
          if (!within) continue;
          const double z = (u * a.z + v * b.z + w * c.z) / (u + v + w);
          const auto k = first(z, low_.z);  // the first cell above the crossing
          if (k < count_[2]) winding[index(i, j, k)] += area < 0.0 ? 1 : -1;  // seen from below: in
        }
    }
    for (std::int32_t j = 0; j < count_[1]; ++j)
      for (std::int32_t i = 0; i < count_[0]; ++i) {
        int inside = 0;
        for (std::int32_t k = 0; k < count_[2]; ++k) {
          inside += winding[index(i, j, k)];
          distance_[index(i, j, k)] = inside > 0 ? kInf : 0.0;
        }
      }
  }

  /// Blocks of cells look at those triangles alone that can be nearest to one of them.
  void measure() {
    constexpr std::int32_t kBlock = 4;
    const auto blocks = [&](std::size_t axis) { return (count_[axis] + kBlock - 1) / kBlock; };
    const std::int32_t nx = blocks(0), ny = blocks(1);
    core::parallel_for(at(nx) * at(ny) * at(blocks(2)), [&](std::size_t b) {
      const auto n = static_cast<std::int32_t>(b);
      measure_block(kBlock * (n % nx), kBlock * (n / nx % ny), kBlock * (n / nx / ny), kBlock);
    });
  }
  void measure_block(std::int32_t i0, std::int32_t j0, std::int32_t k0, std::int32_t size) {
    std::vector<std::array<std::int32_t, 3>> inside;
    for (std::int32_t k = k0; k < std::min(k0 + size, count_[2]); ++k)
      for (std::int32_t j = j0; j < std::min(j0 + size, count_[1]); ++j)
        for (std::int32_t i = i0; i < std::min(i0 + size, count_[0]); ++i)
          if (of(i, j, k) > 0.0) inside.push_back({i, j, k});
    if (inside.empty()) return;
    const Vec3 middle = low_ + cell_ * Vec3{i0 + 0.5 * size, j0 + 0.5 * size, k0 + 0.5 * size};
    const double half = 0.5 * size * cell_ * std::sqrt(3.0);
    std::vector<double> distances(mesh_.triangles.size());
    double nearest = kInf;
    for (Index t = 0; t < mesh_.triangle_count(); ++t)
      nearest = std::min(nearest, distances[static_cast<std::size_t>(t)] = distance_to(mesh_, t, middle));
    for (const auto& [i, j, k] : inside) {
      double& d = distance_[index(i, j, k)];
      for (Index t = 0; t < mesh_.triangle_count(); ++t)
        if (distances[static_cast<std::size_t>(t)] <= nearest + 2.0 * half)
          d = std::min(d, distance_to(mesh_, t, place(i, j, k)));
    }
  }

  const TriangleMesh& mesh_;
  double cell_ = 0.0;
  std::array<std::int32_t, 3> count_{};
  Vec3 low_;
  std::vector<double> distance_;
};

/// Inscribed balls that no neighbour's contains.
std::vector<Ball> maximal_balls(const InnerDistance& inner) {
  constexpr double kSmallest = 1.5;  // cells: finer ones are none of this grid's business
  constexpr double kSlack = 0.05;    // of a cell
  std::vector<Ball> balls;
  const auto& n = inner.count();
  for (std::int32_t k = 1; k + 1 < n[2]; ++k)
    for (std::int32_t j = 1; j + 1 < n[1]; ++j)
      for (std::int32_t i = 1; i + 1 < n[0]; ++i) {
        const double own = inner.of(i, j, k);
        if (own < kSmallest * inner.cell()) continue;
        bool maximal = true;
        for (std::int32_t m = 0; m < 27 && maximal; ++m) {
          const std::int32_t x = m % 3 - 1, y = m / 3 % 3 - 1, z = m / 9 - 1;
          if (m == 13) continue;
          const double way = inner.cell() * std::sqrt(static_cast<double>(x * x + y * y + z * z));
          maximal = inner.of(i + x, j + y, k + z) < own + way - kSlack * inner.cell();
        }
        if (maximal) balls.push_back({inner.place(i, j, k), own});
      }
  return balls;
}

/// Greedy: one after the other that covers the most of what is bare. What a ball would add only falls as
/// others are taken, so that an old bound is enough until it comes out on top.
std::vector<Ball> cover(const std::vector<Ball>& candidates, const InnerDistance& inner, int count) {
  const auto& n = inner.count();
  std::vector<std::uint8_t> bare;
  for (std::int32_t k = 0; k < n[2]; ++k)
    for (std::int32_t j = 0; j < n[1]; ++j)
      for (std::int32_t i = 0; i < n[0]; ++i) bare.push_back(inner.of(i, j, k) > 0.0 ? 1 : 0);
  const Vec3 first = inner.place(0, 0, 0);
  const auto visit = [&](const Ball& ball, auto&& cell) {
    const auto from = [&](double x, double low) {
      return std::max(0, static_cast<std::int32_t>(std::ceil((x - ball.radius - low) / inner.cell())));
    };
    const auto to = [&](double x, double low, std::int32_t last) {
      return std::min(last, static_cast<std::int32_t>(std::floor((x + ball.radius - low) / inner.cell())));
    };
    for (auto k = from(ball.centre.z, first.z); k <= to(ball.centre.z, first.z, n[2] - 1); ++k)
      for (auto j = from(ball.centre.y, first.y); j <= to(ball.centre.y, first.y, n[1] - 1); ++j)
        for (auto i = from(ball.centre.x, first.x); i <= to(ball.centre.x, first.x, n[0] - 1); ++i)
          if (norm2(inner.place(i, j, k) - ball.centre) <= ball.radius * ball.radius)
            cell(bare[(static_cast<std::size_t>(k) * static_cast<std::size_t>(n[1]) +
                       static_cast<std::size_t>(j)) *
                          static_cast<std::size_t>(n[0]) +
                      static_cast<std::size_t>(i)]);
  };
  const auto gain_of = [&](const Ball& ball) {
    std::size_t gain = 0;
    visit(ball, [&](std::uint8_t& b) { gain += b; });
    return gain;
  };
  struct Offer {
    std::size_t gain;
    double radius;
    std::size_t candidate;
    bool operator<(const Offer& o) const noexcept {  // of equal ones the larger, then the first
      if (gain != o.gain) return gain < o.gain;
      if (radius != o.radius) return radius < o.radius;
      return candidate > o.candidate;
    }
  };
  std::vector<std::size_t> gains(candidates.size());
  core::parallel_for(candidates.size(), [&](std::size_t c) { gains[c] = gain_of(candidates[c]); });
  std::priority_queue<Offer> offers;
  for (std::size_t c = 0; c < candidates.size(); ++c) offers.push({gains[c], candidates[c].radius, c});
  std::vector<Ball> taken;
  while (!offers.empty() && taken.size() < static_cast<std::size_t>(count)) {
    Offer best = offers.top();
    offers.pop();
    if (const std::size_t now = gain_of(candidates[best.candidate]); now != best.gain) {
      best.gain = now;
      if (now > 0) offers.push(best);
      continue;
    }
    if (best.gain == 0) break;
    taken.push_back(candidates[best.candidate]);
    visit(taken.back(), [](std::uint8_t& b) { b = 0; });
  }
  return taken;
}

std::vector<Ball> grown(std::vector<Ball> balls, double by) {
  for (Ball& b : balls) b.radius += by;
  return balls;
}

/// By how much the radii must grow for the union to have a volume (bisection; the union grows with it).
double growth_to(const std::vector<Ball>& balls, double volume) {
  constexpr int kPanels = 16;  // 1e-4 of the volume
  double low = 0.0, high = std::cbrt(volume);
  if (mass_properties(balls, kPanels).volume >= volume) return 0.0;
  for (int k = 0; k < 24; ++k) {
    const double middle = 0.5 * (low + high);
    (mass_properties(grown(balls, middle), kPanels).volume < volume ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double distance_to_union(const std::vector<Ball>& balls, const Vec3& p) noexcept {
  double distance = kInf;
  for (const Ball& b : balls) distance = std::min(distance, norm(p - b.centre) - b.radius);
  return distance;
}

/// The surface's points on a lattice of a cell's width, the corners among them.
double deepest_gap(const TriangleMesh& mesh, const std::vector<Ball>& balls, double cell) {
  double deepest = 0.0;
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    const auto [a, b, c] = corners_of(mesh, t);
    const double longest = std::max({norm(b - a), norm(c - b), norm(a - c)});
    const int n = std::max(1, static_cast<int>(std::ceil(longest / cell)));
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n - i; ++j)
        deepest = std::max(deepest, distance_to_union(balls, a + (b - a) * (static_cast<double>(i) / n) +
                                                                 (c - a) * (static_cast<double>(j) / n)));
  }
  return deepest;
}

}  // namespace

SphereFit fit_spheres(const TriangleMesh& mesh, int count) {
  const InnerDistance inner(mesh);
  const std::vector<Ball> inscribed = cover(maximal_balls(inner), inner, count);
  if (inscribed.empty())
    throw GeometryError(
        fmt::format("no sphere of {:.4g} mm radius fits inside: the solid is thinner than a sixteenth of its "
                    "length, or its normals point inwards",
                    1.5e3 * inner.cell()));
  const double volume = signed_volume(mesh);
  SphereFit fit;
  fit.growth = growth_to(inscribed, volume);
  fit.balls = grown(inscribed, fit.growth);
  fit.volume_error = mass_properties(fit.balls).volume / volume - 1.0;
  fit.deepest = deepest_gap(mesh, fit.balls, inner.cell());
  fit.furthest = fit.growth;  // an inscribed ball touches the surface
  return fit;
}

}  // namespace abradem::geometry
