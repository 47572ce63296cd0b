// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/report/sweep_table.h"

#include <gtest/gtest.h>

#include <cmath>

#include "abradem/report/sweep_page.h"

namespace abradem::report {
namespace {

SweepTable table_of(const std::vector<std::string>& keys,
                    const std::vector<std::vector<std::string>>& values) {
  std::vector<SweepRun> runs;
  for (const auto& v : values)
    runs.push_back({"000" + std::to_string(runs.size() + 1), "completed", v, "/none"});
  return make_sweep_table(keys, runs);
}

TEST(SweepTable, PutsTheUnitIntoTheHeaderAndNumbersBelow) {
  const SweepTable table =
      table_of({"wall.\"my disc\".mesh.size", "run.end", "run.time_step"},
               {{"100 um", "\"1 rev\"", "10% rayleigh"}, {"1 mm", "2 rev", "20% rayleigh"}});
  EXPECT_EQ(table.factors[0].title, "wall.my disc.mesh.size [um]");
  EXPECT_EQ(table.factors[0].text, (std::vector<std::string>{"100", "1000"}));
  EXPECT_EQ(table.factors[0].number, (std::vector<double>{100.0, 1000.0}));
  EXPECT_EQ(table.factors[1].title, "run.end [rev]");
  EXPECT_EQ(table.factors[1].text, (std::vector<std::string>{"1", "2"}));
  EXPECT_EQ(table.factors[2].title, "run.time_step [% rayleigh]");
}

TEST(SweepTable, LeavesWordsVectorsAndMixedKindsAsWritten) {
  const SweepTable table = table_of({"wall.disc.contact", "particle.pin.load", "run.end"},
                                    {{"patch", "[0, 0, -5]", "1 rev"}, {"resolved", "5 N", "2 s"}});
  EXPECT_TRUE(table.factors[0].number.empty());
  EXPECT_EQ(table.factors[1].text[0], "[0, 0, -5]");
  EXPECT_TRUE(table.factors[1].number.empty());
  EXPECT_EQ(table.factors[2].text, (std::vector<std::string>{"1 rev", "2 s"}));
  const std::string csv = to_csv(table);
  EXPECT_TRUE(csv.starts_with("name,status,wall.disc.contact,particle.pin.load,run.end,revolution,time_s,"));
  EXPECT_NE(csv.find("\n0001,completed,patch,\"[0, 0, -5]\",1 rev,nan,nan,"), std::string::npos) << csv;
  EXPECT_TRUE(csv.ends_with(",nan\n"));
}

TEST(SweepTable, KnowsEvenRatiosFromEvenDifferences) {
  EXPECT_TRUE(table_of({"a"}, {{"1e-12"}, {"1e-11"}, {"1e-10"}}).factors[0].logarithmic);
  EXPECT_FALSE(table_of({"a"}, {{"0"}, {"50"}, {"100"}}).factors[0].logarithmic);
  EXPECT_FALSE(table_of({"a"}, {{"1"}, {"2"}, {"3"}}).factors[0].logarithmic);
}

/// A table with one result, as if the runs had been made.
SweepTable with_volumes(SweepTable table, const std::vector<double>& volumes) {
  for (SweepColumn& column : table.results)
    if (column.title == "swept_volume_mm3") column.number = volumes;
  return table;
}

TEST(SweepPage, DrawsWhatVariesAgainstEachKey) {
  const SweepTable grid = with_volumes(table_of({"a", "b"}, {{"1", "x"}, {"1", "y"}, {"2", "x"}, {"2", "y"}}),
                                       {1.0, 2.0, 3.0, 4.0});
  const std::vector<Figure> figures = main_effects(grid);
  ASSERT_EQ(figures.size(), 1U);  // the other results do not exist
  ASSERT_EQ(figures[0].panels.size(), 2U);
  const Panel& a = figures[0].panels[0];
  ASSERT_EQ(a.series.size(), 2U);  // a curve for each b
  EXPECT_EQ(a.series[1].name, "b: y");
  EXPECT_EQ(a.series[1].x, (std::vector<double>{1.0, 2.0}));
  EXPECT_EQ(a.series[1].y, (std::vector<double>{2.0, 4.0}));
  const Panel& b = figures[0].panels[1];
  EXPECT_EQ(b.x.labels, (std::vector<std::pair<double, std::string>>{{0.0, "x"}, {1.0, "y"}}));
}

TEST(SweepPage, DrawsMeansWhereThereAreManyKeys) {
  const SweepTable table = with_volumes(
      table_of({"a", "b", "c"}, {{"1", "1", "1"}, {"1", "2", "2"}, {"2", "1", "2"}, {"2", "2", "1"}}),
      {1.0, 3.0, 5.0, std::nan("")});
  const std::vector<Figure> figures = main_effects(table);
  ASSERT_EQ(figures.size(), 1U);
  const Series& means = figures[0].panels[0].series.at(1);
  EXPECT_EQ(means.x, (std::vector<double>{1.0, 2.0}));
  EXPECT_EQ(means.y, (std::vector<double>{2.0, 5.0}));
}

TEST(SweepPage, SaysWhenNothingDiffers) {
  const SweepTable table = with_volumes(table_of({"a"}, {{"1"}, {"2"}}), {1.0, 1.0});
  EXPECT_TRUE(main_effects(table).empty());
  EXPECT_NE(page_html(sweep_page({}, table)).find("No result differs"), std::string::npos);
}

TEST(SweepPage, NamesFailuresAndShowsDecades) {
  std::vector<SweepRun> runs;
  for (const char* alpha : {"1e-12 1/Pa", "1e-11 1/Pa", "1e-10 1/Pa", "1 1/Pa"})
    runs.push_back({alpha, "completed", {alpha}, "/none", ""});
  runs.back().status = "failed";
  runs.back().message = "the wear is too deep";
  SweepTable table = make_sweep_table({"wear.\"a/b\".wear_coefficient"}, runs);
  table = with_volumes(std::move(table), {1e-3, 1e-2, 1.0, std::nan("")});
  const std::vector<Figure> figures = main_effects(table);
  ASSERT_EQ(figures.size(), 1U);
  EXPECT_TRUE(figures[0].panels[0].y.log);
  EXPECT_EQ(figures[0].panels[0].x.title, "wear.a/b.wear_coefficient [1/Pa]");
  const std::string page = page_html(sweep_page({}, table));
  EXPECT_NE(page.find("the wear is too deep"), std::string::npos);
  EXPECT_NE(page.find("3 of 4 runs completed, 1 failed"), std::string::npos);
}

}  // namespace
}  // namespace abradem::report
