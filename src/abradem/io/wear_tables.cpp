// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/wear_tables.h"

#include <numbers>

namespace abradem::io {

namespace {
constexpr double kMm = 1e3, kMm2 = 1e6, kMm3 = 1e9, kDegrees = 180.0 / std::numbers::pi;
}  // namespace

const std::vector<std::string>& revolution_columns() {
  static const std::vector<std::string> names{
      "revolution",    "time_s",        "law_volume_mm3", "swept_volume_mm3", "paper_volume_mm3",
      "depth_mean_mm", "depth_sd_mm",   "depth_min_mm",   "depth_max_mm",     "width_mean_mm",
      "width_sd_mm",   "area_mean_mm2", "force_mean_N",   "force_sd_N",       "force_min_N",
      "force_max_N",   "depth_p_chi2",  "width_p_chi2"};
  return names;
}

std::array<double, 18> revolution_values(const analysis::RevolutionRow& r) {
  return {r.revolution,          r.time,
          kMm3 * r.law_volume,   kMm3 * r.swept_volume,
          kMm3 * r.paper_volume, kMm * r.depth_mean,
          kMm * r.depth_sd,      kMm * r.depth_min,
          kMm * r.depth_max,     kMm * r.width_mean,
          kMm * r.width_sd,      kMm2 * r.area_mean,
          r.force_mean,          r.force_sd,
          r.force_min,           r.force_max,
          r.depth_p_chi2,        r.width_p_chi2};
}

WearTables::WearTables(const std::filesystem::path& folder, const WearTablePositions& from)
    : revolutions_(folder / "revolutions.csv", revolution_columns(), CsvWriter::Growing{from.revolutions}),
      contours_(folder / "contours.csv",
                {"revolution", "angle_deg", "depth_mm", "width_mm", "area_mm2", "displaced_width_mm"},
                CsvWriter::Growing{from.contours}),
      profiles_(folder / "profiles.csv", {"revolution", "angle_deg", "radius_mm", "height_mm"},
                CsvWriter::Growing{from.profiles}) {}

void WearTables::add(const analysis::RevolutionRow& r, std::span<const analysis::Contour> contours) {
  revolutions_.row(revolution_values(r));
  for (const analysis::Contour& c : contours) {
    const double angle = kDegrees * c.angle;
    contours_.row(
        {r.revolution, angle, kMm * c.depth, kMm * c.width, kMm2 * c.area, kMm * c.displaced_width});
    for (const analysis::ProfilePoint& p : c.profile)
      profiles_.row({r.revolution, angle, kMm * p.radius, kMm * p.height});
  }
}

WearTablePositions WearTables::positions() const noexcept {
  return {revolutions_.position(), contours_.position(), profiles_.position()};
}

void WearTables::flush() {
  for (CsvWriter* table : {&contours_, &profiles_, &revolutions_}) table->flush();
}

void WearTables::sync() {
  for (CsvWriter* table : {&contours_, &profiles_, &revolutions_}) table->sync();
}

void WearTables::close() {
  revolutions_.close();
  contours_.close();
  profiles_.close();
}

}  // namespace abradem::io
