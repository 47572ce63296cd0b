// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/wear_map_tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "abradem/io/csv.h"

namespace abradem::io {

namespace {

using simulation::Simulation;
using wear::WearMap;

constexpr double kMm = 1e3, kMm2 = 1e6, kMm3 = 1e9, kUm = 1e6, kUm3 = 1e18, kMPa = 1e-6;
constexpr double kDegrees = 180.0 / std::numbers::pi;

/// Where a wall's element began: its centre and its area.
struct Place {
  Vec3 centre;
  double area = 0.0;
};
Place place_of(const wear::WearingSurface& surface, std::size_t t) {
  const auto& v = surface.mesh().triangles[t];
  const auto at = [&](std::size_t k) { return surface.reference()[static_cast<std::size_t>(v[k])]; };
  return {(at(0) + at(1) + at(2)) * (1.0 / 3.0), 0.5 * norm(cross(at(1) - at(0), at(2) - at(0)))};
}

bool any_map(const Simulation& run) {
  for (std::size_t w = 0; w < run.walls().size(); ++w)
    if (run.map_of(w) != nullptr) return true;
  return false;
}

void write_elements(const std::filesystem::path& path, const Simulation& run,
                    std::optional<std::size_t> worn_wall) {
  const bool mapped = any_map(run);
  std::vector<std::string> columns{"element",         "x_mm",         "y_mm", "z_mm", "area_mm2",
                                   "wear_volume_mm3", "wear_depth_um"};
  if (mapped) {
    columns.insert(columns.end(), {"wall", "force_sliding_J", "shear_work_J", "normal_work_J", "sliding_mm",
                                   "impacts", "impact_energy_J", "peak_pressure_MPa"});
    for (const std::string_view law : wear::kMechanismNames) columns.push_back(std::string(law) + "_mm3");
  }
  const double of_test = run.acceleration();
  CsvWriter table(path, columns);
  for (std::size_t w = 0; w < run.walls().size(); ++w) {
    const WearMap* map = run.map_of(w);
    if (map == nullptr && worn_wall != w) continue;
    const wear::WearingSurface& surface = run.walls()[w].surface();
    const auto volume = surface.element_volume();
    for (std::size_t t = 0; t < volume.size(); ++t) {
      const WearMap::Element e = map != nullptr ? map->total(t) : WearMap::Element{};
      if (volume[t] == 0.0 && !e.touched()) continue;
      const Place p = place_of(surface, t);
      std::vector<double> row{static_cast<double>(t),  kMm * p.centre.x, kMm * p.centre.y,
                              kMm * p.centre.z,        kMm2 * p.area,    kMm3 * volume[t],
                              kUm * volume[t] / p.area};
      if (mapped) {
        row.insert(row.end(), {static_cast<double>(w), of_test * e.force_sliding, of_test * e.shear_work,
                               of_test * e.normal_work, kMm * of_test * e.sliding,
                               of_test * static_cast<double>(e.impacts.count), of_test * e.impacts.energy(),
                               kMPa * e.peak_pressure});
        const wear::MechanismVolumes v = map != nullptr ? run.mapped_volumes(w, t) : wear::MechanismVolumes{};
        for (const double law : v) row.push_back(kMm3 * law);
      }
      table.row(row);
    }
  }
  table.close();
}

void write_integrals(const std::filesystem::path& path, const Simulation& run) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  CsvWriter table(path,
                  {"wall", "abrader", "region", "element", "area_mm2", "force_sliding_J", "shear_work_J",
                   "normal_work_J", "finnie_mm3", "oka_mm3", "expression_mm3", "impacts", "impact_energy_J",
                   "impact_mass_kg", "angle_mean_deg", "speed_rms_m_per_s", "diameter_mean_mm"});
  const double of_test = run.acceleration();
  for (std::size_t w = 0; w < run.walls().size(); ++w) {
    if (run.map_of(w) == nullptr) continue;
    const WearMap& map = *run.map_of(w);
    for (const WearMap::Layer& layer : map.layers())
      for (std::size_t t = 0; t < layer.elements.size(); ++t) {
        const WearMap::Element& e = layer.elements[t];
        if (!e.touched()) continue;
        const wear::Impact mean =
            e.impacts.mass > 0.0 ? e.impacts.mean() : wear::Impact{kNone, kNone, 0.0, kNone};
        table.row({static_cast<double>(w), static_cast<double>(layer.abrader),
                   static_cast<double>(map.region_of(t)), static_cast<double>(t),
                   kMm2 * place_of(run.walls()[w].surface(), t).area, of_test * e.force_sliding,
                   of_test * e.shear_work, of_test * e.normal_work, kMm3 * e.finnie, kMm3 * e.oka,
                   kMm3 * e.expression, of_test * static_cast<double>(e.impacts.count),
                   of_test * e.impacts.energy(), of_test * mean.mass, kDegrees * mean.angle, mean.speed,
                   kMm * mean.diameter});
      }
  }
  table.close();
}

/// Calls visit(wall, abrader, region, spectra) for each.
void for_spectra(const Simulation& run,
                 const std::function<void(double, double, double, const wear::Spectra&)>& visit) {
  for (std::size_t w = 0; w < run.walls().size(); ++w) {
    if (run.map_of(w) == nullptr) continue;
    for (const WearMap::Layer& layer : run.map_of(w)->layers())
      for (std::size_t r = 0; r < layer.regions.size(); ++r)
        visit(static_cast<double>(w), layer.abrader, static_cast<double>(r), layer.regions[r]);
  }
}

double low_of(std::uint64_t key, int shift) {
  return wear::low_of_eighth_octave(static_cast<std::uint16_t>(key >> shift & 0xffffu));
}
double high_of(std::uint64_t key, int shift) {
  return wear::low_of_eighth_octave(static_cast<std::uint16_t>((key >> shift & 0xffffu) + 1));
}

void write_sliding(const std::filesystem::path& path, const Simulation& run) {
  CsvWriter table(path, {"wall", "abrader", "region", "force_low_N", "force_high_N", "speed_low_m_per_s",
                         "speed_high_m_per_s", "time_s", "sliding_m", "force_sliding_J", "shear_work_J"});
  const double of_test = run.acceleration();
  for_spectra(run, [&](double wall, double abrader, double region, const wear::Spectra& spectra) {
    for (const auto& [key, s] : spectra.sliding.entries())
      table.row({wall, abrader, region, low_of(key, 16), high_of(key, 16), low_of(key, 0), high_of(key, 0),
                 of_test * s.time, of_test * s.sliding, of_test * s.force_sliding, of_test * s.shear_work});
  });
  table.close();
}

void write_impact_classes(const std::filesystem::path& path, const Simulation& run) {
  CsvWriter table(path, {"wall", "abrader", "region", "angle_low_deg", "angle_high_deg", "speed_low_m_per_s",
                         "speed_high_m_per_s", "impacts", "mass_kg", "angle_mean_deg", "speed_rms_m_per_s",
                         "diameter_mean_mm"});
  const double of_test = run.acceleration();
  for_spectra(run, [&](double wall, double abrader, double region, const wear::Spectra& spectra) {
    for (const auto& [key, s] : spectra.impacts.entries()) {
      const auto angle = static_cast<std::size_t>(key >> 32);
      const wear::Impact mean = s.mean();
      table.row({wall, abrader, region, kDegrees * wear::ImpactSpectrum::low(angle),
                 kDegrees * wear::ImpactSpectrum::low(angle + 1), low_of(key, 16), high_of(key, 16),
                 of_test * static_cast<double>(s.count), of_test * s.mass, kDegrees * mean.angle, mean.speed,
                 kMm * mean.diameter});
    }
  });
  table.close();
}

}  // namespace

