// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/report/run_folder.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <string_view>

#include "abradem/core/error.h"
#include "abradem/io/vtp_read.h"

namespace abradem::report {
namespace {

using namespace std::string_view_literals;

constexpr std::array kRevolutions = {
    "revolution"sv,    "time_s"sv,        "law_volume_mm3"sv, "swept_volume_mm3"sv, "paper_volume_mm3"sv,
    "depth_mean_mm"sv, "depth_sd_mm"sv,   "depth_min_mm"sv,   "depth_max_mm"sv,     "width_mean_mm"sv,
    "width_sd_mm"sv,   "area_mean_mm2"sv, "force_mean_N"sv,   "force_sd_N"sv,       "force_min_N"sv,
    "force_max_N"sv,   "depth_p_chi2"sv,  "width_p_chi2"sv};
constexpr std::array kContours = {"revolution"sv, "angle_deg"sv, "depth_mm"sv, "width_mm"sv, "area_mm2"sv};
constexpr std::array kProfiles = {"revolution"sv, "angle_deg"sv, "radius_mm"sv, "height_mm"sv};
constexpr std::array kForce = {"time_s"sv,     "revolution"sv, "normal_force_N"sv, "tangential_force_N"sv,
                               "overlap_um"sv, "contacts"sv};

constexpr std::array kRidges = {"revolution"sv,           "groove_volume_mm3"sv,   "removed_volume_mm3"sv,
                                "displaced_volume_mm3"sv, "piled_volume_mm3"sv,    "ridge_height_mean_mm"sv,
                                "ridge_height_sd_mm"sv,   "ridge_area_mean_mm2"sv, "groove_area_mean_mm2"sv};
constexpr std::array kTip = {"revolution"sv, "particle"sv,      "law_volume_mm3"sv, "removed_volume_mm3"sv,
                             "mass_ug"sv,    "flat_along_mm"sv, "flat_across_mm"sv};
constexpr std::array kTipProfile = {"particle"sv, "distance_mm"sv, "sphere_um"sv, "recession_along_um"sv,
                                    "recession_across_um"sv};

constexpr std::array kParticles = {"time_s"sv,           "particles"sv,      "mass_kg"sv,
                                   "inserted"sv,         "removed"sv,        "removed_mass_kg"sv,
                                   "contacts"sv,         "wall_contacts"sv,  "kinetic_energy_J"sv,
                                   "elastic_energy_J"sv, "fastest_m_per_s"sv};

constexpr std::array kWalls = {"time_s"sv,      "wall"sv,        "force_x_N"sv,
                               "force_y_N"sv,   "force_z_N"sv,   "torque_x_Nm"sv,
                               "torque_y_Nm"sv, "torque_z_Nm"sv, "power_W"sv};
constexpr std::array kLaws = {"time_s"sv,     "wall"sv,    "archard_mm3"sv,       "shear_work_mm3"sv,
                              "finnie_mm3"sv, "oka_mm3"sv, "impact_energy_mm3"sv, "impacts"sv};
constexpr std::array kImpacts = {
    "wall"sv,       "impacts"sv, "mass_kg"sv, "angle_mean_deg"sv, "speed_mean_m_per_s"sv,
    "finnie_mm3"sv, "oka_mm3"sv};
constexpr std::array kErosion = {"wall"sv,          "abrader"sv,           "angle_deg"sv,
                                 "speed_m_per_s"sv, "finnie_mm3_per_kg"sv, "oka_mm3_per_kg"sv};

constexpr std::array kWear = {"element"sv,
                              "x_mm"sv,
                              "y_mm"sv,
                              "z_mm"sv,
                              "area_mm2"sv,
                              "wear_volume_mm3"sv,
                              "wear_depth_um"sv,
                              "wall"sv,
                              "shear_work_J"sv,
                              "normal_work_J"sv,
                              "sliding_mm"sv,
                              "impacts"sv,
                              "impact_energy_J"sv,
                              "peak_pressure_MPa"sv};

/// A table that only some runs write. @param later a column that earlier versions do not write: zeros then
std::optional<Table> read_if_there(const std::filesystem::path& file,
                                   std::span<const std::string_view> required, std::string_view later = {}) {
  std::error_code code;
  if (!std::filesystem::exists(file, code)) return std::nullopt;
  Table table = read_table(file, required);
  if (!later.empty() && std::ranges::find(table.names, later) == table.names.end()) {
    table.columns.emplace_back(table.rows(), 0.0);
    table.names.emplace_back(later);
  }
  return table;
}

std::string read_case(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
    throw IoError(fmt::format("{}: no such file; every run writes it into its output folder", file.string()));
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The frames of one wall: its first file and its last.
struct WallFrames {
  std::string part;
  std::filesystem::path first, last;
};

std::vector<WallFrames> frames_by_wall(const std::vector<io::SeriesFrame>& entries) {
  std::vector<WallFrames> walls;
  for (const io::SeriesFrame& entry : entries) {
    auto wall = walls.begin();
    while (wall != walls.end() && wall->part != entry.part) ++wall;
    if (wall == walls.end()) {
      walls.push_back({entry.part, entry.file, entry.file});
    } else {
      wall->last = entry.file;
    }
  }
  return walls;
}

/// The frames are in metres.
void to_millimetres(geometry::TriangleMesh& mesh) {
  for (Vec3& p : mesh.vertices) p *= 1e3;
}

void read_surface(RunFolder& run) {
  const std::filesystem::path series = run.folder / "series.pvd";
  std::error_code code;
  if (!std::filesystem::exists(series, code)) {
    run.surface_note =
        "The run wrote no frames of the surface: there is no series.pvd (output.frames = \"none\"?).";
    return;
  }
  run.surface_note = "No wall has worn in this run.";
  for (const WallFrames& wall : frames_by_wall(io::read_pvd(series))) {
    io::VtpSurface before = io::read_vtp(wall.first);
    if (before.mesh.triangles.empty()) continue;
    io::VtpSurface after = io::read_vtp(wall.last);
    to_millimetres(before.mesh);
    to_millimetres(after.mesh);
    const auto stated = after.point_data.find("depth_um");
    const bool usable =
        stated != after.point_data.end() && stated->second.values.size() == before.mesh.vertices.size();
    const std::vector<double> depth = usable ? stated->second.values : sunk_um(before.mesh, after.mesh);
    std::optional<WornSurface> surface = worn_surface(before.mesh, depth);
    if (surface && (!run.surface || surface->max_depth_um > run.surface->max_depth_um))
      run.surface = std::move(surface);
  }
}

/// The last frames of the walls; their part in the series is their number.
void read_wear_map(RunFolder& run) {
  const std::filesystem::path series = run.folder / "series.pvd";
  std::error_code code;
  if (!std::filesystem::exists(series, code)) return;
  std::vector<WallFrame> frames;
  for (const WallFrames& wall : frames_by_wall(io::read_pvd(series)))
    for (std::size_t w = 0; w < run.manifest.walls.size(); ++w)
      if (wall.part == std::to_string(w)) frames.push_back({run.manifest.walls[w], wall.last});
  run.wear_map = wear_map_view(frames);
}

}  // namespace

RunFolder read_run_folder(const std::filesystem::path& folder) {
  std::error_code code;
  if (!std::filesystem::is_directory(folder, code)) {
    throw IoError(fmt::format("{}: no such folder; expected the output folder of a run", folder.string()));
  }
  RunFolder run;
  run.folder = folder;
  run.manifest = read_manifest(folder / "run.json");
  run.resolved_case = read_case(folder / "case.resolved.toml");
  const std::filesystem::path tables = folder / "tables";
  run.revolutions = read_table(tables / "revolutions.csv", kRevolutions);
  run.contours = read_table(tables / "contours.csv", kContours);
  run.profiles = read_table(tables / "profiles.csv", kProfiles);
  run.force = read_table(tables / "force.csv", kForce);
  run.ridges = read_if_there(tables / "ridges.csv", kRidges);
  run.tip = read_if_there(tables / "tip.csv", kTip);
  run.tip_profile = read_if_there(tables / "tip_profile.csv", kTipProfile);
  run.particles = read_if_there(tables / "particles.csv", kParticles);
  run.walls = read_if_there(tables / "walls.csv", kWalls);
  run.laws = read_if_there(tables / "wear_by_law.csv", kLaws, "expression_mm3");
  run.impacts = read_if_there(tables / "impacts.csv", kImpacts, "expression_mm3");
  run.erosion = read_if_there(tables / "erosion.csv", kErosion, "expression_mm3_per_kg");
  if (std::filesystem::exists(tables / "wear_integrals.csv", code))
    run.wear = read_table(tables / "wear.csv", kWear);
  read_surface(run);
  if (run.wear) read_wear_map(run);
  return run;
}

}  // namespace abradem::report
