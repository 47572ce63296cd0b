// SPDX-License-Identifier: BSD-3-Clause
// A run that is ended in any way and taken up again leaves what a run that was never stopped leaves, bit for
// bit.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <nlohmann/json.hpp>
#include <thread>
#include <vector>

#include "abradem/core/random.h"
#include "abradem/io/csv.h"
#include "cli/program.h"
#include "support/case_texts.h"
#include "support/says.h"

namespace abradem::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using namespace std::chrono_literals;

const std::string kCase = std::string(ABRADEM_SOURCE_DIR) + "/cases/pin-on-disc.toml" +
                          " --quiet --no-report --set wall.disc.mesh.size='0.5 mm' --set output.contours=36"
                          " --set output.every='0.02 rev'";
/// A fraction of a second of work.
const std::string kDynamic = kCase + " --set run.end='0.16 rev'";
const std::string kQuasiStatic = kCase +
                                 " --set run.end='0.5 rev' --set run.method=quasi_static "
                                 "--set run.increment='0.005 mm'";
/// Checkpoints as often as the program looks.
const std::string kOften = " --set output.checkpoint_every='20 ms'";

json manifest(const fs::path& folder) { return json::parse(read_file(folder / "run.json")); }

/// A run of the program that can be sent signals.
class Running {
 public:
  Running(const std::string& arguments, const fs::path& folder) : process_(::fork()) {
    if (process_ != 0) return;
    const std::string command =
        "cd '" + folder.string() + "' && exec '" ABRADEM_PROGRAM "' " + arguments + " 2>>messages";
    ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    ::_exit(127);
  }
  ~Running() {
    if (process_ > 0) end(SIGKILL);
  }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;
  void send(int signal) const { ::kill(process_, signal); }
  /// @return its exit code, or 1000 + the signal that ended it
  int wait() {
    int status = 0;
    ::waitpid(process_, &status, 0);
    process_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
  }
  int end(int signal) {
    send(signal);
    return wait();
  }

 private:
  pid_t process_;
};

bool wait_for(const std::function<bool()>& what) {
  for (int i = 0; i < 3000; ++i) {
    if (what()) return true;
    std::this_thread::sleep_for(5ms);
  }
  return false;
}

std::size_t frame_count(const fs::path& folder) {
  std::error_code ignored;
  std::size_t count = 0;
  for (const auto& entry : fs::directory_iterator(folder / "vtk", ignored))
    count += entry.path().extension() == ".vtp";
  return count;
}

std::size_t checkpoints(const fs::path& folder) {
  std::error_code ignored;
  std::size_t count = 0;
  for (const auto& entry : fs::directory_iterator(folder / "restart", ignored))
    count += entry.path().extension() == ".checkpoint";
  return count;
}

/// Tables, surfaces and hash are the same, and nothing is left over.
void expect_same(const fs::path& one, const fs::path& other) {
  EXPECT_EQ(manifest(other)["status"], "completed");
  EXPECT_EQ(manifest(one)["state_hash"], manifest(other)["state_hash"]);
  EXPECT_EQ(manifest(one)["ledger"], manifest(other)["ledger"]);
  EXPECT_EQ(manifest(one)["results"], manifest(other)["results"]);
  std::size_t files = 0;
  for (const char* part : {"tables", "vtk"}) {
    for (const auto& entry : fs::directory_iterator(one / part)) {
      const fs::path same = other / part / entry.path().filename();
      EXPECT_TRUE(read_file(entry.path()) == read_file(same)) << same;
      ++files;
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(one / part), {}),
              std::distance(fs::directory_iterator(other / part), {}));
  }
  EXPECT_GE(files, 7U);
  EXPECT_EQ(read_file(one / "series.pvd"), read_file(other / "series.pvd"));
  EXPECT_LE(checkpoints(other), 2U);
}

/// Every file can be read as what it is, whenever it is looked at. The system may cut a write short that is
/// killed in the middle: then a table ends with a part of a row.
void expect_valid(const fs::path& folder, bool killed = false) {
  std::error_code ignored;
  if (fs::exists(folder / "run.json")) {
    EXPECT_TRUE(json::accept(read_file(folder / "run.json")));
  }
  for (const char* part : {"tables", "vtk"}) {
    for (const auto& entry : fs::directory_iterator(folder / part, ignored)) {
      if (entry.path().extension() == ".csv") {
        std::string text = read_file(entry.path());
        if (killed) text.resize(text.rfind('\n') + 1);
        EXPECT_NO_THROW((void)io::parse_csv(text, entry.path().string())) << entry.path();
      } else if (entry.path().extension() == ".vtp") {
        EXPECT_NE(read_file(entry.path()).find("</VTKFile>"), std::string::npos) << entry.path();
      }
    }
  }
}

