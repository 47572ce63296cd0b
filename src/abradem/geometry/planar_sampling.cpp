// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/geometry/planar_sampling.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <utility>

#include "abradem/core/random.h"

namespace abradem::geometry {

namespace {

constexpr double kGrain = 12.0;        ///< spacing of the grain seeds
constexpr double kGrainJitter = 0.35;  ///< of the spacing, each way
constexpr double kClosest = 0.65;      ///< smallest distance between two points
constexpr double kBorderGap =
    0.62;  ///< smallest depth of a free point; above 0.5 borders stay Delaunay edges
constexpr double kRowHeight = 0.5 * std::numbers::sqrt3;

/// Spacing of the lattice within a grain. Between grains and along borders points are left out; a lattice
/// finer by this much makes up for it, so that the mean edge is 1 (measured: docs/theory/meshes.md).
double lattice_spacing(double border_length, double area) noexcept {
  return std::max(0.9, 0.978 - 0.08 * border_length / area);
}

enum Stream : std::uint64_t { border_stream, order_stream, grain_stream };

std::size_t at(Index i) noexcept { return static_cast<std::size_t>(i); }

double distance2(Point2 a, Point2 b) noexcept {
  return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
}

/// Points hashed by the unit cell they lie in; answers "is anything nearer than kClosest?" in O(1).
class NearbyPoints {
 public:
  NearbyPoints(std::vector<Point2>& points, double expected)
      : points_(points), heads_(std::bit_ceil(static_cast<std::size_t>(expected) + 64), -1) {}

  void add(Point2 p) {
    Index& head = heads_[slot(cell(p.x), cell(p.y))];
    next_.push_back(head);
    head = static_cast<Index>(points_.size());
    points_.push_back(p);
  }
  [[nodiscard]] bool crowded(Point2 p) const {
    // Cells are 1 wide and kClosest < 1: at most two columns and two rows are within reach.
    const auto x0 = cell(p.x - kClosest), x1 = cell(p.x + kClosest);
    const auto y0 = cell(p.y - kClosest), y1 = cell(p.y + kClosest);
    for (auto y = y0; y <= y1; ++y)
      for (auto x = x0; x <= x1; ++x)
        for (Index i = heads_[slot(x, y)]; i >= 0; i = next_[at(i)])
          if (distance2(points_[at(i)], p) < kClosest * kClosest) return true;
    return false;
  }

 private:
  static std::int64_t cell(double x) noexcept { return static_cast<std::int64_t>(std::floor(x)); }
  [[nodiscard]] std::size_t slot(std::int64_t x, std::int64_t y) const noexcept {
    // Neighbouring cells of a row fall into neighbouring slots: near in memory.
    const std::uint64_t row = core::splitmix64(static_cast<std::uint64_t>(y));
    return (row + static_cast<std::uint64_t>(x)) & (heads_.size() - 1);
  }
  std::vector<Point2>& points_;
  std::vector<Index> heads_;
  std::vector<Index> next_;
};

/// Seeds of the grains on a jittered square grid; each is a function of its grid position and the seed alone.
struct Grains {
  std::uint64_t seed;

