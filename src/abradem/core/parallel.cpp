// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/core/parallel.h"

#include <omp.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

namespace abradem::core::parallel_detail {

namespace {

constexpr std::size_t kMostThreads = 256;
constexpr int kSpins = 4000;  // some 20 us: loops of one step follow each other faster than a thread wakes up

void pause() noexcept {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}

/// Threads that wait for loops. A loop is cut into one range per thread; each works through its own and then
/// through what is left of the others'.
class Pool {
 public:
  void run(std::size_t count, std::size_t grain, std::size_t threads, Call call, void* body) {
    start(threads - 1);
    call_.store(call, std::memory_order_relaxed);
    body_.store(body, std::memory_order_relaxed);
    grain_.store(grain, std::memory_order_relaxed);
    parts_.store(threads, std::memory_order_relaxed);
    done_.store(0, std::memory_order_relaxed);
    ++epoch_;
    for (std::size_t p = 0; p < threads; ++p) {
      part_[p].end.store(static_cast<std::uint32_t>((p + 1) * count / threads), std::memory_order_relaxed);
      part_[p].next.store(ticket(epoch_, p * count / threads), std::memory_order_release);
    }
    posted_.store(epoch_, std::memory_order_seq_cst);
    if (asleep_.load(std::memory_order_seq_cst) > 0) posted_.notify_all();
    work(epoch_, 0);
    // What others have begun they will end: it was taken by a thread that was running.
    for (int spin = 0; done_.load(std::memory_order_acquire) < count; ++spin)
      if (spin < kSpins)
        pause();
      else
        std::this_thread::yield();
  }

 private:
  /// Next index of a range, and above it the loop that it belongs to: a thread that is late by a loop cannot
  /// take anything.
  struct alignas(64) Part {
    std::atomic<std::uint64_t> next{0};
    std::atomic<std::uint32_t> end{0};
  };
  static std::uint64_t ticket(std::uint32_t epoch, std::size_t next) noexcept {
    return (std::uint64_t{epoch} << 32U) | next;
  }

  void start(std::size_t helpers) {
    for (; helpers_ < helpers; ++helpers_)
      std::thread([this, own = helpers_ + 1] { wait_for_loops(own); }).detach();
  }

  void wait_for_loops(std::size_t own) noexcept {
    std::uint32_t seen = 0;
    for (;;) {
      std::uint32_t posted = posted_.load(std::memory_order_acquire);
      for (int spin = 0; spin < kSpins && posted == seen; ++spin) {
        pause();
        posted = posted_.load(std::memory_order_acquire);
      }
      if (posted == seen) {
        asleep_.fetch_add(1, std::memory_order_seq_cst);
        posted_.wait(seen, std::memory_order_seq_cst);
        asleep_.fetch_sub(1, std::memory_order_relaxed);
        posted = posted_.load(std::memory_order_acquire);
      }
      seen = posted;
      work(posted, own);
    }
  }

  void work(std::uint32_t epoch, std::size_t own) noexcept {
    const std::size_t parts = parts_.load(std::memory_order_relaxed);
    if (own >= parts) return;  // fewer threads are asked for than there once were
    for (std::size_t k = 0; k < parts; ++k) {
      Part& part = part_[(own + k) % parts];
      std::uint64_t next = part.next.load(std::memory_order_acquire);
      for (;;) {
        const auto first = static_cast<std::uint32_t>(next);
        const std::uint32_t end = part.end.load(std::memory_order_relaxed);
        if (next >> 32U != epoch || first >= end) break;
        // Read before the range is taken: as long as something is left to take, they are this loop's.
        const Call call = call_.load(std::memory_order_relaxed);
        void* const body = body_.load(std::memory_order_relaxed);
        const std::size_t grain = grain_.load(std::memory_order_relaxed);
        const auto last = static_cast<std::uint32_t>(std::min<std::size_t>(end, first + grain));
        if (!part.next.compare_exchange_weak(next, ticket(epoch, last), std::memory_order_acq_rel,
                                             std::memory_order_acquire))
          continue;
        call(body, first, last);
        done_.fetch_add(last - first, std::memory_order_acq_rel);
        next = part.next.load(std::memory_order_acquire);
      }
    }
  }

  std::array<Part, kMostThreads> part_;
  alignas(64) std::atomic<std::uint32_t> posted_{0};
  std::atomic<int> asleep_{0};
  alignas(64) std::atomic<std::size_t> done_{0};
  std::atomic<Call> call_{nullptr};
  std::atomic<void*> body_{nullptr};
  std::atomic<std::size_t> grain_{1}, parts_{0};
  std::uint32_t epoch_ = 0;
  std::size_t helpers_ = 0;
};

/// Never destroyed: its threads wait until the process ends. A forked child has none of them and makes its
/// own.
Pool& pool() {
  static Pool* made = nullptr;
  static pid_t maker = 0;
  if (made == nullptr || maker != getpid()) made = new Pool, maker = getpid();
  return *made;
}

std::mutex one_at_a_time;
thread_local bool inside = false;

}  // namespace

void share_out(std::size_t count, std::size_t grain, Call call, void* body) {
  const auto threads = std::min({static_cast<std::size_t>(std::max(omp_get_max_threads(), 1)), kMostThreads,
                                 (count + grain - 1) / std::max<std::size_t>(grain, 1)});
  // A loop inside a loop, or beside another one, runs where it is.
  std::unique_lock lock(one_at_a_time, std::defer_lock);
  if (threads < 2 || inside || count >= UINT32_MAX || !lock.try_lock()) {
    call(body, 0, count);
    return;
  }
  inside = true;
  pool().run(count, grain, threads, call, body);
  inside = false;
}

}  // namespace abradem::core::parallel_detail
