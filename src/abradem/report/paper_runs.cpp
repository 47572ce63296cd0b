// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/report/paper_runs.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "abradem/core/error.h"
#include "abradem/material/material.h"

namespace abradem::report {
namespace {

using namespace std::string_view_literals;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

constexpr std::array kRevolutionColumns = {"revolution"sv,       "law_volume_mm3"sv, "swept_volume_mm3"sv,
                                           "paper_volume_mm3"sv, "depth_mean_mm"sv,  "width_mean_mm"sv,
                                           "force_mean_N"sv,     "force_max_N"sv};
constexpr std::array kContourColumns = {"revolution"sv, "angle_deg"sv, "depth_mm"sv, "width_mm"sv,
                                        "displaced_width_mm"sv};
constexpr std::array kProfileColumns = {"revolution"sv, "angle_deg"sv, "radius_mm"sv, "height_mm"sv};
constexpr std::array kForceColumns = {"revolution"sv, "normal_force_N"sv, "normal_along_N"sv,
                                      "normal_across_N"sv, "normal_sum_N"sv};

/// Revolutions are written after whole steps, which need not end on one exactly.
bool same_revolution(double a, double b) noexcept { return std::abs(a - b) < 1e-3; }

template <class Keep>
std::vector<double> rows(const Table& table, std::string_view column, double factor, Keep keep) {
  const std::vector<double>& values = table[column];
  const std::vector<double>& revolution = table["revolution"];
  std::vector<double> out;
  for (std::size_t k = 0; k < values.size(); ++k)
    if (keep(revolution[k])) out.push_back(factor * values[k]);
  return out;
}

const simulation::WallSetup* worn_wall(const simulation::Setup& setup) noexcept {
  for (const simulation::WallSetup& wall : setup.walls)
    if (wall.deformation != simulation::DeformationRule::none) return &wall;
  return nullptr;
}

}  // namespace

double FinishedRun::wear_coefficient() const noexcept {
  return setup().wear.empty() ? 0.0 : setup().wear.front().wear_coefficient;
}

double FinishedRun::mesh_size() const noexcept {
  const simulation::WallSetup* wall = worn_wall(setup());
  return wall == nullptr ? 0.0 : wall->mesh.size;
}

double FinishedRun::effective_modulus() const {
  if (setup().wear.empty()) return 0.0;
  const auto material = [&](const std::string& name) {
    const auto found = std::ranges::find(setup().materials, name, &simulation::MaterialSetup::name);
    return found == setup().materials.end()
               ? material::Material{}
               : material::Material{found->density, found->shear_modulus, found->poisson_ratio};
  };
  const simulation::WearSetup& wear = setup().wear.front();
  return material::effective_moduli(material(wear.abrader), material(wear.worn)).E_eff;
}

std::vector<double> FinishedRun::sections(double revolution, std::string_view column, double factor) const {
  return rows(contours, column, factor, [&](double r) { return same_revolution(r, revolution); });
}

std::vector<double> FinishedRun::forces(double revolution, std::string_view column) const {
  return rows(force, column, 1.0, [&](double r) { return r > revolution - 1.0 && r <= revolution; });
}

std::vector<double> FinishedRun::column(std::string_view name, double factor) const {
  return rows(revolutions, name, factor, [](double) { return true; });
}

std::vector<double> FinishedRun::normality(std::string_view contour_column, analysis::Binning binning) const {
  std::vector<double> p;
  for (const double revolution : column("revolution")) {
    const std::vector<double> values = sections(revolution, contour_column);
    p.push_back(binning == analysis::Binning::equal_width
                    ? analysis::chi_squared_normality(values, analysis::kEqualWidthBins, binning).p
                    : analysis::chi_squared_normality(values).p);
  }
  return p;
}

double FinishedRun::at(double revolution, std::string_view column) const {
  const std::vector<double> found =
      rows(revolutions, column, 1.0, [&](double r) { return same_revolution(r, revolution); });
  return found.empty() ? kNaN : found.front();
}

FinishedRun read_finished(const StudyRun& run) {
  const std::filesystem::path tables = run.folder / "tables";
  FinishedRun out{&run, read_table(tables / "revolutions.csv", kRevolutionColumns),
                  read_table(tables / "contours.csv", kContourColumns),
                  read_table(tables / "profiles.csv", kProfileColumns),
                  read_table(tables / "force.csv", kForceColumns)};
  if (out.revolutions.rows() == 0)
    throw IoError(fmt::format("{}: no rows; expected one per output of a completed run",
                              (tables / "revolutions.csv").string()));
  return out;
}

std::vector<DrawnProfile> profiles_of(const FinishedRun& run, double revolution, double track) {
  const auto &turns = run.profiles["revolution"], &angles = run.profiles["angle_deg"],
             &radii = run.profiles["radius_mm"], &heights = run.profiles["height_mm"];
  std::vector<DrawnProfile> out;
  for (std::size_t k = 0; k < turns.size(); ++k) {
    if (!same_revolution(turns[k], revolution)) continue;
    if (out.empty() || out.back().angle != angles[k]) out.push_back({angles[k], {}, {}});
    out.back().x_mm.push_back(radii[k] - track);
    out.back().height_um.push_back(1e3 * heights[k]);
  }
  return out;
}

const FinishedRun* PaperReading::with_coefficient(double coefficient) const noexcept {
  for (const FinishedRun& run : coefficients)
    if (std::abs(run.wear_coefficient() / coefficient - 1.0) < 1e-6) return &run;
  return nullptr;
}

PaperRuns read_paper_runs(const simulation::Setup& study, std::span<const StudyRun> runs) {
  PaperRuns out;
  out.setup = study;
  out.readings[0] = {.name = "paper's rules",
                     .volume_column = "paper_volume_mm3",
                     .volume_name = "eq. 10-12 over the elements in contact",
                     .width_column = "displaced_width_mm",
                     .width_name = "from the first displaced node to the last",
                     .binning = analysis::Binning::equal_width};
  out.readings[1] = {.name = "conserving",
                     .volume_column = "swept_volume_mm3",
                     .volume_name = "what the mesh lost",
                     .width_column = "width_mm",
                     .width_name = "opening at 1 % of the depth, at least 0.5 µm",
                     .binning = analysis::Binning::equiprobable,
                     .conserving = true,
                     .colour = 1};
  out.published = read_published(study.study->published);
  out.measured = study.measurement.value_or(simulation::MeasurementSetup{});
  out.passes_test = out.measured.revolutions.value_or(kNaN);
  for (const simulation::ParticleSetup& particle : study.particles) {
    if (norm(particle.load) == 0.0) continue;
    out.load = norm(particle.load);
    out.track = std::hypot(particle.position.x, particle.position.y);
  }
  for (const StudyRun& run : runs) {
    const simulation::WallSetup* wall = worn_wall(run.setup);
    if (run.status != "completed" || wall == nullptr) continue;
    PaperReading& reading = out.readings[wall->deformation == simulation::DeformationRule::paper ? 0 : 1];
    if (run.variation == kMeshSizeRuns) reading.mesh_sizes.push_back(read_finished(run));
    if (run.variation == kRevolutionRuns) reading.revolutions = read_finished(run);
    if (run.variation == kCoefficientRuns) reading.coefficients.push_back(read_finished(run));
    if (run.variation == kSeedRuns) reading.seeds.push_back(read_finished(run));
    if (run.variation == kProfileRuns) reading.profile = read_finished(run);
    if (run.variation == kCalibratedRuns) out.calibrated.push_back(read_finished(run));
    if (run.variation == kLaboratoryRuns) out.laboratory = read_finished(run);
  }
  for (PaperReading& reading : out.readings) {
    std::ranges::stable_sort(reading.mesh_sizes, {}, &FinishedRun::mesh_size);
    std::ranges::stable_sort(reading.coefficients, {}, &FinishedRun::wear_coefficient);
  }
  std::ranges::stable_sort(out.calibrated, {}, &FinishedRun::effective_modulus);
  return out;
}

}  // namespace abradem::report
