// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "abradem/contact/candidate_kernels.h"
#include "abradem/contact/patch.h"
#include "abradem/contact/point_contacts.h"
#include "abradem/core/hash.h"
#include "abradem/simulation/wall.h"
#include "abradem/wear/archard.h"
#include "abradem/wear/footprint.h"
#include "abradem/wear/laws.h"
#include "abradem/wear/ridges.h"
#include "abradem/wear/wear_map.h"
#include "abradem/wear/wearing_tip.h"

namespace abradem::simulation {

/// One sphere as a wall sees it: world frame.
struct SphereState {
  Vec3 position, velocity, spin;
  double radius = 0.0, mass = 0.0;
};

/// What a wall has lost to each mechanism, and to which impacts.
struct WearAccount {
  wear::MechanismVolumes law{};  ///< [m^3]
  wear::ImpactSpectrum impacts;

  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("law", self.law)("impacts", self.impacts);
  }
};

/// Where a contact's wear is mapped; nowhere, where there is no layer.
struct MapLayer {
  wear::WearMap* map = nullptr;
  wear::WearMap::Layer* layer = nullptr;
};

/// What falls on one triangle of a contact's wear, as parts of the whole: in all, and at its corners.
struct WearShare {
  geometry::Index triangle = 0;
  geometry::Triangle vertex{};
  double whole = 0.0, at0 = 0.0, at1 = 0.0, at2 = 0.0;
  double area = 0.0;  ///< of the triangle [m^2]
};
/// What contacts did to walls in one step, until it is booked.
struct WearRecords {
  struct Record {
    std::int32_t contact = 0, wall = 0, material = 0;  ///< whose it is
    bool nodal = false;                                ///< it lies on candidate nodes
    std::size_t first = 0, end = 0;                    ///< its places in `node`, or else in `share`
    wear::MapSample sample;                            ///< but for the volumes
  };
  std::vector<Record> record;
  std::vector<WearShare> share;
  std::vector<double> node;  ///< load of each of the first candidate nodes
  void clear() noexcept {
    record.clear();
    share.clear();
    node.clear();
  }
};

struct ForceAndTorque {
  Vec3 force, torque;
};

/// How the normal force stands on the elements that carry it: the sum of their parts F_i. The directions of
/// the parts across the axis cancel in the resultant; their sizes do not.
struct NormalParts {
  double along = 0.0;   ///< sum of F_i . axis [N]
  double across = 0.0;  ///< sum of |F_i - (F_i . axis) axis| [N]
  double sum = 0.0;     ///< sum of |F_i| [N]
};

/// Everything between one sphere and one wall: what it touches, what each contact remembers, the force, and
/// the wear it leaves. The step calls find, then compute, then deposit.
class SphereWall : public core::InSmallBlocks {
 public:
  /// One contact, in the wall's frame.
  struct Touch {
    Vec3 n;                      ///< from the wall to the sphere
    Vec3 point;                  ///< on the sphere's surface
    double overlap = 0.0;        ///< [m]
    double elastic_force = 0.0;  ///< [N]
    double a = 0.0;              ///< contact radius sqrt(R overlap) [m]
    double deepest = 0.0;        ///< largest local overlap [m]
    int key = -1;                ///< per_triangle: mesh triangle
    int part = 0;                ///< patch or flat set that it stands for
    int nearest = -1;            ///< point contacts: candidate triangle that holds the nearest point
    bool of_point = false;       ///< a point contact, not a patch
    double damper_power = 0.0;   ///< of the normal damper, of a pair with options in this step [W]
    double weight = 1.0;  ///< `automatic`: share of the rule in the force, which all forces here have [-]
    contact::ContactForce force;
    int memory = -1;  ///< place of its memory in this step; -1: none

    template <typename Self, typename Archive>
    static void visit(Self& self, Archive& archive) {
      archive("n", self.n)("point", self.point)("overlap", self.overlap);
      archive("elastic_force", self.elastic_force)("a", self.a)("deepest", self.deepest);
      archive("key", self.key)("part", self.part)("nearest", self.nearest)("force", self.force);
      archive("of_point", self.of_point)("weight", self.weight);
    }
  };

