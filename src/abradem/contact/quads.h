// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abradem/contact/sphere_rows.h"
#include "abradem/core/simd.h"

/// Rows as quads of doubles, and the way between rows and arrays. Elementwise: same bits on every machine.
namespace abradem::contact {

using Quad = double __attribute__((vector_size(32), may_alias));

ABRADEM_INLINE const Quad* quads(const SphereRow& s) noexcept { return reinterpret_cast<const Quad*>(&s); }
ABRADEM_INLINE Quad* quads(SphereRow& s) noexcept { return reinterpret_cast<Quad*>(&s); }
ABRADEM_INLINE Quad* quads(LoadRow& s) noexcept { return reinterpret_cast<Quad*>(&s); }
ABRADEM_INLINE const Quad* quads(const LoadRow& s) noexcept { return reinterpret_cast<const Quad*>(&s); }
ABRADEM_INLINE const Quad& quad(const SpringRow& s) noexcept { return reinterpret_cast<const Quad&>(s); }
ABRADEM_INLINE Quad& quad(SpringRow& s) noexcept { return reinterpret_cast<Quad&>(s); }
ABRADEM_INLINE Quad& quad_at(double* p) noexcept { return *reinterpret_cast<Quad*>(p); }

/// Rows become columns.
ABRADEM_INLINE void transpose(Quad& a, Quad& b, Quad& c, Quad& d) noexcept {
  const Quad ab0 = __builtin_shufflevector(a, b, 0, 4, 2, 6), ab1 = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Quad cd0 = __builtin_shufflevector(c, d, 0, 4, 2, 6), cd1 = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  a = __builtin_shufflevector(ab0, cd0, 0, 1, 4, 5);
  b = __builtin_shufflevector(ab1, cd1, 0, 1, 4, 5);
  c = __builtin_shufflevector(ab0, cd0, 2, 3, 6, 7);
  d = __builtin_shufflevector(ab1, cd1, 2, 3, 6, 7);
}

}  // namespace abradem::contact
