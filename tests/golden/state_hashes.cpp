// SPDX-License-Identifier: BSD-3-Clause
// Prints the hash of the state of short runs by every rule, so that builds can be compared: by other
// compilers, at other levels of optimisation, under sanitizers. One line per run.
#include <omp.h>

#include <cstdio>
#include <string>

#include "support/cases.h"
#include "support/grains.h"

namespace {

using namespace abradem;
using namespace abradem::simulation;

void print(const std::string& name, Setup setup) {
  Simulation run(std::move(setup));
  while (!run.finished()) run.step();
  std::printf("%-40s %6d steps %016llx\n", name.c_str(), static_cast<int>(run.steps()),
              static_cast<unsigned long long>(run.state_hash()));
}

}  // namespace

int main() {
  omp_set_num_threads(2);
  const std::pair<const char*, ContactRule> contacts[] = {{"patch", ContactRule::patch},
                                                          {"resolved", ContactRule::resolved},
                                                          {"per_triangle", ContactRule::per_triangle}};
  for (const auto& [method, name] :
       {std::pair(Method::dynamic, "dynamic"), std::pair(Method::quasi_static, "quasi_static")})
    for (const auto& [rule, contact] : contacts)
      for (const auto& [deformation, how] : {std::pair(DeformationRule::conserving, "conserving"),
                                             std::pair(DeformationRule::paper, "paper")}) {
        test::PinOnDisc pin;
        pin.track = 6e-3;
        pin.size = 0.2e-3;
        pin.method = method;
        pin.contact = contact;
        pin.deformation = deformation;
        pin.revolutions = method == Method::dynamic ? 0.004 : 0.2;
        print(std::string(name) + " " + rule + " " + how, pin.setup());
      }
  // Balls that bounce, roll and meet on a disc that turns.
  test::PinOnDisc pin;
  pin.track = 6e-3;
  pin.size = 0.3e-3;
  pin.method = Method::dynamic;
  pin.revolutions = 0.004;
  Setup setup = pin.setup();
  setup.contacts.push_back({"iron_ore", "iron_ore", 0.5, 0.4, 0.02});
  setup.run.gravity = {0.0, 0.0, -9.81};
  setup.particles.clear();
  for (int k = 0; k < 3; ++k) {
    ParticleSetup ball;
    ball.name = "ball" + std::to_string(k);
    ball.material = "iron_ore";
    ball.radius = 0.5e-3;
    ball.position = {6e-3, 0.99e-3 * k, 0.51e-3};
    ball.velocity = {0.0, 0.2 - 0.2 * k, -0.3};
    setup.particles.push_back(ball);
  }
  print("dynamic balls", setup);
  print("particles in numbers", test::tray());
}
