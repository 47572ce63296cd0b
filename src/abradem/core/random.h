// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

namespace abradem::core {

/// One step of SplitMix64: a bijective scramble of 64 bits [Steele, Lea & Flood, OOPSLA 2014]. Also the hash
/// that turns (seed, counter) into independent values, so that nothing depends on an order of evaluation.
[[nodiscard]] constexpr std::uint64_t splitmix64(std::uint64_t x) noexcept {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

/// Uniform in [0, 1) with 53 random bits.
[[nodiscard]] constexpr double unit_interval(std::uint64_t bits) noexcept {
  return static_cast<double>(bits >> 11) * 0x1.0p-53;
}

/// A seeded random stream, xoshiro256++ [Blackman & Vigna, ACM TOMS 47(4), 2021]. Written out here because
/// the distributions of the standard library give other bits with other compilers. Give every entity its own
/// stream number: streams of one seed are independent of each other and of the order they are used in.
class RandomStream {
 public:
  explicit constexpr RandomStream(std::uint64_t seed, std::uint64_t stream = 0) noexcept {
    std::uint64_t x = splitmix64(seed) ^ splitmix64(~stream);
    for (std::uint64_t& word : state_) word = x = splitmix64(x);
  }

  /// 64 uniform bits.
  constexpr std::uint64_t bits() noexcept {
    const std::uint64_t result = rotated(state_[0] + state_[3], 23) + state_[0];
    const std::uint64_t shifted = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= shifted;
    state_[3] = rotated(state_[3], 45);
    return result;
  }
  /// Uniform in [0, 1).
  constexpr double uniform() noexcept { return unit_interval(bits()); }
  /// Uniform in [low, high).
  constexpr double uniform(double low, double high) noexcept { return low + (high - low) * uniform(); }

  /// For core/archive.h.
  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("state", self.state_);
  }

 private:
  static constexpr std::uint64_t rotated(std::uint64_t x, int k) noexcept {
    return (x << k) | (x >> (64 - k));
  }
  std::array<std::uint64_t, 4> state_{};
};

}  // namespace abradem::core