 private:
  struct Memory {
    Vec3 n, point;
    int key = -1;
    contact::TangentialHistory history;
    bool used = false;
    bool of_point = false;
    // Where the wall wears by impacts: how this one began, until the sphere no longer comes closer.
    double speed = 0.0, angle = 0.0;  // [m/s], from the surface [rad]
    bool approaching = false;
    bool striking = false;  // it has just ceased to
    bool fresh = false;     // it begins in this step

    template <typename Self, typename Archive>
    static void visit(Self& self, Archive& archive) {
      archive("n", self.n)("point", self.point)("key", self.key)("history", self.history);
      archive("speed", self.speed)("angle", self.angle)("approaching", self.approaching);
      archive("of_point", self.of_point);
    }
  };

 public:
  /// What one step needs and nobody asks for afterwards. Objects that are used one after another may share
  /// one (lend): then it stays in the fast memory, and there may be thousands of them.
  struct Scratch {
    contact::PointContactFinder::Findings points;
    wear::FootprintIntegrator footprint;
    std::vector<WearShare> shares;  // of the last landing
    std::vector<char> mask;
    core::PooledVector<Memory> kept;  // what the contacts of this step go on with
  };
  /// Null: it has its own. What ploughs must not share.
  void lend(Scratch* scratch) noexcept {
    scratch_ = scratch;
    points_.lend(scratch != nullptr ? &scratch->points : nullptr);
  }

  /// Asks the memory for what the next step of a point contact reads: first this object, then, when that is
  /// there, its arrays.
  void fetch() const noexcept {
    const auto* from = reinterpret_cast<const char*>(this);
    core::prefetch(from, static_cast<std::size_t>(reinterpret_cast<const char*>(&tip_) - from));
  }
  void fetch_arrays() const noexcept {
    if (near_) {
      near_->few.fetch();
    } else {
      candidates_.fetch();
      points_.fetch();
    }
    const auto ask = [](const auto& list) {
      if (!list.empty()) core::prefetch(list.data(), sizeof list.front());
    };
    ask(touches_);
    ask(memory_);
  }

  /// First part of the search: settles what the last candidates still owe the wall. Where they owe it
  /// elements (owes_elements), in the order of particles; else it touches nothing but this object.
  /// @param c,v position and velocity of the sphere in the wall's frame
  /// @param load a force of the size to be expected, for the margin of the search [N]
  void prepare(Wall& wall, const Vec3& c, const Vec3& v, double R, const contact::PairProperties& pair,
               double load, double dt);
  /// Finds the contacts of the sphere at c, in the wall's frame. Touches nothing but this object: many may
  /// run at once.
  void find(const Wall& wall, const Vec3& c, double R, const contact::PairProperties& pair);

  /// Were the contacts of this step found among few triangles, without a search?
  [[nodiscard]] bool is_near() const noexcept { return is_near_; }
  /// After a find without contacts: where the sphere may go before there can be one.
  [[nodiscard]] contact::FreeWay free_way(const Wall& wall) const noexcept;

  /// The wall is gone: no contacts, and none remembered.
  void let_go() noexcept {
    touches_.clear();
    memory_.clear();
  }

  /// Forces of the contacts found [world frame], and their histories one step on.
  ForceAndTorque compute(const Wall& wall, const geometry::Pose& pose, const SphereState& sphere,
                         const contact::PairProperties& pair, double dt);

  /// By what contacts slide in a step.
  struct Sliding {
    double dt = 0.0;        ///< [s]
    bool by_speed = false;  ///< by |v_t| dt, not by their plastic slip
    [[nodiscard]] double of(const Touch& touch) const noexcept {
      return by_speed ? touch.force.v_t * dt : touch.force.slip;
    }
  };
  /// Books the wear of one step: law volume of each contact, shared out under it. Returns the law's volume
  /// [m^3].
  double deposit(Wall& wall, double alpha_s, double R, const contact::PairProperties& pair,
                 const Sliding& sliding);

