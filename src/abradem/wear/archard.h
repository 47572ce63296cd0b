// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace abradem::wear {

/// What a wear law sees of one contact in one step: plain numbers, whatever rule found the contact.
struct ContactSample {
  double F_n = 0.0;   ///< compressive normal force, >= 0 [N]
  double slip = 0.0;  ///< sliding distance of this step [m]
};

/// Archard: dV = alpha_s F_n |v_t| dt [m^3], alpha_s = k / H_s [1/Pa].      [paper, eq. 4; Archard 1953]
[[nodiscard]] inline double archard_volume(double alpha_s, const ContactSample& c) noexcept {
  return alpha_s * c.F_n * c.slip;
}

}  // namespace abradem::wear
