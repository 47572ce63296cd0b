// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/wall_tables.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace abradem::io {

namespace {

using simulation::Simulation;
using wear::ImpactSpectrum;

constexpr double kMm = 1e3, kMm3 = 1e9, kDegrees = 180.0 / std::numbers::pi;
constexpr double kLoadRows = 20.0;  // of each wall, per output

/// tables/impacts.csv: how many, how fast, and what they wore, by angle.
void write_impacts(const std::filesystem::path& path, const Simulation& run) {
  CsvWriter table(path,
                  {"wall", "angle_low_deg", "angle_high_deg", "impacts", "mass_kg", "angle_mean_deg",
                   "speed_mean_m_per_s", "diameter_mean_mm", "finnie_mm3", "oka_mm3", "expression_mm3"});
  const double of_test = run.acceleration();
  for (std::size_t w = 0; w < run.walls().size(); ++w) {
    const auto& bins = run.impacts_on(w).bins();
    for (std::size_t k = 0; k < bins.size(); ++k) {
      const ImpactSpectrum::Bin& b = bins[k];
      if (b.count == 0) continue;
      table.row({static_cast<double>(w), kDegrees * ImpactSpectrum::low(k),
                 kDegrees * ImpactSpectrum::low(k + 1), of_test * static_cast<double>(b.count),
                 of_test * b.mass, kDegrees * b.angle / b.mass, b.speed / b.mass, kMm * b.diameter / b.mass,
                 kMm3 * b.finnie, kMm3 * b.oka, kMm3 * b.expression});
    }
  }
  table.close();
}

/// The mean impact on a wall, its mass that of all together; no mass where there was none.
wear::Impact mean_impact(const ImpactSpectrum& impacts) {
  wear::Impact mean;
  for (const ImpactSpectrum::Bin& b : impacts.bins()) {
    mean.mass += b.mass;
    mean.speed += b.speed;
    mean.diameter += b.diameter;
  }
  if (mean.mass > 0.0) mean.speed /= mean.mass, mean.diameter /= mean.mass;
  return mean;
}

/// tables/erosion.csv: what the laws of impacts say at any angle, for the wall's mean speed and diameter.
void write_erosion(const std::filesystem::path& path, const Simulation& run) {
  CsvWriter table(path, {"wall", "abrader", "angle_deg", "speed_m_per_s", "diameter_mm", "finnie_mm3_per_kg",
                         "oka_mm3_per_kg", "expression_mm3_per_kg"});
  const double once = 1.0 / run.acceleration();  // the laws count each impact so many times
  for (std::size_t w = 0; w < run.walls().size(); ++w) {
    wear::Impact impact = mean_impact(run.impacts_on(w));
    if (!(impact.mass > 0.0)) continue;
    const double mass = impact.mass / static_cast<double>(run.impacts_on(w).count());
    for (std::size_t m = 0; m < run.setup().materials.size(); ++m) {
      const wear::Laws& laws = run.wear_laws(static_cast<int>(m), run.walls()[w].material());
      if (!laws.strikes()) continue;
      for (int degree = 0; degree <= 90; ++degree) {
        impact.angle = degree / kDegrees;
        impact.mass = mass;  // an expression may take it as it likes
        wear::MechanismVolumes v{}, per_mass{};
        wear::add_impact(laws, impact, v);
        impact.mass = 1.0;
        wear::add_impact(laws, impact, per_mass);
        const auto volume = [once](const wear::MechanismVolumes& of, wear::Mechanism mechanism) {
          return kMm3 * once * of[static_cast<std::size_t>(mechanism)];
        };
        table.row({static_cast<double>(w), static_cast<double>(m), static_cast<double>(degree), impact.speed,
                   kMm * impact.diameter, volume(per_mass, wear::Mechanism::finnie),
                   volume(per_mass, wear::Mechanism::oka), volume(v, wear::Mechanism::expression) / mass});
      }
    }
  }
  table.close();
}

std::vector<std::string> columns_by_law() {
  std::vector<std::string> columns{"revolution", "time_s", "wall"};
  for (const std::string_view law : wear::kMechanismNames) columns.push_back(std::string(law) + "_mm3");
  columns.emplace_back("impacts");
  return columns;
}

}  // namespace

WallTables::WallTables(const Simulation& run, const std::filesystem::path& folder,
                       const WallTablePositions& from)
    : tables_(folder / "tables"),
      stride_(static_cast<std::uint64_t>(
          std::max(1.0, std::floor(static_cast<double>(run.steps_per_output()) / kLoadRows)))),
      loads_(tables_ / "walls.csv",
             {"time_s", "revolution", "wall", "force_x_N", "force_y_N", "force_z_N", "torque_x_Nm",
              "torque_y_Nm", "torque_z_Nm", "power_W"},
             CsvWriter::Growing{from.loads}) {
  if (run.wears_by_laws())
    laws_.emplace(tables_ / "wear_by_law.csv", columns_by_law(), CsvWriter::Growing{from.laws});
}

void WallTables::add_loads(const Simulation& run, double revolution) {
  for (std::size_t w = 0; w < run.walls().size(); ++w) {
    const Simulation::WallLoad load = run.load_on_wall(w);
    loads_.row({run.test_time(), revolution, static_cast<double>(w), load.force.x, load.force.y, load.force.z,
                load.torque.x, load.torque.y, load.torque.z, load.power});
  }
}

void WallTables::add(const Simulation& run, double revolution) {
  if (!laws_) return;
  for (std::size_t w = 0; w < run.walls().size(); ++w) {
    const wear::MechanismVolumes v = run.law_volumes(w);
    std::vector<double> row{revolution, run.test_time(), static_cast<double>(w)};
    for (const double volume : v) row.push_back(kMm3 * volume);
    row.push_back(run.acceleration() * static_cast<double>(run.impacts_on(w).count()));
    laws_->row(row);
  }
}

WallTablePositions WallTables::positions() const noexcept {
  return {loads_.position(), laws_ ? laws_->position() : 0};
}

void WallTables::flush() {
  loads_.flush();
  if (laws_) laws_->flush();
}

void WallTables::sync() {
  loads_.sync();
  if (laws_) laws_->sync();
}

void WallTables::close(const Simulation& run) {
  loads_.close();
  if (!laws_) return;
  laws_->close();
  write_impacts(tables_ / "impacts.csv", run);
  write_erosion(tables_ / "erosion.csv", run);
}

}  // namespace abradem::io
