// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/case_schema.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "abradem/core/units.h"

namespace abradem::io {
namespace {

using Json = nlohmann::json;

/// The schema of the table a row is in: "wall.*.mesh" → properties.wall.additionalProperties.properties.mesh.
const Json& section_of(const Json& schema, std::string_view path) {
  const Json* node = &schema;
  std::istringstream words{std::string(path)};
  for (std::string word; std::getline(words, word, '.');) {
    if (node->contains("anyOf")) node = &node->at("anyOf").at(0);  // one, or a list of them
    node = word != "*"               ? &node->at("properties").at(word)
           : node->contains("items") ? &node->at("items")
                                     : &node->at("additionalProperties");
  }
  return node->contains("anyOf") ? node->at("anyOf").at(0) : *node;
}

TEST(CaseJsonSchema, KnowsEveryKeyAndRefusesOthers) {
  const Json schema = Json::parse(case_json_schema());
  EXPECT_EQ(schema.at("$schema"), "https://json-schema.org/draft/2020-12/schema");
  for (const Row& row : case_rows()) {
    const Json& section = section_of(schema, row.section);
    EXPECT_EQ(section.at("additionalProperties"), false) << row.section;
    ASSERT_TRUE(section.at("properties").contains(row.key)) << row.section << " " << row.key;
    EXPECT_FALSE(
        section.at("properties").at(std::string(row.key)).at("description").get<std::string>().empty());
  }
}

TEST(CaseJsonSchema, StatesChoicesDefaultsAndWhatIsRequired) {
  const Json schema = Json::parse(case_json_schema());
  const Json& wall = section_of(schema, "wall.*");
  EXPECT_EQ(wall.at("properties").at("contact").at("enum"),
            Json({"patch", "resolved", "per_triangle", "auto"}));
  EXPECT_NE(
      wall.at("properties").at("contact").at("description").get<std::string>().find("Default: `\"patch\"`"),
      std::string::npos);
  EXPECT_EQ(wall.at("properties").at("deformation").at("default"), "none");
  EXPECT_EQ(wall.at("required"), Json({"material", "mesh"}));
  EXPECT_EQ(schema.at("required"), Json({"schema", "material", "wall", "run"}));
  EXPECT_EQ(section_of(schema, "run").at("properties").at("time_step").at("default"), "20% rayleigh");
  const Json& mesh = section_of(schema, "wall.*.mesh");
  EXPECT_EQ(mesh.at("allOf").at(0).at("then"), Json::parse(R"({"required": ["inner"]})"));
}

TEST(CaseTable, IsComplete) {
  for (const Row& row : case_rows()) {
    EXPECT_FALSE(row.doc.empty()) << row.key;
    EXPECT_TRUE(row.doc.ends_with('.')) << row.key;
    EXPECT_FALSE(row.example.empty()) << row.key;
    EXPECT_NE(row.slot, nullptr) << row.key;
    EXPECT_EQ(row.kind == Kind::choice || row.kind == Kind::choices, !row.choices.empty());
    if (!row.when.key.empty()) {
      const Row* decider = sibling(row, row.when.key);
      ASSERT_NE(decider, nullptr) << row.key;
      for (const std::string_view value : row.when.values)
        EXPECT_NE(std::ranges::find(decider->choices, value), decider->choices.end())
            << row.key << " " << value;
    }
    int sections = 0;
    for (const Section& section : case_sections()) sections += section.path == row.section ? 1 : 0;
    EXPECT_EQ(sections, 1) << row.section;
  }
}

TEST(CaseTable, HasNoDefaultsForMaterialConstants) {
  for (const Row& row : case_rows()) {
    EXPECT_FALSE(row.section == "material.*" && row.need == Need::has_default) << row.key;
  }
}

TEST(CaseReference, IsFresh) {
  std::ifstream file(ABRADEM_SOURCE_DIR "/docs/reference/case-file.md", std::ios::binary);
  const std::string page((std::istreambuf_iterator<char>(file)), {});
  EXPECT_EQ(page, case_reference_markdown())
      << "run: abradem schema --format md > docs/reference/case-file.md";
}

TEST(TomlText, EscapesWhatTomlNeedsEscaped) {
  EXPECT_EQ(toml_string("a \"b\" \\ \n µ"), "\"a \\\"b\\\" \\\\ \\u000A µ\"");
  EXPECT_EQ(toml_key("mild_steel-2"), "mild_steel-2");
  EXPECT_EQ(toml_key("a/b"), "\"a/b\"");
  EXPECT_EQ(toml_key(""), "\"\"");
}

}  // namespace
}  // namespace abradem::io
