// SPDX-License-Identifier: BSD-3-Clause
// The table [study] of a case file.
#include "abradem/io/case_study.h"

#include <gtest/gtest.h>

#include <fstream>

#include "abradem/io/case_file.h"
#include "abradem/study/variations.h"
#include "support/case_texts.h"
#include "support/says.h"

namespace abradem::io {
namespace {

using test::contains;
using test::replaced;

std::string pin_on_disc() {
  std::ifstream file(ABRADEM_SOURCE_DIR "/cases/pin-on-disc.toml", std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

constexpr const char* kStudy = R"(
[study]
page = "table"
[[study.variation]]
name = "mesh"
set = { "run.end" = "1 rev", run.seed = 7 }
together = { "wall.disc.contact" = ["per_triangle", "patch"], "wall.disc.deformation" = ["paper", "conserving"] }
vary = { "wall.disc.mesh.size" = ["0.2 mm", 3e-4] }
[[study.variation]]
name = "wear"
vary = { 'wear."iron_ore/mild_steel".wear_coefficient' = ["1e-11 1/Pa", "5e-11 1/Pa", 0] }
)";

simulation::Setup read(const std::string& study, const std::vector<std::string>& overrides = {}) {
  return parse_case(pin_on_disc() + study, "study.toml", "/folder", overrides).setup;
}

std::string complaint(const std::string& study, const std::vector<std::string>& overrides = {}) {
  try {
    static_cast<void>(read(study, overrides));
    return {};
  } catch (const InputError& error) {
    return error.what();
  }
}

/// "study.toml:LINE:" of the line that holds this text.
std::string line_of(const std::string& study, const std::string& part) {
  const std::string text = pin_on_disc() + study;
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(text.find(part));
  return "study.toml:" + std::to_string(1 + std::count(text.begin(), end, '\n')) + ":";
}

TEST(CaseStudy, ReadsVariationsAsTomlText) {
  const simulation::Setup setup = read(kStudy);
  ASSERT_TRUE(setup.study);
  ASSERT_EQ(setup.study->variations.size(), 2U);
  const simulation::VariationSetup& mesh = setup.study->variations[0];
  EXPECT_EQ(mesh.name, "mesh");
  EXPECT_EQ(mesh.set, (std::vector<simulation::VariedKey>{{"run.end", {"\"1 rev\""}}, {"run.seed", {"7"}}}));
  EXPECT_EQ(mesh.vary[0].values, (std::vector<std::string>{"\"0.2 mm\"", "0.0003"}));
  EXPECT_EQ(study::plan(*setup.study).size(), 2U * 2U + 3U);
}

TEST(CaseStudy, ResolvesToItself) {
  const simulation::Setup setup = read(kStudy);
  const std::string text = resolved_case(setup);
  const Case again = parse_case(text, "case.resolved.toml", "/elsewhere");
  EXPECT_TRUE(again.setup == setup) << text;
  EXPECT_EQ(resolved_case(again.setup), text);
}

TEST(CaseStudy, ItsOverridesMakeTheRuns) {
  const simulation::Setup setup = read(kStudy);
  const std::vector<study::PlannedRun> runs = study::plan(*setup.study);
  const auto run = [&](std::size_t i) {
    return read(kStudy, study::overrides_of(setup.study->variations[runs[i].variation], runs[i], {}));
  };
  const simulation::Setup second = run(1);
  EXPECT_EQ(second.walls[0].contact, simulation::ContactRule::per_triangle);
  EXPECT_EQ(second.walls[0].deformation, simulation::DeformationRule::paper);
  EXPECT_EQ(second.walls[0].mesh.size, 3e-4);
  EXPECT_EQ(second.run.seed, 7U);
  EXPECT_EQ(second.run.end, (simulation::Duration{1.0, true}));
  EXPECT_EQ(run(5).wear[0].wear_coefficient, 5e-11);
}

TEST(CaseStudy, FindsEveryProblemOfEveryRunWithItsPlace) {
  std::string bad = replaced(kStudy, "\"0.2 mm\"", "\"0.2 s\"");
  bad = replaced(bad, "\"per_triangle\"", "\"per_trianlge\"");
  bad = replaced(bad, "0]", "-1]");
  bad = replaced(bad, "\"run.end\"", "\"run.ennd\"");
  const std::string text = complaint(bad);
  EXPECT_TRUE(contains(text, line_of(bad, "set =")));
  EXPECT_TRUE(contains(text, "unknown key 'ennd' in [run]; did you mean 'end'?"));
  EXPECT_TRUE(contains(text, line_of(bad, "together =") + "37: error: 'contact'"));
  EXPECT_TRUE(contains(text, "did you mean \"per_triangle\"?"));
  EXPECT_TRUE(contains(text, line_of(bad, "vary = { \"wall") + "35: error: 'size': expected a length"));
  EXPECT_TRUE(contains(text, "must be >= 0, got -1"));
  EXPECT_TRUE(contains(text, "study.toml: 4 errors"));
}

TEST(CaseStudy, FindsWhatOnlyACombinationMakesWrong) {
  const std::string bad = replaced(kStudy, "\"0.2 mm\"", "\"5 mm\"");  // the ring is 4 mm wide
  EXPECT_TRUE(contains(complaint(bad), line_of(bad, "vary = { \"wall")));
  EXPECT_TRUE(contains(complaint(bad), "do not fit"));
}

TEST(CaseStudy, RefusesListsThatDoNotGoTogether) {
  const std::string bad = replaced(kStudy, "[\"paper\", \"conserving\"]", "[\"paper\"]");
  EXPECT_TRUE(contains(complaint(bad), "'wall.disc.deformation' has 1 values and 'wall.disc.contact' has 2"));
  EXPECT_TRUE(
      contains(complaint(replaced(kStudy, "[\"0.2 mm\", 3e-4]", "\"0.2 mm\"")), "expected a list of values"));
  EXPECT_TRUE(contains(complaint(replaced(kStudy, "[\"0.2 mm\", 3e-4]", "[]")), "expected a list of values"));
}

TEST(CaseStudy, RefusesNamesThatCannotBeFolders) {
  EXPECT_TRUE(contains(complaint(replaced(kStudy, "\"mesh\"", "\"../mesh\"")), "name of a folder"));
  EXPECT_TRUE(
      contains(complaint(replaced(kStudy, "\"mesh\"", "\"wear\"")), "two variations of the name 'wear'"));
  EXPECT_TRUE(
      contains(complaint(replaced(kStudy, "\"run.end\"", "\"study.page\"")), "knows nothing of its study"));
  EXPECT_TRUE(contains(complaint(replaced(kStudy, "\"run.end\"", "\"run end\"")), "is not a dotted key"));
  EXPECT_TRUE(contains(complaint("[study]\npage = \"table\"\n"),
                       "the case has no variation; add [[study.variation]]"));
  EXPECT_TRUE(contains(complaint("[study.variation]\nname = \"a\"\n"), "list of tables"));
}

TEST(CaseStudy, ThePaperNeedsPublishedValues) {
  EXPECT_TRUE(contains(complaint(replaced(kStudy, "\"table\"", "\"paper\"")), "name their file"));
  EXPECT_TRUE(contains(complaint(replaced(kStudy, "\"table\"", "\"paper\"\npublished = \"none.json\"")),
                       "there is no file '/folder/none.json'"));
}

TEST(CaseStudy, AnOverrideGoesOverWhatIsSetAndNotOverWhatVaries) {
  const Case both = parse_case(pin_on_disc() + kStudy, "study.toml", "/folder",
                               std::vector<std::string>{"wall.disc.mesh.size=0.5 mm"});
  ASSERT_EQ(both.notes.size(), 1U);
  EXPECT_TRUE(contains(both.notes[0], "the study varies 'wall.disc.mesh.size'"));
  // Every run is checked with the override.
  EXPECT_TRUE(contains(complaint(kStudy, {"run.end=1 mm"}), "--set: error: 'end'"));
}

}  // namespace
}  // namespace abradem::io
