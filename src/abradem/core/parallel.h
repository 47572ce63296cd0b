// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace abradem::core {

/// Calls body(i) for i = 0 … count - 1, on all threads when there is enough to share out. The bodies must
/// write to places of their own; then the result does not depend on the number of threads.
/// @param worth_sharing fewer bodies than this run on the calling thread: meeting the others takes some
/// microseconds, and far more where the machine is busy
template <typename Body>
void parallel_for(std::size_t count, Body&& body, std::size_t worth_sharing = 9) {
  if (count < worth_sharing) {
    for (std::size_t i = 0; i < count; ++i) body(i);
    return;
  }
  const auto n = static_cast<std::ptrdiff_t>(count);
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t i = 0; i < n; ++i) body(static_cast<std::size_t>(i));
}

/// The same for a few large bodies: shared out from two on.
template <typename Body>
void parallel_blocks(std::size_t count, Body&& body) {
  const auto n = static_cast<std::ptrdiff_t>(count);
#pragma omp parallel for schedule(static) if (n > 1)
  for (std::ptrdiff_t i = 0; i < n; ++i) body(static_cast<std::size_t>(i));
}

}  // namespace abradem::core
