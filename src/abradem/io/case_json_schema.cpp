// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "abradem/core/units.h"
#include "abradem/io/case_schema.h"

namespace abradem::io {
namespace {

using Json = nlohmann::ordered_json;

Json text_with_unit() { return {{"type", "string"}, {"pattern", "^\\s*[-+]?[0-9.]"}}; }

/// A number in SI, or text with a unit. Limits hold for the bare number; text is checked by the program.
Json quantity(const Row& row) {
  Json number = {{"type", "number"}};
  if (std::isfinite(row.limits.low))
    number[row.limits.low_excluded ? "exclusiveMinimum" : "minimum"] = row.limits.low;
  if (std::isfinite(row.limits.high))
    number[row.limits.high_excluded ? "exclusiveMaximum" : "maximum"] = row.limits.high;
  return {{"anyOf", Json::array({number, text_with_unit()})}};
}

Json vector_of(const Json& item) {
  return {{"type", "array"}, {"items", item}, {"minItems", 3}, {"maxItems", 3}};
}

Json value_schema(const Row& row) {
  switch (row.kind) {
    case Kind::text:
      return {{"type", "string"}};
    case Kind::file:
    case Kind::material:
    case Kind::length_unit: {
      Json text = {{"type", "string"}, {"minLength", 1}};
      if (row.kind != Kind::length_unit) return text;
      return {{"anyOf", Json::array({text, {{"type", "number"}, {"exclusiveMinimum", 0}}})}};
    }
    case Kind::choice:
      return {{"enum", row.choices}};
    case Kind::choices:
      return {{"anyOf", Json::array({{{"enum", row.choices}},
                                     {{"type", "array"},
                                      {"items", {{"enum", row.choices}}},
                                      {"minItems", 1},
                                      {"uniqueItems", true}}})}};
    case Kind::version:
      return {{"const", 1}};
    case Kind::integer:
      return {{"type", "integer"}, {"minimum", row.limits.low}, {"maximum", row.limits.high}};
    case Kind::vector:
      return vector_of(quantity(row));
    case Kind::direction:
      return vector_of({{"type", "number"}});
    case Kind::force_down:
    case Kind::along_axis:
      return {{"anyOf", Json::array({quantity(row), vector_of(quantity(row))})}};
    case Kind::acceleration:
      return {{"anyOf", Json::array({quantity(row)["anyOf"][0], {{"const", "auto"}}})}};
    case Kind::changes:
      return {{"type", "object"}, {"minProperties", 1}};
    case Kind::variations:
      return {{"type", "object"},
              {"minProperties", 1},
              {"additionalProperties", {{"type", "array"}, {"minItems", 1}}}};
    case Kind::constants:
      return {{"type", "object"},
              {"additionalProperties", {{"anyOf", Json::array({{{"type", "number"}}, text_with_unit()})}}}};
    case Kind::quantity:
    case Kind::duration:
    case Kind::time_step:
      return quantity(row);
  }
  return {};
}

Json row_schema(const Row& row) {
  Json schema = value_schema(row);
  std::string doc(row.doc);
  if (!row.when.key.empty()) doc += fmt::format(" Only where {}.", describe_when(row));
  if (!row.unit.empty())
    doc += fmt::format(" [{}; a bare number is in {}]", row.unit,
                       core::si_unit(core::parse_unit(row.unit).dimension));
  schema["description"] = doc;
  if (!row.default_note.empty())
    schema["description"] = fmt::format("{} Default: {}.", doc, row.default_note);
  else if (const auto text = default_text(row))
    // A TOML value of these kinds (text, numbers, arrays of them) is JSON as it stands.
    schema["default"] = Json::parse(*text);
  return schema;
}

/// "Where shape is annulus, inner is required", for each row that depends on another key.
Json conditional_requirements(const std::vector<const Row*>& rows) {
  Json all = Json::array();
  for (const Row* row : rows) {
    if (row->when.key.empty() || row->need != Need::required) continue;
    const std::string decider(row->when.key);
    Json required = {{"required", Json::array({row->key})}};
    if (!row->also.empty())
      required = {{"anyOf", Json::array({required, {{"required", Json::array({row->also})}}})}};
    Json decides = {{"enum", row->when.values}};
    if (sibling(*row, row->when.key)->kind == Kind::choices)
      decides = {{"anyOf", Json::array({decides, {{"type", "array"}, {"contains", decides}}})}};
    all.push_back({{"if", {{"properties", {{decider, decides}}}, {"required", Json::array({decider})}}},
                   {"then", required}});
  }
  return all;
}

Json section_schema(const Section& section) {
  Json schema = {{"type", "object"}, {"description", section.doc}, {"additionalProperties", false}};
  Json properties = Json::object();
  Json required = Json::array();
  const std::vector<const Row*> rows = rows_of(section);
  for (const Row* row : rows) {
    properties[std::string(row->key)] = row_schema(*row);
    if (!row->also.empty() && !properties.contains(row->also))
      properties[std::string(row->also)] = row_schema(*row);
    if (row->need == Need::required && row->when.key.empty() && row->implied_by.empty())
      required.push_back(row->key);
  }
  for (const Section* child : sections_in(section)) {
    const std::string word(own_word(*child));
    if (child->naming == Naming::none) {
      properties[word] = section_schema(*child);
    } else if (child->naming == Naming::one_or_list) {
      Json item = section_schema(*child);
      properties[word] = {
          {"anyOf", Json::array({item, {{"type", "array"}, {"items", item}, {"minItems", 1}}})}};
    } else if (child->naming == Naming::list) {
      properties[word] = {{"type", "array"}, {"items", section_schema(*child)}};
      if (child->presence == Presence::at_least_one) properties[word]["minItems"] = 1;
    } else {
      const char* names = child->naming == Naming::pair ? "^[^/]+/[^/]+$" : "^[^/]+$";
      properties[word] = {{"type", "object"},
                          {"propertyNames", {{"pattern", names}}},
                          {"additionalProperties", section_schema(*child)}};
      if (child->presence == Presence::at_least_one) properties[word]["minProperties"] = 1;
    }
    if (child->presence != Presence::optional) required.push_back(word);
  }
  schema["properties"] = properties;
  if (!required.empty()) schema["required"] = required;
  if (Json conditions = conditional_requirements(rows); !conditions.empty()) schema["allOf"] = conditions;
  return schema;
}

}  // namespace

std::string case_json_schema() {
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                 {"title", "Abradem case file, version 1"}};
  schema.update(section_schema(case_sections().front()));
  return schema.dump(2) + "\n";
}

}  // namespace abradem::io
