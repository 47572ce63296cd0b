// SPDX-License-Identifier: BSD-3-Clause
// What things are made of, and what happens where they meet.
#include <array>

#include "abradem/io/case_row_slots.h"
#include "abradem/io/case_rows.h"

namespace abradem::io {
namespace {

using namespace std::string_view_literals;

// In the order of the enumerations of setup.h.
constexpr std::array kContactLaws{"hertz_mindlin"sv, "linear"sv};
constexpr std::array kRollingModels{"constant"sv, "epsd2"sv};
constexpr std::array kTorsions{"none"sv, "marshall"sv};
constexpr std::array kCohesions{"none"sv, "sjkr"sv, "jkr"sv};
constexpr std::array kWearLaws{"archard"sv};

constexpr std::array kLinear{"linear"sv};
constexpr std::array kSjkr{"sjkr"sv};
constexpr std::array kJkr{"jkr"sv};

const std::array kRows{
    Row{.section = "",
        .key = "schema",
        .kind = Kind::version,
        .slot = [](const Target&) -> Slot { return {}; },
        .example = "1",
        .doc = "Version of this format; 1 is the only one."},
    Row{.section = "",
        .key = "title",
        .kind = Kind::text,
        .need = Need::has_default,
        .slot = ABRADEM_SLOT(setup->title),
        .example = "\"Pin on disc\"",
        .doc = "One line for the report."},

    Row{.section = "material.*",
        .key = "density",
        .slot = ABRADEM_SLOT(material->density),
        .unit = "kg/m^3",
        .limits = kPositive,
        .example = "\"4850 kg/m^3\"",
        .doc = "Mass per volume."},
    Row{.section = "material.*",
        .key = "shear_modulus",
        .slot = ABRADEM_SLOT(material->shear_modulus),
        .unit = "GPa",
        .limits = kPositive,
        .example = "\"78 GPa\"",
        .doc = "Elastic shear modulus G; Young's modulus is 2 G (1 + poisson_ratio)."},
    Row{.section = "material.*",
        .key = "poisson_ratio",
        .slot = ABRADEM_SLOT(material->poisson_ratio),
        .limits = {.low = -1.0, .high = 0.5, .low_excluded = true, .high_excluded = true},
        .example = "0.3",
        .doc = "Poisson's ratio."},
    Row{.section = "material.*",
        .key = "hardness",
        .need = Need::optional,
        .slot = ABRADEM_SLOT(material->hardness),
        .unit = "HV",
        .limits = kPositive,
        .example = "\"143 HV\"",
        .doc = "Indentation hardness H; only used to state the dimensionless Archard coefficient k = "
               "wear_coefficient * H."},

    Row{.section = "contact.*",
        .key = "law",
        .kind = Kind::choice,
        .need = Need::has_default,
        .slot = ABRADEM_CHOICE(contact->law),
        .choices = kContactLaws,
        .example = "\"hertz_mindlin\"",
        .doc =
            "Contact law: Hertz-Mindlin (no slip), or linear springs; both with viscous damping and Coulomb "
            "friction."},
    Row{.section = "contact.*",
        .key = "normal_stiffness",
        .slot = ABRADEM_SLOT(contact->normal_stiffness),
        .unit = "N/m",
        .limits = kPositive,
        .when = {"law", kLinear},
        .example = "\"1e5 N/m\"",
        .doc = "Stiffness of the normal spring."},
    Row{.section = "contact.*",
        .key = "tangential_stiffness",
        .need = Need::optional,
        .slot = ABRADEM_SLOT(contact->tangential_stiffness),
        .unit = "N/m",
        .limits = kPositive,
        .when = {"law", kLinear},
        .default_note = "2/7 of the normal one",
        .example = "\"3e4 N/m\"",
        .doc = "Stiffness of the tangential spring."},
    Row{.section = "contact.*",
        .key = "restitution",
        .slot = ABRADEM_SLOT(contact->restitution),
        .limits = {.low = 0.0, .high = 1.0, .low_excluded = true},
        .example = "0.4",
        .doc = "Coefficient of restitution: speed after a head-on impact over the speed before."},
    Row{.section = "contact.*",
        .key = "static_friction",
        .slot = ABRADEM_SLOT(contact->static_friction),
        .limits = kNotNegative,
        .example = "0.5",
        .doc = "Coulomb coefficient of friction."},
    Row{.section = "contact.*",
        .key = "rolling_friction",
        .need = Need::has_default,
        .slot = ABRADEM_SLOT(contact->rolling_friction),
        .limits = kNotNegative,
        .example = "0.01",
        .doc = "Coefficient of rolling friction: largest rolling torque over normal force and effective "
               "radius."},
    Row{.section = "contact.*",
        .key = "rolling_model",
        .kind = Kind::choice,
        .need = Need::has_default,
        .slot = ABRADEM_CHOICE(contact->rolling_model),
        .choices = kRollingModels,
        .example = "\"epsd2\"",
        .doc =
            "Type A, a constant torque against the spin (constant), or type C, a spring that yields at that "
            "torque and holds a sphere at rest (epsd2)."},
    Row{.section = "contact.*",
        .key = "torsion",
        .kind = Kind::choice,
        .need = Need::has_default,
        .slot = ABRADEM_CHOICE(contact->torsion),
        .choices = kTorsions,
        .example = "\"marshall\"",
        .doc =
            "Resistance against spin about the normal: none, or that of static_friction over the contact's "
            "circle (marshall)."},
    Row{.section = "contact.*",
        .key = "cohesion",
        .kind = Kind::choice,
        .need = Need::has_default,
        .slot = ABRADEM_CHOICE(contact->cohesion),
        .choices = kCohesions,
        .example = "\"jkr\"",
        .doc = "None; a force per area of contact (sjkr); or the adhesion of Johnson, Kendall and Roberts "
               "(jkr), at walls of rule resolved and at planes."},
    Row{.section = "contact.*",
        .key = "cohesion_energy_density",
        .slot = ABRADEM_SLOT(contact->cohesion_energy_density),
        .unit = "J/m^3",
        .limits = kPositive,
        .when = {"cohesion", kSjkr},
        .example = "\"1e5 J/m^3\"",
        .doc = "Cohesive force over the area of the circle in which the bodies cut each other."},
    Row{.section = "contact.*",
        .key = "work_of_adhesion",
        .slot = ABRADEM_SLOT(contact->work_of_adhesion),
        .unit = "J/m^2",
        .limits = kPositive,
        .when = {"cohesion", kJkr},
        .example = "\"0.1 J/m^2\"",
        .doc = "Work w that parting takes per area (twice the surface energy of equal bodies): the pull-off "
               "force "
               "is 3/2 pi w R_eff."},

    Row{.section = "wear.*",
        .key = "law",
        .kind = Kind::choice,
        .need = Need::has_default,
        .slot = [](const Target&) -> Slot { return {}; },
        .choices = kWearLaws,
        .example = "\"archard\"",
        .doc = "Wear law: Archard, volume = wear_coefficient * normal force * sliding distance."},
    Row{.section = "wear.*",
        .key = "wear_coefficient",
        .slot = ABRADEM_SLOT(wear->wear_coefficient),
        .unit = "1/Pa",
        .limits = kNotNegative,
        .example = "\"5e-11 1/Pa\"",
        .doc = "Archard coefficient alpha_s = k / H, volume worn per force and sliding distance."},
    Row{.section = "wear.*",
        .key = "acceleration",
        .kind = Kind::acceleration,
        .need = Need::has_default,
        .slot = ABRADEM_SLOT(wear->acceleration),
        .limits = {.low = 1.0},
        .example = "108.5",
        .doc = "Revolutions of the test that one modelled revolution stands for: its wear counts so many "
               "times. end, every and the tables count those of the test. auto chooses the number by "
               "comparing runs of n and 2 n revolutions."},
    Row{.section = "wear.*",
        .key = "tolerance",
        .need = Need::has_default,
        .slot = ABRADEM_SLOT(wear->tolerance),
        .unit = "%",
        .limits = kPositive,
        .example = "\"1 %\"",
        .doc = "Of acceleration = \"auto\": difference allowed between the mean profiles, relative L2."},

    Row{.section = "ploughing",
        .key = "removed_fraction",
        .slot = ABRADEM_SLOT(setup->ploughing->removed_fraction),
        .limits = {.low = 0.0, .high = 1.0},
        .example = "0.6",
        .doc = "Of the volume that leaves a groove, the part that is lost as debris (f_ab of Zum Gahr); the "
               "rest "
               "is moved to ridges beside the contact. The wear coefficient gives the lost volume, so that "
               "wear_coefficient / removed_fraction leaves the groove; at 0 nothing is lost and the "
               "coefficient is that of the groove."},
    Row{.section = "ploughing",
        .key = "ridge_angle",
        .need = Need::has_default,
        .slot = ABRADEM_SLOT(setup->ploughing->ridge_angle),
        .unit = "deg",
        .limits = {.low = 0.0, .high = 1.5533430342749532, .low_excluded = true},
        .example = "\"10 deg\"",
        .doc = "Steepest flank that a ridge builds against the first surface."},
    Row{.section = "ploughing",
        .key = "ahead",
        .need = Need::has_default,
        .slot = ABRADEM_SLOT(setup->ploughing->ahead),
        .limits = {.low = 0.0, .high = 1.0},
        .example = "0.2",
        .doc = "Share of what is moved that goes ahead of the contact instead of beside it."},
};

}  // namespace

std::span<const Row> material_rows() { return kRows; }

}  // namespace abradem::io
