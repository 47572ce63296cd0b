// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/contact/plane_forces.h"

#include <algorithm>
#include <utility>

#include "abradem/contact/full_law.h"
#include "abradem/core/parallel.h"
#include "abradem/core/prefetch.h"

namespace abradem::contact {

namespace {

std::size_t at(std::int32_t i) noexcept { return static_cast<std::size_t>(i); }

constexpr std::size_t kCapacity = ContactChunk::kCapacity;
constexpr double kPi = 3.141592653589793;

/// A function of its own so that it is compiled for several instruction sets.
ABRADEM_DISPATCH void law(ContactChunk& c, std::size_t count, double dt) noexcept {
  hertz_mindlin_loop(c, count, dt);
}

ABRADEM_DISPATCH void full_law(ContactChunk& c, OptionsChunk& o, std::size_t count, double dt) noexcept {
  full_law_loop(c, o, count, dt);
}

/// Rolling resistance against the spin relative to the plane; capped so that one step cannot reverse it.
Vec3 rolling_torque(const PairConstants& pair, const SphereRow& s, const Vec3& relative_spin, double F_n,
                    double dt) noexcept {
  const double speed = norm(relative_spin);
  if (speed == 0.0 || pair.rolling == 0.0) return {};
  const double inertia = 0.4 * s.radius * s.radius / s.inverse_mass;
  const double magnitude = std::min(pair.rolling * s.radius * std::max(F_n, 0.0), inertia * speed / dt);
  return relative_spin * (-magnitude / speed);
}

}  // namespace

void PlaneList::rebuild(const Spheres& spheres, const MovingPlane& plane, double skin,
                        std::int32_t first_id) {
  std::vector<std::pair<std::int32_t, std::size_t>> before;  // id and place of what touches
  for (std::size_t k = 0; k < sphere.size(); ++k)
    if (touching[k] != 0) before.emplace_back(id[k], k);
  std::ranges::sort(before);
  const std::vector<SpringRow> old = std::move(spring), old_torque = std::move(torque);
  sphere.clear();
  id.clear();
  const Vec3 n = plane.pose.turn(plane.normal);
  const double level = dot(n, plane.pose.to_world(plane.point));
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const SphereRow& s = spheres.row[i];
    if (spheres.id[i] < first_id || dot(n, s.position()) - level >= s.radius + skin) continue;
    sphere.push_back(static_cast<std::int32_t>(i));
    id.push_back(spheres.id[i]);
  }
  touching.assign(sphere.size(), 0);
  fresh.assign(sphere.size(), 0);
  spring.assign(sphere.size(), {});
  torque.assign(sphere.size(), {});
  load.assign(sphere.size(), {});
  F_n.assign(sphere.size(), 0.0);
  slip.assign(sphere.size(), 0.0);
  for (std::size_t k = 0; k < sphere.size(); ++k) {
    const auto found =
        std::ranges::lower_bound(before, id[k], {}, &std::pair<std::int32_t, std::size_t>::first);
    if (found == before.end() || found->first != id[k]) continue;
    touching[k] = 1;
    spring[k] = old[found->second];
    torque[k] = old_torque[found->second];
  }
}

bool PlaneList::fits(std::size_t spheres) const {
  for (const std::size_t length : {id.size(), touching.size(), fresh.size(), spring.size(), torque.size(),
                                   load.size(), F_n.size(), slip.size()})
    if (length != size()) return false;
  return std::ranges::is_sorted(sphere) &&
         (sphere.empty() || (sphere.front() >= 0 && at(sphere.back()) < spheres));
}

