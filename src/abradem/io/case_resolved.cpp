// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include "abradem/io/case_file.h"
#include "abradem/io/case_schema.h"

namespace abradem::io {
namespace {

void write_section(const Section& section, const Target& target, const std::string& path, std::string& out) {
  const bool list =
      section.naming == Naming::list || (section.naming == Naming::one_or_list && section.count(target) > 1);
  if (!path.empty()) out += list ? fmt::format("\n[[{}]]\n", path) : fmt::format("\n[{}]\n", path);
  for (const Row* row : rows_of(section)) {
    if (!applies(*row, target)) continue;
    if (const auto value = format_value(*row, row->slot(target)))
      out += fmt::format("{} = {}\n", row->key, *value);
    else
      out += fmt::format("# {}: {}\n", row->key, row->default_note.empty() ? "not given" : row->default_note);
  }
  for (const Section* child : sections_in(section)) {
    const std::string word =
        path.empty() ? std::string(own_word(*child)) : fmt::format("{}.{}", path, own_word(*child));
    for (std::size_t i = 0; i < child->count(target); ++i) {
      Target inner = target;
      child->enter(inner, i);
      const std::string inner_path = child->naming == Naming::name || child->naming == Naming::pair
                                         ? fmt::format("{}.{}", word, toml_key(child->name(inner)))
                                         : word;
      write_section(*child, inner, inner_path, out);
    }
  }
}

}  // namespace

std::string resolved_case(const simulation::Setup& setup) {
  // The table writes through the same slots it reads with; a copy keeps the caller's setup constant.
  simulation::Setup copy = setup;
  Target target;
  target.setup = &copy;
  std::string out =
      "# Every key of the case with its value; reading this file gives the same run, bit for bit.\n";
  write_section(case_sections().front(), target, "", out);
  return out;
}

}  // namespace abradem::io
