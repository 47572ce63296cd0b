// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

/// Loops marked ABRADEM_DISPATCH are compiled for several instruction sets; the machine's best is taken at
/// start up. They are written so that every set gives the same bits: elementwise, or summed in eight fixed
/// lanes.
namespace abradem::core {

#if defined(__x86_64__) && defined(__GNUC__) && !defined(ABRADEM_NO_DISPATCH)
#define ABRADEM_DISPATCH __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define ABRADEM_DISPATCH
#endif
/// Eight doubles that a loop sums in, one per lane; stays in registers whatever their width.
using Lanes = double __attribute__((vector_size(64), aligned(8), may_alias));
/// The lanes' sum in a fixed order.
#define ABRADEM_SUM_LANES(v) \
  ((((v)[0] + (v)[1]) + ((v)[2] + (v)[3])) + (((v)[4] + (v)[5]) + ((v)[6] + (v)[7])))
/// What such a loop calls must become part of it.
#define ABRADEM_INLINE inline __attribute__((always_inline))

/// Eight numbers from any place. Copied: clang takes a pointer to lanes for one that is aligned to all of
/// them.
ABRADEM_INLINE void load_lanes(Lanes& to, const double* from) { __builtin_memcpy(&to, from, sizeof to); }

/// Sum of an array padded to eight lanes; call it from such a loop's function.
ABRADEM_INLINE double sum_lanes(const double* values, std::size_t padded_count) {
  // Halves of the eight lanes: the widest that all machines with vectors worth the name keep in registers.
  using Half = double __attribute__((vector_size(32), aligned(8), may_alias));
  Half low{}, high{};
  for (std::size_t i = 0; i < padded_count; i += 8) {
    low += *reinterpret_cast<const Half*>(values + i);
    high += *reinterpret_cast<const Half*>(values + i + 4);
  }
  return ((low[0] + low[1]) + (low[2] + low[3])) + ((high[0] + high[1]) + (high[2] + high[3]));
}

}  // namespace abradem::core
