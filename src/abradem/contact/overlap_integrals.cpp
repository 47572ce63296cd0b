// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/contact/overlap_integrals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "abradem/contact/overlap_series.h"

namespace abradem::contact {

namespace {

/// Integrals over the disc's overlap with the triangle of e^k, k = 1 … terms, by Green's theorem: each edge
/// adds what it sees from the disc's centre. On the plane e = E - rho^2, so inside the disc the edge integral
/// is a polynomial; outside it is an angle. The angles are summed as a product of complex numbers, whose
/// argument is taken once.
class DiscIntegrals {
 public:
  DiscIntegrals(double E, std::size_t terms) noexcept : E_(E), terms_(terms) {}

  /// @param h signed distance of the edge's line from the centre   @param t0,t1 ends along it from its foot
  void add_edge(double h, double t0, double t1) noexcept {
    surrounded_ = surrounded_ && h > 0.0;
    const double w2 = E_ - h * h;  // squared half chord
    const double w = std::sqrt(std::max(w2, 0.0));
    if (t1 <= -w || t0 >= w) {  // nothing of the edge inside
      turn(h, t0, t1);
      return;
    }
    const double ta = std::clamp(t0, -w, w), tb = std::clamp(t1, -w, w);
    if (t0 < ta) turn(h, t0, ta);
    if (tb < t1) turn(h, tb, t1);
    add_chord(h, w2, ta, tb);
    cut_ = cut_ || ta < tb;
  }

  /// To be called after the last edge. @return false where the triangle misses the disc
  [[nodiscard]] bool close() noexcept {
    angle_ = std::atan2(im_, re_);
    // Around a centre inside the triangle the angles are positive and sum up to a whole turn at most; from
    // outside it is seen under half a turn at most, and what else the argument says is round-off.
    constexpr double pi = std::numbers::pi;
    if (angle_ < (surrounded_ ? 0.0 : -0.5 * pi)) angle_ += 2.0 * pi;
    if (!surrounded_) angle_ = std::max(angle_, 0.0);
    // With no edge inside, the triangle holds the whole disc or none of it.
    if (!cut_) angle_ = surrounded_ ? 2.0 * pi : 0.0;
    return cut_ || surrounded_;
  }

  /// Integral of e^k dA over the overlap.
  [[nodiscard]] double moment(std::size_t k) const noexcept {
    double power = E_;
    for (std::size_t j = 0; j < k; ++j) power *= E_;
    return (chord_[k] + angle_ * power) / (2.0 * static_cast<double>(k + 1));
  }

 private:
  /// Turns by the angle under which the centre sees the line from one place to another.
  void turn(double h, double from, double to) noexcept {
    const double x = h * h + from * to, y = h * (to - from);
    const double re = re_ * x - im_ * y;
    im_ = re_ * y + im_ * x;
    re_ = re;
  }

  void add_chord(double h, double w2, double ta, double tb) noexcept {
    // J_j = integral of (w2 - t^2)^j dt by recursion; S_k = sum_j E^(k-j) J_j.
    const double ea = w2 - ta * ta, eb = w2 - tb * tb;
    double J = tb - ta, pa = ta, pb = tb, S = J;
    for (std::size_t k = 1; k <= terms_; ++k) {
      pa *= ea;
      pb *= eb;
      const double twice = 2.0 * static_cast<double>(k);
      J = (pb - pa + twice * w2 * J) * kInverse[k];
      S = S * E_ + J;
      chord_[k] += h * S;
    }
  }

  static constexpr std::array<double, series::kTerms + 1> kInverse = [] {  // 1 / (2 k + 1)
    std::array<double, series::kTerms + 1> inverse{};
    for (std::size_t k = 0; k <= series::kTerms; ++k) inverse[k] = 1.0 / (2.0 * static_cast<double>(k) + 1.0);
    return inverse;
  }();

  double E_, angle_ = 0.0, re_ = 1.0, im_ = 0.0;
  std::size_t terms_;
  bool cut_ = false, surrounded_ = true;
  std::array<double, series::kTerms + 1> chord_{};
};

/// Terms of the series that a shallow overlap needs: the next is below 1e-13 of M's first, that of e^2.
std::size_t terms_for(double largest_excess) noexcept {
  constexpr double kRest = 1e-13;
  std::size_t terms = 2;
  for (double power = largest_excess; terms < series::kTerms && power > kRest; ++terms)
    power *= largest_excess;
  return terms;
}

}  // namespace

OverlapIntegrals overlap_of_triangle(const Vec3& a, const Vec3& b, const Vec3& c, double R) noexcept {
  const Vec3 area2 = cross(b - a, c - a);
  const double twice_area = norm(area2);
  if (!(twice_area > 0.0)) return {};
  const Vec3 n = area2 / twice_area;
  const double d = -dot(n, a);  // signed distance of the centre above the plane
  const double E = R * R - d * d;
  if (E <= 0.0) return {};

  const Vec3 foot = -d * n;
  const double R2 = R * R;
  const std::size_t terms = terms_for(E / R2);
  DiscIntegrals integrals(E, terms);
  const std::array<Vec3, 3> p{a - foot, b - foot, c - foot};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3& p0 = p[k];
    const Vec3 edge = p[(k + 1) % 3] - p0;
    const double length = norm(edge);
    const double h = dot(n, cross(p0, edge)) / length;
    const double t0 = dot(p0, edge) / length;
    integrals.add_edge(h, t0, t0 + length);
  }
  if (!integrals.close()) return {};

  double G = 0.0, M = 0.0, scale = 1.0;
  for (std::size_t k = 1; k <= terms; ++k) {
    scale /= R2;
    const double I = integrals.moment(k) * scale;
    G += series::kOverlap[k] * I;
    M += series::kWeighted[k] * I;
  }
  return {R * G, R * d * M};
}

OverlapIntegrals overlap_of_plane(double delta, double R) noexcept {
  constexpr double pi = std::numbers::pi;
  const double x = delta / R;
  return {pi * R * delta * delta * (1.0 - 2.0 * x / 3.0),
          pi / 3.0 * R * delta * delta * delta * (1.0 - 0.5 * x)};
}

double equivalent_overlap(double M, double R) noexcept {
  if (!(M > 0.0)) return 0.0;
  // delta^3 (1 - delta / 2R) = 3M / (pi R): a contraction for delta << R; three Newton steps reach round-off.
  const double target = 3.0 * M / (std::numbers::pi * R);
  double delta = std::cbrt(target);
  for (int i = 0; i < 3; ++i) {
    const double value = delta * delta * delta * (1.0 - 0.5 * delta / R) - target;
    const double slope = delta * delta * (3.0 - 2.0 * delta / R);
    delta -= value / slope;
  }
  return delta;
}

}  // namespace abradem::contact