  /// How the wear of a step is recorded.
  struct Recording {
    Sliding sliding;
    bool sliding_only = false;                         ///< nobody asks for what does not slide under load
    std::int32_t contact = 0, wall = 0, material = 0;  ///< whose they are to be
  };
  /// Records what the contacts do to the wall in this step. Touches nothing but this object and the records.
  void record_wear(const Wall& wall, const SphereState& sphere, const contact::PairProperties& pair,
                   const Recording& how, WearRecords& records);
  /// Books a contact of this step, or what was recorded of it: its volumes on the surface, and what it did on
  /// the map, where there is one.
  void book(Wall& wall, const WearRecords& records, const WearRecords::Record& record,
            const wear::MapSample& sample, const MapLayer& map);

  /// The sphere's worn end as this wall sees it now, for the next find.
  void set_tip(const contact::Tip& tip) noexcept { tip_ = tip; }
  /// Books the sphere's own wear of one step and, when enough has come together to matter or an output is
  /// `due`, takes it off the tip where the contacts press. Returns the law's volume [m^3].
  double wear_tip(wear::WearingTip& tip, const Wall& wall, double alpha_s,
                  const contact::PairProperties& pair, bool due, const Sliding& sliding);
  /// Wear of the tip not yet taken off [m^3].
  [[nodiscard]] double tip_pending() const noexcept { return tip_pending_; }

  /// How a step ploughs: what leaves the groove and is not lost, and how the sphere slides.
  struct Displaced {
    double volume = 0.0;   ///< of this step [m^3]
    Vec3 v;                ///< velocity of the sphere over the wall, in the wall's frame [m/s]
    Vec3 turning;          ///< curvature of its path over the wall [1/m]
    double way = 0.0;      ///< slid in this step [m]
    double spacing = 1.0;  ///< of the piles, in half-lengths of the contact
    bool due = false;      ///< pile up now
  };
  /// Books what a step displaced and piles it up beside the contact, when it has slid far enough since the
  /// last pile, has parted, or an output is due.
  void plough(Wall& wall, const wear::Ploughing& ploughing, const Displaced& displaced, double R,
              const contact::PairProperties& pair);
  /// Displaced and not yet piled up [m^3].
  [[nodiscard]] double unpiled_volume() const noexcept { return unpiled_; }

  /// Force on the sphere and torque about its centre, of the contacts as they are [world frame].
  [[nodiscard]] ForceAndTorque load(const geometry::Pose& pose, double R) const noexcept;
  /// The sphere's centre at the last search, in the wall's frame.
  [[nodiscard]] const Vec3& centre() const noexcept { return centre_; }
  [[nodiscard]] const core::PooledVector<Touch>& touches() const noexcept { return touches_; }
  [[nodiscard]] core::PooledVector<Touch>& touches() noexcept { return touches_; }
  [[nodiscard]] const contact::MeshCandidates& candidates() const noexcept { return candidates_; }
  /// Elements in contact: under `patch` those with a corner in the ball, else the contacts.
  [[nodiscard]] int elements(const Wall& wall) const;

  /// The normal force by elements: contact by contact, or under `patch` node by node, each with its overlap
  /// and its part of the surface. @param axis unit vector in the wall's frame
  [[nodiscard]] NormalParts normal_parts(const Wall& wall, const Vec3& axis) const noexcept;

  /// Hands the wear of elements that is still kept in the candidates' numbering to the surface.
  void book_elements(Wall& wall);
  /// Is there any?
  [[nodiscard]] bool owes_elements() const noexcept { return !node_pending_.empty(); }
  /// Wear of elements not yet handed over [m^3].
  [[nodiscard]] double pending_volume() const noexcept;

  /// The triangle that is nearest to the sphere at c, in the wall's frame; -1 where none is near, or for a
  /// plane.
  [[nodiscard]] geometry::Index nearest_triangle(const Vec3& c) const noexcept;

