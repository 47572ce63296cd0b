// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/analysis/half_space_groove.h"

#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "abradem/core/error.h"

namespace abradem::analysis {
namespace {
constexpr double kExponent = 3.395;  // m
}  // namespace

double PressedSphere::half_width() const noexcept {
  return std::cbrt(0.75 * force * radius / effective_modulus);
}

double PressedSphere::approach() const noexcept { return half_width() * half_width() / radius; }

double groove_number(double wear, double effective_modulus) noexcept { return wear * effective_modulus; }

double thin_wear_depth(double W) noexcept { return W; }

double rigid_sphere_depth(double W) noexcept { return std::pow(W / std::numbers::sqrt2, 2.0 / 3.0); }

double half_space_depth(double W) noexcept {
  if (W <= 0.0) return 0.0;
  return std::pow(std::pow(thin_wear_depth(W), -kExponent) + std::pow(rigid_sphere_depth(W), -kExponent),
                  -1.0 / kExponent);
}

double rigid_from(double deviation) {
  if (!(deviation > 0.0 && deviation < 0.5))
    throw InputError(fmt::format("deviation {}; expected a share between 0 and 0.5", deviation));
  // With q = rigid / thin the ratio to the rigid sphere's depth is (1 + q^m)^(-1/m), and q = (2 W)^(-1/3).
  const double q = std::pow(std::pow(1.0 - deviation, -kExponent) - 1.0, 1.0 / kExponent);
  return 0.5 / (q * q * q);
}

}  // namespace abradem::analysis
