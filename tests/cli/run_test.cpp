// SPDX-License-Identifier: BSD-3-Clause
// Whole runs through the real program: what comes out, what bad input gets, what is left when something ends
// a run early. The meshes are as small as they can be.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>
#include <vector>

#include "abradem/geometry/generators.h"
#include "abradem/io/csv.h"
#include "abradem/io/mesh_files.h"
#include "cli/program.h"
#include "support/case_texts.h"
#include "support/says.h"

namespace abradem::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const std::string kExample = ABRADEM_SOURCE_DIR "/cases/pin-on-disc.toml";
const std::string kCoarse = " --set wall.disc.mesh.size='0.5 mm'";
const std::string kShort = " --set run.end='0.02 rev' --set output.every='0.01 rev' --set output.contours=36";
const std::string kRun = "run " + kExample + kCoarse + kShort;

std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

json manifest(const fs::path& folder) { return json::parse(read_file(folder / "run.json")); }

const std::vector<std::string> kRevolutionColumns{
    "revolution",   "time_s",       "law_volume_mm3", "swept_volume_mm3", "paper_volume_mm3", "depth_mean_mm",
    "depth_sd_mm",  "depth_min_mm", "depth_max_mm",   "width_mean_mm",    "width_sd_mm",      "area_mean_mm2",
    "force_mean_N", "force_sd_N",   "force_min_N",    "force_max_N",      "depth_p_chi2",     "width_p_chi2"};

/// The columns that scripts rely on.
const std::map<std::string, std::vector<std::string>> kTables{
    {"revolutions", kRevolutionColumns},
    {"contours", {"revolution", "angle_deg", "depth_mm", "width_mm", "area_mm2", "displaced_width_mm"}},
    {"profiles", {"revolution", "angle_deg", "radius_mm", "height_mm"}},
    {"force",
     {"time_s", "revolution", "normal_force_N", "tangential_force_N", "overlap_um", "contacts",
      "normal_along_N", "normal_across_N", "normal_sum_N"}}};

io::CsvTable table(const fs::path& folder, const std::string& name) {
  return io::read_csv(folder / "tables" / (name + ".csv"));
}
std::size_t rows(const io::CsvTable& t) { return t.values.size() / t.columns.size(); }

/// Nothing is cut short, missing or left over.
void expect_whole(const fs::path& folder) {
  for (const char* name : {"case.toml", "case.resolved.toml", "run.log", "run.json"})
    EXPECT_TRUE(fs::is_regular_file(folder / name)) << name;
  for (const auto& [name, columns] : kTables) EXPECT_EQ(table(folder, name).columns, columns);
  EXPECT_NO_THROW((void)table(folder, "wear"));
  const std::string page = read_file(folder / "report.html");
  EXPECT_TRUE(contains(page.substr(page.size() - std::min<std::size_t>(page.size(), 20)), "</html>"));
  const std::string series = read_file(folder / "series.pvd");
  EXPECT_TRUE(contains(series, "</VTKFile>"));
  for (std::size_t at = series.find("file=\""); at != std::string::npos; at = series.find("file=\"", at)) {
    at += 6;
    const std::string frame = series.substr(at, series.find('"', at) - at);
    EXPECT_TRUE(contains(read_file(folder / frame), "</VTKFile>")) << frame;
  }
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    EXPECT_EQ(entry.path().string().find(".tmp"), std::string::npos) << entry.path();
}

// ---- what comes out
// ---------------------------------------------------------------------------------------------------

