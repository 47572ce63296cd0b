// SPDX-License-Identifier: BSD-3-Clause
// Measured data through the real program: a wear law from a table of tests, and profiles.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/program.h"
#include "support/says.h"

namespace abradem::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const std::string kTests = ABRADEM_SOURCE_DIR "/cases/data/ptfe-pin-on-disc.csv";

TEST(CalibrateTests, SaysThatArchardDoesNotHoldForThePublishedTests) {
  const Outcome text = run_program("calibrate " + kTests);
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_TRUE(contains(text.out, "Linear Archard does not hold for M1, M2, M3."));
  EXPECT_TRUE(contains(text.out, "q is not identifiable: all tests slid 5000 m"));
  EXPECT_TRUE(contains(text.out, "p = 1.738 (1.5 to 1.98)"));
  EXPECT_TRUE(contains(text.out, "35.4 % by the power law, 80.7 % by Archard's"));

  const Outcome object = run_program("calibrate " + kTests + " --json --coverage 0.9");
  ASSERT_EQ(object.exit_code, 0) << object.err;
  const json result = json::parse(object.out);
  ASSERT_EQ(result.at("materials").size(), 3U);
  EXPECT_EQ(result.at("materials")[0].at("identifiable"), "p");
  EXPECT_TRUE(result.at("materials")[0].at("q").is_null());
  EXPECT_TRUE(result.at("materials")[0].at("archard").at("rejected"));
  EXPECT_GT(result.at("materials")[0].at("p").at("low"), 1.49);  // narrower than at 95 %
}

TEST(CalibrateTests, WritesAPageAndReplacesItOnlyWhenAsked) {
  const ScratchFolder folder;
  const std::string to = " --quiet -o " + (folder.path() / "law").string();
  const Outcome first = run_program("calibrate " + kTests + to);
  EXPECT_EQ(first.exit_code, 0) << first.err;
  for (const char* file : {"report.html", "calibration.json", "tables/exponents.csv", "tables/prediction.csv",
                           "tables/diagnosis.csv", "tables/predicted.csv", "tables/laws.csv",
                           "tables/residuals.csv", "tables/exponent-intervals.csv"})
    EXPECT_TRUE(fs::exists(folder.path() / "law" / file)) << file;
  EXPECT_EQ(run_program("calibrate " + kTests + to).exit_code, 2);
  EXPECT_EQ(run_program("calibrate " + kTests + to + " --force").exit_code, 0);
}

TEST(CalibrateTests, RefusesWhatBelongsToACaseAndTablesThatAreNone) {
  const Outcome set = run_program("calibrate " + kTests + " --set run.seed=2");
  EXPECT_EQ(set.exit_code, 2);
  EXPECT_TRUE(contains(set.err, "--set belongs to a case; a table of tests has none"));

  const ScratchFolder folder;
  write_file(folder.path() / "t.csv", "force_N,distance_m,volume_mm3\n5,100,1\n5,100\n");
  const Outcome cut = run_program("calibrate t.csv", folder.path());
  EXPECT_EQ(cut.exit_code, 5);
  EXPECT_TRUE(contains(cut.err, "t.csv:3: 2 fields where the header names 3 columns"));
  write_file(folder.path() / "t.csv", "force_N,distance_m,volume_mm3\n5,100,1\n5,100,2\n");
  const Outcome few = run_program("calibrate t.csv", folder.path());
  EXPECT_EQ(few.exit_code, 2);
  EXPECT_TRUE(contains(few.err, "2 tests; a law and its scatter need 3 or more"));
}

