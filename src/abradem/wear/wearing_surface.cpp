// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/wear/wearing_surface.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "abradem/core/error.h"

namespace abradem::wear {

namespace {

using geometry::Triangle;
using geometry::TriangleMesh;

std::size_t at(Index i) noexcept { return static_cast<std::size_t>(i); }

/// Cubic in tau that a triangle sweeps when its corners move by -tau u: coefficients of tau, tau^2, tau^3.
std::array<double, 3> sweep_cubic(const Vec3 (&p)[3], const Vec3 (&u)[3]) noexcept {
  const Vec3 e1 = p[1] - p[0], e2 = p[2] - p[0], d1 = u[1] - u[0], d2 = u[2] - u[0];
  const Vec3 U = u[0] + u[1] + u[2];
  const double a0 = dot(U, cross(e1, e2));
  const double a1 = -dot(U, cross(d1, e2) + cross(e1, d2));
  const double a2 = dot(U, cross(d1, d2));
  return {a0 / 6.0, a1 / 12.0, a2 / 18.0};
}

/// Smallest altitude of a triangle [m].
double smallest_altitude(const TriangleMesh& mesh, const Triangle& t, double area) noexcept {
  double longest2 = 0.0;
  for (std::size_t k = 0; k < 3; ++k)
    longest2 = std::max(longest2, norm2(mesh.vertices[at(t[(k + 1) % 3])] - mesh.vertices[at(t[k])]));
  return 2.0 * area / std::sqrt(longest2);
}

/// Components of the worn vertices that share a triangle; each component's vertices in ascending order.
std::vector<std::vector<Index>> connected_patches(const TriangleMesh& mesh, const geometry::Rows& stars,
                                                  std::span<const Index> vertices) {
  std::vector<std::size_t> parent(vertices.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  const auto position = [&](Index v) {
    const auto found = std::ranges::lower_bound(vertices, v);
    return found != vertices.end() && *found == v ? found - vertices.begin() : std::ptrdiff_t{-1};
  };
  for (std::size_t i = 0; i < vertices.size(); ++i)
    for (const Index t : stars[vertices[i]])
      for (const Index w : mesh.triangles[at(t)])
        if (const auto j = position(w); j >= 0) parent[root(static_cast<std::size_t>(j))] = root(i);
  std::vector<std::vector<Index>> patches;
  std::vector<std::size_t> patch_of_root(vertices.size(), vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    std::size_t& patch = patch_of_root[root(i)];
    if (patch == vertices.size()) {
      patch = patches.size();
      patches.emplace_back();
    }
    patches[patch].push_back(vertices[i]);
  }
  return patches;
}

}  // namespace

double swept_between(const Vec3 (&from)[3], const Vec3 (&to)[3]) noexcept {
  const Vec3 u[3]{from[0] - to[0], from[1] - to[1], from[2] - to[2]};
  const auto c = sweep_cubic(from, u);
  return c[0] + c[1] + c[2];
}

WearingSurface::WearingSurface(TriangleMesh mesh)
    : mesh_(std::move(mesh)), reference_(mesh_.vertices), stars_(geometry::triangles_of_vertices(mesh_)) {
  if (mesh_.triangles.empty()) throw GeometryError("the mesh has no triangles");
  const std::size_t vertices = mesh_.vertices.size();
  direction_.assign(vertices, {});
  limit_.assign(vertices, std::numeric_limits<double>::infinity());
  std::vector<double> star_area(vertices, 0.0);
  for (Index t = 0; t < mesh_.triangle_count(); ++t) {
    const Vec3 a = area_vector(mesh_, t);
    const double area = norm(a);
    if (!(area > 0.0))
      throw GeometryError(fmt::format(
          "triangle {} has no area; `abradem check` on the mesh finds such triangles and repairs them", t));
    const double altitude = smallest_altitude(mesh_, mesh_.triangles[at(t)], area);
    for (const Index v : mesh_.triangles[at(t)]) {
      direction_[at(v)] += a;
      star_area[at(v)] += area;
      limit_[at(v)] = std::min(limit_[at(v)], 0.1 * altitude);
    }
  }

  inverse_area_.assign(vertices, 0.0);
  open_border_.assign(vertices, 0);
  for (std::size_t v = 0; v < vertices; ++v) {
    const double projected = norm(direction_[v]);
    direction_[v] = normalized(direction_[v]);
    // The star is flat when its area vectors all point the same way.
    constexpr double kFlat = 1e-12;
    if (star_area[v] - projected <= kFlat * star_area[v] && projected > 0.0)
      inverse_area_[v] = 3.0 / projected;
    else if (star_area[v] > 0.0)
      flat_ = false;
  }
  const auto neighbours = geometry::neighbours_of_triangles(mesh_, stars_);
  for (std::size_t t = 0; t < neighbours.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      if (neighbours[t][k] < 0)
        for (const Index v : {mesh_.triangles[t][k], mesh_.triangles[t][(k + 1) % 3]})
          open_border_[at(v)] = inverse_area_[at(v)] == 0.0;

  sink_.assign(vertices, 0.0);
  pending_.assign(vertices, 0.0);
  volume_.assign(mesh_.triangles.size(), 0.0);
  pending_element_.assign(mesh_.triangles.size(), 0.0);
}

void WearingSurface::deposit_element(Index triangle, double volume) {
  volume_[at(triangle)] += volume;
  if (pending_element_[at(triangle)] == 0.0 && volume > 0.0) touched_elements_.push_back(triangle);
  pending_element_[at(triangle)] += volume;
}

void WearingSurface::watch(Index v, double distance) noexcept {
  const double limit = limit_[at(v)];
  if (distance <= limit) return;
  ++guards_.deep_steps;
  if (!(distance <= 5.0 * limit)) {  // not a number too
    ++guards_.fatal_steps;
    guards_.worst_vertex = v;
  }
}

void WearingSurface::displace(Index v, double distance) {
  const std::size_t i = at(v);
  watch(v, std::abs(distance));
  if (sink_[i] == 0.0 && distance != 0.0) first_moved_.push_back(v);
  sink_[i] += distance;
  deepest_sink_ = std::max(deepest_sink_, std::abs(sink_[i]));
  mesh_.vertices[i] = reference_[i] - sink_[i] * direction_[i];
}

void WearingSurface::raise_vertex(Index vertex, double volume) {
  if (piled_.empty()) piled_.assign(mesh_.vertices.size(), 0.0);
  double& piled = piled_[at(vertex)];
  if (piled == 0.0 && volume > 0.0) touched_piles_.push_back(vertex);
  piled += volume;
  const double y = volume - raised_lost_, sum = raised_ + y;  // Kahan
  raised_lost_ = (sum - raised_) - y;
  raised_ = sum;
}

void WearingSurface::deform_conserving() {
  if (touched_.empty() && touched_piles_.empty()) return;
  odometer_ += move_by_volume(touched_, pending_, 1.0);
  odometer_ += move_by_volume(touched_piles_, piled_, -1.0);
  ++revision_;
}

/// Moves vertices by the volumes that wait at them: in (sign 1) or out (-1). Returns the furthest way [m].
double WearingSurface::move_by_volume(std::vector<Index>& vertices, std::vector<double>& pending,
                                      double sign) {
  double furthest = 0.0;
  if (flat_) {
    for (const Index v : vertices) {
      const double distance = pending[at(v)] * inverse_area_[at(v)];
      displace(v, sign * distance);
      furthest = std::max(furthest, distance);
      swept_by_updates_ += sign * pending[at(v)];
      pending[at(v)] = 0.0;
    }
  } else {
    std::ranges::sort(vertices);
    std::vector<double> distance;
    for (const auto& patch : connected_patches(mesh_, stars_, vertices)) {
      for (const Index v : patch) pending[at(v)] *= sign;
      close_volume(patch, pending, distance);
      for (std::size_t i = 0; i < patch.size(); ++i) {
        displace(patch[i], distance[i]);
        furthest = std::max(furthest, std::abs(distance[i]));
        border_moved_ = border_moved_ || open_border_[at(patch[i])] != 0;
        pending[at(patch[i])] = 0.0;
      }
    }
  }
  vertices.clear();
  return furthest;
}

/// Finds the distances by which a patch's vertices must sink so that it sweeps its pending volume exactly:
/// s_i = V_i / (m_i . b_i) to first order, then one common factor tau from the cubic of the swept volume.
void WearingSurface::close_volume(std::span<const Index> vertices, std::span<const double> pending,
                                  std::vector<double>& distance) {
  distance.assign(vertices.size(), 0.0);
  double target = 0.0;
  std::vector<Index> triangles;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Index v = vertices[i];
    double projected = 0.0;  // m_i . b_i, b_i = sum of a third of the star's area vectors
    for (const Index t : stars_[v]) {
      projected += dot(direction_[at(v)], area_vector(mesh_, t)) / 3.0;
      triangles.push_back(t);
    }
    if (!(projected > 0.0)) {
      ++guards_.flipped;
      guards_.worst_triangle = stars_[v].front();
      projected = std::numeric_limits<double>::infinity();
    }
    distance[i] = pending[at(v)] / projected;
    target += pending[at(v)];
  }
  std::ranges::sort(triangles);
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());