TEST(WholeRun, FillsTheFolderAsDocumented) {
  const ScratchFolder scratch;
  const fs::path folder = scratch.path() / "result";
  const Outcome outcome = run_program(kRun + " -o result", scratch.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_TRUE(contains(outcome.err, "kappa 1"));
  expect_whole(folder);
  EXPECT_EQ(rows(table(folder, "revolutions")), 2U);
  EXPECT_EQ(rows(table(folder, "contours")), 72U);
  EXPECT_GT(rows(table(folder, "force")), 100U);
  EXPECT_GT(rows(table(folder, "wear")), 0U);
  EXPECT_DOUBLE_EQ(table(folder, "revolutions").column("revolution").back(), 0.02);

  const json run = manifest(folder);
  for (const char* key : {"status", "exit_code", "version", "commit", "compiler", "threads", "seed", "steps",
                          "wall_seconds", "steps_per_second", "state_hash", "ledger", "results"})
    EXPECT_TRUE(run.contains(key)) << key;
  EXPECT_EQ(run["status"], "completed");
  EXPECT_EQ(run["exit_code"], 0);
  for (const char* key :
       {"law_volume_mm3", "deposited_volume_mm3", "swept_volume_mm3", "residual_relative", "kappa"})
    EXPECT_TRUE(run["ledger"][key].is_number()) << key;
  EXPECT_LT(run["ledger"]["residual_relative"].get<double>(), 1e-12);
  EXPECT_EQ(run["results"].size(), kRevolutionColumns.size());
  for (const std::string& name : kRevolutionColumns) EXPECT_TRUE(run["results"].contains(name)) << name;
  EXPECT_EQ(run["results"]["law_volume_mm3"], table(folder, "revolutions").column("law_volume_mm3").back());
}

TEST(WholeRun, ChoosesTheAccelerationAndSaysWhatItCost) {
  const ScratchFolder folder;
  const std::string coarse =
      "run " + kExample + kCoarse +
      " --set run.method=quasi_static --set output.contours=36 --set run.end='40 rev'"
      " --set output.frames=none --set 'wear.\"iron_ore/mild_steel\".wear_coefficient=2e-11'";
  const Outcome chosen = run_program(coarse +
                                         " --set 'wear.\"iron_ore/mild_steel\".acceleration=auto'"
                                         " --set 'wear.\"iron_ore/mild_steel\".tolerance=2 %' -o auto",
                                     folder.path());
  ASSERT_EQ(chosen.exit_code, 0) << chosen.err;
  EXPECT_TRUE(contains(chosen.err, "error accepted"));
  const json record = manifest(folder.path() / "auto");
  const json& acceleration = record["acceleration"];
  EXPECT_EQ(acceleration["chosen"], "auto");
  const double factor = acceleration["factor"];
  EXPECT_GT(factor, 1.0);
  EXPECT_DOUBLE_EQ(factor * acceleration["modelled_revolutions"].get<double>(), 40.0);
  EXPECT_LT(acceleration["profile_error"].get<double>(), 0.02);
  EXPECT_GE(acceleration["trials"].size(), 1u);
  EXPECT_NEAR(record["results"]["revolution"].get<double>(), 40.0, 1e-9);
  EXPECT_TRUE(contains(read_file(folder.path() / "auto" / "report.html"), "of the test per modelled one"));

  // The resolved case holds the number, and gives the same bits.
  const Outcome again = run_program("run auto/case.resolved.toml -o again", folder.path());
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(manifest(folder.path() / "again")["state_hash"], record["state_hash"]);
  EXPECT_DOUBLE_EQ(manifest(folder.path() / "again")["acceleration"]["factor"].get<double>(), factor);
}

/// Seconds chosen for hours: the log, run.json, the tables and the report agree on the time of the test.
TEST(WholeRun, ChoosesTheAccelerationOfManyParticles) {
  const ScratchFolder folder;
  const std::string chute = "run " ABRADEM_SOURCE_DIR
                            "/cases/liner-life.toml --threads 1 --set run.settle='0.2 s' --set run.end='2 h'"
                            " --set output.every='1 h' --set output.frames=ends";
  const Outcome chosen =
      run_program(chute + " --set 'wear.\"ore/steel\".tolerance=90 %' -o auto", folder.path());
  ASSERT_EQ(chosen.exit_code, 0) << chosen.err;
  for (const char* part : {"acceleration: 0.4 s, depths differ by", "the flow settles for 0.2 s",
                           "error accepted", "of the depths"})
    EXPECT_TRUE(contains(chosen.err, part)) << part << "\n" << chosen.err;
  const json record = manifest(folder.path() / "auto");
  const json& acceleration = record["acceleration"];
  const double factor = acceleration["factor"], modelled = acceleration["modelled_s"];
  EXPECT_DOUBLE_EQ(modelled, 0.4);
  EXPECT_NEAR(factor * modelled, 7200.0 - 0.2, 1e-9);
  EXPECT_LT(acceleration["map_error"].get<double>(), 0.9);
  for (const char* key : {"difference", "volume_difference", "noise"})
    EXPECT_GT(acceleration["trials"][0][key].get<double>(), 0.0) << key;
  EXPECT_EQ(record["settle_s"], 0.2);
  EXPECT_NEAR(record["results"]["time_s"].get<double>(), 7200.0, 1.0);
  EXPECT_EQ(table(folder.path() / "auto", "revolutions").column("law_volume_mm3")[0], 0.0);  // it has settled
  const io::CsvTable particles = table(folder.path() / "auto", "particles");
  EXPECT_NEAR(particles.column("time_s").back(), 7200.0, 1.0);
  EXPECT_NEAR(particles.column("modelled_time_s").back(), 0.6, 1e-3);
  // The rate of the test: depth over its two hours, of which the settling is next to nothing.
  const std::string places = read_file(folder.path() / "auto" / "tables" / "wear-places.csv");
  EXPECT_TRUE(contains(places, "worn through after [h]")) << places;
  const io::CsvTable wear = table(folder.path() / "auto", "wear");
  const double deepest_mm = 1e-3 * std::ranges::max(wear.column("wear_depth_um"));
  EXPECT_TRUE(contains(places, fmt::format(",{:.4g},", deepest_mm / 2.0))) << deepest_mm << "\n" << places;

  const Outcome again =
      run_program("run auto/case.resolved.toml --threads 1 --no-report -o again", folder.path());
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(manifest(folder.path() / "again")["state_hash"], record["state_hash"]);
}

TEST(WholeRun, WarnsOfAStreamThatDriesUpBeforeTheTestEnds) {
  const ScratchFolder folder;
  const Outcome outcome = run_program(
      "run " ABRADEM_SOURCE_DIR
      "/cases/liner-life.toml --threads 1 --no-report -o out --set run.settle='0.1 s' --set run.end='1 h' "
      "--set "
      "output.every='1 h' --set 'wear.\"ore/steel\".acceleration=1e5' --set insertion.feed.mass='0.1 kg'",
      folder.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "the wear is that of a stream that dries up")) << outcome.err;
}

