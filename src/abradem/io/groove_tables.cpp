// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/groove_tables.h"

#include <fmt/core.h>

#include <cmath>

#include "abradem/core/error.h"
#include "abradem/io/vtp.h"

namespace abradem::io {

namespace {

constexpr double kMm = 1e3, kUm = 1e6, kMm2 = 1e6, kMm3 = 1e9;

bool any_tip(const simulation::Simulation& run) {
  for (std::size_t p = 0; p < run.particles().size(); ++p)
    if (run.tip(p) != nullptr) return true;
  return false;
}

/// The worn end as a surface in the world: a square of the map's points, each on the sphere and then back.
void write_tip_surface(const std::filesystem::path& file, const simulation::Simulation& run, std::size_t p) {
  const wear::WearingTip& tip = *run.tip(p);
  const Vec3 u = run.tip_along(p), v = run.tip_across(p), axis = run.particles().guide[p];
  const double R = tip.radius();
  const int side = tip.shape().side();
  geometry::TriangleMesh mesh;
  std::vector<double> recession;
  std::vector<geometry::Index> number(tip.shape().recession.size(), -1);
  for (std::size_t k = 0; k < number.size(); ++k) {
    const double s = tip.s_of(k), t = tip.t_of(k), h2 = R * R - s * s - t * t;
    if (h2 <= 0.0) continue;
    number[k] = static_cast<geometry::Index>(mesh.vertices.size());
    mesh.vertices.push_back(run.particles().position[p] + s * u + t * v +
                            (std::sqrt(h2) - tip.recession_of(k)) * axis);
    recession.push_back(kUm * tip.recession_of(k));
  }
  for (int j = 0; j + 1 < side; ++j)
    for (int i = 0; i + 1 < side; ++i) {
      const auto at = [&](int a, int b) {
        const int k = (j + b) * side + i + a;
        return number[static_cast<std::size_t>(k)];
      };
      const geometry::Index q[4]{at(0, 0), at(1, 0), at(1, 1), at(0, 1)};
      if (q[0] < 0 || q[1] < 0 || q[2] < 0 || q[3] < 0) continue;
      mesh.triangles.push_back({q[0], q[1], q[2]});
      mesh.triangles.push_back({q[0], q[2], q[3]});
    }
  const VtpArray points[]{{"recession_um", recession, 1}};
  write_vtp(file, mesh, points, {});
}

}  // namespace

GrooveTables::GrooveTables(const simulation::Simulation& run, std::filesystem::path folder,
                           const GrooveTablePositions& from)
    : folder_(std::move(folder)) {
  if (run.ploughs())
    ridges_.emplace(
        folder_ / "tables" / "ridges.csv",
        std::vector<std::string>{"revolution", "groove_volume_mm3", "removed_volume_mm3",
                                 "displaced_volume_mm3", "piled_volume_mm3", "ridge_height_mean_mm",
                                 "ridge_height_sd_mm", "ridge_area_mean_mm2", "groove_area_mean_mm2"},
        CsvWriter::Growing{from.ridges});
  if (any_tip(run))
    tips_.emplace(folder_ / "tables" / "tip.csv",
                  std::vector<std::string>{"revolution", "particle", "law_volume_mm3", "deposited_volume_mm3",
                                           "removed_volume_mm3", "mass_ug", "recession_um", "flat_along_mm",
                                           "flat_across_mm", "map_cell_um"},
                  CsvWriter::Growing{from.tips});
}

void GrooveTables::add(const simulation::Simulation& run, const simulation::Ledger& ledger, double revolution,
                       std::span<const analysis::Contour> contours) {
  if (ridges_) {
    const analysis::RidgeSummary ridge = analysis::ridge_summary(contours);
    ridges_->row({revolution, kMm3 * (ledger.law + ledger.displaced), kMm3 * ledger.law,
                  kMm3 * ledger.displaced, kMm3 * ledger.piled, kMm * ridge.height_mean,
                  kMm * ridge.height_sd, kMm2 * ridge.ridge_area, kMm2 * ridge.groove_area});
  }
  if (!tips_) return;
  for (std::size_t p = 0; p < run.particles().size(); ++p) {
    const wear::WearingTip* tip = run.tip(p);
    if (tip == nullptr) continue;
    const wear::WearingTip::Extent flat = tip->flat(simulation::kFlatLevel);
    const auto material = static_cast<std::size_t>(run.particles().material[p]);
    tips_->row({revolution, static_cast<double>(p), kMm3 * run.tip_law_volume(p),
                kMm3 * tip->deposited_volume(), kMm3 * tip->removed_volume(),
                1e9 * run.setup().materials[material].density * tip->removed_volume(), kUm * tip->deepest(),
                kMm * flat.along_s, kMm * flat.along_t, kUm * tip->shape().cell});
  }
}

GrooveTablePositions GrooveTables::positions() const noexcept {
  return {ridges_ ? ridges_->position() : 0, tips_ ? tips_->position() : 0};
}

void GrooveTables::flush() {
  for (auto* table : {&ridges_, &tips_})
    if (*table) (*table)->flush();
}

void GrooveTables::sync() {
  for (auto* table : {&ridges_, &tips_})
    if (*table) (*table)->sync();
}

void GrooveTables::close(const simulation::Simulation& run) {
  if (ridges_) ridges_->close();
  if (!tips_) return;
  tips_->close();
  CsvWriter profile(folder_ / "tables" / "tip_profile.csv",
                    {"particle", "distance_mm", "sphere_um", "recession_along_um", "recession_across_um"});
  for (std::size_t p = 0; p < run.particles().size(); ++p) {
    const wear::WearingTip* tip = run.tip(p);
    if (tip == nullptr) continue;
    const contact::TipShape& shape = tip->shape();
    for (int i = -shape.half; i <= shape.half; ++i) {
      const double x = shape.cell * i, R = tip->radius();
      if (std::abs(x) >= R) continue;
      profile.row({static_cast<double>(p), kMm * x, kUm * (R - std::sqrt(R * R - x * x)),
                   kUm * shape.at(x, 0.0), kUm * shape.at(0.0, x)});
    }
    if (run.setup().output.frames != simulation::Frames::none)
      write_tip_surface(folder_ / "vtk" / fmt::format("tip_{}.vtp", run.particles().name[p]), run, p);
  }
  profile.close();
}

}  // namespace abradem::io
