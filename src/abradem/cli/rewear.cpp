// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <optional>
#include <string_view>
#include <tuple>

#include "abradem/cli/commands.h"
#include "abradem/cli/print.h"
#include "abradem/core/error.h"
#include "abradem/core/suggest.h"
#include "abradem/io/atomic_file.h"
#include "abradem/io/case_file.h"
#include "abradem/io/rewear_tables.h"
#include "abradem/report/rewear_page.h"
#include "abradem/simulation/pair_laws.h"

namespace abradem::cli {
namespace {

namespace fs = std::filesystem;
using namespace std::string_view_literals;
using simulation::Setup;
using simulation::WearLaw;
using simulation::WearSetup;

constexpr auto& kLaws = wear::kMechanismNames;  // in the order of WearLaw

std::string pair_of(const WearSetup& w) { return w.abrader + "/" + w.worn; }

std::vector<WearLaw> laws_named(std::string_view text) {
  std::vector<WearLaw> laws;
  while (true) {
    const std::string_view word = text.substr(0, text.find(','));
    const auto found = std::ranges::find(kLaws, word);
    if (found == kLaws.end()) {
      const std::string nearest = core::nearest_spelling(
          std::string(word), std::vector<std::string_view>(kLaws.begin(), kLaws.end()));
      throw InputError(fmt::format("--law: no law '{}'; {}", word,
                                   nearest.empty() ? fmt::format("use {}", fmt::join(kLaws, ", "))
                                                   : fmt::format("did you mean '{}'?", nearest)));
    }
    const auto law = static_cast<WearLaw>(found - kLaws.begin());
    if (std::ranges::find(laws, law) == laws.end()) laws.push_back(law);
    if (word.size() == text.size()) return laws;
    text.remove_prefix(word.size() + 1);
  }
}

std::string read_text(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
    throw IoError(fmt::format("{}: no such file; expected the output folder of a run", file.string()));
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// A law without a number of its own wears nothing: it is asked for. What a pair had before is kept.
void check_coefficients(const WearSetup& w) {
  const auto has = [&](WearLaw law) { return std::ranges::find(w.laws, law) != w.laws.end(); };
  const auto ask = [&](const char* key, const char* example) {
    throw InputError(fmt::format("wear \"{0}\": the run has no {1} for it; add --set 'wear.\"{0}\".{1}={2}'",
                                 pair_of(w), key, example));
  };
  if (has(WearLaw::archard) && w.wear_coefficient == 0.0) ask("wear_coefficient", "1e-12 1/Pa");
  if (has(WearLaw::shear_work) && w.shear_work_coefficient == 0.0)
    ask("shear_work_coefficient", "0.001 mm^3/J");
  if (has(WearLaw::finnie) && w.finnie_coefficient == 0.0) ask("finnie_coefficient", "1e-11 1/Pa");
  if (has(WearLaw::impact_energy) && w.normal_energy_coefficient == 0.0 && w.shear_energy_coefficient == 0.0)
    ask("normal_energy_coefficient", "0.001 mm^3/J");
}

/// The case of the run with other laws.
Setup changed(const Setup& before, const RewearArguments& a, const fs::path& file) {
  for (const std::string& override : a.overrides)
    if (!override.starts_with("wear."))
      throw InputError(
          fmt::format("--set {}: rewear can change keys of [wear] alone; for another case run "
                      "it again",
                      override));
  Setup setup = before;
  if (!a.pair.empty() && std::ranges::find(setup.wear, a.pair, pair_of) == setup.wear.end())
    throw InputError(fmt::format("--pair {}: the case has no such [wear] pair", a.pair));
  if (!a.pair.empty() && a.law.empty()) throw InputError("--pair says which pair --law is for; give --law");
  if (!a.law.empty())
    for (WearSetup& w : setup.wear)
      if (a.pair.empty() || pair_of(w) == a.pair) {
        w.laws = laws_named(a.law);
        const bool given = std::ranges::any_of(
            a.overrides, [](const std::string& o) { return o.find(".expression") != std::string::npos; });
        if (std::ranges::find(w.laws, WearLaw::expression) != w.laws.end() && w.expression.empty() && !given)
          throw InputError(fmt::format(
              "wear \"{0}\": the run has no expression for it; add --set 'wear.\"{0}\".expression=k * "
              "Fn * slip' and its constants",
              pair_of(w)));
      }
  Setup after = io::parse_case(io::resolved_case(setup), file.string(), file.parent_path(), a.overrides,
                               io::NamedFiles::kept)
                    .setup;
  for (const WearSetup& w : after.wear) check_coefficients(w);
  Setup same = after;
  same.wear = before.wear;
  const auto how_run = [](const Setup& s) {
    std::vector<std::tuple<std::string, double, std::optional<double>>> pairs;
    for (const WearSetup& w : s.wear) pairs.emplace_back(pair_of(w), w.acceleration.factor, w.tolerance);
    return pairs;
  };
  if (same != before || how_run(after) != how_run(before))
    throw InputError("rewear can change the laws of [wear] and their coefficients, nothing else");
  return after;
}

bool free_name(const fs::path& folder, const std::string& name) {
  std::error_code code;
  return !fs::exists(folder / fmt::format("rewear_{}.html", name), code) &&
         !fs::exists(folder / "tables" / fmt::format("rewear_{}.csv", name), code);
}

std::string chosen_name(const fs::path& folder, const std::string& asked) {
  if (asked.empty()) {
    int n = 1;
    while (!free_name(folder, std::to_string(n))) ++n;
    return std::to_string(n);
  }
  if (!std::ranges::all_of(asked, [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
               c == '-';
      }))
    throw InputError(fmt::format("--name {}: use letters, digits, _ and -", asked));
  if (!free_name(folder, asked))
    throw InputError(fmt::format("'{}' already has a rewear_{}; use another --name", folder.string(), asked));
  return asked;
}

/// Radius of the spheres of a material where all have the same; else 0.
double only_radius(const Setup& setup, const std::string& material) {
  std::vector<double> radii;
  for (const simulation::ParticleSetup& p : setup.particles)
    if (p.material == material) radii.push_back(p.shape.empty() ? p.radius : 0.0);
  for (const simulation::InsertionSetup& i : setup.insertions) {
    if (i.material != material) continue;
    const bool single = i.size.kind == simulation::SizeKind::single && i.shape.empty() &&
                        !simulation::gives_places(i.volume.shape);
    radii.push_back(single ? i.size.radius : 0.0);
  }
  return !radii.empty() && std::ranges::all_of(radii, [&](double r) { return r == radii[0]; }) ? radii[0]
                                                                                               : 0.0;
}

/// Can another expression be worked out from classes of contacts?
void check_expression(const Setup& setup, const WearSetup& w, analysis::LawChange& change) {
  using wear::Symbol;
  const auto &was = change.before.expression, &is = change.after.expression;
  if (!is || is->by_impact() || (was && is->same_as(*was)) || analysis::linear_expression(*is)) return;
  const auto refuse = [&](const char* why) {
    throw InputError(
        fmt::format("wear \"{}\": the record of the run cannot tell what this expression wears: {}. Run "
                    "the case with it",
                    pair_of(w), why));
  };
  if (!is->proportional_to_step()) refuse("its volume depends on the time step");
  if (is->names(Symbol::dt) && !analysis::wears_by_sliding_alone(*is))
    refuse("contacts that do not slide are in no class, and dt counts there too; the way slid is slip");
  if (is->names(Symbol::normal_work))
    refuse(
        "classes of contacts have no normal_work; times a constant, and added to Fn * slip and shear_work "
        "times "
        "others, it would be found exactly");
  const bool sized =
      std::ranges::any_of(std::array{Symbol::a, Symbol::p_mean, Symbol::p_max, Symbol::m, Symbol::R},
                          [&](Symbol s) { return is->names(s); });
  change.radius = only_radius(setup, w.abrader);
  if (sized && change.radius == 0.0)
    refuse(
        "a, p_mean, p_max, m and R want spheres of one size, and classes of contacts do not tell sizes "
        "apart");
  const auto material = std::ranges::find(setup.materials, w.abrader, &simulation::MaterialSetup::name);
  change.mass = material->density * 4.0 / 3.0 * std::numbers::pi * std::pow(change.radius, 3);
}

std::vector<analysis::LawChange> changes_of(const Setup& before, const Setup& after) {
  const auto index = [&](const std::string& material) {
    return static_cast<int>(std::ranges::find(before.materials, material, &simulation::MaterialSetup::name) -
                            before.materials.begin());
  };
  std::vector<analysis::LawChange> changes;
  for (std::size_t w = 0; w < before.walls.size(); ++w)
    for (std::size_t k = 0; k < before.wear.size(); ++k)
      if (before.wear[k].worn == before.walls[w].material) {
        changes.push_back({static_cast<int>(w), index(before.wear[k].abrader),
                           simulation::laws_of(before, before.wear[k], 1.0),
                           simulation::laws_of(after, after.wear[k], 1.0)});
        check_expression(after, after.wear[k], changes.back());
      }
  return changes;
}

std::string assumptions_of(const Setup& after) {
  std::string text;
  for (const WearSetup& w : after.wear) {
    std::vector<std::string> laws;
    for (const WearLaw law : w.laws) laws.emplace_back(kLaws[static_cast<std::size_t>(law)]);
    text += fmt::format("{}{} wears {} by {}", text.empty() ? "" : "; ", w.abrader, w.worn,
                        fmt::join(laws, " + "));
  }
  return text + ".";
}

void check_numbers(const analysis::Recorded& recorded, const report::RewearSummary& s,
                   const fs::path& tables) {
  const auto fits = [&](int wall, int region) {
    return static_cast<std::size_t>(wall) < s.walls.size() &&
           static_cast<std::size_t>(region) < s.walls[static_cast<std::size_t>(wall)].regions.size();
  };
  for (const auto& e : recorded.elements)
    if (!fits(e.wall, e.region) || !(e.area > 0.0))
      throw IoError(fmt::format("{}: element {} is of no wall or region of this case",
                                (tables / "wear_integrals.csv").string(), e.element));
  for (const auto& i : recorded.impacts)
    if (!fits(i.wall, i.region) || !(i.mean.mass > 0.0))
      throw IoError(fmt::format("{}: a class of impacts is of no wall or region of this case",
                                (tables / "impact_spectrum.csv").string()));
  for (const auto& c : recorded.sliding)
    if (!fits(c.wall, c.region))
      throw IoError(fmt::format("{}: a class of contacts is of no wall or region of this case",
                                (tables / "sliding_spectrum.csv").string()));
}

}  // namespace

int rewear_command(const RewearArguments& arguments) {
  const fs::path folder = arguments.folder, tables = folder / "tables", file = folder / "case.resolved.toml";
  if (std::error_code code; !fs::is_directory(folder, code))
    throw IoError(fmt::format("{}: no such folder; expected the output folder of a run", folder.string()));
  const Setup before = io::parse_case(read_text(file), file.string(), folder, {}, io::NamedFiles::kept).setup;
  const Setup after = changed(before, arguments, file);
  const analysis::Recorded recorded = io::read_recorded_wear(tables);

  report::RewearSummary summary;
  summary.name = chosen_name(folder, arguments.name);
  summary.title = before.title;
  summary.assumptions = assumptions_of(after);
  for (const simulation::WallSetup& wall : before.walls) {
    report::RewearSummary::Wall& w = summary.walls.emplace_back();
    w.name = wall.name;
    for (const simulation::RegionSetup& region : before.regions)
      if (region.wall == wall.name) w.regions.push_back(region.name);
    w.regions.push_back(wall.name);
  }
  check_numbers(recorded, summary, tables);
  const auto unchanged = changes_of(before, before);
  for (const analysis::RewornRegion& r : analysis::rewear(recorded, unchanged).regions)
    summary.walls[static_cast<std::size_t>(r.wall)].before += wear::total(r.volumes);
  summary.reworn = analysis::rewear(recorded, changes_of(before, after));

  const std::string stem = "rewear_" + summary.name;
  io::write_reworn_elements(tables / (stem + ".csv"), summary.reworn);
  io::write_reworn_regions(tables / (stem + "_regions.csv"), summary.reworn);
  io::write_file_atomically(folder / (stem + ".case.toml"), io::resolved_case(after));
  const fs::path page = folder / (stem + ".html");
  const report::Page content = report::rewear_page(summary);
  report::write_section_tables(folder, content.sections);
  io::write_file_atomically(page, report::page_html(content));
  if (!arguments.quiet) print_message(fmt::format("page: {}", page.string()));
  print_result(arguments.json ? report::rewear_json(summary) : report::rewear_text(summary));
  return static_cast<int>(ExitCode::ok);
}

}  // namespace abradem::cli
