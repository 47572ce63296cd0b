// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/case_rows.h"

namespace abradem::io {

std::span<const Row> case_rows() {
  static const std::vector<Row> rows = [] {
    std::vector<Row> all;
    for (const std::span<const Row> part : {material_rows(), body_rows(), insertion_rows(), run_rows()})
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }();
  return rows;
}

}  // namespace abradem::io
