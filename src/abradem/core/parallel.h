// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>

/// Loops shared out among threads, as many as omp_get_max_threads() says (OMP_NUM_THREADS, --threads).
///
/// The threads are our own and not OpenMP's, whose loops end when every thread has arrived: where the cores
/// are shared with other programs, all wait at every loop for one that is not running. Here a thread that
/// comes late finds its part done by the others, and nobody waits for it.
namespace abradem::core {

namespace parallel_detail {

using Call = void (*)(void* body, std::size_t first, std::size_t last);
/// Calls call(body, first, last) over disjoint ranges that make up 0 … count, on all threads; `grain` indices
/// at a time.
void share_out(std::size_t count, std::size_t grain, Call call, void* body);

template <typename Body>
void run(std::size_t count, std::size_t grain, Body& body) {
  share_out(
      count, grain,
      [](void* b, std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) (*static_cast<Body*>(b))(i);
      },
      const_cast<std::remove_const_t<Body>*>(std::addressof(body)));
}

}  // namespace parallel_detail

/// Calls body(i) for i = 0 … count - 1, on all threads when there is enough to share out. The bodies must
/// write to places of their own and not throw; then the result does not depend on the number of threads.
/// @param worth_sharing fewer bodies than this run on the calling thread: meeting the others takes some
/// microseconds
template <typename Body>
void parallel_for(std::size_t count, Body&& body, std::size_t worth_sharing = 9) {
  if (count < worth_sharing) {
    for (std::size_t i = 0; i < count; ++i) body(i);
    return;
  }
  constexpr std::size_t kPieces = 32;
  parallel_detail::run(count, count / kPieces + 1, body);
}

/// The same for a few large bodies: shared out from two on, one by one.
template <typename Body>
void parallel_blocks(std::size_t count, Body&& body) {
  parallel_detail::run(count, 1, body);
}

}  // namespace abradem::core
