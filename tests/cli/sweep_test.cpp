// SPDX-License-Identifier: BSD-3-Clause
// Sweeps through the real program: what comes out, what is run again and what is not, what is left when
// something ends one early.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

#include "cli/program.h"
#include "support/says.h"

namespace abradem::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const std::string kCase = ABRADEM_SOURCE_DIR "/cases/pin-on-disc.toml";
/// Some 10 ms per run.
const std::string kShort =
    " --set run.method=quasi_static --set wall.disc.mesh.inner='21 mm' --set wall.disc.mesh.outer='23 mm'"
    " --set run.end='0.02 rev' --set output.every='0.01 rev' --set output.contours=8 --set "
    "output.frames=none";
const std::string kSizes = " --vary 'wall.disc.mesh.size=0.4 mm,0.5 mm'";
const std::string kAlphas = " --vary 'wear.\"iron_ore/mild_steel\".wear_coefficient=1e-11..3e-11 1/Pa:3'";
const std::string kSweep = "sweep " + kCase + kShort + kSizes + kAlphas;

std::size_t lines(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

std::string summary(const fs::path& folder) { return read_file(folder / "summary.csv"); }
json manifest(const fs::path& folder) { return json::parse(read_file(folder / "batch.json")); }

/// When each run was made: its run.json is written once, at its end.
std::map<std::string, fs::file_time_type> made(const fs::path& folder) {
  std::map<std::string, fs::file_time_type> times;
  for (const fs::directory_entry& run : fs::directory_iterator(folder / "runs"))
    if (fs::exists(run.path() / "run.json"))
      times[run.path().filename()] = fs::last_write_time(run.path() / "run.json");
  return times;
}

// ---- what comes out
// ---------------------------------------------------------------------------------------------------

TEST(Sweep, MakesARunForEveryPointAndOneTable) {
  const ScratchFolder scratch;
  const fs::path folder = scratch.path() / "result";
  const Outcome outcome = run_program(kSweep + " -o result --jobs 2", scratch.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_TRUE(contains(outcome.err, "6 of 6 runs completed"));
  const std::string table = summary(folder);
  EXPECT_EQ(lines(table), 7U);
  EXPECT_TRUE(table.starts_with(
      "name,status,wall.disc.mesh.size [mm],wear.iron_ore/mild_steel.wear_coefficient [1/Pa],revolution,"));
  EXPECT_TRUE(contains(table, "\n0002,completed,0.4,2e-11,0.02,"));
  EXPECT_TRUE(contains(table, "\n0006,completed,0.5,3e-11,0.02,"));
  // The last row of the run's own table, to the last digit.
  const std::string own = read_file(folder / "runs" / "0006" / "tables" / "revolutions.csv");
  const std::string last = own.substr(own.rfind('\n', own.size() - 2) + 1);
  EXPECT_TRUE(contains(table, "\n0006,completed,0.5,3e-11," + last.substr(0, last.size() - 1) + ","));
  const json batch = manifest(folder);
  EXPECT_EQ(batch["status"], "completed");
  EXPECT_EQ(batch["completed"], 6);
  EXPECT_EQ(batch["runs"][5]["folder"], "runs/0006");
  EXPECT_FALSE(fs::exists(folder / "runs" / "0001" / "report.html"));
  EXPECT_TRUE(contains(read_file(folder / "report.html"), "Main effects"));
  EXPECT_EQ(json::parse(read_file(folder / "runs" / "0001" / "run.json"))["threads"], 1);
  EXPECT_EQ(run_program("report result/runs/0001", scratch.path()).exit_code, 0);
}

TEST(Sweep, GivesTheSameTableWhateverTheNumberOfJobs) {
  const ScratchFolder scratch;
  ASSERT_EQ(run_program(kSweep + " -o one --jobs 1 --quiet", scratch.path()).exit_code, 0);
  const Outcome eight = run_program(kSweep + " -o eight --jobs 8 --quiet --json", scratch.path());
  ASSERT_EQ(eight.exit_code, 0);
  EXPECT_EQ(eight.err, "");
  EXPECT_EQ(summary(scratch.path() / "one"), summary(scratch.path() / "eight"));
  EXPECT_EQ(json::parse(eight.out), manifest(scratch.path() / "eight"));
}

TEST(Sweep, RunsOneCaseAtATimeForJobArrays) {
  const ScratchFolder scratch;
  ASSERT_EQ(run_program(kSweep + " -o whole --quiet", scratch.path()).exit_code, 0);
  for (int k = 6; k >= 1; --k) {
    const Outcome one =
        run_program(kSweep + " -o parts --quiet --json --case " + std::to_string(k), scratch.path());
    EXPECT_EQ(one.exit_code, 0) << one.err;
    EXPECT_EQ(json::parse(one.out)["status"], "completed");
    EXPECT_EQ(made(scratch.path() / "parts").size(), static_cast<std::size_t>(7 - k));
    if (k == 4) {
      const Outcome early = run_program(kSweep + " -o parts --collect", scratch.path());
      EXPECT_EQ(early.exit_code, 0);
      EXPECT_TRUE(contains(early.err, "warning: 3 of 6 runs are not done"));
      EXPECT_TRUE(contains(summary(scratch.path() / "parts"), "\n0001,missing,0.4,1e-11,nan,"));
      EXPECT_EQ(made(scratch.path() / "parts").size(), 3U);
    }
  }
  ASSERT_EQ(run_program(kSweep + " -o parts --quiet --collect", scratch.path()).exit_code, 0);
  EXPECT_EQ(summary(scratch.path() / "whole"), summary(scratch.path() / "parts"));
  EXPECT_EQ(run_program(kSweep + " -o parts --case 7", scratch.path()).exit_code, 2);
}

/// Another process has made its folder and the first file in it, and no more yet.
TEST(Sweep, OneCaseAtATimeIsNotStoppedByACaseThatJustBegins) {
  const ScratchFolder scratch;
  const fs::path parts = scratch.path() / "parts";
  ASSERT_EQ(run_program(kSweep + " -o parts --quiet --case 1", scratch.path()).exit_code, 0);
  fs::create_directories(parts / "runs" / "0002");
  write_file(parts / "runs" / "0002" / ".abradem-write-test", "");
  const Outcome other = run_program(kSweep + " -o parts --quiet --case 3", scratch.path());
  EXPECT_EQ(other.exit_code, 0) << other.err;
  const Outcome early = run_program(kSweep + " -o parts --quiet --collect", scratch.path());
  EXPECT_EQ(early.exit_code, 0) << early.err;
  EXPECT_TRUE(contains(summary(parts), "\n0002,missing,"));
  const Outcome whole = run_program(kSweep + " -o parts --quiet", scratch.path());
  EXPECT_EQ(whole.exit_code, 2);
  EXPECT_TRUE(contains(whole.err, "runs/0002' is in the way: it holds files that are not of a run"));
}

TEST(Sweep, SamplesRanges) {
  const ScratchFolder scratch;
  const std::string ranges = "sweep " + kCase + kShort +
                             " --set wall.disc.mesh.size='0.5 mm' --vary 'particle.pin.load=1..10 N'"
                             " --vary 'wear.\"iron_ore/mild_steel\".wear_coefficient=1e-12..1e-10 1/Pa:log'"
                             " --vary wall.disc.contact=patch,resolved --samples 4 --quiet";
  ASSERT_EQ(run_program(ranges + " --design lhs --seed 3 -o lhs", scratch.path()).exit_code, 0);
  EXPECT_EQ(lines(summary(scratch.path() / "lhs")), 5U);
  ASSERT_EQ(run_program(ranges + " --design sobol -o sobol", scratch.path()).exit_code, 0);
  EXPECT_TRUE(contains(summary(scratch.path() / "sobol"), "\n0001,completed,1,1e-12,patch,"));
  EXPECT_TRUE(contains(summary(scratch.path() / "sobol"), "\n0002,completed,5.5,1e-11,resolved,"));
}

// ---- what is refused
// ---------------------------------------------------------------------------------------------------

TEST(Sweep, FindsEveryMistakeBeforeAnythingRuns) {
  const ScratchFolder scratch;
  const auto refused = [&](const std::string& options, const std::string& message) {
    const Outcome outcome = run_program("sweep " + kCase + kShort + " -o result " + options, scratch.path());
    EXPECT_EQ(outcome.exit_code, 2) << options;
    EXPECT_EQ(outcome.out, "") << options;
    EXPECT_TRUE(contains(outcome.err, message)) << options;
    EXPECT_TRUE(fs::is_empty(scratch.path())) << options;
  };
  refused("", "--vary");
  refused("--vary wall.disc.mesh.sise=1", "did you mean 'size'?");
  refused("--vary run.seed=1,2 --vary 'wall.disc.mesh.size=0.5 mm,0 mm'", "runs '0002' and '0004':");
  refused("--vary 'wall.disc.mesh.size=0.5 mm,0 mm'", "wall.disc.mesh.size=0 mm");
  refused("--vary run.seed=1 --vary run.seed=2", "'run.seed' is varied twice");
  refused("--set run.seed=3 --vary run.seed=1,2", "'run.seed' is both set and varied");
  refused("--vary run.seed=1,2 --vary particle.pin.load=5 --design list",
          "'run.seed' has 2, 'particle.pin.load' has 1");
  refused("--vary run.seed=1..9 --design lhs", "needs --samples N");
  refused("--vary run.seed=1..9", "give their number or list them");
  refused("--vary run.seed=1,2 --samples 3", "--samples counts only with");
  refused("--vary run.seed=1,2 --seed 3", "--seed counts only with");
  refused("--vary run.seed=1,2 --design latin", "--design");
  refused("--vary run.seed=1,2 --case 1 --collect", "--collect");
  refused("--vary run.seed=1,2 --collect", "holds no runs to collect");
}

TEST(Sweep, NeverTouchesAnotherCasesFolder) {
  const ScratchFolder scratch;
  const fs::path folder = scratch.path() / "result";
  ASSERT_EQ(run_program(kSweep + " -o result --quiet", scratch.path()).exit_code, 0);
  const auto before = made(folder);
  const std::string other = kSweep + " -o result --quiet --set particle.pin.load='4 N'";
  const Outcome refused = run_program(other, scratch.path());
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_TRUE(
      contains(refused.err, "holds runs of other inputs under the names '0001', '0002', '0003' and 3 more"));
  EXPECT_EQ(made(folder), before);
  EXPECT_EQ(run_program(other + " --force", scratch.path()).exit_code, 0);
  EXPECT_NE(made(folder), before);

  fs::create_directory(scratch.path() / "mine");
  write_file(scratch.path() / "mine" / "report.html", "mine");
  const Outcome foreign = run_program(kSweep + " -o mine --force", scratch.path());
  EXPECT_EQ(foreign.exit_code, 2);
  EXPECT_TRUE(contains(foreign.err, "holds files that are not of a sweep"));
  EXPECT_EQ(read_file(scratch.path() / "mine" / "report.html"), "mine");
}

// ---- going on
// ---------------------------------------------------------------------------------------------------

TEST(Sweep, NeverRepeatsAFinishedRun) {
  const ScratchFolder scratch;
  const fs::path folder = scratch.path() / "result";
  ASSERT_EQ(run_program(kSweep + " -o result --quiet", scratch.path()).exit_code, 0);
  auto before = made(folder);
  const std::string table = summary(folder);
  fs::remove(folder / "summary.csv");
  fs::remove(folder / "runs" / "0003" / "run.json");
  ASSERT_EQ(run_program(kSweep + " -o result --quiet", scratch.path()).exit_code, 0);
  EXPECT_EQ(summary(folder), table);
  auto after = made(folder);
  EXPECT_NE(after.at("0003"), before["0003"]);
  after.erase("0003"), before.erase("0003");
  EXPECT_EQ(after, before);
  // More values at the end of the first key: more runs, the others stay.
  const std::string more =
      "sweep " + kCase + kShort + " --vary 'wall.disc.mesh.size=0.4 mm,0.5 mm,0.6 mm'" + kAlphas;
  ASSERT_EQ(run_program(more + " -o result --quiet", scratch.path()).exit_code, 0);
  const auto grown = made(folder);
  EXPECT_EQ(grown.size(), 9U);
  for (const auto& [name, time] : before) EXPECT_EQ(grown.at(name), time) << name;
}

TEST(Sweep, MakesEqualRunsOnce) {
  const ScratchFolder scratch;
  const std::string twice =
      "sweep " + kCase + kShort + " --vary 'wall.disc.mesh.size=0.5 mm,500 um' -o result";
  ASSERT_EQ(run_program(twice + " --quiet", scratch.path()).exit_code, 0);
  EXPECT_EQ(made(scratch.path() / "result").size(), 1U);
  EXPECT_EQ(manifest(scratch.path() / "result")["runs"][1]["folder"], "runs/0001");
  EXPECT_TRUE(contains(summary(scratch.path() / "result"), "\n0002,completed,0.5,0.02,"));
}

TEST(Sweep, AFailedRunHasItsMessageAndStopsNoOther) {
  const ScratchFolder scratch;
  const fs::path folder = scratch.path() / "result";
  // 50 kN throws the pin through the disc.
  const std::string sweep = "sweep " + kCase + kShort +
                            " --set run.method=dynamic --set wall.disc.mesh.size='0.5 mm'"
                            " --vary 'particle.pin.load=5 N,50 kN,6 N' -o result";
  const Outcome outcome = run_program(sweep + " --quiet", scratch.path());
  EXPECT_EQ(outcome.exit_code, 4);
  EXPECT_TRUE(contains(outcome.err, "warning: run '0002' failed: particle 'pin'"));
  EXPECT_EQ(lines(outcome.err), 1U) << outcome.err;
  const json batch = manifest(folder);
  EXPECT_EQ(batch["status"], "failed");
  EXPECT_EQ(batch["completed"], 2);
  EXPECT_EQ(batch["runs"][1]["exit_code"], 4);
  EXPECT_TRUE(contains(batch["runs"][1]["error"].get<std::string>(), "particle 'pin'"));
  EXPECT_TRUE(contains(summary(folder), "\n0002,failed,50000,")) << summary(folder);
  // The same inputs would fail in the same way.
  const auto before = made(folder);
  EXPECT_EQ(run_program(sweep + " --quiet", scratch.path()).exit_code, 4);
  EXPECT_EQ(made(folder), before);
  EXPECT_EQ(run_program(sweep + " --quiet --force", scratch.path()).exit_code, 4);
  EXPECT_NE(made(folder).at("0002"), before.at("0002"));
  EXPECT_EQ(made(folder).at("0001"), before.at("0001"));
}

TEST(Sweep, ARunThatCannotBeginIsRecordedToo) {
  const ScratchFolder scratch;
  const fs::path folder = scratch.path() / "result";
  const fs::path no_mesh = scratch.path() / "no mesh.stl";
  write_file(no_mesh, "solid nothing\nendsolid nothing\n");
  const std::string sweep =
      "sweep " + kCase + kShort +
      " --vary 'wall.disc.mesh={shape=\"annulus\",inner=\"21 mm\",outer=\"23 mm\",size=\"0.5 mm\"},"
      "{shape=\"file\",file=\"" +
      no_mesh.string() + "\",unit=\"mm\"}' -o result";
  const Outcome outcome = run_program(sweep + " --quiet", scratch.path());
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_TRUE(contains(outcome.err, "run '0002' failed: "));
  EXPECT_TRUE(contains(manifest(folder)["runs"][1]["error"].get<std::string>(), "no mesh.stl"));
  EXPECT_TRUE(contains(summary(folder), "\n0002,failed,\"{shape=\"\"file\"\","));
  const auto before = made(folder);
  EXPECT_EQ(run_program(sweep + " --quiet", scratch.path()).exit_code, 3);
  EXPECT_EQ(made(folder), before);
}

/// What shows that the first run of a sweep is done.
const fs::path kFirstDone = fs::path("result") / "runs" / "0001" / "run.json";

const std::string kSlow =
    "sweep " + kCase +
    " --set run.method=quasi_static --set wall.disc.mesh.size='0.3 mm' --set output.contours=8"
    " --set output.frames=none --set run.end='2 rev' --vary run.seed=1,2,3,4,5,6,7,8 --quiet --jobs 2 -o "
    "result";

TEST(Sweep, BrokenOffPolitelyGoesOnWhereItStopped) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const ScratchFolder scratch;
    const fs::path folder = scratch.path() / "result";
    EXPECT_EQ(break_off(kSlow, scratch.path(), kFirstDone, signal), 130);
    const json batch = manifest(folder);
    EXPECT_EQ(batch["status"], "interrupted");
    EXPECT_GE(batch["completed"], 1);
    EXPECT_LT(batch["completed"], 8);
    const auto before = made(folder);
    ASSERT_EQ(run_program(kSlow, scratch.path()).exit_code, 0);
    EXPECT_EQ(manifest(folder)["completed"], 8);
    EXPECT_EQ(made(folder).at("0001"), before.at("0001"));
    EXPECT_EQ(lines(summary(folder)), 9U);
  }
}

