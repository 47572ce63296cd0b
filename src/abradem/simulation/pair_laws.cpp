// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/simulation/pair_laws.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>

#include "abradem/core/error.h"
#include "abradem/material/material.h"

namespace abradem::simulation {

std::shared_ptr<const wear::Expression> expression_of(const Setup& setup, const WearSetup& w) {
  using wear::Symbol;
  wear::SymbolValues values;
  values.fill(std::numeric_limits<double>::quiet_NaN());
  const auto set = [&](Symbol symbol, double value) { values[static_cast<std::size_t>(symbol)] = value; };
  const auto elastic = [](const MaterialSetup& m) {
    return material::Material{m.density, m.shear_modulus, m.poisson_ratio};
  };
  const auto end = setup.materials.end();
  const auto worn = std::ranges::find(setup.materials, w.worn, &MaterialSetup::name),
             abrader = std::ranges::find(setup.materials, w.abrader, &MaterialSetup::name);
  if (worn != end) {
    if (worn->hardness) set(Symbol::H, *worn->hardness);
    set(Symbol::E, material::youngs_modulus(elastic(*worn)));
    set(Symbol::nu, worn->poisson_ratio);
    set(Symbol::rho, worn->density);
  }
  if (abrader != end) {
    if (abrader->hardness) set(Symbol::H_p, *abrader->hardness);
    set(Symbol::E_p, material::youngs_modulus(elastic(*abrader)));
    set(Symbol::nu_p, abrader->poisson_ratio);
    set(Symbol::rho_p, abrader->density);
  }
  for (const ContactSetup& c : setup.contacts)
    if ((c.first == w.abrader && c.second == w.worn) || (c.first == w.worn && c.second == w.abrader))
      set(Symbol::mu, c.static_friction);
  if (worn != end && abrader != end)
    set(Symbol::E_eff, material::effective_moduli(elastic(*abrader), elastic(*worn)).E_eff);
  return std::make_shared<const wear::Expression>(fmt::format("wear \"{}/{}\"", w.abrader, w.worn),
                                                  w.expression, w.constants, values);
}

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
  if (has(WearLaw::expression)) {
    try {
      laws.expression = expression_of(setup, w);
    } catch (const wear::ExpressionError& error) {
      throw wear::ExpressionError(error.position,
                                  fmt::format("wear \"{}/{}\": {}", w.abrader, w.worn, error.what()));
    }
    laws.of_expression = acceleration;
  }
  return laws;
}

}  // namespace abradem::simulation