  double c1 = 0.0, c2 = 0.0, c3 = 0.0;
  for (const Index t : triangles) {
    Vec3 p[3], u[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const Index v = mesh_.triangles[at(t)][k];
      p[k] = mesh_.vertices[at(v)];
      const auto found = std::ranges::lower_bound(vertices, v);
      if (found != vertices.end() && *found == v)
        u[k] = distance[static_cast<std::size_t>(found - vertices.begin())] * direction_[at(v)];
    }
    const auto c = sweep_cubic(p, u);
    c1 += c[0];
    c2 += c[1];
    c3 += c[2];
  }
  double tau = 1.0;
  constexpr int kNewtonSteps = 4;  // quadratic from an error of order (sink / edge): two reach round-off
  for (int i = 0; i < kNewtonSteps; ++i)
    tau -= (tau * (c1 + tau * (c2 + tau * c3)) - target) / (c1 + tau * (2.0 * c2 + tau * 3.0 * c3));
  if (!(tau > 0.0) || !std::isfinite(tau)) tau = 1.0;  // the guards above have counted why
  for (double& d : distance) d *= tau;
  swept_by_updates_ += tau * (c1 + tau * (c2 + tau * c3));
}

double WearingSurface::deform_paper() {
  if (touched_elements_.empty()) return 0.0;
  std::ranges::sort(touched_elements_);  // the sum at a vertex must not depend on the order of contacts
  std::vector<std::pair<Index, Vec3>> moves;
  moves.reserve(3 * touched_elements_.size());
  for (const Index t : touched_elements_) {
    const Vec3 a = area_vector(mesh_, t);
    const double area = norm(a);
    const Vec3 step = a * (pending_element_[at(t)] / (area * area));  // eq. 6 along eq. 9's normal
    for (const Index v : mesh_.triangles[at(t)]) moves.emplace_back(v, step);
  }
  // Each vertex moves by the sum over its worn elements; displacements are collected first, so that all
  // normals are those of the beginning of the step.
  std::ranges::stable_sort(moves, {}, &std::pair<Index, Vec3>::first);
  std::vector<Vec3> before;
  std::vector<double> area_before;
  for (const Index t : touched_elements_) {
    const Triangle& v = mesh_.triangles[at(t)];
    before.push_back((mesh_.vertices[at(v[0])] + mesh_.vertices[at(v[1])] + mesh_.vertices[at(v[2])]) *
                     (1.0 / 3.0));
    area_before.push_back(norm(area_vector(mesh_, t)));
  }
  double furthest = 0.0;
  for (std::size_t i = 0; i < moves.size();) {
    const Index v = moves[i].first;
    Vec3 sum;
    for (; i < moves.size() && moves[i].first == v; ++i) sum += moves[i].second;
    const double distance = norm(sum);
    watch(v, distance);
    furthest = std::max(furthest, distance);
    if (sink_[at(v)] == 0.0 && distance != 0.0) first_moved_.push_back(v);
    sink_[at(v)] += distance;
    deepest_sink_ = std::max(deepest_sink_, sink_[at(v)]);
    mesh_.vertices[at(v)] -= sum;
  }
  double paper_volume = 0.0;  // eq. 10-11 over the elements in contact
  for (std::size_t k = 0; k < touched_elements_.size(); ++k) {
    const Index t = touched_elements_[k];
    const Triangle& v = mesh_.triangles[at(t)];
    const Vec3 after =
        (mesh_.vertices[at(v[0])] + mesh_.vertices[at(v[1])] + mesh_.vertices[at(v[2])]) * (1.0 / 3.0);
    paper_volume += norm(after - before[k]) * area_before[k];
    watch_orientation(t);
    pending_element_[at(t)] = 0.0;
  }
  touched_elements_.clear();
  odometer_ += furthest;
  ++revision_;
  return paper_volume;
}

double WearingSurface::deposited_volume() const {
  // Kahan: many elements of very different wear. In eight lanes, which do not wait for each other.
  constexpr std::size_t kLanes = 8;
  std::array<double, kLanes> sum{}, lost{};
  const auto add = [&](std::size_t lane, double v) {
    const double y = v - lost[lane], t = sum[lane] + y;
    lost[lane] = (t - sum[lane]) - y;
    sum[lane] = t;
  };
  const std::size_t whole = volume_.size() / kLanes * kLanes;
  for (std::size_t i = 0; i < whole; i += kLanes)
    for (std::size_t k = 0; k < kLanes; ++k) add(k, volume_[i + k]);
  for (std::size_t i = whole; i < volume_.size(); ++i) add(0, volume_[i]);
  for (std::size_t k = 1; k < kLanes; ++k) add(0, sum[k] - lost[k]);
  return sum[0];
}

double WearingSurface::swept_volume() const {
  if (border_moved_) return swept_by_updates_;
  double sum = 0.0;
  for (const Index t : worn_triangles()) {
    const Triangle& v = mesh_.triangles[at(t)];
    const Vec3 from[3]{reference_[at(v[0])], reference_[at(v[1])], reference_[at(v[2])]};
    const Vec3 to[3]{mesh_.vertices[at(v[0])], mesh_.vertices[at(v[1])], mesh_.vertices[at(v[2])]};
    sum += swept_between(from, to);
  }
  return sum;
}

double WearingSurface::waiting_volume() const noexcept {
  double sum = 0.0;
  for (const Index v : touched_) sum += pending_[at(v)];
  for (const Index v : touched_piles_) sum -= piled_[at(v)];
  return sum;
}

const std::vector<Index>& WearingSurface::worn_triangles() const {
  if (!worn_known_) {
    worn_.clear();
    for (Index t = 0; t < mesh_.triangle_count(); ++t) {
      const Triangle& v = mesh_.triangles[at(t)];
      if (sink_[at(v[0])] != 0.0 || sink_[at(v[1])] != 0.0 || sink_[at(v[2])] != 0.0) worn_.push_back(t);
    }
    worn_known_ = true;
  } else if (!first_moved_.empty()) {
    const auto before = static_cast<std::ptrdiff_t>(worn_.size());
    for (const Index v : first_moved_)
      for (const Index t : stars_[v]) worn_.push_back(t);
    std::sort(worn_.begin() + before, worn_.end());
    std::inplace_merge(worn_.begin(), worn_.begin() + before, worn_.end());
    worn_.erase(std::unique(worn_.begin(), worn_.end()), worn_.end());
  }
  first_moved_.clear();
  return worn_;
}

void WearingSurface::watch_orientation(Index t) noexcept {
  const Triangle& v = mesh_.triangles[at(t)];
  const Vec3 before =
      cross(reference_[at(v[1])] - reference_[at(v[0])], reference_[at(v[2])] - reference_[at(v[0])]);
  if (dot(before, area_vector(mesh_, t)) <= 0.0) {
    ++guards_.flipped;
    guards_.worst_triangle = t;
  }
}

void WearingSurface::check_orientation() {
  for (const Index t : worn_triangles()) watch_orientation(t);
}

}  // namespace abradem::wear