TEST(Resume, AfterSignalsGivesTheSameBits) {
  for (const std::string& run : {kDynamic, kQuasiStatic}) {
    const ScratchFolder scratch;
    ASSERT_EQ(run_program("run " + run + " -o whole", scratch.path()).exit_code, 0);
    const fs::path folder = scratch.path() / "cut";
    for (const int signal : {SIGINT, SIGTERM}) {
      // The first ends the run, the second the run that goes on.
      Running running(
          signal == SIGINT ? "run " + run + " -o cut" : "resume cut --quiet --no-report --threads 2",
          scratch.path());
      // A frame of its own, so that it is on its way and answers signals.
      const std::size_t frames = signal == SIGINT ? 2 : frame_count(folder);
      ASSERT_TRUE(wait_for([&] { return frame_count(folder) > frames; }));
      ASSERT_EQ(running.end(signal), 130);
      EXPECT_EQ(manifest(folder)["status"], "interrupted");
      EXPECT_EQ(manifest(folder)["checkpoint"]["steps"], manifest(folder)["steps"]);
      expect_valid(folder);
    }
    const Outcome rest = run_program("resume cut --quiet --no-report --threads 1", scratch.path());
    ASSERT_EQ(rest.exit_code, 0) << rest.err;
    EXPECT_EQ(manifest(folder)["resumed"], 2);
    expect_same(scratch.path() / "whole", folder);
    // Once more changes nothing.
    const std::string before = read_file(folder / "run.json");
    EXPECT_EQ(run_program("resume cut", scratch.path()).exit_code, 0);
    EXPECT_EQ(read_file(folder / "run.json"), before);
  }
}

TEST(Resume, AfterKillsAtAnyMomentGivesTheSameBits) {
  core::RandomStream random(20, 1);
  int kills = 0;
  for (const std::string& run : {kDynamic, kQuasiStatic}) {
    const ScratchFolder scratch;
    const auto start = std::chrono::steady_clock::now();
    ASSERT_EQ(run_program("run " + run + kOften + " -o whole", scratch.path()).exit_code, 0);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    for (int k = 0; k < 8; ++k) {
      const std::string name = "cut" + std::to_string(k);
      bool begun = false;
      for (int part = 0; part < 2; ++part) {
        Running running(
            begun ? "resume " + name + " --quiet --no-report" : "run " + run + kOften + " --force -o " + name,
            scratch.path());
        std::this_thread::sleep_for(std::chrono::duration<double>(random.uniform(0.0, 0.5 * seconds)));
        kills += running.end(SIGKILL) == 1000 + SIGKILL;
        begun = fs::exists(scratch.path() / name / "case.resolved.toml");
        expect_valid(scratch.path() / name, true);
      }
      const Outcome rest = run_program(
          begun ? "resume " + name + " --quiet --no-report" : "run " + run + kOften + " --force -o " + name,
          scratch.path());
      ASSERT_EQ(rest.exit_code, 0) << rest.err;
      expect_same(scratch.path() / "whole", scratch.path() / name);
      fs::remove_all(scratch.path() / name);
    }
  }
  EXPECT_GT(kills, 16);
}

TEST(Resume, GoesOnPastTheEnd) {
  const ScratchFolder scratch;
  const std::string often = kCase + " --set output.every='0.03 rev'";
  ASSERT_EQ(run_program("run " + often + " --set run.end='0.1 rev' -o short", scratch.path()).exit_code, 0);
  ASSERT_EQ(run_program("run " + often + " --set run.end='0.15 rev' -o whole", scratch.path()).exit_code, 0);
  const Outcome rest =
      run_program("resume short --quiet --no-report --set run.end='0.15 rev'", scratch.path());
  ASSERT_EQ(rest.exit_code, 0) << rest.err;
  expect_same(scratch.path() / "whole", scratch.path() / "short");
  EXPECT_EQ(read_file(scratch.path() / "whole" / "case.resolved.toml"),
            read_file(scratch.path() / "short" / "case.resolved.toml"));
  const auto refused = [&](const std::string& more, const std::string& why) {
    const Outcome outcome = run_program("resume short --set " + more, scratch.path());
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_NE(outcome.err.find(why), std::string::npos) << outcome.err;
  };
  refused("run.seed=2", "can change run.end and output.checkpoint_every, nothing else");
  refused("run.end='0.05 rev'", "run.end lies before");
  expect_same(scratch.path() / "whole", scratch.path() / "short");
}

