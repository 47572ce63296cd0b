// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/report/paper_page.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <map>

#include "abradem/core/error.h"
#include "abradem/report/paper_claims.h"
#include "abradem/report/paper_figures.h"
#include "support/study_fixture.h"

namespace abradem::report {
namespace {

namespace fs = std::filesystem;
using study::Verdict;
using test::SyntheticStudy;

const std::string kClaims = ABRADEM_SOURCE_DIR "/cases/paper/claims.json";

/// Runs made of formulas: the paper's numbers in its own rules, Archard's law in the conserving ones.
class PaperPage : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = fs::temp_directory_path() / ("abradem_paper_page_" + std::to_string(::getpid()));
    study_ = new SyntheticStudy(test::published_study(folder_));
    setup_ = new simulation::Setup(test::paper_setup());
    setup_->study->page = simulation::StudyPage::paper;
    setup_->study->published = kClaims;
    runs_ = new PaperRuns(read_paper_runs(*setup_, study_->runs()));
    for (const JudgedClaim& claim : judge_claims(*runs_)) judged_[claim.claim->id] = claim;
  }
  static void TearDownTestSuite() {
    judged_.clear();
    delete runs_;
    delete setup_;
    delete study_;
    fs::remove_all(folder_);
  }
  /// Of a claim in a reading: 0 the paper's rules, 1 conserving.
  static Verdict verdict(const std::string& id, std::size_t reading) {
    return judged_.at(id).answers.at(reading).value().verdict;
  }
  static const DataTable& table(const Page& page, const std::string& id) {
    for (const PageSection& section : page.sections)
      for (const auto& item : section.items)
        if (const auto* found = std::get_if<DataTable>(&item); found != nullptr && found->id == id)
          return *found;
    throw std::runtime_error("no table " + id);
  }
  static std::vector<std::string> figures(const Page& page) {
    std::vector<std::string> ids;
    for (const PageSection& section : page.sections)
      for (const auto& item : section.items)
        if (const auto* figure = std::get_if<Figure>(&item)) ids.push_back(figure->id);
    return ids;
  }

  static inline fs::path folder_;
  static inline SyntheticStudy* study_ = nullptr;
  static inline simulation::Setup* setup_ = nullptr;
  static inline PaperRuns* runs_ = nullptr;
  static inline std::map<std::string, JudgedClaim> judged_;
};

TEST_F(PaperPage, TableFourEndsWithTheWornPinAndTheRidges) {
  const DataTable t = *table4(*runs_);
  ASSERT_EQ(t.columns[7], "inside what was measured");
  const std::vector<std::string>&theirs = t.rows[1], &without = t.rows[t.rows.size() - 2],
        &with = t.rows.back();
  EXPECT_EQ(theirs[7], "volume");
  EXPECT_EQ(without[7], "width, volume");
  EXPECT_EQ(with[0], "the same pin, worn, and ridges: 54.0 % of the groove removed");
  EXPECT_EQ(with[7], "depth, width, volume");
  EXPECT_EQ(with[2], "-14 %");
  const Figure figure = *fig18_against_test(*runs_);
  EXPECT_EQ(figure.panels.back().title, "(c) Conserving, with a worn pin and ridges");
  PaperRuns before = *runs_;
  before.laboratory.reset();
  EXPECT_EQ(table4(before)->rows.size(), t.rows.size() - 1);
  EXPECT_EQ(fig18_against_test(before)->panels.size(), figure.panels.size() - 1);
}

TEST_F(PaperPage, FindsReproducedWhatIsThePapers) {
  for (const char* id : {"M01", "M02", "N01", "N02", "D01", "D02", "D04", "W04", "V13", "V14", "V15", "V16",
                         "V17", "C04", "C05", "P03", "C06", "C07", "T01", "T02", "F08", "F17", "F18"})
    EXPECT_EQ(verdict(id, 0), Verdict::reproduced)
        << id << ": " << judged_.at(id).answers[0]->ours << "; " << judged_.at(id).answers[0]->why;
}