bool plane_forces(const Spheres& spheres, PlaneList& list, const MovingPlane& plane,
                  std::span<const PairConstants> by_material, bool options, double dt) {
  const Vec3 n = plane.pose.turn(plane.normal);
  const double level = dot(n, plane.pose.to_world(plane.point));
  const std::size_t chunks = (list.size() + kCapacity - 1) / kCapacity;
  std::vector<std::uint8_t> deep(chunks, 0);
  if (options) list.lost.assign(list.size(), 0.0);
  core::parallel_for(
      chunks,
      [&](std::size_t chunk) {
        ContactChunk c;
        OptionsChunk o;
        std::size_t which[kCapacity];
        std::size_t count = 0;
        const std::size_t end = std::min(list.size(), (chunk + 1) * kCapacity);
        for (std::size_t k = chunk * kCapacity; k < end; ++k) {
          core::prefetch(&spheres.row[at(list.sphere[k])], sizeof(SphereRow));
        }
        for (std::size_t k = chunk * kCapacity; k < end; ++k) {
          const SphereRow& s = spheres.row[at(list.sphere[k])];
          const double overlap = s.radius - (dot(n, s.position()) - level);
          const PairConstants& pair = by_material[static_cast<std::size_t>(s.material)];
          const bool sticks = pair.options.adhesion > 0.0 && list.touching[k] != 0;
          if (!(overlap > 0.0) && !sticks) {
            list.touching[k] = list.fresh[k] = 0;
            list.spring[k] = list.torque[k] = {};
            list.load[k] = {};
            list.F_n[k] = list.slip[k] = 0.0;
            continue;
          }
          deep[chunk] = deep[chunk] != 0 || overlap > 0.5 * kDeepest * s.radius;
          list.fresh[k] = list.touching[k] == 0 ? 1 : 0;
          list.touching[k] = 1;
          const Vec3 arm = -s.radius * n;
          const Vec3 v = s.velocity() + cross(s.spin(), arm) - plane.pose.velocity_at(s.position() + arm);
          const Vec3 spring = plane.pose.turn({list.spring[k].x, list.spring[k].y, list.spring[k].z});
          c.nx[count] = n.x, c.ny[count] = n.y, c.nz[count] = n.z;
          c.vx[count] = v.x, c.vy[count] = v.y, c.vz[count] = v.z;
          c.sx[count] = spring.x, c.sy[count] = spring.y, c.sz[count] = spring.z;
          c.overlap[count] = overlap;
          c.R_eff[count] = s.radius;
          c.m_eff[count] = 1.0 / s.inverse_mass;
          c.set_constants(count, pair);
          if (options) {
            const Vec3 spin = s.spin() - plane.pose.spin;
            const Vec3 torque = plane.pose.turn({list.torque[k].x, list.torque[k].y, list.torque[k].z});
            o.set_constants(count, pair);
            o.held[count] = sticks ? 1.0 : 0.0;
            o.area[count] = kPi * overlap * (2.0 * s.radius - overlap);
            o.a_c[count] = snapping_radius(pair, s.radius);
            o.wx[count] = spin.x, o.wy[count] = spin.y, o.wz[count] = spin.z;
            o.mx[count] = torque.x, o.my[count] = torque.y, o.mz[count] = torque.z;
            o.twist[count] = list.torque[k].twist;
            o.inertia[count] = 0.4 * s.radius * s.radius / s.inverse_mass;
          }
          which[count++] = k;
        }
        if (count == 0) return;
        const std::size_t padded = (count + 7) / 8 * 8;
        for (std::size_t k = count; k < padded; ++k) c.copy(count - 1, k);
        if (options) {
          for (std::size_t k = count; k < padded; ++k) o.copy(count - 1, k);
          full_law(c, o, padded, dt);
        } else {
          law(c, padded, dt);
        }
        for (std::size_t m = 0; m < count; ++m) {
          const std::size_t k = which[m];
          const SphereRow& s = spheres.row[at(list.sphere[k])];
          const PairConstants& pair = by_material[static_cast<std::size_t>(s.material)];
          const Vec3 spring = plane.pose.turn_back({c.sx[m], c.sy[m], c.sz[m]});
          list.spring[k] = {spring.x, spring.y, spring.z, 0.0};
          const Vec3 rolling = options ? Vec3{o.wx[m], o.wy[m], o.wz[m]}
                                       : rolling_torque(pair, s, s.spin() - plane.pose.spin, c.F_n[m], dt);
          const Vec3 torque = s.radius * Vec3{c.tx[m], c.ty[m], c.tz[m]} + rolling;
          if (options) {
            const Vec3 elastic = plane.pose.turn_back({o.mx[m], o.my[m], o.mz[m]});
            list.torque[k] = {elastic.x, elastic.y, elastic.z, o.twist[m]};
            if (o.parted[m] > 0.0) list.touching[k] = 0;
            list.lost[k] = o.lost[m] * dt;
          }
          list.load[k] = {c.fx[m], c.fy[m], c.fz[m], c.stiffening[m], torque.x, torque.y, torque.z, 0.0};
          list.F_n[k] = c.F_n[m];
          const double S_t = options ? o.S_t[m] : pair.tangential * std::sqrt(c.R_eff[m] * c.overlap[m]);
          list.slip[k] = c.slip[m] > 0.0 ? c.slip[m] / S_t : 0.0;
        }
      },
      32);
  return std::ranges::none_of(deep, [](std::uint8_t d) { return d != 0; });
}

}  // namespace abradem::contact
