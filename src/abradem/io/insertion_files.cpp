// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/insertion_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>

#include "abradem/core/error.h"
#include "abradem/geometry/mesh_check.h"
#include "abradem/geometry/mesh_repair.h"
#include "abradem/io/measured_table.h"
#include "abradem/io/mesh_files.h"
#include "abradem/io/run_particles.h"

namespace abradem::io {

namespace {

using namespace simulation;

constexpr core::Dimension kLength{.length = 1}, kNone{};

std::vector<double> column(const MeasuredTable& table, std::string_view name,
                           const core::Dimension& dimension) {
  return table.quantities(std::array{name}, dimension);
}
bool has(const MeasuredTable& table, std::string_view name) {
  return table.find(std::array{name}).has_value();
}

/// @throws IoError naming the place of the first value for which `good` does not hold
void require(const MeasuredTable& table, std::string_view name, std::span<const double> values,
             const char* wanted, bool (*good)(double)) {
  const std::size_t bad = static_cast<std::size_t>(std::ranges::find_if_not(values, good) - values.begin());
  if (bad < values.size())
    throw IoError(table.at(bad, *table.find(std::array{name}), fmt::format("{} must be {}", name, wanted)));
}

/// Of the column radius, or of half the diameter [m].
std::vector<double> radii(const MeasuredTable& table) {
  const std::string_view name = has(table, "diameter") && !has(table, "radius") ? "diameter" : "radius";
  std::vector<double> values = column(table, name, kLength);
  if (values.empty()) throw IoError(fmt::format("{}: has no rows", table.file()));
  require(table, name, values, "> 0", [](double R) { return R > 0.0; });
  if (name == "diameter")
    for (double& R : values) R *= 0.5;
  return values;
}

/// The vectors of the columns NAME_x, NAME_y and NAME_z; where the table has none of them, those of the case
/// for all.
std::vector<Vec3> own_vectors(const MeasuredTable& table, const std::string& name,
                              const core::Dimension& dimension, const Vec3& of_all) {
  std::vector<Vec3> values(table.rows(), of_all);
  if (!has(table, name + "_x") && !has(table, name + "_y") && !has(table, name + "_z")) return values;
  const auto x = column(table, name + "_x", dimension), y = column(table, name + "_y", dimension),
             z = column(table, name + "_z", dimension);
  for (std::size_t r = 0; r < values.size(); ++r) values[r] = {x[r], y[r], z[r]};
  return values;
}

void read_places(InsertionSetup& i) {
  const MeasuredTable table(i.volume.file);
  const auto x = column(table, "x", kLength), y = column(table, "y", kLength),
             z = column(table, "z", kLength), R = radii(table);
  const auto velocity = own_vectors(table, "velocity", {.length = 1, .time = -1}, i.velocity);
  const auto spin = own_vectors(table, "spin", {.time = -1, .angle = 1}, i.spin);
  i.placed.clear();
  for (std::size_t r = 0; r < x.size(); ++r)
    i.placed.push_back({{x[r], y[r], z[r]}, R[r], velocity[r], spin[r]});
}

/// Shares by number, or by mass, which a number of spheres has that goes with 1/R^3. Sizes of no share are
/// left out.
void read_sizes(SizeSetup& size) {
  const MeasuredTable table(size.file);
  const std::string_view name = has(table, "mass_share") && !has(table, "share") ? "mass_share" : "share";
  const std::vector<double> R = radii(table), shares = column(table, name, kNone);
  require(table, name, shares, ">= 0", [](double share) { return share >= 0.0; });
  size.radii.clear(), size.shares.clear();
  const double largest = std::ranges::max(R);
  for (std::size_t r = 0; r < R.size(); ++r) {
    if (shares[r] == 0.0) continue;
    size.radii.push_back(R[r]);
    size.shares.push_back(name == "share" ? shares[r] : shares[r] * std::pow(largest / R[r], 3.0));
  }
  if (size.radii.empty()) throw IoError(fmt::format("{}: all shares are 0", table.file()));
}

void fit_shape(const std::string& name, ShapeFitSetup& fit) {
  geometry::TriangleMesh mesh = read_mesh(fit.file, fit.unit);
  geometry::repair_mesh(mesh);
  const geometry::MeshReport report = geometry::check_mesh(mesh);
  if (!report.closed)
    throw GeometryError(fmt::format(
        "shape '{}': the mesh '{}' is not closed ({} open edges, {} with more than two triangles, {} "
        "between opposite sides): it bounds no solid; `abradem check {}` says more",
        name, fit.file, report.open_edges, report.non_manifold_edges, report.inconsistent_edges, fit.file));
  if (report.components > 1 || !(report.volume > 0.0))
    throw GeometryError(
        fmt::format("shape '{}': the mesh '{}' is not one solid: it has {} parts that enclose "
                    "{:.4g} mm^3 together",
                    name, fit.file, report.components, 1e9 * report.volume));
  try {
    fit.fit = geometry::fit_spheres(mesh, fit.count);
  } catch (const GeometryError& e) {
    throw GeometryError(fmt::format("shape '{}', mesh '{}': {}", name, fit.file, e.what()));
  }
  fit.solid = geometry::mass_properties(mesh);
}

}  // namespace

std::vector<std::string> read_insertion_files(Setup& setup) {
  for (ShapeSetup& shape : setup.shapes)
    if (shape.fit) fit_shape(shape.name, *shape.fit);
  for (InsertionSetup& i : setup.insertions) {
    if (i.volume.shape == VolumeShape::file)
      read_places(i);
    else if (!gives_places(i.volume.shape) && i.size.kind == SizeKind::table)
      read_sizes(i.size);
  }
  return take_from_runs(setup);
}

}  // namespace abradem::io
