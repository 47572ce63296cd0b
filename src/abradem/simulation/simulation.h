// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "abradem/contact/hertz_mindlin.h"
#include "abradem/core/archive.h"
#include "abradem/simulation/bulk.h"
#include "abradem/simulation/particles.h"
#include "abradem/simulation/setup.h"
#include "abradem/simulation/sphere_wall.h"
#include "abradem/simulation/wall.h"
#include "abradem/wear/wearing_tip.h"

namespace abradem::simulation {

/// What of the material lost is accounted for [m^3].
struct Ledger {
  double law = 0.0;            ///< removed: sum of alpha F_n |v_t| dt over the contacts
  double deposited = 0.0;      ///< booked in the elements; what was piled up on them counts negative
  double swept = 0.0;          ///< lost by the mesh
  double paper = 0.0;          ///< eq. 10-12 over the elements in contact
  double planes = 0.0;         ///< by the law off analytic planes, which keep their shape; in no other sum
  double displaced = 0.0;      ///< ploughed aside; law + displaced left the groove
  double piled = 0.0;          ///< … of it, found in the ridges
  double unpiled = 0.0;        ///< … of it, that found no place beside the contact
  double tip_law = 0.0;        ///< of the guided spheres' own wear: the law's volume
  double tip_deposited = 0.0;  ///< … booked in the maps of their tips
  double tip_removed = 0.0;    ///< … that these maps lack, by their shape
  /// Largest of |deposited - law| and, where the rule conserves, |swept - law|, over the volume that left the
  /// groove (without ploughing: over law); 0 without wear. With ploughing also |piled + unpiled - displaced|.
  double residual = 0.0;
  /// Largest of |tip_deposited - tip_law| and |tip_removed - tip_law| over tip_law; 0 without wear.
  double tip_residual = 0.0;
  /// swept / law, of the meshes that change their shape; 0 without wear or with rigid surfaces.
  double kappa = 0.0;

  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("law", self.law)("deposited", self.deposited)("swept", self.swept)("paper", self.paper)(
        "residual", self.residual)("kappa", self.kappa);
  }
};

/// Recession beyond which a tip counts as worn where its flat is measured [m].
inline constexpr double kFlatLevel = 1e-8;

/// The contact forces of one step, summed over the walls, for one particle.
struct ForceSample {
  double time = 0.0;        ///< [s]
  double normal = 0.0;      ///< |sum of F_n n| [N]
  double tangential = 0.0;  ///< |sum of F_t| [N]
  double overlap = 0.0;     ///< of the deepest contact [m]
  int contacts = 0;         ///< elements in contact
};

/// A limit on the time step: how far the run is from it.
struct StabilityLimit {
  std::string name;
  double value = 0.0;  ///< of the run, in the limit's own unit
  double limit = 0.0;
  std::string unit;
  [[nodiscard]] bool ok() const noexcept { return value <= limit; }
};

/// A discrete element simulation of spheres on walls that wear.
///
///     Simulation run(setup);
///     while (!run.finished()) run.step();
///
/// Same setup, same bits, whatever the number of threads. Not copyable into two that share; movable.
class Simulation {
 public:
  /// @throws InputError, GeometryError for a setup that cannot run
  explicit Simulation(Setup setup, const MeshSource& source = generate_mesh);

  /// One time step (`dynamic`) or one sliding increment (`quasi_static`).
  /// The step's chapters: move_walls, find_contacts, compute_forces, accumulate_wear, deform_walls,
  /// integrate, record (docs/architecture.md).
  /// @throws SimulationError when the state has left the range the equations hold in
  void step();

  /// Steps until the next output is due or the run ends. `watch` is called now and then (every few
  /// milliseconds); where it returns false the run pauses early. Returns true when an output is due.
  bool advance(const std::function<bool()>& watch = {});

