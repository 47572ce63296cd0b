// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/analysis/contour.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "abradem/core/error.h"

namespace abradem::analysis {

namespace {

using geometry::Index;
using geometry::TriangleMesh;

constexpr double kPi = std::numbers::pi;

std::size_t at(Index i) noexcept { return static_cast<std::size_t>(i); }

/// In-plane coordinates (x, y) and displacement h of points; the axis looks at the reader.
struct Frame {
  Vec3 origin, u, v, axis;
};

/// The plane of one section, in frame coordinates: n . (x, y) = offset, with e . (x, y) the coordinate along
/// it.
struct Line {
  double nx, ny, offset, ex, ey;
};

struct Corner {
  Index vertex;
  double x, y, h;
};
using Corners = std::array<Corner, 3>;

struct Sections {
  std::vector<Line> lines;
  Band kept;  ///< of the coordinate along the section
};

/// Which sections a triangle may meet; may name too many, never too few. `first + count` may pass the last
/// section where sections are periodic.
struct SectionRange {
  int first = 0, count = 0;
};

void check(const TriangleMesh& mesh, std::span<const Vec3> reference) {
  if (reference.size() != mesh.vertices.size())
    throw InputError(fmt::format("sections: {} reference positions for {} vertices; give one per vertex",
                                 reference.size(), mesh.vertices.size()));
}

void check(const TriangleMesh& mesh, Index triangle) {
  if (triangle < 0 || triangle >= mesh.triangle_count())
    throw InputError(
        fmt::format("sections: candidate triangle {} of a mesh with {} triangles; indices start at 0",
                    triangle, mesh.triangle_count()));
}

void check(const Band& band, const char* what) {
  if (!(band.low <= band.high))
    throw InputError(
        fmt::format("sections: {} band is [{} m, {} m]; the low end must not exceed the high end", what,
                    band.low, band.high));
}

void check_count(int count) {
  if (count < 1) throw InputError(fmt::format("sections: count is {}; at least 1 is needed", count));
}

Vec3 unit(const Vec3& a, const char* what) {
  const double length = norm(a);
  if (!(length > 0.0) || !std::isfinite(length))
    throw InputError(fmt::format("sections: {} is ({}, {}, {}); a finite, non-zero vector is needed", what,
                                 a.x, a.y, a.z));
  return a / length;
}

/// Frame with u along the part of `toward` that is perpendicular to the axis.
Frame make_frame(const Vec3& axis, const Vec3& toward, const Vec3& origin, const char* what) {
  const Vec3 a = unit(axis, "the axis");
  const Vec3 t = unit(toward, what);
  const Vec3 across = t - dot(t, a) * a;
  if (norm(across) < 1e-6)  // less than 0.2 arc seconds from the axis: the direction would be round-off
    throw InputError(fmt::format("sections: {} is parallel to the axis; give one across it", what));
  const Vec3 u = normalized(across);
  return {origin, u, cross(a, u), a};
}

Corner corner(const TriangleMesh& mesh, std::span<const Vec3> reference, const Frame& frame, Index vertex) {
  const Vec3& x = mesh.vertices[at(vertex)];
  const Vec3 r = x - frame.origin;
  return {vertex, dot(r, frame.u), dot(r, frame.v), dot(x - reference[at(vertex)], frame.axis)};
}

/// Where the edge a-b meets the line. The ends are taken in the order of their vertex numbers, so that both
/// triangles of the edge give the same bits and the point is found twice, not two points.
ProfilePoint crossing(const Corner* a, const Corner* b, double f_a, double f_b, const Line& line) noexcept {
  if (a->vertex > b->vertex) std::swap(a, b), std::swap(f_a, f_b);
  const double s = f_a / (f_a - f_b);
  const double t_a = line.ex * a->x + line.ey * a->y;
  const double t_b = line.ex * b->x + line.ey * b->y;
  return {t_a + s * (t_b - t_a), a->h + s * (b->h - a->h)};
}

ProfilePoint point_at(double radius, const ProfilePoint& a, const ProfilePoint& b) noexcept {
  return {radius, a.height + (radius - a.radius) / (b.radius - a.radius) * (b.height - a.height)};
}

/// Appends the part of the triangle's section that lies in the kept band.
void cut_triangle(const Corners& c, const Line& line, const Band& kept, std::vector<ProfilePoint>& out) {
  std::array<double, 3> f;
  for (std::size_t k = 0; k < 3; ++k) f[k] = line.nx * c[k].x + line.ny * c[k].y - line.offset;
  // Half-open sides (0 belongs to the upper one): a line through a vertex meets two edges, as any other does.
  std::array<ProfilePoint, 3> ends;
  std::size_t found = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t l = (k + 1) % 3;
    if ((f[k] >= 0.0) != (f[l] >= 0.0)) ends[found++] = crossing(&c[k], &c[l], f[k], f[l], line);
  }
  if (found != 2) return;
  ProfilePoint a = ends[0], b = ends[1];
  if (a.radius > b.radius) std::swap(a, b);
  if (b.radius < kept.low || a.radius > kept.high) return;
  const ProfilePoint whole_a = a, whole_b = b;
  if (a.radius < kept.low) a = point_at(kept.low, whole_a, whole_b);
  if (b.radius > kept.high) b = point_at(kept.high, whole_a, whole_b);
  out.push_back(a);
  out.push_back(b);
}

void order(std::vector<ProfilePoint>& profile) {
  std::ranges::sort(profile, [](const ProfilePoint& a, const ProfilePoint& b) {
    return a.radius < b.radius || (a.radius == b.radius && a.height < b.height);
  });
  profile.erase(std::unique(profile.begin(), profile.end()), profile.end());
}

/// One pass over the candidates: each triangle goes to the sections that `sections_of(corners)` names.
template <typename SectionsOf>
std::vector<Contour> cut_all(const TriangleMesh& mesh, std::span<const Vec3> reference,
                             std::span<const Index> candidates, const Frame& frame, const Sections& sections,
                             SectionsOf sections_of) {
  const auto count = static_cast<int>(sections.lines.size());
  std::vector<Contour> contours(sections.lines.size());
  for (const Index t : candidates) {
    check(mesh, t);
    const geometry::Triangle& v = mesh.triangles[at(t)];
    const Corners corners{corner(mesh, reference, frame, v[0]), corner(mesh, reference, frame, v[1]),
                          corner(mesh, reference, frame, v[2])};
    const SectionRange range = sections_of(corners);
    for (int i = 0; i < range.count; ++i) {
      const auto k = static_cast<std::size_t>((range.first + i) % count);
      cut_triangle(corners, sections.lines[k], sections.kept, contours[k].profile);
    }
  }
  for (Contour& contour : contours) {
    order(contour.profile);
    measure(contour);
  }
  return contours;
}

/// Sections within the angles a triangle can span, seen from the axis: its centroid's angle, plus or minus
/// the angle of the disc around the centroid that holds its corners (asin q <= q pi/2).
SectionRange sections_around(const Corners& c, int count) noexcept {
  const double x = (c[0].x + c[1].x + c[2].x) / 3.0;
  const double y = (c[0].y + c[1].y + c[2].y) / 3.0;
  double reach2 = 0.0;
  for (const Corner& p : c) reach2 = std::max(reach2, (p.x - x) * (p.x - x) + (p.y - y) * (p.y - y));
  const double r2 = x * x + y * y;
  if (!(reach2 < r2)) return {0, count};  // the axis may pass through
  const double half = 0.5 * kPi * std::sqrt(reach2 / r2);
  const double angle = std::atan2(y, x);
  const double per_radian = count / (2.0 * kPi);
  const auto first = static_cast<int>(std::floor((angle - half) * per_radian));
  const auto last = static_cast<int>(std::ceil((angle + half) * per_radian));
  if (last - first + 1 >= count) return {0, count};
  return {(first % count + count) % count, last - first + 1};
}

/// Sections within the range of x the triangle spans; section k lies at low + (k + 1/2) step.
SectionRange sections_along(const Corners& c, double low, double step, int count) noexcept {
  const auto [lowest, highest] = std::minmax({c[0].x, c[1].x, c[2].x});
  const double last_section = count - 1;
  const double first = std::max(0.0, std::floor((lowest - low) / step - 0.5));
  const double last = std::min(last_section, std::ceil((highest - low) / step - 0.5));
  if (!(first <= last)) return {};
  return {static_cast<int>(first), static_cast<int>(last - first) + 1};
}

bool displaced(const TriangleMesh& mesh, std::span<const Vec3> reference, Index vertex) noexcept {
  return mesh.vertices[at(vertex)] != reference[at(vertex)];
}

}  // namespace

