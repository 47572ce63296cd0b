// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/study/variations.h"

#include <gtest/gtest.h>

namespace abradem::study {
namespace {

using simulation::VariationSetup;

VariationSetup example() {
  return {"size",
          {{"run.end", {"\"1 rev\""}}},
          {{"wall.disc.contact", {"\"patch\"", "\"per_triangle\""}},
           {"wall.disc.deformation", {"\"conserving\"", "\"paper\""}}},
          {{"run.seed", {"1", "2"}}, {"wall.disc.mesh.size", {"0.1", "0.2", "0.3"}}}};
}

TEST(Plan, CrossesWhatVariesAndKeepsTogetherWhatGoesTogether) {
  const std::vector<PlannedRun> runs = plan({{}, {}, {example(), {"alone", {}, {}, {}}}});
  ASSERT_EQ(runs.size(), 2U * 2U * 3U + 1U);
  EXPECT_EQ(runs[0].name, "size/01");
  EXPECT_EQ(runs[11].name, "size/12");
  EXPECT_EQ(runs[12].name, "alone/01");
  // The last crossed key is the fastest, what goes together the slowest.
  using Varied = std::vector<std::pair<std::string, std::string>>;
  EXPECT_EQ(varied_in(example(), runs[1]), (Varied{{"wall.disc.contact", "\"patch\""},
                                                   {"wall.disc.deformation", "\"conserving\""},
                                                   {"run.seed", "1"},
                                                   {"wall.disc.mesh.size", "0.2"}}));
  EXPECT_EQ(varied_in(example(), runs[9]), (Varied{{"wall.disc.contact", "\"per_triangle\""},
                                                   {"wall.disc.deformation", "\"paper\""},
                                                   {"run.seed", "2"},
                                                   {"wall.disc.mesh.size", "0.1"}}));
}

TEST(Plan, PutsTheUsersOverridesBetweenWhatIsSetAndWhatVaries) {
  const PlannedRun run = plan({{}, {}, {example()}})[0];
  EXPECT_EQ(overrides_of(example(), run, {"run.end=2 rev"}),
            (std::vector<std::string>{"run.end=\"1 rev\"", "run.end=2 rev", "wall.disc.contact=\"patch\"",
                                      "wall.disc.deformation=\"conserving\"", "run.seed=1",
                                      "wall.disc.mesh.size=0.1"}));
}

TEST(Plan, CountsWithoutOverflow) {
  VariationSetup v{"many", {}, {}, {}};
  EXPECT_EQ(count_runs(v, 100), 1U);
  EXPECT_EQ(count_runs(example(), 100), 12U);
  for (int i = 0; i < 80; ++i) v.vary.push_back({"k", {"1", "2"}});
  EXPECT_EQ(count_runs(v, 100), 101U);
}

}  // namespace
}  // namespace abradem::study
