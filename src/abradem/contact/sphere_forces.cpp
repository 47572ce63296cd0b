// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/contact/sphere_forces.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "abradem/contact/full_law.h"
#include "abradem/contact/quads.h"
#include "abradem/core/parallel.h"

namespace abradem::contact {

namespace {

std::size_t at(std::int32_t i) noexcept { return static_cast<std::size_t>(i); }

constexpr std::size_t kCapacity = ContactChunk::kCapacity;

/// Contacts of one block on their way through the law: what overlaps, gathered from the list.
struct PairChunk {
  ContactChunk c;
  alignas(64) double offset[4 * kCapacity];  // x_i - x_j and R_i + R_j, row by row
  ContactChunk::Array reach, inverse_mass, R_i, ux, uy, uz;
  OptionsChunk o;  // torques of rolling; the rest only where a pair has options
  std::int32_t pair[kCapacity];
};

struct Work {
  const SphereRow* __restrict sphere;
  const std::int32_t* __restrict owner;
  const std::int32_t* __restrict partner;
  std::uint8_t* __restrict touching;
  const std::int32_t* __restrict far;
  SpringRow* __restrict spring;
  SpringRow* __restrict torque;  ///< null where none are remembered
  LoadRow* __restrict far_load;
  LoadRow* __restrict load;
  const PairTable* table;
  const std::uint8_t* __restrict image;  ///< null where nothing is periodic
  const SpringRow* __restrict shift;
  std::int32_t block_end;  ///< spheres from here on belong to later blocks
  double dt;
};

/// Rows of the chunk's contacts turned into arrays: relative velocity, spins times radii, springs.
ABRADEM_INLINE void gather(const Work& w, PairChunk& p, std::size_t count) noexcept {
  const Quad minus{-1.0, -1.0, -1.0, 1.0};
  for (std::size_t k = 0; k < count; k += 4) {
    Quad d[4], v[4], u[4], s[4];
    for (std::size_t m = 0; m < 4; ++m) {
      const auto pair = at(p.pair[k + m]);
      const SphereRow& i = w.sphere[w.owner[pair]];
      const SphereRow& j = w.sphere[w.partner[pair]];
      d[m] = quad_at(p.offset + 4 * (k + m));
      v[m] = quads(i)[1] + quads(j)[1] * minus;  // the last: sum of the inverse masses
      u[m] = quads(i)[2] * i.radius + quads(j)[2] * j.radius;
      s[m] = quad(w.spring[pair]);
      p.R_i[k + m] = i.radius;
    }
    transpose(d[0], d[1], d[2], d[3]);
    transpose(v[0], v[1], v[2], v[3]);
    transpose(u[0], u[1], u[2], u[3]);
    transpose(s[0], s[1], s[2], s[3]);
    quad_at(p.c.nx + k) = d[0], quad_at(p.c.ny + k) = d[1], quad_at(p.c.nz + k) = d[2];
    quad_at(p.reach + k) = d[3];
    quad_at(p.c.vx + k) = v[0], quad_at(p.c.vy + k) = v[1], quad_at(p.c.vz + k) = v[2];
    quad_at(p.inverse_mass + k) = v[3];
    quad_at(p.ux + k) = u[0], quad_at(p.uy + k) = u[1], quad_at(p.uz + k) = u[2];
    quad_at(p.c.sx + k) = s[0], quad_at(p.c.sy + k) = s[1], quad_at(p.c.sz + k) = s[2];
  }
}

/// From offsets to normals, overlaps, effective radii and masses, and velocities at the contact.
/// @return largest overlap beyond kDeepest R_eff [m], or less than 0
ABRADEM_INLINE double meet(PairChunk& p, std::size_t count) noexcept {
  ContactChunk& c = p.c;
  double deepest = -1.0;
#pragma omp simd reduction(max : deepest)
  for (std::size_t k = 0; k < count; ++k) {
    const double dx = c.nx[k], dy = c.ny[k], dz = c.nz[k], reach = p.reach[k];
    const double distance = std::sqrt(dx * dx + dy * dy + dz * dz), inverse = 1.0 / distance;
    const double nx = dx * inverse, ny = dy * inverse, nz = dz * inverse;
    const double shared = 1.0 / (reach * p.inverse_mass[k]);
    c.nx[k] = nx;
    c.ny[k] = ny;
    c.nz[k] = nz;
    const double overlap = reach - distance;
    const double R_eff = p.R_i[k] * (reach - p.R_i[k]) * p.inverse_mass[k] * shared;
    const double beyond = overlap - kDeepest * R_eff;
    deepest = beyond > deepest ? beyond : deepest;
    c.overlap[k] = overlap;
    c.R_eff[k] = R_eff;
    c.m_eff[k] = reach * shared;
    c.vx[k] -= p.uy[k] * nz - p.uz[k] * ny;
    c.vy[k] -= p.uz[k] * nx - p.ux[k] * nz;
    c.vz[k] -= p.ux[k] * ny - p.uy[k] * nx;
  }
  return deepest;
}

/// Relative spins, and the inertia that they have.
ABRADEM_INLINE void gather_spins(const Work& w, PairChunk& p, std::size_t count) noexcept {
  for (std::size_t k = 0; k < count; ++k) {
    const SphereRow& i = w.sphere[w.owner[p.pair[k]]];
    const SphereRow& j = w.sphere[w.partner[p.pair[k]]];
    p.o.wx[k] = i.wx - j.wx;
    p.o.wy[k] = i.wy - j.wy;
    p.o.wz[k] = i.wz - j.wz;
    p.o.inertia[k] = 0.4 / (i.inverse_mass / (i.radius * i.radius) + j.inverse_mass / (j.radius * j.radius));
  }
}

/// Rolling resistance of constant torque, as rolling_torque of hertz_mindlin.h, against w_i - w_j.
ABRADEM_INLINE void roll(const Work& w, PairChunk& p, std::size_t count) noexcept {
  gather_spins(w, p, count);
  const ContactChunk& c = p.c;
  OptionsChunk& o = p.o;
  const double inverse_dt = 1.0 / w.dt;
#pragma omp simd
  for (std::size_t k = 0; k < count; ++k) {
    const double speed = std::sqrt(o.wx[k] * o.wx[k] + o.wy[k] * o.wy[k] + o.wz[k] * o.wz[k]);
    const double F_n = c.F_n[k] > 0.0 ? c.F_n[k] : 0.0;
    const double resistance = c.rolling[k] * c.R_eff[k] * F_n, most = o.inertia[k] * speed * inverse_dt;
    const double per_speed = (resistance < most ? resistance : most) / speed;
    const double scale = speed > 0.0 ? -per_speed : 0.0;
    o.wx[k] *= scale;
    o.wy[k] *= scale;
    o.wz[k] *= scale;
  }
}

/// The law of pairs that have options: cohesion, rolling springs and so on.
ABRADEM_INLINE void full_law(const Work& w, PairChunk& p, std::size_t count) noexcept {
  constexpr double quarter_pi = 0.7853981633974483;
  ContactChunk& c = p.c;
  OptionsChunk& o = p.o;
  gather_spins(w, p, count);
  for (std::size_t k = 0; k < count; ++k) {
    const auto pair = at(p.pair[k]);
    const PairConstants& constants =
        w.table->of(w.sphere[w.owner[pair]].material, w.sphere[w.partner[pair]].material);
    c.set_constants(k, constants);
    o.set_constants(k, constants);
    o.a_c[k] = snapping_radius(constants, c.R_eff[k]);
    const SpringRow torque = w.torque != nullptr ? w.torque[pair] : SpringRow{};
    o.mx[k] = torque.x, o.my[k] = torque.y, o.mz[k] = torque.z, o.twist[k] = torque.twist;
    const double d = p.reach[k] - c.overlap[k], difference = p.R_i[k] - (p.reach[k] - p.R_i[k]);
    o.area[k] = quarter_pi * c.overlap[k] * (d + p.reach[k]) * (d - difference) * (d + difference) / (d * d);
  }
  full_law_loop(c, o, count, w.dt);
}

/// What the contacts remember besides their springs, and those that have snapped.
ABRADEM_INLINE void remember(const Work& w, const PairChunk& p, std::size_t count) noexcept {
  const OptionsChunk& o = p.o;
  for (std::size_t k = 0; k < count; ++k) {
    const auto pair = at(p.pair[k]);
    if (w.torque != nullptr) w.torque[pair] = {o.mx[k], o.my[k], o.mz[k], o.twist[k]};
    if (o.parted[k] > 0.0) w.touching[pair] = 0;
  }
}

/// Arrays turned back into rows and added to the spheres, contact by contact in the order of the list.
template <bool kRolling>
ABRADEM_INLINE void scatter(const Work& w, PairChunk& p, std::size_t count) noexcept {
  ContactChunk& c = p.c;
  const Quad minus{-1.0, -1.0, -1.0, 1.0};
  for (std::size_t k = 0; k < count; k += 4) {
    Quad f[4]{quad_at(c.fx + k), quad_at(c.fy + k), quad_at(c.fz + k), quad_at(c.stiffening + k)};
    Quad t[4]{quad_at(c.tx + k), quad_at(c.ty + k), quad_at(c.tz + k), Quad{}};
    Quad s[4]{quad_at(c.sx + k), quad_at(c.sy + k), quad_at(c.sz + k), Quad{}};
    Quad r[4]{};
    transpose(f[0], f[1], f[2], f[3]);
    transpose(t[0], t[1], t[2], t[3]);
    transpose(s[0], s[1], s[2], s[3]);
    if constexpr (kRolling) {
      r[0] = quad_at(p.o.wx + k), r[1] = quad_at(p.o.wy + k), r[2] = quad_at(p.o.wz + k);
      transpose(r[0], r[1], r[2], r[3]);
    }
    const std::size_t here = std::min<std::size_t>(4, count - k);
    for (std::size_t m = 0; m < here; ++m) {
      const auto pair = at(p.pair[k + m]);
      const std::int32_t i = w.owner[pair], j = w.partner[pair];
      quad(w.spring[pair]) = s[m];
      Quad* own = quads(w.load[i]);
      Quad* other = quads(j < w.block_end ? w.load[j] : w.far_load[w.far[pair]]);
      const Quad on_i = t[m] * w.sphere[i].radius, on_j = t[m] * w.sphere[j].radius;
      own[0] += f[m];
      own[1] += kRolling ? on_i + r[m] : on_i;
      if (j < w.block_end) {
        other[0] += f[m] * minus;
        other[1] += kRolling ? on_j - r[m] : on_j;
      } else {
        other[0] = f[m] * minus;
        other[1] = kRolling ? on_j - r[m] : on_j;
      }
    }
  }
}

/// The law over the contacts gathered so far. @return largest overlap beyond kDeepest R_eff [m], or less than
/// 0
template <bool kOptions>
ABRADEM_INLINE double flush(const Work& w, PairChunk& p, std::size_t count) noexcept {
  constexpr std::size_t kLanes = 8;
  const std::size_t padded = (count + kLanes - 1) / kLanes * kLanes;
  for (std::size_t k = count; k < padded; ++k) {
    p.pair[k] = p.pair[count - 1];
    quad_at(p.offset + 4 * k) = quad_at(p.offset + 4 * (count - 1));
  }
  gather(w, p, padded);
  if constexpr (kOptions) {
    const double beyond = meet(p, padded);
    full_law(w, p, padded);
    scatter<true>(w, p, count);
    remember(w, p, count);
    return beyond;
  }
  if (w.table->materials > 1)
    for (std::size_t k = 0; k < padded; ++k) {
      const auto pair = at(p.pair[k]);
      p.c.set_constants(k, w.table->of(w.sphere[w.owner[pair]].material, w.sphere[w.partner[pair]].material));
    }
  const double deepest = meet(p, padded);
  hertz_mindlin_loop(p.c, padded, w.dt);
  if (w.table->rolling) {
    roll(w, p, padded);
    scatter<true>(w, p, count);
  } else {
    scatter<false>(w, p, count);
  }
  return deepest;
}

/// Pair k has parted: it remembers nothing, and does nothing to its partner.
ABRADEM_INLINE void release(const Work& w, std::size_t k) noexcept {
  w.spring[k] = {};
  if (w.torque != nullptr) w.torque[k] = {};
  if (w.partner[k] >= w.block_end) w.far_load[w.far[k]] = {};
}

/// Where byte m of eight stands in a word.
constexpr unsigned byte_shift(std::size_t m) noexcept {
  return static_cast<unsigned>(std::endian::native == std::endian::little ? 8 * m : 56 - 8 * m);
}

/// All pairs of one block, eight at a time. What overlaps is gathered into a chunk; full chunks go through
/// the law. (Copies of w's pointers: stores to `touching`, which are bytes, may alias anything.)
template <bool kOptions, bool kPeriodic>
ABRADEM_INLINE double forces_of_block(const Work& w, std::int32_t first, std::int32_t last,
                                      PairChunk& p) noexcept {
  const Quad minus{-1.0, -1.0, -1.0, 1.0};
  const SphereRow* const sphere = w.sphere;
  const std::int32_t* const owner = w.owner;
  const std::int32_t* const partner = w.partner;
  std::uint8_t* const touching = w.touching;
  double deepest = -1.0;
  std::size_t count = 0;
  std::int32_t pair = first;
  for (; pair + 8 <= last; pair += 8) {
    const auto k = at(pair);
    // Partners lie here and there: ask early for those that will be needed.
    constexpr std::int32_t kAhead = 32;
    const auto ahead = at(std::min(pair + kAhead, last - 8));
    for (std::size_t m = 0; m < 8; ++m) {
      const char* const row = reinterpret_cast<const char*>(sphere + partner[ahead + m]);
      __builtin_prefetch(row);
      __builtin_prefetch(row + 64);
    }
    Quad d[8];
    std::uint64_t gap[8];  // bits of |x_i - x_j|^2 - (R_i + R_j)^2
    for (std::size_t half = 0; half < 8; half += 4) {
      Quad column[4];
      for (std::size_t m = 0; m < 4; ++m) {
        Quad between =
            quads(sphere[owner[k + half + m]])[0] + quads(sphere[partner[k + half + m]])[0] * minus;
        if constexpr (kPeriodic) between += quad(w.shift[w.image[k + half + m]]);
        column[m] = d[half + m] = between;
      }
      transpose(column[0], column[1], column[2], column[3]);
      const Quad g =
          column[0] * column[0] + column[1] * column[1] + column[2] * column[2] - column[3] * column[3];
      quad_at(reinterpret_cast<double*>(gap) + half) = g;
    }
    std::uint64_t now = 0, before = 0;
    std::memcpy(&before, touching + k, 8);
    for (std::size_t m = 0; m < 8; ++m) {
      std::uint64_t overlaps = gap[m] >> 63;  // the sign
      if constexpr (kOptions)  // what sticks together stays so until the law says that it has parted
        if (w.table->adhesion) overlaps |= before >> byte_shift(m) & 1U;
      quad_at(p.offset + 4 * count) = d[m];
      p.pair[count] = pair + static_cast<std::int32_t>(m);
      count += overlaps;
      now |= overlaps << byte_shift(m);
    }
    std::memcpy(touching + k, &now, 8);
    if ((before & ~now) != 0) [[unlikely]]
      for (std::size_t m = 0; m < 8; ++m)
        if (((before & ~now) >> byte_shift(m) & 1U) != 0) release(w, k + m);
    if (count + 8 > kCapacity) {
      deepest = std::max(deepest, flush<kOptions>(w, p, count));
      count = 0;
    }
  }
  for (; pair < last; ++pair) {
    const auto k = at(pair);
    Quad d = quads(sphere[owner[k]])[0] + quads(sphere[partner[k]])[0] * minus;
    if constexpr (kPeriodic) d += quad(w.shift[w.image[k]]);
    const Quad s = d * d;
    const bool sticks = kOptions && w.table->adhesion && touching[k] != 0;
    const bool overlaps = s[0] + s[1] + s[2] - s[3] < 0.0 || sticks;
    quad_at(p.offset + 4 * count) = d;
    p.pair[count] = pair;
    if (touching[k] != 0 && !overlaps) release(w, k);
    touching[k] = static_cast<std::uint8_t>(overlaps);
    count += overlaps;
  }
  return count > 0 ? std::max(deepest, flush<kOptions>(w, p, count)) : deepest;
}

using BlockForces = double (*)(const Work&, std::int32_t, std::int32_t, PairChunk&) noexcept;
ABRADEM_DISPATCH double block_forces(const Work& w, std::int32_t first, std::int32_t last,
                                     PairChunk& p) noexcept {
  return forces_of_block<false, false>(w, first, last, p);
}
ABRADEM_DISPATCH double with_options(const Work& w, std::int32_t first, std::int32_t last,
                                     PairChunk& p) noexcept {
  return forces_of_block<true, false>(w, first, last, p);
}
ABRADEM_DISPATCH double periodic(const Work& w, std::int32_t first, std::int32_t last,
                                 PairChunk& p) noexcept {
  return forces_of_block<false, true>(w, first, last, p);
}
ABRADEM_DISPATCH double periodic_with_options(const Work& w, std::int32_t first, std::int32_t last,
                                              PairChunk& p) noexcept {
  return forces_of_block<true, true>(w, first, last, p);
}

/// Blocks' own pairs first, then what comes from earlier blocks.
void add_far_loads(const SphereList& list, std::vector<LoadRow>& load) {
  core::parallel_for(
      list.far_target.size(),
      [&](std::size_t t) {
        LoadRow& own = load[at(list.far_target[t])];
        for (auto r = at(list.far_start[t]); r < at(list.far_start[t + 1]); ++r) own += list.far_load[r];
      },
      SphereList::kBlock);
}

}  // namespace

bool sphere_forces(const Spheres& spheres, SphereList& list, const PairTable& table, double dt,
                   std::vector<LoadRow>& load) {
  load.resize(spheres.size());
  std::vector<double> deepest(list.blocks(), -1.0);
  core::parallel_blocks(list.blocks(), [&](std::size_t b) {
    const std::size_t begin = b * SphereList::kBlock, end = std::min(begin + SphereList::kBlock, list.size());
    std::fill(load.begin() + static_cast<std::ptrdiff_t>(begin),
              load.begin() + static_cast<std::ptrdiff_t>(end), LoadRow{});
    PairChunk chunk;
    if (table.materials == 1)
      for (std::size_t k = 0; k < kCapacity; ++k) chunk.c.set_constants(k, table.pair[0]);
    const Work work{spheres.row.data(),
                    list.owner.data(),
                    list.partner.data(),
                    list.touching.data(),
                    list.far.data(),
                    list.spring.data(),
                    list.torque.empty() ? nullptr : list.torque.data(),
                    list.far_load.data(),
                    load.data(),
                    &table,
                    list.image.empty() ? nullptr : list.image.data(),
                    list.shifts.data(),
                    static_cast<std::int32_t>(end),
                    dt};
    const BlockForces closed = table.options ? periodic_with_options : periodic;
    const BlockForces open = table.options ? with_options : block_forces;
    const auto block = list.image.empty() ? open : closed;
    deepest[b] = block(work, list.start[begin], list.start[end], chunk);
  });
  add_far_loads(list, load);
  return std::ranges::none_of(deepest, [](double d) { return d > 0.0; });
}

namespace {

ABRADEM_DISPATCH Advance advance_block(SphereRow* __restrict sphere, const LoadRow* __restrict load,
                                       std::size_t count, const Vec3& gravity, double dt) noexcept {
  Advance met;
  const Quad fall{gravity.x * dt, gravity.y * dt, gravity.z * dt, 0.0}, step{dt, dt, dt, 0.0};
  double fastest2 = 0.0, longest2 = 0.0, stability = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    Quad* s = quads(sphere[i]);
    const Quad* l = quads(load[i]);
    const double R = sphere[i].radius, per_mass = dt * sphere[i].inverse_mass;
    const double per_inertia = per_mass * 2.5 / (R * R);
    const Quad m{per_mass, per_mass, per_mass, 0.0}, I{per_inertia, per_inertia, per_inertia, 0.0};
    const Quad v = s[1] + (l[0] * m + fall);
    s[1] = v;
    s[0] += v * step;
    s[2] += l[1] * I;
    const Quad v_2 = v * v;
    const double v2 = v_2[0] + v_2[1] + v_2[2], way2 = v2 / (R * R);
    const double number = load[i].stiffening * sphere[i].inverse_mass;
    met.finite &= v2 < 1e300;
    fastest2 = v2 > fastest2 ? v2 : fastest2;
    longest2 = way2 > longest2 ? way2 : longest2;
    stability = number > stability ? number : stability;
  }
  met.fastest2 = fastest2;
  met.longest = dt * std::sqrt(longest2);
  met.stability = stability;
  return met;
}

}  // namespace

Advance advance_spheres(std::span<SphereRow> spheres, std::span<const LoadRow> load, const Vec3& gravity,
                        double dt) {
  constexpr std::size_t kBlock = SphereList::kBlock;
  std::vector<Advance> met((spheres.size() + kBlock - 1) / kBlock);
  core::parallel_blocks(met.size(), [&](std::size_t b) {
    const std::size_t begin = b * kBlock, count = std::min(kBlock, spheres.size() - begin);
    met[b] = advance_block(spheres.data() + begin, load.data() + begin, count, gravity, dt);
  });
  Advance all;
  for (const Advance& m : met) {
    all.fastest2 = std::max(all.fastest2, m.fastest2);
    all.longest = std::max(all.longest, m.longest);
    all.stability = std::max(all.stability, m.stability);
    all.finite = all.finite && m.finite;
  }
  return all;
}

}  // namespace abradem::contact
