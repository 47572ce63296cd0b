// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "abradem/contact/sphere_rows.h"
#include "abradem/core/random.h"
#include "abradem/geometry/triangle_mesh.h"
#include "abradem/simulation/clumps.h"
#include "abradem/simulation/setup.h"

namespace abradem::simulation {

/// A random radius from a distribution of sizes, cut off at its bounds by drawing again. [m]
[[nodiscard]] double draw_radius(const SizeSetup& size, core::RandomStream& random);
/// Smallest and largest radius that can be drawn [m].
[[nodiscard]] double smallest_radius(const SizeSetup& size) noexcept;
[[nodiscard]] double largest_radius(const SizeSetup& size) noexcept;
/// Of an insertion, given places included [m].
[[nodiscard]] double smallest_radius(const InsertionSetup& insertion) noexcept;
[[nodiscard]] double largest_radius(const InsertionSetup& insertion) noexcept;

/// Bounding box of a box or a cylinder [m], and its volume [m^3].
[[nodiscard]] geometry::BoundingBox box_of(const VolumeSetup& volume);
[[nodiscard]] double volume_of(const VolumeSetup& volume);

/// Brings the particles of one [insertion] into the run: at once, or at a rate. Each is tried at random
/// places of the volume until it overlaps no other and no wall; one that finds none waits, so that the size
/// distribution is kept. Of a shape that is no sphere each is turned at random, uniformly over all rotations,
/// and waits as it is turned; the sphere about it stays inside the volume, and its own spheres overlap no
/// other.
class Inserter {
 public:
  using Clear = std::function<bool(const Vec3&, double)>;

  /// @param setup must outlive this; it is not copied   @param density of the material [kg/m^3]   @param
  /// stream number of the random stream; that of the turns is far from it   @param shape null: spheres
  /// @throws InputError when the largest does not go into the volume
  Inserter(const InsertionSetup& setup, int material, double density, std::uint64_t seed,
           std::uint64_t stream, const ClumpShape* shape = nullptr);

  /// Spheres that are due by a time and find a place. Call at steps where `wants` says so.
  /// @throws InputError at time 0 when those to be inserted at once do not all find a place
  /// @param period lengths after which space repeats itself; 0 along open axes [m]
  /// @param clear does a sphere (centre, radius) overlap no wall? Empty: there are none
  [[nodiscard]] std::vector<contact::SphereRow> insert(double time, const contact::Spheres& present,
                                                       const Vec3& period = {}, const Clear& clear = {});
  /// The same where a shape is given; the number of the shape is left open.
  [[nodiscard]] std::vector<Clumps::Birth> insert_clumps(double time, const contact::Spheres& present,
                                                         const Vec3& period = {}, const Clear& clear = {});
  [[nodiscard]] bool wants(double time) const noexcept { return time >= next_; }
  /// Null: spheres.
  [[nodiscard]] const ClumpShape* shape() const noexcept { return shape_ ? &*shape_ : nullptr; }
  /// Radius of the smallest sphere that can come in, a clump's among them [m].
  [[nodiscard]] double smallest_sphere() const noexcept {
    return smallest_radius(*setup_) * (shape_ ? shape_->smallest : 1.0);
  }

  [[nodiscard]] const InsertionSetup& setup() const noexcept { return *setup_; }
  [[nodiscard]] std::uint64_t inserted() const noexcept { return inserted_; }
  [[nodiscard]] double inserted_mass() const noexcept { return mass_; }
  /// Spheres due that found no place in their last try.
  [[nodiscard]] bool waiting() const noexcept { return waiting_; }

  /// What is drawn and counted so far, for core/archive.h.
  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("random", self.random_)("radius", self.radius_)("next", self.next_)("mass", self.mass_);
    archive("inserted", self.inserted_)("waiting", self.waiting_);
    archive("turns", self.turns_)("w", self.turn_.w)("x", self.turn_.x)("y", self.turn_.y)("z", self.turn_.z);
  }
  /// @return whether what was loaded can be of this insertion
  [[nodiscard]] bool restored() const noexcept;

 private:
  [[nodiscard]] bool due(double time, double next_mass) const noexcept;
  [[nodiscard]] Vec3 draw_place(double radius);
  void draw_next();
  void refuse_too_small_a_volume() const;
  [[noreturn]] void refuse_full_volume() const;
  [[nodiscard]] std::vector<Clumps::Birth> bring_in(double time, const contact::Spheres& present,
                                                    const Vec3& period, const Clear& clear);

  const InsertionSetup* setup_;  // of the run: its list of places may be long
  int material_;
  double density_;
  core::RandomStream random_;
  core::RandomStream turns_;
  std::optional<ClumpShape> shape_;
  double radius_ = 0.0;        // of the next one
  geometry::Quaternion turn_;  // likewise
  double next_ = 0.0, mass_ = 0.0;
  std::uint64_t inserted_ = 0;
  bool waiting_ = false;
};

}  // namespace abradem::simulation
