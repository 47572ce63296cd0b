// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/wear/wearing_tip.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "abradem/core/error.h"

namespace abradem::wear {

namespace {

constexpr int kWidestSpan = 64;   // points across a contact, beyond which half as many are enough
constexpr double kDeepest = 2.0;  // Hertz approaches that the deepest point seen may differ from the wall's
constexpr int kFirstHalf = 16;    // points of a new map from its middle to an edge
constexpr double kFurthest = 0.966;  // of R: 75 degrees from the axis

std::size_t at(std::int32_t i) noexcept { return static_cast<std::size_t>(i); }

}  // namespace

WearingTip::WearingTip(double R, double cell) : R_(R), coarsest_(2.0 * cell) {
  shape_.cell = cell;
  set_grid(std::min(kFirstHalf, static_cast<int>(kFurthest * R / cell)));
}

void WearingTip::set_grid(int half) {
  shape_.half = half;
  shape_.recession.assign(static_cast<std::size_t>(shape_.side()) * static_cast<std::size_t>(shape_.side()),
                          0.0);
  pressure_.assign(shape_.recession.size(), 0.0);
}

bool WearingTip::restored() {
  constexpr int kMostPoints = 20'000;  // along a side, far beyond what contacts need
  const contact::TipShape& map = shape_;
  if (!(map.cell > 0.0) || map.half < 0 || map.half > kMostPoints) return false;
  const auto side = static_cast<std::size_t>(map.side());
  if (map.recession.size() != side * side) return false;
  pressure_.assign(map.recession.size(), 0.0);
  return std::ranges::all_of(pressed_, [&](const Share& s) { return s.point < map.recession.size(); });
}

void WearingTip::grow(int half) {
  const contact::TipShape old = shape_;
  set_grid(half);
  for (int j = -old.half; j <= old.half; ++j)
    for (int i = -old.half; i <= old.half; ++i)
      shape_.recession[shape_.index(i, j)] = old.recession[old.index(i, j)];
}

double WearingTip::s_of(std::size_t k) const noexcept {
  return shape_.cell * (static_cast<int>(k) % shape_.side() - shape_.half);
}
double WearingTip::t_of(std::size_t k) const noexcept {
  const int row = static_cast<int>(k) / shape_.side();
  return shape_.cell * (row - shape_.half);
}

/// Of the surface over the cell [m^2]. It faces along the axis, or as the sphere does where it is as new.
double WearingTip::area(std::size_t k) const noexcept {
  const double cell2 = shape_.cell * shape_.cell;
  const int i = static_cast<int>(k) % shape_.side() - shape_.half;
  const int j = static_cast<int>(k) / shape_.side() - shape_.half;
  if (std::max(std::abs(i), std::abs(j)) >= shape_.half) return cell2;
  // Slopes of the sphere, and of what is missing.
  const double s = s_of(k), t = t_of(k), h = std::sqrt(R_ * R_ - s * s - t * t), d = 2.0 * shape_.cell;
  const double slope_s = s / h + (shape_.recession[point(i + 1, j)] - shape_.recession[point(i - 1, j)]) / d;
  const double slope_t = t / h + (shape_.recession[point(i, j + 1)] - shape_.recession[point(i, j - 1)]) / d;
  return cell2 * std::sqrt(1.0 + slope_s * slope_s + slope_t * slope_t);
}

/// Every second point, with the mean of its surroundings weighted 4 : 2 : 1, which keeps the sum.
void WearingTip::coarsen() {
  const contact::TipShape old = shape_;
  const int from = old.half;
  shape_.cell *= 2.0;
  set_grid(old.half / 2 + 1);
  const auto r = [&](int i, int j) {
    return std::max(std::abs(i), std::abs(j)) > from ? 0.0 : old.recession[old.index(i, j)];
  };
  for (int j = -shape_.half; j <= shape_.half; ++j)
    for (int i = -shape_.half; i <= shape_.half; ++i) {
      double sum = 0.0;
      for (int b = -1; b <= 1; ++b)
        for (int a = -1; a <= 1; ++a)
          sum += r(2 * i + a, 2 * j + b) / ((a == 0 ? 2.0 : 4.0) * (b == 0 ? 2.0 : 4.0));
      shape_.recession[point(i, j)] = sum;
    }
  pressed_.clear();
  ++shape_.revision;
}

double WearingTip::pressure(const Contact& contact, double deepest, double g) noexcept {
  if (contact.d_e == 0.0) return std::max(g, 0.0);
  return std::sqrt(std::max(0.0, contact.d_e - 2.0 * (deepest - g)));
}

/// Overlap below which a point is not pressed, with a margin for what the map has changed since the contact
/// was found [m].
double WearingTip::least_overlap(const Contact& contact) noexcept {
  return contact.d_e == 0.0 ? 0.0 : contact.field.deepest - kDeepest * contact.d_e;
}

/// Visits the points of the map that lie over a triangle, with the sphere's excess there:
/// visit(point, excess of the sphere as new, offset from its centre along the axis).
template <typename Visit>
void WearingTip::cover(const contact::MeshCandidates& m, const Contact& contact, std::size_t triangle,
                       const Visit& visit) const {
  double s[3], t[3], e[3], z[3];
  const std::int32_t corners[3]{m.v0[triangle], m.v1[triangle], m.v2[triangle]};
  const std::span<const double> excess = contact.field.raw.empty() ? contact.field.excess : contact.field.raw;
  for (int k = 0; k < 3; ++k) {
    const Vec3 offset = m.node_position(at(corners[k])) - contact.field.c;
    z[k] = dot(offset, contact.frame.axis);
    if (z[k] <= 0.0) return;  // the far side of the sphere
    s[k] = dot(offset, contact.frame.u) / shape_.cell;
    t[k] = dot(offset, contact.frame.v) / shape_.cell;
    e[k] = excess[at(corners[k])];
  }
  const double det = (s[1] - s[0]) * (t[2] - t[0]) - (s[2] - s[0]) * (t[1] - t[0]);
  if (det == 0.0) return;  // seen from its edge
  const auto first = [&](const double(&x)[3]) {
    return std::max(-shape_.half, static_cast<int>(std::ceil(std::min({x[0], x[1], x[2]}) - 1e-9)));
  };
  const auto last = [&](const double(&x)[3]) {
    return std::min(shape_.half, static_cast<int>(std::floor(std::max({x[0], x[1], x[2]}) + 1e-9)));
  };
  const double inverse = 1.0 / (R_ * R_);
  const double l01 = m.l01[triangle] * inverse, l12 = m.l12[triangle] * inverse,
               l20 = m.l20[triangle] * inverse;
  constexpr double kEdge = -1e-9;  // a point on an edge belongs to both sides; it is counted once
  for (int j = first(t); j <= last(t); ++j)
    for (int i = first(s); i <= last(s); ++i) {
      const double b1 = ((i - s[0]) * (t[2] - t[0]) - (s[2] - s[0]) * (j - t[0])) / det;
      const double b2 = ((s[1] - s[0]) * (j - t[0]) - (i - s[0]) * (t[1] - t[0])) / det;
      const double b0 = 1.0 - b1 - b2;
      if (b0 < kEdge || b1 < kEdge || b2 < kEdge) continue;
      // Along a line the excess is a parabola of curvature -2.
      visit(point(i, j), b0 * e[0] + b1 * e[1] + b2 * e[2] + b0 * b1 * l01 + b1 * b2 * l12 + b2 * b0 * l20,
            b0 * z[0] + b1 * z[1] + b2 * z[2]);
    }
}

/// Collects the pressures of all points, on a map that is made larger until the contact lies inside it. The
/// deepest point counts as the map sees it.
/// @param collect (add), add(point, excess of the sphere as new, offset along the axis)
template <typename Collect>
void WearingTip::gather(const Contact& contact, const Vec3& deepest_at, const Collect& collect) {
  if (span_ > kWidestSpan && shape_.cell < coarsest_) coarsen();
  const int furthest = static_cast<int>(kFurthest * R_ / shape_.cell);
  while (true) {
    for (const Share& share : pressed_) pressure_[share.point] = 0.0;
    pressed_.clear();
    // First the overlaps, each point once; the pressures follow when the deepest is known.
    const double least = least_overlap(contact);
    double deepest = 0.0;
    collect([&](std::size_t k, double raw, double z) {
      const double e = contact::worn_excess(raw, shape_.recession[k], z, R_);
      const double g = contact.field.R * e / (1.0 + std::sqrt(1.0 - e));
      if (pressure_[k] != 0.0 || !(g > least)) return;
      pressure_[k] = 1.0;
      pressed_.push_back({k, g});
      deepest = pressed_.size() == 1 ? g : std::max(deepest, g);
    });
    bool at_edge = false;
    std::size_t kept = 0;
    for (const Share& share : pressed_) {
      const double p = pressure(contact, deepest, share.weight);
      pressure_[share.point] = p;
      if (!(p > 0.0)) continue;
      pressed_[kept++] = share;
      const int i = static_cast<int>(share.point) % shape_.side(),
                j = static_cast<int>(share.point) / shape_.side();
      at_edge = at_edge || std::min({i, j, shape_.side() - 1 - i, shape_.side() - 1 - j}) < 2;
    }
    pressed_.resize(kept);
    const double s = dot(deepest_at, contact.frame.u), t = dot(deepest_at, contact.frame.v);
    const int reached = static_cast<int>(std::ceil(std::max(std::abs(s), std::abs(t)) / shape_.cell)) + 2;
    if (!at_edge && reached <= shape_.half) break;
    const int wanted = std::max(shape_.half + shape_.half / 2, reached);
    if (at_edge ? shape_.half >= furthest : reached > furthest)
      throw SimulationError(fmt::format(
          "a sphere of radius {:.4g} mm wears more than 75 degrees from the direction of its load, which the "
          "map of its worn tip cannot show. Let it meet walls across its load, or leave out its wear",
          1e3 * R_));
    pressed_.clear();
    grow(std::min(wanted, furthest));
  }
  if (pressed_.empty()) {
    const int i = static_cast<int>(std::lround(dot(deepest_at, contact.frame.u) / shape_.cell)) + shape_.half;
    const int j = static_cast<int>(std::lround(dot(deepest_at, contact.frame.v) / shape_.cell)) + shape_.half;
    pressed_.push_back({static_cast<std::size_t>(j * shape_.side() + i), 0.0});
    pressure_[pressed_.front().point] = 1.0;
  }
  std::ranges::sort(pressed_, {}, &Share::point);
  total_ = pressed_area_ = 0.0;
  int low[2]{shape_.side(), shape_.side()}, high[2]{0, 0};
  for (Share& share : pressed_) {
    share.weight = area(share.point) * pressure_[share.point];
    total_ += share.weight;
    pressed_area_ += area(share.point);
    const int place[2]{static_cast<int>(share.point) % shape_.side(),
                       static_cast<int>(share.point) / shape_.side()};
    for (int k = 0; k < 2; ++k) low[k] = std::min(low[k], place[k]), high[k] = std::max(high[k], place[k]);
  }
  span_ = std::max(high[0] - low[0], high[1] - low[1]);
}

void WearingTip::press_on(const contact::MeshCandidates& candidates, const Contact& contact,
                          const Vec3& deepest_at) {
  const double g_cut = least_overlap(contact) / R_, cut = g_cut * (2.0 - g_cut);
  const std::span<const double> excess = contact.field.raw.empty() ? contact.field.excess : contact.field.raw;
  gather(contact, deepest_at, [&](const auto& add) {
    for (std::size_t t = 0; t < candidates.triangle_count(); ++t) {
      if (!contact.mask.empty() && contact.mask[t] == 0) continue;
      // No point of the triangle has a larger excess: squared distances are convex.
      const double bound = std::max({excess[at(candidates.v0[t])], excess[at(candidates.v1[t])],
                                     excess[at(candidates.v2[t])]}) +
                           candidates.longest[t] / (3.0 * R_ * R_);
      if (bound > cut) cover(candidates, contact, t, add);
    }
  });
}

void WearingTip::press_on_plane(const Contact& contact, double height, const Vec3& n,
                                const Vec3& deepest_at) {
  const double n_s = dot(n, contact.frame.u), n_t = dot(n, contact.frame.v), n_a = dot(n, contact.frame.axis);
  gather(contact, deepest_at, [&](const auto& add) {
    for (std::size_t k = 0; k < shape_.recession.size(); ++k) {
      // The plane's point over (s, t) lies h along the axis: n . (s u + t v + h axis) = -height.
      const double s = s_of(k), t = t_of(k), h = -(height + s * n_s + t * n_t) / n_a;
      if (h > 0.0) add(k, 1.0 - (s * s + t * t + h * h) / (R_ * R_), h);
    }
  });
}

void WearingTip::wear(double volume) {
  if (volume == 0.0 || pressed_.empty()) return;
  const double scale = volume / (total_ * shape_.cell * shape_.cell);
  for (const Share& share : pressed_) shape_.recession[share.point] += scale * share.weight;
  const double y = volume - lost_, sum = deposited_ + y;  // Kahan: a long run adds many small ones
  lost_ = (sum - deposited_) - y;
  deposited_ = sum;
  ++shape_.revision;
}

double WearingTip::removed_volume() const {
  double sum = 0.0;
  for (const double r : shape_.recession) sum += r;
  return sum * shape_.cell * shape_.cell;
}

double WearingTip::deepest() const { return *std::ranges::max_element(shape_.recession); }

WearingTip::Extent WearingTip::flat(double level) const {
  const auto along = [&](std::size_t first, std::size_t stride) {
    double low = 0.0, high = 0.0;
    const int n = shape_.side();
    const auto r = [&](int i) { return shape_.recession[first + static_cast<std::size_t>(i) * stride]; };
    const auto crossing = [&](int in, int out) {
      return (out - in) * (r(in) - level) / (r(in) - r(out)) + in;
    };
    int from = 0, to = n - 1;
    while (from < n && r(from) <= level) ++from;
    while (to > from && r(to) <= level) --to;
    if (from >= n) return 0.0;
    low = from == 0 ? 0.0 : crossing(from, from - 1);
    high = to == n - 1 ? n - 1.0 : crossing(to, to + 1);
    return (high - low) * shape_.cell;
  };
  const auto n = static_cast<std::size_t>(shape_.side()), middle = static_cast<std::size_t>(shape_.half);
  return {along(middle * n, 1), along(middle, n)};
}

}  // namespace abradem::wear