/// A case of particles in numbers, of sizes and from places in files.
void write_feed(const fs::path& folder) {
  write_file(folder / "sizes.csv", "radius_mm,share\n0.8,1\n1.1,2\n");
  write_file(folder / "places.csv", "x_mm,y_mm,z_mm,radius_mm\n0,0,1.4,1.5\n4,1,2,1\n-4,2,1.2,1.2\n");
  write_file(folder / "feed.toml", std::string(kGlass) + R"([wear."glass/glass"]
wear_coefficient = "1e-10 1/Pa"
[wall.plate]
material = "glass"
mesh = { shape = "plate", length = "20 mm", width = "20 mm", size = "2 mm" }
motion = { kind = "oscillation", amplitude = ["1 mm", 0, 0], frequency = "50 Hz" }
contact = "resolved"
[insertion.feed]
material = "glass"
mass = "1 kg"
mass_rate = "0.05 kg/s"
velocity = [0, 0, "-0.5 m/s"]
size = { kind = "table", file = "sizes.csv" }
volume = { low = ["-8 mm", "-8 mm", "4 mm"], high = ["8 mm", "8 mm", "9 mm"] }
[insertion.some]
material = "glass"
volume = { shape = "file", file = "places.csv" }
[domain]
low = ["-10 mm", "-10 mm", "-5 mm"]
high = ["10 mm", "10 mm", "20 mm"]
[run]
end = "30 ms"
gravity = [0, 0, "-9.81 m/s^2"]
[output]
every = "10 ms"
)");
}

/// The files of sizes and places are gone when the run is taken up.
TEST(Resume, OfParticlesInNumbersGoesOnPastTheEnd) {
  const ScratchFolder scratch;
  write_feed(scratch.path());
  const std::string run = "run feed.toml --quiet --no-report --threads 1";
  ASSERT_EQ(run_program(run + " -o whole", scratch.path()).exit_code, 0);
  ASSERT_EQ(run_program(run + " --set run.end='17 ms' -o short", scratch.path()).exit_code, 0);
  fs::remove(scratch.path() / "sizes.csv");
  fs::remove(scratch.path() / "places.csv");
  const Outcome rest =
      run_program("resume short --quiet --no-report --threads 2 --set run.end='30 ms'", scratch.path());
  ASSERT_EQ(rest.exit_code, 0) << rest.err;
  expect_same(scratch.path() / "whole", scratch.path() / "short");
  const io::CsvTable table = io::read_csv(scratch.path() / "short" / "tables" / "particles.csv");
  EXPECT_EQ(table.rows(), 4U);
  EXPECT_GT(table.column("inserted").back(), 50.0);
}

/// A rock falls on the feed's plate, and is taken up again in the middle of that; so is what goes on from
/// there.
TEST(Resume, OfANamedClumpGoesOn) {
  const ScratchFolder scratch;
  write_feed(scratch.path());
  write_file(scratch.path() / "feed.toml", read_file(scratch.path() / "feed.toml") + R"([shape.rock]
spheres = [{ position = [0, 0, 0], radius = "1.5 mm" }, { position = ["2 mm", 0, 0], radius = "1 mm" }]
[particle.rock]
material = "glass"
shape = "rock"
rotation = ["20 deg", "40 deg", 0]
position = [0, "4 mm", "5 mm"]
velocity = [0, 0, "-1 m/s"]
)");
  const std::string run = "run feed.toml --quiet --no-report --threads 1 --set output.every='10 ms'";
  ASSERT_EQ(run_program(run + " -o whole", scratch.path()).exit_code, 0);
  ASSERT_EQ(run_program(run + " --set run.end='17 ms' -o short", scratch.path()).exit_code, 0);
  const Outcome rest =
      run_program("resume short --quiet --no-report --threads 2 --set run.end='30 ms'", scratch.path());
  ASSERT_EQ(rest.exit_code, 0) << rest.err;
  expect_same(scratch.path() / "whole", scratch.path() / "short");
  EXPECT_TRUE(
      contains(run_program("check feed.toml", scratch.path()).err, "particle 'rock' of glass: shape 'rock'"));
  // Inside the plate it is refused before the run.
  const Outcome buried =
      run_program(run + " -o buried --set particle.rock.position='[0, 0, \"0.5 mm\"]'", scratch.path());
  EXPECT_EQ(buried.exit_code, 2);
  EXPECT_TRUE(contains(buried.err, "'rock': "));
  EXPECT_TRUE(contains(buried.err, "of its 2 spheres lie inside wall 'plate'"));
}

