// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "abradem/core/units.h"
#include "abradem/core/vec3.h"
#include "abradem/geometry/quaternion.h"
#include "abradem/geometry/sphere_fit.h"

/// A case, resolved: what the case file says, in SI units, as plain data. The case reader fills it, a C++
/// program may fill it by hand; `Simulation` takes it. Keys and defaults: docs/reference/case-file.md.
namespace abradem::simulation {

struct MaterialSetup {
  std::string name;
  double density = 0.0;            ///< [kg/m^3]
  double shear_modulus = 0.0;      ///< [Pa]
  double poisson_ratio = 0.0;      ///< [-]
  std::optional<double> hardness;  ///< [Pa]; only to state k = alpha H
  bool operator==(const MaterialSetup&) const = default;
};

enum class ContactLaw { hertz_mindlin, linear };
enum class RollingModel { constant, epsd2 };
enum class Torsion { none, marshall };
enum class Cohesion { none, sjkr, jkr };

struct ContactSetup {
  std::string first, second;      ///< material names, any order
  double restitution = 1.0;       ///< [-]
  double static_friction = 0.0;   ///< [-]
  double rolling_friction = 0.0;  ///< [-]
  ContactLaw law = ContactLaw::hertz_mindlin;
  double normal_stiffness = 0.0;                    ///< linear [N/m]
  std::optional<double> tangential_stiffness = {};  ///< linear [N/m]; default: 2/7 of the normal one
  RollingModel rolling_model = RollingModel::constant;
  Torsion torsion = Torsion::none;
  Cohesion cohesion = Cohesion::none;
  double cohesion_energy_density = 0.0;  ///< sjkr [J/m^3]
  double work_of_adhesion = 0.0;         ///< jkr [J/m^2]
  bool operator==(const ContactSetup&) const = default;
};

/// How many seconds (revolutions) of the test one modelled second (revolution) stands for: its wear counts so
/// many times. `automatic` leaves the choice to study::choose_acceleration; a Simulation wants it made.
/// docs/theory/scaling.md
struct Acceleration {
  double factor = 1.0;  ///< >= 1; 1: every second of the test is modelled
  bool automatic = false;
  bool operator==(const Acceleration&) const = default;
};

/// In the order of wear::Mechanism.
enum class WearLaw { archard, shear_work, finnie, oka, impact_energy, expression };

/// Oka's erosion; what is not given is that of SiO2 grains on a metal of the worn material's hardness.
struct OkaSetup {
  std::optional<double> reference_erosion;  ///< at 90 degrees and the reference speed and diameter [m^3/kg]
  double reference_speed = 104.0;           ///< [m/s]
  double reference_diameter = 326e-6;       ///< [m]
  std::optional<double> speed_exponent;     ///< k2 [-]
  double diameter_exponent = 0.19;          ///< k3 [-]
  std::optional<double> n1, n2;             ///< exponents of the angle function [-]
  bool operator==(const OkaSetup&) const = default;
};

struct WearSetup {
  std::string abrader, worn;      ///< the first wears the second
  double wear_coefficient = 0.0;  ///< alpha_s = k / H_s [1/Pa], Archard
  Acceleration acceleration = {};
  /// Acceleration automatic: of the groove's profile, or the map of depths, relative L2 [-]; default: 1 % of
  /// a profile, 10 % of a map.
  std::optional<double> tolerance = {};
  std::vector<WearLaw> laws{WearLaw::archard};  ///< their volumes add up
  double shear_work_coefficient = 0.0;          ///< C: volume per work of friction [m^3/J]
  double finnie_coefficient = 0.0;              ///< k = c / (psi p) [1/Pa]
  double finnie_force_ratio = 2.0;              ///< K [-]
  OkaSetup oka = {};
  double normal_energy_coefficient = 0.0;  ///< k_n: volume per energy lost along the normal [m^3/J]
  double shear_energy_coefficient = 0.0;   ///< k_t: volume per energy lost to friction [m^3/J]
  std::string expression = {};             ///< volume per step of a contact or per impact; wear::Expression
  std::vector<core::NamedQuantity> constants = {};  ///< that the expression names
  bool operator==(const WearSetup&) const = default;
};

/// Micro-ploughing: of the volume that leaves a groove, what part is lost and where the rest goes.
/// docs/theory/ploughing.md
struct PloughingSetup {
  double removed_fraction = 1.0;             ///< f_ab: debris / volume that leaves the groove [-], 0 … 1
  double ridge_angle = 0.17453292519943295;  ///< steepest flank that a ridge builds [rad]
  double ahead = 0.0;  ///< share of what is displaced that goes ahead of the contact [-]
  bool operator==(const PloughingSetup&) const = default;
};

enum class MeshShape { annulus, disc, plate, plane, file };
struct MeshSetup {
  MeshShape shape = MeshShape::annulus;
  double inner = 0.0, outer = 0.0;   ///< annulus, disc: radii [m]
  double length = 0.0, width = 0.0;  ///< plate: along x and y [m]
  double size = 0.0;                 ///< target edge length [m]
  Vec3 position;                     ///< where the shape's centre (or the file's origin) goes [m]
  Vec3 rotation;               ///< turns about the fixed axes x, y and z, in this order, before that [rad]
  Vec3 normal{0.0, 0.0, 1.0};  ///< plane: its outward normal
  std::string file;            ///< absolute, or relative to the case file's folder
  double unit = 1.0;           ///< file: metres per unit of length in the file
  bool operator==(const MeshSetup&) const = default;
};

/// A row of a motion's table: where the wall is at a time. It is turned about its axis, then displaced.
struct MotionRow {
  double time = 0.0;   ///< [s]
  Vec3 displacement;   ///< [m]
  double angle = 0.0;  ///< [rad]
  bool operator==(const MotionRow&) const = default;

  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("time", self.time)("displacement", self.displacement)("angle", self.angle);
  }
};
/// What a wall does after the last row of its table: it stays there, or begins again at the first.
enum class TableEnd { hold, repeat };

