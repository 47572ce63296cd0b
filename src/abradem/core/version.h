// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// What this build is; recorded in every run.
namespace abradem::core {
[[nodiscard]] const char* version() noexcept;
[[nodiscard]] const char* commit() noexcept;
[[nodiscard]] const char* compiler() noexcept;
[[nodiscard]] const char* compiler_flags() noexcept;
}  // namespace abradem::core
