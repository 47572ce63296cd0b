// SPDX-License-Identifier: BSD-3-Clause
// Particles in numbers in a case file.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include "abradem/core/error.h"
#include "abradem/io/case_file.h"
#include "abradem/io/insertion_files.h"
#include "abradem/simulation/clumps.h"

namespace abradem::io {
namespace {

constexpr const char* kHead = R"(schema = 1
[material.glass]
density = 2500
shear_modulus = "0.1 GPa"
poisson_ratio = 0.25
[material.steel]
density = 7900
shear_modulus = "78 GPa"
poisson_ratio = 0.3
[contact."glass/steel"]
restitution = 0.5
static_friction = 0.4
[wall.floor]
material = "steel"
mesh = { shape = "plane" }
[run]
end = "1 s"
)";
constexpr const char* kPair = R"([contact."glass/glass"]
restitution = 0.5
static_friction = 0.5
)";
constexpr const char* kFeed = R"([insertion.feed]
material = "glass"
number = 500
mass_rate = "0.5 kg/s"
size = { kind = "normal", mean = "3 mm", sd = "0.3 mm", low = "2 mm", high = "4 mm" }
volume = { shape = "cylinder", base = [0, 0, "10 mm"], top = [0, 0, "60 mm"], radius = "40 mm" }
[domain]
low = [-1, -1, -1]
high = [1, 1, 1]
outside = "stop"
)";

simulation::Setup read(const std::string& text, const std::filesystem::path& folder = {}) {
  return parse_case(text, "case.toml", folder, {}).setup;
}

std::string refusal(const std::string& text) {
  try {
    static_cast<void>(read(text));
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

TEST(InsertionCase, IsReadInSiAndWrittenBack) {
  const simulation::Setup setup = read(std::string(kHead) + kPair + kFeed);
  ASSERT_EQ(setup.insertions.size(), 1u);
  const simulation::InsertionSetup& feed = setup.insertions[0];
  EXPECT_EQ(feed.name, "feed");
  EXPECT_EQ(feed.number, 500u);
  EXPECT_DOUBLE_EQ(*feed.mass_rate, 0.5);
  EXPECT_EQ(feed.size.kind, simulation::SizeKind::normal);
  EXPECT_DOUBLE_EQ(feed.size.sd, 0.3e-3);
  EXPECT_EQ(feed.volume.shape, simulation::VolumeShape::cylinder);
  EXPECT_DOUBLE_EQ(feed.volume.top.z, 0.06);
  EXPECT_EQ(setup.domain->outside, simulation::Outside::stop);
  EXPECT_EQ(read(resolved_case(setup)), setup);
}

TEST(InsertionCase, NamesTheMissingPair) {
  EXPECT_NE(refusal(std::string(kHead) + kFeed).find("add [contact.\"glass/glass\"]"), std::string::npos);
}

TEST(InsertionCase, RefusesWhatCannotBe) {
  const std::string head = std::string(kHead) + kPair;
  EXPECT_NE(refusal(head).find("the case has no particles"), std::string::npos);
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string feed = kFeed;
    feed.replace(feed.find(from), from.size(), to);
    return refusal(head + feed);
  };
  EXPECT_NE(with("number = 500", "").find("needs a number or a mass"), std::string::npos);
  EXPECT_NE(with("number = 500", "number = 500\nmass = \"1 kg\"").find("both a number and a mass"),
            std::string::npos);
  EXPECT_NE(with("\"40 mm\"", "\"2 mm\"").find("too small for one sphere of 4 mm radius"), std::string::npos);
  EXPECT_NE(with("mean = \"3 mm\"", "mean = \"5 mm\"").find("must lie between low and high"),
            std::string::npos);
  EXPECT_NE(with("high = [1, 1, 1]", "high = [1, -2, 1]").find("must be above that of low"),
            std::string::npos);
}

struct Slip {
  const char* said;   ///< in the case
  const char* wrong;  ///< instead of it
  const char* asked;  ///< a part of the question
};

class InsertionUnitSlip : public testing::TestWithParam<Slip> {};

TEST_P(InsertionUnitSlip, IsAskedAboutInWords) {
  const Slip& slip = GetParam();
  std::string text =
      std::string(kHead) + kPair + kFeed + "[wall.tray]\nmaterial = \"steel\"\n" +
      "mesh = { shape = \"plate\", length = 0.4, width = 0.4, size = 0.1, position = [0, 0, -0.01] }\n";
  const auto notes = [&] {
    std::string all;
    for (const std::string& note : parse_case(text, "case.toml", {}, {}).notes) all += note;
    return all;
  };
  EXPECT_EQ(notes(), "");
  const std::size_t at = text.find(slip.said);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, std::string(slip.said).size(), slip.wrong);
  const std::string asked = notes();
  EXPECT_NE(asked.find(slip.asked), std::string::npos) << asked;
}