  [[nodiscard]] bool finished() const noexcept { return steps_ >= total_steps_; }
  [[nodiscard]] double time() const noexcept { return static_cast<double>(steps_) * dt_; }
  [[nodiscard]] double time_step() const noexcept { return dt_; }
  [[nodiscard]] std::uint64_t steps() const noexcept { return steps_; }
  [[nodiscard]] std::uint64_t total_steps() const noexcept { return total_steps_; }
  /// Once the flow has settled.
  [[nodiscard]] std::uint64_t steps_per_output() const noexcept { return steps_per_output_; }
  /// Is an output due after the steps made so far? One is due where the flow has settled.
  [[nodiscard]] bool at_output() const noexcept { return due_after(steps_); }
  /// Intervals of the output that have passed; a whole number at every output.
  [[nodiscard]] double output_intervals() const noexcept;
  /// Turns (cycles) of the first wall that turns (oscillates); 0 where none does.
  /// They are revolutions of the test: with an acceleration more than the wall has turned.
  [[nodiscard]] double revolution() const noexcept;
  /// Seconds (revolutions) of the test that a modelled one stands for; 1 where wear is not accelerated.
  [[nodiscard]] double acceleration() const noexcept { return acceleration_; }
  /// Time of the test [s]: time() until the flow has settled, and acceleration() times what is modelled then.
  [[nodiscard]] double test_time() const noexcept {
    if (steps_ < settle_steps_) return std::min(time(), settle_);
    return settle_ + static_cast<double>(steps_ - settle_steps_) * dt_ * acceleration_;
  }
  /// Time at the start in which nothing wears; the test's and the model's [s].
  [[nodiscard]] double settle_time() const noexcept { return settle_; }
  /// Does the next step still belong to it?
  [[nodiscard]] bool settling() const noexcept { return steps_ < settle_steps_; }
  [[nodiscard]] bool turns() const noexcept { return period_ > 0.0; }
  /// Time of one of them [s]; 0 where nothing turns or oscillates.
  [[nodiscard]] double period() const noexcept { return period_; }

  [[nodiscard]] const Setup& setup() const noexcept { return setup_; }
  [[nodiscard]] const Particles& particles() const noexcept { return particles_; }
  [[nodiscard]] Particles& particles() noexcept { return particles_; }
  [[nodiscard]] const std::vector<Wall>& walls() const noexcept { return walls_; }
  [[nodiscard]] const SphereWall& contact(std::size_t particle, std::size_t wall) const {
    return sphere_walls_[particle * walls_.size() + wall];
  }
  [[nodiscard]] Ledger ledger();
  /// The largest residual of such books that is no fault [-]: 1e-9, and what rounding explains while next to
  /// nothing is worn.
  [[nodiscard]] double ledger_tolerance(const Ledger& books) const;
  /// The worn tip of particle p; nothing where it cannot wear.
  [[nodiscard]] const wear::WearingTip* tip(std::size_t p) const noexcept {
    return tips_[p] ? &*tips_[p] : nullptr;
  }
  /// Its law's volume [m^3].
  [[nodiscard]] double tip_law_volume(std::size_t p) const noexcept { return tip_law_[p]; }
  /// Directions of the axes s and t of the map of particle p's tip, in the world.
  [[nodiscard]] const Vec3& tip_along(std::size_t p) const noexcept { return tip_along_[p]; }
  [[nodiscard]] Vec3 tip_across(std::size_t p) const noexcept {
    return cross(tip_along_[p], particles_.guide[p]);
  }
  /// Does anything plough (a removed fraction below 1)?
  [[nodiscard]] bool ploughs() const noexcept { return removed_fraction() < 1.0; }
  /// Volume worn so far by the law off all meshes, as in the ledger [m^3]; cheap.
  [[nodiscard]] double law_volume() const noexcept;
  /// … off analytic planes, which have nothing to lose and stand outside the ledger's balance [m^3].
  [[nodiscard]] double plane_volume() const noexcept;
  /// Does any wall wear by another law than Archard's?
  [[nodiscard]] bool wears_by_laws() const noexcept;
  /// Does this wall?
  [[nodiscard]] bool wears_by_laws(std::size_t wall) const noexcept { return by_laws_[wall] != 0; }
  /// Volume that a wall has lost so far to each mechanism [m^3].
  [[nodiscard]] wear::MechanismVolumes law_volumes(std::size_t wall) const noexcept;
  /// The impacts on a wall so far, where it wears by impacts.
  [[nodiscard]] const wear::ImpactSpectrum& impacts_on(std::size_t wall) const noexcept {
    return account_[wall].impacts;
  }
  /// What a wall has suffered, element by element; nothing where no map is kept. In modelled revolutions:
  /// the test's are acceleration() times as much.
  [[nodiscard]] const wear::WearMap* map_of(std::size_t wall) const noexcept {
    return maps_[wall] ? &*maps_[wall] : nullptr;
  }
  /// Volume that an element has lost to each mechanism [m^3]; where a map is kept.
  [[nodiscard]] wear::MechanismVolumes mapped_volumes(std::size_t wall, std::size_t element) const;
  /// Regions of a wall, in the order of its map's: the named ones, then the rest of it.
  [[nodiscard]] std::vector<std::string> regions_of(std::size_t wall) const;
  /// How material `abrader` wears `worn`, accelerated as the run is.
  [[nodiscard]] const wear::Laws& wear_laws(int abrader, int worn) const {
    return laws_[static_cast<std::size_t>(abrader) * materials_.size() + static_cast<std::size_t>(worn)];
  }
  /// Forces of the last step on particle p.
  [[nodiscard]] ForceSample force_on(std::size_t p) const noexcept;
  /// The normal force of the last step on particle p by the elements that carry it, along and across its
  /// load (without one: the z axis), summed over the walls.
  [[nodiscard]] NormalParts normal_parts_on(std::size_t p) const noexcept;
  /// Elements of all walls that particle p touches.
  [[nodiscard]] int elements_in_contact(std::size_t p) const;
  /// Called after every step; for statistics and series.
  void on_step(std::function<void(const Simulation&)> observer) { observer_ = std::move(observer); }