enum class MotionKind { none, rotation, translation, oscillation, table };
/// Rigid motion of a wall. An oscillation moves by amplitude * sin(2 pi frequency t). A table is
/// interpolated linearly, and holds its first row before it begins.
struct MotionSetup {
  MotionKind kind = MotionKind::none;
  Vec3 axis{0.0, 0.0, 1.0};
  Vec3 center;             ///< rotation, table: a point on the axis of rotation [m]
  double rate = 0.0;       ///< rotation [rad/s]
  Vec3 velocity;           ///< translation [m/s]
  Vec3 amplitude;          ///< oscillation [m]
  double frequency = 0.0;  ///< oscillation [Hz]
  Vec3 surface_velocity;   ///< of a belt over the wall, which itself moves as `kind` says; wall's frame [m/s]
  std::string file;        ///< table: its CSV file, absolute; empty: `rows` are given
  std::vector<MotionRow> rows;      ///< table: given, or as read
  TableEnd after = TableEnd::hold;  ///< table
  bool operator==(const MotionSetup&) const = default;
};

enum class ContactRule { patch, resolved, per_triangle, automatic };
enum class DeformationRule { none, conserving, paper };
enum class Footprint { hertz, overlap };
/// The sides of a surface that can be touched: of a solid the one its normals point to, of a thin sheet both.
enum class Sides { front, both };

struct WallSetup {
  std::string name;
  std::string material;
  MeshSetup mesh;
  MotionSetup motion;
  std::vector<MotionSetup> carried_by;  ///< motions on top of `motion`, one after the other
  ContactRule contact = ContactRule::patch;
  Sides sides = Sides::front;  ///< both: with contact `resolved` and no deformation
  DeformationRule deformation = DeformationRule::none;
  Footprint footprint = Footprint::hertz;
  int deform_every = 1;             ///< steps between updates of the shape; 1 in the rule `paper`
  std::optional<double> until;      ///< taken away at this time, as a gate is [s]; default: it stays
  std::optional<double> thickness;  ///< of the liner, which may wear off [m]; only for the report
  bool operator==(const WallSetup&) const = default;

  [[nodiscard]] std::size_t motions() const noexcept { return 1 + carried_by.size(); }
  /// The k-th motion, the innermost first.
  [[nodiscard]] const MotionSetup& motion_at(std::size_t k) const noexcept {
    return k == 0 ? motion : carried_by[k - 1];
  }
};

/// Part of a wall whose spectra are kept apart: the elements whose unworn centres lie in a box.
struct RegionSetup {
  std::string name, wall;
  Vec3 low, high;  ///< in the wall's frame [m]
  bool operator==(const RegionSetup&) const = default;
};