Vec3 angle_zero(const Vec3& axis) {
  const Vec3 a = unit(axis, "the axis");
  const Vec3 toward = std::abs(a.x) < 0.9 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
  return normalized(toward - dot(toward, a) * a);
}

std::vector<Index> worn_region(const TriangleMesh& mesh, std::span<const Vec3> reference, int rings) {
  check(mesh, reference);
  if (rings < 0) throw InputError(fmt::format("sections: {} rings around the worn region; 0 or more", rings));
  std::vector<char> marked(mesh.vertices.size());
  for (Index v = 0; v < mesh.vertex_count(); ++v) marked[at(v)] = displaced(mesh, reference, v);
  const auto meets_marked = [&](const geometry::Triangle& t) {
    return marked[at(t[0])] || marked[at(t[1])] || marked[at(t[2])];
  };
  std::vector<Index> region;
  const auto collect = [&] {
    region.clear();
    for (Index t = 0; t < mesh.triangle_count(); ++t)
      if (meets_marked(mesh.triangles[at(t)])) region.push_back(t);
  };
  collect();
  for (int ring = 0; ring < rings; ++ring) {
    for (const Index t : region)
      for (const Index v : mesh.triangles[at(t)]) marked[at(v)] = 1;
    collect();
  }
  return region;
}

