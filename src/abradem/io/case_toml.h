// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "abradem/io/case_problems.h"
#include "abradem/io/case_value.h"

namespace abradem::io {

/// Reads TOML. A syntax error is added to `problems` (TOML readers stop at the first), and the tree is then
/// empty.
[[nodiscard]] Value parse_toml(std::string_view text, Problems& problems);

/// What an override `KEY=VALUE` changes, as a tree. The key is a dotted TOML key; a value that is not TOML is
/// taken as text, so that `run.end=24 s` needs no quotes for the shell to eat. Problems go to `problems`
/// under the name
/// `--set`.
[[nodiscard]] Value parse_override(std::string_view assignment, Problems& problems);

/// A tree with this value alone, at a dotted TOML key written at `place` (in the file). A key that cannot be
/// one is added to `problems`, and the tree is then empty.
[[nodiscard]] Value tree_of(std::string_view key, const Place& place, const Value& value, Problems& problems);

/// Lays changes over the tree: they replace values and add keys, but no new material, wall, particle or pair.
void lay_over(Value& tree, const Value& change, Problems& problems);

/// The value as TOML on one line; reading it gives the same value.
[[nodiscard]] std::string toml_text(const Value& value);

/// Whether the entry is a step of a dotted key (a.b = …), which goes into the table there; an inline table
/// (a = { … }) takes its place.
[[nodiscard]] bool is_dotted(const Entry& entry) noexcept;

}  // namespace abradem::io