/// The mesh and the table of a motion are part of a checkpoint: their files are gone when the run is taken
/// up.
TEST(Resume, OfAWallOfCombinedMotionsGoesOnWithoutItsFiles) {
  const ScratchFolder scratch;
  write_feed(scratch.path());
  write_file(scratch.path() / "ride.csv",
             "time_s,x_mm,z_mm,angle_deg\n0,0,0,0\n0.004,1,0.2,1\n0.009,0,0,0\n");
  std::string text =
      replaced(read_file(scratch.path() / "feed.toml"),
               "motion = { kind = \"oscillation\", amplitude = [\"1 mm\", 0, 0], frequency = \"50 Hz\" }",
               "motion = [{ kind = \"rotation\", rate = \"180 deg/s\" },\n"
               "          { kind = \"table\", axis = [0, 1, 0], file = \"ride.csv\", after = \"repeat\" },\n"
               "          { kind = \"oscillation\", amplitude = [\"1 mm\", 0, 0], frequency = \"50 Hz\" }]");
  text = replaced(text, "shape = \"plate\", length = \"20 mm\", width = \"20 mm\", size = \"2 mm\"",
                  "file = \"plate.obj\", unit = \"mm\"");
  write_file(scratch.path() / "plate.obj", "v -10 -10 0\nv 10 -10 0\nv 10 10 0\nv -10 10 0\nf 1 2 3 4\n");
  write_file(scratch.path() / "feed.toml", text);
  const std::string run = "run feed.toml --quiet --no-report --threads 1 --set output.every='10 ms'";
  const Outcome whole = run_program(run + " -o whole", scratch.path());
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  ASSERT_EQ(run_program(run + " --set run.end='17 ms' -o short", scratch.path()).exit_code, 0);
  fs::remove(scratch.path() / "ride.csv");
  fs::remove(scratch.path() / "plate.obj");
  const Outcome rest =
      run_program("resume short --quiet --no-report --threads 2 --set run.end='30 ms'", scratch.path());
  ASSERT_EQ(rest.exit_code, 0) << rest.err;
  expect_same(scratch.path() / "whole", scratch.path() / "short");
}

TEST(Resume, OfParticlesInNumbersAfterKillsGivesTheSameBits) {
  core::RandomStream random(21, 1);
  const ScratchFolder scratch;
  write_feed(scratch.path());
  const std::string run = "run feed.toml --quiet --no-report --threads 1 --set run.end='0.1 s'" + kOften;
  const auto start = std::chrono::steady_clock::now();
  ASSERT_EQ(run_program(run + " -o whole", scratch.path()).exit_code, 0);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  int kills = 0;
  for (int k = 0; k < 4; ++k) {
    const std::string name = "cut" + std::to_string(k);
    const auto command = [&] {
      return fs::exists(scratch.path() / name / "case.resolved.toml")
                 ? "resume " + name + " --quiet --no-report --threads 2"
                 : run + " --force -o " + name;
    };
    for (int part = 0; part < 2; ++part) {
      Running running(command(), scratch.path());
      std::this_thread::sleep_for(std::chrono::duration<double>(random.uniform(0.1, 0.6) * seconds));
      kills += running.end(SIGKILL) == 1000 + SIGKILL;
      expect_valid(scratch.path() / name, true);
    }
    const Outcome rest = run_program(command(), scratch.path());
    ASSERT_EQ(rest.exit_code, 0) << rest.err;
    expect_same(scratch.path() / "whole", scratch.path() / name);
  }
  EXPECT_GT(kills, 4);
}

TEST(Checkpoint, IsWrittenWhenAskedForAndTheRunGoesOn) {
  const ScratchFolder scratch;
  Running running("run " + kCase + " --set run.end='1000 rev' -o result", scratch.path());
  const fs::path folder = scratch.path() / "result";
  ASSERT_TRUE(wait_for([&] { return fs::exists(folder / "vtk" / "disc_0002.vtp"); }));
  EXPECT_EQ(checkpoints(folder), 0U);
  for (int k = 0; k < 3; ++k) {
    const std::string before = fs::exists(folder / "run.json") ? read_file(folder / "run.json") : "";
    running.send(SIGUSR1);
    ASSERT_TRUE(wait_for(
        [&] { return fs::exists(folder / "run.json") && read_file(folder / "run.json") != before; }));
  }
  EXPECT_EQ(checkpoints(folder), 2U);  // the last two are kept
  const json run = manifest(folder);
  EXPECT_EQ(run["status"], "running");
  EXPECT_TRUE(run["exit_code"].is_null());
  EXPECT_TRUE(fs::exists(folder / run["checkpoint"]["file"].get<std::string>()));
  // A second program in the same folder is sent away.
  const Outcome other = run_program("resume result", scratch.path());
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_NE(other.err.find("another abradem works on"), std::string::npos) << other.err;
  EXPECT_EQ(running.end(SIGINT), 130);
}

