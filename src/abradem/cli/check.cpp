// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "abradem/cli/check_mesh.h"
#include "abradem/cli/commands.h"
#include "abradem/cli/print.h"
#include "abradem/cli/summary.h"
#include "abradem/core/error.h"
#include "abradem/core/units.h"
#include "abradem/io/case_file.h"
#include "abradem/io/insertion_files.h"

namespace abradem::cli {

namespace {

/// Metres per unit of length given as its name.
double unit_of(const std::string& name) {
  const std::string text = "1 " + name;
  try {
    const core::Quantity q = core::parse_quantity(text);
    if (q.dimension == core::Dimension{.length = 1}) return q.value;
  } catch (const core::UnitError&) {
  }
  throw InputError(fmt::format("--unit {}: expected a unit of length such as mm, m, cm or in", name));
}

}  // namespace

int check_command(const CheckArguments& arguments) {
  std::string suffix = std::filesystem::path(arguments.path).extension().string();
  std::ranges::transform(suffix, suffix.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (suffix == ".stl" || suffix == ".obj" || suffix == ".ply")
    return check_mesh_command(arguments.path, unit_of(arguments.unit), arguments.json);
  io::Case read = io::load_case(arguments.path, arguments.overrides);
  for (const std::string& note : read.notes) print_message(note);
  for (const std::string& note : io::read_insertion_files(read.setup)) print_message(note);
  print_message(fmt::format("{}: no errors\n{}", arguments.path, summarize(read.setup)));
  return static_cast<int>(ExitCode::ok);
}

}  // namespace abradem::cli
