// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "abradem/contact/sphere_forces.h"
#include "abradem/core/hash.h"
#include "abradem/simulation/bulk_stability.h"
#include "abradem/simulation/bulk_walls.h"
#include "abradem/simulation/clumps.h"
#include "abradem/simulation/insertion.h"
#include "abradem/simulation/particles.h"

namespace abradem::simulation {

/// What became of the particles in numbers so far, and how they move now. A clump counts as one.
struct BulkState {
  std::uint64_t inserted = 0, removed = 0, present = 0;
  double mass = 0.0, removed_mass = 0.0;  ///< [kg]
  std::uint64_t pair_contacts = 0, wall_contacts = 0;
  double kinetic_energy = 0.0;  ///< [J]
  double elastic_energy = 0.0;  ///< normal, among the spheres; without adhesion and cohesion [J]
  double fastest = 0.0;         ///< [m/s]
};

/// Spheres among themselves: all contacts between spheres of a case, and everything about those that come in
/// numbers. Named particles lead a double life here: `Particles` holds them, moves them and brings them to
/// the walls; this engine sees copies of them (ids 0 … named - 1) and returns the forces of their contacts.
///
/// The methods are chapters of the simulation's step (docs/architecture.md#particles-in-numbers).
class Bulk {
 public:
  /// @param materials densities are taken from them   @param shapes of setup.shapes, in their order
  Bulk(const Setup& setup, const std::vector<material::Material>& materials,
       const std::vector<material::PairProperties>& properties, const Particles& named,
       const std::vector<ClumpShape>& shapes, std::span<const Wall> walls);

  /// Takes in what is due for insertion and takes out what has left; makes the lists anew when they have worn
  /// out; finds the contacts with the walls.
  void find_contacts(const Surroundings& around, const Particles& named, std::vector<double>& paper);
  /// Forces of the walls on those in numbers, and, where others than integrate() ask for them, of all on all;
  /// adds their share to the named ones.
  void compute_forces(const Surroundings& around, Particles& named);
  /// Moves them; where nobody has asked for the forces among them, finds these on the way.
  void integrate(const Surroundings& around);
  /// @throws SimulationError naming a particle when the state has left the range that the equations hold in
  void check(const Surroundings& around, std::uint64_t step) const;
  /// A sphere that is faster stops the run: its energy explodes [m/s].
  void limit_speed(double speed) noexcept { fastest_allowed_ = speed; }
  /// @throws SimulationError when the step is too long for the contacts, unless `then` is to go on
  void watch_stability(const Surroundings& around, std::uint64_t step, Stability then);

  [[nodiscard]] BulkWalls& walls() noexcept { return walls_; }
  [[nodiscard]] const BulkWalls& walls() const noexcept { return walls_; }
  /// All spheres, in the order of the engine; ids below named() are the named ones.
  [[nodiscard]] const contact::Spheres& spheres() const noexcept { return spheres_; }
  [[nodiscard]] const contact::SphereList& list() const noexcept { return list_; }
  /// Those of several spheres; what acts on their spheres is handed over to them.
  [[nodiscard]] const Clumps& clumps() const noexcept { return clumps_; }
  [[nodiscard]] std::int32_t named() const noexcept { return named_; }
  /// Forces of the last step's contacts, in the order of spheres(); those of named particles are handed over.
  [[nodiscard]] const contact::LoadRows& loads() const noexcept { return load_; }
  [[nodiscard]] const std::vector<Inserter>& inserters() const noexcept { return inserters_; }
  /// Largest 2 g + W met. docs/theory/time-step.md
  [[nodiscard]] double worst_stability() const noexcept { return stability_.worst(); }
  /// Largest speed met [m/s].
  [[nodiscard]] double fastest() const noexcept { return fastest_; }
  [[nodiscard]] BulkState state(const std::vector<material::PairProperties>& properties) const;
  /// Adds everything that the next step depends on.
  void add_to(core::StateHash& hash) const;

  /// All that lasts from one step to the next, for core/archive.h; restore() follows a load.
  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("spheres", self.spheres_)("list", self.list_)("walls", self.walls_)("clumps", self.clumps_);
    for (auto& inserter : self.inserters_) archive("inserter", inserter);
    archive("next_id", self.next_id_)("skin", self.skin_)("travelled", self.travelled_);
    archive("margin", self.margin_)("near_at", self.near_at_)("fastest_now", self.met_.fastest2);
    archive("wall_time", self.wall_time_)("worn_out", self.worn_out_);
    archive("stability", self.stability_)("fastest", self.fastest_);
    archive("removed", self.removed_)("removed_mass", self.removed_mass_);
  }
  /// @return whether what was loaded fits the case
  [[nodiscard]] bool restore(const Surroundings& around);

 private:
  [[nodiscard]] bool needs_loads() const noexcept { return named_ > 0 || !clumps_.empty(); }
  void take_in(double time, std::span<const Wall> walls, std::span<const geometry::Pose> poses);
  void refuse_buried(const Inserter& inserter, std::size_t first, double time, std::span<const Wall> walls);
  [[nodiscard]] bool is_inside(std::size_t w, const Wall& wall, const Vec3& c);
  [[nodiscard]] double longest_stretch() const;
  void check_periods() const;
  [[nodiscard]] double margin(double dt);
  void take_out();
  void take_out_clumps();
  [[nodiscard]] bool in_clump(std::size_t i) const noexcept {
    return !spheres_.clump.empty() && spheres_.clump[i] >= 0;
  }
  [[nodiscard]] std::string title(std::size_t i) const;
  void find_named();
  void check_motion(const Surroundings& around, std::uint64_t step) const;
  void check_overlaps(const Surroundings& around, std::uint64_t step) const;
  void fetch_named(const Particles& named);
  [[noreturn]] void fail(std::size_t i, const std::string& what, const Surroundings& around,
                         std::uint64_t step,
                         const char* advice =
                             ". Shorten the time step, or check the stiffness, the speeds "
                             "and the starting positions") const;

  contact::Spheres spheres_;
  Clumps clumps_;
  contact::SphereList list_;
  contact::PairTable table_;
  contact::LoadRows load_;
  BulkWalls walls_;
  std::vector<Inserter> inserters_;
  std::vector<std::optional<bool>> solid_;  // of each wall that was asked: does it bound a solid?
  std::optional<DomainSetup> domain_;
  Vec3 period_;  // 0 along open axes
  std::vector<std::size_t> place_of_named_;
  std::vector<std::string> names_;
  std::int32_t named_ = 0, next_id_ = 0;
  double skin_ = 0.0, travelled_ = 0.0, wall_time_ = 0.0;  // since the lists were made
  double margin_ = 0.0,
         near_at_ = 0.0;  // of the near pairs, and what had been travelled when they were found
  bool worn_out_ = true, pairs_sound_ = true, walls_sound_ = true;
  contact::Advance met_;
  BulkStability stability_;
  double removed_mass_ = 0.0, fastest_ = 0.0, fastest_allowed_ = std::numeric_limits<double>::infinity();
  std::uint64_t removed_ = 0;
};

}  // namespace abradem::simulation