INSTANTIATE_TEST_SUITE_P(
    All, InsertionUnitSlip,
    testing::Values(
        Slip{"density = 2500", "density = 2.5", "less than foam: is it in g/cm^3? Then write \"2.5 g/cm^3\""},
        Slip{"mass_rate = \"0.5 kg/s\"", "mass_rate = 500",
             "mass_rate = 500 kg/s of 'feed' is 211 times what can fall out of its volume"},
        Slip{"mass_rate = \"0.5 kg/s\"", "mass_rate = \"0.5 mg/s\"",
             "less than one of its largest particles, 0.00067 kg: is it in another unit?"},
        Slip{"number = 500\nmass_rate = \"0.5 kg/s\"", "mass = 900",
             "mass = 900 kg of 'feed' is 1.43e+03 times what its volume of 0.0002513 m^3 would hold"},
        Slip{"number = 500\nmass_rate = \"0.5 kg/s\"", "mass = \"0.5 g\"",
             "mass = 0.0005 kg of 'feed' is less than one of its largest particles, 0.0006702 kg"},
        Slip{"{ kind = \"normal\", mean = \"3 mm\", sd = \"0.3 mm\", low = \"2 mm\", high = \"4 mm\" }",
             "{ radius = \"3 um\" }",
             "'feed' has particles of at most 0.003 mm radius in a volume of 0.0002513 m^3"},
        Slip{"{ kind = \"normal\", mean = \"3 mm\", sd = \"0.3 mm\", low = \"2 mm\", high = \"4 mm\" }",
             "{ radius = \"30 um\" }", "wall 'tray' is 400 mm wide and 'feed' has a radius of"},
        Slip{"number = 500", "number = 500\nvelocity = [0, 0, -500]",
             "particles of 'feed' start at 500 m/s: is their velocity in mm/s?"},
        Slip{"number = 500", "number = 500\nspin = [0, 50000, 0]",
             "the surface of particles of 'feed' moves at 200 m/s by their spin"}));

/// Sizes in millimetres read as metres cannot lie in the volume: refused.
TEST(InsertionCase, RefusesSizesInMillimetresReadAsMetres) {
  std::string text = std::string(kHead) + kPair + kFeed;
  const std::string size =
      "{ kind = \"normal\", mean = \"3 mm\", sd = \"0.3 mm\", low = \"2 mm\", high = \"4 mm\" }";
  text.replace(text.find(size), size.size(), "{ radius = 3 }");
  EXPECT_NE(
      refusal(text).find("is too small for one sphere of 3000 mm radius: are the sizes in millimetres?"),
      std::string::npos)
      << refusal(text);
}

