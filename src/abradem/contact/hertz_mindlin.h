// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "abradem/core/vec3.h"
#include "abradem/material/material.h"

/// Hertz-Mindlin (no slip) contact of two bodies, as pure functions.            docs/theory/contact.md
///
///   symbol   meaning                                                     unit
///   R_eff    effective radius, 1/R_eff = 1/R_i + 1/R_j (wall: R)         m
///   m_eff    effective mass,   1/m_eff = 1/m_i + 1/m_j (wall: m)         kg
///   delta    overlap, > 0 in contact                                     m
///   a        contact radius sqrt(R_eff delta)                            m
///   S_n, S_t stiffnesses 2 E_eff a and 8 G_eff a                         N/m
///   n        unit normal, from the other body to this one                -
///   v_n      normal relative velocity, > 0 when parting                  m/s
///   s        tangential spring (elastic displacement of this body)       m
namespace abradem::contact {

using material::PairProperties;

[[nodiscard]] inline double contact_radius(double R_eff, double delta) noexcept {
  return std::sqrt(R_eff * delta);
}
[[nodiscard]] inline double normal_stiffness(const PairProperties& p, double a) noexcept {
  return 2.0 * p.E_eff * a;
}
[[nodiscard]] inline double tangential_stiffness(const PairProperties& p, double a) noexcept {
  return 8.0 * p.G_eff * a;
}

/// Elastic normal force (4/3) E_eff sqrt(R_eff) delta^(3/2) = (2/3) S_n delta [N]   [paper, eq. 1]
[[nodiscard]] inline double hertz_force(const PairProperties& p, double R_eff, double delta) noexcept {
  return (2.0 / 3.0) * normal_stiffness(p, contact_radius(R_eff, delta)) * delta;
}

/// Hertz approach of a load [m]: delta = (9 F^2 / (16 E_eff^2 R_eff))^(1/3).
[[nodiscard]] inline double hertz_overlap(const PairProperties& p, double R_eff, double force) noexcept {
  return std::cbrt(9.0 * force * force / (16.0 * p.E_eff * p.E_eff * R_eff));
}

/// Coefficient of the viscous part for a stiffness S: 2 sqrt(5/6) beta sqrt(S m_eff) [N s/m]; with the short
/// attractive tail kept, the pair returns its restitution at any impact speed (Tsuji et al. 1992).
[[nodiscard]] inline double damping_coefficient(const PairProperties& p, double S, double m_eff) noexcept {
  constexpr double two_sqrt_5_6 = 1.8257418583505538;
  return two_sqrt_5_6 * p.beta * std::sqrt(S * m_eff);
}

/// Stiffness and damping coefficient that a step has to be short enough for: those of the pair's law.
[[nodiscard]] inline double step_stiffness(const PairProperties& p, double a) noexcept {
  return p.options.linear() ? p.options.normal_stiffness : normal_stiffness(p, a);
}
[[nodiscard]] inline double step_damping(const PairProperties& p, double S, double m_eff) noexcept {
  return p.options.linear() ? 2.0 * p.beta * std::sqrt(S * m_eff) : damping_coefficient(p, S, m_eff);
}

/// What a contact remembers from step to step.
struct TangentialHistory {
  Vec3 s;              ///< elastic tangential displacement [m]
  Vec3 rolling;        ///< elastic torque of rolling friction of type C [N m]
  double twist = 0.0;  ///< elastic torque about the normal [N m]

  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("s", self.s)("rolling", self.rolling)("twist", self.twist);
  }
};

/// Kinematics of one contact at one step. Velocities are of this body relative to the other, at the contact.
struct ContactState {
  Vec3 n;
  double elastic_force = 0.0;  ///< normal, without damping [N]
  double a = 0.0;              ///< contact radius [m]
  double m_eff = 0.0;          ///< [kg]
  Vec3 v;                      ///< relative velocity [m/s]
};

struct ContactForce {
  double F_n = 0.0;   ///< normal force with damping; < 0 in the short tail before release [N]
  Vec3 F_t;           ///< tangential force on this body [N]
  double slip = 0.0;  ///< plastic sliding of this step: what the spring did not take up [m]
  double v_t = 0.0;   ///< tangential speed [m/s]

  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("F_n", self.F_n)("F_t", self.F_t)("slip", self.slip)("v_t", self.v_t);
  }
};

/// The spring turned into the plane of the new normal, at its length.
[[nodiscard]] inline Vec3 rotate_into_plane(const Vec3& s, const Vec3& n) noexcept {
  const Vec3 projected = s - dot(s, n) * n;
  const double length2 = norm2(s), projected2 = norm2(projected);
  return projected2 > 0.0 ? projected * std::sqrt(length2 / projected2) : Vec3{};
}

/// One step of the force law.                                                    [paper, eq. 1-2]
///   F_n = elastic - D_n v_n,   F_t = -S_t s - D_t v_t,   |F_t| <= mu elastic
/// Order: turn s into the new plane, at its length; add v_t dt; stick with damping, or slip without it and
/// cut s back to Coulomb's cone. The length cut off is the plastic slip: path = change of s + slip, exactly.
/// The cone stands on the elastic force: the damper's impulse over an impact is nil, so the friction impulse
/// is mu times the normal impulse; max(F_n, 0) would leave out the attractive tail and give 3 % too much at e
/// = 0.5. s is not rescaled when a changes. What that means for energy, and what other rules do:
/// docs/theory/contact.md
[[nodiscard]] inline ContactForce hertz_mindlin(const PairProperties& p, const ContactState& c, double dt,
                                                TangentialHistory& history) noexcept {
  ContactForce f;
  const double v_n = dot(c.v, c.n);
  const Vec3 v_t = c.v - v_n * c.n;
  f.v_t = norm(v_t);
  f.F_n = c.elastic_force - damping_coefficient(p, normal_stiffness(p, c.a), c.m_eff) * v_n;

  const double S_t = tangential_stiffness(p, c.a);
  Vec3 s = rotate_into_plane(history.s, c.n);
  s += v_t * dt;
  const double length = norm(s);
  const double limit = p.static_friction * c.elastic_force;
  if (S_t * length > limit) {
    const double elastic_length = limit / S_t;
    f.slip = length - elastic_length;
    f.F_t = s * (-limit / length);
    s *= elastic_length / length;
  } else {
    f.F_t = -S_t * s - damping_coefficient(p, S_t, c.m_eff) * v_t;
    const double magnitude = norm(f.F_t);
    if (magnitude > limit) f.F_t *= limit / magnitude;
  }
  history.s = s;
  return f;
}

/// Rolling resistance of constant torque, mu_r R_eff max(F_n, 0) against the relative rolling spin [N m];
/// capped so that one step cannot reverse the spin (inertia I).           docs/theory/contact.md#rolling
[[nodiscard]] inline Vec3 rolling_torque(const PairProperties& p, double R_eff, double F_n, const Vec3& spin,
                                         double I, double dt) noexcept {
  const double speed = norm(spin);
  if (speed == 0.0 || p.rolling_friction == 0.0) return {};
  const double magnitude = std::min(p.rolling_friction * R_eff * std::max(F_n, 0.0), I * speed / dt);
  return spin * (-magnitude / speed);
}

}  // namespace abradem::contact
