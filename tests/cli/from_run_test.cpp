// SPDX-License-Identifier: BSD-3-Clause
// Runs that begin with what another run left.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "abradem/io/csv.h"
#include "cli/program.h"
#include "support/case_texts.h"
#include "support/says.h"

namespace abradem::test {
namespace {

namespace fs = std::filesystem;

/// Spheres and pebbles that fall into a tray, and a run that shakes what lies there.
class FromRun : public testing::Test {
 protected:
  void SetUp() override {
    write_file(folder() / "fall.toml", head("at rest") + R"([insertion.grains]
material = "glass"
number = 60
size = { kind = "uniform", low = "0.8 mm", high = "1.1 mm" }
volume = { low = ["-7 mm", "-7 mm", "1 mm"], high = ["7 mm", "7 mm", "7 mm"] }
[insertion.pebbles]
material = "glass"
shape = "pebble"
number = 10
volume = { low = ["-7 mm", "-7 mm", "7.5 mm"], high = ["7 mm", "7 mm", "13 mm"] }
)");
    write_file(folder() / "shake.toml", head("shaken") + R"([insertion.grains]
material = "glass"
volume = { run = "settled" }
[insertion.pebbles]
material = "glass"
shape = "pebble"
volume = { run = "settled" }
)");
    const Outcome fall = run_program("run fall.toml -o settled --quiet --no-report --threads 1", folder());
    ASSERT_EQ(fall.exit_code, 0) << fall.err;
  }
  [[nodiscard]] const fs::path& folder() const noexcept { return scratch_.path(); }
  void refuse(const std::string& overrides, std::initializer_list<const char*> words) const {
    const Outcome checked = run_program("check shake.toml " + overrides, folder());
    EXPECT_EQ(checked.exit_code, 2);
    EXPECT_TRUE(says(checked.err, words));
    EXPECT_EQ(run_program("run shake.toml -o refused " + overrides, folder()).exit_code, 2);
    EXPECT_FALSE(fs::exists(folder() / "refused"));
  }
  static nlohmann::json manifest(const fs::path& run) {
    return nlohmann::json::parse(read_file(run / "run.json"));
  }

 private:
  static std::string head(const std::string& motion) {
    return std::string(kGlass) + R"([shape.pebble]
spheres = [{ position = [0, 0, 0], radius = "1 mm" }, { position = ["0.8 mm", 0, 0], radius = "0.7 mm" }]
[wall.plate]
material = "glass"
mesh = { shape = "plate", length = "20 mm", width = "20 mm", size = "5 mm" }
)" +
           (motion == "shaken" ? "motion = { kind = \"oscillation\", amplitude = [\"0.2 mm\", 0, 0], "
                                 "frequency = \"50 Hz\" }\n"
                               : "") +
           R"([domain]
low = ["-8 mm", "-8 mm", "-5 mm"]
high = ["8 mm", "8 mm", "20 mm"]
periodic = "xy"
[run]
end = "20 ms"
gravity = [0, 0, "-9.81 m/s^2"]
[output]
every = "5 ms"
)";
  }
  ScratchFolder scratch_;
};

TEST_F(FromRun, TakesUpWhatItLeftAndIsResumedWithoutIt) {
  const Outcome checked = run_program("check shake.toml", folder());
  EXPECT_EQ(checked.exit_code, 0) << checked.err;
  EXPECT_TRUE(says(checked.err, {"60 particles, as left by", "10 particles, as left by"}));
  const std::string run = "run shake.toml --quiet --no-report --threads 1";
  ASSERT_EQ(run_program(run + " -o whole", folder()).exit_code, 0);
  EXPECT_TRUE(
      contains(read_file(folder() / "whole" / "run.log"), "insertion 'grains': 60 particles as left by "));
  const io::CsvTable left = io::read_csv(folder() / "settled" / "tables" / "particles.csv"),
                     taken = io::read_csv(folder() / "whole" / "tables" / "particles.csv");
  EXPECT_EQ(taken.column("particles").front(), left.column("particles").back());
  EXPECT_NEAR(taken.column("mass_kg").front() / left.column("mass_kg").back(), 1.0, 1e-14);
  EXPECT_NEAR(taken.column("kinetic_energy_J").front() / left.column("kinetic_energy_J").back(), 1.0, 1e-13);

  ASSERT_EQ(run_program(run + " -o short --set run.end='10 ms'", folder()).exit_code, 0);
  fs::remove_all(folder() / "settled");
  const Outcome rest =
      run_program("resume short --quiet --no-report --threads 2 --set run.end='20 ms'", folder());
  ASSERT_EQ(rest.exit_code, 0) << rest.err;
  EXPECT_EQ(manifest(folder() / "short")["state_hash"], manifest(folder() / "whole")["state_hash"]);
}

