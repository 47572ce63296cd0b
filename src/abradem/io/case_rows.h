// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abradem/io/case_schema.h"

/// The parts of case_rows(), by topic and in its order.
namespace abradem::io {

[[nodiscard]] std::span<const Row> material_rows();   ///< and contact, wear, ploughing
[[nodiscard]] std::span<const Row> body_rows();       ///< walls, named particles
[[nodiscard]] std::span<const Row> insertion_rows();  ///< and the domain
[[nodiscard]] std::span<const Row> run_rows();        ///< and output, measurement, study

}  // namespace abradem::io
