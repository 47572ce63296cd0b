// SPDX-License-Identifier: BSD-3-Clause
// What the machine may do to a run: no room, no folder, no terminal, no memory. A message, the exit code, and
// what was good is still there.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "abradem/io/csv.h"
#include "cli/program.h"

namespace abradem::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const std::string kRun = "run " + std::string(ABRADEM_SOURCE_DIR) +
                         "/cases/pin-on-disc.toml --quiet --no-report --set wall.disc.mesh.size='0.5 mm'"
                         " --set output.contours=36 --set output.every='0.02 rev' --set output.frames=none";

json manifest(const fs::path& folder) { return json::parse(read_file(folder / "run.json")); }

/// A run on a full disk ends with 5 and can be gone on with when there is room.
void expect_goes_on(const fs::path& scratch, const std::string& full, const std::string& run) {
  const fs::path folder = scratch / "full";
  EXPECT_EQ(manifest(folder)["status"], "failed");
  EXPECT_EQ(manifest(folder)["exit_code"], 5);
  EXPECT_NE(full.find("cannot write"), std::string::npos) << full;
  for (const char* table : {"revolutions", "contours", "profiles", "force"})
    EXPECT_NO_THROW((void)io::read_csv(folder / "tables" / (std::string(table) + ".csv"))) << table;
  const Outcome rest = run_program("resume full --quiet --no-report", scratch);
  ASSERT_EQ(rest.exit_code, 0) << rest.err;
  ASSERT_EQ(run_program(run + " -o whole", scratch).exit_code, 0);
  EXPECT_EQ(manifest(folder)["state_hash"], manifest(scratch / "whole")["state_hash"]);
  for (const char* table : {"revolutions", "contours", "profiles", "force", "wear"}) {
    const std::string file = "tables/" + std::string(table) + ".csv";
    EXPECT_TRUE(read_file(folder / file) == read_file(scratch / "whole" / file)) << table;
  }
}

TEST(Fault, NoRoomForTheTablesLosesNoRow) {
  const ScratchFolder scratch;
  const std::string run = kRun + " --set run.end='0.3 rev' --set output.checkpoint_every=0";
  // A limit on the size of files stands for the disk: force.csv comes to it after some outputs.
  const Outcome full = run_program(run + " -o full", scratch.path(), "ulimit -f 400");
  ASSERT_EQ(full.exit_code, 5) << full.err;
  expect_goes_on(scratch.path(), full.err, run);
}

/// A real file system of half a megabyte; where the machine lets nobody mount one, a limit on the size of
/// files.
TEST(Fault, ASmallFileSystemThatIsFullLosesNoRow) {
  const ScratchFolder scratch;
  fs::create_directory(scratch.path() / "full");
  fs::create_directory(scratch.path() / "kept");
  const std::string mount = "mount -t tmpfs -o size=600k tmpfs full 2>/dev/null";
  std::string unshare;
  for (const char* way : {"unshare -rm", "unshare -m"}) {  // as an ordinary user; as root
    const std::string tried = std::string(way) + " sh -c '" + mount + "' 2>/dev/null";
    if (run_program("--version >/dev/null", scratch.path(), tried).exit_code == 0) unshare = way;
  }
  std::string run = kRun + " --set run.end='0.3 rev'";
  if (unshare.empty()) {
    run += " --set output.checkpoint_every=0";  // a file larger than the limit
    fs::remove(scratch.path() / "full");
    const Outcome full = run_program(run + " -o full", scratch.path(), "ulimit -f 300");
    ASSERT_EQ(full.exit_code, 5) << full.err;
    expect_goes_on(scratch.path(), full.err, run);
    return;
  }
  const std::string inside = "{ " + unshare + " sh -c '" + mount +
                             "; \"$0\" \"$@\"; code=$?; cp -r full/. kept; exit $code' '" +
                             ABRADEM_PROGRAM "' " + run + " -o full 2>said; echo $? >code; }";
  ASSERT_EQ(run_program("--version >/dev/null", scratch.path(), inside).exit_code, 0);
  EXPECT_EQ(read_file(scratch.path() / "code"), "5\n") << read_file(scratch.path() / "said");
  fs::remove(scratch.path() / "full");
  fs::rename(scratch.path() / "kept", scratch.path() / "full");
  expect_goes_on(scratch.path(), read_file(scratch.path() / "said"), run);
}

