// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/case_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>

#include "abradem/io/case_problems.h"
#include "support/case_texts.h"
#include "support/says.h"

namespace abradem::io {
namespace {

using test::contains;
using test::replaced;

namespace fs = std::filesystem;
using CaseSetup = simulation::Setup;

const char* const kExample = ABRADEM_SOURCE_DIR "/cases/pin-on-disc.toml";

/// A short case in which everything has its default.
constexpr const char* kSmall = R"(schema = 1
[material.ore]
density = 4850
shear_modulus = "0.1 GPa"
poisson_ratio = 0.24
[contact."ore/ore"]
restitution = 0.4
static_friction = 1
[wall.floor]
material = "ore"
mesh = { shape = "plane" }
[particle.ball]
material = "ore"
radius = "3 mm"
position = [0, 0, "10 mm"]
[run]
end = "2 s"
)";

CaseSetup read(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return parse_case(text, "case.toml", "/folder", overrides).setup;
}

CaseSetup example(const std::vector<std::string>& overrides = {}) { return read_case(kExample, overrides); }

std::string complaint(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    static_cast<void>(read(text, overrides));
    return {};
  } catch (const InputError& error) {
    return error.what();
  }
}

std::string complaint_about_example(const std::string& override) {
  try {
    static_cast<void>(example({override}));
    return {};
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(CaseFile, TheExampleSaysWhatItSays) {
  const CaseSetup s = example();
  EXPECT_EQ(s.title, "Pin on disc: iron ore on mild steel");
  ASSERT_EQ(s.materials.size(), 2u);
  EXPECT_EQ(s.materials[0], (simulation::MaterialSetup{"iron_ore", 4850.0, 1e8, 0.24, {}}));
  EXPECT_EQ(s.materials[1], (simulation::MaterialSetup{"mild_steel", 7932.0, 78e9, 0.3, 143 * 9.80665e6}));
  ASSERT_EQ(s.contacts.size(), 1u);
  EXPECT_EQ(s.contacts[0], (simulation::ContactSetup{"iron_ore", "mild_steel", 0.4, 1.0, 0.0}));
  ASSERT_EQ(s.wear.size(), 1u);
  EXPECT_EQ(s.wear[0], (simulation::WearSetup{"iron_ore", "mild_steel", 6.81e-11}));
  ASSERT_EQ(s.walls.size(), 1u);
  const simulation::WallSetup& disc = s.walls[0];
  EXPECT_EQ(disc.name, "disc");
  EXPECT_EQ(disc.material, "mild_steel");
  EXPECT_EQ(disc.mesh.shape, simulation::MeshShape::annulus);
  EXPECT_EQ(disc.mesh.inner, 0.020);
  EXPECT_EQ(disc.mesh.outer, 0.024);
  EXPECT_EQ(disc.mesh.size, 0.0001);
  EXPECT_EQ(disc.motion.kind, simulation::MotionKind::rotation);
  EXPECT_EQ(disc.motion.rate, std::numbers::pi);
  EXPECT_EQ(disc.contact, simulation::ContactRule::patch);
  EXPECT_EQ(disc.deformation, simulation::DeformationRule::conserving);
  EXPECT_EQ(disc.footprint, simulation::Footprint::hertz);
  ASSERT_EQ(s.particles.size(), 1u);
  const simulation::ParticleSetup& pin = s.particles[0];
  EXPECT_EQ(pin.radius, 0.003);
  EXPECT_EQ(pin.position, (Vec3{0.022, 0.0, 0.003}));
  EXPECT_EQ(pin.guide, simulation::Guide::vertical);
  EXPECT_EQ(pin.load, (Vec3{0.0, 0.0, -5.0}));
  EXPECT_EQ(s.run.end, (simulation::Duration{12.0, true}));
  EXPECT_EQ(s.run.time_step, (simulation::TimeStep{0.2, true}));
  EXPECT_EQ(s.output.every, (simulation::Duration{1.0, true}));
  EXPECT_EQ(s.output.contours, 360);
  ASSERT_TRUE(s.measurement);
  EXPECT_EQ(s.measurement->wear_volume, (simulation::MeanSd{0.565e-9, 0.089e-9}));
  EXPECT_EQ(s.measurement->depth, (simulation::Range{0.010e-3, 0.014e-3}));
  EXPECT_EQ(s.measurement->revolutions, 1302.5);
}

TEST(CaseFile, KeepsTheTextByteForByte) {
  std::ifstream file(kExample, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  EXPECT_EQ(load_case(kExample).text, text);
}

TEST(CaseFile, AKeyOfAnyCharacterIsReadOrRefusedInWords) {
  const std::string small = kSmall;
  EXPECT_EQ(complaint(small + "\u00b3 = 1\n").substr(0, 22), "case.toml:18:1: error:");
  const auto utf8 = [](unsigned c) {
    std::string text;
    const auto byte = [&](unsigned b) { text += static_cast<char>(b); };
    if (c < 0x800) {
      byte(0xc0 | c >> 6);
    } else {
      byte(0xe0 | c >> 12);
      byte(0x80 | (c >> 6 & 0x3f));
    }
    byte(0x80 | (c & 0x3f));
    return text;
  };
  for (unsigned c = 0x80; c < 0x10000; c += c < 0x1000 ? 1 : 61)
    EXPECT_NE(complaint(small + utf8(c) + " = 1\n"), "") << c;
}

TEST(CaseFile, WhatIsNotGivenHasTheDefaultOfTheSetup) {
  const CaseSetup s = read(kSmall);
  const simulation::WallSetup fresh;
  EXPECT_EQ(s.walls[0].motion, fresh.motion);
  EXPECT_EQ(s.walls[0].contact, fresh.contact);
  EXPECT_EQ(s.walls[0].deformation, simulation::DeformationRule::none);
  EXPECT_EQ(s.particles[0].load, Vec3{});
  EXPECT_EQ(s.run.time_step, simulation::TimeStep{});
  EXPECT_EQ(s.run.seed, 1u);
  EXPECT_FALSE(s.measurement);
  // Nothing turns: a tenth of the run, not a revolution.
  EXPECT_EQ(s.output.every, (simulation::Duration{0.2, false}));
}

TEST(CaseFile, KeepsTheOrderOfTheFile) {
  const CaseSetup s =
      read(std::string(kSmall) + "[wall.another]\nmaterial = \"ore\"\nmesh = { shape = \"plane\" }\n");
  ASSERT_EQ(s.walls.size(), 2u);
  EXPECT_EQ(s.walls[0].name, "floor");
  EXPECT_EQ(s.walls[1].name, "another");
}

TEST(CaseFile, ReadsEveryShapeAndMotion) {
  const auto with = [](const std::string& mesh, const std::string& motion) {
    return read(replaced(kSmall, "mesh = { shape = \"plane\" }", "mesh = " + mesh + "\nmotion = " + motion))
        .walls[0];
  };
  const auto plate = with(
      R"({ shape = "plate", length = "30 mm", width = "10 mm", size = "1 mm", position = [0, 0, "-1 mm"] })",
      R"({ kind = "oscillation", amplitude = "5 mm", axis = [3, 0, 0], frequency = "2 Hz" })");
  EXPECT_EQ(plate.mesh.length, 0.03);
  EXPECT_EQ(plate.mesh.width, 0.01);
  EXPECT_EQ(plate.mesh.position, (Vec3{0.0, 0.0, -0.001}));
  EXPECT_EQ(plate.motion.amplitude, (Vec3{0.005, 0.0, 0.0}));
  EXPECT_EQ(plate.motion.axis, (Vec3{1.0, 0.0, 0.0}));
  EXPECT_EQ(plate.motion.frequency, 2.0);
  const auto disc = with(R"({ shape = "disc", radius = "24 mm", size = "1 mm" })",
                         R"({ kind = "translation", velocity = ["70 mm/s", 0, 0] })");
  EXPECT_EQ(disc.mesh.outer, 0.024);
  EXPECT_EQ(disc.mesh.inner, 0.0);
  EXPECT_EQ(disc.motion.velocity, (Vec3{0.07, 0.0, 0.0}));
  EXPECT_EQ(with(R"({ shape = "disc", outer = "24 mm", size = "1 mm" })", R"({ kind = "none" })").mesh,
            disc.mesh);
  const auto plane = with(R"({ shape = "plane", normal = [0, 3, 4] })",
                          R"({ kind = "rotation", rate = "30 rpm", centre = ["1 mm", 0, 0] })");
  EXPECT_EQ(plane.mesh.normal, (Vec3{0.0, 0.6, 0.8}));
  EXPECT_EQ(plane.motion.rate, std::numbers::pi);
  EXPECT_EQ(plane.motion.center, (Vec3{0.001, 0.0, 0.0}));
}

class MeshFile : public testing::Test {
 protected:
  MeshFile() : folder_(fs::temp_directory_path() / fs::path("abradem-case-" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
    std::ofstream(folder_ / "disc.STL") << "solid\nendsolid\n";
    std::ofstream(folder_ / "disc.step") << "x";
  }
  ~MeshFile() override { fs::remove_all(folder_); }
  CaseSetup with(const std::string& mesh) const {
    return parse_case(replaced(kSmall, "{ shape = \"plane\" }", mesh), "case.toml", folder_).setup;
  }
  std::string complaint_with(const std::string& mesh) const {
    try {
      static_cast<void>(with(mesh));
      return {};
    } catch (const InputError& error) {
      return error.what();
    }
  }
  fs::path folder_;
};

TEST_F(MeshFile, IsRelativeToTheCaseAndNeedsItsUnit) {
  const CaseSetup s = with(R"({ file = "disc.STL", unit = "mm" })");
  EXPECT_EQ(s.walls[0].mesh.shape, simulation::MeshShape::file);
  EXPECT_EQ(s.walls[0].mesh.file, (folder_ / "disc.STL").string());
  EXPECT_EQ(s.walls[0].mesh.unit, 0.001);
  EXPECT_EQ(read(resolved_case(s)), s);
  EXPECT_TRUE(contains(complaint_with(R"({ file = "disc.STL" })"), "missing key 'unit'"));
  EXPECT_TRUE(contains(complaint_with(R"({ file = "disc.STL", unit = "kg" })"), "expected a unit of length"));
  EXPECT_EQ(with(R"({ file = "disc.STL", unit = "25.4 mm" })").walls[0].mesh.unit, 0.0254);
}

TEST_F(MeshFile, ThatCannotBeReadIsNamed) {
  EXPECT_TRUE(contains(complaint_with(R"({ file = "none.stl", unit = "mm" })"), "none.stl' does not exist"));
  EXPECT_TRUE(contains(complaint_with(R"({ file = ".", unit = "mm" })"), "is a folder"));
  EXPECT_TRUE(contains(complaint_with(R"({ file = "disc.step", unit = "mm" })"), "none of .stl, .obj, .ply"));
  EXPECT_TRUE(contains(complaint_with(R"({ file = "", unit = "mm" })"), "is empty"));
}

// ---- the resolved case
// ---------------------------------------------------------------------------------------

TEST(ResolvedCase, ReadsBackToTheSameSetup) {
  for (const CaseSetup& s : {example(), read(kSmall),
                             example({"run.end=24 s", "run.method=quasi_static", "run.increment=51 um"})}) {
    const std::string text = resolved_case(s);
    EXPECT_EQ(read(text), s) << text;
    EXPECT_EQ(resolved_case(read(text)), text);
  }
}

TEST(ResolvedCase, KeepsBitsThatNoShortNumberHas) {
  CaseSetup s = example();
  s.title = "quotes \" and \\ and \t and µ";
  s.materials[0].density = std::nextafter(4850.0, 5000.0);
  s.walls[0].motion.rate = std::nextafter(std::numbers::pi, 4.0);
  s.walls[0].mesh.size = 1.0 / 9000.0;
  s.materials[1].hardness = 1.0 / 3.0 * 1e9;
  s.particles[0].velocity = {1e-300, -1.0 / 3.0, 0.1 + 0.2};
  s.run.time_step = {1.0 / 3.0, true};
  s.run.end = {1.0 / 3.0, false};
  s.run.seed = 9'000'000'000'000'000'001u;
  EXPECT_EQ(read(resolved_case(s)), s) << resolved_case(s);
}

TEST(ResolvedCase, NamesWhatWasNotGiven) {
  const std::string text = resolved_case(example());
  EXPECT_TRUE(contains(text, "# hardness: not given"));
  EXPECT_TRUE(contains(text, "inner = \"20 mm\""));
  EXPECT_TRUE(contains(text, "rate = \"180 deg/s\""));
}

// ---- overrides
// -----------------------------------------------------------------------------------------------

TEST(Override, ChangesWhatTheFileSays) {
  const CaseSetup s = example(
      {R"(contact."iron_ore/mild_steel".restitution=0.5)", "run.end=24 s", "wall.disc.contact=resolved",
       "wall.disc.mesh.size = \"0.2 mm\"", "particle.pin.position=[\"22 mm\", 0, 0.003]", "title=a = b",
       "wall.disc.motion = { kind = \"rotation\", rate = \"90 deg/s\" }", "run.seed=7", "run.seed=8"});
  EXPECT_EQ(s.contacts[0].restitution, 0.5);
  EXPECT_EQ(s.run.end, (simulation::Duration{24.0, false}));
  EXPECT_EQ(s.walls[0].contact, simulation::ContactRule::resolved);
  EXPECT_EQ(s.walls[0].mesh.size, 0.0002);
  EXPECT_EQ(s.walls[0].mesh.inner, 0.020);
  EXPECT_EQ(s.walls[0].motion.rate, std::numbers::pi / 2);
  EXPECT_EQ(s.title, "a = b");
  EXPECT_EQ(s.run.seed, 8u);
}

TEST(Override, AddsASectionThatTheFileLeftOut) {
  EXPECT_EQ(read(kSmall, {"output.contours=36"}).output.contours, 36);
}

TEST(Override, IsReportedByItsOwnText) {
  EXPECT_TRUE(
      contains(complaint_about_example("run.sed=3"),
               "--set: error: unknown key 'sed' in [run]; did you mean 'seed'?\n    run.sed=3\n        ^"));
  EXPECT_TRUE(
      contains(complaint_about_example("run.end=12 kg"), "--set: error: 'end': expected a time such as"));
  EXPECT_TRUE(contains(complaint_about_example("run.end"), "expected KEY=VALUE"));
  EXPECT_TRUE(contains(complaint_about_example("run.end="), "value after '=' is missing"));
  EXPECT_TRUE(contains(complaint_about_example("=3"), "expected KEY=VALUE"));
  EXPECT_TRUE(contains(complaint_about_example("a b=3"), "dotted key"));
  EXPECT_TRUE(contains(complaint_about_example("run=3"), "is a table, not a value"));
}

TEST(Override, AddsNoNewNames) {
  EXPECT_TRUE(contains(complaint_about_example("particle.pni.radius=3 mm"),
                       "the case has no particle 'pni'; it has 'pin'"));
  EXPECT_TRUE(contains(complaint_about_example("contact.x.restitution=0.5"), "'iron_ore/mild_steel'"));
}

// ---- what cannot be read
// -------------------------------------------------------------------------------------

TEST(UnusableFile, IsOneClearMessage) {
  const auto complaint_of = [](const fs::path& path) -> std::string {
    try {
      static_cast<void>(read_case(path));
      return {};
    } catch (const InputError& error) {
      EXPECT_EQ(error.code(), ExitCode::input);
      return error.what();
    }
  };
  EXPECT_TRUE(contains(complaint_of("no/such.toml"), "'no/such.toml' does not exist"));
  EXPECT_TRUE(contains(complaint_of(ABRADEM_SOURCE_DIR), "is a folder"));
  EXPECT_TRUE(contains(complaint_of("/dev/null"), "is empty"));
  EXPECT_TRUE(contains(complaint_of("/dev/zero"), "larger than 16 MB"));
  EXPECT_TRUE(contains(complaint(""), "is empty"));
  EXPECT_TRUE(contains(complaint(" \n\t\n"), "is empty"));
  EXPECT_TRUE(contains(complaint(std::string("\x7f"
                                             "ELF\0\0\0",
                                             7)),
                       "not a text file"));
  EXPECT_TRUE(contains(complaint("\xff\xfe\x41"), "case.toml:1:1: error: this is not TOML"));
  EXPECT_TRUE(contains(complaint("schema = 1\ntitle = \"x\n"), "case.toml:2:"));
  EXPECT_TRUE(contains(complaint("# only a comment\n"), "missing key 'schema'"));
  EXPECT_TRUE(contains(complaint("schema = 1\nschema = 1\n"), "case.toml:2:"));
  EXPECT_TRUE(contains(complaint("schema = 1\n[=]\n"), "case.toml:2:2: error: this is not TOML"));
  EXPECT_TRUE(contains(complaint("[[[x]]]\n"), "case.toml:1:3: error: this is not TOML"));
}

// ---- values
// --------------------------------------------------------------------------------------------------

struct BadValue {
  const char* replace;
  const char* by;
  const char* message;
};

class RefusesValue : public testing::TestWithParam<BadValue> {};

TEST_P(RefusesValue, SayingWhatWasExpected) {
  const BadValue& bad = GetParam();
  EXPECT_TRUE(contains(complaint(replaced(kSmall, bad.replace, bad.by)), bad.message));
}

INSTANTIATE_TEST_SUITE_P(
    Values, RefusesValue,
    testing::Values(
        BadValue{
            "\"3 mm\"", "\"3 kg\"",
            "case.toml:14:10: error: 'radius': expected a length such as \"3 mm\", got \"3 kg\" (a mass)"},
        BadValue{"\"3 mm\"", "\"-3 mm\"", "'radius': must be > 0, got \"-3 mm\""},
        BadValue{"\"3 mm\"", "0", "must be > 0, got 0"},
        BadValue{"\"3 mm\"", "nan", "nan is not a finite number"},
        BadValue{"\"3 mm\"", "-inf", "not a finite number"},
        BadValue{"\"3 mm\"", "\"nan mm\"", "not a finite number"},
        BadValue{"\"3 mm\"", "\"3\"", "text without a unit; a bare number, 3, would be in m"},
        BadValue{"\"3 mm\"", "\"3 mmm\"",
                 "case.toml:14:13: error: 'radius': in \"3 mmm\": unknown unit 'mmm'; did you mean 'mm'?"},
        BadValue{"\"3 mm\"", "true", "got true (a boolean)"},
        BadValue{"\"3 mm\"", "1979-05-27", "got a date"}, BadValue{"\"3 mm\"", "[1, 2]", "got an array of 2"},
        BadValue{"\"3 mm\"", "{ a = 1 }", "got a table"},
        BadValue{"[0, 0, \"10 mm\"]", "[0, 0]", "expected three components such as"},
        BadValue{"[0, 0, \"10 mm\"]", "[0, \"1 s\", \"10 mm\"]",
                 "case.toml:15:16: error: 'position': expected a length"},
        BadValue{"[0, 0, \"10 mm\"]", "\"10 mm\"", "expected three components"},
        BadValue{"poisson_ratio = 0.24", "poisson_ratio = 0.5", "must be > -1 and < 0.5, got 0.5"},
        BadValue{"poisson_ratio = 0.24", "poisson_ratio = -1", "must be > -1 and < 0.5"},
        BadValue{"poisson_ratio = 0.24", "poisson_ratio = \"1 mm\"",
                 "expected a number, got \"1 mm\" (a length)"},
        BadValue{"poisson_ratio = 0.24", "",
                 "case.toml:2:11: error: missing key 'poisson_ratio' in [material.ore]"},
        BadValue{"restitution = 0.4", "restitution = 0", "must be > 0 and <= 1"},
        BadValue{"static_friction = 1", "static_friction = -1", "must be >= 0"},
        BadValue{"static_friction", "static_frction",
                 "unknown key 'static_frction' in [contact.\"ore/ore\"]; did you mean 'static_friction'?"},
        BadValue{"static_friction", "friction", "did you mean 'static_friction'?"},
        BadValue{"static_friction = 1", "static_friction = 1\ngravity = 1", "it belongs in [run]"},
        BadValue{"static_friction = 1", "static_friction = 1\nlaw = \"hooke\"",
                 "expected one of \"hertz_mindlin\""},
        BadValue{"\"plane\"", "\"plnae\"", "did you mean \"plane\"?"},
        BadValue{"\"plane\"", "3", "expected one of"},
        BadValue{"shape = \"plane\"", "", "missing key 'shape'"},
        BadValue{"shape = \"plane\"", "shape = \"plane\", size = 1",
                 "'size' in [wall.floor.mesh] counts only where shape = annulus or disc or plate; here shape "
                 "= \"plane\""},
        BadValue{"shape = \"plane\"", "shape = \"plane\", normal = [0, 0, 0]", "points nowhere"},
        BadValue{"shape = \"plane\"", "shape = \"disc\", radius = 1, outer = 1, size = 1",
                 "are the same; give one"},
        BadValue{"\"2 s\"", "\"2 m\"",
                 "expected a time such as \"24 s\" or a number of revolutions such as \"12 rev\", got \"2 "
                 "m\" (a length)"},
        BadValue{"\"2 s\"", "\"-2 s\"", "must be > 0"}, BadValue{"\"2 s\"", "\"2\"", "text without a unit"},
        BadValue{"\"2 s\"", "inf", "not a finite"}, BadValue{"\"2 s\"", "[]", "expected a time"},
        BadValue{"\"2 s\"", "\"2 s\"\ntime_step = \"20% raleigh\"", "did you mean \"rayleigh\"?"},
        BadValue{"\"2 s\"", "\"2 s\"\ntime_step = \"200% rayleigh\"", "never stable"},
        BadValue{"\"2 s\"", "\"2 s\"\ntime_step = \"20%\"", "expected a time such as \"1.4e-5 s\""},
        BadValue{"\"2 s\"", "\"2 s\"\ntime_step = 0", "must be > 0"},
        BadValue{"\"2 s\"", "\"2 s\"\nseed = -1", "expected a whole number"},
        BadValue{"\"2 s\"", "\"2 s\"\nseed = 1.5", "expected a whole number"},
        BadValue{"schema = 1", "schema = 2", "version 1 of the case format, got 2"},
        BadValue{"schema = 1", "", "missing key 'schema' at the top of the file"},
        BadValue{"schema = 1", "schema = 1\ntitle = 3", "expected text such as"},
        BadValue{"[run]\nend", "[output]\nevery", "missing [run]"},
        BadValue{"[run]", "[rnu]", "unknown key 'rnu' at the top of the file; did you mean 'run'?"},
        BadValue{"[material.ore]", "[material]", "'density' cannot stand directly in [material]"},
        BadValue{"[contact.\"ore/ore\"]", "[contact.ore]", "'ore' is not a pair"},
        BadValue{"[contact.\"ore/ore\"]", "[contact.\"ore/\"]", "'ore/' is not a pair"},
        BadValue{"[particle.ball]", "[particle.\"a/b\"]", "'a/b' cannot be a name"}));

// ---- several problems, several keys
// --------------------------------------------------------------------------

TEST(Problems, AreAllReportedInOnePassInTheOrderOfTheFile) {
  std::string text = replaced(kSmall, "4850", "\"4850 kg\"");
  text = replaced(text, "restitution = 0.4", "restitutoin = 0.4");
  text = replaced(text, "\"3 mm\"", "\"-3 mm\"");
  try {
    static_cast<void>(read(text, {"run.seed=x"}));
    FAIL();
  } catch (const CaseError& error) {
    ASSERT_EQ(error.problems.size(), 5u) << error.what();
    const auto at = [&](std::size_t i) {
      const Place& p = error.problems[i].place;
      return std::to_string(p.source) + ":" + std::to_string(p.line) + ":" + std::to_string(p.column);
    };
    EXPECT_EQ(at(0), "0:3:11");
    EXPECT_EQ(at(1), "0:6:10");
    EXPECT_EQ(at(2), "0:7:1");
    EXPECT_EQ(at(3), "0:14:10");
    EXPECT_EQ(at(4), "1:1:10");
    EXPECT_TRUE(
        contains(error.what(),
                 "case.toml:7:1: error: unknown key 'restitutoin' in [contact.\"ore/ore\"]; did you mean "
                 "'restitution'?\n    restitutoin = 0.4\n    ^\n"));
    EXPECT_TRUE(contains(error.what(), "case.toml: 5 errors"));
  }
}

TEST(Problems, PutTheCaretUnderItsColumnBehindTabsAndUmlauts) {
  const std::string text = replaced(kSmall, "radius = \"3 mm\"", "\tradius\t= \"3 kg\" # µ");
  EXPECT_TRUE(contains(complaint(text), "    \tradius\t= \"3 kg\" # µ\n    \t      \t  ^\n"));
}

TEST(Problems, AreCutOffWhenTheyFillTheScreen) {
  std::string text = kSmall;
  for (int i = 0; i < 100; ++i) text += "zzz" + std::to_string(i) + " = 1\n";
  EXPECT_TRUE(contains(complaint(text), "… and 60 more"));
  EXPECT_TRUE(contains(complaint(text), "100 errors"));
}

struct BadExample {
  const char* override;
  const char* message;
};

class RefusesCombination : public testing::TestWithParam<BadExample> {};

TEST_P(RefusesCombination, SayingWhatToChange) {
  EXPECT_TRUE(contains(complaint_about_example(GetParam().override), GetParam().message))
      << GetParam().override;
}

INSTANTIATE_TEST_SUITE_P(
    Combinations, RefusesCombination,
    testing::Values(
        BadExample{"wall.disc.material=mild_steal", "no material 'mild_steal'; did you mean 'mild_steel'?"},
        BadExample{"particle.pin.material=copper", "no material 'copper'; add [material.copper]"},
        BadExample{"particle.pin.material=mild_steel",
                   "particle 'pin' and wall 'disc' can touch, but the case has no contact pair for their "
                   "materials; add "
                   "[contact.\"mild_steel/mild_steel\"]"},
        BadExample{"wear={}",
                   "does not say how 'iron_ore' wears 'mild_steel'; add [wear.\"iron_ore/mild_steel\"]"},
        BadExample{"wall.disc.mesh.outer=\"20 mm\"",
                   "the outer radius, 20 mm, must be larger than the inner one, 20 mm"},
        BadExample{"wall.disc.mesh.size=\"5 mm\"", "triangles of 5 mm do not fit into a shape 4 mm wide"},
        BadExample{"wall.disc.mesh.size=\"5 um\"", "5.1e+07 of them, more than the 2e+07"},
        BadExample{
            "wall.disc.mesh={shape=\"annulus\",inner=20,outer=24,size=0.1}",
            "wall 'disc' is 48 m wide and 'pin' has a radius of 3 mm: is the wall given in millimetres?"},
        BadExample{"wall.disc.mesh={shape=\"annulus\",inner=20e-6,outer=24e-6,size=0.1e-6}",
                   "in the wrong unit of length"},
        BadExample{"particle.pin.radius=3",
                   "'pin' has a radius of 3 m; a bare number is in metres: was \"3 mm\" meant?"},
        BadExample{"particle.pin.position=[\"22 mm\",0,\"-1 mm\"]",
                   "the centre of 'pin' is 1 mm below the surface of wall 'disc'"},
        BadExample{"particle.pin.position=[\"22 mm\",0,\"2.5 mm\"]",
                   "'pin' starts 0.5 mm deep in wall 'disc', 17 % of its radius"},
        BadExample{"particle.pin.position=[\"30 mm\",0,\"3 mm\"]",
                   "it misses wall 'disc' by 6 mm sideways, a ring from 20 mm to 24 mm"},
        BadExample{"particle.pin.position=[0,0,\"3 mm\"]", "it misses wall 'disc' by 20 mm sideways"},
        BadExample{"particle.pin.position=[\"22 mm\",0,\"9 mm\"]", "'pin' hangs 6 mm above wall 'disc'"},
        BadExample{"particle.pin.load=\"1e308 N\"", "the load would press 'pin' through the wall"},
        BadExample{"particle.pin.spin=[0,0,1]", "the guide of 'pin' blocks its spin"},
        BadExample{"wall.disc.motion.rate=0", "revolutions cannot be counted"},
        BadExample{"wall.disc.motion.rate=\"2 Hz\"",
                   "(a frequency; say what turns: rad/s, deg/s, rev/s or rpm)"},
        BadExample{"wall.disc.motion={kind=\"oscillation\",amplitude=1,frequency=\"30 rpm\"}",
                   "(a rate of rotation; 1 Hz is one cycle per second)"},
        BadExample{"wall.disc.motion={kind=\"spin\"}", "expected one of \"none\", \"rotation\""},
        BadExample{"measurement.depth.low=\"1 mm\"",
                   "the smallest value, 1 mm, is above the largest, 0.014 mm"},
        BadExample{"wall.disc.mesh={shape=\"plane\"}", "an analytic plane, which has no nodes to move"},
        BadExample{"wear.\"iron_ore/mild_steel\".acceleration=0.5", "'acceleration': must be >= 1, got 0.5"},
        BadExample{"wear.\"iron_ore/mild_steel\".acceleration=automatic",
                   "expected a number such as 108.5 or \"auto\", got \"automatic\""},
        BadExample{"wear.\"iron_ore/mild_steel\".tolerance=0", "'tolerance': must be >"}));

TEST(Acceleration, IsANumberOrLeftToTheProgram) {
  const std::string key = "wear.\"iron_ore/mild_steel\".acceleration=";
  EXPECT_EQ(example().wear[0].acceleration, (simulation::Acceleration{1.0, false}));
  EXPECT_EQ(example({key + "108.5"}).wear[0].acceleration, (simulation::Acceleration{108.5, false}));
  const CaseSetup automatic = example({key + "auto", "wear.\"iron_ore/mild_steel\".tolerance=2 %"});
  EXPECT_EQ(automatic.wear[0].acceleration, (simulation::Acceleration{1.0, true}));
  EXPECT_DOUBLE_EQ(automatic.wear[0].tolerance.value(), 0.02);
  EXPECT_FALSE(example().wear[0].tolerance);
  EXPECT_EQ(read(resolved_case(automatic)), automatic);
}

TEST(Acceleration, IsOneForAllPairsAndNeedsSomethingThatTurns) {
  const std::string second = ",\"mild_steel/mild_steel\"={wear_coefficient=1e-13,acceleration=3}}";
  EXPECT_TRUE(contains(complaint_about_example(
                           "wear={\"iron_ore/mild_steel\"={wear_coefficient=1e-11,acceleration=2}" + second),
                       "every wear pair must have the same acceleration"));
  EXPECT_TRUE(contains(complaint(kSmall + std::string("[wear.\"ore/ore\"]\nwear_coefficient = 1e-12\n"
                                                      "acceleration = 2\n")),
                       "acceleration leaves out revolutions, but no wall has a motion"));
}

/// Many particles on a wall at rest.
constexpr const char* kMany = R"(
[insertion.feed]
material = "ore"
number = 10
size = { radius = "1 mm" }
volume = { low = [0, 0, "10 mm"], high = ["20 mm", "20 mm", "30 mm"] }
[wear."ore/ore"]
wear_coefficient = 1e-12
)";

TEST(Acceleration, OfManyParticlesBeginsWhereTheirFlowHasSettled) {
  const std::string many = kSmall + std::string(kMany), settle = "run.settle=";
  EXPECT_EQ(example().run.settle, (simulation::Duration{0.0, false}));
  const CaseSetup settled = read(many + "acceleration = 1000\n", {settle + "1 ms", "run.end=20 s"});
  EXPECT_EQ(settled.run.settle, (simulation::Duration{1e-3, false}));
  EXPECT_EQ(read(resolved_case(settled)), settled);
  EXPECT_TRUE(contains(complaint(many + "acceleration = \"auto\"\n"), "give [run] settle"));
  EXPECT_TRUE(contains(complaint(many, {settle + "2 s", "run.end=2 s"}), "must be before run.end"));
  EXPECT_TRUE(contains(complaint(many, {settle + "1 rev"}), "revolutions cannot be counted"));
  EXPECT_TRUE(contains(complaint(many, {settle + "-1 s"}), "'settle': must be >= 0"));
}

TEST(WearLaws, AreOneOrAList) {
  using simulation::WearLaw;
  const std::string pair = "wear.\"iron_ore/mild_steel\"";
  EXPECT_EQ(example().wear[0].laws, std::vector{WearLaw::archard});
  const CaseSetup several = read(kSmall + std::string(R"([material.steel]
density = 7850
shear_modulus = "78 GPa"
poisson_ratio = 0.3
hardness = "143 HV"
[wear."ore/steel"]
law = ["shear_work", "finnie", "oka", "impact_energy"]
shear_work_coefficient = "0.01 mm^3/J"
finnie_coefficient = "2e-11 1/Pa"
oka_n1 = 0.8
normal_energy_coefficient = "2 mm^3/kJ"
)"));
  const simulation::WearSetup& w = several.wear[0];
  EXPECT_EQ(w.laws,
            (std::vector{WearLaw::shear_work, WearLaw::finnie, WearLaw::oka, WearLaw::impact_energy}));
  EXPECT_DOUBLE_EQ(w.shear_work_coefficient, 1e-11);
  EXPECT_DOUBLE_EQ(w.normal_energy_coefficient, 2e-12);
  EXPECT_EQ(w.oka.n1, 0.8);
  EXPECT_EQ(w.oka.n2, std::nullopt);
  EXPECT_EQ(read(resolved_case(several)), several);

  EXPECT_TRUE(contains(complaint_about_example(pair + ".law=[]"), "is an empty list"));
  EXPECT_TRUE(contains(complaint_about_example(pair + ".law=[\"archard\",\"archard\"]"), "twice"));
  EXPECT_TRUE(contains(complaint_about_example(pair + ".law=finnie"), "finnie_coefficient"));
  EXPECT_TRUE(contains(complaint_about_example(pair + ".law=ocka"), "did you mean \"oka\""));
  EXPECT_TRUE(contains(complaint(kSmall + std::string("[wear.\"ore/ore\"]\nlaw = \"oka\"\n")),
                       "Oka's law needs the hardness of 'ore'"));
  EXPECT_TRUE(contains(complaint(kSmall + std::string("[wear.\"ore/ore\"]\nlaw = \"impact_energy\"\n")),
                       "needs a normal_energy_coefficient"));
}

TEST(Combination, APairMayBeGivenOnlyOnce) {
  const std::string text = std::string(R"(schema = 1
[material.a]
density = 1000
shear_modulus = 1e8
poisson_ratio = 0.3
[material.b]
density = 1000
shear_modulus = 1e8
poisson_ratio = 0.3
[contact."a/b"]
restitution = 0.4
static_friction = 1
[contact."b/a"]
restitution = 0.4
static_friction = 1
[wall.w]
material = "a"
mesh = { shape = "plane" }
[particle.p]
material = "b"
radius = 0.1
position = [0, 0, 1]
[run]
end = 1
)");
  EXPECT_TRUE(
      contains(complaint(text), "case.toml:13:10: error: this pair is already given as [contact.\"a/b\"]"));
}

TEST(Combination, FreeParticlesNeedAPairAmongThemselves) {
  const std::string second =
      "[material.glass]\ndensity = 2500\nshear_modulus = 1e9\npoisson_ratio = 0.2\n"
      "[contact.\"glass/ore\"]\nrestitution = 0.5\nstatic_friction = 0.1\n"
      "[particle.b]\nmaterial = \"glass\"\nradius = 0.001\nposition = [1, 0, 1]\n"
      "[particle.c]\nmaterial = \"glass\"\nradius = 0.001\nposition = [2, 0, 1]\n";
  EXPECT_TRUE(contains(complaint(kSmall + second), "particles 'b' and 'c' can touch"));
}

TEST(Combination, TheDeformationRulePaperMovesNodesAtEveryStep) {
  const std::vector<std::string> overrides{"wall.disc.deformation=paper", "wall.disc.deform_every=2"};
  EXPECT_THROW(static_cast<void>(example(overrides)), CaseError);
  EXPECT_NO_THROW(static_cast<void>(example({"wall.disc.deformation=paper"})));
}

TEST(Combination, QuasiStaticNeedsAGuidedLoadedParticleAndAMovingWall) {
  const auto complaint_of = [](std::vector<std::string> overrides) -> std::string {
    overrides.emplace_back("run.method=quasi_static");
    try {
      static_cast<void>(example(overrides));
      return {};
    } catch (const CaseError& error) {
      return error.what();
    }
  };
  EXPECT_EQ(complaint_of({}), "");
  EXPECT_TRUE(contains(complaint_of({"particle.pin.guide=none"}), "'pin' is free; set guide = \"vertical\""));
  EXPECT_TRUE(contains(complaint_of({"particle.pin.load=0"}), "needs a load that presses 'pin' down"));
  EXPECT_TRUE(contains(complaint_of({"particle.pin.load=[0,0,5]"}), "needs a load that presses 'pin' down"));
  EXPECT_TRUE(contains(complaint_of({"wall.disc.motion.kind=none", "run.end=2 s", "output.every=1 s"}),
                       "counts only where"));
  EXPECT_TRUE(contains(complaint_of({"wall.disc.motion={kind=\"none\"}", "run.end=2 s", "output.every=1 s"}),
                       "no wall moves"));
}

TEST(Combination, NotesWhatIsAllowedButProbablyNotMeant) {
  const auto notes = [](const std::vector<std::string>& overrides) {
    std::string all;
    for (const std::string& note : load_case(kExample, overrides).notes) all += note;
    return all;
  };
  EXPECT_EQ(notes({}), "");
  EXPECT_TRUE(contains(notes({"wall.disc.deformation=none"}),
                       "note: wear is counted, but no wall changes its shape"));
  EXPECT_TRUE(contains(notes({"particle.pin.load=0"}), "nothing presses 'pin' down"));
  EXPECT_TRUE(
      contains(notes({"particle.pin.load=\"20 kN\""}),
               "the load would press 'pin' 10.28 mm deep into the wall, more than a tenth of its radius"));
  EXPECT_TRUE(contains(notes({"material.iron_ore.shear_modulus=0.1"}), "check the load (N)"));
  EXPECT_TRUE(contains(notes({"output.every=20 rev"}), "longer than the run"));
  EXPECT_TRUE(contains(notes({"run.increment=50 um"}), "counts only with method = \"quasi_static\""));
}

struct Slip {
  const char* change;    ///< of the example
  const char* question;  ///< a part of what is asked
  const char* meant;     ///< the same in its unit: nothing is asked
  bool refused = false;
};

class UnitSlip : public testing::TestWithParam<Slip> {};

TEST_P(UnitSlip, IsAskedAboutInWords) {
  const Slip& slip = GetParam();
  const auto said = [](const char* change) -> std::pair<std::string, bool> {
    try {
      std::string all;
      for (const std::string& note : load_case(kExample, std::vector<std::string>{change}).notes) all += note;
      return {all, false};
    } catch (const InputError& error) {
      return {error.what(), true};
    }
  };
  const auto [text, refused] = said(slip.change);
  EXPECT_TRUE(contains(text, slip.question)) << text;
  EXPECT_EQ(refused, slip.refused);
  EXPECT_EQ(said(slip.meant), (std::pair<std::string, bool>{}));
}

INSTANTIATE_TEST_SUITE_P(
    All, UnitSlip,
    testing::Values(
        Slip{"material.mild_steel.density=7.932",
             "at 99.2 km/s, faster than through diamond (12.8 km/s): is the density, 7.932 kg/m^3, in g/cm^3 "
             "(\"7.932 g/cm^3\")?",
             "material.mild_steel.density=\"7.932 g/cm^3\"", true},
        Slip{"material.iron_ore.density=4.85", "less than foam: is it in g/cm^3? Then write \"4.85 g/cm^3\"",
             "material.iron_ore.density=\"4.85 g/cm^3\""},
        Slip{"material.iron_ore.density=4850000", "more than any element",
             "material.iron_ore.density=\"4850000 g/m^3\""},
        Slip{"material.mild_steel.shear_modulus=78", "less than jelly: is it in GPa? Then write \"78 GPa\"",
             "material.mild_steel.shear_modulus=\"78 GPa\""},
        Slip{"material.mild_steel.hardness=143", "is it in HV? Then write \"143 HV\"",
             "material.mild_steel.hardness=\"143 HV\""},
        Slip{"wear.\"iron_ore/mild_steel\".wear_coefficient=0.001", "is this the dimensionless k",
             "wear.\"iron_ore/mild_steel\".wear_coefficient=\"5e-11 1/Pa\""},
        Slip{"wall.disc.motion.rate=180",
             "rate = 180 is in rad/s, 28.6 turns per second: is it in degrees? Write \"180 deg/s\"",
             "wall.disc.motion.rate=\"180 rad/s\""},
        Slip{"wall.disc.motion.rate=\"18000 rad/s\"", "wall 'disc' moves at 396 m/s where a particle is",
             "wall.disc.motion.rate=\"18000 deg/s\""},
        Slip{"wall.disc.motion={ kind=\"oscillation\", amplitude=[1.5, 0, 0], frequency=\"1 Hz\" }",
             "goes 1.5 m to and fro", "wall.disc.motion.rate=\"180 deg/s\""},
        Slip{"run.gravity=[0, 0, -9810]", "gravity is 9810 m/s^2, 1e+03 times the Earth's: is it in mm/s^2?",
             "run.gravity=[0, 0, \"-9810 mm/s^2\"]"},
        Slip{"particle.pin.load=500",
             "is pressed with 500 N, 17.7 N on each mm^2 of its cross-section: is the load in grams? Then "
             "write "
             "\"4.903 N\"",
             "particle.pin.load=\"4.903 N\""},
        Slip{"particle.pin.load=\"500 g\"", "a mass, and a load is a force: its weight is 4.903325 N",
             "particle.pin.load=\"4.903 N\"", true},
        Slip{"ploughing={ removed_fraction=0.6, ridge_angle=10 }",
             "a bare number is in rad: was \"10 deg\" meant?",
             "ploughing={ removed_fraction=0.6, ridge_angle=\"10 deg\" }", true},
        Slip{"particle.pin.radius=3", "a bare number is in metres: was \"3 mm\" meant?",
             "particle.pin.radius=\"3 mm\"", true},
        Slip{"wall.disc.mesh={ shape=\"annulus\", inner=20, outer=24, size=0.1 }",
             "wall 'disc' is 48 m wide and 'pin' has a radius of 3 mm: is the wall given in millimetres?",
             "wall.disc.mesh.size=\"0.1 mm\"", true}));

TEST(UnitSlip, OfAFreeSphereIsAQuestion) {
  const std::string floor =
      std::string(kSmall).replace(std::string(kSmall).find("{ shape = \"plane\" }"), 19,
                                  "{ shape = \"plate\", length = 48, width = 48, size = 1 }");
  const auto notes = [&](const std::vector<std::string>& overrides) {
    std::string all;
    for (const std::string& note : parse_case(floor, "case.toml", "/", overrides).notes) all += note;
    return all;
  };
  EXPECT_TRUE(
      contains(notes({}), "is 48 m wide and 'ball' has a radius of 3 mm: is the wall given in millimetres"));
  EXPECT_EQ(notes({"particle.ball.radius=\"300 mm\"", "particle.ball.position=[0, 0, 1]"}), "");
  EXPECT_TRUE(contains(notes({"particle.ball.velocity=[0, 0, -300]", "particle.ball.radius=0.3",
                              "particle.ball.position=[0, 0, 1]"}),
                       "'ball' starts at 300 m/s: is its velocity in mm/s?"));
}

}  // namespace
}  // namespace abradem::io
