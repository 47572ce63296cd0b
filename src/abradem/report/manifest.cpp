// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/report/manifest.h"

#include <fmt/core.h>

#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "abradem/core/error.h"

namespace abradem::report {
namespace {

using nlohmann::ordered_json;

/// One object of the file, and the words for pointing at it.
struct Place {
  const ordered_json& object;
  std::string file, path;

  [[noreturn]] void fail(const std::string& key, const std::string& what) const {
    throw IoError(
        fmt::format("{}: key '{}{}' {}; the file is not a complete record of a run", file, path, key, what));
  }
  [[nodiscard]] const ordered_json& at(const std::string& key) const {
    const auto found = object.find(key);
    if (found == object.end()) fail(key, "is missing");
    return *found;
  }
  [[nodiscard]] Place inside(const std::string& key) const {
    const ordered_json& value = at(key);
    if (!value.is_object()) fail(key, fmt::format("is a {}, expected an object", value.type_name()));
    return {value, file, path + key + "."};
  }
  [[nodiscard]] std::string text(const std::string& key) const {
    const ordered_json& value = at(key);
    if (!value.is_string()) fail(key, fmt::format("is a {}, expected a string", value.type_name()));
    return value.get<std::string>();
  }
  /// JSON has no NaN; writers put null.
  [[nodiscard]] double number(const std::string& key) const {
    const ordered_json& value = at(key);
    if (value.is_null()) return std::numeric_limits<double>::quiet_NaN();
    if (!value.is_number()) fail(key, fmt::format("is a {}, expected a number", value.type_name()));
    return value.get<double>();
  }
  template <class Integer>
  [[nodiscard]] Integer integer(const std::string& key) const {
    const ordered_json& value = at(key);
    if (!value.is_number_integer())
      fail(key, fmt::format("is {}, expected a whole number", value.dump().substr(0, 40)));
    return value.get<Integer>();
  }
};

std::string as_text(const ordered_json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return fmt::format("{:.6g}", value.get<double>());
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_null()) return "–";
  return value.dump();
}

LedgerSummary read_ledger(const Place& place) {
  return {place.number("law_volume_mm3"), place.number("deposited_volume_mm3"),
          place.number("swept_volume_mm3"), place.number("residual_relative"), place.number("kappa")};
}

std::optional<Band> read_band(const Place& place, const std::string& key) {
  if (!place.object.contains(key)) return std::nullopt;
  const Place band = place.inside(key);
  return Band{band.number("low"), band.number("high")};
}

Measurement read_measurement(const Place& place) {
  Measurement out;
  if (place.object.contains("wear_volume_mm3")) {
    const Place volume = place.inside("wear_volume_mm3");
    out.wear_volume_mm3 = MeanSd{volume.number("mean"), volume.number("sd")};
  }
  out.depth_mm = read_band(place, "depth_mm");
  out.width_mm = read_band(place, "width_mm");
  if (place.object.contains("revolutions")) out.revolutions = place.number("revolutions");
  return out;
}

void read_optional(const Place& place, Manifest& out) {
  const ordered_json& json = place.object;
  if (json.contains("counted")) out.counted = place.text("counted");
  if (json.contains("settle_s")) out.settle_s = place.number("settle_s");
  if (json.contains("inputs_hash")) out.inputs_hash = place.text("inputs_hash");
  if (json.contains("error")) out.error = place.text("error");
  if (json.contains("case_title")) out.case_title = place.text("case_title");
  if (json.contains("limits") && json["limits"].is_array()) {
    for (const ordered_json& limit : json["limits"]) {
      const Place row{limit, place.file, "limits."};
      const auto ok = limit.find("ok");
      out.limits.push_back({row.text("name"), as_text(row.at("value")), as_text(row.at("limit")),
                            ok == limit.end() || !ok->is_boolean() || ok->get<bool>()});
    }
  }
  if (json.contains("warnings") && json["warnings"].is_array()) {
    for (const ordered_json& warning : json["warnings"]) out.warnings.push_back(as_text(warning));
  }
  if (json.contains("walls") && json["walls"].is_array())
    for (const ordered_json& wall : json["walls"]) {
      const Place entry{wall, place.file, "walls."};
      out.walls.push_back(entry.text("name"));
      out.thickness_mm.push_back(wall.contains("thickness_mm") ? std::optional(entry.number("thickness_mm"))
                                                               : std::nullopt);
    }
  if (json.contains("setup") && json["setup"].is_object()) {
    for (const auto& [name, value] : json["setup"].items()) out.setup.emplace_back(name, as_text(value));
  }
  if (json.contains("measurement") && json["measurement"].is_object()) {
    out.measurement = read_measurement(place.inside("measurement"));
  }
}

ordered_json parse(const std::filesystem::path& file) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(file, code)) {
    throw IoError(fmt::format("{}: no such file; is '{}' the output folder of a run?", file.string(),
                              file.parent_path().string()));
  }
  std::ifstream stream(file);
  try {
    ordered_json json = ordered_json::parse(stream);
    if (!json.is_object())
      throw IoError(fmt::format("{}: a {}, expected an object", file.string(), json.type_name()));
    return json;
  } catch (const ordered_json::parse_error& error) {
    throw IoError(fmt::format("{}: not valid JSON at byte {}; was the run cut off while writing?",
                              file.string(), error.byte));
  }
}

}  // namespace

Manifest read_manifest(const std::filesystem::path& file) {
  const ordered_json json = parse(file);
  const Place place{json, file.string(), ""};
  Manifest out;
  out.status = place.text("status");
  if (out.status != "running" && out.status != "completed" && out.status != "interrupted" &&
      out.status != "failed") {
    place.fail("status",
               fmt::format("is '{}', expected running, completed, interrupted or failed", out.status));
  }
  if (out.status != "running") out.exit_code = place.integer<int>("exit_code");
  out.version = place.text("version");
  out.commit = place.text("commit");
  out.compiler = place.text("compiler");
  out.state_hash = as_text(place.at("state_hash"));
  out.threads = place.integer<std::int64_t>("threads");
  out.steps = place.integer<std::int64_t>("steps");
  out.seed = place.integer<std::uint64_t>("seed");
  out.wall_seconds = place.number("wall_seconds");
  out.steps_per_second = place.number("steps_per_second");
  out.ledger = read_ledger(place.inside("ledger"));
  const Place results = place.inside("results");
  for (const auto& [name, value] : results.object.items())
    out.results.emplace_back(name, results.number(name));
  read_optional(place, out);
  return out;
}

}  // namespace abradem::report
