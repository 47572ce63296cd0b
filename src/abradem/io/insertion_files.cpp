// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/insertion_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "abradem/core/error.h"
#include "abradem/geometry/mesh_check.h"
#include "abradem/geometry/mesh_repair.h"
#include "abradem/io/csv.h"
#include "abradem/io/mesh_files.h"

namespace abradem::io {

namespace {

using namespace simulation;

/// A column in which every number is finite and, where wanted, above 0.
std::vector<double> checked(const CsvTable& table, const std::string& file, const char* name, bool positive) {
  std::vector<double> values = table.column(name);
  for (std::size_t r = 0; r < values.size(); ++r)
    if (!std::isfinite(values[r]) || (positive && !(values[r] > 0.0)))
      throw InputError(fmt::format("{}:{}: {} = {}; must be a number{}", file, r + 2, name, values[r],
                                   positive ? " > 0" : ""));
  if (values.empty()) throw InputError(fmt::format("'{}' has no rows", file));
  return values;
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

void read_insertion_files(Setup& setup) {
  for (ShapeSetup& shape : setup.shapes)
    if (shape.fit) fit_shape(shape.name, *shape.fit);
  for (InsertionSetup& i : setup.insertions) {
    if (i.volume.shape == VolumeShape::file) {
      const CsvTable table = read_csv(i.volume.file);
      const auto x = checked(table, i.volume.file, "x_mm", false),
                 y = checked(table, i.volume.file, "y_mm", false),
                 z = checked(table, i.volume.file, "z_mm", false),
                 R = checked(table, i.volume.file, "radius_mm", true);
      // Velocities of their own, where the file has them.
      const bool moving = std::ranges::find(table.columns, "velocity_x_m_per_s") != table.columns.end();
      std::vector<double> u, v, w;
      if (moving) {
        u = checked(table, i.volume.file, "velocity_x_m_per_s", false);
        v = checked(table, i.volume.file, "velocity_y_m_per_s", false);
        w = checked(table, i.volume.file, "velocity_z_m_per_s", false);
      }
      i.placed.clear();
      for (std::size_t r = 0; r < x.size(); ++r)
        i.placed.push_back(
            {1e-3 * Vec3{x[r], y[r], z[r]}, 1e-3 * R[r], moving ? Vec3{u[r], v[r], w[r]} : i.velocity});
    }
    if (i.size.kind == SizeKind::table && i.volume.shape != VolumeShape::file) {
      const CsvTable table = read_csv(i.size.file);
      i.size.radii = checked(table, i.size.file, "radius_mm", true);
      for (double& R : i.size.radii) R *= 1e-3;
      i.size.shares = checked(table, i.size.file, "share", true);
    }
  }
}

}  // namespace abradem::io
