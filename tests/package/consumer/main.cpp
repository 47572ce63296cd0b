// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdio>

#include "abradem/core/version.h"
#include "abradem/geometry/triangle_mesh.h"
#include "abradem/simulation/setup.h"

int main() {
  // The corner of the unit cube: a closed tetrahedron of volume 1/6.
  const abradem::geometry::TriangleMesh corner{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                               {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  const double volume = abradem::geometry::signed_volume(corner);
  const abradem::simulation::Setup setup;
  std::printf("abradem %s: volume %.17g\n", abradem::core::version(), volume);
  return std::abs(volume - 1.0 / 6.0) < 1e-15 && setup.output.contours == 360 ? 0 : 1;
}