TEST(WholeRun, WritesTheFramesThatAreAskedFor) {
  const ScratchFolder scratch;
  const auto frames = [&](const std::string& which) {
    const Outcome outcome =
        run_program(kRun + " -o " + which + " --set 'output.frames=" + which + "'", scratch.path());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const fs::path vtk = scratch.path() / which / "vtk";
    if (!fs::exists(vtk)) return std::ptrdiff_t{0};
    return std::count_if(fs::directory_iterator(vtk), {}, [](const fs::directory_entry& entry) {
      return entry.path().filename().string().starts_with("disc_");
    });
  };
  EXPECT_EQ(frames("all"), 3);  // the new surface and two outputs
  EXPECT_EQ(frames("ends"), 2);
  EXPECT_EQ(frames("none"), 0);
  EXPECT_FALSE(fs::exists(scratch.path() / "none" / "series.pvd"));
  EXPECT_EQ(read_file(scratch.path() / "none" / "tables" / "revolutions.csv"),
            read_file(scratch.path() / "all" / "tables" / "revolutions.csv"));
}

TEST(WholeRun, WarnsOfAGrooveOfFewTriangles) {
  const ScratchFolder scratch;
  const auto groove_of = [&](const std::string& size) {
    return run_program("run " + kExample + " --set wall.disc.mesh.size='" + size +
                           "' --set run.method=quasi_static --set run.end='2 rev' --set output.every='2 rev'"
                           " --set output.contours=36 --set output.frames=none --no-report --force -o result",
                       scratch.path());
  };
  const Outcome coarse = groove_of("0.25 mm");
  EXPECT_EQ(coarse.exit_code, 0);
  EXPECT_TRUE(contains(coarse.err, "triangles wide, fewer than 5"));
  EXPECT_EQ(manifest(scratch.path() / "result")["warnings"].size(), 1u);
  EXPECT_FALSE(contains(groove_of("0.1 mm").err, "triangles wide"));
}