std::optional<Band> worn_extent(const TriangleMesh& mesh, std::span<const Vec3> reference,
                                std::span<const Index> candidates, const Vec3& origin,
                                const Vec3& direction) {
  check(mesh, reference);
  const Vec3 along = unit(direction, "the direction");
  Band band{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Index t : candidates) {
    check(mesh, t);
    for (const Index v : mesh.triangles[at(t)]) {
      if (!displaced(mesh, reference, v)) continue;
      const double s = dot(mesh.vertices[at(v)] - origin, along);
      band = {std::min(band.low, s), std::max(band.high, s)};
    }
  }
  if (band.low > band.high) return std::nullopt;
  return band;
}

std::vector<Contour> cut_contours(const TriangleMesh& mesh, std::span<const Vec3> reference,
                                  std::span<const Index> candidates, const RotaryCuts& cuts) {
  check(mesh, reference);
  check_count(cuts.count);
  check(cuts.radii, "radial");
  const Vec3 zero = cuts.zero ? *cuts.zero : angle_zero(cuts.axis);
  const Frame frame = make_frame(cuts.axis, zero, cuts.center, "the direction of angle 0");
  Sections sections{{}, {std::max(0.0, cuts.radii.low), cuts.radii.high}};  // radius >= 0: half-planes
  const auto angle = [&](std::size_t k) { return 2.0 * kPi * static_cast<double>(k) / cuts.count; };
  for (std::size_t k = 0; k < static_cast<std::size_t>(cuts.count); ++k) {
    const double c = std::cos(angle(k)), s = std::sin(angle(k));
    sections.lines.push_back({-s, c, 0.0, c, s});
  }
  std::vector<Contour> contours =
      cut_all(mesh, reference, candidates, frame, sections,
              [&](const Corners& corners) { return sections_around(corners, cuts.count); });
  for (std::size_t k = 0; k < contours.size(); ++k) contours[k].angle = angle(k);
  return contours;
}

std::vector<Contour> cut_contours(const TriangleMesh& mesh, std::span<const Vec3> reference,
                                  std::span<const Index> candidates, const StraightCuts& cuts) {
  check(mesh, reference);
  check_count(cuts.count);
  check(cuts.across, "transverse");
  if (!(cuts.along.low < cuts.along.high) || !std::isfinite(cuts.along.high - cuts.along.low))
    throw InputError(
        fmt::format("sections: the worn length is [{} m, {} m]; a finite, non-empty range is needed",
                    cuts.along.low, cuts.along.high));
  const Frame frame = make_frame(cuts.axis, cuts.direction, cuts.origin, "the sliding direction");
  const double step = (cuts.along.high - cuts.along.low) / cuts.count;
  const auto position = [&](std::size_t k) { return cuts.along.low + (static_cast<double>(k) + 0.5) * step; };
  Sections sections{{}, cuts.across};
  for (std::size_t k = 0; k < static_cast<std::size_t>(cuts.count); ++k)
    sections.lines.push_back({1.0, 0.0, position(k), 0.0, 1.0});
  std::vector<Contour> contours =
      cut_all(mesh, reference, candidates, frame, sections,
              [&](const Corners& c) { return sections_along(c, cuts.along.low, step, cuts.count); });
  for (std::size_t k = 0; k < contours.size(); ++k) contours[k].angle = position(k);
  return contours;
}

