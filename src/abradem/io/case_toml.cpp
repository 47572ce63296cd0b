// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/case_toml.h"

#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <tuple>

#include "abradem/io/case_schema.h"

// toml++ 3.3 asserts (in an optimised clang build: assumes) that a table header starts with a key, and then
// handles "[=" as the error it is. Text a person typed must reach that error, so the assertion is taken out.
#undef NDEBUG
#define TOML_ASSERT(expr) static_cast<void>(0)
// Its tables of Unicode call "unreachable" what is only no letter and no blank (a bare key with U+00B3):
// there the answer is no.
#include <toml++/impl/forward_declarations.h>
#include <toml++/impl/preprocessor.h>
#pragma push_macro("TOML_UNREACHABLE")
#undef TOML_UNREACHABLE
#define TOML_UNREACHABLE return false
#include <toml++/impl/unicode.h>
#pragma pop_macro("TOML_UNREACHABLE")
#include <toml++/toml.h>

namespace abradem::io {
namespace {

Place place_of(const toml::source_region& region, int source) {
  return {source, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

Value convert(const toml::node& node, int source);

void convert_table(const toml::table& table, int source, Value& value) {
  value.type = Value::Type::table;
  for (const auto& [key, child] : table)
    value.entries.push_back({std::string(key.str()), place_of(key.source(), source), convert(child, source)});
  // The library sorts by name; the order of the file matters (the first wall that turns counts revolutions).
  std::stable_sort(value.entries.begin(), value.entries.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.place.line, a.place.column) < std::tie(b.place.line, b.place.column);
  });
}

Value convert(const toml::node& node, int source) {
  Value value;
  value.place = place_of(node.source(), source);
  if (const toml::table* table = node.as_table()) {
    convert_table(*table, source, value);
  } else if (const toml::array* array = node.as_array()) {
    value.type = Value::Type::array;
    for (const toml::node& item : *array) value.items.push_back(convert(item, source));
  } else if (const auto* text = node.as_string()) {
    value.type = Value::Type::text;
    value.text = text->get();
  } else if (const auto* integer = node.as_integer()) {
    value.type = Value::Type::integer;
    value.integer = integer->get();
  } else if (const auto* number = node.as_floating_point()) {
    value.type = Value::Type::number;
    value.number = number->get();
  } else if (const auto* boolean = node.as_boolean()) {
    value.type = Value::Type::boolean;
    value.boolean = boolean->get();
  } else {
    value.type = Value::Type::date;
  }
  return value;
}

/// The first '=' outside quotes, or npos.
std::size_t assignment_sign(std::string_view text) {
  char quote = '\0';
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quote != '\0') {
      if (c == '\\' && quote == '"') ++i;
      if (c == quote) quote = '\0';
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '=') {
      return i;
    }
  }
  return std::string_view::npos;
}

std::string quoted(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + "\"";
}

Value parse_assignment(std::string_view text, int source, Problems& problems) {
  const std::size_t sign = assignment_sign(text);
  if (sign == std::string_view::npos || sign == 0) {
    problems.error({source, 1, 1},
                   "expected KEY=VALUE, such as run.end=\"24 s\" or wall.disc.contact=resolved");
    return {};
  }
  if (text.substr(sign + 1).find_first_not_of(" \t") == std::string_view::npos) {
    problems.error({source, 1, static_cast<int>(sign) + 1}, "the value after '=' is missing");
    return {};
  }
  try {
    return convert(toml::parse(text), source);
  } catch (const toml::parse_error&) {
    // Not TOML as it stands: the value is meant as text, and what is wrong with the key shows below.
  }
  std::string_view value = text.substr(sign + 1);
  value.remove_prefix(std::min(value.find_first_not_of(" \t"), value.size()));
  try {
    return convert(toml::parse(fmt::format("{}{}", text.substr(0, sign + 1), quoted(value))), source);
  } catch (const toml::parse_error& error) {
    problems.error(place_of(error.source(), source),
                   fmt::format("{}; expected KEY=VALUE with a dotted key, names with '/' or '.' in quotes",
                               error.description()));
    return {};
  }
}

