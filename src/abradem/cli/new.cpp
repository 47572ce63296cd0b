// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <filesystem>
#include <vector>

#include "abradem/cli/commands.h"
#include "abradem/cli/output_folder.h"
#include "abradem/cli/print.h"
#include "abradem/cli/templates.h"
#include "abradem/core/error.h"
#include "abradem/core/suggest.h"

namespace abradem::cli {
namespace {

const CaseTemplate& find_template(const std::string& name) {
  std::vector<std::string_view> names;
  for (const CaseTemplate& t : case_templates()) {
    if (t.name == name) return t;
    names.push_back(t.name);
  }
  const std::string nearest = core::nearest_spelling(name, names);
  throw InputError(nearest.empty()
                       ? fmt::format("no template '{}'; there are {}", name, fmt::join(names, ", "))
                       : fmt::format("no template '{}'; did you mean '{}'?", name, nearest));
}

}  // namespace

int new_command(const NewArguments& arguments) {
  const CaseTemplate& chosen = find_template(arguments.name);
  if (arguments.path.empty()) {
    print_result(chosen.text);
    return static_cast<int>(ExitCode::ok);
  }
  std::error_code ignored;
  const auto status = std::filesystem::symlink_status(arguments.path, ignored);
  if (std::filesystem::is_directory(status))
    throw InputError(fmt::format("'{}' is a folder; give the name of a file", arguments.path));
  if (std::filesystem::exists(status) && !arguments.force)
    throw InputError(fmt::format("'{}' exists; add --force to replace it", arguments.path));
  write_file(arguments.path, chosen.text);
  print_message(fmt::format("{} written; next: abradem run {}", arguments.path, arguments.path));
  return static_cast<int>(ExitCode::ok);
}

}  // namespace abradem::cli
