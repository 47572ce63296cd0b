// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/report/scaling_page.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>

#include "abradem/analysis/half_space_groove.h"
#include "support/study_fixture.h"

namespace abradem::report {
namespace {

namespace fs = std::filesystem;

/// A soft and a stiff pin whose depth is off by 1e-4 (1e-5) of the scaling factor.
class ScalingPage : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("abradem_scaling_page_" + std::to_string(::getpid()));
    setup_ = test::paper_setup();
    setup_.study->page = simulation::StudyPage::scaling;
    setup_.run.end = {1302.5, true};
    setup_.wear.front().wear_coefficient = 6.28e-13;
  }
  void TearDown() override { fs::remove_all(folder_); }

  void add(test::SyntheticStudy& study, double modulus, double factor, double error, double depth,
           double width) {
    simulation::Setup setup = setup_;
    setup.study.reset();
    setup.materials.front().shear_modulus = modulus;
    setup.wear.front().acceleration.factor = factor;
    test::SyntheticRun run{.revolutions = 4, .per_row = 1302.5 / 4};
    run.depth_mm = [=](double n, double) { return depth * n / 1302.5 * (1.0 + error * (factor - 1.0)); };
    run.width_mm = [=](double, double) { return width; };
    run.swept_mm3 = [](double n) { return 0.565 * n / 1302.5; };
    study.add("scaling", setup, run);
  }
  test::SyntheticStudy both() {
    test::SyntheticStudy study(folder_);
    for (const double factor : {162.8125, 1302.5 / 12, 1302.5 / 48, 1.0}) {
      add(study, 0.1e9, factor, 1e-5, 0.00796, 0.78);
      add(study, 30e9, factor, 1e-4, 0.0116, 0.568);
    }
    return study;
  }
  static const DataTable* table(const Page& page, const std::string& id) {
    for (const PageSection& section : page.sections)
      for (const auto& item : section.items)
        if (const auto* found = std::get_if<DataTable>(&item); found != nullptr && found->id == id)
          return found;
    return nullptr;
  }
  static const Figure* figure(const Page& page, const std::string& id) {
    for (const PageSection& section : page.sections)
      for (const auto& item : section.items)
        if (const auto* found = std::get_if<Figure>(&item); found != nullptr && found->id == id) return found;
    return nullptr;
  }

  fs::path folder_;
  simulation::Setup setup_;
};

TEST_F(ScalingPage, FindsTheLargestFactorForATolerance) {
  const test::SyntheticStudy study = both();
  const Page page = scaling_page(setup_, study.runs(), folder_);
  const DataTable* factors = table(page, "largest-factor");
  ASSERT_NE(factors, nullptr);
  EXPECT_EQ(factors->columns[1], "pin of 0.1 GPa");
  // 0.3 %: the stiff pin's error of 1e-4 (f - 1) reaches it at f = 31, nearly interpolated.
  EXPECT_EQ(factors->rows[3][0], "0.3 %");
  EXPECT_EQ(factors->rows[3][1], "162.8 or more");
  EXPECT_NEAR(std::stod(factors->rows[3][2]), 31.0, 0.5);
  EXPECT_EQ(factors->rows[3][3], "162.8");
  // 0.01 %: less than the least factor that was run.
  EXPECT_EQ(factors->rows[0][1], "< 27.1");
}

TEST_F(ScalingPage, TablesTheDeviationsFromTheLeastScaledRun) {
  const test::SyntheticStudy study = both();
  const Page page = scaling_page(setup_, study.runs(), folder_);
  const DataTable* runs = table(page, "scaling-runs");
  ASSERT_NE(runs, nullptr);
  ASSERT_EQ(runs->rows.size(), 8U);
  EXPECT_EQ(runs->rows[0][1], "1302.5");
  EXPECT_EQ(runs->rows[0][4], "0");
  EXPECT_EQ(runs->rows[7][1], "8.0000");
  EXPECT_EQ(runs->rows[7][4], "+1.6 %");
  EXPECT_EQ(runs->rows[7][8], "1.6");
}

TEST_F(ScalingPage, PutsRunsAndLaboratoryOnTheMasterCurve) {
  const test::SyntheticStudy study = both();
  const Page page = scaling_page(setup_, study.runs(), folder_);
  const Figure* master = figure(page, "master-curve");
  ASSERT_NE(master, nullptr);
  const auto series = [&](const std::string& name) {
    for (const Series& s : master->panels[0].series)
      if (s.name == name) return s;
    throw std::runtime_error("no series " + name);
  };
  const Series curve = series("elastic half-space"), soft = series("pin of 0.1 GPa"),
               laboratory = series("laboratory, taken for each pin");
  for (std::size_t k = 0; k < curve.x.size(); ++k)
    EXPECT_DOUBLE_EQ(curve.y[k], analysis::half_space_depth(curve.x[k]));
  EXPECT_EQ(soft.x.size(), 16U);  // every row of every run
  EXPECT_NEAR(soft.x.back(), 6.28e-13 * 1302.5 * 2.6285e8, 1e-4);
  EXPECT_NEAR(soft.y[3], 0.00796 / 40.7857e-3, 1e-5);  // the end of the unscaled run
  ASSERT_EQ(laboratory.x.size(), 2U);
  EXPECT_TRUE(laboratory.theirs);
  EXPECT_NEAR(laboratory.x[1], 47.7, 0.1);
}

TEST_F(ScalingPage, SaysWhichMeasuredRangesAreMet) {
  const test::SyntheticStudy study = both();
  const DataTable* laboratory = nullptr;
  const Page page = scaling_page(setup_, study.runs(), folder_);
  laboratory = table(page, "laboratory");
  ASSERT_NE(laboratory, nullptr);
  const auto verdicts = [&](std::size_t row) {
    return std::pair{laboratory->rows[row][3], laboratory->rows[row][5]};
  };
  EXPECT_EQ(verdicts(0), (std::pair<std::string, std::string>{"reproduced", "reproduced"}));  // volume
  EXPECT_EQ(verdicts(1), (std::pair<std::string, std::string>{"trend only", "reproduced"}));  // depth
  EXPECT_EQ(verdicts(2), (std::pair<std::string, std::string>{"reproduced", "trend only"}));  // width
}

TEST_F(ScalingPage, OfNoFinishedRunNamesTheGaps) {
  test::SyntheticStudy study(folder_);
  study.add_failed("scaling", setup_, "it went unphysical");
  const std::string html = page_html(scaling_page(setup_, study.runs(), folder_));
  EXPECT_NE(html.find("scaling/01 failed: it went unphysical"), std::string::npos);
}

}  // namespace
}  // namespace abradem::report
