// SPDX-License-Identifier: BSD-3-Clause
// What a case says of its walls, and what it leaves open.
#include <gtest/gtest.h>

#include <numbers>

#include "abradem/core/error.h"
#include "abradem/io/case_file.h"
#include "support/case_texts.h"
#include "support/says.h"

namespace abradem::io {
namespace {

using simulation::ContactRule;

constexpr auto kHead = R"(schema = 1
[material.steel]
density = 7932
shear_modulus = "78 GPa"
poisson_ratio = 0.3
[contact."steel/steel"]
restitution = 0.4
static_friction = 0.3
[run]
end = "1 s"
time_step = "1e-5 s"
[wall.floor]
material = "steel"
)";
constexpr auto kPlate =
    "mesh = { shape = \"plate\", length = \"60 mm\", width = \"60 mm\", size = \"10 mm\" }\n";
constexpr auto kNamed = R"([particle.ball]
material = "steel"
radius = "3 mm"
position = [0, 0, "20 mm"]
)";
constexpr auto kGrains = R"([insertion.grains]
material = "steel"
number = 10
size = { radius = "3 mm" }
volume = { low = [0, 0, "10 mm"], high = ["30 mm", "30 mm", "40 mm"] }
)";

simulation::Setup read(const std::string& rest) { return parse_case(kHead + rest, "case.toml", ".").setup; }

std::string refusal(const std::string& rest) {
  try {
    static_cast<void>(read(rest));
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

TEST(WallCase, ContactIsAutoWhereAllParticlesAreInNumbers) {
  const std::string plate = kPlate;
  EXPECT_EQ(read(plate + kNamed).walls[0].contact, ContactRule::patch);
  EXPECT_EQ(read(plate + kGrains).walls[0].contact, ContactRule::automatic);
  EXPECT_EQ(read(plate + kGrains + kNamed).walls[0].contact, ContactRule::patch);
  EXPECT_EQ(read(plate + "contact = \"patch\"\n" + kGrains).walls[0].contact, ContactRule::patch);
  EXPECT_EQ(read(plate + "sides = \"both\"\n" + kGrains).walls[0].contact, ContactRule::resolved);
  const simulation::Setup setup = read(plate + kGrains);
  EXPECT_EQ(parse_case(resolved_case(setup), "resolved", ".").setup, setup);
}

/// Contacts that last beyond zero overlap are followed by points.
TEST(WallCase, JkrTakesTheResolvedRule) {
  const auto with_jkr = [](const std::string& rest, const char* more = "") {
    return test::replaced(
        kHead + rest, "static_friction = 0.3",
        std::string("static_friction = 0.3\ncohesion = \"jkr\"\nwork_of_adhesion = 0.1\n") + more);
  };
  const auto refused = [](const std::string& text) {
    try {
      static_cast<void>(parse_case(text, "case.toml", "."));
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string("accepted");
  };
  const std::string plate = kPlate;
  EXPECT_EQ(parse_case(with_jkr(plate + kGrains), "case.toml", ".").setup.walls[0].contact,
            ContactRule::resolved);
  EXPECT_TRUE(test::says(refused(with_jkr(plate + "contact = \"auto\"\n" + kGrains)),
                         {"case.toml:18:11:", "JKR contacts with wall 'floor'", "contact = \"resolved\""}));
  EXPECT_TRUE(test::says(refused(with_jkr(plate + kGrains, "law = \"linear\"\nnormal_stiffness = 1e4\n")),
                         {"case.toml:9:", "with law = \"linear\" take sjkr"}));
}

TEST(WallCase, ASheetTakesTheResolvedRuleAndKeepsItsShape) {
  const std::string plate = kPlate;
  EXPECT_EQ(refusal(plate + "sides = \"both\"\ncontact = \"resolved\"\n" + kNamed), "accepted");
  EXPECT_NE(refusal(plate + "sides = \"both\"\n" + kNamed).find("takes contact = \"resolved\""),
            std::string::npos);
  EXPECT_NE(refusal(plate + "sides = \"both\"\ndeformation = \"conserving\"\n" + kGrains)
                .find("deformation = \"none\""),
            std::string::npos);
  EXPECT_NE(refusal("mesh = { shape = \"plane\" }\nsides = \"both\"\n" + std::string(kGrains))
                .find("with a half space behind it"),
            std::string::npos);
}

TEST(WallCase, ATurnedShapeIsNotJudgedAsALevelOne) {
  const std::string mesh =
      "mesh = { shape = \"plate\", length = \"60 mm\", width = \"60 mm\", size = \"10 mm\", "
      "position = [\"10 mm\", 0, \"22 mm\"]";
  // Level it would hold the ball's centre beneath it; upright it stands beside the ball.
  EXPECT_NE(refusal(mesh + ", rotation = [0, 0, 0] }\n" + kNamed), "accepted");
  const simulation::Setup setup = read(mesh + ", rotation = [0, \"90 deg\", 0] }\n" + kNamed);
  EXPECT_DOUBLE_EQ(setup.walls[0].mesh.rotation.y, 0.5 * std::numbers::pi);
  EXPECT_NE(refusal("mesh = { shape = \"plane\", rotation = [0, 1, 0] }\n" + std::string(kNamed))
                .find("counts only where shape = annulus or disc or plate or file"),
            std::string::npos);
}

}  // namespace
}  // namespace abradem::io
