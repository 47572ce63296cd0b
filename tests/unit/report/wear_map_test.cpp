// SPDX-License-Identifier: BSD-3-Clause
// The walls' maps in the report: what is shown of them, and the worst places.
#include <gtest/gtest.h>

#include <string>
#include <variant>
#include <vector>

#include "abradem/geometry/generators.h"
#include "abradem/io/vtp.h"
#include "abradem/report/wear_map_section.h"
#include "abradem/report/wear_map_view.h"
#include "unit/io/temporary_folder.h"

namespace abradem::report {
namespace {

class WearMapFrames : public io::TemporaryFolder {};

TEST_F(WearMapFrames, KeepsTheTrianglesUnderTheGreatestPressure) {
  const geometry::TriangleMesh mesh = geometry::make_plate(10e-3, 10e-3, 1e-3, 1);
  const std::size_t n = mesh.triangles.size();
  std::vector<double> pressure(n), sliding(n, 0.0), depth(n);
  for (std::size_t t = 0; t < n; ++t) pressure[t] = static_cast<double>((7 * t) % n), depth[t] = 1.0;
  const io::VtpArray cells[]{
      {"peak_pressure_MPa", pressure, 1}, {"sliding_mm", sliding, 1}, {"wear_depth_um", depth, 1}};
  io::write_vtp(in_folder("wall.vtp"), mesh, {}, cells);
  io::write_vtp(in_folder("plain.vtp"), mesh);
  const std::vector<WallFrame> frames{{"plain", in_folder("plain.vtp")}, {"wall", in_folder("wall.vtp")}};
  const auto whole = wear_map_view(frames);
  ASSERT_TRUE(whole);
  ASSERT_EQ(whole->walls.size(), 1u);  // one has no map
  EXPECT_EQ(whole->walls[0].triangles, n);
  ASSERT_EQ(whole->quantities.size(), 2u);  // nothing slid
  EXPECT_EQ(whole->quantities[0].key, "wear_depth_um");
  EXPECT_FLOAT_EQ(whole->x_mm[static_cast<std::size_t>(whole->i[0])],
                  static_cast<float>(1e3 * mesh.vertices[static_cast<std::size_t>(mesh.triangles[0][0])].x));

  const auto part = wear_map_view(frames, 20);
  ASSERT_TRUE(part);
  EXPECT_EQ(part->walls[0].mesh_triangles, n);
  ASSERT_EQ(part->i.size(), 20u);
  for (const double p : part->quantities[1].values) EXPECT_GE(p, static_cast<double>(n) - 20.0);
  EXPECT_FALSE(wear_map_view({frames[0]}));
}

Table wear_table() {
  Table t;
  t.names = {"element",
             "x_mm",
             "y_mm",
             "z_mm",
             "area_mm2",
             "wear_volume_mm3",
             "wear_depth_um",
             "wall",
             "shear_work_J",
             "normal_work_J",
             "sliding_mm",
             "impacts",
             "impact_energy_J",
             "peak_pressure_MPa"};
  // Elements 0 and 1 are neighbours; 2 is far away, 3 of another wall at the place of 0, 4 never wore.
  const std::vector<std::vector<double>> rows{{0, 0, 0, 0, 2, 0.02, 10, 0, 1, 2, 3, 4, 5, 6},
                                              {1, 1, 0, 0, 2, 0.018, 9, 0, 1, 2, 3, 4, 5, 6},
                                              {2, 90, 0, 0, 2, 0.01, 5, 0, 1, 2, 3, 4, 5, 6},
                                              {3, 0, 0, 0, 2, 0.004, 2, 1, 1, 2, 3, 4, 5, 6},
                                              {4, 50, 0, 0, 2, 0, 0, 0, 1, 2, 3, 4, 5, 6}};
  t.columns.resize(t.names.size());
  for (const auto& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) t.columns[c].push_back(row[c]);
  return t;
}

TEST(WearMapSection, NamesTheWorstPlacesAndWhenALinerIsWornThrough) {
  RunFolder run;
  EXPECT_FALSE(wear_map_section(run));
  run.wear = wear_table();
  run.manifest.walls = {"liner", "side"};
  run.manifest.thickness_mm = {20.0, std::nullopt};
  run.revolutions.names = {"time_s"};
  run.revolutions.columns = {{1800.0}};
  const auto section = wear_map_section(run);
  ASSERT_TRUE(section);
  const auto& places = std::get<DataTable>(section->items.at(0));
  ASSERT_EQ(places.rows.size(), 3u);
  const auto cell = [&](std::size_t row, const std::string& column) {
    for (std::size_t c = 0; c < places.columns.size(); ++c)
      if (places.columns[c] == column) return places.rows[row].at(c);
    return std::string("no column ") + column;
  };
  EXPECT_EQ(cell(0, "element"), "0");
  EXPECT_EQ(cell(1, "element"), "2");
  EXPECT_EQ(cell(2, "wall"), "side");
  EXPECT_DOUBLE_EQ(std::stod(cell(0, "rate [mm/h]")), 0.02);
  EXPECT_DOUBLE_EQ(std::stod(cell(0, "worn through after [h]")), 1000.0);
  EXPECT_EQ(cell(2, "worn through after [h]"), "–");
  const auto& sums = std::get<DataTable>(section->items.at(1));
  ASSERT_EQ(sums.rows.size(), 2u);
  EXPECT_DOUBLE_EQ(std::stod(sums.rows[0].at(1)), 0.048);
  EXPECT_DOUBLE_EQ(std::stod(sums.rows[0].back()), 6.0);  // of what wore
}

}  // namespace
}  // namespace abradem::report
