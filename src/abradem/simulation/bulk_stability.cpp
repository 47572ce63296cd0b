// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/simulation/bulk_stability.h"

#include <algorithm>

namespace abradem::simulation {

namespace {

std::size_t at(std::int32_t i) noexcept { return static_cast<std::size_t>(i); }

/// Sum over a sphere's contacts of k n n^T.
struct Tensor {
  double xx = 0.0, yy = 0.0, zz = 0.0, xy = 0.0, yz = 0.0, zx = 0.0;
  void add(double k, const Vec3& n) noexcept {
    xx += k * n.x * n.x, yy += k * n.y * n.y, zz += k * n.z * n.z;
    xy += k * n.x * n.y, yz += k * n.y * n.z, zx += k * n.z * n.x;
  }
  [[nodiscard]] double along(const Vec3& n) const noexcept {
    return xx * n.x * n.x + yy * n.y * n.y + zz * n.z * n.z +
           2.0 * (xy * n.x * n.y + yz * n.y * n.z + zx * n.z * n.x);
  }
};

/// One contact: where, along which normal, and what it has of c dt and S dt^2 [kg].
struct Link {
  BulkStability::Mode mode;
  Vec3 n;
  double damping = 0.0, stiffness = 0.0;
};

Link link_of(const contact::PairConstants& pair, double a, double m_eff, double dt) noexcept {
  Link link;
  const double S = pair.options.linear() ? pair.options.normal_stiffness : pair.normal * a;
  link.damping = pair.damping * std::sqrt(S * m_eff) * dt;
  link.stiffness = S * dt * dt;
  return link;
}

/// Where a sphere was when the forces of this step were found.
Vec3 before(const contact::SphereRow& s, double dt) noexcept { return s.position() - dt * s.velocity(); }

/// The contacts of spheres marked as `hot`.
std::vector<Link> links_of(const contact::Spheres& spheres, const contact::SphereList& list,
                           const contact::PairTable& table, const BulkWalls& walls,
                           const Surroundings& around, const std::vector<std::uint8_t>& hot) {
  std::vector<Link> links;
  list.for_each_near([&](const contact::ContactBlock& block, std::size_t k) {
    const std::size_t own = at(block.i[k]), other = at(block.j[k]);
    if (block.touching[k] == 0 || (hot[own] == 0 && hot[other] == 0)) return;
    const contact::SphereRow &i = spheres.row[own], &j = spheres.row[other];
    const Vec3 apart = before(i, around.dt) - before(j, around.dt);
    const double reach = i.radius + j.radius, distance = norm(apart), overlap = reach - distance;
    if (!(overlap > 0.0)) return;
    Link link = link_of(table.of(i.material, j.material), std::sqrt(i.radius * j.radius / reach * overlap),
                        1.0 / (i.inverse_mass + j.inverse_mass), around.dt);
    link.mode.sphere = own;
    link.mode.partner = block.j[k];
    link.n = apart * (1.0 / distance);
    links.push_back(link);
  });
  const auto add_wall = [&](std::int32_t sphere, std::size_t w, const Vec3& n, double a, double weight) {
    const contact::SphereRow& s = spheres.row[at(sphere)];
    const auto& pair = around.pair(static_cast<int>(s.material), around.walls[w].material());
    Link link = link_of(contact::PairConstants::of(pair), a, 1.0 / s.inverse_mass, around.dt);
    link.damping *= weight;
    link.stiffness *= weight;
    link.mode.sphere = at(sphere);
    link.mode.wall = static_cast<std::int32_t>(w);
    link.n = around.poses[w].turn(n);
    links.push_back(link);
  };
  for (std::size_t w = 0; w < walls.planes().size(); ++w) {
    const contact::PlaneList& plane = walls.planes()[w];
    const Vec3& n = around.walls[w].setup().mesh.normal;
    for (std::size_t k = 0; k < plane.size(); ++k) {
      const contact::SphereRow& s = spheres.row[at(plane.sphere[k])];
      const double height =
          dot(n, around.poses[w].to_body(before(s, around.dt)) - around.walls[w].setup().mesh.position);
      if (plane.touching[k] != 0 && hot[at(plane.sphere[k])] != 0 && height < s.radius)
        add_wall(plane.sphere[k], w, n, std::sqrt(s.radius * (s.radius - height)), 1.0);
    }
  }
  for (const BulkWalls::NearMesh& m : walls.meshes())
    if (hot[at(m.sphere)] != 0)
      for (const SphereWall::Touch& t : m.contact->touches())
        add_wall(m.sphere, at(m.wall), t.n, t.a, t.weight);
  return links;
}

/// What moves as one: of each sphere the row that stands for its body (its own, or a clump's first), and how
/// willingly that body moves [1/kg].
struct Bodies {
  std::vector<std::size_t> of;
  std::vector<double> response;

