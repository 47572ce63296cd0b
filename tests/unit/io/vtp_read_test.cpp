// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/vtp_read.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "abradem/core/error.h"
#include "abradem/geometry/generators.h"
#include "abradem/io/vtp.h"

namespace abradem::io {
namespace {

class VtpFile : public ::testing::Test {
 protected:
  void SetUp() override {
    file_ = std::filesystem::temp_directory_path() /
            ("abradem_vtp_" + std::to_string(::getpid()) +
             ::testing::UnitTest::GetInstance()->current_test_info()->name());
  }
  void TearDown() override { std::filesystem::remove(file_); }

  const std::filesystem::path& with(const std::string& text) {
    std::ofstream(file_, std::ios::binary) << text;
    return file_;
  }
  std::string message(const std::string& text) {
    with(text);
    try {
      (void)read_vtp(file_);
    } catch (const IoError& error) {
      return error.what();
    }
    return {};
  }

  std::filesystem::path file_;
};

/// Two triangles over four points.
std::string ascii(const std::string& connectivity = "0 1 2 1 3 2", const std::string& offsets = "3 6") {
  return R"(<?xml version="1.0"?>
<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian"><PolyData><Piece NumberOfPoints="4" NumberOfPolys="2">
<PointData Scalars="depth_um"><DataArray type="Float64" Name="depth_um" format="ascii">0 1.5 2.5e0 -3</DataArray></PointData>
<CellData><DataArray type="Int32" Name="a &lt; b" NumberOfComponents="2" format="ascii">1 2
3 4</DataArray></CellData>
<Points><DataArray type="Float64" Name="Points" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0 1 1 -0.25</DataArray></Points>
<Verts></Verts>
<Polys><DataArray type="Int32" Name="connectivity" format="ascii">)" +
         connectivity + R"(</DataArray><DataArray type="Int32" Name="offsets" format="ascii">)" + offsets +
         "</DataArray></Polys></Piece></PolyData></VTKFile>\n";
}

TEST_F(VtpFile, ReadsAnAsciiSurfaceWithItsFields) {
  const VtpSurface surface = read_vtp(with(ascii()));
  ASSERT_EQ(surface.mesh.vertices.size(), 4u);
  EXPECT_EQ(surface.mesh.vertices[3], (Vec3{1.0, 1.0, -0.25}));
  ASSERT_EQ(surface.mesh.triangles.size(), 2u);
  EXPECT_EQ(surface.mesh.triangles[1], (geometry::Triangle{1, 3, 2}));
  EXPECT_EQ(surface.point_data.at("depth_um").values, (std::vector<double>{0.0, 1.5, 2.5, -3.0}));
  EXPECT_EQ(surface.cell_data.at("a < b").components, 2);
}

// A triangle (0 0 0, 1 0 0, 0 1 0) as other writers store it: header and data together, and one after the
// other.
std::string inline_binary(const char* connectivity) {
  return std::string(
             R"(<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian" header_type="UInt32"><PolyData>
<Piece NumberOfPoints="3" NumberOfPolys="1"><Points><DataArray type="Float32" Name="Points" NumberOfComponents="3" format="ascii">
0 0 0 1 0 0 0 1 0</DataArray></Points><Polys><DataArray type="Int32" Name="connectivity" format="binary">)") +
         connectivity +
         R"(</DataArray><DataArray type="Int32" Name="offsets" format="ascii">3</DataArray></Polys></Piece></PolyData></VTKFile>)";
}

TEST_F(VtpFile, ReadsBase64WithItsHeaderTogetherAndApart) {
  const geometry::Triangle expected{0, 1, 2};
  EXPECT_EQ(read_vtp(with(inline_binary("DAAAAAAAAAABAAAAAgAAAA=="))).mesh.triangles.at(0), expected);
  EXPECT_EQ(read_vtp(with(inline_binary("DAAAAA==AAAAAAEAAAACAAAA"))).mesh.triangles.at(0), expected);
}

TEST_F(VtpFile, ACutOffArrayIsNamedAsDamage) {
  EXPECT_NE(message(inline_binary("DAAAAAAAAAABAAAA")).find("shorter than its header says"),
            std::string::npos);
  EXPECT_NE(message(inline_binary("DAA")).find("shorter than its header says"), std::string::npos);
}

TEST_F(VtpFile, WhatIsNoTriangulatedSurfaceIsRefused) {
  EXPECT_NE(message("solid disc\n").find("not a VTK XML file"), std::string::npos);
  EXPECT_NE(
      message("<VTKFile type=\"UnstructuredGrid\">").find("holds 'UnstructuredGrid', expected PolyData"),
      std::string::npos);
  EXPECT_NE(message("<VTKFile type=\"PolyData\" byte_order=\"BigEndian\">").find("big endian"),
            std::string::npos);
  EXPECT_NE(
      message("<VTKFile type=\"PolyData\" compressor=\"vtkLZ4DataCompressor\">").find("vtkLZ4DataCompressor"),
      std::string::npos);
  EXPECT_NE(message("<VTKFile type=\"PolyData\"><PolyData></PolyData></VTKFile>").find("no <Piece>"),
            std::string::npos);
  EXPECT_NE(message("<VTKFile type=\"PolyData\"").find("ends inside a tag"), std::string::npos);
  EXPECT_NE(message(ascii("0 1 2 3", "4")).find("only triangles"), std::string::npos);
  EXPECT_NE(message(ascii("0 1 2 1 9 2")).find("triangle 1 names point 9, but there are 4"),
            std::string::npos);
  EXPECT_NE(message(ascii("0 1 2 1 x 2")).find("'x', expected a number"), std::string::npos);
}

TEST_F(VtpFile, CountsThatCannotBeAreRefused) {
  const auto with_count = [&](const std::string& count) {
    std::string text = ascii();
    text.replace(text.find("NumberOfPoints=\"4\""), 18, "NumberOfPoints=\"" + count + "\"");
    return message(text);
  };
  for (const char* count : {"-1", "4.5", "1e300", "nan", "6148914691236517206"})
    EXPECT_NE(
        with_count(count).find("NumberOfPoints is '" + std::string(count) + "', expected a whole number"),
        std::string::npos)
        << with_count(count);
  std::string none = ascii();
  none.replace(none.find("<Points>"), 8, "<Pointz>");
  EXPECT_NE(message(none).find("states 4 points, and has no <Points> that hold them"), std::string::npos);
  std::string far = ascii();
  far.replace(far.find("1 1 -0.25"), 9, "1 1 inf  ");
  EXPECT_NE(message(far).find("point 3 is not finite"), std::string::npos) << message(far);
}

TEST_F(VtpFile, AMissingFileIsNamed) {
  try {
    (void)read_vtp(file_);
    FAIL();
  } catch (const IoError& error) {
    EXPECT_NE(std::string(error.what()).find(file_.string() + ": no such file"), std::string::npos);
  }
}

TEST_F(VtpFile, ReadsWhatTheWriterWritesBitForBit) {
  geometry::TriangleMesh mesh = geometry::make_annulus(20e-3, 24e-3, 0.2e-3, 1);  // more than one block
  std::vector<double> depth;
  for (Vec3& p : mesh.vertices) depth.push_back(1e6 * (p.z = -1e-6 * std::abs(p.x / 3.0)));
  const VtpArray field{.name = "depth < um", .values = depth};
  write_vtp(file_, mesh, {&field, 1});
  const VtpSurface surface = read_vtp(file_);
  EXPECT_EQ(surface.mesh.vertices, mesh.vertices);
  EXPECT_EQ(surface.mesh.triangles, mesh.triangles);
  EXPECT_EQ(surface.point_data.at("depth < um").values, depth);
}

TEST_F(VtpFile, SpheresAreASurfaceWithoutTriangles) {
  const std::vector<Vec3> centres{{0.022, 0.0, 0.003}};
  const std::vector<double> radii{0.003};
  write_vtp_spheres(file_, centres, radii);
  EXPECT_EQ(read_vtp(file_).mesh.vertices, centres);
  EXPECT_TRUE(read_vtp(file_).mesh.triangles.empty());
}

TEST_F(VtpFile, ReadsTheWritersCollection) {
  const std::vector<PvdEntry> entries{{0.0, "vtk/a & b.vtp", 0}, {0.1, "vtk/c.vtp", 2}};
  write_pvd(file_, entries);
  const auto frames = read_pvd(file_);
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].file, file_.parent_path() / "vtk/a & b.vtp");
  EXPECT_EQ(frames[1].time, 0.1);
  EXPECT_EQ(frames[1].part, "2");
}

TEST_F(VtpFile, ReadsACollectionInOrder) {
  const auto frames = read_pvd(with(R"(<?xml version="1.0"?>
<VTKFile type="Collection" version="1.0"><Collection>
<DataSet timestep="0" part="0" file="vtk/a &amp; b_0.vtp"/>
<DataSet timestep="2.5" part="1" file="vtk/pin_1.vtp"/>
</Collection></VTKFile>)"));
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].file, file_.parent_path() / "vtk/a & b_0.vtp");
  EXPECT_EQ(frames[1].time, 2.5);
  EXPECT_EQ(frames[1].part, "1");
  EXPECT_THROW((void)read_pvd(with("<VTKFile type=\"PolyData\">")), IoError);
}

}  // namespace
}  // namespace abradem::io
