// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/factor_text.h"

#include <gtest/gtest.h>

#include "abradem/core/error.h"
#include "support/says.h"

namespace abradem::io {
namespace {

using test::contains;

using Strings = std::vector<std::string>;

std::string complaint(const std::string& text) {
  try {
    (void)parse_factor(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no complaint";
}

TEST(FactorText, SplitsAtCommasOutsideQuotesAndBrackets) {
  const study::Factor sizes = parse_factor("wall.disc.mesh.size=0.1 mm, 0.2 mm");
  EXPECT_EQ(sizes.key, "wall.disc.mesh.size");
  EXPECT_EQ(sizes.values, (Strings{"0.1 mm", "0.2 mm"}));
  EXPECT_FALSE(sizes.range);
  EXPECT_EQ(parse_factor("wall.disc.motion.axis=[0, 0, 1],[0,1,0]").values,
            (Strings{"[0, 0, 1]", "[0,1,0]"}));
  EXPECT_EQ(parse_factor("title=\"a, b\",'c, d',e").values, (Strings{"\"a, b\"", "'c, d'", "e"}));
  EXPECT_EQ(
      parse_factor("wall.disc.mesh={ shape = \"disc\", outer = 1 },{ shape = \"plane\" }").values.size(), 2U);
  const study::Factor pair = parse_factor("wear.\"iron_ore/mild_steel\".wear_coefficient=1e-11");
  EXPECT_EQ(pair.key, "wear.\"iron_ore/mild_steel\".wear_coefficient");
  EXPECT_EQ(parse_factor("wear.\"a=b/c\".wear_coefficient=1").key, "wear.\"a=b/c\".wear_coefficient");
}

TEST(FactorText, ReadsRangesWithTheirUnit) {
  using study::Range;
  EXPECT_EQ(parse_factor("a=0.1 mm..1 mm").range, (Range{0.1, 1.0, "mm", false, false}));
  EXPECT_EQ(parse_factor("a=0.1 .. 1 mm:log").range, (Range{0.1, 1.0, "mm", true, false}));
  EXPECT_EQ(parse_factor("a=-1..+1").range, (Range{-1.0, 1.0, "", false, false}));
  EXPECT_EQ(parse_factor("run.time_step=10% rayleigh..20% rayleigh").range,
            (Range{10.0, 20.0, "% rayleigh", false, false}));
  const study::Range mixed = *parse_factor("a=100 um..1 mm").range;
  EXPECT_DOUBLE_EQ(mixed.low, 0.1);
  EXPECT_EQ(mixed.unit, "mm");
}

TEST(FactorText, TakesValuesOfARange) {
  EXPECT_EQ(parse_factor("a=1..3 mm:3").values, (Strings{"1 mm", "2 mm", "3 mm"}));
  EXPECT_EQ(parse_factor("a=1e-12..1e-10 1/Pa:3:log").values,
            (Strings{"1e-12 1/Pa", "1e-11 1/Pa", "1e-10 1/Pa"}));
  EXPECT_EQ(parse_factor("a=0,1..3:2,9").values, (Strings{"0", "1", "3", "9"}));
}

TEST(FactorText, KnowsWholeNumbersOfTheCase) {
  EXPECT_TRUE(parse_factor("run.seed=1..10").range->whole);
  EXPECT_TRUE(parse_factor("output.contours=36..360").range->whole);
  EXPECT_FALSE(parse_factor("contact.\"a/b\".static_friction=0..1").range->whole);
}

TEST(FactorText, LeavesFilesAlone) {
  EXPECT_EQ(parse_factor("wall.disc.mesh.file=../a.stl,../../b.stl").values,
            (Strings{"../a.stl", "../../b.stl"}));
  EXPECT_EQ(parse_factor("wall.disc.mesh.file=a/../b.stl").values, (Strings{"a/../b.stl"}));
}

TEST(FactorText, SaysWhatIsWrong) {
  EXPECT_TRUE(contains(complaint("run.end"), "'run.end' names no values; expected KEY=VALUE,VALUE,…"));
  EXPECT_TRUE(contains(complaint("=3"), "names no key"));
  EXPECT_TRUE(contains(complaint("a="), "has an empty value"));
  EXPECT_TRUE(contains(complaint("a=1,,2"), "has an empty value"));
  EXPECT_TRUE(contains(complaint("a=1 mm..2"), "the upper end has no unit"));
  EXPECT_TRUE(contains(complaint("a=1 mm..2 kg"), "its ends are a length and a mass"));
  EXPECT_TRUE(contains(complaint("a=1 mm..2 foot"), "foot"));
  EXPECT_TRUE(contains(complaint("a=1..2:lin"), "':lin' is neither ':log' nor a number of values"));
  EXPECT_TRUE(contains(complaint("a=1..2:1"), "2 or more"));
  EXPECT_TRUE(contains(complaint("a=0,1..2"), "say how many it stands for, as in 1..2:5"));
  EXPECT_TRUE(contains(complaint("a=2..1:3"), "is empty: give the lower end first"));
}

}  // namespace
}  // namespace abradem::io