TEST(WholeRun, JsonIsAllThatReachesStdout) {
  const ScratchFolder scratch;
  const Outcome outcome = run_program(kRun + " -o result --json", scratch.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, read_file(scratch.path() / "result" / "run.json"));
  EXPECT_TRUE(json::accept(outcome.out));
}

TEST(WholeRun, QuietIsQuiet) {
  const ScratchFolder scratch;
  const Outcome outcome = run_program(kRun + " --quiet -o result", scratch.path());
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, "");
}

TEST(WholeRun, GoesOnWithoutAReader) {
  const ScratchFolder scratch;
  EXPECT_EQ(run_program(kRun + " -o full 2>/dev/full", scratch.path()).exit_code, 0);
  expect_whole(scratch.path() / "full");
  // `abradem … 2>&1 | true`: the reader is gone before the run is done.
  const std::string piped = "{ '" ABRADEM_PROGRAM "' " + kRun + " -o piped; echo $? >code; } 2>&1 | true";
  EXPECT_EQ(
      run_program("--version >/dev/null", scratch.path(), piped + "; while [ ! -s code ]; do sleep 0.1; done")
          .exit_code,
      0);
  EXPECT_EQ(read_file(scratch.path() / "code"), "0\n");
  expect_whole(scratch.path() / "piped");
}

TEST(WholeRun, SameBitsForAnyNumberOfThreadsAndEveryTime) {
  const ScratchFolder scratch;
  const std::string methods[] = {"dynamic", "quasi_static"};
  for (const std::string& method : methods) {
    const std::string run = kRun + " --quiet --set run.method=" + method;
    const char* const variants[][2] = {{"one", "1"}, {"two", "2"}, {"again", "2"}};
    for (const auto& [name, threads] : variants)
      ASSERT_EQ(run_program(run + " -o " + method + name + " --threads " + threads, scratch.path()).exit_code,
                0);
    const fs::path first = scratch.path() / (method + "one");
    EXPECT_EQ(manifest(first)["threads"], 1);
    for (const char* other : {"two", "again"}) {
      const fs::path second = scratch.path() / (method + other);
      EXPECT_EQ(manifest(second)["threads"], 2);
      EXPECT_EQ(manifest(second)["state_hash"], manifest(first)["state_hash"]) << method << other;
      for (const char* name : {"revolutions", "contours", "profiles", "force", "wear"}) {
        const std::string file = std::string("tables/") + name + ".csv";
        EXPECT_TRUE(read_file(second / file) == read_file(first / file)) << method << other << ' ' << file;
      }
    }
  }
}

TEST(WholeRun, ForcedReplacesOnlyWhenTheNewCaseIsGood) {
  const ScratchFolder scratch;
  ASSERT_EQ(run_program(kRun + " --quiet -o result", scratch.path()).exit_code, 0);
  const std::string before = read_file(scratch.path() / "result" / "run.json");
  EXPECT_EQ(run_program(kRun + " --force -o result --set particle.pin.radius=-1", scratch.path()).exit_code,
            2);
  EXPECT_EQ(run_program(kRun + " -o result", scratch.path()).exit_code, 2);
  EXPECT_EQ(read_file(scratch.path() / "result" / "run.json"), before);
  expect_whole(scratch.path() / "result");
  EXPECT_EQ(run_program(kRun + " --quiet --force -o result --set run.seed=2", scratch.path()).exit_code, 0);
  EXPECT_EQ(manifest(scratch.path() / "result")["seed"], 2);
  expect_whole(scratch.path() / "result");
}

// ---- meshes from files
// ---------------------------------------------------------------------------------------------------

