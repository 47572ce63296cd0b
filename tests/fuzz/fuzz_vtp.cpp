// SPDX-License-Identifier: BSD-3-Clause
// Any bytes as a surface of a run (.vtp) and as its list of frames (.pvd): a mesh whose triangles have their
// corners, or an error of ours.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "abradem/core/error.h"
#include "abradem/io/vtp_read.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace abradem;
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    const geometry::TriangleMesh mesh = io::parse_vtp(text, "fuzzed.vtp").mesh;
    for (const geometry::Triangle& t : mesh.triangles)
      for (const geometry::Index corner : t)
        if (corner < 0 || static_cast<std::size_t>(corner) >= mesh.vertices.size()) std::abort();
  } catch (const Error&) {
  }
  try {
    (void)io::parse_pvd(text, "fuzzed.pvd");
  } catch (const Error&) {
  }
  return 0;
}
