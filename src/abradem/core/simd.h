// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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

}  // namespace abradem::core
