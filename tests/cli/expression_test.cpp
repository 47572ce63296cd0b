// SPDX-License-Identifier: BSD-3-Clause
// A wear law by an expression, from the case to the tables. docs/theory/wear.md#expression
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "abradem/io/csv.h"
#include "cli/program.h"
#include "support/case_texts.h"
#include "support/says.h"

namespace abradem::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// The transfer chute with the wear given here, and a plane that it wears too.
void write_chute(const fs::path& file, const std::string& wear) {
  write_file(file, transfer_chute(wear) +
                       "\n[wall.floor]\nmaterial = \"steel\"\n"
                       "mesh = { shape = \"plane\", position = [0, 0, \"30 mm\"], normal = [0.2, 0, 1] }\n");
}
Outcome run(const fs::path& folder, const std::string& name, const std::string& rest = "") {
  return run_program("run " + name + ".toml -o " + name +
                         " --quiet --set run.end=\"0.15 s\" --set output.frames=ends " + rest,
                     folder);
}

TEST(Expression, GoesThroughTablesReportAndRewear) {
  const ScratchFolder scratch;
  const fs::path& folder = scratch.path();
  write_chute(folder / "chute.toml",
              "law = [\"archard\", \"expression\"]\nwear_coefficient = \"1e-8 1/Pa\"\n"
              "expression = \"C * shear_work\"\nconstants = { C = \"20 mm^3/J\" }");
  const Outcome made = run(folder, "chute");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const json record = json::parse(read_file(folder / "chute/run.json"));
  const json& ledger = record.at("ledger");
  const double by_expression = ledger.at("by_law").at("expression_mm3").get<double>();
  EXPECT_GT(by_expression, 0.0);
  // The ledger counts meshes; the plane's volume stands apart, and both together are what the laws took.
  const double planes = ledger.at("planes_law_volume_mm3").get<double>();
  EXPECT_GT(planes, 0.0);
  EXPECT_NEAR((ledger.at("law_volume_mm3").get<double>() + planes) /
                  (by_expression + ledger.at("by_law").at("archard_mm3").get<double>()),
              1.0, 1e-12);
  EXPECT_LT(ledger.at("residual_relative").get<double>(), 1e-9);
  EXPECT_TRUE(contains(read_file(folder / "chute/run.log"), "on planes)"));
  EXPECT_TRUE(contains(read_file(folder / "chute/run.log"), "analytic planes, which keep their shape: law "));

  // Element by element it is C times the work of friction.
  const io::CsvTable wear = io::read_csv(folder / "chute/tables/wear.csv");
  const auto volume = wear.column("expression_mm3"), work = wear.column("shear_work_J");
  double sum = 0.0;
  for (std::size_t r = 0; r < volume.size(); ++r) {
    sum += volume[r];
    EXPECT_NEAR(volume[r], 20.0 * work[r], 1e-9 * volume[r]);
  }
  EXPECT_GT(sum, 0.0);
  EXPECT_GT(io::read_csv(folder / "chute/tables/wear_by_law.csv").column("expression_mm3").back(), 0.0);
  EXPECT_TRUE(contains(read_file(folder / "chute/report.html"), "expression [mm³]"));

  // rewear: it stays, is left out, or is another.
  const auto rewear = [&](const std::string& arguments) {
    const Outcome out = run_program("rewear chute --json " + arguments, folder);
    EXPECT_EQ(out.exit_code, 0) << out.err;
    double archard = 0.0, expression = 0.0;
    const json found = out.exit_code == 0 ? json::parse(out.out) : json{{"regions", json::array()}};
    for (const json& r : found.at("regions")) {
      archard += r.at("archard_mm3").get<double>();
      expression += r.at("expression_mm3").get<double>();
    }
    return std::pair(archard, expression);
  };
  const auto [once, kept] = rewear("--name same");
  const auto [twice, still] = rewear("--name twice --set 'wear.\"ore/steel\".wear_coefficient=2e-8 1/Pa'");
  const auto [alone, none] = rewear("--name alone --law archard");
  EXPECT_NEAR(twice / once, 2.0, 1e-7);
  EXPECT_NEAR(kept / sum, 1.0, 1e-7);
  EXPECT_EQ(still, kept);
  EXPECT_EQ(alone, once);
  EXPECT_EQ(none, 0.0);
  const auto [as_before, doubled] =
      rewear("--name other --set 'wear.\"ore/steel\".expression=2 * C * shear_work'");
  EXPECT_EQ(as_before, once);
  EXPECT_NEAR(doubled / kept, 2.0, 1e-7);  // a sum of what the map keeps
  for (const auto& [expression, words] :
       {std::pair("C * Fn * v_slide * dt", "dt counts there too"),
        std::pair("C * sqrt(normal_work * shear_work)", "have no normal_work"),
        std::pair("C * shear_work * a / R", "want spheres of one size"),
        std::pair("C * Fn * a", "depends on the time step")}) {
    const Outcome refused = run_program(
        "rewear chute --set 'wear.\"ore/steel\".expression=" + std::string(expression) + "'", folder);
    EXPECT_EQ(refused.exit_code, 2) << expression;
    EXPECT_TRUE(contains(refused.err, words));
  }

  // Tables of a version that knew no expressions.
  for (const char* name : {"wear_by_law.csv", "wear_integrals.csv"}) {
    const fs::path file = folder / "chute/tables" / name;
    std::string text = read_file(file);
    const std::size_t at = text.find("expression_mm3");
    ASSERT_NE(at, std::string::npos);
    write_file(file, text.replace(at, 14, "other_mm3"));
  }
  EXPECT_EQ(run_program("report chute", folder).exit_code, 0);
  EXPECT_EQ(rewear("--name old").second, 0.0);
}

