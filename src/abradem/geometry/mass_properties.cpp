// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/geometry/mass_properties.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace abradem::geometry {

namespace {

/// Integrals of 1, of the coordinates and of their products.
struct Moments {
  double one = 0.0;
  Vec3 first, squares, products;  // int x …; int x^2 …; int yz, zx, xy
};

/// From integrals about any point to the body's own.
MassProperties about_centre(const Moments& m, const Vec3& origin) {
  MassProperties body;
  body.volume = m.one;
  const Vec3 c = m.first / m.one;
  body.centre = origin + c;
  const double xx = m.squares.x - m.one * c.x * c.x, yy = m.squares.y - m.one * c.y * c.y,
               zz = m.squares.z - m.one * c.z * c.z;
  body.moments = {yy + zz, zz + xx, xx + yy};
  body.products = {-(m.products.x - m.one * c.y * c.z), -(m.products.y - m.one * c.z * c.x),
                   -(m.products.z - m.one * c.x * c.y)};
  return body;
}

struct Disc {
  double x = 0.0, y = 0.0, radius = 0.0;
};

/// Gauss's rule of eight points on [-1, 1].
constexpr std::array kNodes{0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
constexpr std::array kWeights{0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};

template <typename F>
void gauss(double from, double to, F&& f) {
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  for (std::size_t k = 0; k < kNodes.size(); ++k) {
    f(middle - half * kNodes[k], half * kWeights[k]);
    f(middle + half * kNodes[k], half * kWeights[k]);
  }
}

/// Integrals over a plane section.
struct Section {
  double one = 0.0, x = 0.0, y = 0.0, xx = 0.0, yy = 0.0, xy = 0.0;

  /// What an arc of the border adds (Green's theorem, counter-clockwise).
  void add_arc(const Disc& d, double from, double to) noexcept {
    const int pieces = static_cast<int>(std::ceil((to - from) / (0.25 * std::numbers::pi)));
    for (int k = 0; k < pieces; ++k)
      gauss(from + (to - from) * k / pieces, from + (to - from) * (k + 1) / pieces, [&](double t, double w) {
        const double c = std::cos(t), s = std::sin(t);
        const double px = d.x + d.radius * c, py = d.y + d.radius * s;
        const double dx = -d.radius * s * w, dy = d.radius * c * w;
        one += 0.5 * (px * dy - py * dx);
        x += 0.5 * px * px * dy;
        y -= 0.5 * py * py * dx;
        xx += px * px * px * dy / 3.0;
        yy -= py * py * py * dx / 3.0;
        xy += 0.5 * px * px * py * dy;
      });
  }
};

/// Which part of circle i other discs cover, as intervals of the angle within [0, 2 pi]; false: all of it.
bool covered_parts(const std::vector<Disc>& discs, std::size_t i,
                   std::vector<std::pair<double, double>>& parts) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const Disc& own = discs[i];
  parts.clear();
  for (std::size_t j = 0; j < discs.size(); ++j) {
    if (j == i) continue;
    const Disc& other = discs[j];
    const double dx = other.x - own.x, dy = other.y - own.y, d = std::hypot(dx, dy);
    if (d >= own.radius + other.radius || d < own.radius - other.radius) continue;
    const bool same = d == 0.0 && own.radius == other.radius;
    if (d <= other.radius - own.radius) {
      if (!same || j < i) return false;
      continue;
    }
    const double cosine =
        (own.radius * own.radius + d * d - other.radius * other.radius) / (2.0 * d * own.radius);
    const double half = std::acos(std::clamp(cosine, -1.0, 1.0));
    double from = std::atan2(dy, dx) - half;
    if (from < 0.0) from += kTurn;
    const double to = from + 2.0 * half;
    parts.emplace_back(from, std::min(to, kTurn));
    if (to > kTurn) parts.emplace_back(0.0, to - kTurn);
  }
  std::ranges::sort(parts);
  return true;
}

Section section_of(const std::vector<Disc>& discs) {
  Section section;
  std::vector<std::pair<double, double>> parts;
  for (std::size_t i = 0; i < discs.size(); ++i) {
    if (!covered_parts(discs, i, parts)) continue;
    double free_from = 0.0;
    for (const auto& [from, to] : parts) {
      if (from > free_from) section.add_arc(discs[i], free_from, from);
      free_from = std::max(free_from, to);
    }
    if (free_from < 2.0 * std::numbers::pi) section.add_arc(discs[i], free_from, 2.0 * std::numbers::pi);
  }
  return section;
}

}  // namespace

