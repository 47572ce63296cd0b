// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/contact/sphere_forces.h"

#include <algorithm>
#include <atomic>

#include "abradem/contact/full_law.h"
#include "abradem/contact/quads.h"
#include "abradem/core/parallel.h"
#include "abradem/core/prefetch.h"

namespace abradem::contact {

namespace {

std::size_t at(std::int32_t i) noexcept { return static_cast<std::size_t>(i); }

constexpr std::size_t kCapacity = ContactChunk::kCapacity;

/// Pairs of one block on their way through the law.
struct PairChunk {
  ContactChunk c;
  ContactChunk::Array reach, inverse_mass, R_i, ux, uy, uz;
  OptionsChunk o;  // torques of rolling; the rest only where a pair has options
};

/// Columns of a ContactBlock from some pair on, and what the pairs act on.
struct Work {
  const SphereRow* __restrict sphere;
  const std::int32_t* __restrict i;
  const std::int32_t* __restrict j;
  const std::int32_t* __restrict row;
  std::uint8_t* __restrict touching;
  double* __restrict sx;
  double* __restrict sy;
  double* __restrict sz;
  SpringRow* __restrict torque;          ///< null where none are remembered
  const std::uint8_t* __restrict image;  ///< null where nothing is periodic
  const SpringRow* __restrict shift;
  LoadRow* __restrict load;
  const PairTable* table;
  double dt;

  bool one_material;  ///< the chunk holds the constants

