// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/case_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

#include "abradem/core/suggest.h"
#include "abradem/io/case_checker.h"
#include "abradem/io/case_motions.h"
#include "abradem/io/case_schema.h"
#include "abradem/simulation/wall_motion.h"

namespace abradem::io {

using namespace simulation;

std::string mm(double metres) { return fmt::format("{:.4g} mm", 1e3 * metres); }
std::string readable(double metres) {
  return std::abs(metres) < 1.0 ? mm(metres) : fmt::format("{:.4g} m", metres);
}

std::string path_of(std::string_view section, std::string_view name) {
  return fmt::format("{}.{}", section, toml_key(name));
}

void Checker::run() {
  for (const MaterialSetup& m : setup_.materials) materials_.insert(m.name);
  check_names();
  check_contact_pairs();
  check_wear_pairs();
  check_wear_laws();
  check_ploughing();
  check_regions();
  for (const WallSetup& wall : setup_.walls) check_wall(wall);
  for (const ParticleSetup& particle : setup_.particles) check_particle(particle);
  check_shapes();
  check_insertions();
  check_run();
  check_acceleration();
  check_measurement();
  check_published();
}

bool Checker::check_material(const std::string& name, const std::string& path) {
  if (materials_.contains(name)) return true;
  const std::vector<std::string_view> known(materials_.begin(), materials_.end());
  const std::string nearest = core::nearest_spelling(name, known);
  error(path, nearest.empty() ? fmt::format("no material '{}'; add [{}], or use one of: {}", name,
                                            path_of("material", name), fmt::join(known, ", "))
                              : fmt::format("no material '{}'; did you mean '{}'?", name, nearest));
  return false;
}

void Checker::check_names() {
  if (!good("material") && materials_.empty()) return;
  const auto check_pair = [&](std::string_view section, const std::string& a, const std::string& b) {
    const std::string path = path_of(section, a + "/" + b);
    check_material(a, path);
    if (b != a) check_material(b, path);
  };
  for (const ContactSetup& c : setup_.contacts) check_pair("contact", c.first, c.second);
  for (const WearSetup& w : setup_.wear) check_pair("wear", w.abrader, w.worn);
  const auto check_user = [&](const std::string& path, const std::string& material) {
    if (good(path)) check_material(material, path);
  };
  for (const WallSetup& w : setup_.walls) check_user(path_of("wall", w.name) + ".material", w.material);
  for (const ParticleSetup& p : setup_.particles)
    check_user(path_of("particle", p.name) + ".material", p.material);
  for (const InsertionSetup& i : setup_.insertions)
    check_user(path_of("insertion", i.name) + ".material", i.material);
}

bool Checker::has_contact(const std::string& a, const std::string& b) const {
  return std::ranges::any_of(setup_.contacts, [&](const ContactSetup& c) {
    return (c.first == a && c.second == b) || (c.first == b && c.second == a);
  });
}

void Checker::require_contact(const std::string& a, const std::string& b, const std::string& path,
                              const std::string& who) {
  if (!good("contact") || !materials_.contains(a) || !materials_.contains(b) || has_contact(a, b)) return;
  if (!reported_.insert({std::min(a, b), std::max(a, b)}).second) return;
  error(path, fmt::format("{} can touch, but the case has no contact pair for their materials; add [{}]", who,
                          path_of("contact", a + "/" + b)));
}

void Checker::check_contact_pairs() {
  for (std::size_t i = 0; i < setup_.contacts.size(); ++i) {
    const ContactSetup& c = setup_.contacts[i];
    for (std::size_t j = 0; j < i; ++j) {
      const ContactSetup& d = setup_.contacts[j];
      if (c.first == d.second && c.second == d.first)
        error(path_of("contact", c.first + "/" + c.second),
              fmt::format("this pair is already given as [{}]; the order of the names makes no difference",
                          path_of("contact", d.first + "/" + d.second)));
    }
    if (c.law == ContactLaw::linear && c.cohesion == Cohesion::jkr)
      error(path_of("contact", c.first + "/" + c.second) + ".cohesion",
            "jkr is the adhesion of Hertz's contact; with law = \"linear\" take sjkr");
  }
  const auto& particles = setup_.particles;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const ParticleSetup& p = particles[i];
    for (const WallSetup& w : setup_.walls)
      require_contact(p.material, w.material, path_of("wall", w.name) + ".material",
                      fmt::format("particle '{}' and wall '{}'", p.name, w.name));
    // Two pins in their holders never meet.
    for (std::size_t j = 0; j < i; ++j)
      if (p.guide == Guide::none || particles[j].guide == Guide::none)
        require_contact(particles[j].material, p.material, path_of("particle", p.name) + ".material",
                        fmt::format("particles '{}' and '{}'", particles[j].name, p.name));
  }
}