enum class Guide { none, vertical };
struct ParticleSetup {
  std::string name;
  std::string material;
  double radius = 0.0;        ///< [m]
  Vec3 position;              ///< [m]
  Vec3 velocity;              ///< [m/s]
  Vec3 spin;                  ///< [rad/s]
  Guide guide = Guide::none;  ///< vertical: a holder leaves only the motion along the load free, no spin
  Vec3 load;                  ///< constant force [N], besides gravity
  /// Name of a shape; empty: a sphere. The radius is then that of a sphere of equal volume, 0: as given.
  std::string shape = {};
  Vec3 rotation = {};  ///< of a shape as it was given: about the fixed axes x, y and z, in this order [rad]
  bool operator==(const ParticleSetup&) const = default;
};

enum class SizeKind { single, uniform, normal, lognormal, table };
/// How large the spheres of an insertion are, by number.
struct SizeSetup {
  SizeKind kind = SizeKind::single;
  double radius = 0.0;           ///< single [m]
  double low = 0.0, high = 0.0;  ///< uniform; bounds of normal and lognormal [m]
  double mean = 0.0, sd = 0.0;   ///< normal, lognormal: of the radius itself [m]
  std::string file;              ///< table: its CSV file, absolute
  std::vector<double> radii;     ///< table, as read [m]
  std::vector<double> shares;    ///< table: of the number of spheres, any sum
  bool operator==(const SizeSetup&) const = default;
};

enum class VolumeShape { box, cylinder, file, face, run };
/// Do these say where each particle is, instead of a space to draw places in?
[[nodiscard]] constexpr bool gives_places(VolumeShape shape) noexcept {
  return shape == VolumeShape::file || shape == VolumeShape::run;
}
/// Where spheres are put: their whole bodies lie inside.
struct VolumeSetup {
  VolumeShape shape = VolumeShape::box;
  Vec3 low, high;            ///< box; face: a box without thickness, on which the centres lie [m]
  Vec3 base, top;            ///< cylinder: centres of its ends [m]
  double radius = 0.0;       ///< cylinder [m]
  std::string file;          ///< file: CSV with a place for every sphere, absolute
  std::string run;           ///< run: folder of a run that left the particles so, absolute
  std::optional<double> at;  ///< run: when, by its series.pvd [s]; default: its last frame
  bool operator==(const VolumeSetup&) const = default;
};

/// A sphere of an insertion at a given place.
struct PlacedSphere {
  Vec3 position;        ///< [m]
  double radius = 0.0;  ///< [m]
  Vec3 velocity;        ///< [m/s]
  Vec3 spin{};          ///< [rad/s]
  bool operator==(const PlacedSphere&) const = default;

  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("position", self.position)("radius", self.radius)("velocity", self.velocity);
    archive("spin", self.spin);
  }
};

/// Spheres in the place of the solid in a closed mesh file. What the file says is filled in by its reader.
struct ShapeFitSetup {
  std::string file;                ///< absolute, or relative to the case file's folder
  double unit = 1.0;               ///< metres per unit of length in the file
  int count = 12;                  ///< at most so many spheres
  geometry::SphereFit fit;         ///< as read
  geometry::MassProperties solid;  ///< of the mesh itself, as read
  bool operator==(const ShapeFitSetup&) const = default;
};

/// What a particle in numbers looks like that is no sphere: spheres that keep together, given or fitted.
struct ShapeSetup {
  std::string name;
  std::vector<geometry::Ball> spheres;  ///< given, in any frame
  std::optional<ShapeFitSetup> fit;     ///< or fitted
  bool operator==(const ShapeSetup&) const = default;
};

/// Particles in numbers, all of one material.
struct InsertionSetup {
  std::string name;
  std::string material;
  SizeSetup size;
  VolumeSetup volume;
  std::uint64_t number = 0;                 ///< how many in all; 0: by mass
  std::optional<double> mass;               ///< how much in all [kg]
  std::optional<double> mass_rate;          ///< over time [kg/s]; default: all at the start
  double start = 0.0;                       ///< time at which it begins [s]
  Vec3 velocity;                            ///< [m/s]
  Vec3 spin;                                ///< [rad/s]
  std::vector<PlacedSphere> placed;         ///< given places, instead of volume, size and number
  std::vector<geometry::Quaternion> turns;  ///< of each placed, of a shape; none given: at random
  std::string shape;  ///< name of a shape; empty: spheres. Radii are then those of spheres of equal volume
  bool operator==(const InsertionSetup&) const = default;
};

