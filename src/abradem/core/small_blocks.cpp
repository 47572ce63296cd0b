// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/core/small_blocks.h"

#include <algorithm>

#include "abradem/core/large_pages.h"

// Sanitizers are to watch each block by itself.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define ABRADEM_WATCHED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define ABRADEM_WATCHED
#endif
#endif

namespace abradem::core {

#ifndef ABRADEM_WATCHED
namespace {

/// Pieces of slabs on large pages. What comes back is the pool's to use again: nothing does before the end.
class Slabs : public std::pmr::memory_resource {
  static constexpr std::size_t kSlab = 2 * LargePages<std::byte>::kPage;

  void* do_allocate(std::size_t bytes, std::size_t alignment) override {
    used_ = (used_ + alignment - 1) / alignment * alignment;
    if (bytes > size_ - std::min(used_, size_)) {
      size_ = std::max(bytes, kSlab);
      slab_ = LargePages<std::byte>().allocate(size_);
      used_ = 0;
    }
    void* const piece = slab_ + used_;
    used_ += bytes;
    return piece;
  }
  void do_deallocate(void*, std::size_t, std::size_t) override {}
  [[nodiscard]] bool do_is_equal(const std::pmr::memory_resource& other) const noexcept override {
    return this == &other;
  }

  std::byte* slab_ = nullptr;
  std::size_t size_ = 0, used_ = 0;
};

}  // namespace
#endif

std::pmr::memory_resource& small_blocks() {
#ifdef ABRADEM_WATCHED
  return *std::pmr::new_delete_resource();
#else
  // Never destroyed: objects with static lifetime may outlast it.
  static auto* const pool = new std::pmr::synchronized_pool_resource(
      {.max_blocks_per_chunk = 256, .largest_required_pool_block = 8192}, new Slabs);
  return *pool;
#endif
}

}  // namespace abradem::core