void write_wear_maps(const std::filesystem::path& tables, const Simulation& run,
                     std::optional<std::size_t> worn_wall) {
  write_elements(tables / "wear.csv", run, worn_wall);
  if (!any_map(run)) return;
  write_integrals(tables / "wear_integrals.csv", run);
  write_sliding(tables / "sliding_spectrum.csv", run);
  write_impact_classes(tables / "impact_spectrum.csv", run);
}

MapArrays map_arrays(const Simulation& run, std::size_t wall) {
  const wear::WearingSurface& surface = run.walls()[wall].surface();
  const auto volume = surface.element_volume();
  const std::size_t n = volume.size();
  MapArrays out;
  std::vector<std::string> names;
  const auto add = [&](std::string name, const auto& of_element) {
    names.push_back(std::move(name));
    std::vector<double>& values = out.values.emplace_back(n);
    for (std::size_t t = 0; t < n; ++t) values[t] = of_element(t);
  };
  add("wear_volume_um3", [&](std::size_t t) { return kUm3 * volume[t]; });
  if (const WearMap* map = run.map_of(wall)) {
    const double of_test = run.acceleration();
    std::vector<WearMap::Element> e(n);
    for (std::size_t t = 0; t < n; ++t) e[t] = map->total(t);
    add("wear_depth_um", [&](std::size_t t) { return kUm * volume[t] / place_of(surface, t).area; });
    add("force_sliding_J", [&](std::size_t t) { return of_test * e[t].force_sliding; });
    add("shear_work_J", [&](std::size_t t) { return of_test * e[t].shear_work; });
    add("normal_work_J", [&](std::size_t t) { return of_test * e[t].normal_work; });
    add("sliding_mm", [&](std::size_t t) { return of_test * kMm * e[t].sliding; });
    add("impacts", [&](std::size_t t) { return of_test * static_cast<double>(e[t].impacts.count); });
    add("impact_energy_J", [&](std::size_t t) { return of_test * e[t].impacts.energy(); });
    add("peak_pressure_MPa", [&](std::size_t t) { return kMPa * e[t].peak_pressure; });
    if (run.wears_by_laws(wall))
      for (std::size_t m = 0; m < wear::kMechanisms; ++m)
        if (run.law_volumes(wall)[m] > 0.0)
          add(std::string(wear::kMechanismNames[m]) + "_um3",
              [&](std::size_t t) { return kUm3 * run.mapped_volumes(wall, t)[m]; });
  }
  for (std::size_t k = 0; k < names.size(); ++k) out.arrays.push_back({names[k], out.values[k], 1});
  return out;
}

}  // namespace abradem::io
