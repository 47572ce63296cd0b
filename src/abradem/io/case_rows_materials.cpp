// SPDX-License-Identifier: BSD-3-Clause
// What things are made of, and what happens where they meet.
#include <array>

#include "abradem/io/case_row_slots.h"
#include "abradem/io/case_rows.h"
#include "abradem/wear/laws.h"

namespace abradem::io {
namespace {

using namespace std::string_view_literals;

// In the order of the enumerations of setup.h.
constexpr std::array kContactLaws{"hertz_mindlin"sv, "linear"sv};
constexpr std::array kRollingModels{"constant"sv, "epsd2"sv};
constexpr std::array kTorsions{"none"sv, "marshall"sv};
constexpr std::array kCohesions{"none"sv, "sjkr"sv, "jkr"sv};
constexpr auto& kWearLaws = wear::kMechanismNames;
constexpr std::array kArchard{"archard"sv};
constexpr std::array kShearWork{"shear_work"sv};
constexpr std::array kFinnie{"finnie"sv};
constexpr std::array kOka{"oka"sv};
constexpr std::array kImpactEnergy{"impact_energy"sv};
constexpr std::array kExpression{"expression"sv};

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
        .doc = "Indentation hardness H; for Oka's law, for an expression that names it, and to state the "
               "dimensionless Archard coefficient k = wear_coefficient * H."},

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
        .kind = Kind::choices,
        .need = Need::has_default,
        .slot = ABRADEM_CHOICES(wear->laws),
        .choices = kWearLaws,
        .example = "[\"archard\", \"oka\"]",
        .doc =
            "Wear law, or several whose volumes add up: by force and sliding distance (archard), by the work "
            "of friction (shear_work), by each impact's mass, speed and angle (finnie, oka), by the energy "
            "that impacts lose along the normal and to friction (impact_energy), by a formula of your own "
            "(expression)."},
    Row{.section = "wear.*",
        .key = "wear_coefficient",
        .slot = ABRADEM_SLOT(wear->wear_coefficient),
        .unit = "1/Pa",
        .limits = kNotNegative,
        .when = {"law", kArchard},
        .example = "\"5e-11 1/Pa\"",
        .doc = "Archard coefficient alpha_s = k / H, volume worn per force and sliding distance."},
    Row{.section = "wear.*",
        .key = "shear_work_coefficient",
        .slot = ABRADEM_SLOT(wear->shear_work_coefficient),
        .unit = "mm^3/J",
        .limits = kNotNegative,
        .when = {"law", kShearWork},
        .example = "\"0.01 mm^3/J\"",
        .doc = "Volume worn per work of friction, C; where a contact slides that is alpha_s / friction."},
    Row{.section = "wear.*",
        .key = "finnie_coefficient",
        .slot = ABRADEM_SLOT(wear->finnie_coefficient),
        .unit = "1/Pa",
        .limits = kNotNegative,
        .when = {"law", kFinnie},
        .example = "\"5e-11 1/Pa\"",
        .doc = "k = c / (psi p): share c of the grains that cut, over flow pressure p and chip ratio psi "
               "(about 2). An impact wears k * mass * speed^2 * f(angle)."},
    Row{.section = "wear.*",
        .key = "finnie_force_ratio",
        .need = Need::has_default,
        .slot = ABRADEM_SLOT(wear->finnie_force_ratio),
        .limits = kPositive,
        .when = {"law", kFinnie},
        .example = "2",
        .doc = "K: normal over tangential force on a grain that cuts; it sets the angle of the most wear."},
    Row{.section = "wear.*",
        .key = "oka_reference_erosion",
        .need = Need::optional,
        .slot = ABRADEM_SLOT(wear->oka.reference_erosion),
        .unit = "mm^3/kg",
        .limits = kNotNegative,
        .when = {"law", kOka},
        .default_note = "from the hardness of what is worn, for SiO2 grains",
        .example = "\"60 mm^3/kg\"",
        .doc =
            "Volume worn per mass of grains at 90 degrees, the reference speed and the reference diameter."},
    Row{.section = "wear.*",
        .key = "oka_reference_speed",
        .need = Need::has_default,
        .slot = ABRADEM_SLOT(wear->oka.reference_speed),
        .unit = "m/s",
        .limits = kPositive,
        .when = {"law", kOka},
        .example = "\"104 m/s\"",
        .doc = "Speed at which the reference erosion holds."},
    Row{.section = "wear.*",
        .key = "oka_reference_diameter",
        .need = Need::has_default,
        .slot = ABRADEM_SLOT(wear->oka.reference_diameter),
        .unit = "mm",
        .limits = kPositive,
        .when = {"law", kOka},
        .example = "\"0.326 mm\"",
        .doc = "Diameter at which the reference erosion holds."},
    Row{.section = "wear.*",
        .key = "oka_speed_exponent",
        .need = Need::optional,
        .slot = ABRADEM_SLOT(wear->oka.speed_exponent),
        .limits = kNotNegative,
        .when = {"law", kOka},
        .default_note = "from the hardness of what is worn, for SiO2 grains",
        .example = "2.35",
        .doc = "k2: erosion grows with the speed to this power."},
    Row{.section = "wear.*",
        .key = "oka_diameter_exponent",
        .need = Need::has_default,
        .slot = ABRADEM_SLOT(wear->oka.diameter_exponent),
        .limits = kNotNegative,
        .when = {"law", kOka},
        .example = "0.19",
        .doc = "k3: erosion per mass grows with the diameter to this power."},
    Row{.section = "wear.*",
        .key = "oka_n1",
        .need = Need::optional,
        .slot = ABRADEM_SLOT(wear->oka.n1),
        .limits = kNotNegative,
        .when = {"law", kOka},
        .default_note = "from the hardness of what is worn, for SiO2 grains",
        .example = "0.8",
        .doc = "Exponent of sin(angle) in the angle function."},
    Row{.section = "wear.*",
        .key = "oka_n2",
        .need = Need::optional,
        .slot = ABRADEM_SLOT(wear->oka.n2),
        .limits = kNotNegative,
        .when = {"law", kOka},
        .default_note = "from the hardness of what is worn, for SiO2 grains",
        .example = "1.3",
        .doc = "Exponent of 1 + hardness (1 - sin(angle)), hardness in GPa, in the angle function."},
    Row{.section = "wear.*",
        .key = "normal_energy_coefficient",
        .need = Need::has_default,
        .slot = ABRADEM_SLOT(wear->normal_energy_coefficient),
        .unit = "mm^3/J",
        .limits = kNotNegative,
        .when = {"law", kImpactEnergy},
        .example = "\"0.001 mm^3/J\"",
        .doc = "Volume worn per energy that contacts lose along the normal."},
    Row{.section = "wear.*",
        .key = "shear_energy_coefficient",
        .need = Need::has_default,
        .slot = ABRADEM_SLOT(wear->shear_energy_coefficient),
        .unit = "mm^3/J",
        .limits = kNotNegative,
        .when = {"law", kImpactEnergy},
        .example = "\"0.01 mm^3/J\"",
        .doc =
            "Volume worn per energy that contacts lose to friction; of the shear impact energy model (SIEM) "
            "C / p."},
    Row{.section = "wear.*",
        .key = "expression",
        .kind = Kind::text,
        .slot = ABRADEM_SLOT(wear->expression),
        .when = {"law", kExpression},
        .example = "\"k / H * Fn * slip\"",
        .doc =
            "Volume worn [m^3] per contact and time step or, where it names v or angle, per impact, as a "
            "formula "
            "in SI; [its names](#expressions). Its unit is checked: numbers have none, so give constants."},
    Row{.section = "wear.*",
        .key = "constants",
        .kind = Kind::constants,
        .need = Need::optional,
        .slot = ABRADEM_SLOT(wear->constants),
        .when = {"law", kExpression},
        .example = "{ k = 1e-4, F0 = \"2 N\" }",
        .doc = "Constants that the expression names, each with its unit; a bare number has none."},
    Row{.section = "wear.*",
        .key = "acceleration",
        .kind = Kind::acceleration,
        .need = Need::has_default,
        .slot = ABRADEM_SLOT(wear->acceleration),
        .limits = {.low = 1.0},
        .example = "108.5",
        .doc =
            "Seconds (revolutions) of the test that a modelled one stands for once run.settle is over: its "
            "wear counts so many times. end, every and the tables count those of the test; flows, motions "
            "and insertions are modelled as they are. auto chooses the number by comparing runs of n and "
            "2 n revolutions, or, of particles in numbers where nothing turns, seconds."},
    Row{.section = "wear.*",
        .key = "tolerance",
        .need = Need::optional,
        .slot = ABRADEM_SLOT(wear->tolerance),
        .unit = "%",
        .limits = kPositive,
        .default_note = "\"1 %\"; \"10 %\" where particles come in numbers",
        .example = "\"1 %\"",
        .doc =
            "Of acceleration = \"auto\": difference allowed between the mean profiles of the groove, or, of "
            "particles in numbers, the maps of depths, relative L2."},

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
