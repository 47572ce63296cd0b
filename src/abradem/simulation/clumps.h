// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "abradem/contact/sphere_forces.h"
#include "abradem/core/hash.h"
#include "abradem/geometry/quaternion.h"
#include "abradem/simulation/setup.h"

/// Particles of several spheres that keep together. docs/theory/clumps.md
namespace abradem::simulation {

/// A shape in its principal axes, its centre of mass at the origin; lengths in units of the radius of the
/// sphere of equal volume.
struct ClumpShape {
  std::string name;
  std::vector<geometry::Ball> spheres;
  Vec3 inertia;           ///< principal moments over density times that radius to the fifth [-]
  double radius = 0.0;    ///< of the sphere of equal volume, as the shape was given [m]
  double bounding = 0.0;  ///< radius about the centre that holds all spheres [-]
  double smallest = 0.0, largest = 0.0;  ///< radius of a sphere [-]
  geometry::Quaternion turn;             ///< at which it stands as it was given
};
/// @throws InputError for a shape without spheres, or with one of no size
[[nodiscard]] ClumpShape clump_shape(const ShapeSetup& setup);

/// The setup with its named clumps as what they move as: insertions of one particle each, before the others.
/// Without any it stays as it is. @throws InputError for one of no known shape, or that is held or loaded
[[nodiscard]] Setup clumps_in_numbers(Setup setup);

/// Turns a rigid body on which no torque acts, by one time step. Rotations about the principal axes 3, 2, 1,
/// 2, 3, each exact, make a symplectic, reversible step of second order that keeps the angular momentum
/// exactly [Dullweber, Leimkuhler & McLachlan 1997, 10.1063/1.474310, sec. III; as NO_SQUISH, Miller et al.
/// 2002, 10.1063/1.1473654].
/// @param momentum angular, in the world [kg m^2/s]   @param inertia principal moments [kg m^2]
void rotate_freely(geometry::Quaternion& turn, const Vec3& momentum, const Vec3& inertia, double dt) noexcept;

/// One clump that moves.
struct Clump {
  std::int32_t id = 0;            ///< for life
  std::int32_t shape = 0;         ///< number of the shape
  std::int32_t first_sphere = 0;  ///< id of its first sphere; the others follow
  std::int32_t material = 0;
  double radius = 0.0;        ///< of the sphere of equal volume [m]
  double mass = 0.0;          ///< [kg]
  Vec3 inertia;               ///< principal moments [kg m^2]
  Vec3 position;              ///< of the centre of mass [m]
  Vec3 velocity;              ///< [m/s]
  Vec3 momentum;              ///< angular, about the centre, in the world [kg m^2/s]
  geometry::Quaternion turn;  ///< from the principal axes to the world
  Vec3 force, torque;         ///< of the contacts, at the last step [N], [N m]

  /// Angular velocity [rad/s].
  [[nodiscard]] Vec3 spin() const noexcept {
    const Vec3 l = turn.turn_back(momentum);
    return turn.turn({l.x / inertia.x, l.y / inertia.y, l.z / inertia.z});
  }
  [[nodiscard]] double rotational_energy() const noexcept { return 0.5 * dot(spin(), momentum); }
  [[nodiscard]] double kinetic_energy() const noexcept {
    return 0.5 * mass * norm2(velocity) + rotational_energy();
  }

  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("id", self.id)("shape", self.shape)("first_sphere", self.first_sphere);
    archive("material", self.material)("radius", self.radius)("mass", self.mass)("inertia", self.inertia);
    archive("position", self.position)("velocity", self.velocity)("momentum", self.momentum);
    archive("w", self.turn.w)("x", self.turn.x)("y", self.turn.y)("z", self.turn.z);
    archive("force", self.force)("torque", self.torque);
  }
};

/// The clumps among the particles in numbers. Their spheres are rows of `Spheres` as all others are, with the
/// mass of the whole clump, and find contacts as all others do; here their loads are gathered, the clumps
/// move, and the rows follow.
class Clumps {
 public:
  Clumps() = default;
  explicit Clumps(std::vector<ClumpShape> shapes) : shapes_(std::move(shapes)) {}

  /// Where a new clump is put, how large it is and how it moves.
  struct Birth {
    std::int32_t shape = 0, material = 0;
    double radius = 0.0, density = 0.0;
    Vec3 position, velocity, spin;
    geometry::Quaternion turn;
  };
  /// Adds one, and its spheres with the ids that follow `next_id`.
  void add(const Birth& birth, contact::Spheres& spheres, std::int32_t& next_id);

  [[nodiscard]] bool empty() const noexcept { return clumps_.empty(); }
  [[nodiscard]] std::size_t size() const noexcept { return clumps_.size(); }
  [[nodiscard]] const std::vector<Clump>& clumps() const noexcept { return clumps_; }
  [[nodiscard]] const std::vector<ClumpShape>& shapes() const noexcept { return shapes_; }
  [[nodiscard]] const ClumpShape& shape_of(const Clump& c) const noexcept {
    return shapes_[static_cast<std::size_t>(c.shape)];
  }

  /// Marks all spheres of the clumps of which `gone[k] != 0` to be taken out at the next rebuild.
  void take_out(const std::vector<std::uint8_t>& gone, contact::Spheres& spheres) const;
  /// After a rebuild: forgets clumps without spheres, brings centres back into the period (0: open) that
  /// begins at `low`, and finds the spheres in their new order.
  void settle(contact::Spheres& spheres, const Vec3& low, const Vec3& period);
  /// Gathers what acts on the spheres of each clump about its centre, in the order of its spheres, and takes
  /// it from their rows (the stiffening stays). Forces are those at the present positions.
  void take_loads(contact::LoadRows& load);
  /// Forces, gravity and torques change the momenta; the new momenta move and turn the clumps; their spheres
  /// follow, with velocities v + w x r. What is met is added to `met`.
  void advance(contact::Spheres& spheres, const contact::LoadRows& load, const Vec3& gravity, double dt,
               contact::Advance& met);

  /// By how much a force of 1 N along any line through the centre of one of a clump's spheres speeds it up
  /// there, at most [1/kg].
  [[nodiscard]] double response(const Clump& c) const noexcept;

  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("clumps", self.clumps_)("next_clump", self.next_clump_);
  }
  /// @return whether what was loaded fits the spheres
  [[nodiscard]] bool restore(const contact::Spheres& spheres, const Vec3& period);
  void add_to(core::StateHash& hash) const;

 private:
  [[nodiscard]] bool locate(const contact::Spheres& spheres, const Vec3& period);
  [[nodiscard]] bool sound(const Clump& c) const noexcept;
  void place(const Clump& c, std::size_t n, contact::Spheres& spheres) const noexcept;

  std::vector<ClumpShape> shapes_;
  std::vector<Clump> clumps_;
  std::int32_t next_clump_ = 0;
  std::vector<std::size_t> start_;    // of each clump in member_; one more than clumps
  std::vector<std::int32_t> member_;  // rows of the spheres, clump by clump
  std::vector<Vec3> image_;           // of each: from the clump's own image to where the row is [m]
};

}  // namespace abradem::simulation
