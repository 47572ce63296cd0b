// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/cli/check_mesh.h"

#include <fmt/core.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <vector>

#include "abradem/cli/print.h"
#include "abradem/core/error.h"
#include "abradem/geometry/mesh_check.h"
#include "abradem/geometry/mesh_repair.h"
#include "abradem/io/mesh_files.h"

namespace abradem::cli {

namespace {

using geometry::MeshReport;
using geometry::MeshVerdict;
using geometry::RepairRecord;

std::string millimetres(double metres) { return fmt::format("{:.5g}", 1e3 * metres); }

void row(const char* name, const std::string& value, const char* remark = "") {
  fmt::print("  {:<28}{:>26}{}{}\n", name, value, *remark != '\0' ? "  " : "", remark);
}

void count_row(const char* name, geometry::Index count, const char* remark_if_any = "") {
  row(name, fmt::format("{}", count), count > 0 ? remark_if_any : "");
}

std::string range(double low, double mean, double high) {
  return fmt::format("{} / {} / {}", millimetres(low), millimetres(mean), millimetres(high));
}

void print_repairs(const RepairRecord& done) {
  fmt::print("repaired in memory (a run does the same; the file is unchanged)\n");
  if (!done.changed()) {
    fmt::print("  nothing to repair\n");
    return;
  }
  const auto show = [](const char* what, geometry::Index count) {
    if (count > 0) count_row(what, count);
  };
  show("vertices merged", done.welded_vertices);
  show("unused vertices dropped", done.unused_vertices);
  show("triangles without area", done.degenerate_triangles);
  show("double triangles dropped", done.duplicate_triangles);
  show("triangles turned round", done.flipped_triangles);
  if (done.turned_outward) row("whole mesh turned outward", "yes");
}

void print_table(const std::string& path, const MeshReport& r, const RepairRecord& done,
                 const MeshVerdict& verdict) {
  fmt::print("{}\n", path);
  row("triangles", fmt::format("{}", r.triangles));
  row("vertices", fmt::format("{}", r.vertices));
  row("parts", fmt::format("{}", r.components));
  row("x from, to [mm]", millimetres(r.box.low.x) + ", " + millimetres(r.box.high.x));
  row("y from, to [mm]", millimetres(r.box.low.y) + ", " + millimetres(r.box.high.y));
  row("z from, to [mm]", millimetres(r.box.low.z) + ", " + millimetres(r.box.high.z));
  row("edge min/mean/max [mm]", range(r.edge_min, r.edge_mean, r.edge_max));
  row("quality min/mean [-]", fmt::format("{:.3f} / {:.3f}", r.quality_min, r.quality_mean),
      "1: equilateral");
  row("area [mm^2]", fmt::format("{:.6g}", 1e6 * r.area));
  row("closed", r.closed ? "yes" : "no");
  if (r.closed) row("volume [mm^3]", fmt::format("{:.6g}", 1e9 * r.volume));
  fmt::print("defects\n");
  count_row("coinciding vertices", r.duplicate_vertices);
  count_row("unused vertices", r.unused_vertices);
  count_row("double triangles", r.duplicate_triangles);
  count_row("triangles without area", r.degenerate_triangles);
  count_row("slivers", r.slivers, "quality below 0.05");
  count_row("open edges", r.open_edges, "the border of a sheet, or holes");
  count_row("border loops", r.border_loops);
  count_row("small holes", r.small_holes, "triangles missing");
  count_row("edges with > 2 triangles", r.non_manifold_edges);
  count_row("edges between opposite sides", r.inconsistent_edges);
  row("inside out", r.inward() ? "yes" : "no");
  print_repairs(done);
  for (const std::string& text : verdict.warnings) fmt::print("warning: {}\n", text);
  for (const std::string& text : verdict.errors) fmt::print("error: {}\n", text);
  fmt::print("verdict: {}\n", verdict.usable() ? "usable" : "not usable");
}

void print_json(const std::string& path, const MeshReport& r, const RepairRecord& done,
                const MeshVerdict& verdict) {
  const auto in_mm = [](const Vec3& v) { return std::vector<double>{1e3 * v.x, 1e3 * v.y, 1e3 * v.z}; };
  const nlohmann::ordered_json json{
      {"mesh", path},
      {"triangles", r.triangles},
      {"vertices", r.vertices},
      {"components", r.components},
      {"box_low_mm", in_mm(r.box.low)},
      {"box_high_mm", in_mm(r.box.high)},
      {"edge_min_mm", 1e3 * r.edge_min},
      {"edge_mean_mm", 1e3 * r.edge_mean},
      {"edge_max_mm", 1e3 * r.edge_max},
      {"quality_min", r.quality_min},
      {"quality_mean", r.quality_mean},
      {"area_mm2", 1e6 * r.area},
      {"closed", r.closed},
      {"volume_mm3", 1e9 * r.volume},
      {"duplicate_vertices", r.duplicate_vertices},
      {"unused_vertices", r.unused_vertices},
      {"duplicate_triangles", r.duplicate_triangles},
      {"degenerate_triangles", r.degenerate_triangles},
      {"slivers", r.slivers},
      {"open_edges", r.open_edges},
      {"border_loops", r.border_loops},
      {"small_holes", r.small_holes},
      {"non_manifold_edges", r.non_manifold_edges},
      {"inconsistent_edges", r.inconsistent_edges},
      {"inside_out", r.inward()},
      {"repaired",
       {{"welded_vertices", done.welded_vertices},
        {"unused_vertices", done.unused_vertices},
        {"degenerate_triangles", done.degenerate_triangles},
        {"duplicate_triangles", done.duplicate_triangles},
        {"flipped_triangles", done.flipped_triangles},
        {"turned_outward", done.turned_outward}}},
      {"warnings", verdict.warnings},
      {"errors", verdict.errors},
      {"usable", verdict.usable()},
  };
  fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
}

}  // namespace

int check_mesh_command(const std::string& path, double unit, bool json) {
  geometry::TriangleMesh mesh = io::read_mesh(path, unit);
  const MeshReport as_read = geometry::check_mesh(mesh);
  const RepairRecord done = geometry::repair_mesh(mesh);
  const MeshVerdict verdict = geometry::judge_mesh(done.changed() ? geometry::check_mesh(mesh) : as_read);
  if (json)
    print_json(path, as_read, done, verdict);
  else
    print_table(path, as_read, done, verdict);
  print_result("");  // all of it has arrived
  return static_cast<int>(verdict.usable() ? ExitCode::ok : ExitCode::geometry);
}

}  // namespace abradem::cli
