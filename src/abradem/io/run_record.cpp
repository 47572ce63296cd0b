// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/run_record.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "abradem/core/hash.h"
#include "abradem/core/version.h"
#include "abradem/io/case_file.h"
#include "abradem/io/run_particles.h"
#include "abradem/io/wear_tables.h"
#include "abradem/simulation/wall_motion.h"

namespace abradem::io {

namespace {

using Json = nlohmann::ordered_json;

constexpr double kMm = 1e3, kMm3 = 1e9;

/// What does not exist is null: JSON has no not-a-number.
Json number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json ledger_json(const simulation::Ledger& ledger) {
  Json json = {{"law_volume_mm3", number(kMm3 * ledger.law)},
               {"deposited_volume_mm3", number(kMm3 * ledger.deposited)},
               {"swept_volume_mm3", number(kMm3 * ledger.swept)},
               {"residual_relative", number(ledger.residual)},
               {"kappa", number(ledger.kappa)}};
  if (ledger.planes > 0.0) json["planes_law_volume_mm3"] = number(kMm3 * ledger.planes);
  if (ledger.displaced > 0.0)
    json["ploughing"] = {{"groove_volume_mm3", number(kMm3 * (ledger.law + ledger.displaced))},
                         {"removed_volume_mm3", number(kMm3 * ledger.law)},
                         {"displaced_volume_mm3", number(kMm3 * ledger.displaced)},
                         {"piled_volume_mm3", number(kMm3 * ledger.piled)},
                         {"unpiled_volume_mm3", number(kMm3 * ledger.unpiled)}};
  if (ledger.tip_law > 0.0)
    json["pin"] = {{"law_volume_mm3", number(kMm3 * ledger.tip_law)},
                   {"deposited_volume_mm3", number(kMm3 * ledger.tip_deposited)},
                   {"removed_volume_mm3", number(kMm3 * ledger.tip_removed)},
                   {"residual_relative", number(ledger.tip_residual)}};
  return json;
}

/// Totals by law: of every wall, and of all.
Json laws_json(const wear::MechanismVolumes& v) {
  Json json = Json::object();
  for (std::size_t m = 0; m < v.size(); ++m)
    json[std::string(wear::kMechanismNames[m]) + "_mm3"] = number(kMm3 * v[m]);
  return json;
}

Json walls_json(const std::vector<RunRecord::Wall>& walls) {
  Json json = Json::array();
  for (const RunRecord::Wall& wall : walls) {
    Json entry{{"name", wall.name}};
    if (wall.by_laws) entry.update({{"law_volume", laws_json(wall.law)}, {"impacts", wall.impacts}});
    if (wall.thickness) entry["thickness_mm"] = number(kMm * *wall.thickness);
    json.push_back(std::move(entry));
  }
  return json;
}

Json results_json(const RunRecord& record) {
  Json results = Json::object();
  if (!record.last) return results;
  const auto& names = revolution_columns();
  const auto values = revolution_values(*record.last);
  for (std::size_t i = 0; i < names.size(); ++i) results[names[i]] = number(values[i]);
  return results;
}

Json measurement_json(const simulation::MeasurementSetup& m) {
  Json json = Json::object();
  if (m.wear_volume)
    json["wear_volume_mm3"] = {{"mean", kMm3 * m.wear_volume->mean}, {"sd", kMm3 * m.wear_volume->sd}};
  if (m.depth) json["depth_mm"] = {{"low", kMm * m.depth->low}, {"high", kMm * m.depth->high}};
  if (m.width) json["width_mm"] = {{"low", kMm * m.width->low}, {"high", kMm * m.width->high}};
  if (m.revolutions) json["revolutions"] = *m.revolutions;
  return json;
}

void add_bytes(core::StateHash& hash, std::string_view bytes) {
  for (std::size_t at = 0; at < bytes.size(); at += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + at, std::min(sizeof word, bytes.size() - at));
    hash.add(word);
  }
  hash.add(static_cast<std::uint64_t>(bytes.size()));
}

void add_file(core::StateHash& hash, const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, 1 << 16> block;
  do {
    file.read(block.data(), block.size());
    add_bytes(hash, {block.data(), static_cast<std::size_t>(file.gcount())});
  } while (file);
}

double acceleration_of(const simulation::Setup& setup) {
  return setup.wear.empty() ? 1.0 : setup.wear.front().acceleration.factor;
}

/// Number of revolutions or seconds modelled for those of the test, and how it was chosen.
Json acceleration_json(const RunRecord& record, double factor) {
  Json json = {{"factor", factor}};
  if (record.acceleration) {
    const study::AccelerationChoice& choice = *record.acceleration;
    json["chosen"] = "auto";
    json[choice.in_revolutions ? "modelled_revolutions" : "modelled_s"] = choice.modelled;
    json["tolerance"] = choice.tolerance;
    json[choice.by_maps ? "map_error" : "profile_error"] = choice.error;
    json["trials"] = Json::array();
    for (const study::AccelerationTrial& trial : choice.trials) {
      Json entry = {{choice.in_revolutions ? "revolutions" : "modelled_s", trial.modelled},
                    {"difference", trial.difference ? number(*trial.difference) : Json(nullptr)}};
      if (choice.by_maps && trial.difference)
        entry.update({{"volume_difference", number(trial.volume_difference)},
                      {"noise", number(trial.noise)},
                      {"limited_by", trial.noise_limits() ? "noise" : "steps"}});
      if (!trial.failure.empty()) entry["failure"] = trial.failure;
      json["trials"].push_back(std::move(entry));
    }
  }
  return json;
}

/// What the report shows of it.
std::string acceleration_text(const RunRecord& record, const simulation::Setup& setup, double factor) {
  std::string text = fmt::format("{:.4g} {} of the test per modelled one", factor,
                                 simulation::period_of(setup.walls) > 0.0 ? "revolutions" : "seconds");
  if (record.acceleration) {
    const study::AccelerationChoice& choice = *record.acceleration;
    text += fmt::format("; chosen: half as many change the {} by {:.2g} %, tolerance {:.2g} %",
                        choice.by_maps ? "map of depths" : "profile", 100.0 * choice.error,
                        100.0 * choice.tolerance);
    if (choice.by_maps && choice.error > 0.0)
      text += fmt::format(", the volume by {:.2g} %; {}", 100.0 * choice.trials.back().volume_difference,
                          study::what_limits(choice.trials.back()));
  }
  return text;
}

}  // namespace

