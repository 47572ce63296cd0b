// SPDX-License-Identifier: BSD-3-Clause
// The ready cases of bulk equipment, made so small that they take a moment: they run to their end, what comes
// in is accounted for, and where a wall wears the ledger closes.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "abradem/io/csv.h"
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
        ReadyCase{"rotating-drum",
                  "--set insertion.charge.number=60 --set run.end='0.07 rev' --set output.every='0.01 rev'",
                  true},
        ReadyCase{"angle-of-repose", "--set run.end='0.12 s' --set output.every='20 ms'"},
        ReadyCase{"pebbles", "--set run.end='0.1 s' --set output.every='20 ms'"}));

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
