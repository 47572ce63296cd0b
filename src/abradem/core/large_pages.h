// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdlib>
#include <new>

namespace abradem::core {

/// Allocator of arrays that a step runs through. Where they are large it asks for large pages: small ones are
/// more than a processor can keep the addresses of. A machine that has none to give gives small ones.
template <typename T>
struct LargePages {
  using value_type = T;
  static constexpr std::size_t kPage = std::size_t{1} << 21U;

  LargePages() noexcept = default;
  template <typename U>
  explicit(false) LargePages(const LargePages<U>&) noexcept {}  // NOLINT(google-explicit-constructor)

  [[nodiscard]] T* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    if (bytes < kPage) return static_cast<T*>(::operator new (bytes, std::align_val_t{alignment()}));
    const std::size_t whole = (bytes + kPage - 1) / kPage * kPage;
    void* const memory = std::aligned_alloc(kPage, whole);
    if (memory == nullptr) throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
    ::madvise(memory, whole, MADV_HUGEPAGE);  // advice: nothing depends on whether it is taken
#endif
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t count) noexcept {
    if (count * sizeof(T) < kPage)
      ::operator delete (memory, std::align_val_t{alignment()});
    else
      std::free(memory);
  }
  friend bool operator==(const LargePages&, const LargePages&) noexcept { return true; }

 private:
  static constexpr std::size_t alignment() noexcept { return alignof(T) > 64 ? alignof(T) : 64; }
};

}  // namespace abradem::core
