// SPDX-License-Identifier: BSD-3-Clause
// Beds, silos and hoppers. docs/verification/bulk.md
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "abradem/io/case_file.h"
#include "support/grains.h"

namespace abradem::test {
namespace {

/// 2200 grains of friction 0.5 that rain on a floor without sides; what fell `stretch` times as high as the
/// bed is, all at once. Their fraction seven radii above the floor and five below the top.
double fraction_of_rain(double stretch, double until) {
  constexpr double R = 3e-3, pitch = 2.06 * R;
  constexpr std::size_t across = 10;
  simulation::Setup setup = grains(0.3, 0.5, 0.0);
  setup.materials[0].shear_modulus = 2e7;  // what falls deepest meets at 2 m/s
  setup.walls = {plane("floor", {0, 0, 0}, {0, 0, 1})};
  setup.run.gravity = {0, 0, -9.81};
  setup.insertions[0].placed = lattice(across * across * 22, across, R, pitch, 0.1);
  for (PlacedSphere& s : setup.insertions[0].placed) s.position.z *= stretch;
  setup.domain = DomainSetup{{0, 0, -1}, {across * pitch, across * pitch, 10}, Outside::stop, Periodic::xy};
  Simulation run(setup);
  while (run.time() < until) run.step();
  const BulkState end = run.bulk_state();
  EXPECT_LT(end.kinetic_energy, 1e-4 * end.mass * 9.81 * R);
  std::vector<double> heights;
  for (const contact::SphereRow& s : run.bulk()->spheres().row) heights.push_back(s.z);
  std::ranges::sort(heights);
  const double top = heights[heights.size() * 98 / 100] - 5.0 * R;
  return fraction_within(run.bulk()->spheres(), {0, 0, 7.0 * R}, {across * pitch, across * pitch, top},
                         0.1 * R);
}

TEST(Bulk, FrictionalGrainsPackAsLooseAsTheyFallGently) {
  const OneThread alone;
  // Let go just above each other they stop near the loosest bed that stands, 0.55 to 0.56 for rough spheres
  // (Onoda & Liniger 1990; Jerkins et al. 2008); a rain shakes down what lies, to 0.58 to 0.60.
  const double gentle = fraction_of_rain(1.5, 0.5), rain = fraction_of_rain(4.5, 0.75);
  EXPECT_GT(gentle, 0.555);
  EXPECT_LT(gentle, 0.58);
  EXPECT_GT(rain, 0.58);
  EXPECT_LT(rain, 0.60);
  EXPECT_GT(rain - gentle, 0.008);
  RecordProperty("gentle", std::to_string(gentle));
  RecordProperty("rain", std::to_string(rain));
}

/// A square silo, filled and then let down on its floor by two diameters, so that all walls carry as much as
/// they can: grains are rougher among themselves than the walls are, or they would roll along the wall and
/// yield beside it with half its friction at work.
TEST(Bulk, SiloWallsCarryWhatJanssenSays) {
  const OneThread alone;
  constexpr double R = 3e-3, pitch = 2.1 * R, friction = 0.2;
  constexpr std::size_t across = 10, layers = 60;
  constexpr double side = across * pitch;
  simulation::Setup setup = grains(0.3, 0.5, side);
  setup.materials.push_back({"wall", 2500.0, 1e7, 0.25, {}});
  setup.contacts.push_back({"grain", "wall", 0.3, friction, 0.0});
  for (WallSetup& wall : setup.walls) wall.material = "wall";
  setup.walls.push_back(plane("floor", {0, 0, 0}, {0, 0, 1}));
  setup.walls[4].motion.kind = MotionKind::translation;
  setup.walls[4].motion.velocity = {0, 0, -0.02};
  setup.run.gravity = {0, 0, -9.81};
  setup.insertions[0].placed = lattice(across * across * layers, across, R, pitch, 0.1);
  Simulation run(setup);
  while (run.time() < 0.6) run.step();

  // Vertical stress over depth: what is above, less what the walls carry of it; a mean of several moments.
  constexpr std::size_t slabs = 20;
  std::array<double, slabs> stress{}, pressed{}, carried_by_wall{};
  double top = 0.0;
  std::vector<double> heights;
  for (const contact::SphereRow& s : run.bulk()->spheres().row) heights.push_back(s.z);
  std::ranges::nth_element(heights, heights.begin() + static_cast<std::ptrdiff_t>(heights.size() * 99 / 100));
  top = heights[heights.size() * 99 / 100] + R;
  const double bottom = run.walls()[4].pose_at(run.time()).shift.z;
  const double slab = (top - bottom) / slabs;
  constexpr int moments = 100;
  for (int m = 0; m < moments; ++m) {
    for (int k = 0; k < 20; ++k) run.step();
    std::array<double, slabs> weight{};
    const auto slab_of = [&](double z) {
      return std::min<std::size_t>(slabs - 1, static_cast<std::size_t>(std::max(0.0, (top - z) / slab)));
    };
    const auto& spheres = run.bulk()->spheres();
    for (const contact::SphereRow& s : spheres.row) weight[slab_of(s.z)] += 9.81 / s.inverse_mass;
    for (std::size_t w = 0; w < 4; ++w) {
      const contact::PlaneList& wall = run.bulk()->walls().planes()[w];
      for (std::size_t k = 0; k < wall.size(); ++k) {
        const std::size_t at = slab_of(spheres.row[static_cast<std::size_t>(wall.sphere[k])].z);
        carried_by_wall[at] += wall.load[k].fz / moments;
        pressed[at] += std::abs(w < 2 ? wall.load[k].fx : wall.load[k].fy) / moments;
        weight[at] -= wall.load[k].fz;
      }
    }
    double above = 0.0;
    for (std::size_t k = 0; k < slabs; ++k) {
      above += weight[k];
      stress[k] += above / (side * side) / moments;
    }
  }
  // Fit of sigma_inf and lambda: for each lambda the best sigma_inf is linear.
  double best = 1e300, lambda = 0.0, saturation = 0.0;
  for (double l = 0.2 * side; l < 6.0 * side; l *= 1.01) {
    double fs = 0.0, ff = 0.0, error = 0.0;
    const auto f = [&](std::size_t k) { return 1.0 - std::exp(-(static_cast<double>(k) + 1.0) * slab / l); };
    for (std::size_t k = 0; k < slabs; ++k) fs += f(k) * stress[k], ff += f(k) * f(k);
    for (std::size_t k = 0; k < slabs; ++k) error += std::pow(stress[k] - fs / ff * f(k), 2);
    if (error < best) best = error, lambda = l, saturation = fs / ff;
  }
  const double residual = std::sqrt(best / slabs) / saturation;
  // Janssen: sigma_inf = rho g lambda, lambda = side / (4 mu K), both also measured on their own: the density
  // from the mass, K from what the walls are pressed with, below the top where it is no constant.
  const double density = run.bulk_state().mass / (side * side * (top - bottom));
  double K = 0.0, normal = 0.0, shear = 0.0;
  for (std::size_t k = 3; k + 1 < slabs; ++k) {
    K += pressed[k] / (4.0 * side * slab) / stress[k] / static_cast<double>(slabs - 4);
    normal += pressed[k], shear += carried_by_wall[k];
  }
  RecordProperty("residual", std::to_string(residual));
  RecordProperty("K", std::to_string(K));
  RecordProperty("mobilised", std::to_string(shear / normal / friction));
  RecordProperty("lambda_ratio", std::to_string(lambda * 4.0 * friction * K / side));
  RecordProperty("density_ratio", std::to_string(saturation / 9.81 / lambda / density));
  EXPECT_LT(residual, 0.02);
  EXPECT_GT((top - bottom) / lambda, 2.5);     // deep enough to saturate
  EXPECT_GT(shear / normal, 0.95 * friction);  // all walls slip
  EXPECT_NEAR(saturation / 9.81 / lambda / density, 1.0, 0.04);
  EXPECT_NEAR(lambda * 4.0 * friction * K / side, 1.0, 0.08);
  EXPECT_GT(K, 0.3);  // lateral over vertical stress of granular beds
  EXPECT_LT(K, 0.9);
}

/// The ready case, filled less high (the rate does not depend on it) and for a shorter time.
TEST(Bulk, SiloWithASlitEmptiesAtThePublishedRate) {
  const OneThread alone;
  constexpr double kPublished = 82.1e-3, kTheirSlice = 5.6e-3, kOurSlice = 8.96e-3;  // [kg/s], [m]
  const std::vector<std::string> smaller{"insertion.fill.number=5000", "wall.gate.until='0.15 s'",
                                         "run.end='0.35 s'"};
  Simulation run(io::read_case(ABRADEM_SOURCE_DIR "/cases/hopper.toml", smaller));
  // Slope by least squares, once the flow is steady and what leaves the slit has reached the domain's end.
  double n = 0.0, t = 0.0, m = 0.0, tt = 0.0, tm = 0.0;
  while (!run.finished()) {
    for (int k = 0; k < 50 && !run.finished(); ++k) run.step();
    if (run.time() < 0.22) continue;
    const double time = run.time(), mass = run.bulk_state().removed_mass;
    n += 1.0, t += time, m += mass, tt += time * time, tm += time * mass;
  }
  const double rate = (n * tm - t * m) / (n * tt - t * t);
  RecordProperty("rate_g_per_s", std::to_string(1e3 * rate * kTheirSlice / kOurSlice));
  EXPECT_NEAR(rate * kTheirSlice / kOurSlice, kPublished, 0.1 * kPublished);
}

}  // namespace
}  // namespace abradem::test
