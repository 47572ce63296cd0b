// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/case_motions.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "abradem/io/case_schema.h"
#include "abradem/io/measured_table.h"
#include "abradem/simulation/wall_motion.h"

namespace abradem::io {

namespace {

using namespace simulation;

constexpr const char* kColumns = "time_s, x_mm, y_mm, z_mm, angle_deg";

void read_motion_file(MotionSetup& m) {
  const MeasuredTable table(m.file);
  std::vector<bool> known(table.header().size(), false);
  const auto column = [&](std::string_view name, const core::Dimension& dimension) {
    const auto c = table.find(std::array{name});
    if (!c) return std::vector<double>(table.rows(), 0.0);
    known[*c] = true;
    return table.quantities(std::array{name}, dimension);
  };
  constexpr core::Dimension kLength{.length = 1};
  if (!table.find(std::array{std::string_view("time")}))
    throw InputError(
        fmt::format("{}: there is no column time_s; a table of a motion has {}", m.file, kColumns));
  const auto time = column("time", {.time = 1}), x = column("x", kLength), y = column("y", kLength),
             z = column("z", kLength), angle = column("angle", {.angle = 1});
  if (const auto other = std::ranges::find(known, false); other != known.end())
    throw InputError(fmt::format("{}: column {} is '{}'; a table of a motion has {}", m.file,
                                 other - known.begin() + 1,
                                 table.header()[static_cast<std::size_t>(other - known.begin())], kColumns));
  m.rows.clear();
  for (std::size_t r = 0; r < table.rows(); ++r) m.rows.push_back({time[r], {x[r], y[r], z[r]}, angle[r]});
  if (const auto problem = problem_of_table(m))
    throw InputError(
        fmt::format("{}:{}: {}", m.file, table.rows() > 0 ? table.line(problem->row) : 1, problem->what));
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
