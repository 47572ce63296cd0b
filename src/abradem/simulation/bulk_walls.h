// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <memory>

#include "abradem/contact/plane_forces.h"
#include "abradem/contact/sphere_list.h"
#include "abradem/simulation/near_grid.h"
#include "abradem/simulation/sphere_wall.h"
#include "abradem/simulation/surroundings.h"

namespace abradem::simulation {

/// Contacts of particles in numbers with the walls. A wall is searched only by those near it, which are
/// listed whenever the list of neighbours is made anew; a sphere beside a mesh then has a SphereWall of its
/// own, with the wall's contact rule, memory and wear, and one beside a plane a row of a PlaneList.
class BulkWalls {
 public:
  /// One sphere beside one mesh.
  struct NearMesh {
    std::int32_t sphere = 0;  ///< index in the order now
    std::int32_t id = 0, wall = 0;
    double clear = 0.0;     ///< it cannot touch before it and the wall have moved so far [m]
    double come = 0.0;      ///< how far they have, since the rebuild [m]
    bool awake = true;      ///< it might touch, in this step
    contact::FreeWay way;   ///< on which it cannot touch
    bool owes = false;      ///< its contact owes the wall elements
    double expected = 0.0;  ///< largest force met [N]
    std::unique_ptr<SphereWall> contact;
    contact::LoadRow load;  ///< on the sphere, world frame

    template <typename Self, typename Archive>
    static void visit(Self& self, Archive& archive) {
      archive("sphere", self.sphere)("id", self.id)("wall", self.wall)("clear", self.clear);
      archive("expected", self.expected)("load", self.load);
      if constexpr (Archive::kLoading) self.contact = std::make_unique<SphereWall>();
      archive("contact", *self.contact);
      if constexpr (Archive::kLoading) self.owes = self.contact->owes_elements();
    }
  };

  explicit BulkWalls(std::size_t walls)
      : planes_(walls), grids_(walls), odometer_(walls, 0.0), unplaced_(walls, 0.0) {}

  /// Lists the spheres within `skin` of each wall; those with id < first_id are none of ours.
  /// What a contact that is no longer near still owes its wall is settled.
  void rebuild(const contact::Spheres& spheres, const Surroundings& around, double skin, int first_id,
               std::vector<double>& paper);
  /// First part of the search, in the order of spheres: who might touch; what their last candidates still owe
  /// the walls.
  /// @param travelled how far any sphere and any wall may have moved against each other since the rebuild [m]
  void prepare(const contact::Spheres& spheres, const Surroundings& around, double travelled);
  /// Finds the contacts, the walls' forces, and what they do to the walls. @return false when a sphere is too
  /// deep in a wall
  [[nodiscard]] bool compute(const contact::Spheres& spheres, const Surroundings& around);
  /// Adds them to the loads of spheres begin … end - 1.
  void add_loads(std::size_t begin, std::size_t end, contact::LoadRows& load) const;

  [[nodiscard]] std::vector<NearMesh>& meshes() noexcept { return meshes_; }
  [[nodiscard]] const std::vector<NearMesh>& meshes() const noexcept { return meshes_; }
  /// Of each wall; empty where it is a mesh.
  [[nodiscard]] const std::vector<contact::PlaneList>& planes() const noexcept { return planes_; }
  /// What the contacts with meshes did to them in the last step, in the order of meshes(), which they name.
  [[nodiscard]] const std::vector<WearRecords>& wear() const noexcept { return wear_; }
  /// Sum of the contact forces on a wall at the last step [N].
  [[nodiscard]] Vec3 force_on(std::size_t wall) const noexcept;
  /// Ploughed aside by spheres that are gone since, where the wall had no place for it [m^3].
  [[nodiscard]] double unplaced(std::size_t wall) const noexcept { return unplaced_[wall]; }
  /// How fast any point of a wall within reach of the spheres moves [m/s].
  [[nodiscard]] double fastest_wall() const noexcept { return fastest_wall_; }
  [[nodiscard]] std::size_t contacts() const noexcept;
  /// Time at which the next wall is taken away, and the lists with it [s]; infinite: none is.
  [[nodiscard]] double next_removal() const noexcept { return next_removal_; }

  /// Who is near which wall, and what each contact remembers, for core/archive.h; restore() follows a load.
  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive.fixed("planes", self.planes_)("meshes", self.meshes_).fixed("odometer", self.odometer_);
    archive.fixed("unplaced", self.unplaced_);
    archive("fastest_wall", self.fastest_wall_)("next_removal", self.next_removal_);
  }
  /// @return whether what was loaded fits the spheres and the walls
  [[nodiscard]] bool restore(const contact::Spheres& spheres, const Surroundings& around);

 private:
  [[nodiscard]] static bool sleeps_on(const NearMesh& m, const contact::SphereRow& s,
                                      const Surroundings& around) noexcept;
  static void prepare(NearMesh& m, const contact::SphereRow& s, const Surroundings& around);
  bool compute(std::size_t k, const contact::SphereRow& s, const Surroundings& around, WearRecords& records);
  void find_constants(const Surroundings& around);
  void list_meshes(const contact::Spheres& spheres, const Surroundings& around, double skin, int first_id,
                   std::vector<double>& paper);

  std::vector<contact::PlaneList> planes_;
  std::vector<NearGrid> grids_;                    // of each mesh wall
  std::vector<NearMesh> meshes_;                   // by sphere, then wall
  std::vector<WearRecords> wear_;                  // of kPart of them after another
  std::vector<double> odometer_;                   // of each wall's wear at the rebuild [m]
  std::vector<double> unplaced_;                   // on each wall, ploughed by contacts that are gone [m^3]
  std::vector<contact::PairConstants> constants_;  // walls x materials
  bool options_ = false;                           // has any of them
  double fastest_wall_ = 0.0, next_removal_ = std::numeric_limits<double>::infinity();
};

}  // namespace abradem::simulation