  /// Adds what the next step depends on: the contacts' springs.
  void add_to(core::StateHash& hash) const;

  /// Eq. 10-12 of the paper over the elements in contact, where the surface moves by `deform_conserving`,
  /// since the start. Asking changes nothing, so that the sum does not depend on how often there is an output
  /// [m^3].
  [[nodiscard]] double centroid_volume(const Wall& wall);

  /// All that lasts from one step to the next, for core/archive.h. restore() follows a load.
  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("candidates", self.candidates_)("patches", self.patches_);
    archive("touches", self.touches_)("memory", self.memory_)("node_pending", self.node_pending_);
    archive("noted_at", self.noted_at_)("noted", self.noted_)("axis", self.axis_);
    archive("centroid_volume", self.centroid_volume_);
    archive("tip_pending", self.tip_pending_)("tip_batch", self.tip_batch_)("tip_area", self.tip_area_);
    archive("ridges", self.ridges_);
    archive("unpiled", self.unpiled_)("slid", self.slid_)("ploughing", self.ploughing_);
  }
  /// @return whether what was loaded fits the wall; the tip must have been set
  [[nodiscard]] bool restore(const Wall& wall);

 private:
  struct Pressing {
    wear::PloughingContact contact;
    double force = 0.0;  // [N]

    template <typename Self, typename Archive>
    static void visit(Self& self, Archive& archive) {
      archive("contact", self.contact)("force", self.force);
    }
  };
  /// Part of what the sphere presses: a contact, or under `per_triangle` all of them as one.
  struct Spot {
    Vec3 n;
    double deepest = 0.0;  // [m]
    double force = 0.0;    // [N]
    int part = 0;
    bool of_point = false;
  };
  /// The few triangles around point contacts, of many contacts with meshes all that a step reads of the
  /// mesh. While the sphere is on its way past all others, the candidates are not stale, and so a search
  /// would give the same bits.
  struct Near : core::InSmallBlocks {
    bool holds = false;
    std::uint64_t revision = 0;  // of the surface
    double load = 0.0;           // up to which the candidates reach far enough [N]
    contact::FewTriangles few;
  };
  [[nodiscard]] bool stays_near(const Wall& wall, const Vec3& c, double load) const noexcept {
    return near_ && near_->holds && load <= near_->load && near_->few.way.holds(c, wall.surface().odometer());
  }
  [[nodiscard]] bool touch_near(const Wall& wall, const Vec3& c, double R,
                                const contact::PairProperties& pair);
  void note_near(const Wall& wall, double R, const contact::PairProperties& pair);
  const std::vector<Spot>& find_spots(const Wall& wall);
  [[nodiscard]] std::span<const char> mask_of(const Wall& wall, int part, bool of_point);
  [[nodiscard]] wear::OverlapField overlap_field(double R, double deepest, bool of_point);
  void shape_tip(wear::WearingTip& tip, const Wall& wall, const contact::PairProperties& pair, bool due);
  void press(wear::WearingTip& tip, const Wall& wall, const Spot& spot, double d_e);
  /// How a contact's wear falls: on triangles or, under a footprint of nodes, valid until the next, on these;
  /// or nowhere.
  struct Landing {
    const wear::FootprintShares* nodes = nullptr;
    std::span<const WearShare> triangles;
    [[nodiscard]] bool nowhere() const noexcept { return nodes == nullptr && triangles.empty(); }
  };
  [[nodiscard]] static bool lands_inside(const contact::CandidateTriangle& triangle, const Vec3& point,
                                         double a, WearShare& share) noexcept;
  void land_on_triangles(const Wall& wall, const Touch& touch, double R, double d_e,
                         std::vector<WearShare>& shares);
  /// @param d_e Hertz's approach of its force [m]   @return valid until the next call
  [[nodiscard]] Landing land(const Wall& wall, const Touch& touch, double R, double d_e);
  void deposit_landed(Wall& wall, const Landing& landing, double dV);
  void map_landed(const MapLayer& map, const Landing& landing, const wear::MapSample& sample) const;
  void fill_sample(const Touch& touch, const SphereState& sphere, const contact::PairProperties& pair,
                   const Sliding& sliding, wear::MapSample& sample) const;
  [[nodiscard]] Scratch& scratch() noexcept {
    if (scratch_ != nullptr) return *scratch_;
    if (!own_) own_ = std::make_unique<Scratch>();
    return *own_;
  }
  void touch_plane(const Wall& wall, const Vec3& c, double R, const contact::PairProperties& pair);
  void touch_patches(double R, std::span<const contact::Patch> patches);
  void touch_points(const Wall& wall, double R, const contact::PairProperties& pair,
                    std::span<const contact::PointContact> points);
  void touch_either(const Wall& wall, const Vec3& c, double R, const contact::PairProperties& pair,
                    bool patches_first);
  [[nodiscard]] bool suit_points(std::span<const contact::PointContact> points, double R) const noexcept;
  [[nodiscard]] contact::CandidateSkin skin_of_points(double R) const noexcept;
  [[nodiscard]] bool by_patches(const Wall& wall) const noexcept;
  Memory& recall(const Touch& touch, ContactRule rule);
  void watch_impact(Memory& memory, const Touch& touch, const Vec3& v) noexcept;
  [[nodiscard]] static wear::WorkSample work_of(const Touch& touch, double slip, double mass,
                                                const contact::PairProperties& pair, double dt) noexcept;
  [[nodiscard]] bool sticking(const Vec3& n) const noexcept;
  bool compute_with_options(Touch& touch, const Vec3& v, const SphereState& sphere, const Vec3& spin,
                            const contact::PairProperties& pair, double dt,
                            contact::TangentialHistory& history, Vec3& torque) const;
  void add_centroid_motion(const Wall& wall);
  [[nodiscard]] double unnoted_centroid_volume(const Wall& wall);
  [[nodiscard]] double area_when_noted(std::size_t t) const noexcept;
  void note_nodes();
  [[nodiscard]] bool inside(std::size_t t) const noexcept;

  // What a step needs of a point contact stands in front: of thousands of these objects it is all that is
  // read.
  Scratch* scratch_ = nullptr;
  bool stale_ = true;     // the candidates were gathered anew in this step
  bool is_near_ = false;  // this step's contacts were found among near_, without a search
  std::unique_ptr<Near> near_;
  double reach_ = 0.0;
  contact::CandidateSkin skin_;
  Vec3 noted_at_;
  Vec3 axis_;     // towards the surface, from the last contact
  Vec3 centre_;   // of the last search
  Vec3 rolling_;  // resistance to rolling in the last step, world frame [N m]
  double centroid_volume_ = 0.0;
  static constexpr std::uint64_t kNeverNoted = ~std::uint64_t{0};
  std::uint64_t noted_revision_ = kNeverNoted;  // of the surface, when its nodes were last noted
  core::PooledVector<Touch> touches_;
  core::PooledVector<Memory> memory_;
  std::vector<double> node_pending_;  // wear at each candidate node, not yet booked with its elements [m^3]
  core::PooledVector<Vec3> noted_;    // of each candidate node: where it was when last noted
  contact::Tip tip_;
  contact::MeshCandidates candidates_;
  contact::PointContactFinder points_;
  contact::PatchEvaluator patches_;  // from here on of no use to them
  std::unique_ptr<Scratch> own_;
  std::vector<Spot> spots_;
  double tip_pending_ = 0.0, tip_batch_ = 0.0;  // worn off the tip in one go [m^3]
  double tip_area_ = 0.0;                       // of the tip under pressure, of late [m^2]
  wear::RidgeBuilder ridges_;
  double unpiled_ = 0.0, slid_ = 0.0;                        // since the last pile [m^3, m]
  std::vector<Pressing> ploughing_;                          // the last contacts
  core::PooledVector<contact::kernels::NodeMotion> motion_;  // of the nodes noted, since then, padded
  std::vector<double> terms_;                                // scratch
};

}  // namespace abradem::simulation