  [[nodiscard]] const PairConstants& constants(std::size_t k) const noexcept {
    return table->of(sphere[i[k]].material, sphere[j[k]].material);
  }
};

/// Rows of the chunk's pairs turned into arrays: offsets, relative velocity, spins times radii; and springs.
template <bool kPeriodic>
ABRADEM_INLINE void gather(const Work& w, PairChunk& p, std::size_t count) noexcept {
  const Quad minus{-1.0, -1.0, -1.0, 1.0};
  for (std::size_t k = 0; k < count; k += 4) {
    Quad d[4], v[4], u[4];
    for (std::size_t m = 0; m < 4; ++m) {
      const SphereRow& i = w.sphere[w.i[k + m]];
      const SphereRow& j = w.sphere[w.j[k + m]];
      d[m] = quads(i)[0] + quads(j)[0] * minus;  // the last: sum of the radii
      if constexpr (kPeriodic) d[m] += quad(w.shift[w.image[k + m]]);
      v[m] = quads(i)[1] + quads(j)[1] * minus;  // the last: sum of the inverse masses
      u[m] = quads(i)[2] * i.radius + quads(j)[2] * j.radius;
      p.R_i[k + m] = i.radius;
    }
    transpose(d[0], d[1], d[2], d[3]);
    transpose(v[0], v[1], v[2], v[3]);
    transpose(u[0], u[1], u[2], u[3]);
    quad_at(p.c.nx + k) = d[0], quad_at(p.c.ny + k) = d[1], quad_at(p.c.nz + k) = d[2];
    quad_at(p.reach + k) = d[3];
    quad_at(p.c.vx + k) = v[0], quad_at(p.c.vy + k) = v[1], quad_at(p.c.vz + k) = v[2];
    quad_at(p.inverse_mass + k) = v[3];
    quad_at(p.ux + k) = u[0], quad_at(p.uy + k) = u[1], quad_at(p.uz + k) = u[2];
  }
#pragma omp simd
  for (std::size_t k = 0; k < count; ++k) p.c.sx[k] = w.sx[k], p.c.sy[k] = w.sy[k], p.c.sz[k] = w.sz[k];
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
    const SphereRow& i = w.sphere[w.i[k]];
    const SphereRow& j = w.sphere[w.j[k]];
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
    const PairConstants& constants = w.constants(k);
    c.set_constants(k, constants);
    o.set_constants(k, constants);
    o.a_c[k] = snapping_radius(constants, c.R_eff[k]);
    o.held[k] = w.touching[k] != 0 ? 1.0 : 0.0;
    const SpringRow torque = w.torque != nullptr ? w.torque[k] : SpringRow{};
    o.mx[k] = torque.x, o.my[k] = torque.y, o.mz[k] = torque.z, o.twist[k] = torque.twist;
    const double d = p.reach[k] - c.overlap[k], difference = p.R_i[k] - (p.reach[k] - p.R_i[k]);
    o.area[k] = quarter_pi * c.overlap[k] * (d + p.reach[k]) * (d - difference) * (d + difference) / (d * d);
  }
  full_law_loop(c, o, count, w.dt);
  for (std::size_t k = 0; k < count; ++k) {
    if (w.torque != nullptr) w.torque[k] = {o.mx[k], o.my[k], o.mz[k], o.twist[k]};
    w.touching[k] = o.parted[k] > 0.0 ? 0 : 1;
  }
}

/// Arrays turned back into rows and added to the spheres, pair by pair in the order of the list.
template <bool kRolling>
ABRADEM_INLINE void scatter(const Work& w, PairChunk& p, std::size_t count) noexcept {
  ContactChunk& c = p.c;
  const Quad minus{-1.0, -1.0, -1.0, 1.0};
  for (std::size_t k = 0; k < count; k += 4) {
    Quad f[4]{quad_at(c.fx + k), quad_at(c.fy + k), quad_at(c.fz + k), quad_at(c.stiffening + k)};
    Quad t[4]{quad_at(c.tx + k), quad_at(c.ty + k), quad_at(c.tz + k), Quad{}};
    Quad r[4]{};
    transpose(f[0], f[1], f[2], f[3]);
    transpose(t[0], t[1], t[2], t[3]);
    if constexpr (kRolling) {
      r[0] = quad_at(p.o.wx + k), r[1] = quad_at(p.o.wy + k), r[2] = quad_at(p.o.wz + k);
      transpose(r[0], r[1], r[2], r[3]);
    }
    const std::size_t here = std::min<std::size_t>(4, count - k);
    for (std::size_t m = 0; m < here; ++m) {
      const std::int32_t i = w.i[k + m], j = w.j[k + m];
      Quad* own = quads(w.load[i]);
      Quad* other = quads(w.load[w.row[k + m]]);
      const Quad on_i = t[m] * w.sphere[i].radius, on_j = t[m] * w.sphere[j].radius;
      own[0] += f[m];
      own[1] += kRolling ? on_i + r[m] : on_i;
      other[0] += f[m] * minus;
      other[1] += kRolling ? on_j - r[m] : on_j;
    }
  }
}

/// The law over `count` pairs. @return largest overlap beyond kDeepest R_eff [m], or less than 0
template <bool kOptions, bool kPeriodic>
ABRADEM_INLINE double forces_of_chunk(const Work& w, PairChunk& p, std::size_t count) noexcept {
  const std::size_t padded = ContactBlock::padded(count);
  gather<kPeriodic>(w, p, padded);
  const double deepest = meet(p, padded);
  if constexpr (kOptions) {
    full_law(w, p, padded);
  } else {
    if (!w.one_material)
      for (std::size_t k = 0; k < padded; ++k) p.c.set_constants(k, w.constants(k));
    hertz_mindlin_loop(p.c, padded, w.dt);
    for (std::size_t k = 0; k < padded; ++k) w.touching[k] = p.c.overlap[k] > 0.0 ? 1 : 0;
  }
#pragma omp simd
  for (std::size_t k = 0; k < padded; ++k) w.sx[k] = p.c.sx[k], w.sy[k] = p.c.sy[k], w.sz[k] = p.c.sz[k];
  if (kOptions) {
    scatter<true>(w, p, count);
  } else if (w.table->rolling) {
    roll(w, p, padded);
    scatter<true>(w, p, count);
  } else {
    scatter<false>(w, p, count);
  }
  return deepest;
}

/// All pairs of one block, chunk by chunk.
template <bool kOptions, bool kPeriodic>
ABRADEM_INLINE double forces_of_block(const Work& block, std::size_t count, PairChunk& p) noexcept {
  double deepest = -1.0;
  Work w = block;
  for (std::size_t done = 0; done < count; done += kCapacity) {
    // Partners lie here and there: ask early for those that will be needed.
    for (std::size_t k = kCapacity; k < std::min(2 * kCapacity, count - done); ++k) {
      core::prefetch(w.sphere + w.j[k], sizeof(SphereRow));
    }
    deepest =
        std::max(deepest, forces_of_chunk<kOptions, kPeriodic>(w, p, std::min(kCapacity, count - done)));
    w.i += kCapacity, w.j += kCapacity, w.row += kCapacity, w.touching += kCapacity;
    w.sx += kCapacity, w.sy += kCapacity, w.sz += kCapacity;
    if (w.torque != nullptr) w.torque += kCapacity;
    if constexpr (kPeriodic) w.image += kCapacity;
  }
  return deepest;
}

using BlockForces = double (*)(const Work&, std::size_t, PairChunk&) noexcept;
ABRADEM_DISPATCH double block_forces(const Work& w, std::size_t count, PairChunk& p) noexcept {
  return forces_of_block<false, false>(w, count, p);
}
ABRADEM_DISPATCH double with_options(const Work& w, std::size_t count, PairChunk& p) noexcept {
  return forces_of_block<true, false>(w, count, p);
}
ABRADEM_DISPATCH double periodic(const Work& w, std::size_t count, PairChunk& p) noexcept {
  return forces_of_block<false, true>(w, count, p);
}
ABRADEM_DISPATCH double periodic_with_options(const Work& w, std::size_t count, PairChunk& p) noexcept {
  return forces_of_block<true, true>(w, count, p);
}

ABRADEM_DISPATCH Advance advance_block(SphereRow* __restrict sphere, const LoadRow* __restrict load,
                                       std::size_t count, const Vec3& gravity, double dt) noexcept {
  const Quad fall{gravity.x * dt, gravity.y * dt, gravity.z * dt, 0.0}, step{dt, dt, dt, 0.0};
  Quad most{};  // of v^2, (v / R)^2 and 2 g + W
  bool finite = true;
  for (std::size_t i = 0; i < count; ++i) {
    Quad* s = quads(sphere[i]);
    const Quad* l = quads(load[i]);
    const double R = sphere[i].radius, per_R2 = 1.0 / (R * R), per_mass = dt * sphere[i].inverse_mass;
    const double per_inertia = per_mass * 2.5 * per_R2;
    const Quad m{per_mass, per_mass, per_mass, 0.0}, I{per_inertia, per_inertia, per_inertia, 0.0};
    const Quad v = s[1] + (l[0] * m + fall);
    s[1] = v;
    s[0] += v * step;
    s[2] += l[1] * I;
    const Quad v_2 = v * v;
    const double v2 = v_2[0] + v_2[1] + v_2[2];
    const Quad here{v2, v2 * per_R2, load[i].stiffening * sphere[i].inverse_mass, 0.0};
    most = here > most ? here : most;
    finite &= v2 < 1e300;
  }
  return {most[0], dt * std::sqrt(most[1]), most[2], finite, true};
}

/// Forces of one step, block by block.
struct Step {
  const Spheres& spheres;
  SphereList& list;
  const PairTable& table;
  double dt;
  LoadRows& load;

