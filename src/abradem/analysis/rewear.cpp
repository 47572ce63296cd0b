// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/analysis/rewear.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <tuple>

#include "abradem/core/error.h"
#include "abradem/core/random.h"

namespace abradem::analysis {

namespace {

using wear::Laws;

/// By how much a law's volumes grow when nothing but its coefficient changes; nothing where more does.
std::optional<double> finnie_scale(const Laws& before, const Laws& after) {
  if (!after.finnie || after.finnie->coefficient == 0.0) return 0.0;
  const bool same = before.finnie && before.finnie->coefficient > 0.0 &&
                    before.finnie->force_ratio == after.finnie->force_ratio;
  return same ? std::optional(after.finnie->coefficient / before.finnie->coefficient) : std::nullopt;
}
std::optional<double> oka_scale(const Laws& before, const Laws& after) {
  if (!after.oka || after.oka->reference_erosion == 0.0) return 0.0;
  if (!before.oka || !(before.oka->reference_erosion > 0.0)) return std::nullopt;
  wear::OkaLaw scaled = *before.oka;
  scaled.reference_erosion = after.oka->reference_erosion;
  return scaled == *after.oka ? std::optional(after.oka->reference_erosion / before.oka->reference_erosion)
                              : std::nullopt;
}

/// The same of an expression: it stays as it was, or is another.
std::optional<double> expression_scale(const Laws& before, const Laws& after) {
  if (!after.expression) return 0.0;
  return before.expression && after.expression->same_as(*before.expression) ? std::optional(1.0)
                                                                            : std::nullopt;
}

/// Volumes by the laws of impacts [m^3].
struct ByImpacts {
  double finnie = 0.0, oka = 0.0, expression = 0.0;
};
/// @param all several impacts as one, of their mass together   @param each mass of one of them [kg]
ByImpacts worn(const Laws& laws, const wear::Impact& all, double each) {
  ByImpacts v;
  if (!(all.mass > 0.0)) return v;
  if (laws.finnie) v.finnie = wear::finnie_volume(*laws.finnie, all);
  if (laws.oka) v.oka = wear::oka_volume(*laws.oka, all);
  if (laws.expression && laws.expression->by_impact() && each > 0.0) {
    wear::Impact one = all;
    one.mass = each;
    v.expression = all.mass / each * laws.expression->of_impact(one);
  }
  return v;
}
/// A class of contacts as one that slides for all their time.
double worn(const LawChange& change, const wear::SlidingSums& s, double speed) {
  const auto& expression = change.after.expression;
  if (!expression || expression->by_impact() || !(s.sliding > 0.0) || !(s.time > 0.0)) return 0.0;
  return expression->of_step({{s.force_sliding / s.sliding, s.sliding}, s.shear_work, 0.0},
                             {.F_t = s.shear_work / s.sliding,
                              .v_t = speed,
                              .dt = s.time,
                              .radius = change.radius,
                              .mass = change.mass});
}
/// A region's volume by classes, and by the mean impacts of its elements.
struct OfRegion {
  ByImpacts classes, means;
  double mass = 0.0, count = 0.0;              ///< of all its impacts
  double by_steps = 0.0, force_sliding = 0.0;  ///< an expression of steps [m^3]; of its elements [J]
  [[nodiscard]] double mean_mass() const noexcept { return count > 0.0 ? mass / count : 0.0; }
};
/// Part of the region's volume that is an element's.
double shared(double of_element, double of_means, double of_classes) {
  return of_means > 0.0 ? of_element / of_means * of_classes : 0.0;
}

/// Contacts that an expression is tried with: each quantity by itself, over many decades.
constexpr int kTrials = 200;
wear::WorkSample draw(core::RandomStream& random) {
  const auto between = [&](double low, double high) { return low * std::pow(high / low, random.uniform()); };
  return {{between(1e-4, 1e4), between(1e-10, 1e-3)}, between(1e-12, 1.0), between(1e-12, 1.0)};
}
/// Volume; NaN where it is none.
double tried(const wear::Expression& e, const wear::WorkSample& work, const wear::ContactLoad& load) {
  try {
    return e.of_step(work, load);
  } catch (const SimulationError&) {
    return std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace

std::optional<LinearExpression> linear_expression(const wear::Expression& e) {
  using wear::Symbol;
  if (e.by_impact()) return std::nullopt;
  for (const Symbol s : {Symbol::Ft, Symbol::v_slide, Symbol::a, Symbol::p_mean, Symbol::p_max, Symbol::dt,
                         Symbol::m, Symbol::R})
    if (e.names(s)) return std::nullopt;
  // What has cases may be another where it is not tried; what has none, and is linear at some places, is so
  // everywhere.
  for (const char* cases : {"<", ">", "=", "?", "&", "|", "min", "max", "abs"})
    if (e.text().find(cases) != std::string::npos) return std::nullopt;
  const wear::ContactLoad load{.dt = 1e-6};
  constexpr double kForce = 1.0, kSlip = 1e-6, kWork = 1e-6;
  const LinearExpression linear{tried(e, {{kForce, kSlip}, 0.0, 0.0}, load) / (kForce * kSlip),
                                tried(e, {{0.0, 0.0}, kWork, 0.0}, load) / kWork,
                                tried(e, {{0.0, 0.0}, 0.0, kWork}, load) / kWork};
  core::RandomStream random(1);
  for (int k = 0; k < kTrials; ++k) {
    const wear::WorkSample w = draw(random);
    const double sum = linear.force_sliding * w.contact.F_n * w.contact.slip +
                       linear.shear_work * w.shear_work + linear.normal_work * w.normal_loss;
    if (!(std::abs(tried(e, w, load) - sum) <= 1e-12 * sum)) return std::nullopt;
  }
  return linear;
}

bool wears_by_sliding_alone(const wear::Expression& e) {
  core::RandomStream random(2);
  for (int k = 0; k < kTrials; ++k) {
    wear::WorkSample w = draw(random);
    const wear::ContactLoad load{.F_t = random.uniform() * w.contact.F_n,
                                 .v_t = random.uniform(),
                                 .dt = 1e-6,
                                 .radius = 1e-3,
                                 .mass = 1e-6};
    w.contact.slip = w.shear_work = 0.0;
    if (tried(e, w, load) != 0.0) return false;
  }
  return true;
}

Reworn rewear(const Recorded& recorded, const std::vector<LawChange>& changes) {
  std::map<std::tuple<int, int>, const LawChange*> change_of;
  std::map<const LawChange*, LinearExpression> linear;
  for (const LawChange& c : changes) {
    change_of[{c.wall, c.abrader}] = &c;
    if (!c.after.expression) continue;
    if (const auto found = linear_expression(*c.after.expression)) linear[&c] = *found;
  }
  const auto change_at = [&](int wall, int abrader) -> const LawChange* {
    const auto change = change_of.find({wall, abrader});
    return change == change_of.end() ? nullptr : change->second;
  };
  std::map<std::tuple<int, int, int>, OfRegion> of_regions;
  const auto add = [](ByImpacts& sum, const ByImpacts& v) {
    sum.finnie += v.finnie, sum.oka += v.oka, sum.expression += v.expression;
  };
  for (const RecordedImpacts& i : recorded.impacts)
    if (const LawChange* change = change_at(i.wall, i.abrader)) {
      OfRegion& region = of_regions[{i.wall, i.abrader, i.region}];
      add(region.classes, worn(change->after, i.mean, i.count > 0.0 ? i.mean.mass / i.count : 0.0));
      region.mass += i.mean.mass, region.count += i.count;
    }
  for (const RecordedSliding& s : recorded.sliding)
    if (const LawChange* change = change_at(s.wall, s.abrader))
      of_regions[{s.wall, s.abrader, s.region}].by_steps += worn(*change, s.sums, s.speed);
  for (const RecordedElement& e : recorded.elements)
    if (const LawChange* change = change_at(e.wall, e.abrader)) {
      OfRegion& region = of_regions[{e.wall, e.abrader, e.region}];
      add(region.means, worn(change->after, e.impact, region.mean_mass()));
      region.force_sliding += e.sums.force_sliding;
    }

  std::map<std::tuple<int, int>, RewornElement> elements;
  std::map<std::tuple<int, int>, RewornRegion> regions;
  for (const RecordedElement& e : recorded.elements) {
    const LawChange* change = change_at(e.wall, e.abrader);
    if (change == nullptr) continue;
    const Laws &before = change->before, &after = change->after;
    wear::WearMap::Element sums = e.sums;
    const OfRegion& region_sums = of_regions[{e.wall, e.abrader, e.region}];
    const ByImpacts own = worn(after, e.impact, region_sums.mean_mass());
    const std::optional<double> finnie = finnie_scale(before, after), oka = oka_scale(before, after),
                                expression = expression_scale(before, after);
    sums.finnie = finnie ? *finnie * sums.finnie
                         : shared(own.finnie, region_sums.means.finnie, region_sums.classes.finnie);
    sums.oka = oka ? *oka * sums.oka : shared(own.oka, region_sums.means.oka, region_sums.classes.oka);
    const auto by_sums = linear.find(change);
    sums.expression =
        expression                ? *expression * sums.expression
        : by_sums != linear.end() ? by_sums->second.force_sliding * sums.force_sliding +
                                        by_sums->second.shear_work * sums.shear_work +
                                        by_sums->second.normal_work * sums.normal_work
        : after.expression->by_impact()
            ? shared(own.expression, region_sums.means.expression, region_sums.classes.expression)
            : shared(e.sums.force_sliding, region_sums.force_sliding, region_sums.by_steps);
    const wear::MechanismVolumes v = wear::mapped_volumes(after, sums);
    RewornElement& element = elements[{e.wall, e.element}];
    element.wall = e.wall, element.element = e.element, element.region = e.region, element.area = e.area;
    RewornRegion& region = regions[{e.wall, e.region}];
    region.wall = e.wall, region.region = e.region;
    region.exact = region.exact && finnie && oka && (expression || by_sums != linear.end());
    for (std::size_t m = 0; m < v.size(); ++m) {
      element.volumes[m] += v[m];
      region.volumes[m] += v[m];
    }
  }
  Reworn out;
  for (const auto& [key, element] : elements) out.elements.push_back(element);
  for (const auto& [key, region] : regions) out.regions.push_back(region);
  return out;
}

}  // namespace abradem::analysis