void measure(Contour& contour) noexcept {
  contour.depth = deepest_sink(contour.profile);
  contour.width = worn_width(contour.profile);
  contour.displaced_width = displaced_width(contour.profile);
  contour.area = sunk_area(contour.profile);
}

double deepest_sink(std::span<const ProfilePoint> profile) noexcept {
  double depth = 0.0;
  for (const ProfilePoint& p : profile) depth = std::max(depth, -p.height);
  return depth;
}

double sunk_area(std::span<const ProfilePoint> profile) noexcept {
  double area = 0.0;
  for (std::size_t i = 1; i < profile.size(); ++i)
    area -= 0.5 * (profile[i].height + profile[i - 1].height) * (profile[i].radius - profile[i - 1].radius);
  return area == 0.0 ? 0.0 : area;  // no -0 in tables
}

namespace {

/// Area of the polyline's part with sign * height > 0 [m^2], exact.
double area_on(std::span<const ProfilePoint> profile, double sign) noexcept {
  double area = 0.0;
  for (std::size_t i = 1; i < profile.size(); ++i) {
    const double a = sign * profile[i - 1].height, b = sign * profile[i].height;
    const double width = profile[i].radius - profile[i - 1].radius;
    if (a >= 0.0 && b >= 0.0)
      area += 0.5 * (a + b) * width;
    else if (a > 0.0 || b > 0.0)
      area += 0.5 * std::max(a, b) * width * std::max(a, b) / (std::max(a, b) - std::min(a, b));
  }
  return area;
}

}  // namespace

RidgeSummary ridge_summary(std::span<const Contour> contours) noexcept {
  RidgeSummary sum;
  double squares = 0.0, count = 0.0;
  for (const Contour& c : contours) {
    if (c.profile.empty()) continue;
    double highest = 0.0;
    for (const ProfilePoint& p : c.profile) highest = std::max(highest, p.height);
    sum.height_mean += highest;
    squares += highest * highest;
    sum.ridge_area += area_on(c.profile, 1.0);
    sum.groove_area += area_on(c.profile, -1.0);
    count += 1.0;
  }
  if (count == 0.0) return sum;
  for (double* value : {&sum.height_mean, &sum.ridge_area, &sum.groove_area}) *value /= count;
  sum.height_sd = std::sqrt(std::max(0.0, squares / count - sum.height_mean * sum.height_mean));
  return sum;
}

double opening(std::span<const ProfilePoint> profile, double level) noexcept {
  const auto below = [level](const ProfilePoint& p) { return p.height < -level; };
  const auto crossing_of = [level](const ProfilePoint& above, const ProfilePoint& under) {
    const double s = (above.height + level) / (above.height - under.height);
    return above.radius + s * (under.radius - above.radius);
  };
  const auto first = std::ranges::find_if(profile, below);
  if (first == profile.end()) return 0.0;
  auto last = std::prev(profile.end());
  while (!below(*last)) --last;
  const double from = first == profile.begin() ? first->radius : crossing_of(*std::prev(first), *first);
  const double to = std::next(last) == profile.end() ? last->radius : crossing_of(*std::next(last), *last);
  return to - from;
}

double width_level(double depth) noexcept { return std::max(0.01 * depth, 0.5e-6); }

double worn_width(std::span<const ProfilePoint> profile) noexcept {
  return opening(profile, width_level(deepest_sink(profile)));
}

double displaced_width(std::span<const ProfilePoint> profile) noexcept {
  const auto moved = [](const ProfilePoint& p) { return p.height != 0.0; };
  const auto first = std::ranges::find_if(profile, moved);
  if (first == profile.end()) return 0.0;
  auto last = std::prev(profile.end());
  while (!moved(*last)) --last;
  const double from = first == profile.begin() ? first->radius : std::prev(first)->radius;
  const double to = std::next(last) == profile.end() ? last->radius : std::next(last)->radius;
  return to - from;
}

}  // namespace abradem::analysis
