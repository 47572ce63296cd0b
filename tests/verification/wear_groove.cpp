// SPDX-License-Identifier: BSD-3-Clause
// A stiff pin wears the circular segment of a rigid sphere, with the section alpha F n.
// docs/verification/wear.md#groove
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "support/cases.h"
#include "support/grooves.h"
#include "support/table.h"

namespace abradem::test {
namespace {

/// The segment of section `area` under a sphere of radius R; depth by Newton.
struct Segment {
  double depth, width;
};
Segment segment_of(double area) {
  constexpr double R = PinOnDisc::kRadius;
  double d = std::cbrt(9.0 * area * area / (32.0 * R));
  for (int i = 0; i < 20; ++i) {
    const double half = std::sqrt((2.0 * R - d) * d);
    d -= (R * R * std::acos(1.0 - d / R) - (R - d) * half - area) / (2.0 * half);
  }
  return {d, 2.0 * std::sqrt((2.0 * R - d) * d)};
}

PinOnPlate stiff_pin(double alpha_n, double size) {
  PinOnPlate pin;
  pin.shear_modulus = 50e9;
  pin.passes = 12;
  pin.wear_per_pass = alpha_n / pin.passes;
  pin.size = size;
  // The ends of the groove are felt over some chords of the pin; the middle stays clear of them.
  const double chord = segment_of(alpha_n * PinOnDisc::kLoad).width;
  pin.amplitude = 0.3e-3 + 2.0 * chord;
  pin.half_width = 0.6e-3;
  pin.margin = 0.4e-3;
  pin.increment = 10e-6;
  return pin;
}

/// Chord at the level that the width is measured at.
double width_at_level(double depth) {
  constexpr double R = PinOnDisc::kRadius;
  const double d = depth - analysis::width_level(depth);
  return 2.0 * std::sqrt((2.0 * R - d) * d);
}

TEST(RigidGroove, ClosedFormEqualsTheTable) {
  const Table table("groove_rigid_sphere.csv");
  ASSERT_GT(table.rows(), 10U);
  for (std::size_t r = 0; r < table.rows(); ++r) {
    const Segment s = segment_of(1e-6 * table.number(r, "A_mm2"));
    EXPECT_NEAR(s.depth / (1e-3 * table.number(r, "depth_exact_mm")), 1.0, 1e-5);
    EXPECT_NEAR(s.width / (1e-3 * table.number(r, "width_exact_mm")), 1.0, 1e-5);
  }
}

TEST(RigidGroove, HasTheSegmentsDepthWidthAndAreaWithTheExponentsOfTheSection) {
  // Width at least eight triangles, and half of it several elastic contact radii (0.054 mm).
  std::vector<double> log_n, log_depth, log_width;
  for (const auto& [n, size] :
       {std::pair(4.0, 0.025e-3), std::pair(12.0, 0.025e-3), std::pair(36.0, 0.05e-3)}) {
    const double alpha_n = 6.81e-11 * n, area = alpha_n * PinOnDisc::kLoad;
    const PinOnPlate pin = stiff_pin(alpha_n, size);
    simulation::Simulation run(pin.setup());
    run.advance();
    const Groove g = measure_plate(run, 0.2e-3);
    const Segment s = segment_of(area);
    const std::string name = fmt::format("G = 50 GPa, h = {} mm, alpha n = {} x 6.81e-11: ", 1e3 * size, n);
    measured(name + "depth error", g.depth / s.depth - 1.0, 0.05);
    measured(name + "width error", g.width / width_at_level(s.depth) - 1.0, 0.05);
    measured(name + "area error", g.area / area - 1.0, 0.01);
    EXPECT_NEAR(g.depth / s.depth, 1.0, 0.05);
    EXPECT_NEAR(g.width / width_at_level(s.depth), 1.0, 0.05);
    EXPECT_NEAR(g.area / area, 1.0, 0.01);
    log_n.push_back(std::log(n));
    log_depth.push_back(std::log(g.depth));
    log_width.push_back(std::log(g.width_at_tenth));  // a fixed level would bend the power law
  }
  const double span = log_n.back() - log_n.front();
  const double p = (log_depth.back() - log_depth.front()) / span,
               q = (log_width.back() - log_width.front()) / span;
  measured("exponent of depth, minus 2/3", p - 2.0 / 3.0, 0.03);
  measured("exponent of width, minus 1/3", q - 1.0 / 3.0, 0.03);
  EXPECT_NEAR(p, 2.0 / 3.0, 0.03);
  EXPECT_NEAR(q, 1.0 / 3.0, 0.03);
}

TEST(RigidGroove, ConvergesWithTheMesh) {
  // A deep groove (0.95 mm wide), so that 0.2 mm still resolves it. Error: L2 of the profile against the
  // segment, mean over three meshes of each size.
  const double area = 2.5e-8, alpha_n = area / PinOnDisc::kLoad;
  const Segment s = segment_of(area);
  std::vector<double> y, sink;
  for (int i = 0; i <= 60; ++i) {
    y.push_back(i * 0.01e-3);
    const double R = PinOnDisc::kRadius;
    sink.push_back(std::max(0.0, s.depth - R + std::sqrt(R * R - y.back() * y.back())));
  }
  std::vector<double> errors;
  for (const double size : {0.2e-3, 0.1e-3, 0.05e-3}) {
    double error = 0.0;
    for (const std::uint64_t seed : {1U, 2U}) {
      PinOnPlate pin = stiff_pin(alpha_n, size);
      pin.half_width = 0.9e-3;
      pin.passes = 24;
      pin.wear_per_pass = alpha_n / pin.passes;
      pin.increment = 20e-6;
      pin.seed = seed;
      simulation::Simulation run(pin.setup());
      run.advance();
      error += relative_l2(measure_plate(run, 0.3e-3, y).profile, sink) / 2.0;
    }
    errors.push_back(error);
    measured(fmt::format("profile L2, h = {} mm", 1e3 * size), error, 1.0);
  }
  const double order = std::log2(errors[0] / errors[2]) / 2.0;
  // Second order inside; the corner at the groove's edge leaves an error over one element: 3/2 in L2.
  measured("order of convergence, 0.2 to 0.05 mm", order, 1.3);
  EXPECT_LT(errors[1], errors[0]);
  EXPECT_LT(errors[2], errors[1]);
  EXPECT_GT(order, 1.3);
  EXPECT_LT(errors[2], 0.02);
}

}  // namespace
}  // namespace abradem::test
