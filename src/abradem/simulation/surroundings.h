// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "abradem/geometry/pose.h"
#include "abradem/material/material.h"
#include "abradem/simulation/wall.h"

namespace abradem::simulation {

/// What of the contacts between a material and a wall is to be booked as wear: nothing, what slides under
/// load (Archard alone), all.
enum class WearUse : std::uint8_t { none, sliding, all };

/// What particles in numbers see of the simulation that they are part of; made anew for every use.
struct Surroundings {
  std::vector<Wall>& walls;
  const std::vector<geometry::Pose>& poses;                 ///< of the walls, now
  const std::vector<material::PairProperties>& properties;  ///< materials x materials
  std::size_t materials = 0;
  double dt = 0.0;  ///< [s]
  double time = 0.0;
  Vec3 gravity;                   ///< [m/s^2]
  std::span<const WearUse> wear;  ///< walls x materials
  bool ploughs = false;           ///< contacts pile up what they move aside

  [[nodiscard]] const material::PairProperties& pair(int a, int b) const {
    return properties[static_cast<std::size_t>(a) * materials + static_cast<std::size_t>(b)];
  }
};

}  // namespace abradem::simulation
