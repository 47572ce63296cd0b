// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/wear/wear_map.h"

#include <algorithm>

namespace abradem::wear {

std::uint16_t angle_class(double angle) noexcept {
  const double place = std::max(angle, 0.0) / ImpactSpectrum::low(1);
  return static_cast<std::uint16_t>(std::min(ImpactSpectrum::kBins - 1, static_cast<std::size_t>(place)));
}

WearMap::Element& WearMap::Element::operator+=(const Element& other) noexcept {
  force_sliding += other.force_sliding;
  shear_work += other.shear_work;
  normal_work += other.normal_work;
  sliding += other.sliding;
  finnie += other.finnie;
  oka += other.oka;
  expression += other.expression;
  peak_pressure = std::max(peak_pressure, other.peak_pressure);
  impacts += other.impacts;
  return *this;
}

WearMap::WearMap(std::size_t elements, std::span<const int> abraders, std::vector<std::uint16_t> region_of,
                 std::size_t regions)
    : region_of_(std::move(region_of)) {
  for (const int abrader : abraders)
    layers_.push_back({abrader, std::vector<Element>(elements), std::vector<Spectra>(regions)});
}

WearMap::Layer* WearMap::layer(int abrader) noexcept {
  const auto found = std::ranges::find(layers_, abrader, &Layer::abrader);
  return found == layers_.end() ? nullptr : &*found;
}

WearMap::Element WearMap::total(std::size_t element) const noexcept {
  Element sum;
  for (const Layer& layer : layers_) sum += layer.elements[element];
  return sum;
}

void WearMap::Booking::add(std::size_t element, double share, double area) noexcept {
  Element& e = layer_.elements[element];
  const ContactSample& contact = s_.work.contact;
  e.force_sliding += share * (contact.F_n * contact.slip);
  e.shear_work += share * s_.work.shear_work;
  e.normal_work += share * s_.work.normal_loss;
  e.sliding += share * (s_.load.weight * contact.slip);
  e.finnie += share * s_.volumes[static_cast<std::size_t>(Mechanism::finnie)];
  e.oka += share * s_.volumes[static_cast<std::size_t>(Mechanism::oka)];
  e.expression += share * s_.volumes[static_cast<std::size_t>(Mechanism::expression)];
  e.peak_pressure =
      std::max(e.peak_pressure, contact.F_n / s_.load.weight * share / std::min(area, s_.hertz_area));
  if (s_.strikes) {
    const double weight = share * s_.impact.mass * s_.impact.speed * s_.impact.speed;
    e.impacts.mass += share * s_.impact.mass;
    e.impacts.mv2 += weight;
    e.impacts.angle += weight * s_.impact.angle;
    e.impacts.diameter += weight * s_.impact.diameter;
  }
  if (share > largest_share_) largest_ = element, largest_share_ = share;
}

void WearMap::Booking::finish() {
  if (!(largest_share_ > 0.0)) return;
  Spectra& spectra = layer_.regions[layer_.regions.size() == 1 ? 0 : map_.region_of(largest_)];
  const ContactSample& contact = s_.work.contact;
  if (contact.slip > 0.0 && contact.F_n > 0.0) {
    SlidingSums& sums = spectra.sliding[Spectra::sliding_key(contact.F_n / s_.load.weight, s_.load.v_t)];
    sums.time += s_.load.weight * s_.load.dt;
    sums.sliding += s_.load.weight * contact.slip;
    sums.force_sliding += contact.F_n * contact.slip;
    sums.shear_work += s_.work.shear_work;
  }
  if (!s_.strikes) return;
  const Impact& impact = s_.impact;
  Element& e = layer_.elements[largest_];
  ++e.impacts.count;
  spectra.impacts[Spectra::impact_key(impact)].add(impact);
}

MechanismVolumes mapped_volumes(const Laws& laws, const WearMap::Element& e) noexcept {
  MechanismVolumes volumes{};
  volumes[static_cast<std::size_t>(Mechanism::archard)] = laws.archard * e.force_sliding;
  volumes[static_cast<std::size_t>(Mechanism::shear_work)] = laws.shear_work * e.shear_work;
  volumes[static_cast<std::size_t>(Mechanism::impact_energy)] =
      laws.normal_energy * e.normal_work + laws.shear_energy * e.shear_work;
  volumes[static_cast<std::size_t>(Mechanism::finnie)] = e.finnie;
  volumes[static_cast<std::size_t>(Mechanism::oka)] = e.oka;
  volumes[static_cast<std::size_t>(Mechanism::expression)] = e.expression;
  return volumes;
}

}  // namespace abradem::wear
