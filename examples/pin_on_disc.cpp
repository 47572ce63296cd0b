// SPDX-License-Identifier: BSD-3-Clause
// The pin-on-disc test as a program of one's own: says what there is, runs it, asks for the groove. SI units.
#include <cstdio>
#include <numbers>

#include "abradem/analysis/contour.h"
#include "abradem/simulation/simulation.h"

int main() {
  namespace sim = abradem::simulation;
  sim::Setup setup;
  setup.materials = {{"iron_ore", 4850.0, 0.1e9, 0.24, {}}, {"mild_steel", 7932.0, 78e9, 0.30, {}}};
  setup.contacts = {
      {.first = "iron_ore", .second = "mild_steel", .restitution = 0.4, .static_friction = 1.0}};
  setup.wear = {{.abrader = "iron_ore", .worn = "mild_steel", .wear_coefficient = 6.81e-11}};

  sim::WallSetup& disc = setup.walls.emplace_back();
  disc.name = "disc", disc.material = "mild_steel";
  disc.mesh.shape = sim::MeshShape::annulus;
  disc.mesh.inner = 0.021, disc.mesh.outer = 0.023, disc.mesh.size = 0.0002;
  disc.motion.kind = sim::MotionKind::rotation, disc.motion.rate = std::numbers::pi;
  disc.deformation = sim::DeformationRule::conserving;

  sim::ParticleSetup& pin = setup.particles.emplace_back();
  pin.name = "pin", pin.material = "iron_ore", pin.radius = 0.003, pin.position = {0.022, 0.0, 0.003};
  pin.guide = sim::Guide::vertical, pin.load = {0.0, 0.0, -5.0};

  setup.run.end = {.value = 3.0, .in_revolutions = true};
  setup.run.method = sim::Method::quasi_static;  // the same groove as `dynamic` with far fewer steps

  sim::Simulation run(setup);
  while (!run.finished()) run.step();

  const auto& surface = run.walls()[0].surface();
  const auto region = abradem::analysis::worn_region(surface.mesh(), surface.reference());
  double depth = 0.0;
  for (const auto& c : abradem::analysis::cut_contours(surface.mesh(), surface.reference(), region,
                                                       abradem::analysis::RotaryCuts{.count = 360}))
    depth += c.depth / 360;
  const sim::Ledger ledger = run.ledger();
  std::printf("after %g revolutions: groove %.1f um deep, %.4f mm^3 worn, kappa %.9f\n", run.revolution(),
              1e6 * depth, 1e9 * ledger.swept, ledger.kappa);
}
