// SPDX-License-Identifier: BSD-3-Clause
// Wear laws that a case writes as an expression.
#include <gtest/gtest.h>

#include "abradem/core/error.h"
#include "abradem/io/case_file.h"
#include "abradem/io/case_schema.h"
#include "abradem/wear/expression.h"
#include "support/says.h"

namespace abradem::io {
namespace {

using test::contains;

using simulation::WearLaw;

constexpr auto kHead = R"(schema = 1
[material.ore]
density = 2650
shear_modulus = "0.1 GPa"
poisson_ratio = 0.25
[material.steel]
density = 7932
shear_modulus = "78 GPa"
poisson_ratio = 0.3
[contact."ore/steel"]
restitution = 0.4
static_friction = 0.3
[wall.floor]
material = "steel"
mesh = { shape = "plate", length = "60 mm", width = "60 mm", size = "10 mm" }
motion = { kind = "translation", velocity = ["1 m/s", 0, 0] }
deformation = "conserving"
[particle.ball]
material = "ore"
radius = "3 mm"
position = [0, 0, "3 mm"]
guide = "vertical"
load = "5 N"
[run]
end = "1 s"
)";

Case read(const std::string& wear, const std::vector<std::string>& overrides = {}) {
  return parse_case(kHead + ("[wear.\"ore/steel\"]\n" + wear), "case.toml", ".", overrides);
}
std::string refusal(const std::string& wear, const std::vector<std::string>& overrides = {}) {
  try {
    static_cast<void>(read(wear, overrides));
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}
TEST(ExpressionCase, IsReadWithItsConstants) {
  const Case found = read(
      "law = [\"archard\", \"expression\"]\nwear_coefficient = 1e-12\n"
      "expression = \"k * Fn * slip * (p_max > p0 ? n : 0)\"\n"
      "[wear.\"ore/steel\".constants]\nk = \"2 mm^3/kJ\"\np0 = \"30 MPa\"\nn = 0.5\n");
  const simulation::WearSetup& w = found.setup.wear[0];
  EXPECT_EQ(w.laws, (std::vector{WearLaw::archard, WearLaw::expression}));
  EXPECT_EQ(w.expression, "k * Fn * slip * (p_max > p0 ? n : 0)");
  ASSERT_EQ(w.constants.size(), 3u);
  EXPECT_EQ(w.constants[0], (core::NamedQuantity{"k", 2e-12, core::parse_unit("1/Pa").dimension}));
  EXPECT_EQ(w.constants[1], (core::NamedQuantity{"p0", 30e6, core::parse_unit("Pa").dimension}));
  EXPECT_EQ(w.constants[2], (core::NamedQuantity{"n", 0.5, {}}));
  EXPECT_EQ(parse_case(resolved_case(found.setup), "again.toml", ".").setup, found.setup);
  EXPECT_TRUE(found.notes.empty());

  const Case other =
      read("law = \"expression\"\nexpression = \"k * Fn * slip\"\nconstants = { k = \"1e-12 1/Pa\" }\n",
           {"wear.\"ore/steel\".constants.k=3e-12 1/Pa"});
  EXPECT_EQ(other.setup.wear[0].constants[0].value, 3e-12);
}

TEST(ExpressionCase, SaysWhatIsWrongAndWhere) {
  const auto law = [](const std::string& expression, const std::string& constants) {
    return "law = \"expression\"\nexpression = \"" + expression + "\"\nconstants = { " + constants + " }\n";
  };
  const std::string k = "k = \"1e-12 1/Pa\"";
  EXPECT_TRUE(contains(refusal("law = \"expression\"\n"), "missing key 'expression'"));
  EXPECT_TRUE(contains(refusal("wear_coefficient = 1e-12\nexpression = \"k\"\n"),
                       "'expression' in [wear.\"ore/steel\"] counts only where law = expression"));
  // The caret is under the name.
  EXPECT_TRUE(contains(refusal(law("k * Fm * slip", k)),
                       "case.toml:28:19: error: unknown name 'Fm' at character 5, did you mean 'Fn'?"));
  EXPECT_TRUE(
      contains(refusal(law("k * Fn * slip / H * H", k)), "'H' at character 17 is the hardness of the wall"));
  EXPECT_TRUE(contains(refusal(law("k * Fn", k)), "expected a volume"));
  EXPECT_TRUE(contains(refusal(law("k * Fn * slip", "k = \"1e-12 m\"")), "expected a volume"));
  EXPECT_TRUE(contains(refusal(law("k * Fn * slip", "k = \"1e-12 1/Paa\"")), "Paa"));
  EXPECT_TRUE(contains(refusal(law("k * Fn * slip", "k = true")), "'k' is true (a boolean)"));
  EXPECT_TRUE(contains(refusal("law = \"expression\"\nexpression = \"Fn\"\nconstants = 3\n"),
                       "expected names with their quantities"));
  EXPECT_TRUE(
      contains(refusal(law("k * m * v^2", k), {"run.method=quasi_static"}), "no impacts and no normal_work"));
  EXPECT_TRUE(contains(refusal(law("k * Fn * slip", k), {"ploughing.removed_fraction=0.5"}), "[ploughing]"));
  EXPECT_EQ(refusal(law("k * Fn * slip", k), {"run.method=quasi_static"}), "accepted");

  const auto notes = [&](const std::string& text) {
    std::string all;
    for (const std::string& note : read(text).notes) all += note + "\n";
    return all;
  };
  EXPECT_TRUE(contains(notes(law("k * Fn * a", k)), "the volume depends on the time step"));
  EXPECT_TRUE(contains(notes(law("k * Fn * slip", k + ", c = 3")), "does not name 'c'"));
}

/// The list of names in the reference is the one that expressions know.
TEST(ExpressionCase, IsInTheReference) {
  const std::string reference = case_reference_markdown();
  for (const wear::SymbolInfo& s : wear::expression_symbols())
    EXPECT_TRUE(contains(reference, "| `" + std::string(s.name) + "` | "));
}

}  // namespace
}  // namespace abradem::io
