// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/cli/summary.h"

#include <fmt/core.h>

#include <cmath>

#include "abradem/core/units.h"
#include "abradem/io/case_checks.h"
#include "abradem/simulation/wall_motion.h"
#include "abradem/study/variations.h"

namespace abradem::cli {
namespace {

using namespace simulation;

std::string_view name_of(MotionKind kind) {
  switch (kind) {
    case MotionKind::none:
      return "at rest";
    case MotionKind::rotation:
      return "turning";
    case MotionKind::translation:
      return "moving";
    case MotionKind::oscillation:
      return "oscillating";
    case MotionKind::table:
      return "moving by a table";
  }
  return {};
}

std::string shape_of(const MeshSetup& mesh) {
  if (mesh.shape == MeshShape::plane) return "an analytic plane";
  if (mesh.shape == MeshShape::file) return mesh.file;
  const double step =
      std::pow(10.0, std::floor(std::log10(io::estimated_triangles(mesh))) - 1.0);  // two digits
  return fmt::format("about {:.0f} triangles of {}", std::round(io::estimated_triangles(mesh) / step) * step,
                     core::format_quantity(mesh.size, "mm"));
}

/// What the first wall that turns or oscillates counts.
std::string_view unit_of_counting(const Setup& setup) {
  for (const WallSetup& w : setup.walls) {
    if (const MotionSetup* m = simulation::cyclic_motion(w))
      return m->kind == MotionKind::rotation ? "revolutions" : "cycles";
  }
  return {};
}

/// "turning, and with that oscillating"
std::string motions_of(const WallSetup& wall) {
  std::string out(name_of(wall.motion.kind));
  for (const MotionSetup& m : wall.carried_by) out += fmt::format(", and with that {}", name_of(m.kind));
  return out;
}

std::string source_of(const InsertionSetup& i) {
  if (i.volume.shape == VolumeShape::file) return "as in " + i.volume.file;
  if (i.volume.shape == VolumeShape::run)
    return fmt::format("{}as left by {}",
                       i.placed.empty() ? "" : fmt::format("{} particles, ", i.placed.size()), i.volume.run);
  return i.number > 0 ? fmt::format("{} particles", i.number)
                      : fmt::format("{:.4g} kg", i.mass.value_or(0.0));
}

}  // namespace

std::string summarize(const Setup& setup) {
  std::string out = setup.title.empty() ? std::string{} : fmt::format("{}\n", setup.title);
  for (const WallSetup& w : setup.walls)
    out += fmt::format("  wall '{}' of {}: {}, {}\n", w.name, w.material, shape_of(w.mesh), motions_of(w));
  for (const ParticleSetup& p : setup.particles)
    if (!p.shape.empty())
      out += fmt::format("  particle '{}' of {}: shape '{}'\n", p.name, p.material, p.shape);
    else
      out += fmt::format("  particle '{}' of {}: radius {}, load {:.4g} N{}\n", p.name, p.material,
                         core::format_quantity(p.radius, "mm"), norm(p.load),
                         p.guide == Guide::vertical ? ", guided" : "");
  for (const InsertionSetup& i : setup.insertions)
    out += fmt::format("  insertion '{}' of {}: {}{}\n", i.name, i.material, source_of(i),
                       i.mass_rate ? fmt::format(" at {:.4g} kg/s", *i.mass_rate) : "");
  const Duration& end = setup.run.end;
  out += fmt::format("  run: {} {}, {}", core::format_number(end.value),
                     end.in_revolutions ? unit_of_counting(setup) : "s",
                     setup.run.method == Method::dynamic ? "dynamic" : "quasi-static");
  if (const Duration& settle = setup.run.settle; settle.value > 0.0)
    out += fmt::format(", {} {} to settle", core::format_number(settle.value),
                       settle.in_revolutions ? unit_of_counting(setup) : "s");
  if (setup.study) {
    const std::size_t runs = study::plan(*setup.study).size();
    out += fmt::format("\n  study: {} run{} in {} variation{}:", runs, runs == 1 ? "" : "s",
                       setup.study->variations.size(), setup.study->variations.size() == 1 ? "" : "s");
    for (const VariationSetup& v : setup.study->variations)
      out += fmt::format(" {} ({})", v.name, study::count_runs(v, runs));
  }
  return out;
}

}  // namespace abradem::cli
