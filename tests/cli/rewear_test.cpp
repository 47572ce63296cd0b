// SPDX-License-Identifier: BSD-3-Clause
// Wear by other laws from the record of a run, against runs by those laws. docs/verification/wear.md#rewear
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>

#include "abradem/io/csv.h"
#include "cli/program.h"
#include "support/case_texts.h"
#include "support/says.h"

namespace abradem::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// The transfer chute on a rigid liner with the wear given here, and a region.
void run_chute(const fs::path& folder, const std::string& name, const std::string& wear) {
  std::string text = transfer_chute(wear);
  text = replaced(text, "poisson_ratio = 0.30", "poisson_ratio = 0.30\nhardness = \"143 HV\"");
  text = replaced(text, "deformation = \"conserving\"", "deformation = \"none\"");
  text +=
      "\n[region.inlet]\nwall = \"liner\"\nlow = [\"-200 mm\", \"-200 mm\", \"-200 mm\"]\n"
      "high = [\"-20 mm\", \"200 mm\", \"200 mm\"]\n";
  write_file(folder / (name + ".toml"), text);
  const Outcome run =
      run_program("run " + name + ".toml -o " + name +
                      " --quiet --no-report --set run.end=\"0.15 s\" --set output.frames=none",
                  folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
}

using ByElement = std::map<std::pair<double, double>, double>;
ByElement elements(const fs::path& file, const std::string& column) {
  const io::CsvTable table = io::read_csv(file);
  const auto wall = table.column("wall"), element = table.column("element"), value = table.column(column);
  ByElement out;
  for (std::size_t r = 0; r < value.size(); ++r)
    if (value[r] != 0.0) out[{wall[r], element[r]}] = value[r];
  return out;
}
/// Difference of the fields over the size of the first, L2.
double difference(const ByElement& expected, const ByElement& found) {
  double d = 0.0, size = 0.0;
  for (const auto& [key, v] : expected) {
    const auto other = found.find(key);
    d += std::pow((other == found.end() ? 0.0 : other->second) - v, 2), size += v * v;
  }
  return std::sqrt(d / size);
}

TEST(Rewear, FindsWhatRunsByOtherLawsFind) {
  const ScratchFolder scratch;
  const fs::path& folder = scratch.path();
  run_chute(folder, "archard", "wear_coefficient = \"1e-12 1/Pa\"");
  run_chute(folder, "work",
            "law = [\"shear_work\", \"impact_energy\"]\nshear_work_coefficient = \"0.002 mm^3/J\"\n"
            "normal_energy_coefficient = \"0.001 mm^3/J\"\nshear_energy_coefficient = \"0.0005 mm^3/J\"");
  run_chute(folder, "impacts", "law = [\"finnie\", \"oka\"]\nfinnie_coefficient = \"1e-10 1/Pa\"");
  const auto rewear = [&](const std::string& arguments) {
    const Outcome out = run_program("rewear " + arguments + " --json", folder);
    EXPECT_EQ(out.exit_code, 0) << out.err;
    return out.exit_code == 0 ? json::parse(out.out) : json{};
  };
  const auto total = [](const json& result, const char* key) {
    double sum = 0.0;
    for (const json& r : result.at("regions")) sum += r.at(key).get<double>();
    return sum;
  };
  const auto of_run = [&](const char* name, const char* key) {
    const json run = json::parse(read_file(folder / name / "run.json"));
    double sum = 0.0;
    for (const json& w : run.at("walls")) sum += w.at("law_volume").at(key).get<double>();
    return sum;
  };

  // Laws by work, each from the run of the other: to round-off, in all and in every element.
  const json archard =
      rewear("work --law archard --name a --set 'wear.\"ore/steel\".wear_coefficient=1e-12 1/Pa'");
  const json ledger = json::parse(read_file(folder / "archard/run.json")).at("ledger");
  // JSON of the command line has nine digits.
  EXPECT_NEAR(total(archard, "archard_mm3") / ledger.at("law_volume_mm3").get<double>(), 1.0, 1e-8);
  EXPECT_LT(difference(elements(folder / "archard/tables/wear.csv", "wear_volume_mm3"),
                       elements(folder / "work/tables/rewear_a.csv", "wear_volume_mm3")),
            1e-12);
  for (const json& r : archard.at("regions")) EXPECT_TRUE(r.at("exact").get<bool>());
  rewear(
      "archard --law shear_work,impact_energy --name w "
      "--set 'wear.\"ore/steel\".shear_work_coefficient=0.002 mm^3/J' "
      "--set 'wear.\"ore/steel\".normal_energy_coefficient=0.001 mm^3/J' "
      "--set 'wear.\"ore/steel\".shear_energy_coefficient=0.0005 mm^3/J'");
  for (const char* column : {"wear_volume_mm3", "shear_work_mm3", "impact_energy_mm3"})
    EXPECT_LT(difference(elements(folder / "work/tables/wear.csv", column),
                         elements(folder / "archard/tables/rewear_w.csv", column)),
              1e-12)
        << column;

  // Laws by impacts from classes: totals to the width of the classes, elements by their mean impact.
  const json impacts =
      rewear("archard --law finnie,oka --name i --set 'wear.\"ore/steel\".finnie_coefficient=1e-10 1/Pa'");
  for (const char* column : {"finnie_mm3", "oka_mm3"}) {
    const double error = std::abs(total(impacts, column) / of_run("impacts", column) - 1.0);
    const double field = difference(elements(folder / "impacts/tables/wear.csv", column),
                                    elements(folder / "archard/tables/rewear_i.csv", column));
    RecordProperty(std::string(column) + "_total", std::to_string(1e6 * error) + "e-6");
    RecordProperty(std::string(column) + "_elements", std::to_string(field));
    EXPECT_LT(error, 1e-3) << column;
    EXPECT_LT(field, 0.1) << column;
  }
  // Another coefficient of the run's own law: exact again.
  const json twice = rewear("impacts --name t --set 'wear.\"ore/steel\".finnie_coefficient=2e-10 1/Pa'");
  EXPECT_NEAR(total(twice, "finnie_mm3") / (2.0 * of_run("impacts", "finnie_mm3")), 1.0, 1e-8);
  EXPECT_TRUE(twice.at("regions")[0].at("exact").get<bool>());
  for (const char* file :
       {"rewear_t.html", "rewear_t.case.toml", "tables/rewear_t_regions.csv", "tables/rewear_t_worst.csv"})
    EXPECT_TRUE(fs::exists(folder / "impacts" / file)) << file;
}

TEST(Rewear, RefusesWhatItCannotDo) {
  const ScratchFolder scratch;
  const fs::path& folder = scratch.path();
  run_chute(folder, "run", "wear_coefficient = \"1e-12 1/Pa\"");
  const auto refused = [&](const std::string& arguments, const std::string& words, int code = 2) {
    const Outcome out = run_program("rewear " + arguments, folder);
    EXPECT_EQ(out.exit_code, code) << arguments;
    EXPECT_TRUE(contains(out.err, words));
  };
  refused("run --law finie", "did you mean 'finnie'?");
  refused("run --law shear_work", "shear_work_coefficient=0.001 mm^3/J");
  refused("run --law expression", "the run has no expression");
  refused("run --pair ore/ore --law archard", "no such [wear] pair");
  refused("run --pair ore/steel", "give --law");
  refused("run --set run.end=1s", "keys of [wear] alone");
  refused("run --set 'wear.\"ore/steel\".tolerance=\"2 %\"'", "nothing else");
  refused("run --name ../x", "use letters, digits");
  refused("nowhere", "no such folder", 5);
  EXPECT_EQ(run_program("rewear run --name x --quiet", folder).exit_code, 0);
  refused("run --name x", "use another --name");
  fs::remove(folder / "run/tables/wear_integrals.csv");
  refused("run", "output.maps=on");
}

}  // namespace
}  // namespace abradem::test