TEST(InsertionCase, ReadsPlacesAndSizesFromFiles) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "abradem_insertion_case";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "places.csv") << "x_mm,y_mm,z_mm,radius_mm\n1,2,30,3\n-10,2,30,2.5\n";
  std::ofstream(folder / "sizes.csv") << "radius_mm,share\n1,3\n2,1\n";
  const std::string head = std::string(kHead) + kPair;
  simulation::Setup setup = read(head + R"([insertion.placed]
material = "glass"
volume = { shape = "file", file = "places.csv" }
velocity = [0, 0, -1]
spin = [0, "60 rpm", "180 deg/s"]
[insertion.drawn]
material = "glass"
number = 3
size = { kind = "table", file = "sizes.csv" }
volume = { low = [0, 0, 1], high = [1, 1, 2] }
)",
                                 folder);
  read_insertion_files(setup);
  ASSERT_EQ(setup.insertions[0].placed.size(), 2u);
  EXPECT_DOUBLE_EQ(setup.insertions[0].placed[1].position.x, -0.01);
  EXPECT_DOUBLE_EQ(setup.insertions[0].placed[1].radius, 2.5e-3);
  EXPECT_DOUBLE_EQ(setup.insertions[0].placed[1].velocity.z, -1.0);
  EXPECT_DOUBLE_EQ(setup.insertions[0].placed[1].spin.y, 2.0 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(setup.insertions[0].placed[1].spin.z, std::numbers::pi);
  EXPECT_EQ(setup.insertions[1].size.shares, (std::vector<double>{3.0, 1.0}));
  // Spins of their own, all three columns or none.
  std::ofstream(folder / "places.csv") << "x_mm,y_mm,z_mm,radius_mm,spin_x_rad_per_s,spin_y_rad_per_s,"
                                          "spin_z_rad_per_s\n1,2,30,3,1,2,3\n-10,2,30,2.5,4,5,6\n";
  read_insertion_files(setup);
  EXPECT_EQ(setup.insertions[0].placed[1].spin, (Vec3{4, 5, 6}));
  EXPECT_DOUBLE_EQ(setup.insertions[0].placed[1].velocity.z, -1.0);
  std::ofstream(folder / "places.csv") << "x_mm,y_mm,z_mm,radius_mm,spin_y_rad_per_s\n1,2,30,3,1\n";
  EXPECT_THROW(read_insertion_files(setup), IoError);
  std::ofstream(folder / "places.csv") << "x_mm,y_mm,z_mm,radius_mm\n1,2,30,0\n";
  EXPECT_THROW(read_insertion_files(setup), IoError);
  // As a spreadsheet writes it: sieves by mass and diameter.
  std::ofstream(folder / "places.csv") << "x_mm,y_mm,z_mm,radius_mm\n1,2,30,3\n";
  std::ofstream(folder / "sizes.csv")
      << "# sieves\r\nDiameter [um];mass share\r\n2000;1\r\n4000;8\r\n9000;0\r\n";
  read_insertion_files(setup);
  EXPECT_EQ(setup.insertions[1].size.radii, (std::vector<double>{1e-3, 2e-3}));
  ASSERT_EQ(setup.insertions[1].size.shares.size(), 2u);
  EXPECT_DOUBLE_EQ(setup.insertions[1].size.shares[1] / setup.insertions[1].size.shares[0], 1.0);
  const auto refused = [&](const char* sizes, const char* words) {
    std::ofstream(folder / "sizes.csv") << sizes;
    try {
      read_insertion_files(setup);
      ADD_FAILURE() << sizes;
    } catch (const IoError& e) {
      EXPECT_NE(std::string(e.what()).find(words), std::string::npos) << e.what();
    }
  };
  refused("radius_mm,share\n1,1\n2,-1\n", "sizes.csv:3:3: share must be >= 0");
  refused("radius_mm,share\n1,0\n", "all shares are 0");
  refused("radius_mm,share\n", "has no rows");
  refused("radius,share\n1,1\n", "has no unit");
  refused("radius_mm\n1\n", "no column 'share'");
  std::filesystem::remove_all(folder);
}

constexpr const char* kPebbles = R"([shape.pebble]
spheres = [{ position = [0, 0, 0], radius = "2 mm" }, { position = ["2 mm", 0, 0], radius = "1.5 mm" }]
[shape.stone]
fit = { file = "stone.stl", unit = "mm", spheres = 8 }
[insertion.pebbles]
material = "glass"
shape = "pebble"
number = 20
volume = { low = [0, 0, 1], high = [1, 1, 2] }
[insertion.stones]
material = "glass"
shape = "stone"
number = 20
size = { kind = "uniform", low = "2 mm", high = "3 mm" }
volume = { low = [0, 0, 2], high = [1, 1, 3] }
)";

TEST(ShapeCase, IsReadAndWrittenBack) {
  const simulation::Setup setup = read(std::string(kHead) + kPair + kPebbles, "/somewhere");
  ASSERT_EQ(setup.shapes.size(), 2u);
  EXPECT_EQ(setup.shapes[0].name, "pebble");
  EXPECT_EQ(setup.shapes[0].spheres,
            (std::vector<geometry::Ball>{{{0, 0, 0}, 2e-3}, {{2e-3, 0, 0}, 1.5e-3}}));
  EXPECT_EQ(setup.shapes[1].fit->file, "/somewhere/stone.stl");
  EXPECT_EQ(setup.shapes[1].fit->unit, 1e-3);
  EXPECT_EQ(setup.shapes[1].fit->count, 8);
  EXPECT_EQ(setup.insertions[0].shape, "pebble");
  EXPECT_EQ(read(resolved_case(setup)), setup);
}

TEST(ShapeCase, RefusesWhatCannotBe) {
  const std::string head = std::string(kHead) + kPair;
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = kPebbles;
    text.replace(text.find(from), from.size(), to);
    return refusal(head + text);
  };
  EXPECT_NE(with("shape = \"pebble\"", "shape = \"peble\"").find("no shape 'peble'; did you mean 'pebble'?"),
            std::string::npos);
  EXPECT_NE(with("spheres = [", "fit = { file = \"a.stl\", unit = \"mm\" }\nspheres = [")
                .find("has both spheres and a fit"),
            std::string::npos);
  EXPECT_NE(with("fit = {", "#").find("needs spheres = [{ position"), std::string::npos);
  EXPECT_NE(with("radius = \"1.5 mm\"", "radius = 0").find("radius"), std::string::npos);
  EXPECT_NE(with("spheres = 8", "spheres = 0").find("1 to 200"), std::string::npos);
  EXPECT_NE(with("spheres = [{ position = [0, 0, 0], radius = \"2 mm\" }, ", "spheres = [3, ")
                .find("'spheres' is a list of tables"),
            std::string::npos);
}