TEST(Sweep, KilledGoesOnWhereItStoppedWithTheSameTable) {
  const ScratchFolder scratch;
  const fs::path folder = scratch.path() / "result";
  EXPECT_EQ(break_off(kSlow, scratch.path(), kFirstDone, SIGKILL), 1000 + SIGKILL);
  const auto before = made(folder);
  // Its children are told to stop, which may take a moment.
  const Outcome again = run_program(kSlow, scratch.path());
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(made(folder).at("0001"), before.at("0001"));
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    EXPECT_EQ(entry.path().string().find(".tmp"), std::string::npos) << entry.path();
  const std::string table = summary(folder);
  const ScratchFolder other;
  ASSERT_EQ(run_program(kSlow, other.path()).exit_code, 0);
  EXPECT_EQ(summary(other.path() / "result"), table);
}

TEST(Sweep, TwoProcessesMakeOneRunOnce) {
  const ScratchFolder scratch;
  const std::string folder = scratch.path().string();
  const std::string one = kSweep + " -o '" + folder + "/result' --quiet --json --case 2";
  const Outcome both = run_program(one + " >'" + folder + "/first' & '" ABRADEM_PROGRAM "' " + one + " >'" +
                                   folder + "/second'; wait");
  ASSERT_EQ(both.exit_code, 0) << both.err;
  // Each prints the record of the one run; a second one would have taken another time.
  const std::string record = read_file(scratch.path() / "result" / "runs" / "0002" / "run.json");
  EXPECT_EQ(read_file(scratch.path() / "first"), record);
  EXPECT_EQ(read_file(scratch.path() / "second"), record);
}

