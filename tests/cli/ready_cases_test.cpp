// SPDX-License-Identifier: BSD-3-Clause
// The ready cases of bulk equipment, made so small that they take a moment: they run to their end, what comes
// in is accounted for, and where a wall wears the ledger closes.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "abradem/io/csv.h"
#include "abradem/io/vtp_read.h"
#include "cli/program.h"

namespace abradem::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct ReadyCase {
  std::string name, smaller;
  bool wears = false;
};

void PrintTo(const ReadyCase& c, std::ostream* out) { *out << c.name; }

class ReadyCases : public testing::TestWithParam<ReadyCase> {};

TEST_P(ReadyCases, RunsToItsEnd) {
  const ScratchFolder scratch;
  const std::string file = ABRADEM_SOURCE_DIR "/cases/" + GetParam().name + ".toml";
  const Outcome outcome =
      run_program("run " + file + " --quiet --threads 1 -o out " + GetParam().smaller, scratch.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err.find("nan"), std::string::npos) << outcome.err;
  const fs::path folder = scratch.path() / "out";
  EXPECT_TRUE(fs::exists(folder / "report.html"));
  const io::CsvTable table = io::read_csv(folder / "tables" / "particles.csv");
  const std::size_t last = table.rows() - 1;
  EXPECT_GT(table.column("inserted")[last], 20.0);
  EXPECT_GT(table.column("wall_contacts")[last], 0.0);
  for (std::size_t r = 0; r < table.rows(); ++r)
    EXPECT_EQ(table.column("particles")[r] + table.column("removed")[r], table.column("inserted")[r]);
  const json ledger = json::parse(read_file(folder / "run.json"))["ledger"];
  EXPECT_EQ(ledger["law_volume_mm3"].get<double>() > 0.0, GetParam().wears);
  EXPECT_LT(ledger["residual_relative"].get<double>(), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(
    Bulk, ReadyCases,
    testing::Values(
        ReadyCase{"hopper",
                  "--set insertion.fill.number=300 --set run.end='50 ms' --set wall.gate.until='40 ms'"},
        ReadyCase{"transfer-chute", "--set run.end='0.14 s'", true},
        ReadyCase{"liner-life",
                  "--set run.settle='0.13 s' --set run.end='1 h' --set output.every='0.5 h' --set "
                  "'wear.\"ore/steel\".acceleration=1e5'",
                  true},
        ReadyCase{"templates/chute", "--set run.end='0.14 s'", true},
        ReadyCase{"rotating-drum",
                  "--set insertion.charge.number=60 --set run.end='0.07 rev' --set output.every='0.01 rev'",
                  true},
        ReadyCase{"drum-profile",
                  "--set insertion.charge.number=300 --set insertion.charge.volume.radius='45 mm' --set "
                  "'insertion.charge.volume.base=[0,\"-5 mm\",\"-70 mm\"]' --set "
                  "'insertion.charge.volume.top=[0,\"5 mm\",\"-70 mm\"]' --set run.end='0.15 s' --set "
                  "output.every='50 ms'",
                  true},
        ReadyCase{"angle-of-repose", "--set run.end='0.12 s' --set output.every='20 ms'"},
        ReadyCase{"pebbles", "--set run.end='0.1 s' --set output.every='20 ms'"}));

/// Particles stand in the world, the drum in its own frame: its frames say how far it has been carried.
TEST(RotatingDrum, FramesSayWhereTheWallIs) {
  const ScratchFolder scratch;
  const Outcome outcome = run_program("run " ABRADEM_SOURCE_DIR
                                      "/cases/rotating-drum.toml --threads 1 --no-report --quiet -o out "
                                      "--set insertion.charge.number=20 --set "
                                      "run.end='0.02 rev' --set output.every='0.01 rev'",
                                      scratch.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const io::VtpSurface drum = io::read_vtp(scratch.path() / "out/vtk/drum_0002.vtp");
  const std::vector<double>& moved = drum.point_data.at("moved_m").values;
  const double a = 0.02 * 2.0 * std::numbers::pi;
  for (std::size_t k = 0; k < drum.mesh.vertices.size(); ++k) {
    const Vec3& v = drum.mesh.vertices[k];  // turned about y
    EXPECT_NEAR(v.x + moved[3 * k], std::cos(a) * v.x + std::sin(a) * v.z, 1e-9);
    EXPECT_NEAR(v.y + moved[3 * k + 1], v.y, 1e-12);
    EXPECT_NEAR(v.z + moved[3 * k + 2], std::cos(a) * v.z - std::sin(a) * v.x, 1e-9);
  }
}

/// Next to nothing is worn: what rounding makes of it is no fault, and nobody is warned.
TEST(DrumProfile, LedgerOfNextToNothingCloses) {
  const ScratchFolder scratch;
  const Outcome outcome = run_program(
      "run " ABRADEM_SOURCE_DIR
      "/cases/drum-profile.toml --threads 1 --no-report -o out --set insertion.charge.number=300 --set "
      "insertion.charge.volume.radius='45 mm' --set 'insertion.charge.volume.base=[0,\"-5 mm\",\"-70 mm\"]' "
      "--set 'insertion.charge.volume.top=[0,\"5 mm\",\"-70 mm\"]' --set run.end='0.1 s' --set "
      "'wear.\"glass/steel\".wear_coefficient=1e-14 1/Pa'",
      scratch.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err.find("does not close"), std::string::npos) << outcome.err;
  const json ledger = json::parse(read_file(scratch.path() / "out/run.json"))["ledger"];
  EXPECT_GT(ledger["law_volume_mm3"].get<double>(), 0.0);
  EXPECT_GT(ledger["residual_relative"].get<double>(), 1e-9);
}

/// Fitted shapes are part of a checkpoint: a run goes on without the mesh to the bits of one that never
/// stopped.
TEST(Pebbles, GoOnWithoutTheirMesh) {
  const ScratchFolder scratch;
  const fs::path cases = ABRADEM_SOURCE_DIR "/cases";
  fs::create_directories(scratch.path() / "meshes");
  fs::copy_file(cases / "pebbles.toml", scratch.path() / "pebbles.toml");
  fs::copy_file(cases / "meshes/pebble.obj", scratch.path() / "meshes/pebble.obj");
  const std::string set = " --quiet --set output.every='10 ms' --set run.end=";
  const Outcome whole = run_program("run pebbles.toml -o whole" + set + "'40 ms'", scratch.path());
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  ASSERT_EQ(run_program("run pebbles.toml -o part" + set + "'20 ms'", scratch.path()).exit_code, 0);
  fs::remove(scratch.path() / "meshes/pebble.obj");
  const Outcome rest = run_program("resume part --quiet --set run.end='40 ms'", scratch.path());
  ASSERT_EQ(rest.exit_code, 0) << rest.err;
  const json record = json::parse(read_file(scratch.path() / "part/run.json"));
  EXPECT_EQ(record["state_hash"], json::parse(read_file(scratch.path() / "whole/run.json"))["state_hash"]);
  EXPECT_NE(record["setup"]["Shape 'pebble'"].get<std::string>().find("8 spheres for a solid of 49.33 mm^3"),
            std::string::npos);
  const std::string frame = read_file(scratch.path() / "whole/vtk/particles_0004.vtp");
  EXPECT_NE(frame.find("Name=\"clump\""), std::string::npos);
  EXPECT_NE(frame.find("Name=\"orientation\""), std::string::npos);
}

TEST(Pebbles, NeedAClosedMesh) {
  const ScratchFolder scratch;
  std::string mesh = read_file(ABRADEM_SOURCE_DIR "/cases/meshes/pebble.obj");
  mesh.resize(mesh.rfind("f "));
  std::ofstream(scratch.path() / "open.obj") << mesh;
  const Outcome outcome = run_program("run " ABRADEM_SOURCE_DIR
                                      "/cases/pebbles.toml --quiet -o out --set shape.pebble.fit.file=\"'" +
                                          (scratch.path() / "open.obj").string() + "'\"",
                                      scratch.path());
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("shape 'pebble': the mesh"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("is not closed (3 open edges"), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(scratch.path() / "out"));
}

/// Every grain strikes once, what the laws take leaves the mesh, and the report draws it.
TEST(ImpactPlate, RunsToItsEnd) {
  const ScratchFolder scratch;
  const Outcome outcome =
      run_program("run " ABRADEM_SOURCE_DIR "/cases/impact-plate.toml --quiet -o out", scratch.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const fs::path folder = scratch.path() / "out";
  const json record = json::parse(read_file(folder / "run.json"));
  const json& by_law = record["ledger"]["by_law"];
  EXPECT_EQ(record["walls"][0]["impacts"], 18);
  EXPECT_NEAR((by_law["finnie_mm3"].get<double>() + by_law["oka_mm3"].get<double>()) /
                  record["ledger"]["law_volume_mm3"].get<double>(),
              1.0, 1e-12);
  EXPECT_LT(record["ledger"]["residual_relative"].get<double>(), 1e-9);
  EXPECT_EQ(io::read_csv(folder / "tables" / "impacts.csv").rows(), 18u);
  EXPECT_GT(io::read_csv(folder / "tables" / "walls.csv").rows(), 0u);
  EXPECT_NE(read_file(folder / "report.html").find("fig-erosion-0"), std::string::npos);
}

}  // namespace
}  // namespace abradem::test
