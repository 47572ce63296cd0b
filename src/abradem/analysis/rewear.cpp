// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/analysis/rewear.h"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

namespace abradem::analysis {

namespace {

using wear::Laws;
using wear::Mechanism;

std::size_t at(Mechanism m) { return static_cast<std::size_t>(m); }

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

/// Volumes by the laws of impacts [m^3].
struct ByImpacts {
  double finnie = 0.0, oka = 0.0;
};
ByImpacts worn(const Laws& laws, const wear::Impact& impact) {
  wear::MechanismVolumes v{};
  if (impact.mass > 0.0) wear::add_impact(laws, impact, v);
  return {v[at(Mechanism::finnie)], v[at(Mechanism::oka)]};
}
/// A region's volume by classes, and by the mean impacts of its elements.
struct OfRegion {
  ByImpacts classes, means;
};
/// Part of the region's volume that is an element's.
double shared(double of_element, double of_means, double of_classes) {
  return of_means > 0.0 ? of_element / of_means * of_classes : 0.0;
}

}  // namespace

Reworn rewear(const Recorded& recorded, const std::vector<LawChange>& changes) {
  std::map<std::tuple<int, int>, const LawChange*> change_of;
  for (const LawChange& c : changes) change_of[{c.wall, c.abrader}] = &c;
  const auto after_of = [&](int wall, int abrader) -> const Laws* {
    const auto change = change_of.find({wall, abrader});
    return change == change_of.end() ? nullptr : &change->second->after;
  };
  std::map<std::tuple<int, int, int>, OfRegion> of_regions;
  const auto add = [](ByImpacts& sum, const ByImpacts& v) { sum.finnie += v.finnie, sum.oka += v.oka; };
  for (const RecordedImpacts& i : recorded.impacts)
    if (const Laws* laws = after_of(i.wall, i.abrader))
      add(of_regions[{i.wall, i.abrader, i.region}].classes, worn(*laws, i.mean));
  for (const RecordedElement& e : recorded.elements)
    if (const Laws* laws = after_of(e.wall, e.abrader))
      add(of_regions[{e.wall, e.abrader, e.region}].means, worn(*laws, e.impact));

  std::map<std::tuple<int, int>, RewornElement> elements;
  std::map<std::tuple<int, int>, RewornRegion> regions;
  for (const RecordedElement& e : recorded.elements) {
    const auto change = change_of.find({e.wall, e.abrader});
    if (change == change_of.end()) continue;
    const Laws &before = change->second->before, &after = change->second->after;
    wear::WearMap::Element sums = e.sums;
    const OfRegion& region_sums = of_regions[{e.wall, e.abrader, e.region}];
    const ByImpacts own = worn(after, e.impact);
    const std::optional<double> finnie = finnie_scale(before, after), oka = oka_scale(before, after);
    sums.finnie = finnie ? *finnie * sums.finnie
                         : shared(own.finnie, region_sums.means.finnie, region_sums.classes.finnie);
    sums.oka = oka ? *oka * sums.oka : shared(own.oka, region_sums.means.oka, region_sums.classes.oka);
    if (!after.expression) sums.expression = 0.0;  // else it is the run's own
    const wear::MechanismVolumes v = wear::mapped_volumes(after, sums);
    RewornElement& element = elements[{e.wall, e.element}];
    element.wall = e.wall, element.element = e.element, element.region = e.region, element.area = e.area;
    RewornRegion& region = regions[{e.wall, e.region}];
    region.wall = e.wall, region.region = e.region;
    region.exact = region.exact && finnie && oka;
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