TEST(Sweep, AFullDiskEndsItWithFiveAndRoomLetsItGoOn) {
  const ScratchFolder scratch;
  // A limit on the size of files stands for a full disk: a run's wear.csv or the page does not fit.
  const Outcome full = run_program(kSweep + " -o result --quiet", scratch.path(), "ulimit -f 8");
  EXPECT_EQ(full.exit_code, 5) << full.err;
  EXPECT_TRUE(contains(full.err, "File too large"));
  EXPECT_EQ(run_program(kSweep + " -o result --quiet", scratch.path()).exit_code, 0);
  EXPECT_EQ(manifest(scratch.path() / "result")["completed"], 6);
}

TEST(Sweep, OverSeedsSaysWhatTheySettle) {
  const ScratchFolder folder;
  const Outcome done = run_program("sweep " + kCase + kShort +
                                       " --set wall.disc.mesh.size='0.4 mm' --vary "
                                       "run.seed=1,2,3 --quiet -o s",
                                   folder.path());
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_TRUE(contains(read_file(folder.path() / "s/report.html"), "What the seed of the mesh decides"));
  EXPECT_EQ(lines(read_file(folder.path() / "s/tables/seed-rule.csv")), 4U);
  EXPECT_EQ(lines(read_file(folder.path() / "s/tables/seed-sensitivity.csv")), 17U);
}

}  // namespace
}  // namespace abradem::test
