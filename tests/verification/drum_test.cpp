// SPDX-License-Identifier: BSD-3-Clause
// The flow in a rotating drum. docs/verification/bulk.md#the-drum
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "abradem/analysis/flow_profile.h"
#include "abradem/io/case_file.h"
#include "abradem/io/csv.h"
#include "abradem/io/measured_table.h"
#include "abradem/io/mesh_files.h"
#include "support/grains.h"
#include "support/reference_data.h"

namespace abradem::test {
namespace {

using namespace std::string_view_literals;
constexpr double kAngle = 27.0 * std::numbers::pi / 180.0, kRadius = 0.12, kRate = 1.214, kBead = 1.5e-3;
const Vec3 kUp{std::sin(kAngle), 0.0, std::cos(kAngle)}, kDown{std::cos(kAngle), 0.0, -std::sin(kAngle)};

/// The beads of the ready case at its end, without spin.
std::vector<PlacedSphere> flowing_bed() {
  const io::CsvTable table = io::read_csv(data_file("drum_bed.csv"));
  std::vector<PlacedSphere> bed;
  for (std::size_t r = 0; r < table.rows(); ++r) {
    const std::span<const double> row = table.row(r);
    bed.push_back({1e-5 * Vec3{row[0], row[1], row[2]}, kBead, 1e-3 * Vec3{row[3], row[4], row[5]}});
  }
  return bed;
}

/// Velocity down the slope by depth: linear between the bins.
class DepthProfile {
 public:
  explicit DepthProfile(const analysis::FlowProfile& flow) {
    for (const analysis::FlowBin& bin : flow.bins())
      if (2 * bin.samples >= flow.moments())
        at_.emplace_back(bin.distance - kRadius, dot(bin.velocity, kDown));
  }
  [[nodiscard]] double surface() const { return at_.back().first; }
  [[nodiscard]] double velocity(double y) const {
    std::size_t k = 1;
    while (k + 1 < at_.size() && at_[k].first < y) ++k;
    const auto [y0, u0] = at_[k - 1];
    const auto [y1, u1] = at_[k];
    return u0 + (u1 - u0) * (y - y0) / (y1 - y0);
  }
  /// Where beads neither rise nor fall.
  [[nodiscard]] double still() const {
    double y = surface();
    while (velocity(y) > 0.0 && y > -kRadius) y -= 1e-5;
    return y;
  }

 private:
  std::vector<std::pair<double, double>> at_;
};

/// The ready case with softer beads, begun where it ends.
TEST(Drum, BeadsFlowAsMeasured) {
  const OneThread alone;
  simulation::Setup setup =
      io::read_case(ABRADEM_SOURCE_DIR "/cases/drum-profile.toml",
                    std::vector<std::string>{"material.glass.shear_modulus='2 MPa'",
                                             "run.time_step='30% rayleigh'"});  // a third of the steps
  setup.insertions[0].placed = flowing_bed();
  setup.output.maps = Maps::off;
  Simulation run(setup,
                 [](const MeshSetup& mesh, std::uint64_t) { return io::read_mesh(mesh.file, mesh.unit); });
  analysis::FlowProfile flow({-kRadius * kUp, -0.02 * kUp, 50, 5e-3, {0, 1, 0}});
  while (run.time() < 0.15) run.step();
  while (run.time() < 0.55 || run.steps() % static_cast<std::uint64_t>(setup.walls[0].deform_every) != 0) {
    run.step();
    if (run.steps() % 100 != 0) continue;
    std::vector<Vec3> centres, velocities;
    for (const contact::SphereRow& s : run.bulk()->spheres().row) {
      centres.push_back(s.position());
      velocities.push_back(s.velocity());
    }
    flow.add(centres, velocities);
  }
  const DepthProfile profile(flow);
  double squares = 0.0, n = 0.0;
  const io::MeasuredTable measured(ABRADEM_SOURCE_DIR "/cases/data/drum-profile.csv");
  const auto distance = measured.quantities(std::array{"distance"sv}, {.length = 1}),
             velocity = measured.quantities(std::array{"component"sv}, {.length = 1, .time = -1});
  for (std::size_t r = 0; r < distance.size(); ++r) {
    const double y = distance[r] - kRadius;
    if (y > profile.surface()) continue;
    squares += std::pow(profile.velocity(y) - velocity[r], 2);
    n += 1.0;
  }
  const double rms = std::sqrt(squares / n);
  EXPECT_GE(n, 33.0);
  EXPECT_LT(rms, 0.06);  // of -0.14 to 0.35 m/s; neighbouring points differ by 0.03
  EXPECT_NEAR(profile.still(), -0.0594, 2.0 * kBead);  // where the measured points change sign
  EXPECT_NEAR(profile.velocity(-0.113) / (-0.113 * kRate), 1.0, 0.04);  // the drum carries them along
  EXPECT_GT(run.ledger().law, 0.0);
  EXPECT_LT(run.ledger().residual, 1e-9);
  RecordProperty("rms", std::to_string(rms));
  RecordProperty("still", std::to_string(profile.still()));
  RecordProperty("surface", std::to_string(profile.surface()));
  RecordProperty("at_the_wall", std::to_string(profile.velocity(-0.113) / (-0.113 * kRate)));
  RecordProperty("residual", std::to_string(1e12 * run.ledger().residual) + "e-12");
}

}  // namespace
}  // namespace abradem::test