std::string shape_text(const simulation::ShapeSetup& shape) {
  const double R = simulation::clump_shape(shape).radius;
  const double volume = 4.0 / 3.0 * std::numbers::pi * R * R * R;
  if (!shape.fit)
    return fmt::format("{} spheres, {:.4g} mm^3, as a sphere of {:.4g} mm radius", shape.spheres.size(),
                       1e9 * volume, 1e3 * R);
  const geometry::SphereFit& fit = shape.fit->fit;
  return fmt::format(
      "{} spheres for a solid of {:.4g} mm^3, as a sphere of {:.4g} mm radius; their union's volume differs "
      "by "
      "{:.2g} %, they leave the surface bare by at most {:.3g} mm and reach out of it by {:.3g} mm",
      fit.balls.size(), 1e9 * volume, 1e3 * R, 100.0 * fit.volume_error, 1e3 * fit.deepest,
      1e3 * fit.furthest);
}

std::uint64_t inputs_hash(const simulation::Setup& setup) {
  core::StateHash hash;
  add_bytes(hash, resolved_case(setup));
  for (const simulation::WallSetup& wall : setup.walls)
    if (wall.mesh.shape == simulation::MeshShape::file) add_file(hash, wall.mesh.file);
  for (const simulation::WallSetup& wall : setup.walls)
    for (std::size_t k = 0; k < wall.motions(); ++k)
      if (const std::string& file = wall.motion_at(k).file; !file.empty()) add_file(hash, file);
  for (const simulation::InsertionSetup& insertion : setup.insertions)
    for (const std::string& file : {insertion.size.file, insertion.volume.file})
      if (!file.empty()) add_file(hash, file);
  for (const simulation::InsertionSetup& insertion : setup.insertions)
    if (insertion.volume.shape == simulation::VolumeShape::run && why_no_run(insertion.volume.run).empty())
      for (const std::filesystem::path& file : frame_files(insertion.volume)) add_file(hash, file.string());
  for (const simulation::ShapeSetup& shape : setup.shapes)
    if (shape.fit) add_file(hash, shape.fit->file);
  return hash.value();
}

