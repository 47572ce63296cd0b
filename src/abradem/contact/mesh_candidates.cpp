// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/contact/mesh_candidates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace abradem::contact {

namespace {

using geometry::TriangleMesh;

std::size_t at(Index i) noexcept { return static_cast<std::size_t>(i); }

std::size_t padded(std::size_t n) noexcept {
  return (n + MeshCandidates::kLanes - 1) / MeshCandidates::kLanes * MeshCandidates::kLanes;
}

/// What is left of an offset across the slide once the nearest point of the slide is taken as origin.
inline Vec3 beside(const Vec3& slide, const Vec3& offset) noexcept {
  const double length2 = norm2(slide);
  return length2 > 0.0 ? offset - std::clamp(dot(offset, slide) / length2, 0.0, 1.0) * slide : offset;
}

/// What a ball of the given reach can meet while its centre stays within the skin around c.
struct Sweep {
  Vec3 c, axis;
  double reach;
  CandidateSkin skin;

  /// A box around all that can be met of a surface: the ball's, cut down to the cap that reaches into the
  /// surface's own box.
  [[nodiscard]] geometry::BoundingBox box(const SurfaceView& surface) const noexcept {
    const double r = reach + std::hypot(skin.tangential, skin.normal) + surface.displaced;
    const Vec3 d{surface.displaced, surface.displaced, surface.displaced};
    const geometry::BoundingBox mesh = surface.grid.box();
    const std::array<Vec3, 2> centres{c, c + skin.slide};
    const geometry::BoundingBox way = geometry::bounding_box(centres);
    const geometry::BoundingBox ball =
        clip({way.low - Vec3{r, r, r}, way.high + Vec3{r, r, r}}, {mesh.low - d, mesh.high + d});
    // Nearest that the surface comes along the axis: there the cap is widest.
    double nearest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 8; ++k) {
      const Vec3 corner{(k & 1) != 0 ? ball.high.x : ball.low.x, (k & 2) != 0 ? ball.high.y : ball.low.y,
                        (k & 4) != 0 ? ball.high.z : ball.low.z};
      nearest = std::min(nearest, dot(corner - c, axis));
    }
    nearest -= skin.normal;
    if (nearest <= 0.0) return ball;
    const double wide =
        std::sqrt(std::max(0.0, reach * reach - nearest * nearest)) + skin.tangential + surface.displaced;
    const Vec3 from = nearest * axis, to = r * axis, w{wide, wide, wide};
    const std::array<Vec3, 4> ends{c + from, c + to, c + skin.slide + from, c + skin.slide + to};
    const geometry::BoundingBox line = geometry::bounding_box(ends);
    return clip(ball, {line.low - w, line.high + w});
  }

  [[nodiscard]] static geometry::BoundingBox clip(const geometry::BoundingBox& a,
                                                  const geometry::BoundingBox& b) noexcept {
    return {{std::max(a.low.x, b.low.x), std::max(a.low.y, b.low.y), std::max(a.low.z, b.low.z)},
            {std::min(a.high.x, b.high.x), std::min(a.high.y, b.high.y), std::min(a.high.z, b.high.z)}};
  }

  /// Distance of `centre` from the axis on its way, when something within `radius` of it across the axis and
  /// `half_depth` along the axis can be met.
  [[nodiscard]] std::optional<double> may_meet(const Vec3& centre, double radius,
                                               double half_depth) const noexcept {
    const Vec3 offset = centre - c;
    const double along = dot(offset, axis);
    const double across = norm(beside(skin.slide, offset - along * axis));
    const double a = std::max(0.0, across - radius - skin.tangential);
    const double b = std::max(0.0, std::abs(along) - half_depth - skin.normal);
    return a * a + b * b < reach * reach ? std::optional(across) : std::nullopt;
  }

  /// The same of a triangle.
  [[nodiscard]] std::optional<double> meets(const TriangleMesh& mesh, Index t) const noexcept {
    const geometry::Triangle& v = mesh.triangles[at(t)];
    const Vec3 &p0 = mesh.vertices[at(v[0])], &p1 = mesh.vertices[at(v[1])], &p2 = mesh.vertices[at(v[2])];
    const Vec3 centroid = (p0 + p1 + p2) * (1.0 / 3.0);
    const Vec3 q0 = p0 - centroid, q1 = p1 - centroid, q2 = p2 - centroid;
    const double radius = std::sqrt(std::max({norm2(q0), norm2(q1), norm2(q2)}));
    const double half_depth =
        std::max({std::abs(dot(q0, axis)), std::abs(dot(q1, axis)), std::abs(dot(q2, axis))});
    return may_meet(centroid, radius, half_depth);
  }
};

}  // namespace

