// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <span>

#include "abradem/contact/contact_chunk.h"
#include "abradem/contact/sphere_list.h"

namespace abradem::contact {

/// Forces and torques of all pairs in the list on all spheres; the springs go one step on. `load` is
/// overwritten; it has list.load_rows() rows, the spheres' first. On all threads; same bits for any number of
/// them.   @return false when two overlap by more than kDeepest of their effective radius
[[nodiscard]] bool sphere_forces(const Spheres& spheres, SphereList& list, const PairTable& table, double dt,
                                 LoadRows& load);

/// What one step of the integration met.
struct Advance {
  double fastest2 = 0.0;   ///< largest squared speed [m^2/s^2]
  double longest = 0.0;    ///< largest way in this step, relative to the radius
  double stability = 0.0;  ///< largest 2 g + W (docs/theory/time-step.md)
  bool finite = true;
  bool sound = true;  ///< what sphere_forces returns
};

/// Symplectic Euler: the loads and gravity change the velocities, the new velocities the positions.
Advance advance_spheres(std::span<SphereRow> spheres, std::span<const LoadRow> load, const Vec3& gravity,
                        double dt);

/// Adds to the loads of spheres begin … end - 1; called for several ranges at once.
using AddLoads = std::function<void(std::size_t begin, std::size_t end)>;

/// sphere_forces, add_loads and advance_spheres in one pass over the memory, to the same bits: a block is
/// moved as soon as the earlier blocks that it is a guest of need it no longer.
Advance forces_and_advance(Spheres& spheres, SphereList& list, const PairTable& table, double dt,
                           LoadRows& load, const Vec3& gravity, const AddLoads& add_loads);

}  // namespace abradem::contact
