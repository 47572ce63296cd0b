// SPDX-License-Identifier: BSD-3-Clause
// Settled box of spheres: particle-steps per second. bench/README.md#particles-in-numbers
//
//   abradem_bulk N [steps] [settle_steps] [positions.csv]
//
// Spheres of 6 mm fall into a box as wide as deep and about as high as wide, come to rest, and are then timed.
// With a fourth argument the settled positions (x, y, z in metres) are written, for other codes.
#include <fmt/format.h>
#include <omp.h>
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <string>

#include "abradem/simulation/simulation.h"

using namespace abradem;
using namespace abradem::simulation;

namespace {

constexpr double kRadius = 3e-3;

/// A box without a lid over [0, side] x [0, side], and the spheres on a loose jittered lattice in it.
Setup settled_box(std::size_t count, double side) {
  Setup setup;
  setup.materials = {{"glass", 2500.0, 1e8, 0.25, {}}};
  setup.contacts = {{"glass", "glass", 0.5, 0.5, 0.0}};
  const std::pair<Vec3, Vec3> planes[]{{{0, 0, 0}, {0, 0, 1}},
                                       {{0, 0, 0}, {1, 0, 0}},
                                       {{side, 0, 0}, {-1, 0, 0}},
                                       {{0, 0, 0}, {0, 1, 0}},
                                       {{0, side, 0}, {0, -1, 0}}};
  for (const auto& [point, normal] : planes) {
    WallSetup wall;
    wall.name = fmt::format("side {}", setup.walls.size());
    wall.material = "glass";
    wall.mesh.shape = MeshShape::plane;
    wall.mesh.position = point;
    wall.mesh.normal = normal;
    setup.walls.push_back(wall);
  }
  InsertionSetup spheres;
  spheres.name = "spheres";
  spheres.material = "glass";
  core::RandomStream random(1);
  const double pitch = 2.0 * kRadius * 1.03;
  const auto across = static_cast<std::size_t>(side / pitch);
  const double margin = 0.5 * (side - static_cast<double>(across) * pitch);
  for (std::size_t i = 0; i < count; ++i) {
    const double x = static_cast<double>(i % across), y = static_cast<double>(i / across % across),
                 z = static_cast<double>(i / across / across);
    const auto jitter = [&] { return random.uniform(-0.014, 0.014) * 2.0 * kRadius; };
    const Vec3 p{margin + (x + 0.5) * pitch + jitter(), margin + (y + 0.5) * pitch + jitter(),
                 (z + 0.55) * pitch + jitter()};
    spheres.placed.push_back({p, kRadius, {random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), 0.0}});
  }
  setup.insertions = {spheres};
  setup.run.end = {1e6, false};
  setup.run.time_step = {0.2, true};
  setup.run.gravity = {0, 0, -9.81};
  setup.output.every = {1e6, false};
  return setup;
}

double user_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) + 1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

}  // namespace

int main(int argc, char** argv) {
  const auto count = static_cast<std::size_t>(argc > 1 ? std::atoll(argv[1]) : 10000);
  const long steps = argc > 2 ? std::atol(argv[2]) : 200;
  const long settle = argc > 3 ? std::atol(argv[3]) : 20000;
  const double side = std::cbrt(static_cast<double>(count)) * 2.0 * kRadius * 1.03;
  Simulation run(settled_box(count, side));
  for (long k = 0; k < settle; ++k) {
    run.step();
    if (k % 2000 == 1999) {
      const BulkState s = run.bulk_state();
      fmt::print(stderr, "settling {:6}: {:.3f} contacts a sphere, fastest {:.3g} m/s, {} rebuilds\n", k + 1,
                 2.0 * static_cast<double>(s.pair_contacts) / static_cast<double>(s.present), s.fastest,
                 run.bulk()->list().rebuilds());
    }
  }
  const std::uint64_t rebuilds = run.bulk()->list().rebuilds();
  const auto start = std::chrono::steady_clock::now();
  const double user = user_seconds();
  for (long k = 0; k < steps; ++k) run.step();
  const double used = user_seconds() - user;
  const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const BulkState s = run.bulk_state();
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const double work = static_cast<double>(s.present) * static_cast<double>(steps);
  fmt::print(
      "{} spheres, {} threads, {} steps of {:.3g} s: {:.3g} particle-steps/s of wall time, {:.3g} per second of user "
      "time; {} contacts among spheres, {} with walls, elastic energy {:.6g} J, {} rebuilds, {:.2f} listed pairs a "
      "sphere, at most {:.0f} bytes a sphere, state {:016x}\n",
      s.present, omp_get_max_threads(), steps, run.time_step(), work / elapsed, work / used, s.pair_contacts,
      s.wall_contacts, s.elastic_energy, run.bulk()->list().rebuilds() - rebuilds,
      static_cast<double>(run.bulk()->list().pairs()) / static_cast<double>(s.present),
      1024.0 * static_cast<double>(usage.ru_maxrss) / static_cast<double>(s.present), run.state_hash());
  if (argc > 4) {
    std::ofstream file(argv[4]);
    for (const contact::SphereRow& p : run.bulk()->spheres().row)
      file << fmt::format("{:.17g},{:.17g},{:.17g}\n", p.x, p.y, p.z);
  }
  return 0;
}