bool MeshCandidates::stale(const SurfaceView& surface, const Vec3& c, double reach) const noexcept {
  const Vec3 moved = c - built_at_;
  const double along = dot(moved, built_axis_);
  const double across2 = norm2(beside(built_skin_.slide, moved - along * built_axis_));
  const double wear = surface.odometer - odometer_at_gather_;
  return !gathered_ || reach > built_reach_ || std::abs(along) + wear > built_skin_.normal ||
         across2 > built_skin_.tangential * built_skin_.tangential;
}

void MeshCandidates::update(const SurfaceView& surface, const Vec3& c, const Vec3& axis, double reach,
                            const CandidateSkin& skin) {
  if (stale(surface, c, reach)) {
    gather(surface, c, axis, reach, skin);
  } else if (revision_ != surface.revision) {
    fetch_positions(surface.mesh);
    // Positions are always the mesh's own; areas and lengths may lag behind by half a per cent of an edge,
    // which changes a normal force by about 1e-5.
    constexpr double kShapeTolerance = 5e-3;
    if (surface.odometer - odometer_at_measure_ > kShapeTolerance * shortest_) {
      measure_triangles();
      odometer_at_measure_ = surface.odometer;
    }
    revision_ = surface.revision;
  }
}

void MeshCandidates::gather(const SurfaceView& surface, const Vec3& c, const Vec3& axis, double reach,
                            const CandidateSkin& skin) {
  const TriangleMesh& mesh = surface.mesh;
  // One for each thread and not for each sphere: there may be thousands beside a large mesh.
  static thread_local std::vector<std::int32_t> local_of;  // local number of a mesh vertex, or -1
  if (local_of.size() < mesh.vertices.size()) local_of.resize(mesh.vertices.size(), -1);
  // A little more than asked for, so that a reach that wavers does not gather every step.
  built_reach_ = reach + 0.25 * skin.normal;
  // With no axis every direction is as likely: the whole skin counts as both.
  const double whole = std::hypot(skin.tangential, skin.normal);
  const Sweep sweep{c, axis, built_reach_, axis == Vec3{} ? CandidateSkin{whole, 0.0, skin.slide} : skin};
  found_.clear();
  const auto [low, high] = sweep.box(surface);
  double furthest = 0.0;
  surface.grid.visit_near(
      low, high,
      [&](const Vec3& centre, double r) {
        return sweep.may_meet(centre, r + surface.displaced, r + surface.displaced).has_value();
      },
      [&](Index t) {
        if (const auto distance = sweep.meets(mesh, t)) {
          found_.emplace_back(*distance, t);
          furthest = std::max(furthest, *distance);
        }
      });
  order_outwards(furthest);

  node.clear();
  triangle.clear();
  v0.clear(), v1.clear(), v2.clear();
  for (const Index t : ordered_) {
    triangle.push_back(t);
    for (std::size_t k = 0; k < 3; ++k) {
      const Index v = mesh.triangles[at(t)][k];
      std::int32_t& local = local_of[at(v)];
      if (local < 0) {
        local = static_cast<std::int32_t>(node.size());
        node.push_back(v);
      }
      (k == 0 ? v0 : k == 1 ? v1 : v2).push_back(local);
    }
  }
  for (const Index v : node) local_of[at(v)] = -1;

  const std::size_t nodes = padded(node.size()), triangles = padded(triangle.size());
  constexpr double far_away = 1e3;  // [m]: squares stay finite and no ball reaches it
  for (auto* array : {&x, &y, &z}) array->assign(nodes, far_away);
  for (auto* array : {&node_area, &bx, &by, &bz}) array->resize(nodes);
  for (auto* array : {&v0, &v1, &v2}) array->resize(triangles, 0);
  for (auto* array : {&ax, &ay, &az, &plane, &l01, &l12, &l20, &longest, &area})
    array->assign(triangles, 0.0);
  fetch_positions(mesh);
  measure_triangles();
  link_nodes();
  place_mean_plane(c, reach);

  gathered_ = true;
  built_at_ = c;
  built_axis_ = axis;
  built_skin_ = skin;
  odometer_at_gather_ = odometer_at_measure_ = surface.odometer;
  revision_ = surface.revision;
  ++gatherings_;
}