/// The example on a mesh file instead of a generated ring.
void write_case_with_mesh(const fs::path& path, const std::string& mesh) {
  std::string text = read_file(kExample);
  const std::size_t begin = text.find("\nmesh = ") + 1;
  write_file(path, text.replace(begin, text.find('\n', begin) - begin, "mesh = " + mesh));
}

geometry::TriangleMesh ring() { return geometry::make_annulus(0.020, 0.024, 0.0005, 1); }

TEST(MeshFile, OfTheGeneratedRingGivesTheSameRun) {
  const ScratchFolder scratch;
  io::write_stl(scratch.path() / "ring.stl", ring(), 1e-3);
  write_case_with_mesh(scratch.path() / "case.toml", "{ file = \"ring.stl\", unit = \"mm\" }");
  const Outcome from_file = run_program("run case.toml --quiet -o file" + kShort, scratch.path());
  ASSERT_EQ(from_file.exit_code, 0) << from_file.err;
  EXPECT_EQ(from_file.err, "");
  ASSERT_EQ(run_program(kRun + " --quiet -o generated", scratch.path()).exit_code, 0);
  const json a = manifest(scratch.path() / "file"), b = manifest(scratch.path() / "generated");
  // STL holds single precision: positions to 1e-6 mm.
  constexpr double kSingle = 1e-5;
  for (const char* name : {"law_volume_mm3", "swept_volume_mm3", "force_mean_N", "depth_max_mm"}) {
    const double expected = b["results"][name].get<double>();
    EXPECT_GT(expected, 0.0) << name;
    EXPECT_NEAR(a["results"][name].get<double>() / expected, 1.0, kSingle) << name;
  }
}

class BadMeshFile : public testing::Test {
 protected:
  /// Runs the example on mesh.stl: one message, this code, no folder.
  void refused(int exit_code, const std::string& message, const std::string& more = "") {
    const Outcome outcome = run_program("run case.toml -o result " + more, scratch_.path());
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_TRUE(contains(outcome.err, message));
    EXPECT_EQ(occurrences(outcome.err, "error:"), 1U) << outcome.err;
    EXPECT_FALSE(fs::exists(scratch_.path() / "result"));
  }
  void SetUp() override {
    write_case_with_mesh(scratch_.path() / "case.toml", "{ file = \"mesh.stl\", unit = \"mm\" }");
    io::write_stl(mesh_, ring(), 1e-3);
  }
  ScratchFolder scratch_;
  fs::path mesh_ = scratch_.path() / "mesh.stl";
};

TEST_F(BadMeshFile, Missing) {
  fs::remove(mesh_);
  refused(2, "mesh.stl' does not exist");
}

TEST_F(BadMeshFile, Folder) {
  fs::remove(mesh_);
  fs::create_directory(mesh_);
  refused(2, "mesh.stl' is a folder; expected a mesh file");
}

TEST_F(BadMeshFile, Empty) {
  write_file(mesh_, "");
  refused(3, "mesh.stl': the file is empty");
}

TEST_F(BadMeshFile, Truncated) {
  fs::resize_file(mesh_, 20000);
  refused(3, "truncated, or not an STL file");
}

TEST_F(BadMeshFile, ClaimingFourThousandMillionTriangles) {
  std::string data = read_file(mesh_);
  data.replace(80, 4, std::string("\x00\x28\x6b\xee", 4));
  write_file(mesh_, data);
  refused(3, "it states 4000000000 triangles, which need 200000000084 bytes");
}