/// Names of the sections whose entries the user names; an override changes what is there and adds no new one,
/// or a slip of the finger would create a second pin.
bool holds_named_entries(std::string_view key) {
  return key == "material" || key == "contact" || key == "wear" || key == "wall" || key == "particle" ||
         key == "insertion";
}

void overlay(Value& base, const Value& change, bool named, std::string_view parent, Problems& problems) {
  for (const Entry& e : change.entries) {
    Entry* existing = base.find(e.key);
    if (existing == nullptr) {
      if (named) {
        std::string there;
        for (const Entry& b : base.entries) there += fmt::format("{}'{}'", there.empty() ? "" : ", ", b.key);
        problems.error(e.place, fmt::format("the case has no {} '{}'; it has {}", parent, e.key,
                                            there.empty() ? "none at all" : there));
        continue;
      }
      if (parent.empty() && holds_named_entries(e.key)) {
        problems.error(e.place, fmt::format("the case has no [{}.…] to override", e.key));
        continue;
      }
      base.entries.push_back(e);
    } else if (existing->value.type == Value::Type::table && is_dotted(e)) {
      overlay(existing->value, e.value, parent.empty() && holds_named_entries(e.key), e.key, problems);
    } else {
      *existing = e;
    }
  }
}

}  // namespace

Value parse_toml(std::string_view text, Problems& problems) {
  try {
    return convert(toml::parse(text), 0);
  } catch (const toml::parse_error& error) {
    problems.error(place_of(error.source(), 0), fmt::format("this is not TOML: {}", error.description()));
    return {};
  }
}

bool is_dotted(const Entry& e) noexcept {
  return e.value.type == Value::Type::table && e.value.place.column == e.place.column;
}

Value parse_override(std::string_view assignment, Problems& problems) {
  const int source = problems.add_source(std::string(assignment));
  return parse_assignment(assignment, source, problems);
}

Value tree_of(std::string_view key, const Place& place, const Value& value, Problems& problems) {
  Value tree;
  try {
    tree = convert(toml::parse(fmt::format("{} = 0", key)), place.source);
  } catch (const toml::parse_error&) {
    problems.error(place,
                   fmt::format("'{}' is not a dotted key of the case, such as wall.disc.mesh.size; names "
                               "with '/' or '.' are quoted",
                               key));
    return {};
  }
  // Everything stands where the key was written; equal places make the steps of the path dotted.
  Value* node = &tree;
  while (node->entries.size() == 1 && node->type == Value::Type::table) {
    Entry& step = node->entries.front();
    step.place = step.value.place = place;
    node = &step.value;
  }
  *node = value;
  return tree;
}

void lay_over(Value& tree, const Value& change, Problems& problems) {
  overlay(tree, change, false, "", problems);
}

std::string toml_text(const Value& value) {
  std::string out;
  switch (value.type) {
    case Value::Type::boolean:
      return value.boolean ? "true" : "false";
    case Value::Type::integer:
      return std::to_string(value.integer);
    case Value::Type::number:
      out = fmt::format("{}", value.number);
      // An integer is another type in TOML.
      return out.find_first_of(".en") == std::string::npos ? out + ".0" : out;
    case Value::Type::text:
      return toml_string(value.text);
    case Value::Type::date:
      return toml_string("a date");
    case Value::Type::array:
      for (const Value& item : value.items) out += (out.empty() ? "" : ", ") + toml_text(item);
      return "[" + out + "]";
    case Value::Type::table:
      for (const Entry& e : value.entries)
        out += fmt::format("{}{} = {}", out.empty() ? "" : ", ", toml_key(e.key), toml_text(e.value));
      return out.empty() ? "{}" : "{ " + out + " }";
  }
  return out;
}

}  // namespace abradem::io
