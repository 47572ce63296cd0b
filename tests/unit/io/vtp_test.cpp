// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/vtp.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <stdexcept>
#include <vector>

#include "abradem/core/error.h"
#include "abradem/geometry/generators.h"
#include "unit/io/temporary_folder.h"

namespace abradem::io {
namespace {

using geometry::TriangleMesh;

class Vtp : public TemporaryFolder {};

/// Runs the system's Python with arguments; its exit status.
int python(const std::string& arguments) {
  const int status = std::system(("/usr/bin/python3 " + arguments).c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST_F(Vtp, VtkReadsBackWhatWasWritten) {
  ASSERT_EQ(python("-c 'import vtkmodules.vtkIOXML'"), 0)
      << "./test installs VTK's Python package (python3-vtk9)";
  // Large enough for several compressed blocks, the last one partial.
  const TriangleMesh mesh = geometry::make_annulus(20e-3, 24e-3, 0.1e-3, 1);
  std::vector<double> radius, first_corner, twice_centre;
  for (const Vec3& v : mesh.vertices) radius.push_back(norm(v));
  for (const auto& t : mesh.triangles) {
    first_corner.push_back(t[0]);
    for (const double x : {2.0, 4.0, 8.0}) twice_centre.push_back(x * t[1]);
  }
  const std::vector<VtpArray> points{{.name = "radius <m> & \"more\"", .values = radius}};
  const std::vector<VtpArray> cells{{.name = "first", .values = first_corner},
                                    {.name = "vector", .values = twice_centre, .components = 3}};
  write_vtp(in_folder("mesh.vtp"), mesh, points, cells);
  write_vtp(in_folder("empty.vtp"), TriangleMesh{});
  const std::vector<Vec3> centres{{1, 2, 3}, {4, 5, 6}};
  const std::vector<double> radii{0.5, 0.25};
  const std::vector<double> ids{7, 8};
  const std::vector<VtpArray> extra{{.name = "id", .values = ids}};
  write_vtp_spheres(in_folder("spheres.vtp"), centres, radii, extra);
  const std::vector<PvdEntry> series{{0.0, "mesh.vtp"}, {0.0, "spheres.vtp", 1}, {0.1, "empty.vtp"}};
  write_pvd(in_folder("series.pvd"), series);
  EXPECT_EQ(python(std::string(ABRADEM_SOURCE_DIR) + "/tests/io/read_vtp.py " + folder_.string()), 0);
}

TEST_F(Vtp, StatesItsCountsAndLeavesNoTemporaryFile) {
  write_vtp(in_folder("a.vtp"), geometry::make_disc(1.0, 1.0, 1));
  const std::string text = content(in_folder("a.vtp"));
  EXPECT_NE(text.find(R"(<Piece NumberOfPoints="7" NumberOfPolys="6">)"), std::string::npos);
  EXPECT_EQ(files(), 1);
}

TEST_F(Vtp, SeriesListsItsFilesWithTheirTimes) {
  const std::vector<PvdEntry> series{{0.1, "vtk/a&b.vtp"}, {2.0, "vtk/c.vtp", 1}};
  write_pvd(in_folder("series.pvd"), series);
  const std::string text = content(in_folder("series.pvd"));
  EXPECT_NE(text.find(R"(<DataSet timestep="0.1" part="0" file="vtk/a&amp;b.vtp"/>)"), std::string::npos);
  EXPECT_NE(text.find(R"(<DataSet timestep="2" part="1" file="vtk/c.vtp"/>)"), std::string::npos);
}

TEST_F(Vtp, RefusesArraysOfAnotherLength) {
  const TriangleMesh mesh = geometry::make_disc(1.0, 1.0, 1);
  const std::vector<double> six(6, 0.0);
  const std::vector<VtpArray> arrays{{.name = "depth", .values = six}};
  EXPECT_THROW(write_vtp(in_folder("a.vtp"), mesh, arrays), std::invalid_argument);
  EXPECT_NO_THROW(write_vtp(in_folder("a.vtp"), mesh, {}, arrays));
}

TEST_F(Vtp, FailingToWriteIsAnIoErrorAndKeepsTheOldFile) {
  const TriangleMesh mesh = geometry::make_disc(1.0, 1.0, 1);
  EXPECT_THROW(write_vtp(in_folder("none/a.vtp"), mesh), IoError);
  std::filesystem::create_directory(in_folder("taken.vtp"));
  EXPECT_THROW(write_vtp(in_folder("taken.vtp"), mesh), IoError);
  EXPECT_TRUE(std::filesystem::is_directory(in_folder("taken.vtp")));
  EXPECT_EQ(files(), 1) << "a temporary file was left behind";
}

}  // namespace
}  // namespace abradem::io
