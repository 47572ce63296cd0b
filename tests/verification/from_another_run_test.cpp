// SPDX-License-Identifier: BSD-3-Clause
// A run that begins with the bed that another has settled. docs/verification/bulk.md
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <string>
#include <tuple>
#include <vector>

#include "abradem/io/case_file.h"
#include "abradem/io/insertion_files.h"
#include "abradem/io/run_recorder.h"
#include "support/grains.h"

namespace abradem::test {
namespace {

namespace fs = std::filesystem;

/// Grains of two materials and pebbles of two spheres in a box whose sides carry by friction.
constexpr const char* kBox = R"(schema = 1
[material.ore]
density = 2700
shear_modulus = "10 MPa"
poisson_ratio = 0.25
[material.steel]
density = 7850
shear_modulus = "30 MPa"
poisson_ratio = 0.3
[contact."ore/ore"]
restitution = 0.3
static_friction = 0.5
rolling_friction = 0.05
[contact."ore/steel"]
restitution = 0.3
static_friction = 0.5
rolling_friction = 0.05
[contact."steel/steel"]
restitution = 0.3
static_friction = 0.5
rolling_friction = 0.05
[shape.pebble]
spheres = [{ position = [0, 0, 0], radius = "2 mm" }, { position = ["2 mm", 0, 0], radius = "1.5 mm" }]
[wall.floor]
material = "steel"
mesh = { shape = "plane" }
[wall.left]
material = "steel"
mesh = { shape = "plane", position = ["-20 mm", 0, 0], normal = [1, 0, 0] }
[wall.right]
material = "steel"
mesh = { shape = "plate", length = "120 mm", width = "60 mm", size = "30 mm", position = ["20 mm", 0, "50 mm"], rotation = [0, "-90 deg", 0] }
[domain]
low = ["-25 mm", "-15 mm", "-5 mm"]
high = ["25 mm", "15 mm", "200 mm"]
periodic = "y"
[run]
gravity = [0, 0, -9.81]
)";
constexpr const char* kFall = R"(end = "0.8 s"
[output]
every = "0.4 s"
[insertion.ore]
material = "ore"
number = 260
size = { kind = "uniform", low = "1.6 mm", high = "2.4 mm" }
volume = { low = ["-19 mm", "-15 mm", "1 mm"], high = ["19 mm", "15 mm", "45 mm"] }
[insertion.balls]
material = "steel"
number = 12
size = { radius = "3 mm" }
volume = { low = ["-19 mm", "-15 mm", "46 mm"], high = ["19 mm", "15 mm", "60 mm"] }
[insertion.pebbles]
material = "ore"
shape = "pebble"
number = 30
volume = { low = ["-19 mm", "-15 mm", "61 mm"], high = ["19 mm", "15 mm", "75 mm"] }
)";
constexpr const char* kGoOn = R"(end = "0.1 s"
[insertion.balls]
material = "steel"
volume = { run = "settled" }
[insertion.pebbles]
material = "ore"
shape = "pebble"
volume = { run = "settled" }
[insertion.ore]
material = "ore"
volume = { run = "settled" }
)";

/// By place.
std::vector<contact::SphereRow> sorted(const Simulation& run) {
  const contact::SphereRows& rows = run.bulk()->spheres().row;
  std::vector<std::size_t> order(rows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return std::tuple(rows[i].x, rows[i].y, rows[i].z); });
  std::vector<contact::SphereRow> sorted;
  for (const std::size_t i : order) sorted.push_back(rows[i]);
  return sorted;
}

/// Largest overlap of two spheres over their effective radius.
double deepest(const Simulation& run) {
  double deepest = 0.0;
  const contact::Spheres& spheres = run.bulk()->spheres();
  run.bulk()->list().for_each_near([&](const contact::ContactBlock& block, std::size_t k) {
    const auto &i = spheres.row[static_cast<std::size_t>(block.i[k])],
               &j = spheres.row[static_cast<std::size_t>(block.j[k])];
    const double reach = i.radius + j.radius;
    deepest =
        std::max(deepest, (reach - norm(i.position() - j.position() + run.bulk()->list().shift(block, k))) *
                              reach / (i.radius * j.radius));
  });
  return deepest;
}

