// SPDX-License-Identifier: BSD-3-Clause
// Any text as a table: whole rows, or an error of ours.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "abradem/core/error.h"
#include "abradem/io/csv.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace abradem;
  try {
    const io::CsvTable table = io::parse_csv({reinterpret_cast<const char*>(data), size}, "table.csv");
    if (table.rows() * table.columns.size() != table.values.size()) std::abort();
  } catch (const Error&) {
  }
  return 0;
}