TEST_F(PaperPage, FindsNotReproducedWhatIsNot) {
  // Archard's volumes are not the paper's, a steady force has no outliers, and a fifth of the depth is
  // another.
  for (const char* id :
       {"N02", "D01", "D02", "D03", "V13", "V14", "V15", "V16", "V17", "C01", "C05", "M02", "F17"})
    EXPECT_EQ(verdict(id, 1), Verdict::not_reproduced) << id << ": " << judged_.at(id).answers[1]->ours;
  EXPECT_EQ(verdict("D04", 1), Verdict::trend_only);  // n^0.6 grows, but is not linear
  EXPECT_EQ(verdict("W04", 1), Verdict::reproduced);
  EXPECT_EQ(verdict("E03", 1), Verdict::reproduced);  // calibrated to the measured volume
  EXPECT_EQ(verdict("E01", 1), Verdict::trend_only);  // 7.96 um against 10 to 14
  EXPECT_EQ(verdict("F16", 0), Verdict::not_reproduced);
}

TEST_F(PaperPage, JudgesByTheRunsAndNotByTheFile) {
  // The same published values, other runs: the coefficients' volumes doubled.
  SyntheticStudy study(folder_ / "doubled");
  for (const StudyRun& run : study_->runs()) {
    if (run.variation != "wear_coefficient" ||
        run.setup.walls.front().deformation != simulation::DeformationRule::paper)
      continue;
    test::SyntheticRun doubled{.revolutions = 12};
    const double coefficient = run.setup.wear.front().wear_coefficient;
    for (const study::PublishedFit& fit : study::published_fits())
      if (fit.wear_coefficient == coefficient)
        doubled.paper_mm3 = [fit](double n) { return 2.1e9 * fit.volume(n); };
    study.add("wear_coefficient", run.setup, doubled);
  }
  const PaperRuns runs = read_paper_runs(*setup_, study.runs());
  for (const JudgedClaim& claim : judge_claims(runs)) {
    if (claim.claim->id.starts_with("V")) {
      EXPECT_EQ(claim.answers[0].value().verdict, Verdict::not_reproduced) << claim.claim->id;
      EXPECT_FALSE(claim.answers[1].has_value());
    }
    if (claim.claim->id == "M01") {
      EXPECT_FALSE(claim.answers[0].has_value());  // its runs are missing
    }
  }
}

TEST_F(PaperPage, HoldsEveryFigureAndTableOfThePaper) {
  const Page page = paper_page(*setup_, study_->runs(), folder_);
  EXPECT_EQ(figures(page),
            (std::vector<std::string>{"fig07-mesh-size", "fig08-contours", "fig09-forces", "fig10-depths",
                                      "fig11-widths", "fig12-depth-boxes", "fig13-width-boxes",
                                      "table3-p-values", "fig14-contours-paper", "fig14-contours-conserving",
                                      "fig15-volumes", "fig15-over-archard", "fig16-force-components",
                                      "fig17-wear-profile", "fig18-against-test"}));
  const DataTable& shown = table(page, "figures-and-tables");
  std::vector<std::string> names;
  for (const auto& row : shown.rows) names.push_back(row.front());
  EXPECT_EQ(names, (std::vector<std::string>{"Fig. 7", "Fig. 8", "Fig. 9", "Fig. 10", "Fig. 11", "Fig. 12",
                                             "Fig. 13", "Fig. 14", "Fig. 15", "Fig. 16", "Fig. 17", "Fig. 18",
                                             "Table 3", "Table 4"}));
  for (const char* id : {"table3-normality", "eq13-17-fits", "table4-against-test", "study-runs"})
    EXPECT_FALSE(table(page, id).rows.empty()) << id;
  // Every claim of the file is either judged or listed as one that no run can answer.
  EXPECT_EQ(table(page, "claims").rows.size() + table(page, "unanswered").rows.size(),
            runs_->published.claims.size());
  EXPECT_EQ(std::ranges::count_if(runs_->published.claims, [](const auto& c) { return c.kind != "figure"; }),
            69);
  EXPECT_NE(page_html(page).find("Pin on disc &lt;published&gt;"), std::string::npos);
}

TEST_F(PaperPage, ComparesInputsWithTheCase) {
  simulation::Setup setup = *setup_;
  setup.particles.front().radius = 2e-3;
  const PaperRuns runs = read_paper_runs(setup, study_->runs());
  const DataTable inputs = unanswered_table(judge_claims(runs), runs);
  const auto status = [&](const std::string& id) {
    return std::ranges::find_if(inputs.rows, [&](const auto& row) { return row[0] == id; })->at(4);
  };
  EXPECT_EQ(status("S01"), "input: differs");
  EXPECT_EQ(status("S15"), "input: the same");
  EXPECT_EQ(status("X01"), "literature: no run can answer");
}

