// SPDX-License-Identifier: BSD-3-Clause
// Any bytes as an STL file: a mesh that can be checked, repaired and used, or an error of ours.
#include "abradem/io/mesh_text.h"
#include "fuzz/fuzz_mesh.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return abradem::test::fuzz_mesh({reinterpret_cast<const char*>(data), size}, abradem::io::detail::read_stl);
}
