// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/cases.h"

namespace abradem::test {

/// The run whose state is fuzzed: some thirty triangles.
inline simulation::Setup checkpoint_case() {
  PinOnDisc pin;
  pin.method = simulation::Method::dynamic;
  simulation::Setup setup = pin.setup();
  simulation::MeshSetup& mesh = setup.walls[0].mesh;
  mesh = {};
  mesh.shape = simulation::MeshShape::plate;
  mesh.length = mesh.width = 1.6e-3;
  mesh.size = 0.5e-3;
  setup.walls[0].motion.center = {-20e-3, 0.0, 0.0};
  setup.particles[0].position = {0.0, 0.0, PinOnDisc::kRadius};
  setup.run.end = setup.output.every = {0.01, true};
  return setup;
}

}  // namespace abradem::test
