// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/cli/mesh_loader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "abradem/cli/print.h"
#include "abradem/core/error.h"
#include "abradem/geometry/mesh_check.h"
#include "abradem/geometry/mesh_repair.h"
#include "abradem/io/mesh_files.h"

namespace abradem::cli {

MeshLoader::MeshLoader(const simulation::Setup& setup) {
  const auto meet = [&](double radius) {  // 0: of a shape as it was given
    if (radius > 0.0) largest_radius_ = std::max(largest_radius_.value_or(0.0), radius);
  };
  for (const simulation::ParticleSetup& p : setup.particles) meet(p.radius);
  for (const simulation::InsertionSetup& i : setup.insertions) meet(simulation::largest_radius(i));
}

geometry::TriangleMesh MeshLoader::operator()(const simulation::MeshSetup& mesh, std::uint64_t seed) const {
  if (mesh.shape != simulation::MeshShape::file) return simulation::generate_mesh(mesh, seed);
  geometry::TriangleMesh read = io::read_mesh(mesh.file, mesh.unit);
  const geometry::RepairRecord repaired = geometry::repair_mesh(read);
  if (repaired.changed())
    print_message(fmt::format("warning: mesh '{}' was repaired in memory; `abradem check` says what was done",
                              mesh.file));
  const geometry::MeshVerdict verdict = geometry::judge_mesh(geometry::check_mesh(read), largest_radius_);
  for (const std::string& warning : verdict.warnings)
    print_message(fmt::format("warning: mesh '{}': {}", mesh.file, warning));
  if (!verdict.usable())
    throw GeometryError(fmt::format("mesh '{}': {}", mesh.file, fmt::join(verdict.errors, "; ")));
  simulation::place(read, mesh);
  return read;
}

}  // namespace abradem::cli