TEST_F(BadMeshFile, OfManyGigabytes) {
  std::error_code error;
  fs::resize_file(mesh_, 7'000'000'000, error);  // sparse: takes no space
  ASSERT_FALSE(error) << error.message();
  refused(3, "it has 7000000000 bytes");
}

TEST_F(BadMeshFile, ThatIsText) {
  write_file(mesh_, "solid\nthis is no mesh\n");
  refused(3, "mesh.stl");
}

TEST_F(BadMeshFile, WithAHole) {
  geometry::TriangleMesh mesh = ring();
  // One whose three vertices are all away from the border.
  const auto inner = [&](geometry::Index v) {
    const double r = norm(mesh.vertices[static_cast<std::size_t>(v)]);
    return r > 0.0212 && r < 0.0228;
  };
  const auto one = std::ranges::find_if(
      mesh.triangles, [&](const geometry::Triangle& t) { return inner(t[0]) && inner(t[1]) && inner(t[2]); });
  ASSERT_NE(one, mesh.triangles.end());
  mesh.triangles.erase(one);
  io::write_stl(mesh_, mesh, 1e-3);
  refused(3, "1 small hole");
}

TEST_F(BadMeshFile, InMetresReadAsMillimetres) {
  io::write_stl(mesh_, ring(), 1.0);
  refused(3, "probably read in the wrong unit");
}

TEST_F(BadMeshFile, InMillimetresReadAsMetres) {
  refused(3, "probably read in the wrong unit", "--set wall.disc.mesh.unit=m");
}

TEST_F(BadMeshFile, UnderAPinThatIsSomewhereElse) {
  const auto pin_at = [](const std::string& x, const std::string& z) {
    return "--set 'particle.pin.position=[\"" + x + "\", 0, \"" + z + "\"]'";
  };
  refused(2, "'pin' starts 1 mm deep in wall 'disc'", pin_at("22 mm", "2 mm"));
  refused(2, "the centre of 'pin' is 2 mm below the surface of wall 'disc'", pin_at("22 mm", "-2 mm"));
  refused(2, "the centre of 'pin' is 40 mm below the surface", pin_at("22 mm", "-40 mm"));
  refused(2, "'pin' hangs 27 mm above wall 'disc'", pin_at("22 mm", "30 mm"));
  refused(2, "'pin' is not above any wall", pin_at("40 mm", "3 mm"));
}

TEST_F(BadMeshFile, UpsideDown) {
  geometry::TriangleMesh mesh = ring();
  for (geometry::Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  io::write_stl(mesh_, mesh, 1e-3);
  refused(2, "turn the normals of the mesh round");
}

// ---- bad cases
// ---------------------------------------------------------------------------------------------------

TEST(BadCase, GetsOneMessageAndLeavesNothing) {
  const ScratchFolder scratch;
  const auto refused = [&](const std::string& arguments, const std::string& message) {
    const Outcome outcome = run_program("run " + arguments + " -o result/below", scratch.path());
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_TRUE(contains(outcome.err, message)) << arguments;
    EXPECT_EQ(occurrences(outcome.err, "error:"), 1U) << outcome.err;
    EXPECT_TRUE(fs::is_empty(scratch.path())) << arguments;
  };
  const auto with = [](const std::string& assignment) { return kExample + " --set '" + assignment + "'"; };
  refused("missing.toml", "case file 'missing.toml' does not exist");
  refused(".", "'.' is a folder; expected a case file");
  refused("/dev/null", "'/dev/null' is empty");
  refused(with("particle.pin.radius=3 N"), "expected a length such as \"3 mm\", got \"3 N\" (a force)");
  refused(with("particle.pin.radius=nan"), "nan is not a finite number");
  refused(with("particle.pin.radius=\"nan mm\""), "'nan' is not a finite number");
  refused(with("particle.pin.load=inf"), "not a finite number");
  refused(with("particle.pin.radius=-3e-3"), "must be > 0, got -0.003");
  refused(with("particle.pin.radius=3"), "was \"3 mm\" meant?");
  refused(with("particle.pin.position=[\"22 mm\", 0, \"2 mm\"]"), "'pin' starts 1 mm deep in wall 'disc'");
  refused(with("particle.pin.position=[\"22 mm\", 0, \"-1 mm\"]"), "1 mm below the surface of wall 'disc'");
  refused(with("particle.pin.position=[\"22 mm\", 0, \"1 m\"]"),
          "above wall 'disc'; its guide only lets it drop");
  refused(with("particle.pin.position=[\"32 mm\", 0, \"3 mm\"]"), "it misses wall 'disc' by 8 mm sideways");
  refused(with("wall.disc.mesh.size=1e-9"), "make size at least");
  refused(with("run.end=1e300"), "1e15");
  refused(with("run.time_step=\"1e-30 s\""), "1e15");
}

// ---- folders that cannot take the output
// ---------------------------------------------------------------------------------------------------

TEST(BadFolder, IsNamedAndNothingIsLeft) {
  const ScratchFolder scratch;
  write_file(scratch.path() / "file", "mine");
  const auto refused = [&](const std::string& folder, int exit_code, const std::string& message) {
    const Outcome outcome = run_program(kRun + " -o '" + folder + "'", scratch.path());
    EXPECT_EQ(outcome.exit_code, exit_code) << folder;
    EXPECT_TRUE(contains(outcome.err, message));
    EXPECT_EQ(occurrences(outcome.err, "error:"), 1U) << outcome.err;
  };
  refused("file", 2, "output folder 'file' is a file");
  refused("file/below", 5, "cannot create the output folder 'file/below': Not a directory");
  refused("/dev/null", 2, "output folder '/dev/null' is a file");
  refused("/proc/abradem/result", 5, "cannot create the output folder '/proc/abradem/result'");
  refused(std::string(300, 'x'), 5, "File name too long");
  EXPECT_EQ(read_file(scratch.path() / "file"), "mine");
  EXPECT_EQ(std::distance(fs::directory_iterator(scratch.path()), fs::directory_iterator{}), 1);
}

TEST(FullDisk, BeforeTheFirstFrameLeavesNoFolder) {
  const ScratchFolder scratch;
  // A limit on the size of files stands for a full disk; the first frame has 68 kB.
  const Outcome outcome = run_program(kRun + " --quiet -o some/where/deep", scratch.path(), "ulimit -f 40");
  EXPECT_EQ(outcome.exit_code, 5);
  EXPECT_TRUE(contains(outcome.err, "cannot write 'some/where/deep/vtk/disc_0000.vtp': File too large"));
  EXPECT_EQ(occurrences(outcome.err, "\n"), 1U) << outcome.err;
  EXPECT_TRUE(fs::is_empty(scratch.path()));
}

TEST(FullDisk, LaterKeepsWhatWasWritten) {
  const ScratchFolder scratch;
  const fs::path folder = scratch.path() / "result";
  // Room for frames and tables, none for the report (770 kB).
  const Outcome outcome = run_program(kRun + " --quiet -o result", scratch.path(), "ulimit -f 1000");
  EXPECT_EQ(outcome.exit_code, 5);
  EXPECT_TRUE(contains(outcome.err, "cannot write 'result/report.html'"));
  EXPECT_EQ(occurrences(outcome.err, "\n"), 1U) << outcome.err;
  const json run = manifest(folder);
  EXPECT_EQ(run["status"], "failed");
  EXPECT_EQ(run["exit_code"], 5);
  EXPECT_TRUE(contains(run["error"].get<std::string>(), "cannot write 'result/report.html'"));
  EXPECT_FALSE(fs::exists(folder / "report.html"));
  EXPECT_EQ(rows(table(folder, "revolutions")), 2U);
  // With room again, the report is made from what is there.
  EXPECT_EQ(run_program("report result", scratch.path()).exit_code, 0);
  expect_whole(folder);
}

// ---- runs that end early
// ---------------------------------------------------------------------------------------------------

TEST(Unphysical, KeepsTheRowsSoFar) {
  const ScratchFolder scratch;
  const fs::path folder = scratch.path() / "result";
  // The pin is shot at the disc: nothing happens for two outputs, then it goes in too deep.
  const Outcome outcome =
      run_program(kRun +
                      " --quiet -o result --json --set 'particle.pin.position=[\"22 mm\", 0, \"4.4 mm\"]'"
                      " --set 'particle.pin.velocity=[0, 0, \"-15 m/s\"]' --set run.end='1 ms' --set "
                      "output.every='0.02 ms'",
                  scratch.path());
  EXPECT_EQ(outcome.exit_code, 4);
  EXPECT_TRUE(contains(outcome.err, "abradem: error: particle 'pin', step "));
  EXPECT_TRUE(contains(outcome.err, "more than a tenth of its radius"));
  EXPECT_EQ(occurrences(outcome.err, "error:"), 1U) << outcome.err;
  const json run = manifest(folder);
  EXPECT_EQ(json::parse(outcome.out), run);
  EXPECT_EQ(run["status"], "failed");
  EXPECT_EQ(run["exit_code"], 4);
  EXPECT_TRUE(contains(run["error"].get<std::string>(), "more than a tenth of its radius"));
  expect_whole(folder);
  EXPECT_GE(rows(table(folder, "revolutions")), 2U);
  EXPECT_EQ(run["results"]["time_s"], table(folder, "revolutions").column("time_s").back());
}

// The load throws the pin through the disc in the first step, without ever touching it.
TEST(Unphysical, AtTheFirstStepIsAWholeFolderToo) {
  const ScratchFolder scratch;
  const Outcome outcome =
      run_program(kRun + " --quiet -o result --set 'particle.pin.load=50 kN'", scratch.path());
  EXPECT_EQ(outcome.exit_code, 4);
  EXPECT_TRUE(contains(outcome.err, "it has left the walls"));
  EXPECT_EQ(manifest(scratch.path() / "result")["status"], "failed");
  expect_whole(scratch.path() / "result");
  EXPECT_EQ(rows(table(scratch.path() / "result", "revolutions")), 0U);
}

/// Starts a run that would take minutes, sends the signal after two outputs. @return the exit code
int interrupt(const fs::path& scratch, int signal) {
  const std::string command = "cd '" + scratch.string() + "' && exec '" ABRADEM_PROGRAM "' run " + kExample +
                              kCoarse +
                              " --quiet -o result --set run.end='1000 rev'"
                              " --set output.every='0.02 rev' --set output.contours=36";
  const pid_t child = ::fork();
  if (child == 0) {
    ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    ::_exit(127);
  }
  for (int i = 0; i < 1200 && !fs::exists(scratch / "result" / "vtk" / "disc_0002.vtp"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  ::kill(child, signal);
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
}

TEST(Interrupted, ByCtrlCOrAPoliteKillLeavesAWholeFolder) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const ScratchFolder scratch;
    EXPECT_EQ(interrupt(scratch.path(), signal), 130);
    const fs::path folder = scratch.path() / "result";
    const json run = manifest(folder);
    EXPECT_EQ(run["status"], "interrupted");
    EXPECT_EQ(run["exit_code"], 130);
    expect_whole(folder);
    EXPECT_GE(rows(table(folder, "revolutions")), 2U);
    // The last row is where it stopped.
    EXPECT_EQ(run["results"]["time_s"], table(folder, "revolutions").column("time_s").back());
    EXPECT_EQ(run["results"]["law_volume_mm3"], run["ledger"]["law_volume_mm3"]);
  }
}

/// Clumps as they were given, by name and in numbers: a mesh file's unit is not judged by a radius that no
/// key states.
TEST(MeshFile, UnderClumpsAsTheyWereGiven) {
  const ScratchFolder scratch;
  write_file(scratch.path() / "plate.obj", "v -10 -10 0\nv 10 -10 0\nv 10 10 0\nv -10 10 0\nf 1 2 3 4\n");
  write_file(scratch.path() / "rocks.toml", std::string(kGlass) + R"([wall.plate]
material = "glass"
mesh = { file = "plate.obj", unit = "mm" }
[shape.rock]
spheres = [{ position = [0, 0, 0], radius = "1.5 mm" }, { position = ["2 mm", 0, 0], radius = "1 mm" }]
[particle.rock]
material = "glass"
shape = "rock"
position = [0, 0, "3 mm"]
velocity = [0, 0, "-1 m/s"]
[insertion.rocks]
material = "glass"
shape = "rock"
number = 2
volume = { low = ["-8 mm", "-8 mm", "6 mm"], high = ["8 mm", "8 mm", "14 mm"] }
[run]
end = "2 ms"
)");
  const Outcome run = run_program("run rocks.toml -o out --quiet", scratch.path());
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(table(scratch.path() / "out", "particles").column("particles").back(), 3.0);
}

}  // namespace
}  // namespace abradem::test