class BadCheckpoint : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(run_program("run " + kDynamic + " -o whole", scratch_.path()).exit_code, 0);
    Running running("run " + kDynamic + kOften + " -o cut", scratch_.path());
    ASSERT_TRUE(wait_for([&] { return checkpoints(folder_) == 2; }));
    running.end(SIGKILL);
    for (const auto& entry : fs::directory_iterator(folder_ / "restart"))
      if (entry.path().extension() == ".checkpoint") files_.push_back(entry.path());
    std::sort(files_.begin(), files_.end());
    ASSERT_EQ(files_.size(), 2U);
  }
  Outcome resume() { return run_program("resume cut --quiet --no-report", scratch_.path()); }
  ScratchFolder scratch_;
  fs::path folder_ = scratch_.path() / "cut";
  std::vector<fs::path> files_;
};

TEST_F(BadCheckpoint, IsPassedOverForTheOneBefore) {
  std::string bytes = read_file(files_[1]);
  bytes[bytes.size() / 2] ^= 1;
  write_file(files_[1], bytes);
  const Outcome outcome = resume();
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("it is damaged: its checksum is another"), std::string::npos) << outcome.err;
  EXPECT_EQ(manifest(scratch_.path() / "whole")["state_hash"], manifest(folder_)["state_hash"]);
  EXPECT_EQ(read_file(scratch_.path() / "whole/tables/force.csv"), read_file(folder_ / "tables/force.csv"));
}

TEST_F(BadCheckpoint, OfAnotherFormatIsRefusedInWords) {
  for (const fs::path& file : files_) {
    std::string bytes = read_file(file);
    bytes[8] = 77;
    write_file(file, bytes);
  }
  const std::string before = read_file(folder_ / "tables" / "force.csv");
  const Outcome outcome = resume();
  EXPECT_EQ(outcome.exit_code, 5);
  EXPECT_NE(outcome.err.find("it has format 77, and this program (abradem"), std::string::npos)
      << outcome.err;
  EXPECT_EQ(read_file(folder_ / "tables" / "force.csv"), before);
}

TEST_F(BadCheckpoint, OfAFolderWithoutItsRowsIsRefused) {
  fs::resize_file(folder_ / "tables" / "force.csv", 150);
  const Outcome outcome = resume();
  EXPECT_EQ(outcome.exit_code, 5);
  EXPECT_NE(outcome.err.find("force.csv' is not what it was when the checkpoint was written"),
            std::string::npos)
      << outcome.err;
}

TEST(Resume, RefusesWhatIsNoRun) {
  const ScratchFolder scratch;
  fs::create_directory(scratch.path() / "empty");
  EXPECT_EQ(run_program("resume empty", scratch.path()).exit_code, 2);
  EXPECT_EQ(run_program("resume nowhere", scratch.path()).exit_code, 2);
}

TEST(Resume, OfASweepIsTheSameCommandAgain) {
  const ScratchFolder scratch;
  const std::string sweep = "sweep " + std::string(ABRADEM_SOURCE_DIR) +
                            "/cases/pin-on-disc.toml --quiet --jobs 2 --set wall.disc.mesh.size='0.5 mm'"
                            " --set output.contours=36 --set output.every='0.02 rev' --set run.end='0.3 rev'"
                            " --set output.checkpoint_every='50 ms'"
                            " --vary 'contact.\"iron_ore/mild_steel\".static_friction=0.3,0.6' -o ";
  ASSERT_EQ(run_program(sweep + "whole", scratch.path()).exit_code, 0);
  const std::vector<fs::path> runs{scratch.path() / "cut/runs/0001", scratch.path() / "cut/runs/0002"};
  {
    Running running(sweep + "cut", scratch.path());
    ASSERT_TRUE(wait_for([&] { return checkpoints(runs[0]) > 0 && checkpoints(runs[1]) > 0; }));
    running.end(SIGKILL);
  }
  const Outcome rest = run_program(sweep + "cut", scratch.path());
  ASSERT_EQ(rest.exit_code, 0) << rest.err;
  int resumed = 0;
  for (const fs::path& run : runs) {
    const fs::path whole = scratch.path() / "whole/runs" / run.filename();
    expect_same(whole, run);
    resumed += manifest(run).value("resumed", 0);
    EXPECT_EQ(checkpoints(run), 0U);  // done: no room is taken up
  }
  EXPECT_GE(resumed, 1);
}

}  // namespace
}  // namespace abradem::test