  [[nodiscard]] std::size_t begin(std::size_t b) const noexcept { return b * SphereList::kBlock; }
  [[nodiscard]] std::size_t end(std::size_t b) const noexcept {
    return std::min(begin(b) + SphereList::kBlock, list.size());
  }

  /// What a block's pairs do to its spheres and to its guests. @return whether none overlap too deeply
  bool forces(std::size_t b) const {
    const auto clear = [&](std::size_t from, std::size_t to) {
      std::fill(load.begin() + static_cast<std::ptrdiff_t>(from),
                load.begin() + static_cast<std::ptrdiff_t>(to), LoadRow{});
    };
    clear(begin(b), end(b));
    clear(list.size() + at(list.guest_start[b]), list.size() + at(list.guest_start[b + 1]));
    PairChunk chunk;
    if (list.one_material()) {
      const double m = spheres.row.front().material;
      for (std::size_t k = 0; k < kCapacity; ++k) chunk.c.set_constants(k, table.of(m, m));
    }
    ContactBlock& block = list.near[b];
    const Work work{spheres.row.data(),
                    block.i.data(),
                    block.j.data(),
                    block.row.data(),
                    block.touching.data(),
                    block.sx.data(),
                    block.sy.data(),
                    block.sz.data(),
                    block.torque.empty() ? nullptr : block.torque.data(),
                    block.image.empty() ? nullptr : block.image.data(),
                    list.shifts.data(),
                    load.data(),
                    &table,
                    dt,
                    list.one_material()};
    const BlockForces closed = table.options ? periodic_with_options : periodic;
    const BlockForces open = table.options ? with_options : block_forces;
    return !((block.image.empty() ? open : closed)(work, block.count, chunk) > 0.0);
  }

