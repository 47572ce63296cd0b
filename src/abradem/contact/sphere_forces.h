// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "abradem/contact/contact_chunk.h"
#include "abradem/contact/sphere_list.h"

namespace abradem::contact {

/// Hertz-Mindlin forces and torques of all pairs in the list on all spheres; the springs go one step on.
/// `load` is overwritten. On all threads; same bits for any number of them.
/// @return false when two overlap by more than kDeepest of their effective radius
[[nodiscard]] bool sphere_forces(const Spheres& spheres, SphereList& list, const PairTable& table, double dt,
                                 std::vector<LoadRow>& load);

/// What one step of the integration met.
struct Advance {
  double fastest2 = 0.0;   ///< largest squared speed [m^2/s^2]
  double longest = 0.0;    ///< largest way in this step, relative to the radius
  double stability = 0.0;  ///< largest 2 g + W (docs/theory/time-step.md)
  bool finite = true;
};

/// Symplectic Euler: the loads and gravity change the velocities, the new velocities the positions.
Advance advance_spheres(std::span<SphereRow> spheres, std::span<const LoadRow> load, const Vec3& gravity,
                        double dt);

}  // namespace abradem::contact
