// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/rewear_tables.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "abradem/core/error.h"
#include "abradem/io/csv.h"

namespace abradem::io {

namespace {

constexpr double kMm3 = 1e9, kMm2 = 1e6, kMm = 1e3, kUm = 1e6, kDegrees = 180.0 / std::numbers::pi;

int whole(double x, const std::filesystem::path& path) {
  if (!(x >= 0.0 && x < 2147483647.0) || x != std::floor(x))
    throw IoError(fmt::format("{}: {} where a number of a wall, material, region or element is expected",
                              path.string(), x));
  return static_cast<int>(x);
}

/// A table's rows by the names of its columns.
class Columns {
 public:
  explicit Columns(const std::filesystem::path& path) : path_(path), table_(read_csv(path)) {}
  [[nodiscard]] std::size_t rows() const noexcept { return table_.rows(); }
  [[nodiscard]] std::vector<double> operator[](const char* name) const {
    try {
      return table_.column(name);
    } catch (const InputError& error) {
      throw IoError(fmt::format("{}: {}", path_.string(), error.what()));
    }
  }
  /// Zeros where an earlier version wrote the table.
  [[nodiscard]] std::vector<double> if_there(const std::string& name) const {
    return std::ranges::find(table_.columns, name) == table_.columns.end() ? std::vector<double>(rows(), 0.0)
                                                                           : table_.column(name);
  }

 private:
  std::filesystem::path path_;
  CsvTable table_;
};

std::vector<std::string> with_laws(std::vector<std::string> columns) {
  for (const std::string_view law : wear::kMechanismNames) columns.push_back(std::string(law) + "_mm3");
  return columns;
}

void add_laws(std::vector<double>& row, const wear::MechanismVolumes& volumes) {
  for (const double v : volumes) row.push_back(kMm3 * v);
}

}  // namespace

analysis::Recorded read_recorded_wear(const std::filesystem::path& tables) {
  const std::filesystem::path integrals = tables / "wear_integrals.csv",
                              spectrum = tables / "impact_spectrum.csv",
                              sliding_spectrum = tables / "sliding_spectrum.csv";
  std::error_code code;
  if (!std::filesystem::exists(integrals, code))
    throw InputError(fmt::format(
        "{}: no such table; the run kept no maps of its walls. Run the case with --set output.maps=on, and a "
        "[wear] pair for the wall",
        integrals.string()));
  analysis::Recorded recorded;
  {
    const Columns t(integrals);
    const auto wall = t["wall"], abrader = t["abrader"], region = t["region"], element = t["element"],
               area = t["area_mm2"], sliding = t["force_sliding_J"], shear = t["shear_work_J"],
               normal = t["normal_work_J"], mass = t["impact_mass_kg"], angle = t["angle_mean_deg"],
               speed = t["speed_rms_m_per_s"], diameter = t["diameter_mean_mm"], finnie = t["finnie_mm3"],
               oka = t["oka_mm3"], expression = t.if_there("expression_mm3");
    for (std::size_t r = 0; r < t.rows(); ++r) {
      analysis::RecordedElement e{whole(wall[r], integrals),
                                  whole(abrader[r], integrals),
                                  whole(region[r], integrals),
                                  whole(element[r], integrals),
                                  area[r] / kMm2,
                                  {},
                                  {}};
      e.sums.force_sliding = sliding[r];
      e.sums.shear_work = shear[r];
      e.sums.normal_work = normal[r];
      if (mass[r] > 0.0) e.impact = {speed[r], angle[r] / kDegrees, mass[r], diameter[r] / kMm};
      e.sums.finnie = finnie[r] / kMm3;
      e.sums.oka = oka[r] / kMm3;
      e.sums.expression = expression[r] / kMm3;
      recorded.elements.push_back(e);
    }
  }
  const Columns t(spectrum);
  const auto wall = t["wall"], abrader = t["abrader"], region = t["region"], mass = t["mass_kg"],
             angle = t["angle_mean_deg"], speed = t["speed_rms_m_per_s"], diameter = t["diameter_mean_mm"],
             count = t["impacts"];
  for (std::size_t r = 0; r < t.rows(); ++r)
    recorded.impacts.push_back({whole(wall[r], spectrum),
                                whole(abrader[r], spectrum),
                                whole(region[r], spectrum),
                                {speed[r], angle[r] / kDegrees, mass[r], diameter[r] / kMm},
                                count[r]});
  {
    const Columns s(sliding_spectrum);
    const auto at_wall = s["wall"], by = s["abrader"], in = s["region"], time = s["time_s"],
               slow = s["speed_low_m_per_s"], fast = s["speed_high_m_per_s"], way = s["sliding_m"],
               force_sliding = s["force_sliding_J"], work = s["shear_work_J"];
    for (std::size_t r = 0; r < s.rows(); ++r)
      recorded.sliding.push_back({whole(at_wall[r], sliding_spectrum),
                                  whole(by[r], sliding_spectrum),
                                  whole(in[r], sliding_spectrum),
                                  {time[r], way[r], force_sliding[r], work[r]},
                                  0.5 * (slow[r] + fast[r])});
  }
  return recorded;
}

void write_reworn_elements(const std::filesystem::path& path, const analysis::Reworn& reworn) {
  CsvWriter table(path, with_laws({"wall", "element", "area_mm2", "wear_volume_mm3", "wear_depth_um"}));
  for (const analysis::RewornElement& e : reworn.elements) {
    const double volume = wear::total(e.volumes);
    std::vector<double> row{static_cast<double>(e.wall), static_cast<double>(e.element), kMm2 * e.area,
                            kMm3 * volume, kUm * volume / e.area};
    add_laws(row, e.volumes);
    table.row(row);
  }
  table.close();
}

void write_reworn_regions(const std::filesystem::path& path, const analysis::Reworn& reworn) {
  CsvWriter table(path, with_laws({"wall", "region", "exact", "wear_volume_mm3"}));
  for (const analysis::RewornRegion& r : reworn.regions) {
    std::vector<double> row{static_cast<double>(r.wall), static_cast<double>(r.region), r.exact ? 1.0 : 0.0,
                            kMm3 * wear::total(r.volumes)};
    add_laws(row, r.volumes);
    table.row(row);
  }
  table.close();
}

}  // namespace abradem::io
