// SPDX-License-Identifier: BSD-3-Clause
// Any text as a case file: a setup that can be written and read again to the same, or an error of ours.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "abradem/core/error.h"
#include "abradem/io/case_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace abradem;
  try {
    const io::Case read =
        io::parse_case({reinterpret_cast<const char*>(data), size}, "case.toml", "/nowhere");
    const std::string resolved = io::resolved_case(read.setup);
    if (io::resolved_case(io::parse_case(resolved, "resolved.toml", "/nowhere").setup) != resolved)
      std::abort();
  } catch (const Error&) {
  }
  return 0;
}
