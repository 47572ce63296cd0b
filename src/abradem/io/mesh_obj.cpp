// SPDX-License-Identifier: BSD-3-Clause
// Wavefront files: `v x y z` and `f v/vt/vn …`; everything else describes looks.
#include <fmt/core.h>

#include "abradem/io/mesh_text.h"

namespace abradem::io::detail {

namespace {

using geometry::Index;
using geometry::TriangleMesh;

/// One corner of a face: the number before the first slash; counted from 1, or backwards from -1.
Index corner_index(const WordReader& reader, std::string_view word, Index vertices_so_far) {
  const std::int64_t number = reader.integer(word.substr(0, word.find('/')), "a vertex number");
  const std::int64_t index = number > 0 ? number - 1 : vertices_so_far + number;
  if (number == 0 || index < 0 || index > INT32_MAX)
    reader.fail(fmt::format(
        "vertex number {} is out of range; {} vertices come before it, counted from 1, or backwards "
        "from -1",
        number, vertices_so_far));
  return static_cast<Index>(index);
}

}  // namespace

TriangleMesh read_obj(const MeshText& text) {
  TriangleMesh mesh;
  WordReader reader(text);
  std::vector<Index> corners;
  // A word of the statement: a backslash at the end of a line continues it on the next.
  const auto next_word = [&] {
    std::string_view word = reader.word_in_line();
    while (word == "\\") {
      reader.next_line();
      word = reader.word_in_line();
    }
    return word;
  };
  for (; !reader.at_end(); reader.next_line()) {
    const std::string_view keyword = reader.word_in_line();
    if (keyword == "v") {
      Vec3 p;
      for (double* x : {&p.x, &p.y, &p.z}) *x = reader.number(next_word(), "a coordinate");
      mesh.vertices.push_back(p);
    } else if (keyword == "f") {
      corners.clear();
      for (std::string_view word = next_word(); !word.empty() && word[0] != '#'; word = next_word())
        corners.push_back(corner_index(reader, word, mesh.vertex_count()));
      if (corners.size() < 3)
        reader.fail(fmt::format("a face has {} corners; expected three or more", corners.size()));
      add_polygon(mesh, corners);
    }
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)  // a face may come before its vertices
    for (const Index v : mesh.triangles[t])
      if (v >= mesh.vertex_count())
        text.fail(fmt::format("a face uses vertex {}, but there are {} vertices", v + std::int64_t{1},
                              mesh.vertex_count()));
  return mesh;
}

}  // namespace abradem::io::detail
