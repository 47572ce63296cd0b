// SPDX-License-Identifier: BSD-3-Clause
// Stereolithography files: 80 bytes of anything, a count, 50 bytes per triangle; or text.
#include <fmt/core.h>

#include <bit>
#include <cmath>
#include <cstring>

#include "abradem/io/mesh_text.h"

namespace abradem::io::detail {

namespace {

using geometry::Index;
using geometry::TriangleMesh;

constexpr std::size_t kHeader = 84, kRecord = 50;
static_assert(std::endian::native == std::endian::little);

std::uint32_t stated_count(std::string_view data) noexcept {
  std::uint32_t count = 0;
  std::memcpy(&count, data.data() + 80, 4);
  return count;
}

/// Text begins with `solid`, and a facet or the end follows soon without a zero byte. A binary file whose
/// size fits its count is binary whatever its header says.
bool is_text(std::string_view data) {
  if (data.size() >= kHeader && data.size() == kHeader + kRecord * std::size_t{stated_count(data)})
    return false;
  const std::string_view start = data.substr(0, 1024);
  const std::size_t word = start.find_first_not_of(" \t\r\n");
  if (word == std::string_view::npos || start.find('\0') != std::string_view::npos) return false;
  return equals_ignoring_case(start.substr(word, 5), "solid");
}

void add_triangle(TriangleMesh& mesh, const Vec3 (&corner)[3]) {
  const Index first = mesh.vertex_count();
  for (const Vec3& p : corner) mesh.vertices.push_back(p);
  mesh.triangles.push_back({first, first + 1, first + 2});
}

TriangleMesh read_binary(const MeshText& text) {
  const std::string_view data = text.data;
  if (data.size() < kHeader)
    text.fail(fmt::format("{} bytes are too few for an STL file, and it is not text beginning with 'solid'",
                          data.size()));
  const std::size_t count = stated_count(data);
  const std::size_t needed = kHeader + kRecord * count;
  if (needed > data.size())
    text.fail(
        fmt::format("truncated, or not an STL file: it states {} triangles, which need {} bytes, but has {}",
                    count, needed, data.size()));
  TriangleMesh mesh;
  mesh.vertices.reserve(3 * count);
  mesh.triangles.reserve(count);
  for (std::size_t t = 0; t < count; ++t) {
    float number[12];
    std::memcpy(number, data.data() + kHeader + kRecord * t, sizeof number);
    Vec3 corner[3];
    for (std::size_t k = 0; k < 3; ++k) {
      corner[k] = {number[3 * k + 3], number[3 * k + 4], number[3 * k + 5]};
      if (!is_finite(corner[k]))
        text.fail(fmt::format("triangle {} has a coordinate that is not finite", t + 1));
    }
    add_triangle(mesh, corner);
  }
  return mesh;
}

TriangleMesh read_text(const MeshText& text) {
  TriangleMesh mesh;
  WordReader reader(text);
  const auto expect = [&](const char* keyword) {
    const std::string_view word = reader.word();
    if (word.empty()) reader.fail(fmt::format("truncated: expected '{}', but the file ends", keyword));
    if (!equals_ignoring_case(word, keyword))
      reader.fail(fmt::format("expected '{}' after {} whole triangles, found '{}'", keyword,
                              mesh.triangles.size(), shown(word)));
  };
  bool inside = false;
  for (std::string_view word = reader.word(); !word.empty(); word = reader.word()) {
    const bool begins = equals_ignoring_case(word, "solid");
    if (begins || equals_ignoring_case(word, "endsolid")) {
      inside = begins;
      reader.next_line();  // the rest is a name
      continue;
    }
    if (!inside || !equals_ignoring_case(word, "facet"))
      reader.fail(fmt::format("expected '{}' after {} whole triangles, found '{}'",
                              inside ? "facet' or 'endsolid" : "solid", mesh.triangles.size(), shown(word)));
    expect("normal");
    for (int i = 0; i < 3; ++i) reader.word();  // not used, and often not numbers
    expect("outer");
    expect("loop");
    Vec3 corner[3];
    for (Vec3& p : corner) {
      expect("vertex");
      for (double* x : {&p.x, &p.y, &p.z}) *x = reader.number(reader.word(), "a coordinate");
    }
    expect("endloop");
    expect("endfacet");
    add_triangle(mesh, corner);
  }
  if (inside) text.fail(fmt::format("truncated: no 'endsolid' after {} triangles", mesh.triangles.size()));
  return mesh;
}

}  // namespace

TriangleMesh read_stl(const MeshText& text) {
  return is_text(text.data) ? read_text(text) : read_binary(text);
}

}  // namespace abradem::io::detail
