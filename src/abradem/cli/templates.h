// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string_view>

namespace abradem::cli {

/// A case file that `abradem new` writes; its text is that of a file in cases/, put in by the build.
struct CaseTemplate {
  std::string_view name;
  std::string_view text;
};

[[nodiscard]] std::span<const CaseTemplate> case_templates() noexcept;

}  // namespace abradem::cli
