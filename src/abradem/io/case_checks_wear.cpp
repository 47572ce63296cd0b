// SPDX-License-Identifier: BSD-3-Clause
// How things wear, and where that is counted.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "abradem/core/suggest.h"
#include "abradem/io/case_checker.h"
#include "abradem/simulation/pair_laws.h"

namespace abradem::io {

using namespace simulation;

void Checker::check_wear_pairs() {
  if (!good("wear")) return;
  bool deforms = false;
  for (const WallSetup& wall : setup_.walls) {
    if (wall.deformation == DeformationRule::none) continue;
    deforms = true;
    const std::string path = path_of("wall", wall.name);
    std::set<std::string> asked;
    std::vector<std::string> abraders;
    for (const ParticleSetup& p : setup_.particles) abraders.push_back(p.material);
    for (const InsertionSetup& i : setup_.insertions) abraders.push_back(i.material);
    for (const std::string& abrader : abraders) {
      if (!materials_.contains(abrader) || !materials_.contains(wall.material)) continue;
      const bool known = std::ranges::any_of(
          setup_.wear, [&](const WearSetup& w) { return w.abrader == abrader && w.worn == wall.material; });
      if (known || !asked.insert(abrader).second) continue;
      error(path + ".deformation",
            fmt::format(
                "wall '{}' changes its shape, but the case does not say how '{}' wears '{}'; add [{}] (with "
                "wear_coefficient = 0 for no wear), or set deformation = \"none\"",
                wall.name, abrader, wall.material, path_of("wear", abrader + "/" + wall.material)));
    }
  }
  if (!setup_.wear.empty() && !deforms && !setup_.walls.empty() && good("wall"))
    note("wear",
         "wear is counted, but no wall changes its shape; set deformation = \"conserving\" on the wall that "
         "wears");
}

/// What laws beside Archard's ask of the rest of the case.
void Checker::check_wear_laws() {
  if (!good("wear") || !good("material")) return;
  for (const WearSetup& w : setup_.wear) {
    const std::string path = path_of("wear", w.abrader + "/" + w.worn);
    const auto has = [&](WearLaw law) { return std::ranges::find(w.laws, law) != w.laws.end(); };
    if (w.laws == std::vector{WearLaw::archard}) continue;
    const auto worn = std::ranges::find(setup_.materials, w.worn, &MaterialSetup::name);
    if (has(WearLaw::oka) && worn != setup_.materials.end() && !worn->hardness)
      error(path + ".law",
            fmt::format("Oka's law needs the hardness of '{}': add hardness = \"143 HV\" to [{}]", w.worn,
                        path_of("material", w.worn)));
    if (has(WearLaw::impact_energy) && w.normal_energy_coefficient == 0.0 &&
        w.shear_energy_coefficient == 0.0)
      error(path + ".law",
            "impact_energy needs a normal_energy_coefficient or a shear_energy_coefficient above 0");
    if (setup_.run.method == Method::quasi_static && good("run.method") &&
        (has(WearLaw::finnie) || has(WearLaw::oka) || has(WearLaw::impact_energy)))
      error(path + ".law", "a balance of forces has no impacts: set run.method = \"dynamic\"");
    if (has(WearLaw::expression)) check_expression(w, path);
    if (setup_.ploughing && setup_.ploughing->removed_fraction < 1.0)
      error(path + ".law", "[ploughing] shares out what Archard's law removes; use law = \"archard\"");
    for (const ParticleSetup& p : setup_.particles)
      if (p.guide != Guide::none && p.material == w.worn)
        error(path + ".law",
              fmt::format("the tip of '{}' wears by Archard's law alone; use law = \"archard\"", p.name));
  }
}

/// Whatever is wrong with an expression itself, and what it asks of the run.
void Checker::check_expression(const WearSetup& w, const std::string& path) {
  const std::string key = path + ".expression";
  if (!good(key) || !good(path + ".constants") || !good("contact")) return;
  try {
    const auto expression = expression_of(setup_, w);
    if (setup_.run.method == Method::quasi_static && good("run.method") &&
        (expression->by_impact() || expression->names(wear::Symbol::normal_work)))
      error(key, "a balance of forces has no impacts and no normal_work: set run.method = \"dynamic\"");
    if (!expression->proportional_to_step())
      note(key,
           "half a step does not wear half as much: the volume depends on the time step. Each term wants one "
           "of "
           "slip, shear_work, normal_work or dt as a factor");
    for (const core::NamedQuantity& c : w.constants)
      if (!expression->names(c.name))
        note(path + ".constants", fmt::format("the expression does not name '{}'", c.name));
  } catch (const wear::ExpressionError& wrong) {
    Place place = places_.of(key);
    // The caret goes to the very character: one past the opening quote, one column per code point.
    if (wrong.position <= w.expression.size()) {
      const std::string_view before = std::string_view(w.expression).substr(0, wrong.position);
      place.column +=
          1 + static_cast<int>(std::ranges::count_if(before, [](char c) { return (c & 0xC0) != 0x80; }));
    }
    problems_.error(place, wrong.what());
  }
}

void Checker::check_regions() {
  if (!good("region")) return;
  if (setup_.regions.size() > 1000)
    error("region", fmt::format("{} regions; at most 1000 are possible", setup_.regions.size()));
  for (const RegionSetup& region : setup_.regions) {
    const std::string path = path_of("region", region.name);
    const auto wall = std::ranges::find(setup_.walls, region.wall, &WallSetup::name);
    if (wall == setup_.walls.end() && good("wall")) {
      std::vector<std::string_view> known;
      for (const WallSetup& w : setup_.walls) known.push_back(w.name);
      const std::string nearest = core::nearest_spelling(region.wall, known);
      error(path + ".wall",
            nearest.empty()
                ? fmt::format("no wall '{}'; the case has: {}", region.wall, fmt::join(known, ", "))
                : fmt::format("no wall '{}'; did you mean '{}'?", region.wall, nearest));
    } else if (wall != setup_.walls.end() && wall->mesh.shape == MeshShape::plane) {
      error(path + ".wall", fmt::format("wall '{}' is a plane, which has no elements", region.wall));
    }
    const Vec3 e = region.high - region.low;
    if (good(path + ".low") && good(path + ".high") && !(e.x > 0.0 && e.y > 0.0 && e.z > 0.0))
      error(path + ".high", "every coordinate of high must be above that of low");
    const bool named_as_wall =
        std::ranges::find(setup_.walls, region.name, &WallSetup::name) != setup_.walls.end();
    if (named_as_wall) error(path, "has the name of a wall, under which the rest of that wall is counted");
  }
}

void Checker::check_ploughing() {
  if (!setup_.ploughing || setup_.ploughing->removed_fraction == 1.0 || !good("wall")) return;
  if (setup_.output.maps == simulation::Maps::on)
    error("output.maps", "what [ploughing] moves aside has no map; use maps = \"off\"");
  for (const WallSetup& wall : setup_.walls)
    if (wall.deformation == DeformationRule::paper)
      error(path_of("wall", wall.name) + ".deformation",
            "the deformation rule paper moves whole elements inwards and has no ridges; with [ploughing] use "
            "deformation = \"conserving\"");
}

void Checker::check_acceleration() {
  if (!good("wear")) return;
  for (const WearSetup& w : setup_.wear) {
    const std::string path = path_of("wear", w.abrader + "/" + w.worn);
    const WearSetup& first = setup_.wear.front();
    if (w.acceleration != first.acceleration)
      error(path + ".acceleration",
            fmt::format("every wear pair must have the same acceleration, and [{}] has another: they "
                        "shorten one and the same run",
                        path_of("wear", first.abrader + "/" + first.worn)));
    else if (w.acceleration.automatic && w.tolerance != first.tolerance)
      error(path + ".tolerance", fmt::format("every wear pair must have the same tolerance, and [{}] has "
                                             "another: one acceleration is chosen for the run",
                                             path_of("wear", first.abrader + "/" + first.worn)));
    if (!w.acceleration.automatic && w.acceleration.factor == 1.0) continue;
    if (counts_revolutions(setup_) || !good("wall") || !good("insertion") || !good("run.settle")) continue;
    if (setup_.insertions.empty())
      error(path + ".acceleration",
            "acceleration leaves out revolutions, but no wall has a motion of kind rotation or oscillation; "
            "where nothing turns it is for particles in numbers, which flow steadily");
    else if (setup_.run.settle.value == 0.0 && w.acceleration.automatic)
      error(path + ".acceleration",
            "\"auto\" first models as long as the flow takes to settle: give [run] settle, such as settle = "
            "\"0.4 s\"");
    else if (setup_.run.settle.value == 0.0)
      note(path + ".acceleration",
           fmt::format("every modelled second stands for {:g} of the test from the start, while the flow "
                       "fills too; [run] settle says when it is steady",
                       w.acceleration.factor));
  }
}

}  // namespace abradem::io