MassProperties mass_properties(const TriangleMesh& mesh) {
  const Vec3 origin = mesh.vertices.empty() ? Vec3{} : mesh.vertices.front();
  Moments m;
  for (const Triangle& t : mesh.triangles) {
    const auto corner = [&](std::size_t k) { return mesh.vertices[static_cast<std::size_t>(t[k])] - origin; };
    const Vec3 a = corner(0), b = corner(1), c = corner(2), sum = a + b + c;
    const double six_volumes = dot(a, cross(b, c));
    m.one += six_volumes / 6.0;
    m.first += six_volumes / 24.0 * sum;
    // int p q dV over a tetrahedron with one corner at 0: V/20 (sum of p_i q_i + sum p_i sum q_i).
    const auto integral = [&](double Vec3::*p, double Vec3::*q) {
      return six_volumes / 120.0 * (a.*p * (a.*q) + b.*p * (b.*q) + c.*p * (c.*q) + sum.*p * (sum.*q));
    };
    m.squares += {integral(&Vec3::x, &Vec3::x), integral(&Vec3::y, &Vec3::y), integral(&Vec3::z, &Vec3::z)};
    m.products += {integral(&Vec3::y, &Vec3::z), integral(&Vec3::z, &Vec3::x), integral(&Vec3::x, &Vec3::y)};
  }
  return about_centre(m, origin);
}

MassProperties mass_properties(std::span<const Ball> balls, int panels) {
  Vec3 origin;
  for (const Ball& b : balls) origin += b.centre / static_cast<double>(balls.size());
  std::vector<double> ends;
  for (const Ball& b : balls) {
    ends.push_back(b.centre.z - origin.z - b.radius);
    ends.push_back(b.centre.z - origin.z + b.radius);
  }
  std::ranges::sort(ends);
  const double longest = (ends.back() - ends.front()) / panels;
  Moments m;
  std::vector<Disc> discs;
  const auto add_section = [&](double z, double weight) {
    discs.clear();
    for (const Ball& b : balls) {
      const double dz = z - (b.centre.z - origin.z), r2 = b.radius * b.radius - dz * dz;
      if (r2 > 0.0) discs.push_back({b.centre.x - origin.x, b.centre.y - origin.y, std::sqrt(r2)});
    }
    const Section s = section_of(discs);
    m.one += weight * s.one;
    m.first += weight * Vec3{s.x, s.y, z * s.one};
    m.squares += weight * Vec3{s.xx, s.yy, z * z * s.one};
    m.products += weight * Vec3{z * s.y, z * s.x, s.xy};
  };
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    const double height = ends[k + 1] - ends[k];
    const int pieces = static_cast<int>(std::ceil(height / longest));
    for (int p = 0; p < pieces; ++p)
      gauss(ends[k] + height * p / pieces, ends[k] + height * (p + 1) / pieces, add_section);
  }
  return about_centre(m, origin);
}

PrincipalAxes principal_axes(const MassProperties& body) {
  Eigen::Matrix3d tensor;
  tensor << body.moments.x, body.products.z, body.products.y,  //
      body.products.z, body.moments.y, body.products.x,        //
      body.products.y, body.products.x, body.moments.z;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(tensor);
  const auto axis = [&](Eigen::Index k) {
    const Eigen::Vector3d v = solver.eigenvectors().col(k);
    return Vec3{v[0], v[1], v[2]};
  };
  const Vec3 x = axis(0), y = axis(1);
  const auto& values = solver.eigenvalues();
  return {{values[0], values[1], values[2]}, quaternion_of(x, y, cross(x, y))};
}

}  // namespace abradem::geometry
