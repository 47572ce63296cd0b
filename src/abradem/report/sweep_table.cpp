// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/report/sweep_table.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string_view>

#include "abradem/core/error.h"
#include "abradem/core/units.h"
#include "abradem/io/factor_text.h"
#include "abradem/io/wear_tables.h"
#include "abradem/report/manifest.h"
#include "abradem/report/particles_section.h"
#include "abradem/report/table.h"

namespace abradem::report {
namespace {

using namespace std::string_view_literals;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// As in the tables of the runs.
std::string number_text(double x) { return std::isfinite(x) ? fmt::format("{}", x) : "nan"; }

/// The number of one value in another's unit; nullopt where it is none or of another kind.
std::optional<double> in_unit(const io::NumberText& value, const std::string& unit) {
  if (value.unit == unit) return value.number;
  try {
    const core::Quantity given = core::parse_quantity(fmt::format("{} {}", value.number, value.unit));
    const core::Quantity one = core::parse_quantity(fmt::format("1 {}", unit));
    // 1 mm in um is 1000, not 1000.0000000000001.
    if (given.dimension == one.dimension) return std::stod(fmt::format("{:.12g}", given.value / one.value));
  } catch (const core::UnitError&) {
  }
  return std::nullopt;
}

/// Equal ratios, over more than a decade.
bool is_logarithmic(std::vector<double> values) {
  std::ranges::sort(values);
  const auto [first, last] = std::ranges::unique(values);
  values.erase(first, last);
  if (values.size() < 3 || values.front() <= 0.0 || values.back() < 10.0 * values.front()) return false;
  const double middle = values[values.size() / 2];
  const double linear = 0.5 * (values.front() + values.back());
  return middle < 0.5 * linear;
}

SweepColumn factor_column(const std::string& key, std::vector<std::string> values) {
  SweepColumn column{.title = key, .text = std::move(values), .number = {}};
  std::erase(column.title, '"');
  std::optional<std::string> unit;
  std::vector<double> numbers;
  for (const std::string& value : column.text) {
    std::string bare = value;
    std::erase(bare, '"');
    const auto read = io::read_number_text(bare);
    if (!read) return column;
    if (!unit) unit = read->unit;
    const auto number = in_unit(*read, *unit);
    if (!number) return column;
    numbers.push_back(*number);
  }
  if (unit && !unit->empty()) column.title += fmt::format(" [{}]", *unit);
  for (std::size_t i = 0; i < numbers.size(); ++i) column.text[i] = number_text(numbers[i]);
  column.logarithmic = is_logarithmic(numbers);
  column.number = std::move(numbers);
  return column;
}

/// What a table of runs has of particles in numbers: the last row of particles.csv, and the mean flow out.
constexpr std::array kOfParticles{
    "particles"sv, "mass_kg"sv,       "inserted"sv,         "removed"sv,          "removed_mass_kg"sv,
    "contacts"sv,  "wall_contacts"sv, "kinetic_energy_J"sv, "elastic_energy_J"sv, "fastest_m_per_s"sv};
constexpr auto kOutflow = "outflow_kg_per_s";

void add_particles(std::map<std::string, double>& results, const std::filesystem::path& file) {
  std::error_code code;
  if (!std::filesystem::exists(file, code)) return;
  const Table table = read_table(file, kOfParticles);
  if (table.rows() == 0) return;
  for (const std::string_view name : kOfParticles) results[std::string(name)] = table[name].back();
  if (const auto outflow = mean_outflow(table)) results[kOutflow] = outflow->rate;
}

/// Results of one run by column; empty where there are none.
std::map<std::string, double> results_of(const std::filesystem::path& folder) {
  try {
    const Manifest run = read_manifest(folder / "run.json");
    std::map<std::string, double> results(run.results.begin(), run.results.end());
    if (!results.empty()) results["kappa"] = run.ledger.kappa;
    results["steps"] = static_cast<double>(run.steps);
    add_particles(results, folder / "tables" / "particles.csv");
    return results;
  } catch (const IoError&) {
    return {};
  }
}

void add_field(std::string& line, const std::string& text) {
  line += ',';
  if (text.find_first_of(",\"\n\r") == std::string::npos) {
    line += text;
    return;
  }
  line += '"';
  for (const char c : text) {
    if (c == '"') line += '"';
    line += c;
  }
  line += '"';
}

}  // namespace

SweepTable make_sweep_table(const std::vector<std::string>& keys, const std::vector<SweepRun>& runs) {
  SweepTable table;
  std::vector<std::string> names = io::revolution_columns();
  names.insert(names.end(), {"kappa", "steps"});
  std::vector<std::map<std::string, double>> results;
  for (const SweepRun& run : runs) results.push_back(results_of(run.folder));
  if (std::ranges::any_of(results, [](const auto& of_run) { return of_run.contains("particles"); })) {
    names.insert(names.end(), kOfParticles.begin(), kOfParticles.end());
    names.emplace_back(kOutflow);
  }
  for (const std::string& name : names) table.results.push_back({.title = name, .text = {}, .number = {}});
  for (std::size_t r = 0; r < runs.size(); ++r) {
    table.names.push_back(runs[r].name);
    table.status.push_back(runs[r].status);
    table.messages.push_back(runs[r].message);
    for (SweepColumn& column : table.results) {
      const auto found = results[r].find(column.title);
      column.number.push_back(found == results[r].end() ? kNone : found->second);
      column.text.push_back(number_text(column.number.back()));
    }
  }
  for (std::size_t f = 0; f < keys.size(); ++f) {
    std::vector<std::string> values;
    for (const SweepRun& run : runs) values.push_back(run.values[f]);
    table.factors.push_back(factor_column(keys[f], std::move(values)));
  }
  return table;
}

std::string to_csv(const SweepTable& table) {
  std::vector<const SweepColumn*> columns;
  for (const SweepColumn& c : table.factors) columns.push_back(&c);
  for (const SweepColumn& c : table.results) columns.push_back(&c);
  std::string text = "name,status";
  for (const SweepColumn* c : columns) add_field(text, c->title);
  text += '\n';
  for (std::size_t r = 0; r < table.names.size(); ++r) {
    text += fmt::format("{},{}", table.names[r], table.status[r]);
    for (const SweepColumn* c : columns) add_field(text, c->text[r]);
    text += '\n';
  }
  return text;
}

}  // namespace abradem::report
