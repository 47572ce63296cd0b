// SPDX-License-Identifier: BSD-3-Clause
// Settled box of spheres: particle-steps per second. bench/README.md#particles-in-numbers
//
//   abradem_bulk make N POSITIONS.csv [steps]      settle N spheres of 6 mm in a box about as high as wide
//   abradem_bulk time POSITIONS.csv [steps] [runs] go on from there, and time it
//   abradem_bulk count POSITIONS.csv               contacts among the spheres and their elastic energy
//   abradem_bulk drum TRIANGLES [steps] [runs] [warm] [STATE.csv]  20,000 spheres in a turning drum that
//   wears
//                                                  and deforms
//   abradem_bulk clumps N [steps] [runs] [warm]    N particles of three spheres each, poured into a box
//
// POSITIONS.csv holds the box's side, then x, y, z of every sphere, in metres: other codes start from it too.
// STATE.csv: x, y, z, velocity and spin of every sphere when the timing begins.
#include <fmt/format.h>
#include <omp.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <numbers>
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

/// Particle-steps per second of several runs, ascending.
struct Rates {
  std::vector<double> wall, user;
};

Rates time_runs(Simulation& run, long steps, long runs) {
  Rates rates;
  const double work = static_cast<double>(run.bulk_state().present) * static_cast<double>(steps);
  for (long r = 0; r < runs; ++r) {
    const auto start = std::chrono::steady_clock::now();
    const double before = user_seconds();
    for (long k = 0; k < steps; ++k) run.step();
    rates.user.push_back(work / (user_seconds() - before));
    rates.wall.push_back(work /
                         std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  std::ranges::sort(rates.user);
  std::ranges::sort(rates.wall);
  return rates;
}

/// Times a run from its present state, and prints what there was to do. @param what "spheres"
int time_and_print(Simulation& run, long steps, long runs, const std::string& what) {
  const std::uint64_t rebuilds = run.bulk()->list().rebuilds();
  const BulkState s = run.bulk_state();
  const auto [wall, user] = time_runs(run, steps, runs);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  fmt::print(
      "{} {}, {} threads, {} runs of {} steps of {:.3g} s\n"
      "particle-steps per second of wall time: median {:.3g}, best {:.3g}; of user time: median {:.3g}, best "
      "{:.3g}\n"
      "at the start {} contacts among spheres, {} with walls, elastic energy {:.9g} J\n"
      "{:.2f} listed pairs a particle, {} rebuilds, at most {:.0f} bytes a particle, state {:016x}\n",
      s.present, what, omp_get_max_threads(), runs, steps, run.time_step(), wall[wall.size() / 2],
      wall.back(), user[user.size() / 2], user.back(), s.pair_contacts, s.wall_contacts, s.elastic_energy,
      static_cast<double>(run.bulk()->list().pairs()) / static_cast<double>(s.present),
      run.bulk()->list().rebuilds() - rebuilds,
      1024.0 * static_cast<double>(usage.ru_maxrss) / static_cast<double>(s.present), run.state_hash());
  return 0;
}

int time(const std::string& path, long steps, long runs) {
  Simulation run(read_box(path));
  for (int k = 0; k < 200; ++k) run.step();
  return time_and_print(run, steps, runs, "spheres");
}

/// A flat, symmetric trefoil of overlapping spheres, as large as a sphere of the other benchmarks.
int clumps(std::size_t count, long steps, long runs, long warm) {
  const double side = std::cbrt(static_cast<double>(count)) * 2.0 * kRadius * 1.2;
  Setup setup = open_box(side);
  ShapeSetup trefoil;
  trefoil.name = "trefoil";
  for (int k = 0; k < 3; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / 3.0;
    trefoil.spheres.push_back({{0.7 * std::cos(angle), 0.7 * std::sin(angle), 0.0}, 1.0});
  }
  setup.shapes = {trefoil};
  setup.insertions[0].shape = trefoil.name;
  // As far apart as their longest way through, so that no turn makes two overlap.
  setup.insertions[0].placed = loose_lattice(count, side / 1.5);
  for (PlacedSphere& s : setup.insertions[0].placed) s.position = 1.5 * s.position;
  Simulation run(setup);
  for (long k = 0; k < warm; ++k) run.step();
  return time_and_print(run, steps, runs, "clumps of 3 spheres");
}

constexpr double kDrumRadius = 0.15, kDrumLength = 0.152;

/// A cylinder about the y axis, seen from inside; about so many triangles.
geometry::TriangleMesh cylinder(std::size_t triangles) {
  const double across = 2.0 * std::numbers::pi * kDrumRadius,
               edge = std::sqrt(2.0 * across * kDrumLength / static_cast<double>(triangles));
  const auto n = static_cast<std::int32_t>(std::round(across / edge)),
             m = static_cast<std::int32_t>(std::round(kDrumLength / edge));
  geometry::TriangleMesh mesh;
  for (std::int32_t k = 0; k <= m; ++k)
    for (std::int32_t i = 0; i < n; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / n;
      mesh.vertices.push_back({kDrumRadius * std::cos(angle),
                               (static_cast<double>(k) / m - 0.5) * kDrumLength,
                               kDrumRadius * std::sin(angle)});
    }
  for (std::int32_t k = 0; k < m; ++k)
    for (std::int32_t i = 0; i < n; ++i) {
      const std::int32_t a = k * n + i, b = k * n + (i + 1) % n, c = a + n, d = b + n;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({c, b, d});
    }
  return mesh;
}

void write_state(const Simulation& run, const std::string& path) {
  std::ofstream file(path);
  for (const contact::SphereRow& p : run.bulk()->spheres().row)
    file << fmt::format("{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n", p.x, p.y,
                        p.z, p.vx, p.vy, p.vz, p.spin().x, p.spin().y, p.spin().z);
  if (!file.flush()) throw IoError(fmt::format("{}: cannot be written", path));
}

int drum(std::size_t triangles, long steps, long runs, long warm, const std::string& state_file) {
  Setup setup = open_box(1.0);
  setup.walls.resize(2);
  setup.walls[0].material = setup.walls[1].material = "steel";
  for (const std::size_t end : {0UL, 1UL}) {
    setup.walls[end].mesh.position = {0.0, (end == 0 ? -0.5 : 0.5) * kDrumLength, 0.0};
    setup.walls[end].mesh.normal = {0.0, end == 0 ? 1.0 : -1.0, 0.0};
  }
  WallSetup shell;
  shell.name = "shell";
  shell.material = "steel";
  shell.mesh.shape = MeshShape::file;
  shell.motion.kind = MotionKind::rotation;
  shell.motion.axis = {0.0, 1.0, 0.0};
  shell.motion.rate = std::numbers::pi;
  shell.contact = ContactRule::resolved;
  shell.deformation = DeformationRule::conserving;
  shell.deform_every = 20;
  setup.walls.push_back(shell);
  setup.materials.push_back({"steel", 7850.0, 7.8e10, 0.3, {}});
  setup.contacts.push_back({"glass", "steel", 0.5, 0.5, 0.0});
  setup.wear.push_back({.abrader = "glass", .worn = "steel", .wear_coefficient = 1e-9});
  std::vector<PlacedSphere> spheres = loose_lattice(90'000, 0.3);
  std::erase_if(spheres, [](PlacedSphere& s) {
    s.position = s.position - Vec3{0.15, 0.15, 0.15};
    const double reach = kDrumRadius - 1.2 * kRadius;
    return std::hypot(s.position.x, s.position.z) > reach ||
           std::abs(s.position.y) > 0.5 * kDrumLength - 1.2 * kRadius;
  });
  if (spheres.size() > 20'000) spheres.resize(20'000);
  setup.insertions[0].placed = spheres;
  Simulation run(setup, [&](const MeshSetup&, std::uint64_t) { return cylinder(triangles); });
  for (long k = 0; k < warm; ++k) run.step();
  if (!state_file.empty()) write_state(run, state_file);
  const BulkState s = run.bulk_state();
  const std::vector<double> wall = time_runs(run, steps, runs).wall;
  const Ledger ledger = run.ledger();
  fmt::print(
      "drum of {} triangles, {} spheres, {} threads, {} runs of {} steps after {}\n"
      "particle-steps per second of wall time: median {:.3g}, best {:.3g}\n"
      "{} contacts among spheres, {} with walls, fastest {:.3g} m/s, {} rebuilds, law {:.6g} mm^3, residual "
      "{:.2g}, state {:016x}\n",
      run.walls()[2].surface().mesh().triangles.size(), s.present, omp_get_max_threads(), runs, steps, warm,
      wall[wall.size() / 2], wall.back(), s.pair_contacts, s.wall_contacts, s.fastest,
      run.bulk()->list().rebuilds(), 1e9 * ledger.law, ledger.residual, run.state_hash());
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
  if (what == "drum" && argc > 2)
    return drum(static_cast<std::size_t>(number(2, 0)), number(3, 200), number(4, 5), number(5, 10000),
                argc > 6 ? argv[6] : "");
  if (what == "clumps" && argc > 2)
    return clumps(static_cast<std::size_t>(number(2, 0)), number(3, 200), number(4, 5), number(5, 40000));
  fmt::print(
      stderr,
      "usage: abradem_bulk make N POSITIONS.csv [steps] | time POSITIONS.csv [steps] [runs] | count "
      "POSITIONS.csv | drum TRIANGLES [steps] [runs] [warm] [STATE.csv] | clumps N [steps] [runs] [warm]\n");
  return 2;
}
