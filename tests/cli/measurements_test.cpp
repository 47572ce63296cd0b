// SPDX-License-Identifier: BSD-3-Clause
// Measured data through the real program: a wear law from a table of tests, and profiles.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/program.h"

namespace abradem::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const std::string kTests = ABRADEM_SOURCE_DIR "/cases/data/ptfe-pin-on-disc.csv";

testing::AssertionResult contains(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "'" << part << "' is not in:\n" << text;
}

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

}  // namespace
}  // namespace abradem::test