TEST(Fault, AFolderThatIsRemovedEndsTheRunWithFive) {
  const ScratchFolder scratch;
  const fs::path folder = scratch.path() / "result";
  const pid_t child = ::fork();
  if (child == 0) {
    const std::string command = "cd '" + scratch.path().string() + "' && exec '" ABRADEM_PROGRAM "' " + kRun +
                                " --set run.end='1000 rev' --set output.frames=all -o result 2>said";
    ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    ::_exit(127);
  }
  for (int i = 0; i < 2000 && !fs::exists(folder / "vtk" / "disc_0001.vtp"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  std::error_code ignored;
  for (int i = 0; i < 10 && fs::exists(folder); ++i) fs::remove_all(folder, ignored);
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 5);
  const std::string said = read_file(scratch.path() / "said");
  EXPECT_NE(said.find("abradem: error: cannot write 'result/"), std::string::npos) << said;
  EXPECT_NE(said.find("No such file or directory"), std::string::npos) << said;
}

TEST(Fault, NoTerminalNoLocaleNoStreamsIsNoMatter) {
  const ScratchFolder scratch;
  const std::string short_run = kRun + " --set run.end='0.02 rev'";
  EXPECT_EQ(run_program(short_run + " -o plain", scratch.path()).exit_code, 0);
  const std::string hash = manifest(scratch.path() / "plain")["state_hash"];
  const char* const surroundings[][2]{{"nolocale", "export LC_ALL=xx_YY.nonsense LANG=none"},
                                      {"comma", "export LC_ALL=de_DE.UTF-8"},
                                      {"noterm", "unset TERM HOME USER"},
                                      {"closed", "exec <&- >&-"}};
  for (const auto& [name, before] : surroundings) {
    const Outcome outcome = run_program(short_run + " -o " + name, scratch.path(), before);
    EXPECT_EQ(outcome.exit_code, 0) << name << outcome.err;
    EXPECT_EQ(manifest(scratch.path() / name)["state_hash"], hash) << name;
    EXPECT_EQ(read_file(scratch.path() / name / "tables/revolutions.csv"),
              read_file(scratch.path() / "plain/tables/revolutions.csv"))
        << name;
  }
}

TEST(Fault, AMemoryLimitIsSaidInWordsAndLeavesNoFolder) {
  const ScratchFolder scratch;
  const Outcome outcome =
      run_program(kRun + " --set run.end='0.02 rev' --set wall.disc.mesh.size='0.03 mm' -o result",
                  scratch.path(), "export OMP_NUM_THREADS=1; ulimit -v 130000");
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_NE(outcome.err.find("out of memory; make the mesh coarser"), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(scratch.path() / "result"));
}

TEST(Fault, AnUnphysicalRunKeepsItsLastGoodState) {
  const ScratchFolder scratch;
  const Outcome outcome =
      run_program(kRun +
                      " -o result --set 'particle.pin.position=[\"22 mm\", 0, \"4.4 mm\"]'"
                      " --set 'particle.pin.velocity=[0, 0, \"-15 m/s\"]' --set run.end='1 ms'"
                      " --set output.every='0.02 ms'",
                  scratch.path());
  EXPECT_EQ(outcome.exit_code, 4);
  const json run = manifest(scratch.path() / "result");
  EXPECT_TRUE(fs::exists(scratch.path() / "result" / run["checkpoint"]["file"].get<std::string>()));
  EXPECT_LT(run["checkpoint"]["steps"].get<int>(), run["steps"].get<int>());
  // It goes on from there, to the same end.
  const Outcome again = run_program("resume result --quiet --no-report", scratch.path());
  EXPECT_EQ(again.exit_code, 4);
  EXPECT_NE(again.err.find("with the same case it will again"), std::string::npos) << again.err;
  EXPECT_EQ(manifest(scratch.path() / "result")["error"], run["error"]);
  EXPECT_EQ(manifest(scratch.path() / "result")["steps"], run["steps"]);
}

}  // namespace
}  // namespace abradem::test
