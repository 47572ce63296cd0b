// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/report/statistics_section.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "abradem/core/random.h"
#include "abradem/report/seed_section.h"
#include "run_fixture.h"

namespace abradem::report {
namespace {

/// Sum of twelve uniform numbers: near enough normal.
double noise(core::RandomStream& random) {
  double sum = -6.0;
  for (int k = 0; k < 12; ++k) sum += random.uniform();
  return sum;
}

/// n outputs of 200 sections each, normal and independent, a volume that grows by 0.05 each.
GrooveSeries steady(int n, double bend = 0.0) {
  GrooveSeries s;
  s.track_radius_mm = 22.0;
  s.grown.push_back({"worn volume", "mm³", {}});
  core::RandomStream random(5);
  double volume = 0.0;
  for (int i = 1; i <= n; ++i) {
    s.revolutions.push_back(i);
    s.depths_mm.emplace_back();
    s.widths_mm.emplace_back();
    for (int k = 0; k < 200; ++k) {
      s.depths_mm.back().push_back(0.01 + 1e-4 * noise(random));
      s.widths_mm.back().push_back(0.7 + 1e-2 * noise(random));
    }
    volume += 0.05 * (1.0 + 0.002 * noise(random)) + bend * i;
    s.grown.front().values.push_back(volume);
  }
  return s;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string out;
  for (const std::string& line : lines) out += line + "\n";
  return out;
}
bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

template <class Item>
const Item* find(const PageSection& section, const std::string& id) {
  for (const auto& item : section.items)
    if (const auto* found = std::get_if<Item>(&item); found != nullptr && found->id == id) return found;
  return nullptr;
}

TEST(StatisticsSection, OfASteadyGrooveFindsNothing) {
  const GrooveSeries s = steady(12);
  const std::string text = joined(statistics_findings(s));
  EXPECT_TRUE(has(text, "Depth after 12 revolutions, 200 sections: chi-squared p = ")) << text;
  EXPECT_TRUE(has(text, "With 5 to 40 equiprobable bins in place of 17")) << text;
  EXPECT_TRUE(has(text, "nothing distinguishes it from a level")) << text;
  EXPECT_TRUE(has(text, "The worn volume grows by 0.0")) << text;
  EXPECT_TRUE(has(text, "Its growth shows no bend")) << text;
  const PageSection section = statistics_section(s, "x");
  const DataTable* tests = find<DataTable>(section, "x-normality");
  ASSERT_NE(tests, nullptr);
  EXPECT_EQ(tests->rows.size(), 24U);  // depth and width of each
  ASSERT_NE(find<DataTable>(section, "x-run-in"), nullptr);
  EXPECT_EQ(find<DataTable>(section, "x-run-in")->rows.size(), 3U);
  ASSERT_NE(find<DataTable>(section, "x-fits"), nullptr);
  EXPECT_EQ(find<DataTable>(section, "x-fits")->rows.size(), 2U);
  for (const char* id : {"x-p", "x-correlation", "x-growth"})
    EXPECT_NE(find<Figure>(section, id), nullptr) << id;
  EXPECT_NO_THROW((void)page_html({.title = "x", .sections = {section}}));
}

TEST(StatisticsSection, SeesABendInTheGrowth) {
  const std::string text = joined(statistics_findings(steady(12, 1e-3)));
  EXPECT_TRUE(has(text, "Its growth bends (b2 = ")) << text;
  EXPECT_TRUE(has(text, "changes (p = ")) << text;
}

TEST(StatisticsSection, LooksAtSixtyOutputsOfMany) {
  const PageSection section = statistics_section(steady(200));
  const DataTable* tests = find<DataTable>(section, "statistics-normality");
  ASSERT_NE(tests, nullptr);
  EXPECT_EQ(tests->rows.size(), 24U);
  EXPECT_EQ(tests->rows.front()[0], "1");
  EXPECT_EQ(tests->rows.back()[0], "200");
  EXPECT_TRUE(has(tests->caption, "12 of 200 outputs.")) << tests->caption;
  EXPECT_EQ(find<Figure>(section, "statistics-p")->panels[0].series[0].x.size(), 60U);
}

TEST(StatisticsSection, HasNothingToSayOfNoSectionsOrEqualOnes) {
  EXPECT_EQ(joined(statistics_findings({})), "There are no sections of a groove to make statistics of.\n");
  EXPECT_EQ(statistics_section({}).items.size(), 1U);
  GrooveSeries same = steady(3);
  for (auto& depths : same.depths_mm) depths.assign(200, 0.01);
  EXPECT_TRUE(
      has(joined(statistics_findings(same)), "no scatter beyond round-off, so there is nothing to test"));
  EXPECT_NO_THROW((void)page_html({.title = "x", .sections = {statistics_section(same)}}));
}

/// Runs that left nothing but their sections.
class SeedSection : public RunFixture {
 protected:
  SweepRun run(const std::string& name, std::uint64_t seed, bool normal) {
    core::RandomStream random(seed);
    std::string text = "revolution,angle_deg,depth_mm,width_mm,area_mm2\n";
    for (int n = 1; n <= 2; ++n)
      for (int k = 0; k < 200; ++k) {
        const double depth = normal || n == 1 ? noise(random) : std::exp(noise(random));
        text += std::to_string(n) + "," + std::to_string(k) + "," + std::to_string(1.0 + 0.1 * depth) + "," +
                std::to_string(2.0 + 0.1 * noise(random)) + ",0\n";
      }
    write_text(folder_ / name / "tables/contours.csv", text);
    return {name, "completed", {std::to_string(seed)}, folder_ / name};
  }
};

TEST_F(SeedSection, CountsTheSeedsThatPass) {
  const std::vector<SweepRun> runs{run("a", 1, true), run("b", 2, true), run("c", 3, false),
                                   run("d", 4, true)};
  const auto section = seed_section(make_sweep_table({"run.seed"}, runs), runs);
  ASSERT_TRUE(section);
  const DataTable* verdicts = find<DataTable>(*section, "seed-sensitivity");
  ASSERT_NE(verdicts, nullptr);
  EXPECT_EQ(verdicts->rows.size(), 16U);  // depth and width, all and independent, four tests
  for (const auto& row : verdicts->rows) {
    // Equal-width bins pool what a skewed sample leaves empty, and then have no verdict on it.
    if (row[2] != "depth" || row[3] != "all" || row[4] == "χ², equal width") continue;
    EXPECT_LE(std::stod(row[5]), 75.0) << row[4];
    EXPECT_GE(std::stod(row[5]), 50.0) << row[4];  // a true normal sample is rejected once in twenty
    EXPECT_LT(std::stod(row[6]), 1e-6) << row[4];
  }
  const DataTable* rule = find<DataTable>(*section, "seed-rule");
  ASSERT_NE(rule, nullptr);
  ASSERT_EQ(rule->rows.size(), 4U);
  EXPECT_EQ(rule->rows[2][3], "–");  // the skewed one fails at the end
  EXPECT_NO_THROW((void)page_html({.title = "x", .sections = {*section}}));
}

TEST_F(SeedSection, NeedsTwoRunsThatDifferInTheSeedAlone) {
  const std::vector<SweepRun> one{run("a", 1, true)};
  EXPECT_FALSE(seed_section(make_sweep_table({"run.seed"}, one), one));
  const std::vector<SweepRun> other{run("a", 1, true), run("b", 2, true)};
  EXPECT_FALSE(seed_section(make_sweep_table({"run.end"}, other), other));
}

}  // namespace
}  // namespace abradem::report