  /// Limits known before the run, and after it with what it met (largest stiffness, number of contacts).
  [[nodiscard]] std::vector<StabilityLimit> limits() const;
  /// Hash of everything that the next step depends on.
  [[nodiscard]] std::uint64_t state_hash() const;
  /// Saves everything that the following steps depend on.
  void save(core::ArchiveWriter& archive) const;
  /// Puts a new run where save() left one of the same setup (the end apart) and the same meshes: it goes on
  /// to the same bits.
  /// @throws IoError when the archive is of something else, or damaged; the run is then of no use
  void load(core::ArchiveReader& archive);
  /// Particles in numbers and the contacts among spheres; none in a case of one particle.
  [[nodiscard]] const std::optional<Bulk>& bulk() const noexcept { return bulk_; }
  [[nodiscard]] BulkState bulk_state() const { return bulk_ ? bulk_->state(pairs_) : BulkState{}; }
  /// Sum of the contact forces of particles in numbers on a wall, at the last step [N].
  [[nodiscard]] Vec3 bulk_force_on_wall(std::size_t wall) const noexcept {
    return bulk_ ? bulk_->walls().force_on(wall) : Vec3{};
  }
  /// What the particles did to a wall in the last step: force, torque about the point that the wall's motion
  /// turns about (the origin where nothing moves), and the power that the wall spent on them (of a belt:
  /// where it is flat) [W].
  struct WallLoad {
    Vec3 force, torque;
    double power = 0.0;
  };
  [[nodiscard]] WallLoad load_on_wall(std::size_t wall) const noexcept;
  /// Kinetic energy of all particles [J].
  [[nodiscard]] double kinetic_energy() const noexcept;