TEST(FromAnotherRun, ASettledBedStaysSettled) {
  const OneThread one_thread;
  const fs::path folder = fs::temp_directory_path() / fmt::format("abradem_from_another_{}", getpid());
  fs::create_directories(folder / "settled");
  const std::string fall = std::string(kBox) + kFall, go_on = std::string(kBox) + kGoOn;
  Simulation first(io::parse_case(fall, "fall.toml", folder).setup);
  io::RunRecorder recorder(first, folder / "settled");
  while (!first.finished()) {
    first.advance();
    recorder.output(first.finished());
  }
  recorder.close();
  std::ofstream(folder / "settled" / "case.resolved.toml") << io::resolved_case(first.setup());

  simulation::Setup setup = io::parse_case(go_on, "go.toml", folder).setup;
  EXPECT_TRUE(io::read_insertion_files(setup).empty());
  Simulation second(setup);
  fs::remove_all(folder);

  // The same particles, to the bit; of clumps the spins are made of the angular momenta and back.
  const auto were = sorted(first), are = sorted(second);
  ASSERT_EQ(were.size(), 260u + 12u + 2u * 30u);
  ASSERT_EQ(are.size(), were.size());
  EXPECT_EQ(second.bulk_state().present, 302u);
  double rounding = 0.0;
  for (std::size_t i = 0; i < were.size(); ++i) {
    const bool clump = were[i].radius == 2e-3 || were[i].radius == 1.5e-3;
    EXPECT_EQ(are[i].radius, were[i].radius);
    EXPECT_EQ(are[i].inverse_mass, were[i].inverse_mass);
    EXPECT_EQ(are[i].material, were[i].material);
    EXPECT_EQ(are[i].position(), were[i].position());
    if (!clump) {
      EXPECT_EQ(are[i].velocity(), were[i].velocity());
      EXPECT_EQ(are[i].spin(), were[i].spin());
    } else {
      rounding = std::max({rounding, norm(are[i].velocity() - were[i].velocity()),
                           1e-3 * norm(are[i].spin() - were[i].spin())});
    }
  }
  EXPECT_LT(rounding, 1e-15);

  // At rest before, and after: springs are loaded anew, within what they were loaded by.
  const BulkState rest = first.bulk_state();
  const double weight = 9.81 * rest.mass, held = deepest(first);
  const double on_floor = first.bulk_force_on_wall(0).z;
  ASSERT_LT(rest.kinetic_energy, 1e-4 * rest.elastic_energy);
  double jump = 0.0, deepest_met = 0.0, fastest = 0.0;
  while (!second.finished()) {
    second.step();
    jump = std::max(jump, second.bulk_state().kinetic_energy);
    fastest = std::max(fastest, second.bulk_state().fastest);
    deepest_met = std::max(deepest_met, deepest(second));
  }
  const double sank = [&] {
    double before = 0.0, after = 0.0;
    for (const contact::SphereRow& s : were) before += s.z;
    for (const contact::SphereRow& s : second.bulk()->spheres().row) after += s.z;
    return (before - after) / static_cast<double>(were.size());
  }();
  EXPECT_LT(jump, 0.03 * rest.elastic_energy);
  EXPECT_LT(deepest_met, 1.1 * held);
  EXPECT_LT(std::abs(sank), 1e-3 * 2e-3);
  EXPECT_LT(second.bulk_state().kinetic_energy, 1e-4 * rest.elastic_energy);
  EXPECT_NEAR(second.bulk_force_on_wall(0).z / weight, on_floor / weight, 0.05);
  RecordProperty("kinetic_over_elastic_before",
                 fmt::format("{:.2e}", rest.kinetic_energy / rest.elastic_energy));
  RecordProperty("jump_over_elastic", fmt::format("{:.2e}", jump / rest.elastic_energy));
  RecordProperty("kinetic_over_elastic_after",
                 fmt::format("{:.2e}", second.bulk_state().kinetic_energy / rest.elastic_energy));
  RecordProperty("fastest", fmt::format("{:.2e}", fastest));
  RecordProperty("deepest", fmt::format("{:.5f}", deepest_met / held));
  RecordProperty("sank_over_radius", fmt::format("{:.2e}", sank / 2e-3));
  RecordProperty("floor",
                 fmt::format("{:.4f} {:.4f}", on_floor / weight, second.bulk_force_on_wall(0).z / weight));
  RecordProperty("rounding", fmt::format("{:.2e}", rounding));
}

}  // namespace
}  // namespace abradem::test
