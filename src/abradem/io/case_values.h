// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abradem/io/case_problems.h"
#include "abradem/io/case_schema.h"
#include "abradem/io/case_value.h"

namespace abradem::io {

/// Reads one value of the file into the member its row names, checking kind, dimension and limits.
/// @return false when the value is wrong; the reason is then in `problems`
[[nodiscard]] bool read_value(const Row& row, const Value& value, const Target& target, Problems& problems);

}  // namespace abradem::io
