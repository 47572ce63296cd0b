// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/material/material.h"

#include <cmath>
#include <numbers>

namespace abradem::material {

double youngs_modulus(const Material& material) noexcept {
  return 2.0 * material.shear_modulus * (1.0 + material.poisson_ratio);
}

double damping_ratio(double restitution) noexcept {
  const double log_e = std::log(restitution);
  return std::abs(log_e) / std::sqrt(log_e * log_e + std::numbers::pi * std::numbers::pi);
}

namespace {
double normal_compliance(const Material& m) noexcept {
  return (1.0 - m.poisson_ratio * m.poisson_ratio) / youngs_modulus(m);
}
double shear_compliance(const Material& m) noexcept { return (2.0 - m.poisson_ratio) / m.shear_modulus; }
}  // namespace

PairProperties effective_moduli(const Material& a, const Material& b) noexcept {
  PairProperties pair;
  pair.E_eff = 1.0 / (normal_compliance(a) + normal_compliance(b));
  pair.G_eff = 1.0 / (shear_compliance(a) + shear_compliance(b));
  return pair;
}

PairProperties effective_moduli_on_rigid(const Material& a) noexcept {
  PairProperties pair;
  pair.E_eff = 1.0 / normal_compliance(a);
  pair.G_eff = 1.0 / shear_compliance(a);
  return pair;
}

double rayleigh_time(const Material& material, double radius) noexcept {
  return std::numbers::pi * radius * std::sqrt(material.density / material.shear_modulus) /
         (0.1631 * material.poisson_ratio + 0.8766);
}

double hertz_time(double E_eff, double R_eff, double m_eff, double speed) noexcept {
  return 2.87 * std::pow(m_eff * m_eff / (R_eff * E_eff * E_eff * speed), 0.2);
}

}  // namespace abradem::material
