// SPDX-License-Identifier: BSD-3-Clause
// VTK XML PolyData [VTK File Formats, "XML File Formats"]: a header that describes arrays, then the arrays as
// appended raw blocks. Each array is [number of blocks][block size][size of the last, partial block or 0]
// [compressed sizes …] as UInt64, then the compressed blocks.
#include "abradem/io/vtp.h"

#include <fmt/core.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "abradem/core/error.h"
#include "abradem/io/atomic_file.h"

namespace abradem::io {

namespace {

using geometry::Index;

constexpr std::size_t kBlock = std::size_t{1} << 20;
constexpr int kLevel = 1;  // the later levels take three times as long for a tenth less

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

/// An array as it stands in the file.
std::string packed(const void* values, std::size_t bytes) {
  const auto* data = static_cast<const Bytef*>(values);
  std::vector<std::uint64_t> sizes{(bytes + kBlock - 1) / kBlock, kBlock, bytes % kBlock};
  std::string blocks;
  std::vector<Bytef> buffer(compressBound(kBlock));
  for (std::size_t begin = 0; begin < bytes; begin += kBlock) {
    uLongf size = buffer.size();
    if (compress2(buffer.data(), &size, data + begin, std::min(kBlock, bytes - begin), kLevel) != Z_OK)
      throw IoError("cannot compress an array for a VTP file");
    sizes.push_back(size);
    blocks.append(reinterpret_cast<const char*>(buffer.data()), size);
  }
  return std::string(reinterpret_cast<const char*>(sizes.data()), sizes.size() * sizeof(std::uint64_t)) +
         blocks;
}
std::string packed(std::span<const Index> values) { return packed(values.data(), values.size_bytes()); }

/// Where each cell of n corners ends.
std::vector<Index> ends_of_cells(std::size_t cells, Index n) {
  std::vector<Index> ends(cells);
  for (std::size_t i = 0; i < cells; ++i) ends[i] = static_cast<Index>(i + 1) * n;
  return ends;
}

/// Collects the header's lines and the appended data while a file is composed.
class Composer {
 public:
  void line(const std::string& text) { header_ += text + "\n"; }

  void array(const char* type, const std::string& name, int components, const std::string& packed_values) {
    header_ += fmt::format(
        R"(<DataArray type="{}" Name="{}" NumberOfComponents="{}" format="appended" offset="{}"/>)", type,
        escaped(name), components, data_.size());
    header_ += '\n';
    data_ += packed_values;
  }
  void array(const std::string& name, int components, std::span<const double> values) {
    array("Float64", name, components, packed(values.data(), values.size_bytes()));
  }

  /// The whole file.
  [[nodiscard]] std::string file() && {
    static_assert(std::endian::native == std::endian::little && sizeof(Index) == 4);
    return "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
           "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n" +
           header_ + "<AppendedData encoding=\"raw\">\n_" + data_ + "\n</AppendedData>\n</VTKFile>\n";
  }

 private:
  std::string header_, data_;
};

void add_fields(Composer& composer, const char* element, std::span<const VtpArray> arrays,
                std::size_t count) {
  composer.line(fmt::format("<{}>", element));
  for (const VtpArray& a : arrays) {
    if (a.components < 1 || a.values.size() != count * static_cast<std::size_t>(a.components))
      throw std::invalid_argument(fmt::format("VTP array '{}' has {} values; expected {} times {} components",
                                              a.name, a.values.size(), count, a.components));
    composer.array(a.name, a.components, a.values);
  }
  composer.line(fmt::format("</{}>", element));
}

void add_points(Composer& composer, std::span<const Vec3> points) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  composer.line("<Points>");
  composer.array("Float64", "Points", 3, packed(points.data(), points.size_bytes()));
  composer.line("</Points>");
}

void add_cells(Composer& composer, const char* element, const std::string& packed_corners,
               const std::string& packed_ends) {
  composer.line(fmt::format("<{}>", element));
  composer.array("Int32", "connectivity", 1, packed_corners);
  composer.array("Int32", "offsets", 1, packed_ends);
  composer.line(fmt::format("</{}>", element));
}

}  // namespace

VtpTriangles::VtpTriangles(std::span<const geometry::Triangle> triangles)
    : size_(triangles.size()),
      corners_(packed(triangles.data(), triangles.size_bytes())),
      ends_(packed(ends_of_cells(triangles.size(), 3))) {
  static_assert(sizeof(geometry::Triangle) == 3 * sizeof(Index));
}

void write_vtp(const std::filesystem::path& path, std::span<const Vec3> vertices,
               const VtpTriangles& triangles, std::span<const VtpArray> point_data,
               std::span<const VtpArray> cell_data) {
  Composer composer;
  composer.line(fmt::format(R"(<PolyData><Piece NumberOfPoints="{}" NumberOfPolys="{}">)", vertices.size(),
                            triangles.size()));
  add_fields(composer, "PointData", point_data, vertices.size());
  add_fields(composer, "CellData", cell_data, triangles.size());
  add_points(composer, vertices);
  add_cells(composer, "Polys", triangles.corners(), triangles.ends());
  composer.line("</Piece></PolyData>");
  write_file_atomically(path, std::move(composer).file());
}

void write_vtp_spheres(const std::filesystem::path& path, std::span<const Vec3> centres,
                       std::span<const double> radii, std::span<const VtpArray> point_data) {
  std::vector<VtpArray> arrays{{.name = "radius", .values = radii}};
  arrays.insert(arrays.end(), point_data.begin(), point_data.end());
  std::vector<Index> numbers(centres.size());
  std::iota(numbers.begin(), numbers.end(), 0);
  Composer composer;
  composer.line(fmt::format(R"(<PolyData><Piece NumberOfPoints="{0}" NumberOfVerts="{0}">)", centres.size()));
  add_fields(composer, "PointData", arrays, centres.size());
  add_points(composer, centres);
  add_cells(composer, "Verts", packed(numbers), packed(ends_of_cells(numbers.size(), 1)));
  composer.line("</Piece></PolyData>");
  write_file_atomically(path, std::move(composer).file());
}

void write_pvd(const std::filesystem::path& path, std::span<const PvdEntry> entries) {
  std::string out =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
      "<Collection>\n";
  for (const PvdEntry& e : entries)
    out +=
        fmt::format("<DataSet timestep=\"{}\" part=\"{}\" file=\"{}\"/>\n", e.time, e.part, escaped(e.file));
  out += "</Collection>\n</VTKFile>\n";
  write_file_atomically(path, out);
}

}  // namespace abradem::io
