// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "abradem/contact/sphere_rows.h"
#include "abradem/core/simd.h"
#include "abradem/material/material.h"

/// Hertz-Mindlin over many contacts at once: the law of hertz_mindlin.h, elementwise over arrays that stay in
/// the first-level cache. Loops are inlined into functions marked ABRADEM_DISPATCH.
namespace abradem::contact {

/// What the law needs of a pair of materials, multiplied out; a symmetric table of these by material.
struct PairConstants {
  double elastic = 0.0;     ///< (4/3) E_eff: F = elastic a overlap [Pa]
  double normal = 0.0;      ///< 2 E_eff: S_n = normal a [Pa]
  double tangential = 0.0;  ///< 8 G_eff: S_t = tangential a [Pa]
  double damping_n = 0.0;   ///< D_n = damping_n sqrt(a m_eff)
  double damping_t = 0.0;   ///< D_t likewise
  double friction = 0.0;    ///< mu
  double rolling = 0.0;     ///< mu_r
  double damping = 0.0;     ///< D = damping sqrt(S m_eff)
  material::ContactOptions options;
  [[nodiscard]] static PairConstants of(const material::PairProperties& p) noexcept {
    constexpr double two_sqrt_5_6 = 1.8257418583505538;
    // The linear law's damper is that of a linear oscillator, and Hertz's springs are not there.
    if (p.options.linear())
      return {.friction = p.static_friction,
              .rolling = p.rolling_friction,
              .damping = 2.0 * p.beta,
              .options = p.options};
    return {4.0 / 3.0 * p.E_eff,
            2.0 * p.E_eff,
            8.0 * p.G_eff,
            two_sqrt_5_6 * p.beta * std::sqrt(2.0 * p.E_eff),
            two_sqrt_5_6 * p.beta * std::sqrt(8.0 * p.G_eff),
            p.static_friction,
            p.rolling_friction,
            two_sqrt_5_6 * p.beta,
            p.options};
  }
};

/// Two overlap too deeply beyond this part of their effective radius (a tenth of the radius, for equal
/// spheres): Hertz's small contact is long gone.
inline constexpr double kDeepest = 0.2;

/// Constants of every pair of materials.
struct PairTable {
  std::size_t materials = 0;
  std::vector<PairConstants> pair;  ///< materials x materials
  bool rolling = false;             ///< any rolling friction at all
  bool options = false;             ///< any contact that is more than Hertz-Mindlin and a constant torque
  bool adhesion = false;            ///< any JKR: contacts that last beyond zero overlap
  [[nodiscard]] const PairConstants& of(double a, double b) const noexcept {
    return pair[static_cast<std::size_t>(a) * materials + static_cast<std::size_t>(b)];
  }
};

/// Contacts side by side; symbols of hertz_mindlin.h. Elements beyond the last contact hold harmless numbers.
struct ContactChunk {
  static constexpr std::size_t kCapacity = 32;
  using Array = double[kCapacity];
  // Given: this body relative to the other.
  alignas(64) Array nx, ny, nz, overlap, R_eff, m_eff, vx, vy, vz;
  Array sx, sy, sz;                                                            // spring, in and out
  Array elastic, normal, tangential, damping_n, damping_t, friction, rolling;  // constants of the pair
  // Found.
  Array fx, fy, fz, F_n;  // force on this body [N]
  Array stiffening;       // 2 D_n dt + S_n dt^2: what the step's stability depends on [kg]
  Array tx, ty, tz;       // F_t x n: torque per lever arm [N]
  Array slip;             // plastic sliding times S_t [N]

  ABRADEM_INLINE void set_constants(std::size_t k, const PairConstants& p) noexcept {
    elastic[k] = p.elastic;
    normal[k] = p.normal;
    tangential[k] = p.tangential;
    damping_n[k] = p.damping_n;
    damping_t[k] = p.damping_t;
    friction[k] = p.friction;
    rolling[k] = p.rolling;
  }
  /// What is given of contact `from`, to fill up a loop with.
  void copy(std::size_t from, std::size_t to) noexcept {
    for (Array* a : {&nx, &ny, &nz, &overlap, &R_eff, &m_eff, &vx, &vy, &vz, &sx, &sy, &sz, &elastic, &normal,
                     &tangential, &damping_n, &damping_t, &friction, &rolling})
      (*a)[to] = (*a)[from];
  }
};

/// The law over contacts 0 … count - 1; count a multiple of eight. Where nothing overlaps, all comes out as
/// 0. docs/theory/contact.md
ABRADEM_INLINE void hertz_mindlin_loop(ContactChunk& c, std::size_t count, double dt) noexcept {
#pragma omp simd
  for (std::size_t k = 0; k < count; ++k) {
    const double nx = c.nx[k], ny = c.ny[k], nz = c.nz[k];
    const double vn = c.vx[k] * nx + c.vy[k] * ny + c.vz[k] * nz;
    const double tvx = c.vx[k] - vn * nx, tvy = c.vy[k] - vn * ny, tvz = c.vz[k] - vn * nz;
    const bool meets = c.overlap[k] > 0.0;
    const double depth = meets ? c.overlap[k] : 0.0;
    const double a = std::sqrt(c.R_eff[k] * depth);
    const double root = std::sqrt(a * c.m_eff[k]);
    const double elastic = c.elastic[k] * a * depth;
    const double D_n = c.damping_n[k] * root, D_t = c.damping_t[k] * root, S_t = c.tangential[k] * a;
    const double F_n = elastic - D_n * vn;

    // The spring turned into the plane of the normal, at its length, and moved on.
    const double sx = c.sx[k], sy = c.sy[k], sz = c.sz[k], sn = sx * nx + sy * ny + sz * nz;
    const double px = sx - sn * nx, py = sy - sn * ny, pz = sz - sn * nz;
    const double length2 = sx * sx + sy * sy + sz * sz, projected2 = px * px + py * py + pz * pz;
    const double turned = std::sqrt(length2 / projected2), turn = projected2 > 0.0 ? turned : 0.0;
    const double ux = px * turn + tvx * dt, uy = py * turn + tvy * dt, uz = pz * turn + tvz * dt;

    // Stick with damping, or slip without it; either is cut back to Coulomb's cone.
    const double limit = c.friction[k] * elastic, limit2 = limit * limit;
    const double trial2 = S_t * S_t * (ux * ux + uy * uy + uz * uz);
    const bool slips = trial2 > limit2;
    const double D = slips ? 0.0 : D_t;
    const double gx = -S_t * ux - D * tvx, gy = -S_t * uy - D * tvy, gz = -S_t * uz - D * tvz;
    const double size2 = gx * gx + gy * gy + gz * gz, size = std::sqrt(size2);
    const double ratio = limit / size, cut = size2 > limit2 ? ratio : 1.0, keep = slips ? cut : 1.0;
    const double ftx = gx * cut, fty = gy * cut, ftz = gz * cut;
    c.sx[k] = meets ? ux * keep : 0.0;
    c.sy[k] = meets ? uy * keep : 0.0;
    c.sz[k] = meets ? uz * keep : 0.0;
    c.slip[k] = slips ? size - limit : 0.0;
    c.F_n[k] = F_n;
    c.fx[k] = F_n * nx + ftx;
    c.fy[k] = F_n * ny + fty;
    c.fz[k] = F_n * nz + ftz;
    c.stiffening[k] = (2.0 * D_n + c.normal[k] * a * dt) * dt;
    c.tx[k] = fty * nz - ftz * ny;
    c.ty[k] = ftz * nx - ftx * nz;
    c.tz[k] = ftx * ny - fty * nx;
  }
}

}  // namespace abradem::contact
