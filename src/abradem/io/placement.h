// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abradem/simulation/simulation.h"

namespace abradem::io {

/// Looks where the particles start, seen from walls whose shape became known only when their file was read;
/// the checks of the case have done the same for generated shapes. A particle may start at most a tenth of
/// its radius deep in a wall, a guided one above some wall and no further than half its radius from it.
/// O(particles * triangles), a few ns each. @throws InputError naming particle, wall, distance and remedy
void refuse_misplaced_particles(const simulation::Simulation& run);

}  // namespace abradem::io
