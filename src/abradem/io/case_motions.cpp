// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/case_motions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>

#include "abradem/io/case_schema.h"
#include "abradem/io/csv.h"
#include "abradem/simulation/wall_motion.h"

namespace abradem::io {

namespace {

using namespace simulation;

constexpr std::array<std::string_view, 5> kColumns{"time_s", "x_mm", "y_mm", "z_mm", "angle_deg"};

void read_motion_file(MotionSetup& m) {
  const CsvTable table = read_csv(m.file);
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    if (std::ranges::find(kColumns, table.columns[c]) == kColumns.end())
      throw InputError(fmt::format("{}:1: column {} is '{}'; a table of a motion has {}", m.file, c + 1,
                                   table.columns[c], fmt::join(kColumns, ", ")));
  const auto column = [&](std::string_view name) {
    const bool there = std::ranges::find(table.columns, name) != table.columns.end();
    return there ? table.column(name) : std::vector<double>(table.rows(), 0.0);
  };
  if (std::ranges::find(table.columns, kColumns[0]) == table.columns.end())
    throw InputError(fmt::format("{}:1: there is no column time_s; a table of a motion has {}", m.file,
                                 fmt::join(kColumns, ", ")));
  const auto time = column("time_s"), x = column("x_mm"), y = column("y_mm"), z = column("z_mm"),
             angle = column("angle_deg");
  m.rows.clear();
  for (std::size_t r = 0; r < table.rows(); ++r)
    m.rows.push_back({time[r], 1e-3 * Vec3{x[r], y[r], z[r]}, std::numbers::pi / 180.0 * angle[r]});
  if (const auto problem = problem_of_table(m))
    throw InputError(fmt::format("{}:{}: {}", m.file, problem->row + 2, problem->what));
}

}  // namespace

void read_motion_files(Setup& setup) {
  for (WallSetup& wall : setup.walls) {
    if (!wall.motion.file.empty()) read_motion_file(wall.motion);
    for (MotionSetup& m : wall.carried_by)
      if (!m.file.empty()) read_motion_file(m);
  }
}

std::string motion_path(const WallSetup& wall, std::size_t k, const Places& places) {
  const std::string whole = fmt::format("wall.{}.motion", toml_key(wall.name));
  const std::string item = fmt::format("{}[{}]", whole, k + 1);
  return places.given(item) ? item : whole;
}

void check_motions(const Setup& setup, const Places& places, Problems& problems) {
  const auto check = [&](const WallSetup& wall, std::size_t k) {
    const MotionSetup& m = wall.motion_at(k);
    const std::string path = motion_path(wall, k, places);
    if (!places.good(path)) return;
    const auto error = [&](const std::string& at, std::string message) {
      problems.error(places.of(at), std::move(message));
    };
    if (k > 0 && m.surface_velocity != Vec3{})
      error(path + ".surface_velocity",
            fmt::format("the belt runs over wall '{}' itself: give surface_velocity in the first motion of "
                        "the list",
                        wall.name));
    if (m.kind != MotionKind::table) {
      if (!m.rows.empty())
        error(path + ".rows", "rows count only where kind = table; set kind = \"table\" or leave them out");
      return;
    }
    if (m.file.empty() == m.rows.empty()) {
      error(path, m.file.empty()
                      ? "kind = \"table\" needs rows, such as rows = [{ time = \"0 s\" }, { time = \"1 s\", "
                        "displacement = [0, 0, \"5 mm\"] }], or a file"
                      : "kind = \"table\" takes its rows from the case or from a file, not from both");
      return;
    }
    if (m.file.empty()) {
      if (const auto problem = problem_of_table(m))
        error(fmt::format("{}.rows[{}]", path, problem->row + 1), problem->what);
      return;
    }
    if (places.files_kept()) return;
    try {
      MotionSetup read = m;
      read_motion_file(read);
    } catch (const Error& why) {
      error(path + ".file", why.what());
    }
  };
  for (const WallSetup& wall : setup.walls)
    for (std::size_t k = 0; k < wall.motions(); ++k) check(wall, k);
}

}  // namespace abradem::io