  [[nodiscard]] core::RandomStream stream(std::int64_t i, std::int64_t j) const noexcept {
    const std::uint64_t place =
        core::splitmix64(static_cast<std::uint64_t>(i)) + static_cast<std::uint64_t>(j);
    return core::RandomStream(seed, grain_stream + core::splitmix64(place));
  }
  [[nodiscard]] Point2 centre(std::int64_t i, std::int64_t j, core::RandomStream& random) const noexcept {
    return {kGrain * (static_cast<double>(i) + random.uniform(-kGrainJitter, kGrainJitter)),
            kGrain * (static_cast<double>(j) + random.uniform(-kGrainJitter, kGrainJitter))};
  }
  [[nodiscard]] Point2 centre(std::int64_t i, std::int64_t j) const noexcept {
    core::RandomStream random = stream(i, j);
    return centre(i, j, random);
  }
};

/// Adds the lattice points of grain (i, j) that lie in its Voronoi cell, in the region, and have room.
void fill_grain(const PlanarRegion& region, const Grains& grains, std::int64_t i, std::int64_t j,
                double spacing, NearbyPoints& nearby) {
  core::RandomStream random = grains.stream(i, j);
  const Point2 centre = grains.centre(i, j, random);
  // No point of a cell is farther from its seed than this: some seed is within (0.5 + jitter) sqrt(2).
  constexpr double reach = kGrain * (0.5 + kGrainJitter) * std::numbers::sqrt2;
  if (region.depth(centre) < -reach) return;
  std::vector<Point2> others;
  for (std::int64_t dj = -2; dj <= 2; ++dj)
    for (std::int64_t di = -2; di <= 2; ++di)
      if (di != 0 || dj != 0) others.push_back(grains.centre(i + di, j + dj));
  std::ranges::sort(others, {}, [&](Point2 o) { return distance2(o, centre); });  // near ones refuse first

  const Point2 along = unit_circle(random.uniform());
  const double offset_x = random.uniform(), offset_y = random.uniform();
  const auto rows = static_cast<int>(std::ceil(reach / (spacing * kRowHeight))) + 1;
  for (int row = -rows; row <= rows; ++row) {
    const double y = spacing * kRowHeight * (row + offset_y);
    if (std::abs(y) > reach) continue;
    const double half = std::sqrt(reach * reach - y * y);
    const double shift = spacing * (offset_x + (row % 2 != 0 ? 0.5 : 0.0));
    for (double x = shift + spacing * std::ceil((-half - shift) / spacing); x <= half; x += spacing) {
      const Point2 p{centre.x + x * along.x - y * along.y, centre.y + x * along.y + y * along.x};
      if (region.depth(p) < kBorderGap) continue;
      const double own = x * x + y * y;
      if (std::ranges::any_of(others, [&](Point2 o) { return distance2(o, p) < own; })) continue;
      if (!nearby.crowded(p)) nearby.add(p);
    }
  }
}

/// Equally spaced points on a circle, counter-clockwise from a random phase; at least six.
void add_circle(double radius, core::RandomStream& random, NearbyPoints& nearby) {
  const double count = std::max(6.0, std::round(2.0 * std::numbers::pi * radius));
  const double phase = random.uniform();
  for (double i = 0.0; i < count; i += 1.0) {
    const Point2 on_unit_circle = unit_circle((i + phase) / count);
    nearby.add({radius * on_unit_circle.x, radius * on_unit_circle.y});
  }
}

/// The border of the rectangle, counter-clockwise from its lower left corner, equally spaced along each side.
void add_rectangle(double a, double b, NearbyPoints& nearby) {
  const double nx = std::max(1.0, std::round(2.0 * a)), ny = std::max(1.0, std::round(2.0 * b));
  for (double i = 0.0; i < nx; i += 1.0) nearby.add({-a + 2.0 * a * (i / nx), -b});
  for (double i = 0.0; i < ny; i += 1.0) nearby.add({a, -b + 2.0 * b * (i / ny)});
  for (double i = 0.0; i < nx; i += 1.0) nearby.add({a - 2.0 * a * (i / nx), b});
  for (double i = 0.0; i < ny; i += 1.0) nearby.add({-a, b - 2.0 * b * (i / ny)});
}

/// Position along the Hilbert curve through a 2^16 by 2^16 grid [Wikipedia, "Hilbert curve", xy2d].
std::uint64_t hilbert_key(std::uint32_t x, std::uint32_t y) noexcept {
  std::uint64_t key = 0;
  for (std::uint32_t s = 1U << 15; s > 0; s >>= 1) {
    const std::uint32_t rx = (x & s) != 0, ry = (y & s) != 0;
    key = 4 * key + ((3 * rx) ^ ry);
    if (ry == 0) {
      if (rx == 1) x = 0xffffU - x, y = 0xffffU - y;
      std::swap(x, y);
    }
  }
  return key;
}

/// Brings all points but the last into the order of the Hilbert curve; returns the new number of each.
std::vector<Index> sort_along_curve(std::vector<Point2>& points, std::vector<char>& is_free,
                                    double half_width) {
  const std::size_t count = points.size() - 1;
  const auto coordinate = [&](double x) {
    return static_cast<std::uint32_t>(std::clamp((x / half_width + 1.0) * 32767.5, 0.0, 65535.0));
  };
  std::vector<std::pair<std::uint64_t, Index>> keys(count);
  for (std::size_t i = 0; i < count; ++i)
    keys[i] = {hilbert_key(coordinate(points[i].x), coordinate(points[i].y)), static_cast<Index>(i)};
  std::ranges::sort(keys);
  const std::vector<Point2> old_points = points;
  const std::vector<char> old_free = is_free;
  std::vector<Index> new_number(points.size(), static_cast<Index>(count));
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t from = at(keys[i].second);
    points[i] = old_points[from];
    is_free[i] = old_free[from];
    new_number[from] = static_cast<Index>(i);
  }
  return new_number;
}

}  // namespace

