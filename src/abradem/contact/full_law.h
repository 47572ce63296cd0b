// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abradem/contact/contact_chunk.h"

/// The law of contacts that are more than Hertz-Mindlin: linear spring-dashpot, cohesion (SJKR, JKR), rolling
/// friction of types A and C, torsion. Elementwise over arrays, each contact with the options of its pair.
/// docs/theory/contact.md#beyond-hertz-mindlin
namespace abradem::contact {

/// What such contacts have besides a ContactChunk.
struct OptionsChunk {
  using Array = ContactChunk::Array;
  alignas(64) Array normal_k, tangential_k, damping, cohesion, adhesion, rolling_spring, torsion;
  Array area;        // SJKR: of the circle in which the bodies cut each other [m^2]
  Array a_c;         // JKR: contact radius at which a contact that is drawn apart snaps [m]; else > 0
  Array wx, wy, wz;  // in: spin of this body relative to the other [rad/s]; out: torque on it [N m]
  Array mx, my, mz;  // elastic rolling torque, in and out [N m]
  Array twist;       // elastic torque about the normal, in and out [N m]
  Array held;        // in: 1: it touched in the step before
  Array inertia;     // of the pair, about its centres [kg m^2]
  Array S_t;         // out: tangential stiffness [N/m]
  Array parted;      // out: 1: the contact is no more
  Array lost;        // out: power of the normal damper [W]

