// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory_resource>
#include <vector>

namespace abradem::core {

/// Memory of the small arrays that thousands of contacts have each: side by side on large pages, where a
/// processor can keep their addresses. It grows with need and is used again, and lasts as long as the
/// program. Any thread may ask.
[[nodiscard]] std::pmr::memory_resource& small_blocks();

/// Allocator from small_blocks().
template <typename T>
struct SmallBlocks {
  using value_type = T;
  SmallBlocks() noexcept = default;
  template <typename U>
  explicit(false) SmallBlocks(const SmallBlocks<U>&) noexcept {}  // NOLINT(google-explicit-constructor)

  [[nodiscard]] T* allocate(std::size_t count) {
    return static_cast<T*>(small_blocks().allocate(count * sizeof(T), alignof(T)));
  }
  void deallocate(T* memory, std::size_t count) noexcept {
    small_blocks().deallocate(memory, count * sizeof(T), alignof(T));
  }
  friend bool operator==(const SmallBlocks&, const SmallBlocks&) noexcept { return true; }
};

template <typename T>
using PooledVector = std::vector<T, SmallBlocks<T>>;

/// A class that derives from it is made by `new` in small_blocks().
struct InSmallBlocks {
  static void* operator new(std::size_t bytes) { return small_blocks().allocate(bytes); }
  static void operator delete(void* memory, std::size_t bytes) noexcept {
    small_blocks().deallocate(memory, bytes);
  }
};

}  // namespace abradem::core