enum class Outside { remove, stop };
/// Axes along which what leaves a box comes in again on the other side.
enum class Periodic { none, x, y, z, xy, xz, yz, xyz };
/// What becomes of particles in numbers that leave a box.
struct DomainSetup {
  Vec3 low, high;  ///< [m]
  Outside outside = Outside::remove;
  Periodic periodic = Periodic::none;
  bool operator==(const DomainSetup&) const = default;
};

/// A length of the run: a time, or a number of revolutions (cycles) of the first wall that turns
/// (oscillates).
struct Duration {
  double value = 0.0;
  bool in_revolutions = false;
  bool operator==(const Duration&) const = default;
};

enum class Method { dynamic, quasi_static };

/// What a run does whose time step is too long for its contacts: it stops, or goes on with a warning.
enum class Stability { stop, warn };

/// A step given in seconds, or as a fraction of the smallest Rayleigh time.
struct TimeStep {
  double value = 0.2;
  bool of_rayleigh = true;
  bool operator==(const TimeStep&) const = default;
};

struct RunSetup {
  Duration end;     ///< of the test
  Duration settle;  ///< at the start, while the flow fills and becomes steady: nothing wears
  Method method = Method::dynamic;
  TimeStep time_step;
  Stability stability = Stability::stop;
  std::optional<double>
      increment;           ///< quasi_static: sliding distance per step [m]; default: chosen from the contact
  Vec3 gravity;            ///< [m/s^2]
  std::uint64_t seed = 1;  ///< of the mesh generator and every random stream
  bool operator==(const RunSetup&) const = default;
};

/// Outputs whose surfaces are written as frames: every one, the new and the last worn one, or none.
enum class Frames { all, ends, none };

/// Wear maps: of walls that particles in numbers wear (automatic), of all that wear, or of none.
enum class Maps { automatic, on, off };

struct OutputSetup {
  Duration every{1.0, true};  ///< frames and table rows
  Frames frames = Frames::all;
  Maps maps = Maps::automatic;
  int contours = 360;               ///< sections of the worn surface per output
  double checkpoint_every = 600.0;  ///< wall-clock time between checkpoints [s]; 0: none on the way
  bool operator==(const OutputSetup&) const = default;
};

struct MeanSd {
  double mean = 0.0, sd = 0.0;
  bool operator==(const MeanSd&) const = default;
};
struct Range {
  double low = 0.0, high = 0.0;
  bool operator==(const Range&) const = default;
};
/// What the laboratory found; only compared with, never fitted to, by a run.
struct MeasurementSetup {
  std::optional<MeanSd> wear_volume;  ///< [m^3]
  std::optional<Range> depth, width;  ///< [m]
  std::optional<double> revolutions;  ///< [-]
  bool operator==(const MeasurementSetup&) const = default;
};

/// A key of the case that the runs of a study change, and its values as TOML text: one per run, or the only
/// one.
struct VariedKey {
  std::string key;  ///< dotted, as for --set: wall.disc.mesh.size
  std::vector<std::string> values;
  bool operator==(const VariedKey&) const = default;
};

/// Some runs of a study that belong together: `set` is the same in all, `together` goes side by side (its
/// lists are equally long), `vary` is crossed with it and with one another.
struct VariationSetup {
  std::string name;
  std::vector<VariedKey> set, together, vary;
  bool operator==(const VariationSetup&) const = default;
};

enum class StudyPage { table, paper, scaling };
/// Many runs of one case, and what is drawn from them. A run itself knows nothing of it.
struct StudySetup {
  StudyPage page = StudyPage::table;
  std::string published;  ///< file of published values to compare with, absolute; may be empty
  std::vector<VariationSetup> variations;
  bool operator==(const StudySetup&) const = default;
};

struct Setup {
  std::string title;
  std::vector<MaterialSetup> materials;
  std::vector<ContactSetup> contacts;
  std::vector<WearSetup> wear;
  std::optional<PloughingSetup> ploughing;
  std::vector<WallSetup> walls;
  std::vector<RegionSetup> regions;
  std::vector<ParticleSetup> particles;
  std::vector<ShapeSetup> shapes;
  std::vector<InsertionSetup> insertions;
  std::optional<DomainSetup> domain;
  RunSetup run;
  OutputSetup output;
  std::optional<MeasurementSetup> measurement;
  std::optional<StudySetup> study;
  bool operator==(const Setup&) const = default;
};

}  // namespace abradem::simulation
