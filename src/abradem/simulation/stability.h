// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace abradem::simulation {

/// A mass M on contacts whose stiffnesses sum to S and whose damping coefficients sum to c, as one step dt of
/// symplectic Euler sees it. docs/theory/time-step.md
struct Scheme {
  double g = 0.0;  ///< c dt / M
  double W = 0.0;  ///< S dt^2 / M

  /// Stable while this is below kLimit.
  [[nodiscard]] double number() const noexcept { return 2.0 * g + W; }
  static constexpr double kLimit = 4.0;
  /// What a small disturbance is multiplied by in one step, at most: the larger root of
  /// lambda^2 - (2 - g - W) lambda + (1 - g).
  [[nodiscard]] double growth() const noexcept {
    const double t = 2.0 - g - W, d = 1.0 - g, inside = 0.25 * t * t - d;
    return inside > 0.0 ? 0.5 * std::abs(t) + std::sqrt(inside) : std::sqrt(d);
  }
  /// The longest step that is stable, where this is the scheme of steps dt: 2 c dt + S dt^2 = 4 M.
  [[nodiscard]] double stable_step(double dt) const noexcept {
    return 4.0 * dt / (g + std::sqrt(g * g + 4.0 * W));
  }
};

/// ln of what a disturbance may grow to while the step is too long: a peak of few steps does not reach it.
inline const double kLargestGrowth = std::log(1e3);

}  // namespace abradem::simulation
