// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/wear_tables.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <numbers>

namespace abradem::io {
namespace {

namespace fs = std::filesystem;

TEST(WearTables, HoldEveryColumnInItsUnit) {
  const fs::path folder = fs::temp_directory_path() / ("abradem-wear-tables-" + std::to_string(getpid()));
  fs::create_directories(folder);
  analysis::RevolutionRow row;
  row.revolution = 2.0;
  row.time = 4.0;
  row.law_volume = 1e-9;
  row.swept_volume = 2e-9;
  row.paper_volume = 3e-9;
  row.depth_mean = 4e-3, row.depth_sd = 5e-3, row.depth_min = 6e-3, row.depth_max = 7e-3;
  row.width_mean = 8e-3, row.width_sd = 9e-3;
  row.area_mean = 10e-6;
  row.force_mean = 11, row.force_sd = 12, row.force_min = 13, row.force_max = 14;
  row.depth_p_chi2 = 0.15, row.width_p_chi2 = 0.16;
  const analysis::Contour contour{.angle = std::numbers::pi / 2,
                                  .depth = 1e-5,
                                  .width = 7e-4,
                                  .area = 5e-9,
                                  .profile = {{0.02, 0.0}, {0.021, -1e-5}}};
  WearTables tables(folder);
  tables.add(row, std::span(&contour, 1));
  EXPECT_EQ(read_csv(folder / "revolutions.csv").rows(), 0U);  // whole at any time
  tables.flush();
  EXPECT_EQ(read_csv(folder / "revolutions.csv").rows(), 1U);
  tables.close();

  const CsvTable revolutions = read_csv(folder / "revolutions.csv");
  const std::vector<std::pair<std::string, double>> expected{
      {"revolution", 2},       {"time_s", 4},         {"law_volume_mm3", 1}, {"swept_volume_mm3", 2},
      {"paper_volume_mm3", 3}, {"depth_mean_mm", 4},  {"depth_sd_mm", 5},    {"depth_min_mm", 6},
      {"depth_max_mm", 7},     {"width_mean_mm", 8},  {"width_sd_mm", 9},    {"area_mean_mm2", 10},
      {"force_mean_N", 11},    {"force_sd_N", 12},    {"force_min_N", 13},   {"force_max_N", 14},
      {"depth_p_chi2", 0.15},  {"width_p_chi2", 0.16}};
  ASSERT_EQ(revolutions.columns.size(), expected.size());
  ASSERT_EQ(revolutions.rows(), 1u);
  for (std::size_t c = 0; c < expected.size(); ++c) {
    EXPECT_EQ(revolutions.columns[c], expected[c].first);
    EXPECT_DOUBLE_EQ(revolutions.values[c], expected[c].second) << expected[c].first;
  }
  const CsvTable contours = read_csv(folder / "contours.csv");
  EXPECT_EQ(contours.columns, (std::vector<std::string>{"revolution", "angle_deg", "depth_mm", "width_mm",
                                                        "area_mm2", "displaced_width_mm"}));
  EXPECT_DOUBLE_EQ(contours.column("angle_deg").at(0), 90.0);
  EXPECT_DOUBLE_EQ(contours.column("depth_mm").at(0), 0.01);
  EXPECT_DOUBLE_EQ(contours.column("width_mm").at(0), 0.7);
  EXPECT_DOUBLE_EQ(contours.column("area_mm2").at(0), 0.005);
  const CsvTable profiles = read_csv(folder / "profiles.csv");
  EXPECT_EQ(profiles.columns,
            (std::vector<std::string>{"revolution", "angle_deg", "radius_mm", "height_mm"}));
  ASSERT_EQ(profiles.rows(), 2u);
  EXPECT_DOUBLE_EQ(profiles.column("radius_mm")[1], 21.0);
  EXPECT_DOUBLE_EQ(profiles.column("height_mm")[1], -0.01);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace abradem::io