  /// What a block's spheres have met as guests of earlier blocks; these must have had their forces.
  void add_guest_loads(std::size_t b) const {
    for (const SphereList::Visit& visit : list.visitors[b])
      for (auto g = at(visit.begin); g < at(visit.end); ++g) load[at(list.guest[g])] += load[list.size() + g];
  }
};

/// What the rows hold is of the step before, and goes: a copy would stand beside the old ones.
void make_room(LoadRows& load, std::size_t rows) {
  if (load.capacity() < rows) {
    LoadRows().swap(load);
    load.reserve(rows + rows / 32);
  }
  load.resize(rows);
}

Advance together(const std::vector<Advance>& blocks) {
  Advance all;
  for (const Advance& m : blocks) {
    all.fastest2 = std::max(all.fastest2, m.fastest2);
    all.longest = std::max(all.longest, m.longest);
    all.stability = std::max(all.stability, m.stability);
    all.finite = all.finite && m.finite;
    all.sound = all.sound && m.sound;
  }
  return all;
}

}  // namespace

bool sphere_forces(const Spheres& spheres, SphereList& list, const PairTable& table, double dt,
                   LoadRows& load) {
  make_room(load, list.load_rows());
  const Step step{spheres, list, table, dt, load};
  std::vector<std::uint8_t> sound(list.blocks());
  core::parallel_blocks(list.blocks(), [&](std::size_t b) { sound[b] = step.forces(b) ? 1 : 0; });
  core::parallel_blocks(list.blocks(), [&](std::size_t b) { step.add_guest_loads(b); });
  return std::ranges::all_of(sound, [](std::uint8_t s) { return s != 0; });
}

Advance advance_spheres(std::span<SphereRow> spheres, std::span<const LoadRow> load, const Vec3& gravity,
                        double dt) {
  constexpr std::size_t kBlock = SphereList::kBlock;
  std::vector<Advance> met((spheres.size() + kBlock - 1) / kBlock);
  core::parallel_blocks(met.size(), [&](std::size_t b) {
    const std::size_t begin = b * kBlock, count = std::min(kBlock, spheres.size() - begin);
    met[b] = advance_block(spheres.data() + begin, load.data() + begin, count, gravity, dt);
  });
  return together(met);
}

Advance forces_and_advance(Spheres& spheres, SphereList& list, const PairTable& table, double dt,
                           LoadRows& load, const Vec3& gravity, const AddLoads& add_loads) {
  make_room(load, list.load_rows());
  const Step step{spheres, list, table, dt, load};
  std::vector<Advance> met(list.blocks());
  std::vector<std::atomic<bool>> has_forces(list.blocks());
  std::vector<std::uint8_t> moved(list.blocks(), 0);
  const auto move = [&](std::size_t b) {
    step.add_guest_loads(b);
    add_loads(step.begin(b), step.end(b));
    const bool sound = met[b].sound;
    met[b] = advance_block(spheres.row.data() + step.begin(b), load.data() + step.begin(b),
                           step.end(b) - step.begin(b), gravity, dt);
    met[b].sound = sound;
    moved[b] = 1;
  };
  core::parallel_blocks(list.blocks(), [&](std::size_t b) {
    met[b].sound = step.forces(b);
    has_forces[b].store(true, std::memory_order_release);
    const bool free = std::ranges::all_of(list.visitors[b], [&](const SphereList::Visit& visit) {
      return has_forces[at(visit.block)].load(std::memory_order_acquire);
    });
    if (free) move(b);
  });
  core::parallel_blocks(list.blocks(), [&](std::size_t b) {
    if (moved[b] == 0) move(b);
  });
  return together(met);
}

}  // namespace abradem::contact
