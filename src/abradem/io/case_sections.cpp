// SPDX-License-Identifier: BSD-3-Clause
#include <array>

#include "abradem/io/case_schema.h"

namespace abradem::io {
namespace {

std::size_t one(const Target&) { return 1; }
void nothing(const Target&) {}
void stay(Target&, std::size_t) {}

/// "a/b" → a, b; the reader has checked that there is exactly one slash.
void split_pair(const std::string& pair, std::string& first, std::string& second) {
  const std::size_t slash = pair.find('/');
  first = pair.substr(0, slash);
  second = pair.substr(slash + 1);
}

const std::array kSections{
    Section{.path = "",
            .doc = "Keys at the top of the file.",
            .presence = Presence::required,
            .count = one,
            .add = nothing,
            .enter = stay},
    Section{.path = "material.*",
            .doc = "A material; its name is used by walls, particles and pairs. The constants "
                   "have no defaults: they decide the result.",
            .presence = Presence::at_least_one,
            .naming = Naming::name,
            .count = [](const Target& t) { return t.setup->materials.size(); },
            .add = [](const Target& t) { t.setup->materials.emplace_back(); },
            .enter = [](Target& t, std::size_t i) { t.material = &t.setup->materials[i]; },
            .name = [](const Target& t) { return t.material->name; },
            .rename = [](const Target& t, const std::string& name) { t.material->name = name; }},
    Section{.path = "contact.*",
            .doc = "How two materials act on each other; the names in any order.",
            .naming = Naming::pair,
            .count = [](const Target& t) { return t.setup->contacts.size(); },
            .add = [](const Target& t) { t.setup->contacts.emplace_back(); },
            .enter = [](Target& t, std::size_t i) { t.contact = &t.setup->contacts[i]; },
            .name = [](const Target& t) { return t.contact->first + "/" + t.contact->second; },
            .rename = [](const Target& t,
                         const std::string& pair) { split_pair(pair, t.contact->first, t.contact->second); }},
    Section{.path = "wear.*",
            .doc = "How the first material wears the second.",
            .naming = Naming::pair,
            .count = [](const Target& t) { return t.setup->wear.size(); },
            .add = [](const Target& t) { t.setup->wear.emplace_back(); },
            .enter = [](Target& t, std::size_t i) { t.wear = &t.setup->wear[i]; },
            .name = [](const Target& t) { return t.wear->abrader + "/" + t.wear->worn; },
            .rename = [](const Target& t,
                         const std::string& pair) { split_pair(pair, t.wear->abrader, t.wear->worn); }},
    Section{.path = "ploughing",
            .doc = "Micro-ploughing: not all that leaves a groove is lost; the rest is piled up in ridges.",
            .count = [](const Target& t) { return std::size_t{t.setup->ploughing ? 1u : 0u}; },
            .add = [](const Target& t) { t.setup->ploughing.emplace(); },
            .enter = stay},
    Section{.path = "wall.*",
            .doc = "A surface that particles touch: a mesh, how it moves, and how it wears.",
            .presence = Presence::at_least_one,
            .naming = Naming::name,
            .count = [](const Target& t) { return t.setup->walls.size(); },
            .add = [](const Target& t) { t.setup->walls.emplace_back(); },
            .enter = [](Target& t, std::size_t i) { t.wall = &t.setup->walls[i]; },
            .name = [](const Target& t) { return t.wall->name; },
            .rename = [](const Target& t, const std::string& name) { t.wall->name = name; }},
    Section{.path = "wall.*.mesh",
            .doc = "The shape of the wall: generated, read from a file, or an analytic plane.",
            .presence = Presence::required,
            .count = one,
            .add = nothing,
            .enter = stay},
    Section{.path = "wall.*.motion",
            .doc =
                "The rigid motion of the wall. A list, `motion = [{ … }, { … }]`, makes motions that carry "
                "each other: the wall moves as the first says, that whole as the second says, and so on.",
            .naming = Naming::one_or_list,
            .count = [](const Target& t) { return t.wall->motions(); },
            .add = [](const Target& t) { t.wall->carried_by.emplace_back(); },
            .enter = [](Target& t,
                        std::size_t i) { t.motion = i == 0 ? &t.wall->motion : &t.wall->carried_by[i - 1]; }},
    Section{.path = "wall.*.motion.rows.*",
            .doc = "A row of a motion's table. Before the first row the wall stands there; between rows it "
                   "moves at constant velocity and rate.",
            .naming = Naming::list,
            .count = [](const Target& t) { return t.motion->rows.size(); },
            .add = [](const Target& t) { t.motion->rows.emplace_back(); },
            .enter = [](Target& t, std::size_t i) { t.motion_row = &t.motion->rows[i]; }},
    Section{.path = "region.*",
            .doc =
                "Part of a wall, for the spectra of its wear map: the elements whose unworn centres lie in "
                "a box; the first region that holds an element has it, and what no region holds counts "
                "under the wall's own name.",
            .naming = Naming::name,
            .count = [](const Target& t) { return t.setup->regions.size(); },
            .add = [](const Target& t) { t.setup->regions.emplace_back(); },
            .enter = [](Target& t, std::size_t i) { t.region = &t.setup->regions[i]; },
            .name = [](const Target& t) { return t.region->name; },
            .rename = [](const Target& t, const std::string& name) { t.region->name = name; }},
    Section{.path = "particle.*",
            .doc = "A sphere or a clump with a name of its own: a pin, an impactor.",
            .naming = Naming::name,
            .count = [](const Target& t) { return t.setup->particles.size(); },
            .add = [](const Target& t) { t.setup->particles.emplace_back(); },
            .enter = [](Target& t, std::size_t i) { t.particle = &t.setup->particles[i]; },
            .name = [](const Target& t) { return t.particle->name; },
            .rename = [](const Target& t, const std::string& name) { t.particle->name = name; }},
    Section{.path = "shape.*",
            .doc = "What particles look like that are no spheres: spheres that keep together (a "
                   "clump), either given or fitted to a closed mesh. Overlaps count once. "
                   "[More](../theory/clumps.md).",
            .naming = Naming::name,
            .count = [](const Target& t) { return t.setup->shapes.size(); },
            .add = [](const Target& t) { t.setup->shapes.emplace_back(); },
            .enter = [](Target& t, std::size_t i) { t.shape = &t.setup->shapes[i]; },
            .name = [](const Target& t) { return t.shape->name; },
            .rename = [](const Target& t, const std::string& name) { t.shape->name = name; }},
    Section{.path = "shape.*.spheres.*",
            .doc = "One sphere of the shape; also written `spheres = [{ position = …, radius = … }, …]`.",
            .naming = Naming::list,
            .count = [](const Target& t) { return t.shape->spheres.size(); },
            .add = [](const Target& t) { t.shape->spheres.emplace_back(); },
            .enter = [](Target& t, std::size_t i) { t.sphere = &t.shape->spheres[i]; }},
    Section{.path = "shape.*.fit",
            .doc = "Spheres in the place of the solid in a mesh file; mass, centre and inertia are those of "
                   "the solid itself.",
            .count = [](const Target& t) { return std::size_t{t.shape->fit ? 1u : 0u}; },
            .add = [](const Target& t) { t.shape->fit.emplace(); },
            .enter = stay},
    Section{.path = "insertion.*",
            .doc = "Particles in numbers, all of one material: how many, how large, and where they come in.",
            .naming = Naming::name,
            .count = [](const Target& t) { return t.setup->insertions.size(); },
            .add = [](const Target& t) { t.setup->insertions.emplace_back(); },
            .enter = [](Target& t, std::size_t i) { t.insertion = &t.setup->insertions[i]; },
            .name = [](const Target& t) { return t.insertion->name; },
            .rename = [](const Target& t, const std::string& name) { t.insertion->name = name; }},
    Section{.path = "insertion.*.size",
            .doc = "How large the spheres are, by number. Not needed where a file or a run gives their "
                   "places, or where "
                   "a shape comes in as it was given.",
            .count =
                [](const Target& t) {
                  const simulation::InsertionSetup& i = *t.insertion;
                  const bool as_given =
                      !i.shape.empty() && i.size.kind == simulation::SizeKind::single && i.size.radius == 0.0;
                  return std::size_t{simulation::gives_places(i.volume.shape) || as_given ? 0u : 1u};
                },
            .add = nothing,
            .enter = stay},
    Section{.path = "insertion.*.volume",
            .doc = "Where the spheres come in. Of those that are drawn the whole bodies lie inside, and they "
                   "overlap no other and no wall; those of a file or a run are taken as they are.",
            .presence = Presence::required,
            .count = one,
            .add = nothing,
            .enter = stay},
    Section{.path = "domain",
            .doc = "A box for the particles in numbers, and what becomes of those that leave it.",
            .count = [](const Target& t) { return std::size_t{t.setup->domain ? 1u : 0u}; },
            .add = [](const Target& t) { t.setup->domain.emplace(); },
            .enter = stay},
    Section{.path = "run",
            .doc = "How long, and how.",
            .presence = Presence::required,
            .count = one,
            .add = nothing,
            .enter = stay},
    Section{.path = "output",
            .doc = "What is written, and how often.",
            .count = one,
            .add = nothing,
            .enter = stay},
    Section{.path = "measurement",
            .doc = "What the laboratory found; drawn beside the result, never used by the run.",
            .count = [](const Target& t) { return std::size_t{t.setup->measurement ? 1u : 0u}; },
            .add = [](const Target& t) { t.setup->measurement.emplace(); },
            .enter = stay},
    Section{.path = "measurement.wear_volume",
            .doc = "Volume worn off.",
            .count = [](const Target& t) { return std::size_t{t.setup->measurement->wear_volume ? 1u : 0u}; },
            .add = [](const Target& t) { t.setup->measurement->wear_volume.emplace(); },
            .enter = stay},
    Section{.path = "measurement.depth",
            .doc = "Depth of the groove.",
            .count = [](const Target& t) { return std::size_t{t.setup->measurement->depth ? 1u : 0u}; },
            .add = [](const Target& t) { t.setup->measurement->depth.emplace(); },
            .enter = stay},
    Section{.path = "measurement.width",
            .doc = "Width of the groove.",
            .count = [](const Target& t) { return std::size_t{t.setup->measurement->width ? 1u : 0u}; },
            .add = [](const Target& t) { t.setup->measurement->width.emplace(); },
            .enter = stay},
    Section{.path = "study",
            .doc = "Makes the case a study: `abradem run` makes the runs of all its variations and draws one "
                   "page from them.",
            .count = [](const Target& t) { return std::size_t{t.setup->study ? 1u : 0u}; },
            .add = [](const Target& t) { t.setup->study.emplace(); },
            .enter = stay},
    Section{.path = "study.variation.*",
            .doc = "A group of runs: the case with some of its keys changed, one run for every combination.",
            .presence = Presence::at_least_one,
            .naming = Naming::list,
            .count = [](const Target& t) { return t.setup->study->variations.size(); },
            .add = [](const Target& t) { t.setup->study->variations.emplace_back(); },
            .enter = [](Target& t, std::size_t i) { t.variation = &t.setup->study->variations[i]; }},
};

}  // namespace

std::span<const Section> case_sections() { return kSections; }

}  // namespace abradem::io