  ABRADEM_INLINE void set_constants(std::size_t k, const PairConstants& p) noexcept {
    normal_k[k] = p.options.normal_stiffness;
    tangential_k[k] = p.options.tangential_stiffness;
    damping[k] = p.damping;
    cohesion[k] = p.options.cohesion;
    adhesion[k] = p.options.adhesion;
    rolling_spring[k] = p.options.rolling_spring ? 1.0 : 0.0;
    torsion[k] = p.options.torsion ? 1.0 : 0.0;
  }
  void copy(std::size_t from, std::size_t to) noexcept {
    for (Array* a : {&normal_k, &tangential_k, &damping, &cohesion, &adhesion, &rolling_spring, &torsion,
                     &area, &a_c, &wx, &wy, &wz, &mx, &my, &mz, &twist, &held, &inertia})
      (*a)[to] = (*a)[from];
  }
};

/// JKR: contact radius at the snap (pi w R_eff^2 / (8 E_eff))^(1/3) [m]; 1 m without adhesion.
[[nodiscard]] inline double snapping_radius(const PairConstants& p, double R_eff) noexcept {
  constexpr double pi = 3.141592653589793;
  return p.options.adhesion > 0.0 ? std::cbrt(pi * p.options.adhesion * R_eff * R_eff / (6.0 * p.elastic))
                                  : 1.0;
}
/// How far a JKR contact is drawn out before it snaps, 3 a_c^2 / R_eff [m]; 0 without adhesion.
[[nodiscard]] inline double stretch_at_snap(const PairConstants& p, double R_eff) noexcept {
  const double a_c = snapping_radius(p, R_eff);
  return p.options.adhesion > 0.0 ? 3.0 * a_c * a_c / R_eff : 0.0;
}

/// The law over contacts 0 … count - 1; count a multiple of eight.
ABRADEM_INLINE void full_law_loop(ContactChunk& c, OptionsChunk& o, std::size_t count, double dt) noexcept {
  constexpr double pi = 3.141592653589793;
  const double inverse_dt = 1.0 / dt;
#pragma omp simd
  for (std::size_t k = 0; k < count; ++k) {
    const double nx = c.nx[k], ny = c.ny[k], nz = c.nz[k];
    const double vn = c.vx[k] * nx + c.vy[k] * ny + c.vz[k] * nz;
    const double tvx = c.vx[k] - vn * nx, tvy = c.vy[k] - vn * ny, tvz = c.vz[k] - vn * nz;
    const double R = c.R_eff[k], overlap = c.overlap[k], m = c.m_eff[k];

    // JKR: overlap = (a_c^2 / R) (u^4 - 4 u) with a = a_c u^2, on the stable branch u >= 1; with u = 1 + e it
    // is e^4 + 4 e^3 + 6 e^2 = beyond. Newton's method from above, where the left side is convex.
    const bool sticks = o.adhesion[k] > 0.0;
    const double a_c = o.a_c[k], beyond = overlap * R / (a_c * a_c) + 3.0, over = beyond > 0.0 ? beyond : 0.0;
    const double near = std::sqrt(over * (1.0 / 6.0)), far = std::sqrt(std::sqrt(over));
    double e = near < far ? near : far;
    for (int iteration = 0; iteration < 6; ++iteration) {
      const double value = ((e + 4.0) * e + 6.0) * e * e - over, slope = ((4.0 * e + 12.0) * e + 12.0) * e;
      e -= value / (slope + 1e-300);
    }
    const double u = 1.0 + e, u3 = u * u * u, pull = pi * o.adhesion[k] * R;
    const double adhesive = pull * (u3 * u3 * (1.0 / 6.0) - u3);
    const double depth = overlap > 0.0 ? overlap : 0.0, a_free = std::sqrt(R * depth);
    const double free = (c.elastic[k] * a_free + o.normal_k[k]) * depth;
    const bool apart = overlap <= 0.0, gone = sticks && o.held[k] > 0.0 ? beyond < 0.0 : apart;
    const double a = sticks ? a_c * u * u : a_free;
    const double elastic = sticks ? adhesive : free;
    // What friction stands on: the pressure between the bodies, without what cohesion takes off it.
    const double pressing = elastic + 3.0 * pull;

    const double S_n = c.normal[k] * a + o.normal_k[k], S_t = c.tangential[k] * a + o.tangential_k[k];
    const double D_n = o.damping[k] * std::sqrt(S_n * m), D_t = o.damping[k] * std::sqrt(S_t * m);
    const double damper = -D_n * vn;
    const double F_n = elastic - o.cohesion[k] * o.area[k] + damper;

    const double sx = c.sx[k], sy = c.sy[k], sz = c.sz[k], sn = sx * nx + sy * ny + sz * nz;
    const double px = sx - sn * nx, py = sy - sn * ny, pz = sz - sn * nz;
    const double length2 = sx * sx + sy * sy + sz * sz, projected2 = px * px + py * py + pz * pz;
    const double turned = std::sqrt(length2 / projected2), turn = projected2 > 0.0 ? turned : 0.0;
    const double ux = px * turn + tvx * dt, uy = py * turn + tvy * dt, uz = pz * turn + tvz * dt;
    const double limit = c.friction[k] * pressing, limit2 = limit * limit;
    const double trial2 = S_t * S_t * (ux * ux + uy * uy + uz * uz);
    const bool slips = trial2 > limit2;
    const double D = slips ? 0.0 : D_t;
    const double gx = -S_t * ux - D * tvx, gy = -S_t * uy - D * tvy, gz = -S_t * uz - D * tvz;
    const double size2 = gx * gx + gy * gy + gz * gz, size = std::sqrt(size2);
    const double ratio = limit / size, cut = size2 > limit2 ? ratio : 1.0, keep = slips ? cut : 1.0;
    const double on = gone ? 0.0 : 1.0;
    const double ftx = on * gx * cut, fty = on * gy * cut, ftz = on * gz * cut, normal = on * F_n;
    c.sx[k] = on * ux * keep;
    c.sy[k] = on * uy * keep;
    c.sz[k] = on * uz * keep;
    c.slip[k] = slips ? on * (size - limit) : 0.0;
    c.F_n[k] = normal;
    c.fx[k] = normal * nx + ftx;
    c.fy[k] = normal * ny + fty;
    c.fz[k] = normal * nz + ftz;
    c.stiffening[k] = on * (2.0 * D_n + S_n * dt) * dt;
    c.tx[k] = fty * nz - ftz * ny;
    c.ty[k] = ftz * nx - ftx * nz;
    c.tz[k] = ftx * ny - fty * nx;
    o.S_t[k] = S_t;
    o.parted[k] = 1.0 - on;
    o.lost[k] = on * D_n * vn * vn;

    // Rolling: a constant torque, or a spring of stiffness S_t R^2 that slides at the same torque (EPSD2).
    // Where torsion has a law of its own, and in type C always, only the part across the normal rolls.
    const double wx = o.wx[k], wy = o.wy[k], wz = o.wz[k], wn = wx * nx + wy * ny + wz * nz;
    const bool spring = o.rolling_spring[k] > 0.0, twists = o.torsion[k] > 0.0;
    const double across = spring || twists ? wn : 0.0;
    const double rx = wx - across * nx, ry = wy - across * ny, rz = wz - across * nz;
    const double load = pressing + damper > 0.0 ? pressing + damper : 0.0, most = c.rolling[k] * R * load;
    const double speed = std::sqrt(rx * rx + ry * ry + rz * rz), stopping = o.inertia[k] * speed * inverse_dt;
    const double torque = most < stopping ? most : stopping, per_speed = torque / speed;
    const double constant = speed > 0.0 ? -per_speed : 0.0;
    const double mn = o.mx[k] * nx + o.my[k] * ny + o.mz[k] * nz;
    const double qx = o.mx[k] - mn * nx, qy = o.my[k] - mn * ny, qz = o.mz[k] - mn * nz;
    const double m2 = o.mx[k] * o.mx[k] + o.my[k] * o.my[k] + o.mz[k] * o.mz[k];
    const double q2 = qx * qx + qy * qy + qz * qz, to_plane = std::sqrt(m2 / q2),
                 q = q2 > 0.0 ? to_plane : 0.0;
    const double kr = S_t * R * R * dt;
    const double ex = qx * q - kr * rx, ey = qy * q - kr * ry, ez = qz * q - kr * rz;
    const double e2 = ex * ex + ey * ey + ez * ez, most_ratio = most / std::sqrt(e2);
    const double hold = e2 > most * most ? most_ratio : 1.0, held = spring ? on * hold : 0.0;
    const double M_x = ex * held, M_y = ey * held, M_z = ez * held;
    o.mx[k] = M_x;
    o.my[k] = M_y;
    o.mz[k] = M_z;

    // Torsion: the friction of a circle of radius a that turns as a whole (Marshall 2009).
    const double half_a2 = 0.5 * a * a, most_twist = (2.0 / 3.0) * a * limit;
    const double trial = o.twist[k] - half_a2 * S_t * wn * dt;
    const double turned_back = trial > most_twist ? most_twist : trial;
    const double elastic_twist = turned_back < -most_twist ? -most_twist : turned_back;
    const double damped = elastic_twist - (trial == elastic_twist ? half_a2 * D_t * wn : 0.0);
    const double below = damped > most_twist ? most_twist : damped;
    const double whole = below < -most_twist ? -most_twist : below;
    const double T = twists ? on * whole : 0.0;
    o.twist[k] = twists ? on * elastic_twist : 0.0;

    const double roll = spring ? 0.0 : on * constant;
    o.wx[k] = M_x + roll * rx + T * nx;
    o.wy[k] = M_y + roll * ry + T * ny;
    o.wz[k] = M_z + roll * rz + T * nz;
  }
}

}  // namespace abradem::contact
