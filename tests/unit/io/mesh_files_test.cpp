// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/mesh_files.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "abradem/core/error.h"
#include "abradem/geometry/generators.h"
#include "unit/io/temporary_folder.h"

namespace abradem::io {
namespace {

using geometry::Triangle;
using geometry::TriangleMesh;

class MeshFiles : public TemporaryFolder {
 protected:
  /// The message of the GeometryError that reading throws; anything else fails the test.
  static std::string refused(const std::filesystem::path& path) {
    try {
      const TriangleMesh mesh = read_mesh(path, 1.0);
      ADD_FAILURE() << path << " was read: " << mesh.triangles.size() << " triangles";
    } catch (const GeometryError& e) {
      EXPECT_NE(std::string(e.what()).find(path.filename().string()), std::string::npos)
          << "names no file: " << e.what();
      return e.what();
    } catch (const std::exception& e) {
      ADD_FAILURE() << path << " gave another error: " << e.what();
    }
    return "";
  }
  void expect_refused(const std::string& name, std::string_view content, const std::string& reason) const {
    const std::string message = refused(write(name, content));
    EXPECT_NE(message.find(reason), std::string::npos)
        << name << ": '" << message << "' lacks '" << reason << "'";
  }
};

const std::string kFacet =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
const std::string kOtherFacet =
    "FACET NORMAL nan nan -nan(ind)\nOUTER LOOP\nVERTEX 1e0 0 0\nVERTEX +1.0 1. 0\nVERTEX 0 1 "
    "0\nENDLOOP\nENDFACET\n";
const std::string kTextStl = "solid a part with a name\n" + kFacet + kOtherFacet + "endsolid a part\n";

std::string number_bytes(auto value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}
std::string reversed(std::string bytes) { return {bytes.rbegin(), bytes.rend()}; }

std::string binary_stl(std::string header, std::uint32_t count, const std::vector<float>& numbers) {
  header.resize(80, ' ');
  std::string out = header + number_bytes(count);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    out += number_bytes(numbers[i]);
    if (i % 12 == 11) out += std::string(2, '\0');
  }
  return out;
}
const std::vector<float> kTwoRecords{0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 0};

void expect_square(const TriangleMesh& mesh, double side = 1.0) {
  EXPECT_EQ(mesh.vertices.size(), 4U);
  EXPECT_EQ(mesh.triangles.size(), 2U);
  EXPECT_NEAR(total_area(mesh), side * side, 1e-12 * side * side);
  for (geometry::Index t = 0; t < mesh.triangle_count(); ++t) EXPECT_GT(area_vector(mesh, t).z, 0.0);
}

TEST_F(MeshFiles, ReadsTextStlInAnyCase) {
  expect_square(read_mesh(write("a.stl", kTextStl), 1.0));
  expect_square(read_mesh(write("b.STL", kTextStl), 1e-3), 1e-3);
  std::string dos = kTextStl;
  for (std::size_t i = 0; (i = dos.find('\n', i)) != std::string::npos; i += 2) dos.insert(i, 1, '\r');
  expect_square(read_mesh(write("c.Stl", dos), 1.0));
  expect_square(read_mesh(
      write("two-solids.stl", "solid a\n" + kFacet + "endsolid\nsolid\n" + kOtherFacet + "endsolid"), 1.0));
}

TEST_F(MeshFiles, ReadsBinaryStlWhateverItsHeaderSays) {
  expect_square(read_mesh(write("a.stl", binary_stl("made by something", 2, kTwoRecords)), 1.0));
  expect_square(read_mesh(write("b.stl", binary_stl("solid facet", 2, kTwoRecords)), 1.0));
  expect_square(read_mesh(write("c.stl", binary_stl("x", 2, kTwoRecords) + "trailing"), 1.0));
}

TEST_F(MeshFiles, KeepsEveryDigitOfTextStl) {
  const auto path = write("digits.stl",
                          "solid\nfacet normal 0 0 1 outer loop vertex 0.12345678901234567 0 0 vertex 1 0 0 "
                          "vertex 0 1 0 endloop endfacet endsolid");
  EXPECT_EQ(read_mesh(path, 1.0).vertices[0].x, 0.12345678901234567);
}

TEST_F(MeshFiles, ReadsObjWithPolygonsNegativeIndicesAndDecoration) {
  const auto path =
      write("a.obj",
            "# a comment\nmtllib x.mtl\no thing\nv 0 0 0\nv 1 0 0 0.5 0.5 0.5\nv 1 1 0\nv 0 1 0 1.0\n"
            "vt 0 0\nvn 0 0 1\ns off\nf 1/1/1 2//1 3 4/1 # a square\n");
  expect_square(read_mesh(path, 1.0));
  expect_square(
      read_mesh(write("b.OBJ", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf -4 -3 -2\nf -4 \\\n -2 -1"), 1.0));
  expect_square(read_mesh(write("late.obj", "f 1 2 3 4\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"), 1.0));
  const TriangleMesh pentagon =
      read_mesh(write("c.obj", "v 0 0 0\nv 1 0 0\nv 2 1 0\nv 1 2 0\nv 0 2 0\nf 1 2 3 4 5\n"), 1.0);
  EXPECT_EQ(pentagon.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
}

TEST_F(MeshFiles, ReadsTextPly) {
  const std::string header =
      "ply\nformat ascii 1.0\ncomment c\nobj_info o\nelement vertex 4\nproperty float z\nproperty double x\n"
      "property float64 y\nproperty uchar red\nelement edge 1\nproperty list uchar int ends\nelement face 2\n"
      "property uchar flag\nproperty list uint8 int32 vertex_index\nend_header\n";
  expect_square(read_mesh(
      write("a.ply", header + "0 0 0 255\n0 1 0 0\n0 1 1 7\n0 0 1 1\n2 0 1\n0 3 0 1 2\n1 3 0 2 3\n"), 1.0));
  const std::string quad =
      "ply\r\nformat ascii 1.0\r\nelement vertex 4\r\nproperty float x\r\nproperty float y\r\nproperty float "
      "z\r\n"
      "property float confidence\r\nelement face 1\r\nproperty list uchar uint "
      "vertex_indices\r\nend_header\r\n"
      "0 0 0 nan\r\n1 0 0 1\r\n1 1 0 1\r\n0 1 0 1\r\n4 0 1 2 3";
  expect_square(read_mesh(write("quad.PLY", quad), 1.0));
}

TEST_F(MeshFiles, ReadsBinaryPlyOfEitherByteOrder) {
  for (const bool big : {false, true}) {
    const auto bytes = [&](auto value) { return big ? reversed(number_bytes(value)) : number_bytes(value); };
    std::string out = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                      "_endian 1.0\nelement vertex 4\nproperty double x\nproperty float y\nproperty short z\n"
                      "property list uchar char extra\nelement face 1\nproperty list ushort uint "
                      "vertex_indices\nend_header\n";
    for (const auto& [x, y] :
         {std::pair{0.0, 0.0F}, std::pair{1.0, 0.0F}, std::pair{1.0, 1.0F}, std::pair{0.0, 1.0F}})
      out += bytes(x) + bytes(y) + bytes(std::int16_t{0}) + "\2ab";
    out += bytes(std::uint16_t{4});
    for (const std::uint32_t i : {0U, 1U, 2U, 3U}) out += bytes(i);
    expect_square(read_mesh(write(big ? "big.ply" : "little.ply", out), 1.0));
  }
}

TEST_F(MeshFiles, WhatWasWrittenIsReadBack) {
  const TriangleMesh mesh = geometry::make_annulus(20e-3, 24e-3, 1e-3, 1);
  write_ply(in_folder("a.ply"), mesh, 1.0);
  const TriangleMesh exact = read_mesh(in_folder("a.ply"), 1.0);
  EXPECT_EQ(exact.vertices, mesh.vertices);
  EXPECT_EQ(exact.triangles, mesh.triangles);
  write_stl(in_folder("a.stl"), mesh, 1e-3);
  const TriangleMesh single = read_mesh(in_folder("a.stl"), 1e-3);
  ASSERT_EQ(single.triangles.size(), mesh.triangles.size());
  EXPECT_EQ(single.vertices.size(), mesh.vertices.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_LT(norm(single.vertices[static_cast<std::size_t>(single.triangles[t][k])] -
                     mesh.vertices[static_cast<std::size_t>(mesh.triangles[t][k])]),
                24e-3 * 1.2e-7);
  EXPECT_EQ(files(), 2) << "a temporary file was left behind";
}

TEST_F(MeshFiles, WhatCannotBeOpenedIsAnIoError) {
  EXPECT_THROW((void)read_mesh(in_folder("none.stl"), 1.0), IoError);
  std::filesystem::create_directory(in_folder("folder.stl"));
  EXPECT_THROW((void)read_mesh(in_folder("folder.stl"), 1.0), IoError);
  EXPECT_THROW((void)read_mesh("/dev/null", 1.0), IoError);
  EXPECT_THROW(write_stl(in_folder("no/such/folder.stl"), geometry::make_disc(1, 1, 1), 1.0), IoError);
  try {
    (void)read_mesh(in_folder("folder.stl"), 1.0);
  } catch (const IoError& e) {
    EXPECT_NE(std::string(e.what()).find("directory"), std::string::npos);
  }
}

TEST_F(MeshFiles, TheUnitIsAPositiveLength) {
  const auto path = write("a.stl", kTextStl);
  for (const double bad :
       {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_THROW((void)read_mesh(path, bad), InputError) << bad;
}

TEST_F(MeshFiles, RefusesBadStl) {
  expect_refused("empty.stl", "", "empty");
  expect_refused("short.stl", "hello", "too few");
  expect_refused("garbage.stl", std::string(500, '\x5a'), "truncated, or not an STL file");
  expect_refused("zeros.stl", std::string(500, '\0'), "no triangles");
  expect_refused("nothing.stl", "solid x\nendsolid x\n", "no triangles");
  expect_refused("huge.stl", binary_stl("x", 0xffffffffU, {}), "states 4294967295 triangles");
  expect_refused("cut.stl", binary_stl("x", 2, kTwoRecords).substr(0, 150), "states 2 triangles");
  expect_refused("cut-text.stl", "solid x\n" + kFacet, "truncated");
  expect_refused("cut-facet.stl", "solid x\n" + kFacet.substr(0, 56), "file ends");
  expect_refused("no-solid.stl", "solid x\nendsolid\n" + kFacet, "expected 'solid'");
  expect_refused(
      "quad.stl",
      "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\n",
      "expected 'endloop'");
  expect_refused("word.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 zero\n",
                 "line 4: expected a coordinate, found 'zero'");
  expect_refused("nan.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 nan\n", "finite");
  std::vector<float> with_nan = kTwoRecords;
  with_nan[16] = std::numeric_limits<float>::quiet_NaN();
  expect_refused("nan-binary.stl", binary_stl("x", 2, with_nan), "triangle 2");
  with_nan[16] = std::numeric_limits<float>::infinity();
  expect_refused("inf-binary.stl", binary_stl("x", 2, with_nan), "not finite");
}

TEST_F(MeshFiles, RefusesBadObj) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  expect_refused("empty.obj", "", "empty");
  expect_refused("no-faces.obj", vertices, "no triangles");
  expect_refused("garbage.obj", std::string("\x01\x02\xff\xfe nonsense\n\0\0", 17), "no triangles");
  expect_refused("zero.obj", vertices + "f 0 1 2\n", "line 4: vertex number 0");
  expect_refused("high.obj", vertices + "f 1 2 4\n", "uses vertex 4, but there are 3");
  expect_refused("low.obj", vertices + "f -1 -2 -4\n", "vertex number -4");
  expect_refused("enormous.obj", vertices + "f 1 2 99999999999\n", "out of range");
  expect_refused("beyond.obj", vertices + "f 1 2 99999999999999999999999\n", "expected a vertex number");
  expect_refused("two.obj", vertices + "f 1 2\n", "2 corners");
  expect_refused("word.obj", vertices + "f one two three\n", "found 'one'");
  expect_refused("nan.obj", "v 0 nan 0\n", "finite");
  expect_refused("missing.obj", "v 0 0\nv 1 0 0\n", "the line ends");
  expect_refused("overflow.obj", "v 0 0 1e999\n", "coordinate");
}

TEST_F(MeshFiles, RefusesBadPly) {
  const auto ply = [](const std::string& format, const std::string& vertices, const std::string& faces,
                      const std::string& body) {
    return "ply\nformat " + format + " 1.0\nelement vertex " + vertices +
           "\nproperty float x\nproperty float y\nproperty float z\nelement face " + faces +
           "\nproperty list uchar int vertex_indices\nend_header\n" + body;
  };
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
  expect_refused("empty.ply", "", "empty");
  expect_refused("garbage.ply", "stanford bunny", "begin with 'ply'");
  expect_refused("header.ply", "ply\nformat ascii 1.0\nelement vertex 3\n", "end_header");
  expect_refused("format.ply", "ply\nformat ebcdic 1.0\nend_header\n", "unknown format");
  expect_refused("no-format.ply", "ply\nend_header\n", "no 'format'");
  expect_refused("no-elements.ply", "ply\nformat ascii 1.0\nend_header\n", "needs the elements");
  expect_refused("line.ply", "ply\nformat ascii 1.0\nwhatever\n", "unknown line");
  expect_refused("type.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty quad x\n",
                 "property type 'quad'");
  expect_refused("orphan.ply", "ply\nformat ascii 1.0\nproperty float x\n", "before any element");
  expect_refused("negative.ply", ply("ascii", "-3", "1", points), "count -3");
  expect_refused("many.ply", ply("ascii", "99999999999", "1", points), "states 99999999999");
  expect_refused("many-binary.ply", ply("binary_little_endian", "4000000000", "1", points),
                 "states 4000000000");
  expect_refused("many-faces.ply", ply("ascii", "3", "1000000000", points + "3 0 1 2\n"),
                 "states 1000000000");
  expect_refused("long-list.ply",
                 ply("binary_little_endian", "0", "1",
                     "\xff"
                     "abc"),
                 "states 255");
  expect_refused("text-list.ply", ply("ascii", "3", "1", points + "200 0 1 2\n"), "states 200");
  expect_refused("cut.ply", ply("ascii", "3", "1", points + "3 0 1\n"), "missing at the end");
  expect_refused("cut-binary.ply", ply("binary_little_endian", "1", "1", std::string(12, '\0') + "\3abc"),
                 "states 3");
  expect_refused("range.ply", ply("ascii", "3", "1", points + "3 0 1 3\n"), "uses vertex 3");
  expect_refused("below.ply", ply("ascii", "3", "1", points + "3 0 1 -1\n"), "out of range");
  expect_refused("two.ply", ply("ascii", "3", "1", points + "2 0 1\n"), "2 corners");
  expect_refused("none.ply", ply("ascii", "3", "0", points), "no triangles");
  expect_refused("nan.ply", ply("ascii", "3", "1", "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n"), "vertex 1");
  expect_refused("word.ply", ply("ascii", "3", "1", "0 0 0\n1 x 0\n0 1 0\n3 0 1 2\n"), "found 'x'");
  expect_refused(
      "flat.ply",
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nend_header\n0 0\n",
      "lacks a property x, y or z");
}

TEST_F(MeshFiles, RefusesOtherFormats) {
  expect_refused("disc.step", "ISO-10303-21;", "expected .stl, .obj or .ply");
  expect_refused("disc", "solid", "expected .stl, .obj or .ply");
}

TEST_F(MeshFiles, NoCutOfAGoodFileIsReadAsAWholeOne) {
  // Every proper prefix of a file is either refused or, where only trailing words are missing, the same mesh.
  const TriangleMesh mesh = geometry::make_disc(1.0, 1.0, 1);
  write_ply(in_folder("whole.ply"), mesh, 1.0);
  write_stl(in_folder("whole.stl"), mesh, 1.0);
  for (const std::string& name : {std::string("whole.ply"), std::string("whole.stl")}) {
    const std::string whole = content(in_folder(name));
    for (std::size_t size = 0; size < whole.size(); ++size)
      refused(write("cut-" + name, whole.substr(0, size)));
  }
  const std::size_t last_word = kTextStl.rfind("endsolid") + 8;
  for (std::size_t size = 0; size < last_word; ++size) refused(write("cut.stl", kTextStl.substr(0, size)));
}

}  // namespace
}  // namespace abradem::io
