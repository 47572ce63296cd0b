// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/analysis/revolution_row.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "abradem/core/error.h"

namespace abradem::analysis {
namespace {

TEST(RevolutionRow, HoldsWhatWentIn) {
  const std::vector<Contour> contours{
      {.angle = 0.0, .depth = 10e-6, .width = 0.7e-3, .area = 4e-9, .profile = {}},
      {.angle = 1.0, .depth = 14e-6, .width = 0.9e-3, .area = 8e-9, .profile = {}},
      {.angle = 2.0, .depth = 12e-6, .width = 0.8e-3, .area = 6e-9, .profile = {}},
  };
  RunningStatistics force;
  for (const double f : {4.0, 5.0, 6.0}) force.add(f);
  const RevolutionRow row =
      revolution_row(3.0, 6.0, {.law = 1e-10, .swept = 2e-10, .paper = 3e-10}, contours, force);
  EXPECT_EQ(row.revolution, 3.0);
  EXPECT_EQ(row.time, 6.0);
  EXPECT_EQ(row.law_volume, 1e-10);
  EXPECT_EQ(row.swept_volume, 2e-10);
  EXPECT_EQ(row.paper_volume, 3e-10);
  EXPECT_DOUBLE_EQ(row.depth_mean, 12e-6);
  EXPECT_DOUBLE_EQ(row.depth_sd, 2e-6);
  EXPECT_EQ(row.depth_min, 10e-6);
  EXPECT_EQ(row.depth_max, 14e-6);
  EXPECT_DOUBLE_EQ(row.width_mean, 0.8e-3);
  EXPECT_NEAR(row.width_sd, 0.1e-3, 1e-18);
  EXPECT_DOUBLE_EQ(row.area_mean, 6e-9);
  EXPECT_DOUBLE_EQ(row.force_mean, 5.0);
  EXPECT_DOUBLE_EQ(row.force_sd, 1.0);
  EXPECT_EQ(row.force_min, 4.0);
  EXPECT_EQ(row.force_max, 6.0);
  EXPECT_TRUE(std::isnan(row.depth_p_chi2));  // three sections are too few for a test
  EXPECT_TRUE(std::isnan(row.width_p_chi2));
}

TEST(RevolutionRow, TestsDepthAndWidthEachOnItsOwn) {
  std::vector<Contour> contours;
  for (int i = 0; i < 360; ++i) {
    // A sum of sines of incommensurate phase is near normal; the width takes two values only.
    double sum = 0.0;
    for (int k = 1; k <= 8; ++k) sum += std::sin(1.0 * i * std::sqrt(1.0 + k) + k);
    contours.push_back({.angle = 0.0,
                        .depth = 1e-5 + 1e-6 * sum,
                        .width = i % 2 ? 1e-3 : 0.9e-3,
                        .area = 0.0,
                        .profile = {}});
  }
  const RevolutionRow row = revolution_row(1.0, 2.0, {}, contours, {});
  EXPECT_GT(row.depth_p_chi2, 0.01);
  EXPECT_LT(row.width_p_chi2, 1e-10);
  EXPECT_TRUE(std::isnan(row.force_mean));
}

TEST(RevolutionRow, WithoutContoursHasNoMeasures) {
  const RevolutionRow row = revolution_row(1.0, 2.0, {.law = 1.0}, {}, {});
  EXPECT_EQ(row.law_volume, 1.0);
  EXPECT_TRUE(std::isnan(row.depth_mean) && std::isnan(row.width_mean) && std::isnan(row.area_mean));
}

TEST(RevolutionRow, RefusesMeasuresThatAreNotFinite) {
  std::vector<Contour> contours(2);
  contours[1].width = std::nan("");
  EXPECT_THROW((void)revolution_row(1.0, 2.0, {}, contours, {}), InputError);
}

}  // namespace
}  // namespace abradem::analysis
