// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "abradem/core/vec3.h"

namespace abradem {

/// The image of p from low on, but not from low + period on, where space repeats itself after `period`; as it
/// is along axes whose period is 0. [m]
[[nodiscard]] inline Vec3 wrapped(const Vec3& p, const Vec3& low, const Vec3& period) noexcept {
  const auto along = [](double x, double from, double length) {
    if (!(length > 0.0)) return x;
    x -= length * std::floor((x - from) / length);
    return x >= from + length ? from : x;  // by rounding
  };
  return {along(p.x, low.x, period.x), along(p.y, low.y, period.y), along(p.z, low.z, period.z)};
}

}  // namespace abradem
