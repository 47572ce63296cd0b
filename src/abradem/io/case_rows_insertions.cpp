// SPDX-License-Identifier: BSD-3-Clause
// Particles in numbers.
#include <array>

#include "abradem/io/case_row_slots.h"
#include "abradem/io/case_rows.h"

namespace abradem::io {
namespace {

using namespace std::string_view_literals;

// In the order of the enumerations of setup.h.
constexpr std::array kSizes{"single"sv, "uniform"sv, "normal"sv, "lognormal"sv, "table"sv};
constexpr std::array kVolumes{"box"sv, "cylinder"sv, "file"sv, "face"sv};
constexpr std::array kPeriodic{"none"sv, "x"sv, "y"sv, "z"sv, "xy"sv, "xz"sv, "yz"sv, "xyz"sv};
constexpr std::array kOutside{"remove"sv, "stop"sv};

constexpr std::array kFile{"file"sv};
constexpr std::array kSingle{"single"sv};
constexpr std::array kNormalSizes{"normal"sv, "lognormal"sv};
constexpr std::array kBoundedSizes{"uniform"sv, "normal"sv, "lognormal"sv};
constexpr std::array kTableOfSizes{"table"sv};
constexpr std::array kBox{"box"sv, "face"sv};
constexpr std::array kCylinder{"cylinder"sv};

const std::array kRows{
    Row{.section = "insertion.*",
        .key = "material",
        .kind = Kind::material,
        .slot = ABRADEM_SLOT(insertion->material),
        .example = "\"iron_ore\"",
        .doc = "Name of the material."},
    Row{.section = "insertion.*",
        .key = "number",
        .kind = Kind::integer,
        .need = Need::has_default,
        .slot = ABRADEM_SLOT(insertion->number),
        .limits = {.low = 0, .high = 1e8},
        .example = "10000",
        .doc = "How many come in, in all; 0: as many as mass says."},
    Row{.section = "insertion.*",
        .key = "mass",
        .need = Need::optional,
        .slot = ABRADEM_SLOT(insertion->mass),
        .unit = "kg",
        .limits = kPositive,
        .example = "\"2 kg\"",
        .doc = "How much comes in, in all, to within half a sphere."},
    Row{.section = "insertion.*",
        .key = "mass_rate",
        .need = Need::optional,
        .slot = ABRADEM_SLOT(insertion->mass_rate),
        .unit = "kg/s",
        .limits = kPositive,
        .default_note = "all at the start",
        .example = "\"0.5 kg/s\"",
        .doc = "Mass per time; what finds no place waits until there is one."},
    Row{.section = "insertion.*",
        .key = "start",
        .need = Need::has_default,
        .slot = ABRADEM_SLOT(insertion->start),
        .unit = "s",
        .limits = kNotNegative,
        .example = "\"0.1 s\"",
        .doc = "Time at which it begins."},
    Row{.section = "insertion.*",
        .key = "velocity",
        .kind = Kind::vector,
        .need = Need::has_default,
        .slot = ABRADEM_SLOT(insertion->velocity),
        .unit = "m/s",
        .example = "[0, 0, \"-1 m/s\"]",
        .doc = "Velocity of those that come in."},
    Row{.section = "insertion.*.size",
        .key = "kind",
        .kind = Kind::choice,
        .need = Need::has_default,
        .slot = ABRADEM_CHOICE(insertion->size.kind),
        .choices = kSizes,
        .example = "\"uniform\"",
        .doc = "Distribution of the radius by number: one size (single), uniform, normal, lognormal, or a "
               "table in "
               "a file."},
    Row{.section = "insertion.*.size",
        .key = "radius",
        .slot = ABRADEM_SLOT(insertion->size.radius),
        .unit = "mm",
        .limits = kPositive,
        .when = {"kind", kSingle},
        .example = "\"3 mm\"",
        .doc = "Radius of all."},
    Row{.section = "insertion.*.size",
        .key = "mean",
        .slot = ABRADEM_SLOT(insertion->size.mean),
        .unit = "mm",
        .limits = kPositive,
        .when = {"kind", kNormalSizes},
        .example = "\"3 mm\"",
        .doc = "Mean radius, before the bounds cut it off."},
    Row{.section = "insertion.*.size",
        .key = "sd",
        .slot = ABRADEM_SLOT(insertion->size.sd),
        .unit = "mm",
        .limits = kPositive,
        .when = {"kind", kNormalSizes},
        .example = "\"0.3 mm\"",
        .doc = "Standard deviation of the radius, before the bounds cut it off."},
    Row{.section = "insertion.*.size",
        .key = "low",
        .slot = ABRADEM_SLOT(insertion->size.low),
        .unit = "mm",
        .limits = kPositive,
        .when = {"kind", kBoundedSizes},
        .example = "\"2 mm\"",
        .doc = "Smallest radius."},
    Row{.section = "insertion.*.size",
        .key = "high",
        .slot = ABRADEM_SLOT(insertion->size.high),
        .unit = "mm",
        .limits = kPositive,
        .when = {"kind", kBoundedSizes},
        .example = "\"4 mm\"",
        .doc = "Largest radius."},
    Row{.section = "insertion.*.size",
        .key = "file",
        .kind = Kind::file,
        .slot = ABRADEM_SLOT(insertion->size.file),
        .when = {"kind", kTableOfSizes},
        .example = "\"sizes.csv\"",
        .doc = "CSV file with the columns radius_mm and share (of the number of spheres, any sum), relative "
               "to the "
               "folder of the case file."},
    Row{.section = "insertion.*.volume",
        .key = "shape",
        .kind = Kind::choice,
        .need = Need::has_default,
        .slot = ABRADEM_CHOICE(insertion->volume.shape),
        .choices = kVolumes,
        .example = "\"box\"",
        .doc = "A box, a cylinder, a file that gives the place of every sphere, or a face: a box without "
               "thickness in one direction, through which spheres come at a mass_rate."},
    Row{.section = "insertion.*.volume",
        .key = "low",
        .kind = Kind::vector,
        .slot = ABRADEM_SLOT(insertion->volume.low),
        .unit = "mm",
        .when = {"shape", kBox},
        .example = "[0, 0, 0]",
        .doc = "Lowest corner."},
    Row{.section = "insertion.*.volume",
        .key = "high",
        .kind = Kind::vector,
        .slot = ABRADEM_SLOT(insertion->volume.high),
        .unit = "mm",
        .when = {"shape", kBox},
        .example = "[\"100 mm\", \"100 mm\", \"50 mm\"]",
        .doc = "Highest corner."},
    Row{.section = "insertion.*.volume",
        .key = "base",
        .kind = Kind::vector,
        .slot = ABRADEM_SLOT(insertion->volume.base),
        .unit = "mm",
        .when = {"shape", kCylinder},
        .example = "[0, 0, 0]",
        .doc = "Centre of one end."},
    Row{.section = "insertion.*.volume",
        .key = "top",
        .kind = Kind::vector,
        .slot = ABRADEM_SLOT(insertion->volume.top),
        .unit = "mm",
        .when = {"shape", kCylinder},
        .example = "[0, 0, \"80 mm\"]",
        .doc = "Centre of the other end."},
    Row{.section = "insertion.*.volume",
        .key = "radius",
        .slot = ABRADEM_SLOT(insertion->volume.radius),
        .unit = "mm",
        .limits = kPositive,
        .when = {"shape", kCylinder},
        .example = "\"40 mm\"",
        .doc = "Radius of the cylinder."},
    Row{.section = "insertion.*.volume",
        .key = "file",
        .kind = Kind::file,
        .slot = ABRADEM_SLOT(insertion->volume.file),
        .when = {"shape", kFile},
        .example = "\"spheres.csv\"",
        .doc = "CSV file with the columns x_mm, y_mm, z_mm and radius_mm, and where the spheres have "
               "velocities of "
               "their own velocity_x_m_per_s, velocity_y_m_per_s and velocity_z_m_per_s; relative to the "
               "folder of "
               "the case file."},

    Row{.section = "domain",
        .key = "low",
        .kind = Kind::vector,
        .slot = ABRADEM_SLOT(setup->domain->low),
        .unit = "mm",
        .example = "[\"-200 mm\", \"-200 mm\", \"-50 mm\"]",
        .doc = "Lowest corner."},
    Row{.section = "domain",
        .key = "high",
        .kind = Kind::vector,
        .slot = ABRADEM_SLOT(setup->domain->high),
        .unit = "mm",
        .example = "[\"200 mm\", \"200 mm\", \"500 mm\"]",
        .doc = "Highest corner."},
    Row{.section = "domain",
        .key = "outside",
        .kind = Kind::choice,
        .need = Need::has_default,
        .slot = ABRADEM_CHOICE(setup->domain->outside),
        .choices = kOutside,
        .example = "\"remove\"",
        .doc = "What becomes of a particle whose centre leaves the box: it is taken out and counted "
               "(remove), or the "
               "run stops. Looked at whenever the list of neighbours is made anew."},
    Row{.section = "domain",
        .key = "periodic",
        .kind = Kind::choice,
        .need = Need::has_default,
        .slot = ABRADEM_CHOICE(setup->domain->periodic),
        .choices = kPeriodic,
        .example = "\"xy\"",
        .doc = "Axes along which what leaves the box comes in again on the other side. Walls do not repeat "
               "themselves: let them reach beyond the box by a diameter."},
};

}  // namespace

std::span<const Row> insertion_rows() { return kRows; }

}  // namespace abradem::io
