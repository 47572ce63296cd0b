// SPDX-License-Identifier: BSD-3-Clause
// Settled box of spheres: particle-steps per second. bench/README.md#particles-in-numbers
//
//   abradem_bulk make N POSITIONS.csv [steps]      settle N spheres of 6 mm in a box about as high as wide
//   abradem_bulk time POSITIONS.csv [steps] [runs] go on from there, and time it
//   abradem_bulk count POSITIONS.csv               contacts among the spheres and their elastic energy
//
// POSITIONS.csv holds the box's side, then x, y, z of every sphere, in metres: other codes start from it too.
#include <fmt/format.h>
#include <omp.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <string>

#include "abradem/core/error.h"
#include "abradem/simulation/simulation.h"

using namespace abradem;
using namespace abradem::simulation;

namespace {

constexpr double kRadius = 3e-3;

/// A box without a lid over [0, side] x [0, side].
Setup open_box(double side) {
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
  setup.insertions = {{}};
  setup.insertions[0].name = "spheres";
  setup.insertions[0].material = "glass";
  setup.run.end = {1e6, false};
  setup.run.time_step = {0.2, true};
  setup.run.gravity = {0, 0, -9.81};
  setup.output.every = {1e6, false};
  return setup;
}

/// Spheres on a loose jittered lattice with small random speeds.
std::vector<PlacedSphere> loose_lattice(std::size_t count, double side) {
  std::vector<PlacedSphere> spheres;
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
    spheres.push_back({p, kRadius, {random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), 0.0}});
  }
  return spheres;
}

int make(std::size_t count, const std::string& path, long steps) {
  const double side = std::cbrt(static_cast<double>(count)) * 2.0 * kRadius * 1.03;
  Setup setup = open_box(side);
  setup.insertions[0].placed = loose_lattice(count, side);
  Simulation run(setup);
  for (long k = 1; k <= steps; ++k) {
    run.step();
    if (k % 2000 != 0) continue;
    const BulkState s = run.bulk_state();
    fmt::print(stderr, "settling {:6}: {:.3f} contacts a sphere, fastest {:.3g} m/s, {} rebuilds\n", k,
               2.0 * static_cast<double>(s.pair_contacts) / static_cast<double>(s.present), s.fastest,
               run.bulk()->list().rebuilds());
  }
  std::ofstream file(path);
  file << fmt::format("{:.17g}\n", side);
  for (const contact::SphereRow& p : run.bulk()->spheres().row)
    file << fmt::format("{:.17g},{:.17g},{:.17g}\n", p.x, p.y, p.z);
  return file.good() ? 0 : 1;
}

double user_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) + 1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

/// The box and the spheres of a file, at rest.
Setup read_box(const std::string& path) {
  std::ifstream file(path);
  double side = 0.0;
  file >> side;
  Setup setup = open_box(side);
  Vec3 p;
  char comma = ',';
  while (file >> p.x >> comma >> p.y >> comma >> p.z) setup.insertions[0].placed.push_back({p, kRadius, {}});
  if (setup.insertions[0].placed.empty()) throw IoError(fmt::format("{}: no positions in it", path));
  return setup;
}

int count(const std::string& path) {
  Simulation run(read_box(path));
  run.step();
  // The step has moved the spheres by less than g dt^2, some nanometres.
  const BulkState s = run.bulk_state();
  fmt::print("{} contacts, elastic energy {:.6g} J\n", s.pair_contacts, s.elastic_energy);
  return 0;
}

int time(const std::string& path, long steps, long runs) {
  Simulation run(read_box(path));
  for (int k = 0; k < 200; ++k) run.step();
  std::vector<double> wall, user;
  const std::uint64_t rebuilds = run.bulk()->list().rebuilds();
  const BulkState s = run.bulk_state();
  const double work = static_cast<double>(s.present) * static_cast<double>(steps);
  for (long r = 0; r < runs; ++r) {
    const auto start = std::chrono::steady_clock::now();
    const double before = user_seconds();
    for (long k = 0; k < steps; ++k) run.step();
    user.push_back(work / (user_seconds() - before));
    wall.push_back(work / std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  std::ranges::sort(user);
  std::ranges::sort(wall);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  fmt::print(
      "{} spheres, {} threads, {} runs of {} steps of {:.3g} s\n"
      "particle-steps per second of wall time: median {:.3g}, best {:.3g}; of user time: median {:.3g}, best "
      "{:.3g}\n"
      "at the start {} contacts among spheres, {} with walls, elastic energy {:.9g} J\n"
      "{:.2f} listed pairs a sphere, {} rebuilds, at most {:.0f} bytes a sphere, state {:016x}\n",
      s.present, omp_get_max_threads(), runs, steps, run.time_step(), wall[wall.size() / 2], wall.back(),
      user[user.size() / 2], user.back(), s.pair_contacts, s.wall_contacts, s.elastic_energy,
      static_cast<double>(run.bulk()->list().pairs()) / static_cast<double>(s.present),
      run.bulk()->list().rebuilds() - rebuilds,
      1024.0 * static_cast<double>(usage.ru_maxrss) / static_cast<double>(s.present), run.state_hash());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  const auto number = [&](int k, long otherwise) { return argc > k ? std::atol(argv[k]) : otherwise; };
  if (what == "make" && argc > 3)
    return make(static_cast<std::size_t>(number(2, 0)), argv[3], number(4, 24000));
  if (what == "time" && argc > 2) return time(argv[2], number(3, 200), number(4, 5));
  if (what == "count" && argc > 2) return count(argv[2]);
  fmt::print(stderr,
             "usage: abradem_bulk make N POSITIONS.csv [steps] | time POSITIONS.csv [steps] [runs] | count "
             "POSITIONS.csv\n");
  return 2;
}
