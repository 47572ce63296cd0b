// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/contact/mesh_candidates.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>

#include "abradem/contact/candidate_kernels.h"
#include "abradem/core/simd.h"

namespace abradem::contact {

namespace {

std::uint64_t next_stamp() noexcept {
  static std::atomic<std::uint64_t> last{0};
  return last.fetch_add(1, std::memory_order_relaxed) + 1;
}

using geometry::TriangleMesh;

constexpr double kShapeTolerance = 5e-3;  // of an edge: wear since the triangles were measured

std::size_t at(Index i) noexcept { return static_cast<std::size_t>(i); }

ABRADEM_INLINE double larger(double a, double b) { return a > b ? a : b; }
ABRADEM_INLINE double smaller(double a, double b) { return a < b ? a : b; }

std::size_t padded(std::size_t n) noexcept {
  return (n + MeshCandidates::kLanes - 1) / MeshCandidates::kLanes * MeshCandidates::kLanes;
}

/// Arrays of `count` one after another in a store.
template <typename T>
void lay_out(std::initializer_list<std::span<T>*> arrays, core::PooledVector<T>& store,
             std::size_t count) noexcept {
  std::size_t from = 0;
  for (std::span<T>* array : arrays) {
    *array = std::span(store).subspan(from, count);
    from += count;
  }
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

  /// Can something be met in the box centre +- half, worn by up to `displaced`?
  [[nodiscard]] bool may_meet(const Vec3& centre, const Vec3& half, double displaced) const noexcept {
    const Vec3 offset = centre - c;
    const double along = dot(offset, axis);
    const double across = norm(beside(skin.slide, offset - along * axis));
    const double half_depth =
        std::abs(half.x * axis.x) + std::abs(half.y * axis.y) + std::abs(half.z * axis.z) + displaced;
    const double a = std::max(0.0, across - norm(half) - displaced - skin.tangential);
    const double b = std::max(0.0, std::abs(along) - half_depth - skin.normal);
    return a * a + b * b < reach * reach;
  }
};

/// The same of triangles: across[k] becomes the distance of the centroid from the axis on its way, or -1
/// where triangle which[k] cannot be met.
ABRADEM_DISPATCH void meet_triangles(const Sweep& sweep, const TriangleMesh& mesh,
                                     std::span<const Index> which, double* __restrict across) noexcept {
  const Index* __restrict triangle = which.data();
  const Index* __restrict corner = mesh.triangles.data()->data();
  const double* __restrict xyz = &mesh.vertices.data()->x;
  // Plain numbers: clang 16 cannot take structured bindings into an OpenMP loop.
  const double cx = sweep.c.x, cy = sweep.c.y, cz = sweep.c.z;
  const double nx = sweep.axis.x, ny = sweep.axis.y, nz = sweep.axis.z;
  const double sx = sweep.skin.slide.x, sy = sweep.skin.slide.y, sz = sweep.skin.slide.z;
  const double slide2 = norm2(sweep.skin.slide), inverse = slide2 > 0.0 ? 1.0 / slide2 : 0.0;
  const double tangential = sweep.skin.tangential, normal = sweep.skin.normal;
  const double reach2 = sweep.reach * sweep.reach;
#pragma omp simd
  for (std::size_t k = 0; k < which.size(); ++k) {
    const Index first = 3 * triangle[k];
    const Index i0 = 3 * corner[first], i1 = 3 * corner[first + 1], i2 = 3 * corner[first + 2];
    const double x0 = xyz[i0] - cx, y0 = xyz[i0 + 1] - cy, z0 = xyz[i0 + 2] - cz;
    const double x1 = xyz[i1] - cx, y1 = xyz[i1 + 1] - cy, z1 = xyz[i1 + 2] - cz;
    const double x2 = xyz[i2] - cx, y2 = xyz[i2 + 1] - cy, z2 = xyz[i2 + 2] - cz;
    const double x = (x0 + x1 + x2) / 3.0, y = (y0 + y1 + y2) / 3.0, z = (z0 + z1 + z2) / 3.0;
    // The triangle as seen from its centroid: a radius, and a half depth along the axis.
    const double h = x * nx + y * ny + z * nz;
    const double d0 = std::abs(x0 * nx + y0 * ny + z0 * nz - h),
                 d1 = std::abs(x1 * nx + y1 * ny + z1 * nz - h),
                 d2 = std::abs(x2 * nx + y2 * ny + z2 * nz - h);
    const auto square = [](double a, double b, double c) { return a * a + b * b + c * c; };
    const double r0 = square(x0 - x, y0 - y, z0 - z), r1 = square(x1 - x, y1 - y, z1 - z),
                 r2 = square(x2 - x, y2 - y, z2 - z);
    const double radius = std::sqrt(larger(larger(r0, r1), r2)), half_depth = larger(larger(d0, d1), d2);
    // As in may_meet.
    const double ox = x - h * nx, oy = y - h * ny, oz = z - h * nz;
    const double way = smaller(larger((ox * sx + oy * sy + oz * sz) * inverse, 0.0), 1.0);
    const double distance = std::sqrt(square(ox - way * sx, oy - way * sy, oz - way * sz));
    const double a = larger(0.0, distance - radius - tangential);
    const double b = larger(0.0, std::abs(h) - half_depth - normal);
    across[k] = a * a + b * b < reach2 ? distance : -1.0;
  }
}

}  // namespace

void CandidateTriangle::follow(const TriangleMesh& mesh) noexcept {
  for (std::size_t k = 0; k < 3; ++k) corner[k] = mesh.vertices[at(vertex[k])];
  const Vec3 e = corner[1] - corner[0], f = corner[2] - corner[0];
  normal = 0.5 * cross(e, f);
  area = norm(normal);
  longest = larger(larger(norm2(e), norm2(f - e)), norm2(f));
}

CandidateTriangle MeshCandidates::triangle_at(std::size_t t) const noexcept {
  const auto i0 = static_cast<std::size_t>(v0[t]), i1 = static_cast<std::size_t>(v1[t]),
             i2 = static_cast<std::size_t>(v2[t]);
  return {.corner = {node_position(i0), node_position(i1), node_position(i2)},
          .normal = {ax[t], ay[t], az[t]},
          .area = area[t],
          .longest = longest[t],
          .vertex = {node[i0], node[i1], node[i2]},
          .triangle = triangle[t],
          .local = static_cast<std::int32_t>(t)};
}

bool MeshCandidates::stale(const SurfaceView& surface, const Vec3& c, double reach) const noexcept {
  const Vec3 moved = c - built_at_;
  const double along = dot(moved, built_axis_);
  const double across2 = norm2(beside(built_skin_.slide, moved - along * built_axis_));
  const double wear = surface.odometer - odometer_at_gather_;
  return !gathered_ || reach > built_reach_ || std::abs(along) + wear > built_skin_.normal ||
         across2 > built_skin_.tangential * built_skin_.tangential;
}

double MeshCandidates::skin_left(const Vec3& c) const noexcept {
  const Vec3 moved = c - built_at_;
  const double along = dot(moved, built_axis_), wear = odometer_ - odometer_at_gather_;
  const double across = norm(beside(built_skin_.slide, moved - along * built_axis_));
  return std::min(built_skin_.normal - std::abs(along) - wear, built_skin_.tangential - across);
}

void MeshCandidates::update(const SurfaceView& surface, const Vec3& c, const Vec3& axis, double reach,
                            const CandidateSkin& skin, bool to_the_bit) {
  if (stale(surface, c, reach)) {
    gather(surface, c, axis, reach, skin);
  } else if (revision_ != surface.revision) {
    fetch_positions(surface.mesh);
    // Positions are always the mesh's own; areas and lengths may lag behind by half a per cent of an edge,
    // which changes a normal force by about 1e-5.
    if (to_the_bit || surface.odometer - odometer_at_measure_ > kShapeTolerance * shortest_) {
      measure_triangles();
      bound_depth();
      odometer_at_measure_ = surface.odometer;
    }
    revision_ = surface.revision;
  }
  odometer_ = surface.odometer;
}

void MeshCandidates::gather(const SurfaceView& surface, const Vec3& c, const Vec3& axis, double reach,
                            const CandidateSkin& skin) {
  const TriangleMesh& mesh = surface.mesh;
  // A little more than asked for, so that a reach that wavers does not gather every step.
  built_reach_ = reach + 0.25 * skin.normal;
  // With no axis every direction is as likely: the whole skin counts as both.
  const double whole = std::hypot(skin.tangential, skin.normal);
  const Sweep sweep{c, axis, built_reach_, axis == Vec3{} ? CandidateSkin{whole, 0.0, skin.slide} : skin};
  near_.clear();
  const auto [low, high] = sweep.box(surface);
  surface.grid.visit_near(
      low, high,
      [&](const Vec3& centre, const Vec3& half) { return sweep.may_meet(centre, half, surface.displaced); },
      [&](Index t) { near_.push_back(t); });
  across_.resize(near_.size());
  meet_triangles(sweep, mesh, near_, across_.data());
  order_outwards();
  number_nodes(mesh);
  allocate();
  fetch_positions(mesh);
  measure_triangles();
  link_nodes();
  place_mean_plane(c, reach);
  bound_depth();

  gathered_ = true;
  built_at_ = c;
  built_axis_ = axis;
  built_skin_ = skin;
  odometer_at_gather_ = odometer_at_measure_ = surface.odometer;
  longest_edge2_at_gather_ = longest_edge2;
  revision_ = surface.revision;
  ++gatherings_;
  stamp_ = next_stamp();
}

bool MeshCandidates::restore(const TriangleMesh& mesh) {
  if (!std::ranges::all_of(triangle, [&](Index t) { return t >= 0 && t < mesh.triangle_count(); }))
    return false;
  number_nodes(mesh);
  if (measured_.size() != node.size()) return false;
  allocate();
  for (std::size_t i = 0; i < node.size(); ++i)
    x[i] = measured_[i].x, y[i] = measured_[i].y, z[i] = measured_[i].z;
  measure_triangles();
  link_nodes();
  bound_depth();
  // Where wear has moved the surface since the last fetch, the next update fetches again.
  fetch_positions(mesh);
  stamp_ = next_stamp();
  return true;
}

/// Local numbers of the vertices, in the order in which the triangles come to them.
void MeshCandidates::number_nodes(const TriangleMesh& mesh) {
  // One for each thread and not for each sphere: there may be thousands beside a large mesh.
  static thread_local std::vector<std::int32_t> numbers;  // local number of a mesh vertex, or -1
  if (numbers.size() < mesh.vertices.size()) numbers.resize(mesh.vertices.size(), -1);
  std::int32_t* const local_of = numbers.data();
  node.clear();
  const std::size_t triangles = padded(triangle.size());
  corners_.assign(3 * triangles, 0);
  lay_out({&v0, &v1, &v2}, corners_, triangles);
  const auto local = [&](Index v) {
    std::int32_t& number = local_of[at(v)];
    if (number < 0) {
      number = static_cast<std::int32_t>(node.size());
      node.push_back(v);
    }
    return number;
  };
  for (std::size_t t = 0; t < triangle.size(); ++t) {
    const auto& corner = mesh.triangles[at(triangle[t])];
    v0[t] = local(corner[0]);
    v1[t] = local(corner[1]);
    v2[t] = local(corner[2]);
  }
  for (const Index v : node) local_of[at(v)] = -1;
}

void MeshCandidates::allocate() {
  const std::size_t nodes = padded(node.size()), triangles = padded(triangle.size());
  of_nodes_.resize(7 * nodes);
  lay_out({&x, &y, &z, &node_area, &bx, &by, &bz}, of_nodes_, nodes);
  of_triangles_.resize(9 * triangles);
  lay_out({&ax, &ay, &az, &area, &l01, &l12, &l20, &longest, &plane}, of_triangles_, triangles);
  constexpr double far_away = 1e3;  // [m]: squares stay finite and no ball reaches it
  for (const std::span<double> array : {x, y, z}) std::ranges::fill(array, far_away);
}

/// From the middle outwards: what is inside the ball comes first, what its rim cuts next, what is outside
/// last, so that loops can stop early and their branches are easy to foresee. Thirty-two rings are order
/// enough.
void MeshCandidates::order_outwards() {
  constexpr std::size_t kRings = 32;
  const double furthest = near_.empty() ? 0.0 : *std::ranges::max_element(across_);
  const double scale = furthest > 0.0 ? kRings / furthest : 0.0;
  const auto ring = [&](double distance) {
    return std::min(kRings - 1, static_cast<std::size_t>(distance * scale));
  };
  std::array<std::size_t, kRings + 1> start{};
  for (const double distance : across_)
    if (distance >= 0.0) ++start[ring(distance) + 1];
  for (std::size_t r = 0; r < kRings; ++r) start[r + 1] += start[r];
  triangle.resize(start[kRings]);
  for (std::size_t k = 0; k < near_.size(); ++k)
    if (across_[k] >= 0.0) triangle[start[ring(across_[k])]++] = near_[k];
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

/// Holds until the triangles are measured again.
void MeshCandidates::bound_depth() noexcept {
  double lowest = 0.0;
  for (std::size_t i = 0; i < node.size(); ++i)
    lowest = std::min(lowest, dot(node_position(i) - mean_point, mean_normal));
  below_plane = kShapeTolerance * shortest_ - lowest;
}

void MeshCandidates::fetch_positions(const TriangleMesh& mesh) noexcept {
  for (std::size_t i = 0; i < node.size(); ++i) {
    const Vec3& p = mesh.vertices[at(node[i])];
    x[i] = p.x;
    y[i] = p.y;
    z[i] = p.z;
  }
}

void MeshCandidates::measure_triangles() {
  measured_.resize(node.size());
  for (std::size_t i = 0; i < node.size(); ++i) measured_[i] = node_position(i);
  const kernels::TriangleSums sums = kernels::measure_triangles(*this);
  kernels::measure_nodes(*this, around_);
  longest_edge2 = sums.longest2;
  shortest_ = std::sqrt(sums.shortest2);
  mean_normal = normalized(sums.area);
  constexpr double kCos10Degrees = 0.984807753012208;
  nearly_flat_ = mean_normal != Vec3{} && kernels::least_facing(*this, mean_normal, kCos10Degrees) >= 0.0;
}

}  // namespace abradem::contact