double PlanarRegion::depth(Point2 p) const noexcept {
  if (is_rectangle()) return std::min(half_length - std::abs(p.x), half_width - std::abs(p.y));
  const double r = std::sqrt(p.x * p.x + p.y * p.y);
  return inner > 0.0 ? std::min(r - inner, outer - r) : outer - r;
}

Point2 unit_circle(double turn) noexcept {
  const double quarters = std::floor(4.0 * turn + 0.5);
  const double x = (turn - 0.25 * quarters) * (2.0 * std::numbers::pi);  // within a quarter of pi
  const double x2 = x * x;
  double s = 1.0, c = 1.0;
  // Taylor to x^17 and x^16, by Horner: the next terms are below 3e-18.
  for (double n = 16.0; n >= 2.0; n -= 2.0) s = 1.0 - s * x2 / (n * (n + 1.0));
  for (double n = 16.0; n >= 2.0; n -= 2.0) c = 1.0 - c * x2 / (n * (n - 1.0));
  s *= x;
  switch (static_cast<int>(quarters) & 3) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    default:
      return {s, -c};
  }
}

PlanarSample sample_region(const PlanarRegion& region, std::uint64_t seed) {
  const double a = region.is_rectangle() ? region.half_length : region.outer;
  const double b = region.is_rectangle() ? region.half_width : region.outer;
  const double area =
      region.is_rectangle() ? 4.0 * a * b : std::numbers::pi * (a * a - region.inner * region.inner);
  const double border = region.is_rectangle() ? 4.0 * (a + b) : 2.0 * std::numbers::pi * (a + region.inner);
  const double spacing = lattice_spacing(border, area);
  PlanarSample sample;
  const double expected = area / (kRowHeight * spacing * spacing) + border;
  sample.points.reserve(static_cast<std::size_t>(1.1 * expected) + 64);
  NearbyPoints nearby(sample.points, expected);
  core::RandomStream random(seed, border_stream);
  if (region.is_rectangle()) {
    add_rectangle(a, b, nearby);
  } else {
    add_circle(region.outer, random, nearby);
  }
  const auto outer_count = static_cast<Index>(sample.points.size());
  if (region.inner > 0.0) add_circle(region.inner, random, nearby);
  const std::size_t border_count = sample.points.size();

  nearby.add({0.0, 0.0});
  const Grains grains{seed};
  const auto nx = static_cast<std::int64_t>(std::ceil(a / kGrain)) + 1;
  const auto ny = static_cast<std::int64_t>(std::ceil(b / kGrain)) + 1;
  for (std::int64_t j = -ny; j <= ny; ++j)
    for (std::int64_t i = -nx; i <= nx; ++i) fill_grain(region, grains, i, j, spacing, nearby);

  std::swap(sample.points[border_count], sample.points.back());
  sample.is_free.assign(sample.points.size(), 1);
  std::fill_n(sample.is_free.begin(), border_count, char{0});
  if (region.inner > 0.0) sample.is_free.back() = 0;
  const std::vector<Index> new_number = sort_along_curve(sample.points, sample.is_free, std::max(a, b));
  for (Index i = 0; i < outer_count; ++i) sample.polygon.push_back(new_number[at(i)]);
  sample.centre = static_cast<Index>(sample.points.size()) - 1;
  return sample;
}

std::vector<Index> insertion_order(Index count, std::uint64_t seed) {
  constexpr int kRounds = 16;
  core::RandomStream random(seed, order_stream);
  std::vector<std::vector<Index>> rounds(kRounds);
  for (Index i = 0; i < count; ++i)
    rounds[at(std::min(kRounds - 1, std::countr_zero(random.bits())))].push_back(i);
  std::vector<Index> order;
  order.reserve(at(count));
  for (auto round = rounds.rbegin(); round != rounds.rend(); ++round)
    order.insert(order.end(), round->begin(), round->end());
  return order;
}

}  // namespace abradem::geometry
