// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstdint>
#include <span>

#include "abradem/core/vec3.h"

namespace abradem::core {

/// 64-bit hash of a state's exact bits (FNV-1a over 64-bit words, finished with a mixer). Equal states on any
/// thread count give equal hashes; it guards against accidents, not against malice.
class StateHash {
 public:
  void add(std::uint64_t word) noexcept {
    value_ ^= word;
    value_ *= 0x100000001b3ULL;
    value_ ^= value_ >> 32;
  }
  void add(double x) noexcept { add(std::bit_cast<std::uint64_t>(x)); }
  void add(const Vec3& v) noexcept { add(v.x), add(v.y), add(v.z); }
  template <typename T>
  void add(std::span<const T> items) noexcept {
    for (const T& item : items) add(item);
  }
  [[nodiscard]] std::uint64_t value() const noexcept {
    std::uint64_t h = value_;
    h = (h ^ (h >> 33)) * 0xff51afd7ed558ccdULL;
    h = (h ^ (h >> 33)) * 0xc4ceb9fe1a85ec53ULL;
    return h ^ (h >> 33);
  }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

}  // namespace abradem::core
