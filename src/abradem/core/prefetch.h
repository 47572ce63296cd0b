// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace abradem::core {

/// Asks the memory for what lies there, line by line: for those who know early what they will need.
/// @tparam kWrite it will be written
template <bool kWrite = false>
inline void prefetch(const void* from, std::size_t bytes) noexcept {
  for (std::size_t byte = 0; byte < bytes; byte += 64)
    __builtin_prefetch(static_cast<const char*>(from) + byte, kWrite ? 1 : 0);
}

}  // namespace abradem::core
