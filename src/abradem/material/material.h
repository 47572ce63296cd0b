// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Elastic materials and what a pair of them has in common in a contact.      docs/theory/contact.md
namespace abradem::material {

struct Material {
  double density = 0.0;        ///< [kg/m^3]
  double shear_modulus = 0.0;  ///< G [Pa]
  double poisson_ratio = 0.0;  ///< nu [-]
};

/// What a contact does besides, or instead of, Hertz-Mindlin with a constant rolling torque; all zero:
/// nothing. docs/theory/contact.md#beyond-hertz-mindlin
struct ContactOptions {
  double normal_stiffness = 0.0;      ///< > 0: linear spring-dashpot instead of Hertz-Mindlin [N/m]
  double tangential_stiffness = 0.0;  ///< of the linear law [N/m]
  double cohesion = 0.0;              ///< SJKR: force per area of contact [J/m^3 = Pa]
  double adhesion = 0.0;              ///< JKR: work of adhesion w [J/m^2]
  bool rolling_spring = false;        ///< rolling friction of type C (EPSD2) instead of a constant torque
  bool torsion = false;               ///< resistance against spin about the normal (Marshall 2009)
  [[nodiscard]] bool any() const noexcept {
    return normal_stiffness > 0.0 || cohesion > 0.0 || adhesion > 0.0 || rolling_spring || torsion;
  }
  [[nodiscard]] bool linear() const noexcept { return normal_stiffness > 0.0; }
  /// Is the normal force that of Hertz with its damper, and nothing besides?
  [[nodiscard]] bool damped_hertz() const noexcept {
    return normal_stiffness == 0.0 && cohesion == 0.0 && adhesion == 0.0;
  }
};

/// What a Hertz-Mindlin contact needs of two materials.
struct PairProperties {
  double E_eff = 0.0;             ///< effective Young's modulus, 1/E_eff = sum (1 - nu^2) / E [Pa]
  double G_eff = 0.0;             ///< effective shear modulus, 1/G_eff = sum (2 - nu) / G [Pa]
  double beta = 0.0;              ///< damping ratio |ln e| / sqrt(ln^2 e + pi^2) [-]
  double static_friction = 0.0;   ///< mu [-]
  double rolling_friction = 0.0;  ///< mu_r [-]
  ContactOptions options = {};
};

/// E = 2 G (1 + nu) [Pa].
[[nodiscard]] double youngs_modulus(const Material& material) noexcept;

/// Damping ratio of a coefficient of restitution e in (0, 1]; e = 1 gives 0.
[[nodiscard]] double damping_ratio(double restitution) noexcept;

/// Effective moduli of two elastic bodies; damping and friction are left at zero.
[[nodiscard]] PairProperties effective_moduli(const Material& a, const Material& b) noexcept;

/// Effective moduli against a rigid counter-body: E* = E / (1 - nu^2), G* = G / (2 - nu).
[[nodiscard]] PairProperties effective_moduli_on_rigid(const Material& a) noexcept;

/// Time a Rayleigh wave needs around a sphere [s], pi R sqrt(rho/G) / (0.1631 nu + 0.8766).
[[nodiscard]] double rayleigh_time(const Material& material, double radius) noexcept;

/// Duration of an elastic Hertz impact at speed v [s], 2.87 (m^2 / (R E_eff^2 v))^(1/5).
[[nodiscard]] double hertz_time(double E_eff, double R_eff, double m_eff, double speed) noexcept;

}  // namespace abradem::material
