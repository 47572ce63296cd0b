// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "abradem/core/vec3.h"

namespace abradem::simulation {

/// The named spheres of a case as arrays; SI.
struct Particles {
  std::vector<Vec3> position, velocity, spin, force, torque, load, guide;  ///< guide: free direction, or zero
  std::vector<double> radius, mass;
  std::vector<int> material;
  std::vector<std::string> name;
  [[nodiscard]] std::size_t size() const noexcept { return radius.size(); }
};

}  // namespace abradem::simulation