TEST_F(PaperPage, HasTheFitsOfThePublishedEquations) {
  const DataTable fits = fits_table(*runs_).value();
  // Three rows per coefficient: the paper's, its rules, conserving. A quadratic is found again.
  ASSERT_EQ(fits.rows.size(), 15U);
  EXPECT_EQ(fits.rows[12][2], "0.09800");
  EXPECT_TRUE(fits.rows[13][2].starts_with("0.098 ± ")) << fits.rows[13][2];
  EXPECT_TRUE(fits.rows[13][3].starts_with("0.011 ± ")) << fits.rows[13][3];
  EXPECT_EQ(fits.rows[14][3], "0 ± < 10⁻⁶");
}

TEST_F(PaperPage, LeavesOutWhatHasNoRunsAndSaysSo) {
  SyntheticStudy study(folder_ / "few");
  study.add_failed("mesh_size", test::paper_setup(), "it went unphysical");
  const Page page = paper_page(*setup_, study.runs(), folder_);
  EXPECT_TRUE(figures(page).empty());
  EXPECT_NE(page_html(page).find("mesh_size/01 failed: it went unphysical"), std::string::npos);
  for (const auto& row : table(page, "claims").rows) EXPECT_EQ(row[4], "not run");
}

TEST_F(PaperPage, RefusesACompletedRunWithoutRows) {
  SyntheticStudy study(folder_ / "empty");
  study.add("mesh_size", study_->runs().front().setup, {.revolutions = 0});
  EXPECT_THROW((void)paper_page(*setup_, study.runs(), folder_), IoError);
}

TEST_F(PaperPage, RefusesAFileThatNamesAnotherRule) {
  std::ifstream in(kClaims);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::string rule = R"("rule": "falling", "shown": "Fig. 7")";
  ASSERT_NE(text.find(rule), std::string::npos);
  text.replace(text.find(rule), rule.size(), R"("rule": "rising", "shown": "Fig. 7")");
  const fs::path file = folder_ / "claims.json";
  test::write_file(file, text);
  simulation::Setup setup = *setup_;
  setup.study->published = file;
  try {
    (void)paper_page(setup, study_->runs(), folder_);
    FAIL();
  } catch (const IoError& error) {
    EXPECT_NE(std::string(error.what()).find("claim 'M01' has the rule 'rising'"), std::string::npos)
        << error.what();
  }
}

// ---- the file of published values
// ---------------------------------------------------------------------------------------------------

TEST(Published, HasTheFitsThatTheCalibrationKnows) {
  const PublishedValues values = read_published(kClaims);
  for (const study::PublishedFit& fit : study::published_fits()) {
    const PublishedClaim* claim = values.find("V" + std::to_string(fit.equation));
    ASSERT_NE(claim, nullptr);
    EXPECT_EQ(claim->numbers[0], fit.a0);
    EXPECT_EQ(claim->numbers[1], fit.a1);
    EXPECT_EQ(claim->numbers[2], fit.a2);
  }
}

TEST(Published, DamageIsNamed) {
  const fs::path file =
      fs::temp_directory_path() / ("abradem_claims_" + std::to_string(::getpid()) + ".json");
  const auto error = [&](const std::string& text) {
    test::write_file(file, text);
    try {
      (void)read_published(file);
    } catch (const IoError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  const std::string good = R"({"id": "A", "quantity": "q", "rule": "value", "kind": "claim", "value": 1})";
  EXPECT_EQ(error(R"({"source": "s", "claims": [)" + good + "]}"), "");
  EXPECT_NE(error("{").find("not JSON"), std::string::npos);
  EXPECT_NE(error(R"({"source": "s"})").find("list 'claims'"), std::string::npos);
  EXPECT_NE(
      error(R"({"source": "s", "claims": [)" + good + "," + good + "]}").find("two claims have the id 'A'"),
      std::string::npos);
  EXPECT_NE(
      error(R"({"source": "s", "claims": [{"id": "B", "quantity": "q", "rule": "value", "kind": "claim"}]})")
          .find("claim 'B': key 'value' is missing"),
      std::string::npos);
  EXPECT_NE(
      error(
          R"({"source": "s", "claims": [{"id": "B", "quantity": "q", "rule": "v", "kind": "c", "value": ["x"]}]})")
          .find("is not a number"),
      std::string::npos);
  fs::remove(file);
  EXPECT_THROW((void)read_published(file), IoError);
}

}  // namespace
}  // namespace abradem::report