/// The run's own sections, read back as measured profiles.
TEST(Analyse, ReadsTheProfilesOfARunAndFindsItsContours) {
  const ScratchFolder folder;
  const Outcome run =
      run_program("run " ABRADEM_SOURCE_DIR
                  "/cases/pin-on-disc.toml --quiet --set run.method=quasi_static --set "
                  "wall.disc.mesh.inner='21 mm' --set wall.disc.mesh.outer='23 mm' --set "
                  "wall.disc.mesh.size='0.2 mm' --set run.end='2 rev' --set output.contours=24 --set "
                  "output.frames=none -o run",
                  folder.path());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Outcome analysis =
      run_program("analyse run/tables/profiles.csv --json --track-radius '22 mm' -o page", folder.path());
  ASSERT_EQ(analysis.exit_code, 0) << analysis.err;
  const json result = json::parse(analysis.out);
  ASSERT_EQ(result.at("sections").size(), 16U);  // eight of each revolution

  std::istringstream contours(read_file(folder.path() / "run/tables/contours.csv"));
  std::string line;
  std::size_t compared = 0;
  std::getline(contours, line);
  while (std::getline(contours, line)) {
    double n, angle, depth, width, area, displaced;
    ASSERT_EQ(
        std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf,%lf", &n, &angle, &depth, &width, &area, &displaced),
        6);
    for (const json& s : result.at("sections")) {
      if (s.at("revolution") != n || std::abs(s.at("angle_deg").get<double>() - angle) > 1e-9) continue;
      EXPECT_NEAR(s.at("depth_mm").get<double>(), depth, 1e-9 * depth);
      EXPECT_NEAR(s.at("width_mm").get<double>(), width, 1e-9 * width);
      EXPECT_NEAR(s.at("displaced_width_mm").get<double>(), displaced, 1e-9 * displaced);
      EXPECT_NEAR(s.at("area_mm2").get<double>(), area, 1e-9 * area);
      ++compared;
    }
  }
  EXPECT_EQ(compared, 16U);
  for (const char* file : {"report.html", "analysis.json", "tables/sections.csv", "tables/profiles.csv",
                           "tables/statistics-normality.csv"})
    EXPECT_TRUE(fs::exists(folder.path() / "page" / file)) << file;
  EXPECT_EQ(run_program("analyse run/tables/profiles.csv -o page", folder.path()).exit_code, 2);

  // What the run itself says of its sections.
  const std::string table = read_file(folder.path() / "run/tables/normality.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 3);
  EXPECT_TRUE(contains(read_file(folder.path() / "run/report.html"), "Statistics of the groove"));
  EXPECT_TRUE(fs::exists(folder.path() / "run/tables/statistics-normality.csv"));
}

TEST(Analyse, LevelsATiltedProfileAndSaysWhatItCannotRead) {
  const ScratchFolder folder;
  std::string text = "x [mm],z [um]\n";
  for (int i = 0; i <= 200; ++i) {
    const double x = 0.01 * i, groove = std::min(0.0, 10.0 * (std::abs(x - 1.0) / 0.5 - 1.0));
    text += std::to_string(x) + "," + std::to_string(groove + 40.0 * x + 3.0) + "\n";
  }
  write_file(folder.path() / "scan.csv", text);
  const Outcome level =
      run_program("analyse scan.csv --level line --shoulder '0.4 mm' --json", folder.path());
  ASSERT_EQ(level.exit_code, 0) << level.err;
  const json section = json::parse(level.out).at("sections")[0];
  EXPECT_NEAR(section.at("depth_mm").get<double>(), 0.01, 1e-7);
  EXPECT_NEAR(section.at("area_mm2").get<double>(), 0.005, 1e-7);
  EXPECT_NEAR(section.at("tilt").get<double>(), 0.04, 1e-9);

  const Outcome shown = run_program("analyse scan.csv scan.csv --level line", folder.path());
  EXPECT_TRUE(contains(shown.out, "Heights are above a straight line through the shoulders"));
  EXPECT_TRUE(contains(shown.out, "median"));

  const Outcome word = run_program("analyse scan.csv --shoulder 3", folder.path());
  EXPECT_EQ(word.exit_code, 2);
  EXPECT_TRUE(contains(word.err, "--shoulder 3: expected a length above 0 with its unit"));
  const Outcome wide = run_program("analyse scan.csv --level line --shoulder '1 mm'", folder.path());
  EXPECT_EQ(wide.exit_code, 2);
  EXPECT_TRUE(contains(wide.err, "scan.csv: shoulders of 1 mm on a section of 2 mm"));
  write_file(folder.path() / "bad.csv", "x_mm,z_um\n0,0\n1,abc\n");
  const Outcome bad = run_program("analyse bad.csv", folder.path());
  EXPECT_EQ(bad.exit_code, 5);
  EXPECT_TRUE(contains(bad.err, "bad.csv:3:3: column 'z_um': 'abc' is not a number"));
  EXPECT_EQ(run_program("analyse none.csv", folder.path()).exit_code, 5);
}

}  // namespace
}  // namespace abradem::test
