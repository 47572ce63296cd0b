// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/report/report.h"

#include <fmt/core.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "abradem/io/atomic_file.h"
#include "abradem/report/page_parts.h"
#include "abradem/report/page_source.h"
#include "abradem/report/particles_section.h"
#include "abradem/report/pin_and_ridges_section.h"
#include "abradem/report/sections.h"
#include "abradem/report/statistics_section.h"
#include "abradem/report/text.h"
#include "abradem/report/walls_section.h"
#include "abradem/report/wear_map_section.h"

namespace abradem::report {
namespace {

// What a figure can show and a page of a few megabytes can hold.
constexpr std::size_t kMaxContourRows = 40000;
constexpr std::size_t kMaxProfileRows = 40000;
constexpr std::size_t kMaxForceRows = 20000;

/// Resolution of the coordinates in the page.
constexpr double kPositionStep_mm = 1e-3;
constexpr double kNormalStep = 1e-4;
constexpr double kDepthStep_um = 1e-4;

/// The surface's arrays and, for the page's script, the steps they are multiples of.
std::string surface_blocks(const WornSurface& surface) {
  const SurfaceView& view = surface.view;
  std::string out;
  out += data_block("x", pack_numbers(view.x_mm, kPositionStep_mm)) +
         data_block("y", pack_numbers(view.y_mm, kPositionStep_mm));
  out += data_block("z", pack_numbers(view.z_mm, kPositionStep_mm));
  out += data_block("nx", pack_numbers(view.nx, kNormalStep)) +
         data_block("ny", pack_numbers(view.ny, kNormalStep));
  out += data_block("nz", pack_numbers(view.nz, kNormalStep));
  out += data_block("depth", pack_numbers(view.depth_um, kDepthStep_um));
  out += data_block("i", pack_numbers(view.i, 1.0)) + data_block("j", pack_numbers(view.j, 1.0)) +
         data_block("k", pack_numbers(view.k, 1.0));
  return out + data_block("map", pack_numbers(surface.map.depth_um, kDepthStep_um));
}

std::string surface_json(const RunFolder& run) {
  if (!run.surface) return "null";
  const WornSurface& s = *run.surface;
  return fmt::format(
      R"({{"position_step":{},"normal_step":{},"depth_step":{},"max_depth_um":{},"resampled":{},"triangles":{},"mesh_triangles":{},)"
      R"("map":{{"polar":{},"u_first":{},"u_step":{},"u_count":{},"v_first":{},"v_step":{},"v_count":{}}}}})",
      json_number(kPositionStep_mm), json_number(kNormalStep), json_number(kDepthStep_um),
      json_number(s.max_depth_um), s.view.resampled, s.view.i.size(), s.mesh_triangles, s.map.polar,
      json_number(s.map.u_first), json_number(s.map.u_step), s.map.u_count, json_number(s.map.v_first),
      json_number(s.map.v_step), s.map.v_count);
}

std::string band_json(const std::optional<Band>& band, double scale) {
  return band ? fmt::format("[{},{}]", json_number(scale * band->low), json_number(scale * band->high))
              : "null";
}

/// What the script has to know beside the tables.
std::string facts_json(const RunFolder& run, const std::string& wear_map, bool contours_thinned,
                       bool profiles_thinned, bool force_thinned) {
  const Measurement& lab = run.manifest.measurement;
  const std::string volume = lab.wear_volume_mm3
                                 ? fmt::format("[{},{}]", json_number(lab.wear_volume_mm3->mean),
                                               json_number(lab.wear_volume_mm3->sd))
                                 : "null";
  return fmt::format(
      R"({{"counted":{},"measured":{{"volume_mm3":{},"depth_um":{},"width_mm":{}}},"surface":{},"surface_note":{},"wear_map":{},)"
      R"("thinned":{{"contours":{},"profiles":{},"force":{}}}}})",
      json_string(run.manifest.counted), volume, band_json(lab.depth_mm, 1e3), band_json(lab.width_mm, 1.0),
      surface_json(run), json_string(run.surface_note), wear_map, contours_thinned, profiles_thinned,
      force_thinned);
}

std::string data_blocks(const RunFolder& run, const std::string& wear_map) {
  const Table contours = thin_revolutions(run.contours, kMaxContourRows);
  const Table profiles = thin_revolutions(run.profiles, kMaxProfileRows);
  const Table force = thin_rows(run.force, kMaxForceRows);
  std::string out =
      data_block("facts", facts_json(run, wear_map, contours.rows() < run.contours.rows(),
                                     profiles.rows() < run.profiles.rows(), force.rows() < run.force.rows()));
  out += data_block("revolutions", to_csv(run.revolutions)) + data_block("contours", to_csv(contours));
  out += data_block("profiles", to_csv(profiles)) + data_block("force", to_csv(force));
  if (run.surface) out += surface_blocks(*run.surface);
  return out;
}

/// Mean distance from the axis of the deepest points of the last output's sections.
double track_radius_mm(const RunFolder& run) {
  const std::vector<double>&n = run.profiles["revolution"], &radius = run.profiles["radius_mm"],
        &height = run.profiles["height_mm"], &angle = run.profiles["angle_deg"];
  double sum = 0.0, deepest = 0.0, at = 0.0;
  int sections = 0;
  for (std::size_t r = 0; r < n.size(); ++r) {
    if (n[r] != n.back()) continue;
    if (height[r] < deepest) deepest = height[r], at = radius[r];
    if (r + 1 == n.size() || angle[r + 1] != angle[r]) {
      if (deepest < 0.0) sum += at, ++sections;
      deepest = 0.0;
    }
  }
  return sections > 0 ? sum / sections : std::numeric_limits<double>::quiet_NaN();
}

/// The sections that are made as those of other pages are.
std::vector<PageSection> numbered_sections(const RunFolder& run) {
  std::vector<PageSection> sections;
  if (std::optional<PageSection> map = wear_map_section(run)) sections.push_back(std::move(*map));
  if (std::optional<PageSection> particles = particles_section(run))
    sections.push_back(std::move(*particles));
  if (std::optional<PageSection> walls = walls_section(run)) sections.push_back(std::move(*walls));
  if (!run.has_groove()) return sections;
  if (std::optional<PageSection> pin = pin_and_ridges_section(run)) sections.push_back(std::move(*pin));
  GrooveSeries series = groove_series(run.contours);
  series.counted = run.manifest.counted;
  if (series.counted == "revolution")
    series.track_radius_mm = track_radius_mm(run);
  else
    series.ends = analysis::Ends::open;
  if (series.revolutions == run.revolutions["revolution"]) {
    series.grown.push_back({"swept volume", "mm³", run.revolutions["swept_volume_mm3"]});
    series.grown.push_back({"volume by eq. 10-12", "mm³", run.revolutions["paper_volume_mm3"]});
  }
  sections.push_back(statistics_section(series));
  return sections;
}

constexpr int kGrooveFigures = 7;  ///< of groove.html, whose numbers go on from three

/// The worn surface and the volume, where there are any.   @param figures counts them
std::string worn_html(const RunFolder& run, int& figures) {
  const bool groove = run.has_groove();
  const auto next = [&] { return std::to_string(++figures); };
  std::string out;
  if (groove || run.surface) {
    const std::string surface = next(), map = next();
    out += fill(surface_figures(), {{"surface_number", surface},
                                    {"map_number", map},
                                    {"whole", groove ? "whole track" : "whole wall"},
                                    {"close", groove ? "close-up of the groove" : "close-up"}});
  }
  if (groove || run.manifest.ledger.law_volume_mm3 > 0.0)
    out += fill(volume_figure(), {{"volume_number", next()}});
  return out;
}

std::string page_of(const RunFolder& run, const std::vector<PageSection>& sections) {
  const bool groove = run.has_groove();
  int figures = 0;
  const std::string worn = worn_html(run, figures);
  if (groove) figures += kGrooveFigures;
  const WearMapFigure map = wear_map_figure(run, figures + 1);
  if (!map.html.empty()) ++figures;
  const SectionParts numbers = section_parts(sections, figures, 0);
  const std::string script = std::string(run_script()) + std::string(figures_script());
  return shell({.kicker = "Abradem wear report",
                .title = page_title(run),
                .lead = verdict(run),
                .body = fill(run_body(), {{"cards", verdict_cards(run)},
                                          {"worn", worn},
                                          {"groove", std::string(groove ? groove_figures() : "") + map.html},
                                          {"numbered", numbers.html},
                                          {"ledger", ledger_table(run)},
                                          {"limits", limits_and_warnings(run)},
                                          {"inputs", inputs(run)},
                                          {"record", record_table(run)}}),
                .data = data_blocks(run, map.facts) + map.data + numbers.data,
                .script = script});
}

}  // namespace

std::string make_page(const RunFolder& run) { return page_of(run, numbered_sections(run)); }

std::filesystem::path write_report(const std::filesystem::path& run_folder) {
  std::filesystem::path page = run_folder / "report.html";
  const RunFolder run = read_run_folder(run_folder);
  const std::vector<PageSection> sections = numbered_sections(run);
  write_section_tables(run_folder, sections);
  io::write_file_atomically(page, page_of(run, sections));
  return page;
}

}  // namespace abradem::report