TEST_F(FromRun, TakesAnEarlierMoment) {
  const std::string at =
      " --set insertion.grains.volume.at='10 ms' --set insertion.pebbles.volume.at='10 ms'";
  ASSERT_EQ(run_program("run shake.toml -o early --quiet --no-report --threads 1" + at, folder()).exit_code,
            0);
  const io::CsvTable left = io::read_csv(folder() / "settled" / "tables" / "particles.csv"),
                     taken = io::read_csv(folder() / "early" / "tables" / "particles.csv");
  EXPECT_NEAR(taken.column("kinetic_energy_J").front() / left.column("kinetic_energy_J")[2], 1.0, 1e-13);
  EXPECT_NE(manifest(folder() / "early")["inputs_hash"], nullptr);
}

/// The only clump lies across the border of the period: half of its spheres are a period away from it.
TEST_F(FromRun, TakesAClumpAcrossTheBorder) {
  const std::string fall = read_file(folder() / "fall.toml");
  write_file(folder() / "one.toml", fall.substr(0, fall.find("[insertion.grains]")) + R"([particle.pebble]
material = "glass"
shape = "pebble"
position = ["7.9 mm", 0, "1.05 mm"]
rotation = [0, 0, "10 deg"]
)");
  const Outcome one =
      run_program("run one.toml -o settled --force --quiet --no-report --threads 1", folder());
  ASSERT_EQ(one.exit_code, 0) << one.err;
  std::string shake = read_file(folder() / "shake.toml");
  shake.erase(shake.find("[insertion.grains]"),
              shake.find("[insertion.pebbles]") - shake.find("[insertion.grains]"));
  write_file(folder() / "shake.toml", shake);
  const Outcome checked = run_program("check shake.toml", folder());
  EXPECT_EQ(checked.exit_code, 0) << checked.err;
  EXPECT_TRUE(contains(checked.err, "1 particles, as left by"));
}

TEST_F(FromRun, RefusesBeforeTheRun) {
  refuse("--set insertion.grains.volume.at='7 ms'", {"has no frame at 0.007 s", "the last at 0.02 s"});
  refuse("--set insertion.grains.volume.run=nowhere",
         {"nowhere' does not exist", "the folder of the case file"});
  refuse("--set insertion.grains.volume.run=.", {"is not the folder of a run: it has no case.resolved.toml"});
  refuse("--set insertion.grains.number=5", {"'number' does not count here"});
  refuse("--set shape.pebble.spheres='[{ position = [0, 0, 0], radius = 0.001 }]'",
         {"was another shape than [shape.pebble]"});
  const std::string shake = read_file(folder() / "shake.toml");
  write_file(folder() / "shake.toml",
             replaced(replaced(shake, "material = \"glass\"\nvolume", "material = \"lead\"\nvolume"),
                      "[shape.pebble]", R"([material.lead]
density = 11000
shear_modulus = "1 GPa"
poisson_ratio = 0.4
[contact."lead/lead"]
restitution = 0.1
static_friction = 0.5
[contact."lead/glass"]
restitution = 0.1
static_friction = 0.5
[shape.pebble])"));
  refuse("", {"left no spheres of 'lead'; it left 60 spheres of 'glass', 10 'pebble' of 'glass'"});
  write_file(folder() / "shake.toml", shake);
  // Another wall: only the run itself has it.
  const Outcome buried =
      run_program("run shake.toml -o refused --set wall.plate.mesh.position='[0, 0, \"0.5 mm\"]'", folder());
  EXPECT_EQ(buried.exit_code, 2);
  EXPECT_TRUE(says(buried.err, {"spheres lie inside wall 'plate' or deeper in it than a tenth",
                                "does the wall stand where it stood there?"}));
  EXPECT_FALSE(fs::exists(folder() / "refused"));
  // Older frames, and damaged ones.
  fs::path last;
  for (const auto& entry : fs::directory_iterator(folder() / "settled" / "vtk"))
    if (entry.path().filename().string().starts_with("particles_")) last = std::max(last, entry.path());
  const std::string frame = read_file(last);
  write_file(last, replaced(frame, "spin_rad_per_s", "spun_rad_per_s"));
  const Outcome old = run_program("check shake.toml", folder());
  EXPECT_EQ(old.exit_code, 5);
  EXPECT_TRUE(says(old.err, {"has no array 'spin_rad_per_s'", "run the case again"}));
  write_file(last, frame.substr(0, frame.size() / 2));
  EXPECT_EQ(run_program("check shake.toml", folder()).exit_code, 5);
}

TEST_F(FromRun, SaysWhatIsLeftOut) {
  write_file(folder() / "shake.toml", replaced(read_file(folder() / "shake.toml"),
                                               "[insertion.pebbles]\nmaterial = \"glass\"\nshape = "
                                               "\"pebble\"\nvolume = { run = \"settled\" }\n",
                                               ""));
  const Outcome checked = run_program("check shake.toml", folder());
  EXPECT_EQ(checked.exit_code, 0);
  EXPECT_TRUE(says(checked.err, {"also left 10 'pebble' of 'glass', which no insertion takes"}));
}

}  // namespace
}  // namespace abradem::test