void Checker::check_run() {
  const bool turns = counts_revolutions(setup_) || !good("wall");
  constexpr std::string_view kNothingTurns =
      "revolutions cannot be counted: no wall has a motion of kind rotation or oscillation; give a time "
      "such as "
      "\"24 s\"";
  if (!turns && setup_.run.end.in_revolutions && good("run.end"))
    error("run.end", std::string(kNothingTurns));
  const Duration& settle = setup_.run.settle;
  if (!turns && settle.in_revolutions && good("run.settle")) error("run.settle", std::string(kNothingTurns));
  if (settle.value > 0.0 && settle.in_revolutions == setup_.run.end.in_revolutions && good("run.settle") &&
      good("run.end") && settle.value >= setup_.run.end.value)
    error("run.settle", "the flow settles before anything wears: must be before run.end");
  if (!turns && setup_.output.every.in_revolutions && places_.given("output.every") && good("output.every"))
    error("output.every", std::string(kNothingTurns));
  if (setup_.run.end.in_revolutions == setup_.output.every.in_revolutions && good("run.end") &&
      good("output") && setup_.output.every.value > setup_.run.end.value && places_.given("output.every"))
    note("output.every", "is longer than the run: only the start and the end will be written");
  if (setup_.run.increment && setup_.run.method == Method::dynamic && good("run.method"))
    note("run.increment", "counts only with method = \"quasi_static\"; a dynamic run takes time_step");
  if (setup_.run.method == Method::quasi_static) check_quasi_static();
}

void Checker::check_quasi_static() {
  if (!good("particle") || !good("wall")) return;
  for (const ParticleSetup& p : setup_.particles) {
    if (!p.shape.empty()) continue;
    const std::string path = path_of("particle", p.name);
    if (p.guide == Guide::none)
      error(path,
            fmt::format(
                "method = \"quasi_static\" balances the load of guided particles, and '{}' is free; set "
                "guide = \"vertical\", or run.method = \"dynamic\"",
                p.name));
    else if (!(p.load.z < 0.0))
      error(path + ".load",
            fmt::format("method = \"quasi_static\" needs a load that presses '{}' down, such as load = "
                        "\"5 N\"",
                        p.name));
  }
  if (std::ranges::all_of(setup_.walls,
                          [](const WallSetup& w) { return leading_motion(w).kind == MotionKind::none; }))
    error("run.method", "method = \"quasi_static\" steps along a sliding distance, but no wall moves");
}

void Checker::check_measurement() {
  if (!setup_.measurement) return;
  const auto check = [&](const std::optional<Range>& range, const std::string& path) {
    if (range && good(path) && range->low > range->high)
      error(path + ".low",
            fmt::format("the smallest value, {}, is above the largest, {}", mm(range->low), mm(range->high)));
  };
  check(setup_.measurement->depth, "measurement.depth");
  check(setup_.measurement->width, "measurement.width");
}

void Checker::check_published() {
  if (!setup_.study || !good("study")) return;
  const StudySetup& study = *setup_.study;
  if (study.page == StudyPage::paper && study.published.empty())
    error("study.page",
          "page = \"paper\" compares with published values: name their file, published = "
          "\"claims.json\"");
  std::error_code ignored;
  if (!study.published.empty() && !std::filesystem::is_regular_file(study.published, ignored))
    error("study.published", fmt::format("there is no file '{}' (relative names start at the folder of the "
                                         "case file)",
                                         study.published));
}

Place Places::of(std::string path) const {
  while (true) {
    if (const auto found = places_.find(path); found != places_.end()) return found->second;
    const std::size_t dot = path.rfind('.');
    if (dot == std::string::npos) return {};
    path.resize(dot);
  }
}

bool Places::good(const std::string& path) const {
  const auto found = wrong_.lower_bound(path);
  for (auto it = found; it != wrong_.end() && it->first.starts_with(path); ++it)
    if (it->first.size() == path.size() || it->first[path.size()] == '.' || it->first[path.size()] == '[')
      return false;
  return true;
}

void check_case(const Setup& setup, const Places& places, Problems& problems) {
  Checker(setup, places, problems).run();
  check_motions(setup, places, problems);
}

bool adheres(const Setup& setup, const WallSetup& wall) noexcept {
  const auto moves = [&](const std::string& material) {
    return std::ranges::find(setup.particles, material, &ParticleSetup::material) != setup.particles.end() ||
           std::ranges::find(setup.insertions, material, &InsertionSetup::material) != setup.insertions.end();
  };
  return std::ranges::any_of(setup.contacts, [&](const ContactSetup& c) {
    return c.cohesion == Cohesion::jkr &&
           ((c.first == wall.material && moves(c.second)) || (c.second == wall.material && moves(c.first)));
  });
}

bool counts_revolutions(const Setup& setup) noexcept {
  return std::ranges::any_of(setup.walls, [](const WallSetup& w) { return cyclic_motion(w) != nullptr; });
}

}  // namespace abradem::io