  Bodies(const contact::Spheres& spheres, const Clumps& clumps)
      : of(spheres.size()), response(spheres.size()) {
    std::vector<std::size_t> first(clumps.size(), spheres.size());
    for (std::size_t i = 0; i < spheres.size(); ++i) {
      const std::int32_t c = spheres.clump.empty() ? -1 : spheres.clump[i];
      if (c >= 0 && first[at(c)] == spheres.size()) first[at(c)] = i;
      of[i] = c >= 0 ? first[at(c)] : i;
      response[i] = c >= 0 ? clumps.response(clumps.clumps()[at(c)]) : spheres.row[i].inverse_mass;
    }
  }
};

/// Rayleigh's quotients of both spheres moving along the link's normal, each by its part of the distance.
Scheme scheme_of(const Link& link, const Bodies& bodies, const std::vector<Tensor>& damping,
                 const std::vector<Tensor>& stiffness) noexcept {
  const std::size_t i = bodies.of[link.mode.sphere];
  const double per_i = bodies.response[i];
  if (link.mode.partner < 0) return {damping[i].along(link.n) * per_i, stiffness[i].along(link.n) * per_i};
  const std::size_t j = bodies.of[at(link.mode.partner)];
  const double per_j = bodies.response[j], m_eff = 1.0 / (per_i + per_j);
  const double u = per_i * m_eff, v = per_j * m_eff;
  const auto quotient = [&](double own, const std::vector<Tensor>& all) {
    return (own + u * u * (all[i].along(link.n) - own) + v * v * (all[j].along(link.n) - own)) / m_eff;
  };
  return {quotient(link.damping, damping), quotient(link.stiffness, stiffness)};
}

}  // namespace

std::optional<BulkStability::Mode> BulkStability::watch(const contact::Spheres& spheres,
                                                        const contact::SphereList& list,
                                                        const contact::PairTable& table,
                                                        const contact::LoadRows& load, const BulkWalls& walls,
                                                        const Clumps& clumps, const Surroundings& around,
                                                        double largest) {
  worst_ = std::max(worst_, largest);
  // Twice the largest sum of one sphere bounds 2 g + W of every motion: nearly all runs end here.
  constexpr double kSafe = 0.5 * Scheme::kLimit;
  if (!(largest > kSafe)) {
    growing_.clear();
    return {};
  }
  const Bodies bodies(spheres, clumps);
  std::vector<double> stiffening(spheres.size(), 0.0);
  for (std::size_t i = 0; i < spheres.size(); ++i) stiffening[bodies.of[i]] += load[i].stiffening;
  std::vector<std::uint8_t> hot(spheres.size());
  for (std::size_t i = 0; i < spheres.size(); ++i)
    hot[i] = static_cast<std::uint8_t>(stiffening[bodies.of[i]] * bodies.response[i] > kSafe);
  const std::vector<Link> links = links_of(spheres, list, table, walls, around, hot);
  std::vector<Tensor> damping(spheres.size()), stiffness(spheres.size());
  for (const Link& link : links) {
    const auto add_to = [&](std::size_t sphere) {
      damping[bodies.of[sphere]].add(link.damping, link.n);
      stiffness[bodies.of[sphere]].add(link.stiffness, link.n);
    };
    add_to(link.mode.sphere);
    if (link.mode.partner >= 0) add_to(at(link.mode.partner));
  }
  // The worst mode of each sphere.
  std::vector<double> number(spheres.size(), 0.0);
  std::vector<Mode> mode(spheres.size());
  for (const Link& link : links) {
    Mode found = link.mode;
    found.scheme = scheme_of(link, bodies, damping, stiffness);
    const auto offer = [&](std::size_t i) {
      if (found.scheme.number() <= number[i]) return;
      number[i] = found.scheme.number();
      mode[i] = found;
    };
    offer(bodies.of[link.mode.sphere]);
    if (link.mode.partner >= 0) offer(bodies.of[at(link.mode.partner)]);
  }
  std::vector<Growing> growing;
  std::optional<Mode> worst;
  double most = kLargestGrowth;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    if (number[i] == 0.0) continue;
    worst_ = std::max(worst_, number[i]);
    const auto old = std::ranges::lower_bound(growing_, spheres.id[i], {}, &Growing::id);
    const double so_far = old != growing_.end() && old->id == spheres.id[i] ? old->ln : 0.0;
    if (number[i] <= Scheme::kLimit && so_far == 0.0) continue;
    const double ln = so_far + std::log(mode[i].scheme.growth());
    if (ln <= 0.0) continue;
    growing.push_back({spheres.id[i], ln});
    if (ln < most) continue;
    most = ln;
    worst = mode[i];
  }
  std::ranges::sort(growing, {}, &Growing::id);
  growing_ = std::move(growing);
  return worst;
}

}  // namespace abradem::simulation
