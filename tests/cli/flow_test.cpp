// SPDX-License-Identifier: BSD-3-Clause
// Mean velocities along a line, from the frames of a run.
#include <gtest/gtest.h>

#include <cmath>

#include "abradem/io/csv.h"
#include "cli/program.h"
#include "support/case_texts.h"
#include "support/says.h"

namespace abradem::test {
namespace {

/// Four grains that fly without forces, each in a bin of its own or beside the line.
void run_flight(const std::filesystem::path& folder) {
  write_file(folder / "places.csv",
             "x_mm,y_mm,z_mm,radius_mm,velocity_x_m_per_s,velocity_y_m_per_s,velocity_z_m_per_s\n"
             "0,0,1,0.5,0.1,0,0\n0,8,3,0.5,0.3,0,0\n0.5,-8,3,0.5,0.1,0.04,0\n-9,0,3,0.5,0,9,0\n");
  write_file(folder / "flight.toml", std::string(kGlass) + R"([wall.floor]
material = "glass"
mesh = { shape = "plane", position = [0, 0, "-50 mm"] }
[insertion.some]
material = "glass"
volume = { shape = "file", file = "places.csv" }
[run]
end = "4 ms"
[output]
every = "1 ms"
)");
  const Outcome run = run_program("run flight.toml -o out --quiet --no-report", folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
}

TEST(Flow, IsTheMeanOfTheFramesAskedFor) {
  const ScratchFolder scratch;
  run_flight(scratch.path());
  const std::string line = "flow out --from '0,0,0 mm' --to '0, 0, 6 mm' --bins 3 --reach '2 mm'";
  const Outcome flow = run_program(
      line + " --average-along 0,1,0 --component 3,4,0 --begin '2 ms' -o flow.csv", scratch.path());
  ASSERT_EQ(flow.exit_code, 0) << flow.err;
  EXPECT_EQ(flow.err, "3 frames\n");
  EXPECT_NE(flow.out.find("component_m_per_s"), std::string::npos);
  const io::CsvTable table = io::read_csv(scratch.path() / "flow.csv");
  ASSERT_EQ(table.rows(), 3u);
  EXPECT_DOUBLE_EQ(table.column("z_mm")[1], 3.0);
  EXPECT_DOUBLE_EQ(table.column("particles")[1], 2.0);
  EXPECT_NEAR(table.column("velocity_x_m_per_s")[0], 0.1, 1e-12);
  EXPECT_NEAR(table.column("velocity_x_m_per_s")[1], 0.2, 1e-12);
  EXPECT_NEAR(table.column("velocity_y_m_per_s")[1], 0.02, 1e-12);
  EXPECT_NEAR(table.column("component_m_per_s")[1], 0.6 * 0.2 + 0.8 * 0.02, 1e-12);
  EXPECT_NEAR(table.column("fluctuation_m_per_s")[1], std::sqrt((0.01 + 0.0004) / 3.0), 1e-12);
  EXPECT_TRUE(std::isnan(table.column("velocity_x_m_per_s")[2]));
  // Without a direction to average along, what lies 8 mm beside the line does not count.
  ASSERT_EQ(run_program(line + " -o near.csv --quiet", scratch.path()).exit_code, 0);
  EXPECT_DOUBLE_EQ(io::read_csv(scratch.path() / "near.csv").column("particles")[1], 0.0);
}

/// The page draws what the table has, and measured points beside it; a table of flow itself is one.
TEST(Flow, DrawsAPageWithMeasuredPoints) {
  const ScratchFolder scratch;
  run_flight(scratch.path());
  const std::string line =
      "flow out --from '0,0,0 mm' --to '0, 0, 6 mm' --bins 3 --reach '2 mm' --average-along 0,1,0 ";
  write_file(scratch.path() / "points.csv", "# seen\ndistance [mm];component [mm/s]\n1;120\n3;150\n");
  const Outcome flow = run_program(
      line + "--component 3,4,0 -o flow.csv --page flow.html --measured points.csv", scratch.path());
  ASSERT_EQ(flow.exit_code, 0) << flow.err;
  EXPECT_TRUE(contains(flow.err, "page: flow.html"));
  const std::string page = read_file(scratch.path() / "flow.html");
  EXPECT_TRUE(says(page, {"fig-flow-velocity", "fig-flow-particles", "no further from it than 2 mm",
                          "over 5 frames from 0 to 0.004 s", "in the direction (3,4,0) [m/s]"}));
  const Outcome again = run_program(line + "--page again.html --measured flow.csv --quiet", scratch.path());
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(again.err, "");
  const auto refused = [&](const std::string& options, int code, const std::string& words) {
    const Outcome out = run_program(line + options, scratch.path());
    EXPECT_EQ(out.exit_code, code) << options;
    EXPECT_TRUE(contains(out.err, words));
  };
  refused("--measured points.csv", 2, "--page");
  refused("--page p.html --measured points.csv", 2, "no column velocity_x, velocity_y or velocity_z");
  refused("--page p.html --measured none.csv", 5, "none.csv");
  EXPECT_FALSE(std::filesystem::exists(scratch.path() / "p.html"));
}

TEST(Flow, SaysWhatItCannotUse) {
  const ScratchFolder scratch;
  run_flight(scratch.path());
  const auto refused = [&](const std::string& options, int code, const std::string& words) {
    const Outcome flow = run_program("flow " + options, scratch.path());
    EXPECT_EQ(flow.exit_code, code) << options;
    EXPECT_NE(flow.err.find(words), std::string::npos) << flow.err;
  };
  const std::string to = " --to '0,0,6 mm' --reach '2 mm'";
  refused("out --from '0,0 mm'" + to, 2, "--from 0,0 mm: expected three numbers with commas and a unit");
  refused("out --from '0,0,0'" + to, 2, "expected a length");
  refused("out --from '0,0,6 mm'" + to, 2, "two ends that differ");
  refused("out --from '0,0,0 mm' --begin '1 s'" + to, 2, "none of its 5 frames with particles");
  refused("out --from '0,0,0 mm' --average-along 0,0,1" + to, 2, "at right angles to the line");
  refused("nowhere --from '0,0,0 mm'" + to, 5, "series.pvd");
}

}  // namespace
}  // namespace abradem::test
