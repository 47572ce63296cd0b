// SPDX-License-Identifier: BSD-3-Clause
// The published study through the real program: few revolutions, a coarse mesh, few sections.
#include <gtest/gtest.h>

#include <signal.h>

#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/program.h"

namespace abradem::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const std::string kReduced =
    "run " ABRADEM_SOURCE_DIR
    "/cases/paper/study.toml --set run.method=quasi_static --set run.end='4 rev' --set output.every='1 rev'"
    " --set wall.disc.mesh.inner='21 mm' --set wall.disc.mesh.outer='23 mm' --set wall.disc.mesh.size='0.4 "
    "mm'"
    " --set run.increment='0.2 mm' --set output.contours=72 --threads 2 --quiet -o study";

/// The row of a claim in tables/claims.csv; its cells have no commas that matter here.
std::string claim(const fs::path& folder, const std::string& id) {
  std::istringstream lines(read_file(folder / "study/tables/claims.csv"));
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with(id + ",")) return line;
  return {};
}

TEST(PublishedStudy, MakesEveryFigureAndJudgesEveryClaimThatItsRunsCanAnswer) {
  const ScratchFolder scratch;
  const Outcome outcome = run_program(kReduced, scratch.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json batch = json::parse(read_file(scratch.path() / "study/batch.json"));
  EXPECT_EQ(batch["status"], "completed");
  EXPECT_EQ(batch["failed"], 0);
  const json figures = json::parse(read_file(scratch.path() / "study/tables/figures.json"));
  EXPECT_EQ(figures.size(), 15U);
  for (const json& figure : figures)
    EXPECT_TRUE(fs::exists(scratch.path() / "study/tables" / figure["file"].get<std::string>()));
  EXPECT_GT(fs::file_size(scratch.path() / "study/report.html"), 500'000U);

  // What holds at any mesh and length: coarse meshes make shallow, wide grooves by the paper's rules; the
  // load is carried; Archard's volume is not the published one.
  EXPECT_NE(claim(scratch.path(), "M01").find(",reproduced,"), std::string::npos)
      << claim(scratch.path(), "M01");
  EXPECT_NE(claim(scratch.path(), "N01").find("5.0"), std::string::npos) << claim(scratch.path(), "N01");
  EXPECT_TRUE(claim(scratch.path(), "V17").ends_with(",not reproduced")) << claim(scratch.path(), "V17");
  // What four revolutions cannot answer is said to be so.
  EXPECT_NE(claim(scratch.path(), "C01").find("not run"), std::string::npos) << claim(scratch.path(), "C01");

  // Nothing is made twice.
  const auto made = fs::last_write_time(scratch.path() / "study/runs/calibrated/02/run.json");
  ASSERT_EQ(run_program(kReduced, scratch.path()).exit_code, 0);
  EXPECT_EQ(fs::last_write_time(scratch.path() / "study/runs/calibrated/02/run.json"), made);
}

TEST(PublishedStudy, RefusesADamagedFileOfValues) {
  const ScratchFolder scratch;
  fs::copy(ABRADEM_SOURCE_DIR "/cases/paper/study.toml", scratch.path() / "study.toml");
  write_file(scratch.path() / "claims.json", "{ no json");
  const Outcome outcome = run_program(
      "run study.toml --set run.method=quasi_static --set run.end='0.01 rev' --set output.every='0.01 rev' "
      "--set "
      "output.contours=8 --set wall.disc.mesh.inner='21 mm' --set wall.disc.mesh.outer='23 mm' --set "
      "wall.disc.mesh.size='0.4 mm' --threads 2 --quiet -o out",
      scratch.path());
  EXPECT_EQ(outcome.exit_code, 5);
  EXPECT_NE(outcome.err.find("claims.json: not JSON"), std::string::npos) << outcome.err;
}

const std::string kScaling =
    "run " ABRADEM_SOURCE_DIR
    "/cases/scaling.toml --set run.end='16 rev' --set output.every='1 rev' --set wall.disc.mesh.inner='21 mm'"
    " --set wall.disc.mesh.outer='23 mm' --set output.contours=24"
    " --set 'wear.\"iron_ore/mild_steel\".wear_coefficient=1.7e-11 1/Pa' --threads 2 --quiet -o out";

TEST(ScalingStudy, ComparesRunsOfTheSameWear) {
  const ScratchFolder scratch;
  const Outcome outcome = run_program(
      kScaling + " --set wall.disc.mesh.size='0.3 mm' --set run.increment='0.3 mm'", scratch.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::string table = read_file(scratch.path() / "out/tables/scaling-runs.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 13) << table;
  const json figures = json::parse(read_file(scratch.path() / "out/tables/figures.json"));
  EXPECT_EQ(figures.size(), 3U);
}

/// The hash of the last state of every run.
std::map<std::string, std::string> state_hashes(const fs::path& study) {
  std::map<std::string, std::string> hashes;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(study / "runs"))
    if (entry.path().filename() == "run.json")
      hashes[fs::relative(entry.path(), study)] = json::parse(read_file(entry.path()))["state_hash"];
  return hashes;
}

TEST(ScalingStudy, KilledGoesOnToTheSameRuns) {
  const std::string study = kScaling + " --set wall.disc.mesh.size='0.2 mm' --set run.increment='0.1 mm'";
  const ScratchFolder killed, whole;
  const fs::path first = fs::path("out") / "runs" / "scaling" / "01" / "run.json";
  EXPECT_EQ(break_off(study, killed.path(), first, SIGKILL), 1000 + SIGKILL);
  const auto made = fs::last_write_time(killed.path() / first);
  EXPECT_FALSE(fs::exists(killed.path() / "out/report.html"));
  const Outcome again = run_program(study, killed.path());
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(fs::last_write_time(killed.path() / first), made);
  ASSERT_EQ(run_program(study, whole.path()).exit_code, 0);
  const auto expected = state_hashes(whole.path() / "out");
  EXPECT_EQ(expected.size(), 18U);
  EXPECT_EQ(state_hashes(killed.path() / "out"), expected);
  for (const char* table : {"scaling-profiles.csv", "master-curve.csv", "largest-factor.csv"})
    EXPECT_EQ(read_file(killed.path() / "out/tables" / table),
              read_file(whole.path() / "out/tables" / table));
}

}  // namespace
}  // namespace abradem::test
