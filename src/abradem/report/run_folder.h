// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "abradem/report/manifest.h"
#include "abradem/report/surface_view.h"
#include "abradem/report/table.h"
#include "abradem/report/wear_map_view.h"

namespace abradem::report {

/// What a run left in its output folder, read and checked.
struct RunFolder {
  std::filesystem::path folder;
  Manifest manifest;
  std::string resolved_case;  ///< case.resolved.toml, as it stands
  Table revolutions, contours, profiles, force;
  std::optional<Table> ridges, tip, tip_profile;  ///< of runs that plough, or wear their pins
  std::optional<Table> particles;                 ///< of runs with particles in numbers
  std::optional<Table> walls;                     ///< loads on the walls; of all but old runs
  std::optional<Table> laws, impacts, erosion;    ///< of runs that wear by other laws than Archard's
  std::optional<Table> wear;                      ///< of runs that kept maps
  std::optional<WearMapView> wear_map;            ///< … and frames of them
  std::optional<WornSurface> surface;
  std::string surface_note;  ///< why there is no surface, when there is none

  /// Is there a guided body's groove to show? Particles in numbers make none.
  [[nodiscard]] bool has_groove() const noexcept { return !particles || force.rows() > 0; }
};

/// Reads run.json, case.resolved.toml, the tables and, from series.pvd, the first and the last frame of
/// the wall that wore most. A run that wrote no frames, or no wear, has no surface, which is no error.
/// @throws IoError when a file is missing or damaged
[[nodiscard]] RunFolder read_run_folder(const std::filesystem::path& folder);

}  // namespace abradem::report