constexpr const char* kRock = R"([shape.pebble]
spheres = [{ position = [0, 0, 0], radius = "2 mm" }, { position = ["2 mm", 0, 0], radius = "1.5 mm" }]
[particle.rock]
material = "glass"
shape = "pebble"
rotation = [0, "90 deg", 0]
position = [0, 0, "10 mm"]
velocity = [0, 0, -1]
spin = ["10 rad/s", 0, 0]
)";

TEST(ShapeCase, GivesANamedParticleItsLooks) {
  const simulation::Setup setup = read(std::string(kHead) + kRock);
  ASSERT_EQ(setup.particles.size(), 1u);
  EXPECT_EQ(setup.particles[0].shape, "pebble");
  EXPECT_DOUBLE_EQ(setup.particles[0].rotation.y, 0.5 * std::numbers::pi);
  EXPECT_EQ(setup.particles[0].radius, 0.0);
  EXPECT_EQ(setup.walls[0].contact, simulation::ContactRule::automatic);
  EXPECT_EQ(read(resolved_case(setup)), setup);
  // As it moves: one particle of an insertion, turned so that the smaller sphere is below.
  const simulation::Setup moves = simulation::clumps_in_numbers(setup);
  EXPECT_TRUE(moves.particles.empty());
  ASSERT_EQ(moves.insertions.size(), 1u);
  EXPECT_EQ(simulation::clumps_in_numbers(moves), moves);
  const simulation::ClumpShape shape = simulation::clump_shape(setup.shapes[0]);
  EXPECT_DOUBLE_EQ(moves.insertions[0].placed[0].radius, shape.radius);
  const auto place = [&](std::size_t k) {
    return shape.radius * moves.insertions[0].turns[0].turn(shape.spheres[k].centre);
  };
  EXPECT_NEAR(norm(place(1) - place(0) - Vec3{0, 0, -2e-3}), 0.0, 1e-15);
}

TEST(ShapeCase, RefusesNamedParticlesThatCannotBe) {
  const auto with = [](const std::string& from, const std::string& to) {
    std::string text = kRock;
    text.replace(text.find(from), from.size(), to);
    return refusal(std::string(kHead) + text);
  };
  EXPECT_NE(with("shape = \"pebble\"", "shape = \"peble\"").find("no shape 'peble'; did you mean 'pebble'?"),
            std::string::npos);
  EXPECT_NE(
      with("spin", "load = 1\nspin").find("'rock' has a shape, and moves freely: a load is for a sphere"),
      std::string::npos);
  EXPECT_NE(with("spin", "guide = \"vertical\"\nspin").find("a guide is for a sphere"), std::string::npos);
  EXPECT_NE(with("shape = \"pebble\"\n", "").find("missing key 'radius' in [particle.rock]"),
            std::string::npos);
  EXPECT_NE(with("shape = \"pebble\"", "radius = 0.001").find("a rotation is for a particle with a shape"),
            std::string::npos);
}

TEST(ShapeCase, FitsSpheresToAClosedMeshAlone) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "abradem_shape_case";
  std::filesystem::create_directories(folder);
  const auto write = [&](std::size_t faces) {
    std::ofstream obj(folder / "stone.obj");
    obj << "v 0 0 0\nv 4 0 0\nv 0 3 0\nv 4 3 0\nv 0 0 2\nv 4 0 2\nv 0 3 2\nv 4 3 2\n";
    const char* face[]{"1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"};
    for (std::size_t k = 0; k < faces; ++k) obj << "f " << face[k] << "\n";
  };
  std::string text = std::string(kHead) + kPair + kPebbles;
  text.replace(text.find("stone.stl"), 9, "stone.obj");
  simulation::Setup setup = read(text, folder);
  write(6);
  read_insertion_files(setup);
  const simulation::ShapeFitSetup& fit = *setup.shapes[1].fit;
  EXPECT_EQ(fit.fit.balls.size(), 8u);
  EXPECT_NEAR(fit.solid.volume, 24e-9, 1e-20);
  EXPECT_NEAR(fit.solid.moments.z, 24e-9 * 25e-6 / 12.0, 1e-24);
  EXPECT_LT(std::abs(fit.fit.volume_error), 1e-3);
  write(5);
  try {
    read_insertion_files(setup);
    FAIL() << "a box without a side";
  } catch (const GeometryError& e) {
    EXPECT_NE(std::string(e.what()).find("shape 'stone': the mesh"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("is not closed (4 open edges"), std::string::npos) << e.what();
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace abradem::io
