// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Loops marked ABRADEM_DISPATCH are compiled for several instruction sets; the machine's best is taken at start
/// up. They are written so that every set gives the same bits: elementwise, or summed in eight fixed lanes.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(ABRADEM_NO_DISPATCH)
#define ABRADEM_DISPATCH __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define ABRADEM_DISPATCH
#endif
/// What such a loop calls must become part of it.
#define ABRADEM_INLINE inline __attribute__((always_inline))
