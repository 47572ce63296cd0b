// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "abradem/analysis/contour.h"
#include "abradem/simulation/wall.h"

/// Sections through the worn wall of a simulation, laid as its motion asks.       docs/theory/contours.md
namespace abradem::analysis {

/// The wall whose wear is told of: the first one that deforms. Nothing where none does.
[[nodiscard]] std::optional<std::size_t> worn_wall(std::span<const simulation::Wall> walls);

/// Contours of a wall as it is now: half-planes through the axis of one that turns, planes across the motion
/// of one that slides or oscillates; `Contour::angle` then goes from 0 to 2 pi from one end of the groove to
/// the other. Empty for a wall without wear and motion, from which no direction of sections follows.
/// @param count sections, >= 1   @throws InputError for an analytic plane, which has no mesh to cut
[[nodiscard]] std::vector<Contour> wall_contours(const simulation::Wall& wall, int count);

}  // namespace abradem::analysis