/// Expressions from the record of a run by Archard's law, against runs by them.
/// docs/verification/wear.md#rewear
TEST(Expression, IsWorkedOutFromTheRecordOfAnotherLaw) {
  const ScratchFolder scratch;
  const fs::path& folder = scratch.path();
  const auto make = [&](const std::string& name, const std::string& wear) {
    write_chute(folder / (name + ".toml"), wear);
    const Outcome made = run(folder, name,
                             "--no-report --set wall.liner.deformation=none --set "
                             "'insertion.feed.size={ radius = \"4 mm\" }'");
    ASSERT_EQ(made.exit_code, 0) << made.err;
  };
  make("archard", "wear_coefficient = \"1e-9 1/Pa\"");
  const std::string constants =
      "{ k = \"1e-9 1/Pa\", F0 = \"0.3 N\", v0 = \"1 m/s\", p0 = \"10 MPa\", C = \"1 mm^3/J\" }";
  for (const auto& [name, expression] :
       {std::pair("threshold", "k * max(0, Fn - F0) * slip"),
        std::pair("sum", "k * Fn * slip + C * (shear_work + 3 * normal_work)"),
        std::pair("rate", "k * Fn * slip * (slip / (v0 * dt))^0.5"),
        std::pair("speed", "k * Fn * slip * (v_slide / v0)^1.5"),
        std::pair("pressure", "k * p_max / p0 * shear_work"),
        std::pair("impacts", "k * m * v^2 * (sin(angle) * v / v0)^1.3")}) {
    make(name,
         "law = \"expression\"\nexpression = \"" + std::string(expression) + "\"\nconstants = " + constants);
    const Outcome out = run_program("rewear archard --json --law expression --name " + std::string(name) +
                                        " --set 'wear.\"ore/steel\".expression=" + expression +
                                        "' --set 'wear.\"ore/steel\".constants=" + constants + "'",
                                    folder);
    ASSERT_EQ(out.exit_code, 0) << out.err;
    const json result = json::parse(out.out), record = json::parse(read_file(folder / name / "run.json"));
    double found = 0.0, expected = 0.0;
    for (const json& r : result.at("regions")) {
      found += r.at("expression_mm3").get<double>();
      EXPECT_EQ(r.at("exact").get<bool>(), std::string(name) == "sum");
    }
    for (const json& w : record.at("walls"))
      if (w.at("name") != "floor") expected += w.at("law_volume").at("expression_mm3").get<double>();
    const double error = std::abs(found / expected - 1.0);
    RecordProperty(name, std::to_string(1e6 * error) + "e-6");
    // Speeds may cluster anywhere in a class of 12.5 %; forces and pressures spread over many.
    const std::map<std::string, double> allowed{{"speed", 0.02}, {"rate", 0.02}, {"sum", 1e-8}};
    EXPECT_LT(error, allowed.contains(name) ? allowed.at(name) : 0.002) << name;
  }
}

TEST(Expression, IsRefusedBeforeTheRunOrStopsIt) {
  const ScratchFolder scratch;
  const fs::path& folder = scratch.path();
  const auto law = [](const std::string& expression) {
    return "law = \"expression\"\nexpression = \"" + expression +
           "\"\nconstants = { k = \"1e-12 1/Pa\", v0 = \"1 mm/s\" }";
  };
  write_chute(folder / "unknown.toml", law("k * Fn * slipp"));
  const Outcome unknown = run(folder, "unknown");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_TRUE(contains(unknown.err, "unknown name 'slipp' at character 10, did you mean 'slip'?"));
  EXPECT_FALSE(fs::exists(folder / "unknown"));

  write_chute(folder / "negative.toml", law("k * Fn * slip * (1 - v_slide / v0)"));
  const Outcome negative = run(folder, "negative");
  EXPECT_EQ(negative.exit_code, 4) << negative.err;
  EXPECT_TRUE(contains(negative.err, "wear \"ore/steel\": the expression gives -"));
  EXPECT_TRUE(contains(negative.err, "where Fn = "));
}

/// Killed and resumed it goes on to the same bits.
TEST(Expression, IsResumed) {
  const ScratchFolder scratch;
  const fs::path& folder = scratch.path();
  write_chute(folder / "whole.toml",
              "law = \"expression\"\nexpression = \"k * p_mean / H * Fn * slip\"\nconstants = { k = \"1e-9 "
              "1/Pa\", H = "
              "\"1 GPa\" }");
  EXPECT_EQ(run(folder, "whole").exit_code, 2);  // H is a name of its own
  write_chute(folder / "whole.toml",
              "law = \"expression\"\nexpression = \"k * p_mean / p0 * Fn * slip\"\nconstants = { k = \"1e-9 "
              "1/Pa\", p0 "
              "= \"1 GPa\" }");
  ASSERT_EQ(run(folder, "whole").exit_code, 0);
  fs::copy_file(folder / "whole.toml", folder / "part.toml");
  const Outcome part = run_program(
      "run part.toml -o part --quiet --no-report --set run.end=\"0.1 s\" --set output.frames=ends", folder);
  ASSERT_EQ(part.exit_code, 0) << part.err;
  const Outcome resumed = run_program("resume part --quiet --no-report --set run.end=\"0.15 s\"", folder);
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  const auto hash = [&](const char* name) {
    const json record = json::parse(read_file(folder / name / "run.json"));
    return std::pair(record.at("state_hash"), record.at("ledger").at("law_volume_mm3"));
  };
  EXPECT_EQ(hash("whole"), hash("part"));
}

}  // namespace
}  // namespace abradem::test