/// From the middle outwards: what is inside the ball comes first, what its rim cuts next, what is outside
/// last, so that loops can stop early and their branches are easy to foresee. Thirty-two rings are order
/// enough.
void MeshCandidates::order_outwards(double furthest) {
  constexpr std::size_t kRings = 32;
  const double scale = furthest > 0.0 ? kRings / furthest : 0.0;
  const auto ring = [&](double distance) {
    return std::min(kRings - 1, static_cast<std::size_t>(distance * scale));
  };
  std::array<std::size_t, kRings + 1> start{};
  for (const auto& [distance, t] : found_) ++start[ring(distance) + 1];
  for (std::size_t r = 0; r < kRings; ++r) start[r + 1] += start[r];
  ordered_.resize(found_.size());
  for (const auto& [distance, t] : found_) ordered_[start[ring(distance)]++] = t;
}

void MeshCandidates::link_nodes() {
  star_start.assign(node.size() + 1, 0);
  const auto for_each_corner = [this](auto&& visit) {
    for (std::size_t t = 0; t < triangle.size(); ++t)
      for (const std::int32_t v : {v0[t], v1[t], v2[t]})
        visit(static_cast<std::size_t>(v), static_cast<std::int32_t>(t));
  };
  for_each_corner([this](std::size_t v, std::int32_t) { ++star_start[v + 1]; });
  for (std::size_t v = 0; v < node.size(); ++v) star_start[v + 1] += star_start[v];
  star.resize(3 * triangle.size());
  for_each_corner(
      [this](std::size_t v, std::int32_t t) { star[static_cast<std::size_t>(star_start[v]++)] = t; });
  for (std::size_t v = node.size(); v > 0; --v) star_start[v] = star_start[v - 1];
  star_start[0] = 0;
}

/// Through the overlap's centre of weight: a surface worn a little deviates from the plane as little as it
/// can.
void MeshCandidates::place_mean_plane(const Vec3& c, double reach) noexcept {
  double weight = 0.0;
  Vec3 sum;
  for (std::size_t i = 0; i < node.size(); ++i) {
    const Vec3 offset = node_position(i) - c;
    const double w = std::max(0.0, reach * reach - norm2(offset)) * node_area[i];
    weight += w;
    sum += w * offset;
  }
  mean_point = weight > 0.0 ? c + sum / weight : c;
}

void MeshCandidates::fetch_positions(const TriangleMesh& mesh) noexcept {
  for (std::size_t i = 0; i < node.size(); ++i) {
    const Vec3& p = mesh.vertices[at(node[i])];
    x[i] = p.x;
    y[i] = p.y;
    z[i] = p.z;
  }
}

void MeshCandidates::measure_triangles() noexcept {
  Vec3 sum;
  longest_edge2 = 0.0;
  for (auto* array : {&node_area, &bx, &by, &bz}) std::ranges::fill(*array, 0.0);
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < triangle.size(); ++t) {
    const Vec3 p0 = node_position(static_cast<std::size_t>(v0[t]));
    const Vec3 e01 = node_position(static_cast<std::size_t>(v1[t])) - p0;
    const Vec3 e02 = node_position(static_cast<std::size_t>(v2[t])) - p0;
    const Vec3 a = 0.5 * cross(e01, e02);
    ax[t] = a.x, ay[t] = a.y, az[t] = a.z;
    area[t] = norm(a);
    plane[t] = dot(a, p0);
    const Vec3 third = a * (1.0 / 3.0);
    for (const std::int32_t v : {v0[t], v1[t], v2[t]}) {
      const auto i = static_cast<std::size_t>(v);
      node_area[i] += area[t] * (1.0 / 3.0);
      bx[i] += third.x, by[i] += third.y, bz[i] += third.z;
    }
    l01[t] = norm2(e01);
    l20[t] = norm2(e02);
    l12[t] = norm2(e02 - e01);
    longest[t] = std::max({l01[t], l12[t], l20[t]});
    longest_edge2 = std::max(longest_edge2, longest[t]);
    shortest = std::min({shortest, l01[t], l12[t], l20[t]});
    sum += a;
  }
  shortest_ = std::sqrt(shortest);
  const double total = norm(sum);
  mean_normal = normalized(sum);
  constexpr double kCos10Degrees = 0.984807753012208;
  nearly_flat_ = total > 0.0;
  for (std::size_t t = 0; t < triangle.size() && nearly_flat_; ++t)
    nearly_flat_ = ax[t] * sum.x + ay[t] * sum.y + az[t] * sum.z >= kCos10Degrees * area[t] * total;
}

}  // namespace abradem::contact