void record_walls(RunRecord& record, const simulation::Simulation& run) {
  record.walls.clear();
  for (std::size_t w = 0; w < run.walls().size(); ++w)
    record.walls.push_back({run.walls()[w].setup().name, run.wears_by_laws(), run.law_volumes(w),
                            static_cast<std::uint64_t>(std::llround(
                                run.acceleration() * static_cast<double>(run.impacts_on(w).count()))),
                            run.walls()[w].setup().thickness});
}

std::string counted(const simulation::Setup& setup) {
  for (const simulation::WallSetup& wall : setup.walls)
    if (const simulation::MotionSetup* m = simulation::cyclic_motion(wall))
      return m->kind == simulation::MotionKind::rotation ? "revolution" : "cycle";
  return "output";
}

std::string to_json(const RunRecord& record, const simulation::Setup& setup) {
  Json json;
  json["status"] = record.status;
  json["exit_code"] = record.status == "running" ? Json(nullptr) : Json(record.exit_code);
  if (!record.error.empty()) json["error"] = record.error;
  json["case_title"] = setup.title;
  json["counted"] = counted(setup);
  json["version"] = core::version();
  json["commit"] = core::commit();
  json["compiler"] = fmt::format("{} {}", core::compiler(), core::compiler_flags());
  json["threads"] = record.threads;
  json["seed"] = setup.run.seed;
  json["steps"] = record.steps;
  json["wall_seconds"] = number(record.wall_seconds);
  json["steps_per_second"] = number(
      record.stepping_seconds > 0.0 ? static_cast<double>(record.steps) / record.stepping_seconds : 0.0);
  json["state_hash"] = fmt::format("{:016x}", record.state_hash);
  json["inputs_hash"] = fmt::format("{:016x}", record.inputs_hash);
  json["ledger"] = ledger_json(record.ledger);
  if (!record.walls.empty()) {
    wear::MechanismVolumes all{};
    for (const RunRecord::Wall& wall : record.walls)
      for (std::size_t m = 0; m < all.size(); ++m) all[m] += wall.law[m];
    if (std::ranges::any_of(record.walls, &RunRecord::Wall::by_laws))
      json["ledger"]["by_law"] = laws_json(all);
    json["walls"] = walls_json(record.walls);
  }
  json["results"] = results_json(record);
  Json limits = Json::array();
  for (const auto& limit : record.limits)
    limits.push_back(
        {{"name", limit.name}, {"value", number(limit.value)}, {"limit", limit.limit}, {"ok", limit.ok()}});
  json["limits"] = limits;
  json["warnings"] = record.warnings;
  json["checkpoint"] = record.checkpoint.empty()
                           ? Json(nullptr)
                           : Json{{"file", record.checkpoint}, {"steps", record.checkpoint_steps}};
  if (record.resumed > 0) json["resumed"] = record.resumed;
  if (const double factor = acceleration_of(setup); factor != 1.0 || record.acceleration) {
    json["acceleration"] = acceleration_json(record, factor);
    json["setup"]["Acceleration"] = acceleration_text(record, setup, factor);
  }
  if (setup.run.settle.value > 0.0) {
    const double settle = simulation::seconds_of(setup.run.settle, simulation::period_of(setup.walls));
    json["settle_s"] = settle;
    json["setup"]["Flow settles"] = fmt::format("nothing wears in the first {:.4g} s", settle);
  }
  for (const simulation::ShapeSetup& shape : setup.shapes)
    json["setup"][fmt::format("Shape '{}'", shape.name)] = shape_text(shape);
  if (setup.measurement) json["measurement"] = measurement_json(*setup.measurement);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace abradem::io
