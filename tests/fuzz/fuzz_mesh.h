// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "abradem/core/error.h"
#include "abradem/geometry/mesh_check.h"
#include "abradem/geometry/mesh_repair.h"
#include "abradem/io/mesh_text.h"

namespace abradem::test {

/// Reads, repairs and checks a mesh as a run does.
template <typename Read>
int fuzz_mesh(std::string_view data, const Read& read) {
  if (data.empty()) return 0;  // refused before the readers are asked
  try {
    const std::string content(data);
    const std::string name = "fuzzed";
    geometry::TriangleMesh mesh = read(io::detail::MeshText{name, content});
    if (mesh.triangles.empty()) return 0;
    for (const Vec3& v : mesh.vertices)
      if (!is_finite(v)) return 0;  // refused by read_mesh
    geometry::repair_mesh(mesh);
    if (!mesh.triangles.empty()) (void)geometry::judge_mesh(geometry::check_mesh(mesh), 1.0);
  } catch (const Error&) {
  }
  return 0;
}

}  // namespace abradem::test
