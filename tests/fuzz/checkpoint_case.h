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

/// The same for particles in numbers: on a mesh and beside a plane, under a named one, and clumps that come
/// in.
inline simulation::Setup grains_checkpoint_case() {
  simulation::Setup setup = checkpoint_case();
  setup.contacts.push_back({"iron_ore", "iron_ore", 0.5, 0.4, 0.02});
  setup.walls[0].contact = simulation::ContactRule::resolved;
  setup.particles[0].guide = simulation::Guide::none;
  setup.particles[0].load = {};
  setup.walls.emplace_back();
  setup.walls[1].name = "side";
  setup.walls[1].material = "mild_steel";
  setup.walls[1].mesh.shape = simulation::MeshShape::plane;
  setup.walls[1].mesh.position = {-1e-3, 0.0, 0.0};
  setup.walls[1].mesh.normal = {1.0, 0.0, 0.0};
  setup.insertions.resize(2);
  for (simulation::InsertionSetup& i : setup.insertions) i.material = "iron_ore";
  setup.insertions[0].name = "placed";
  for (int k = 0; k < 4; ++k)
    setup.insertions[0].placed.push_back({{-0.61e-3 + 0.79e-3 * k, 0.0, 0.39e-3}, 0.4e-3, {}});
  setup.particles[0].radius = 0.4e-3;
  setup.particles[0].position = {0.18e-3, 0.0, 1.18e-3};
  setup.insertions[1].name = "fed";
  setup.insertions[1].size.radius = 0.4e-3;
  setup.insertions[1].shape = "pair";
  setup.shapes = {{"pair", {{{}, 1.0}, {{1.0, 0.0, 0.0}, 0.8}}, {}}};
  setup.insertions[1].volume.low = {4e-3, -1e-3, 1e-3};
  setup.insertions[1].volume.high = {6e-3, 1e-3, 3e-3};
  setup.insertions[1].number = 8;
  setup.insertions[1].mass_rate = 1e4;
  setup.insertions[1].start = 5e-6;
  setup.domain =
      simulation::DomainSetup{{-8e-3, -8e-3, -8e-3}, {8e-3, 8e-3, 8e-3}, simulation::Outside::remove};
  setup.run.gravity = {0.0, 0.0, -9.81};
  return setup;
}

}  // namespace abradem::test
