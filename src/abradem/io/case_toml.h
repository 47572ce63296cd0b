// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "abradem/io/case_problems.h"
#include "abradem/io/case_value.h"

namespace abradem::io {

/// Reads TOML. A syntax error is added to `problems` (TOML readers stop at the first), and the tree is then
/// empty.
[[nodiscard]] Value parse_toml(std::string_view text, Problems& problems);

/// Lays `KEY=VALUE` over the tree. The key is a dotted TOML key; a value that is not TOML is taken as text,
/// so that `run.end=24 s` needs no quotes for the shell to eat. Problems go to `problems` under the name
/// `--set`.
void apply_override(Value& tree, std::string_view assignment, Problems& problems);

}  // namespace abradem::io
