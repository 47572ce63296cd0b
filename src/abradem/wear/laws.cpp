// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/wear/laws.h"

#include <algorithm>
#include <cmath>

namespace abradem::wear {

double finnie_function(double force_ratio, double angle) noexcept {
  const double K = force_ratio;
  const double s = std::sin(angle), c = std::cos(angle);
  return 6.0 * s <= K * c ? (2.0 * s * c - (6.0 / K) * s * s) / K : c * c / 6.0;
}

double finnie_volume(const FinnieLaw& law, const Impact& impact) noexcept {
  return law.coefficient * impact.mass * impact.speed * impact.speed *
         finnie_function(law.force_ratio, impact.angle);
}

OkaLaw OkaLaw::of_hardness(double hardness) noexcept {
  constexpr double kMm3 = 1e-9;
  OkaLaw law;
  law.hardness = 1e-9 * hardness;
  law.reference_erosion = kMm3 * 65.0 * std::pow(law.hardness, -0.12);
  law.speed_exponent = 2.3 * std::pow(law.hardness, 0.038);
  law.n1 = 0.71 * std::pow(law.hardness, 0.14);
  law.n2 = 2.4 * std::pow(law.hardness, -0.94);
  return law;
}

double oka_function(const OkaLaw& law, double angle) noexcept {
  const double s = std::sin(angle);
  return std::pow(s, law.n1) * std::pow(1.0 + law.hardness * (1.0 - s), law.n2);
}

double oka_volume(const OkaLaw& law, const Impact& impact) noexcept {
  const double at_90 = law.reference_erosion *
                       std::pow(impact.speed / law.reference_speed, law.speed_exponent) *
                       std::pow(impact.diameter / law.reference_diameter, law.diameter_exponent);
  return impact.mass * at_90 * oka_function(law, impact.angle);
}

void add_impact(const Laws& laws, const Impact& impact, MechanismVolumes& volumes) {
  if (laws.finnie)
    volumes[static_cast<std::size_t>(Mechanism::finnie)] += finnie_volume(*laws.finnie, impact);
  if (laws.oka) volumes[static_cast<std::size_t>(Mechanism::oka)] += oka_volume(*laws.oka, impact);
  if (laws.expression && laws.expression->by_impact())
    volumes[static_cast<std::size_t>(Mechanism::expression)] +=
        laws.of_expression * laws.expression->of_impact(impact);
}

void ImpactSpectrum::add(const Impact& impact, const MechanismVolumes& volumes) noexcept {
  const double place = impact.angle / low(1);
  Bin& bin = bins_[std::min(kBins - 1, static_cast<std::size_t>(std::max(place, 0.0)))];
  ++bin.count;
  bin.mass += impact.mass;
  bin.angle += impact.mass * impact.angle;
  bin.speed += impact.mass * impact.speed;
  bin.diameter += impact.mass * impact.diameter;
  bin.finnie += volumes[static_cast<std::size_t>(Mechanism::finnie)];
  bin.oka += volumes[static_cast<std::size_t>(Mechanism::oka)];
  bin.expression += volumes[static_cast<std::size_t>(Mechanism::expression)];
}

std::uint64_t ImpactSpectrum::count() const noexcept {
  std::uint64_t sum = 0;
  for (const Bin& bin : bins_) sum += bin.count;
  return sum;
}

}  // namespace abradem::wear
