// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/simulation/pair_laws.h"

#include <fmt/format.h>

#include <algorithm>

#include "abradem/core/error.h"

namespace abradem::simulation {

wear::Laws laws_of(const Setup& setup, const WearSetup& w, double acceleration) {
  const auto has = [&](WearLaw law) { return std::ranges::find(w.laws, law) != w.laws.end(); };
  wear::Laws laws;
  if (has(WearLaw::archard)) laws.archard = w.wear_coefficient * acceleration;
  if (has(WearLaw::shear_work)) laws.shear_work = w.shear_work_coefficient * acceleration;
  if (has(WearLaw::finnie))
    laws.finnie = wear::FinnieLaw{w.finnie_coefficient * acceleration, w.finnie_force_ratio};
  if (has(WearLaw::impact_energy)) {
    laws.normal_energy = w.normal_energy_coefficient * acceleration;
    laws.shear_energy = w.shear_energy_coefficient * acceleration;
  }
  if (has(WearLaw::oka)) {
    const auto worn = std::ranges::find(setup.materials, w.worn, &MaterialSetup::name);
    if (!worn->hardness)
      throw InputError(
          fmt::format("wear \"{}/{}\": Oka's law needs the hardness of '{}'", w.abrader, w.worn, w.worn));
    wear::OkaLaw oka = wear::OkaLaw::of_hardness(*worn->hardness);
    oka.reference_erosion = w.oka.reference_erosion.value_or(oka.reference_erosion) * acceleration;
    oka.reference_speed = w.oka.reference_speed;
    oka.reference_diameter = w.oka.reference_diameter;
    oka.speed_exponent = w.oka.speed_exponent.value_or(oka.speed_exponent);
    oka.diameter_exponent = w.oka.diameter_exponent;
    oka.n1 = w.oka.n1.value_or(oka.n1);
    oka.n2 = w.oka.n2.value_or(oka.n2);
    laws.oka = oka;
  }
  return laws;
}

}  // namespace abradem::simulation
