// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/mesh_files.h"

#include <fmt/core.h>

#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <new>
#include <system_error>

#include "abradem/core/error.h"
#include "abradem/geometry/mesh_repair.h"
#include "abradem/io/atomic_file.h"
#include "abradem/io/mesh_text.h"

namespace abradem::io {

namespace {

using geometry::Index;
using geometry::Triangle;
using geometry::TriangleMesh;

/// About 10^8 triangles of binary STL, and few enough for Index whatever the format.
constexpr std::uintmax_t kMostBytes = 6'000'000'000;

std::string file_content(const std::filesystem::path& path) {
  const auto fail = [&](const std::string& why) {
    throw IoError(fmt::format("cannot read mesh '{}': {}", path.string(), why));
  };
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status))
    fail("no such file; relative paths start from the folder of the case file");
  if (std::filesystem::is_directory(status)) fail("it is a directory; name the mesh file in it");
  if (!std::filesystem::is_regular_file(status)) fail("it is not a regular file");
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) fail(error.message());
  if (size > kMostBytes)
    throw GeometryError(
        fmt::format("cannot read mesh '{}': it has {} bytes; at most {} are possible (about 10^8 "
                    "triangles): coarsen the mesh",
                    path.string(), size, kMostBytes));
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) fail(std::generic_category().message(errno));
  std::string content(size, '\0');
  content.resize(std::fread(content.data(), 1, size, file.get()));
  if (std::ferror(file.get())) fail("reading failed");
  return content;
}

void append_raw(std::string& out, const void* data, std::size_t size) {
  static_assert(std::endian::native == std::endian::little,
                "binary STL and PLY are written as memory has them");
  out.append(static_cast<const char*>(data), size);
}

TriangleMesh read_known(const std::filesystem::path& path, double unit) {
  const std::string suffix = path.extension().string();
  const auto is = [&](const char* known) { return detail::equals_ignoring_case(suffix, known); };
  const std::string content = file_content(path);
  const detail::MeshText text{path.string(), content};
  if (!is(".stl") && !is(".obj") && !is(".ply"))
    text.fail(fmt::format("unknown suffix '{}'; expected .stl, .obj or .ply", suffix));
  if (content.empty()) text.fail("the file is empty");
  TriangleMesh mesh = is(".stl")   ? detail::read_stl(text)
                      : is(".obj") ? detail::read_obj(text)
                                   : detail::read_ply(text);
  if (mesh.triangles.empty()) text.fail("it contains no triangles");
  if (is(".stl")) geometry::weld_vertices(mesh);
  for (Vec3& v : mesh.vertices) {
    v *= unit;
    if (!is_finite(v)) text.fail(fmt::format("coordinates times the unit {} m are not finite", unit));
  }
  return mesh;
}

}  // namespace

TriangleMesh read_mesh(const std::filesystem::path& path, double unit) {
  if (!(std::isfinite(unit) && unit > 0.0))
    throw InputError(
        fmt::format("the unit of mesh '{}' is {} m; expected a positive length, for instance 0.001 for "
                    "millimetres",
                    path.string(), unit));
  try {
    return read_known(path, unit);
  } catch (const std::bad_alloc&) {
    throw GeometryError(
        fmt::format("cannot read mesh '{}': it does not fit into memory; coarsen it", path.string()));
  }
}

void write_stl(const std::filesystem::path& path, const TriangleMesh& mesh, double unit) {
  std::string out(80, ' ');
  out.replace(0, 7, "abradem");
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  append_raw(out, &count, 4);
  out.reserve(84 + 50 * mesh.triangles.size());
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    const Triangle& v = mesh.triangles[static_cast<std::size_t>(t)];
    const Vec3 points[4] = {normalized(area_vector(mesh, t)),
                            mesh.vertices[static_cast<std::size_t>(v[0])] / unit,
                            mesh.vertices[static_cast<std::size_t>(v[1])] / unit,
                            mesh.vertices[static_cast<std::size_t>(v[2])] / unit};
    for (const Vec3& p : points) {
      const float single[3] = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
      append_raw(out, single, 12);
    }
    out.append(2, '\0');
  }
  write_file_atomically(path, out);
}

void write_ply(const std::filesystem::path& path, const TriangleMesh& mesh, double unit) {
  std::string out = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment abradem\nelement vertex {}\nproperty double x\nproperty "
      "double y\n"
      "property double z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
      mesh.vertices.size(), mesh.triangles.size());
  for (const Vec3& vertex : mesh.vertices) {
    const Vec3 p = vertex / unit;
    const double xyz[3] = {p.x, p.y, p.z};
    append_raw(out, xyz, 24);
  }
  for (const Triangle& t : mesh.triangles) {
    out += '\3';
    append_raw(out, t.data(), 12);
  }
  write_file_atomically(path, out);
}

}  // namespace abradem::io
