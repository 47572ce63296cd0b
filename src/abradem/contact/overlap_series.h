// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

/// Power series in epsilon = e / R^2, with e = R^2 - |x - c|^2 (positive inside the ball): no root and no
/// difference of near-equal numbers is left in the integrals of a shallow overlap.
namespace abradem::contact::series {

inline constexpr std::size_t kTerms = 8;

/// g / R = 1 - sqrt(1 - eps) = sum kOverlap[k] eps^k.
inline constexpr std::array<double, kTerms + 1> kOverlap{
    0.0, 1.0 / 2, 1.0 / 8, 1.0 / 16, 5.0 / 128, 7.0 / 256, 21.0 / 1024, 33.0 / 2048, 429.0 / 32768};

/// Binomial series of (1 - eps)^(-3/2).
inline constexpr std::array<double, kTerms + 1> kInverseCubedRoot{
    1.0,         3.0 / 2,       15.0 / 8,      35.0 / 16,       315.0 / 128,
    693.0 / 256, 3003.0 / 1024, 6435.0 / 2048, 109395.0 / 32768};

/// Weight of M on the surface, Q(r) / (R r^3) with Q the integral of (R - s) s^2 from r to R:
/// (1 - eps)^(-3/2) / 12 - 1/3 + (1 - eps)^(1/2) / 4 = sum kWeighted[k] eps^k; starts at eps^2 / 8.
inline constexpr std::array<double, kTerms + 1> kWeighted = [] {
  std::array<double, kTerms + 1> c{};
  for (std::size_t k = 2; k <= kTerms; ++k) c[k] = kInverseCubedRoot[k] / 12 - kOverlap[k] / 4;
  return c;
}();

}  // namespace abradem::contact::series