 private:
  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive);

  void add_particles();
  [[nodiscard]] Surroundings surroundings() noexcept;
  void add_tips();
  void check_ploughing() const;
  [[nodiscard]] double removed_fraction() const noexcept {
    return setup_.ploughing ? setup_.ploughing->removed_fraction : 1.0;
  }
  /// Volume that leaves the groove per force and sliding distance [1/Pa].
  [[nodiscard]] double groove_coefficient(int abrader, int worn) const;
  void wear_tip(std::size_t p, std::size_t w);
  struct SlidingSphere {
    Vec3 x, v;  // [m], [m/s]
    double R;   // [m]
    int material;
  };
  void plough(SphereWall& contact, std::size_t w, const SlidingSphere& sphere, double groove_volume);
  [[nodiscard]] bool due_after(std::uint64_t steps) const noexcept {
    if (steps >= total_steps_ || steps == settle_steps_) return true;
    return steps < settle_steps_ ? steps % steps_per_settling_output_ == 0
                                 : (steps - settle_steps_) % steps_per_output_ == 0;
  }
  [[nodiscard]] bool output_due() const noexcept { return due_after(steps_ + 1); }
  void choose_time_step();
  void count_steps();
  /// Revolutions modelled while the wall wears; 0 where nothing turns.
  [[nodiscard]] double wearing_revolutions() const noexcept {
    return period_ > 0.0 ? (end_ - settle_) / period_ : 0.0;
  }
  [[nodiscard]] double choose_increment() const;
  void find_pair_properties();
  void choose_accounts();
  void choose_maps();
  [[nodiscard]] MapLayer map_layer(std::size_t wall, int abrader) noexcept;
  [[nodiscard]] const contact::PairProperties& pair(int a, int b) const {
    return pairs_[static_cast<std::size_t>(a) * setup_.materials.size() + static_cast<std::size_t>(b)];
  }
  void refuse_missing_pairs(const std::vector<char>& given) const;
  [[nodiscard]] double plane_wear(std::size_t wall) const;
  double plane_wear_by_laws(std::size_t wall);
  [[nodiscard]] double wear_coefficient(int abrader, int worn) const;

  void move_walls();
  void find_contacts();
  void compute_forces();
  void accumulate_wear();
  void book_wear();
  void deform_walls();
  void integrate();
  void record();

  void find_equilibrium(std::size_t p);
  [[nodiscard]] bool wears_by_speed(const Wall& wall) const noexcept;
  void book_bulk_wear();
  void fetch_elements(const WearRecords& records);
  double book_contact(SphereWall& contact, const WearRecords& records, const WearRecords::Record& record);
  void find_uses_of_wear();
  void book_elements();
  void limit_energies();
  void limit_bulk_energy(Vec3 low, Vec3 high, bool bounded);
  void check_state() const;
  [[nodiscard]] bool ledger_due() const noexcept;
  void check_ledger();
  void watch_stability();
  /// Parts of the limits that the spheres of an insertion reach.
  struct InsertionLimits {
    double rayleigh = 0.0, hertz = 0.0, number = 0.0;
  };
  [[nodiscard]] InsertionLimits limits_of(const Inserter& inserter) const;

  Setup setup_;
  std::vector<material::Material> materials_;
  std::vector<contact::PairProperties> pairs_;
  std::vector<double> wear_;      // alpha_s of (abrader, worn)
  std::vector<wear::Laws> laws_;  // of (abrader, worn)
  Particles particles_;
  std::vector<Wall> walls_;
  std::vector<geometry::Pose> poses_;
  std::vector<SphereWall> sphere_walls_;               // particle-major
  std::optional<Bulk> bulk_;                           // where spheres can meet spheres, or come in numbers
  std::vector<double> law_, paper_;                    // per wall [m^3]
  std::vector<double> displaced_;                      // per wall, ploughed aside [m^3]
  std::vector<char> by_laws_;                          // per wall: it wears by others than Archard's
  std::vector<WearUse> wear_use_;                      // walls x materials
  std::vector<WearUse> no_wear_;                       // likewise, while the flow settles
  WearRecords records_;                                // scratch: of one named particle on one wall
  std::vector<WearAccount> account_;                   // per wall, where it does
  std::vector<std::optional<wear::WearMap>> maps_;     // per wall
  std::vector<std::optional<wear::WearingTip>> tips_;  // per particle
  std::vector<Vec3> tip_along_;                        // per particle: axis s of its tip's map
  std::vector<double> tip_law_;                        // per particle [m^3]
  double dt_ = 0.0, period_ = 0.0, end_ = 0.0, acceleration_ = 1.0;  // end: modelled
  double settle_ = 0.0, settling_output_ = 0.0;                      // how long; between its outputs [s]
  std::uint64_t steps_ = 0, total_steps_ = 0, steps_per_output_ = 1;
  std::uint64_t settle_steps_ = 0, steps_per_settling_output_ = 1;
  std::function<void(const Simulation&)> observer_;
  std::vector<double>
      stiffness_ratio_;         // quasi_static: of each particle's contact, to Hertz's; 0: not measured yet
  double worst_damping_ = 0.0;  // largest 2 g + W met
  std::vector<double> growth_;  // of a disturbance of each particle, while its steps are too long: ln [-]
  std::vector<double> energy_limit_;  // kinetic, of each particle: none that moves rightly has it [J]
};

/// Resolves a duration to seconds. @throws InputError when it is in revolutions and nothing turns
[[nodiscard]] double seconds_of(const Duration& duration, double period);

}  // namespace abradem::simulation
