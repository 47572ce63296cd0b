// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "abradem/core/units.h"
#include "abradem/io/case_schema.h"
#include "abradem/wear/expression.h"

namespace abradem::io {
namespace {

/// A '|' would end the cell of a table.
std::string cell(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '|') result += '\\';
    result += c;
  }
  return result;
}

std::string heading(const Section& section) {
  if (section.path.empty()) return "Top of the file";
  std::string name(section.path);
  const bool list = section.naming == Naming::list;
  if (list) name.resize(name.rfind(".*"));
  const std::size_t star = name.find('*');
  if (star != std::string::npos)
    name.replace(star, 1, section.naming == Naming::pair ? "\"NAME/NAME\"" : "NAME");
  if (list) return fmt::format("`[[{}]]`", name);
  if (section.naming == Naming::one_or_list) return fmt::format("`[{}]` or `[[{}]]`", name, name);
  return fmt::format("`[{}]`", name);
}

std::string value_cell(const Row& row) {
  switch (row.kind) {
    case Kind::text:
      return "text";
    case Kind::file:
      return "path";
    case Kind::material:
      return "name of a material";
    case Kind::choice:
      return fmt::format("`\"{}\"`", fmt::join(row.choices, "\"` \\| `\""));
    case Kind::choices:
      return fmt::format("one or a list of `\"{}\"`", fmt::join(row.choices, "\"` \\| `\""));
    case Kind::version:
      return "`1`";
    case Kind::quantity:
      return row.unit.empty()
                 ? "number [-]"
                 : fmt::format("{} [{}]", core::describe(core::parse_unit(row.unit).dimension), row.unit);
    case Kind::integer:
      return "whole number [-]";
    case Kind::vector:
      return fmt::format("3 components [{}]", row.unit);
    case Kind::direction:
      return "3 numbers [-]";
    case Kind::force_down:
    case Kind::along_axis:
      return fmt::format("one value or 3 components [{}]", row.unit);
    case Kind::duration:
      return "a time [s] or revolutions [rev]";
    case Kind::time_step:
      return "a time [s] or a share of the Rayleigh time [%]";
    case Kind::acceleration:
      return "number [-] or `\"auto\"`";
    case Kind::changes:
      return "table: key of the case = value";
    case Kind::variations:
      return "table: key of the case = list of values";
    case Kind::constants:
      return "table: name = quantity of any dimension";
    case Kind::length_unit:
      return "a unit of length, or a length [m]";
  }
  return {};
}

std::string default_cell(const Row& row) {
  if (!row.default_note.empty()) return std::string(row.default_note);
  if (row.need == Need::required)
    return row.when.key.empty() ? "**required**" : fmt::format("**required** where {}", describe_when(row));
  if (row.need == Need::optional) return "not given";
  const std::string text = fmt::format("`{}`", default_text(row).value_or(""));
  return row.when.key.empty() ? text : fmt::format("{} (where {})", text, describe_when(row));
}

std::string presence(const Section& section) {
  switch (section.presence) {
    case Presence::required:
      return "Required.";
    case Presence::at_least_one:
      return "At least one is required.";
    case Presence::optional:
      return "Optional.";
  }
  return {};
}

std::string_view owner(wear::SymbolInfo::Of of) {
  switch (of) {
    case wear::SymbolInfo::Of::step:
      return "a contact in one step";
    case wear::SymbolInfo::Of::impact:
      return "one impact";
    case wear::SymbolInfo::Of::sphere:
      return "the sphere";
    case wear::SymbolInfo::Of::materials:
      return "the materials";
  }
  return {};
}

}  // namespace

std::string case_reference_markdown() {
  std::string out =
      "<!-- Written by `abradem schema --format md`; a test checks that it is fresh. Do not edit. -->\n"
      "# The case file\n\n"
      "A case file is [TOML](https://toml.io). It says everything about a run; `abradem check CASE` tells "
      "what is wrong "
      "with one,\n"
      "`abradem new pin-on-disc` writes one to start from, `abradem run CASE --set KEY=VALUE` overrides a "
      "key.\n\n"
      "**Quantities.** A bare number is in SI units (m, kg, s, N, Pa, rad). Text carries its unit, as in "
      "`\"3 mm\"`, "
      "`\"180 deg/s\"`,\n"
      "`\"5e-11 1/Pa\"`, and the dimension is checked. The unit in brackets below is the one "
      "`case.resolved.toml` shows; "
      "[-] is\n"
      "dimensionless. Every component of a vector may carry its own unit. Names with `/` or `.` are "
      "quoted.\n";
  for (const Section& section : case_sections()) {
    out += fmt::format("\n## {}\n\n{} {}\n", heading(section), section.doc, presence(section));
    if (rows_of(section).empty()) continue;
    out += "\n";
    out += "| Key | Value | Default | Allowed | Meaning | Example |\n|---|---|---|---|---|---|\n";
    for (const Row* row : rows_of(section)) {
      const std::string also = row->also.empty() ? "" : fmt::format(" (or `{}`)", row->also);
      out += fmt::format("| `{}`{} | {} | {} | {} | {} | `{}` |\n", row->key, also, value_cell(*row),
                         cell(default_cell(*row)), cell(describe_limits(*row)), cell(row->doc), row->example);
    }
  }
  out +=
      "\n## Expressions\n\n"
      "What `expression` of [wear](#wearnamename) may name, in SI. [More](../theory/wear.md#expression)\n\n"
      "| Name | Unit | Of | Meaning |\n|---|---|---|---|\n";
  for (const wear::SymbolInfo& s : wear::expression_symbols())
    out += fmt::format("| `{}` | {} | {} | {} |\n", s.name, s.unit.empty() ? "-" : s.unit, owner(s.of),
                       s.meaning);
  out +=
      "\n`+ - * / ^`, comparisons, `&&`, `||`, `condition ? this : that`, `pi`, and the functions "
      "`sin cos tan asin acos atan exp ln log10 sqrt cbrt abs` of one and `min max` of two arguments.\n"
      "\n## Units\n\n"
      "Products are written with `*`, `·` or a space, quotients with `/`, powers with `^2`, `²` or `³`; "
      "parentheses are "
      "allowed:\n"
      "`kg/m^3`, `1/Pa`, `kg/(m s^2)`. An angle counts as a dimension, so `rad/s` (a rate of rotation) and "
      "`Hz` (a "
      "frequency) differ.\n\n"
      "| Unit | In SI | Meaning |\n|---|---|---|\n";
  for (const core::NamedUnit& u : core::named_units()) {
    const std::string si = core::si_unit(u.unit.dimension);
    const double value = core::parse_quantity(fmt::format("1 {}", u.symbol)).value;
    out += fmt::format("| `{}` | {}{}{} | {} |\n", u.symbol, core::format_number(value),
                       si.empty() ? "" : " ", si, u.meaning);
  }
  return out;
}

}  // namespace abradem::io
