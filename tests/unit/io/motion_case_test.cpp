// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/case_motions.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <numbers>

#include "abradem/core/error.h"
#include "abradem/io/case_file.h"

namespace abradem::io {
namespace {

using simulation::MotionKind;

constexpr auto kHead = R"(schema = 1
[material.steel]
density = 7932
shear_modulus = "78 GPa"
poisson_ratio = 0.3
[contact."steel/steel"]
restitution = 0.4
static_friction = 0.3
[particle.ball]
material = "steel"
radius = "3 mm"
position = [0, 0, "20 mm"]
[run]
end = "1 s"
time_step = "1e-5 s"
[wall.floor]
material = "steel"
mesh = { shape = "plate", length = "60 mm", width = "60 mm", size = "10 mm" }
)";

class MotionCase : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("abradem_motion_case_" + std::to_string(::testing::UnitTest::GetInstance()->random_seed()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] simulation::Setup read(const std::string& motion) const {
    return parse_case(kHead + motion, "case.toml", folder_).setup;
  }
  [[nodiscard]] std::string refusal(const std::string& motion) const {
    try {
      static_cast<void>(read(motion));
    } catch (const InputError& e) {
      return e.what();
    }
    return "accepted";
  }
  void write(const std::string& text) const { std::ofstream(folder_ / "ride.csv") << text; }

  std::filesystem::path folder_;
};

void expect_in(const std::string& message, std::string_view part) {
  EXPECT_NE(message.find(part), std::string::npos) << message;
}

TEST_F(MotionCase, AListCarriesOneMotionByTheNext) {
  const simulation::Setup setup = read(R"([[wall.floor.motion]]
kind = "rotation"
rate = "90 deg/s"
[[wall.floor.motion]]
kind = "table"
axis = [0, 1, 0]
center = [0, 0, "5 mm"]
after = "repeat"
rows = [
  { time = "0 s" },
  { time = "0.5 s", displacement = [0, 0, "2 mm"], angle = "5 deg" },
  { time = "1 s" },
]
[[wall.floor.motion]]
kind = "oscillation"
amplitude = [0, 0, "1 mm"]
frequency = "25 Hz"
)");
  const simulation::WallSetup& wall = setup.walls[0];
  ASSERT_EQ(wall.motions(), 3U);
  EXPECT_EQ(wall.motion.kind, MotionKind::rotation);
  ASSERT_EQ(wall.carried_by[0].rows.size(), 3U);
  EXPECT_DOUBLE_EQ(wall.carried_by[0].rows[1].displacement.z, 2e-3);
  EXPECT_DOUBLE_EQ(wall.carried_by[0].rows[1].angle, 5.0 * std::numbers::pi / 180.0);
  EXPECT_EQ(wall.carried_by[1].kind, MotionKind::oscillation);
  // What is resolved reads back the same, also where one motion stands alone.
  EXPECT_EQ(parse_case(resolved_case(setup), "resolved", folder_).setup, setup);
  const simulation::Setup one = read("motion = [{ surface_velocity = [1, 0, 0] }]\n");
  EXPECT_EQ(one.walls[0].motions(), 1U);
  EXPECT_EQ(parse_case(resolved_case(one), "resolved", folder_).setup, one);
  const simulation::Setup belt = read(
      "motion = [{ surface_velocity = [1, 0, 0] }, { kind = \"oscillation\", amplitude = [0, 0, 0.001], "
      "frequency = 50 }]\n");
  EXPECT_EQ(parse_case(resolved_case(belt), "resolved", folder_).setup, belt);
}

TEST_F(MotionCase, ReadsTheTableOfAFile) {
  write("time_s,z_mm,angle_deg\n0,0,0\n0.25,10,90\n1,0,360\n");
  simulation::Setup setup = read("motion = { kind = \"table\", file = \"ride.csv\" }\n");
  EXPECT_EQ(parse_case(resolved_case(setup), "resolved", folder_).setup, setup);
  read_motion_files(setup);
  const auto& rows = setup.walls[0].motion.rows;
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_DOUBLE_EQ(rows[1].time, 0.25);
  EXPECT_DOUBLE_EQ(rows[1].displacement.z, 0.01);
  EXPECT_DOUBLE_EQ(rows[1].angle, 0.5 * std::numbers::pi);
}

TEST_F(MotionCase, SaysWhatIsWrongWithAFileAndWhere) {
  const std::string motion = "motion = { kind = \"table\", file = \"ride.csv\" }\n";
  expect_in(refusal(motion), "no such file");
  write("time_s,z_mm\n0,0\n1,1\n0.5,2\n");
  expect_in(refusal(motion), "ride.csv:4: the times must ascend: 0.5 s comes after 1 s");
  expect_in(refusal(motion), "case.toml:19:35: error");  // the place of the file's name
  write("time_s,z\n0,0\n");
  expect_in(refusal(motion), "ride.csv:1:8: column 'z' has no unit; write a length");
  write("time_s,w_mm\n0,0\n");
  expect_in(refusal(motion), "ride.csv: column 2 is 'w_mm'; a table of a motion has time_s, x_mm");
  write("time_s,z_mm\n0,abc\n");
  expect_in(refusal(motion), "ride.csv:2:3: column 'z_mm': 'abc' is not a number");
  write("z_mm\n0\n");
  expect_in(refusal(motion), "there is no column time_s");
  write("time_s,z_mm\n");
  expect_in(refusal(motion), "the table has no rows");
  write("time_s,z_mm\n0,0\n1,5\n");
  expect_in(refusal("motion = { kind = \"table\", file = \"ride.csv\", after = \"repeat\" }\n"),
            "must end where it began (or whole turns on): the last row is 5 mm");
}

TEST_F(MotionCase, SaysWhatIsWrongWithMotionsOfTheCase) {
  expect_in(refusal("motion = { kind = \"table\" }\n"), "needs rows, such as");
  expect_in(refusal("motion = { kind = \"table\", rows = [{ time = 0 }, { time = \"2 mm\" }] }\n"),
            "'time': expected a time");
  const std::string late = refusal("motion = { kind = \"table\", rows = [{ time = 1 }, { time = 1 }] }\n");
  expect_in(late, "the times must ascend: 1 s comes after 1 s");
  expect_in(late, "case.toml:19:50: error");  // the second row
  expect_in(refusal("motion = { rows = [{ time = 1 }] }\n"), "rows count only where kind = table");
  write("time_s,z_mm\n0,0\n");
  expect_in(refusal("motion = { kind = \"table\", file = \"ride.csv\", rows = [{ time = 1 }] }\n"),
            "not from both");
  expect_in(refusal("motion = [{ kind = \"rotation\", rate = 1 }, { surface_velocity = [1, 0, 0] }]\n"),
            "give surface_velocity in the first motion of the list");
  expect_in(refusal("motion = [{ kind = \"rotation\", rate = 1 }, { kind = \"rotation\" }]\n"),
            "missing key 'rate' in [wall.floor.motion[2]]");
  expect_in(refusal("motion = 3\n"), "a table or a list of tables");
  expect_in(refusal("motion = []\n"), "a table or a list of tables");
}

TEST_F(MotionCase, AWallThatBeginsElsewhereIsNotJudgedByWhereItWasPut) {
  const std::string motion =
      "motion = { kind = \"table\", rows = [{ time = 0, displacement = [0, 0, \"-40 mm\"] }] }\n";
  // Where it was put the ball would start inside it.
  EXPECT_NO_THROW(
      static_cast<void>(parse_case(kHead + motion, "case.toml", folder_,
                                   std::vector<std::string>{"wall.floor.mesh.position=[0,0,0.02]"})));
  EXPECT_THROW(static_cast<void>(parse_case(kHead, "case.toml", folder_,
                                            std::vector<std::string>{"wall.floor.mesh.position=[0,0,0.02]"})),
               InputError);
}

TEST_F(MotionCase, AskWhetherATableIsInAnotherUnit) {
  const auto notes = [&](const std::string& rows) {
    const Case read =
        parse_case(kHead + ("motion = { kind = \"table\", rows = [" + rows + "] }\n"), "case.toml", folder_);
    return read.notes.empty() ? std::string() : read.notes[0];
  };
  EXPECT_EQ(notes("{ time = 0 }, { time = 1, displacement = [0, 0, 0.1] }"), "");
  expect_in(notes("{ time = 0 }, { time = 1, displacement = [0, 0, 500] }"),
            "moves at 500 m/s where a particle");
}

}  // namespace
}  // namespace abradem::io
