// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "abradem/contact/sphere_rows.h"
#include "abradem/core/random.h"
#include "abradem/geometry/triangle_mesh.h"
#include "abradem/simulation/setup.h"

namespace abradem::simulation {

/// A random radius from a distribution of sizes, cut off at its bounds by drawing again. [m]
[[nodiscard]] double draw_radius(const SizeSetup& size, core::RandomStream& random);
/// Smallest and largest radius that can be drawn [m].
[[nodiscard]] double smallest_radius(const SizeSetup& size) noexcept;
[[nodiscard]] double largest_radius(const SizeSetup& size) noexcept;
/// Of an insertion, given places included [m].
[[nodiscard]] double smallest_radius(const InsertionSetup& insertion) noexcept;

/// Bounding box of a box or a cylinder [m], and its volume [m^3].
[[nodiscard]] geometry::BoundingBox box_of(const VolumeSetup& volume);
[[nodiscard]] double volume_of(const VolumeSetup& volume);

/// Brings the spheres of one [insertion] into the run: at once, or at a rate. Each is tried at random places
/// of the volume until it overlaps no other; one that finds none waits, so that the size distribution is
/// kept.
class Inserter {
 public:
  /// @param density of the material [kg/m^3]   @param stream number of the random stream
  Inserter(const InsertionSetup& setup, int material, double density, std::uint64_t seed,
           std::uint64_t stream);

  /// Spheres that are due by a time and find a place. Call at steps where `wants` says so.
  /// @throws InputError at time 0 when those to be inserted at once do not all find a place
  [[nodiscard]] std::vector<contact::SphereRow> insert(double time, const contact::Spheres& present);
  [[nodiscard]] bool wants(double time) const noexcept { return time >= next_; }

  [[nodiscard]] const InsertionSetup& setup() const noexcept { return setup_; }
  [[nodiscard]] std::uint64_t inserted() const noexcept { return inserted_; }
  [[nodiscard]] double inserted_mass() const noexcept { return mass_; }
  /// Spheres due that found no place in their last try.
  [[nodiscard]] bool waiting() const noexcept { return waiting_; }

  /// What is drawn and counted so far, for core/archive.h.
  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("random", self.random_)("radius", self.radius_)("next", self.next_)("mass", self.mass_);
    archive("inserted", self.inserted_)("waiting", self.waiting_);
  }

 private:
  [[nodiscard]] bool due(double time, double next_mass) const noexcept;
  [[nodiscard]] Vec3 draw_place(double radius);
  void draw_next();

  InsertionSetup setup_;
  int material_;
  double density_;
  core::RandomStream random_;
  double radius_ = 0.0;  // of the next one
  double next_ = 0.0, mass_ = 0.0;
  std::uint64_t inserted_ = 0;
  bool waiting_ = false;
};

}  // namespace abradem::simulation
