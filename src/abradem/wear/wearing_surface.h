// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "abradem/geometry/triangle_mesh.h"

namespace abradem::wear {

using geometry::Index;

/// How an update may go wrong, counted; the run reports the counts and stops at the fatal ones.
struct DeformGuards {
  std::uint64_t deep_steps =
      0;  ///< a vertex moved by more than a tenth of its smallest altitude in one update
  std::uint64_t fatal_steps = 0;  ///< … by more than half of it
  std::uint64_t flipped = 0;      ///< a triangle turned by more than 90 degrees from its first orientation
  Index worst_vertex = -1;        ///< of the last fatal step
  Index worst_triangle = -1;      ///< last flipped

  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("deep_steps", self.deep_steps)("fatal_steps", self.fatal_steps)("flipped", self.flipped);
    archive("worst_vertex", self.worst_vertex)("worst_triangle", self.worst_triangle);
  }
};

/// A surface that loses material: a mesh, where it started, and what each element has lost.
///
/// Wear arrives as volumes of elements (`deposit`) and is turned into motion of the vertices by one of two
/// rules (docs/theory/wear.md#deformation):
///   deform_conserving   each vertex moves against its first normal; what the surface sweeps is the volume
///                       deposited, exactly;
///   deform_paper        eq. 6-9 of the paper to the letter: the three vertices of an element each move by
///   its
///                       full depth dV / A, along its normal; on a regular mesh this sweeps six times dV.
class WearingSurface {
 public:
  /// @throws GeometryError for a mesh without triangles or with a triangle of no area
  explicit WearingSurface(geometry::TriangleMesh mesh);

  [[nodiscard]] const geometry::TriangleMesh& mesh() const noexcept { return mesh_; }
  [[nodiscard]] std::span<const Vec3> reference() const noexcept { return reference_; }
  [[nodiscard]] const geometry::Rows& stars() const noexcept { return stars_; }
  /// Changes whenever a vertex moves.
  [[nodiscard]] std::uint64_t revision() const noexcept { return revision_; }
  /// Odometer of the wear: the sum over updates of the furthest that any vertex moved [m].
  [[nodiscard]] double odometer() const noexcept { return odometer_; }
  /// Bound on how far any vertex is from where it started [m].
  [[nodiscard]] double deepest_sink() const noexcept { return deepest_sink_; }

  /// Books wear of one element: `volume` >= 0 [m^3] in all, at0 … at2 of it at its vertices (their sum).
  void deposit(Index triangle, double volume, double at0, double at1, double at2) {
    deposit(triangle, mesh_.triangles[static_cast<std::size_t>(triangle)], volume, at0, at1, at2);
  }
  /// @param v the element's vertices, for those who know them
  void deposit(Index triangle, const geometry::Triangle& v, double volume, double at0, double at1,
               double at2) {
    volume_[static_cast<std::size_t>(triangle)] += volume;
    add_to_vertex(v[0], at0);
    add_to_vertex(v[1], at1);
    add_to_vertex(v[2], at2);
  }
  /// Asks the memory for what a deposit writes to.
  void fetch(Index triangle, const geometry::Triangle& vertices) const noexcept {
    __builtin_prefetch(&volume_[static_cast<std::size_t>(triangle)], 1);
    for (const Index v : vertices) __builtin_prefetch(&pending_[static_cast<std::size_t>(v)], 1);
  }
  /// The same in two parts: what falls to a vertex now, and what an element has lost, for the record only.
  void deposit_at_vertex(Index vertex, double volume) { add_to_vertex(vertex, volume); }
  void book_element(Index triangle, double volume) { volume_[static_cast<std::size_t>(triangle)] += volume; }
  /// Books volume that is piled up on a vertex [m^3], >= 0; deform_conserving raises the vertex by it.
  void raise_vertex(Index vertex, double volume);
  /// How far a vertex has been raised against its first position, along its first normal; < 0: sunk [m].
  [[nodiscard]] double height(Index vertex) const noexcept {
    return -sink_[static_cast<std::size_t>(vertex)];
  }
  /// Volume piled up since the start [m^3].
  [[nodiscard]] double raised_volume() const noexcept { return raised_; }

  /// Books wear of one element for the rule of the paper, which knows elements only.
  void deposit_element(Index triangle, double volume);

  /// Moves the vertices so that the surface sweeps what was deposited since the last update, then so that it
  /// gains what was piled up. Where the surface was flat this is linear and exact by construction; elsewhere
  /// one Newton iteration on the exact cubic of each connected patch closes it to round-off.
  void deform_conserving();
  /// Moves the vertices by eq. 6-9 of the paper.
  /// @return sum of |centroid displacement| * area over the elements worn since the last update [paper, eq.
  /// 10-12]
  double deform_paper();

  /// Wear booked per element since the start [m^3].
  [[nodiscard]] std::span<const double> element_volume() const noexcept { return volume_; }
  /// Sum of element_volume, in a fixed order [m^3].
  [[nodiscard]] double deposited_volume() const;
  /// Volume between the surface as it was and as it is, by geometry alone [m^3]; see swept_between. Where
  /// wear moved an open border that is not flat, the sum over the updates, since there the path matters.
  [[nodiscard]] double swept_volume() const;
  /// Volume that the next deform_conserving will sweep [m^3].
  [[nodiscard]] double waiting_volume() const noexcept;
  /// Triangles with a vertex that was displaced, ascending. Costs what is new since the last call, not the
  /// mesh.
  [[nodiscard]] const std::vector<Index>& worn_triangles() const;
  /// Looks for triangles that have turned over (all worn ones).
  void check_orientation();
  [[nodiscard]] const DeformGuards& guards() const noexcept { return guards_; }
  [[nodiscard]] bool flat() const noexcept { return flat_; }

  /// All that wear has changed since the surface was made of its mesh, for core/archive.h.
  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive.fixed("vertices", self.mesh_.vertices).fixed("sink", self.sink_).fixed("pending", self.pending_);
    archive.indices("touched", self.touched_, self.pending_.size());
    archive.fixed("volume", self.volume_).fixed("pending_element", self.pending_element_);
    archive.indices("touched_elements", self.touched_elements_, self.volume_.size());
    archive("border_moved", self.border_moved_)("swept_by_updates", self.swept_by_updates_);
    archive("odometer", self.odometer_)("deepest_sink", self.deepest_sink_)("revision", self.revision_);
    archive("piled", self.piled_);
    archive.indices("touched_piles", self.touched_piles_, self.piled_.size());
    archive("raised", self.raised_)("raised_lost", self.raised_lost_);
    archive("guards", self.guards_);
  }
  /// @return whether what was loaded fits the mesh
  [[nodiscard]] bool restored() noexcept {
    worn_known_ = false;
    return piled_.empty() || piled_.size() == sink_.size();
  }

 private:
  void add_to_vertex(Index v, double volume) {
    double& pending = pending_[static_cast<std::size_t>(v)];
    if (pending == 0.0 && volume > 0.0) touched_.push_back(v);
    pending += volume;
  }
  void displace(Index v, double distance);
  void watch(Index v, double distance) noexcept;
  void watch_orientation(Index t) noexcept;
  void close_volume(std::span<const Index> vertices, std::span<const double> pending,
                    std::vector<double>& distance);
  double move_by_volume(std::vector<Index>& vertices, std::vector<double>& pending, double sign);

  geometry::TriangleMesh mesh_;
  std::vector<Vec3> reference_;
  geometry::Rows stars_;
  std::vector<Vec3> direction_;       // outward unit normal at each vertex, from the reference
  std::vector<double> inverse_area_;  // flat stars: 1 / (third of the star's area) [1/m^2]; else 0
  std::vector<double> limit_;         // a tenth of the smallest altitude at each vertex [m]
  std::vector<double> sink_;          // distance moved against direction_ [m]
  std::vector<double> pending_;       // volume waiting at each vertex [m^3]
  std::vector<Index> touched_;        // vertices with pending volume
  std::vector<double> piled_;         // volume to be piled up at each vertex; empty: there was none yet [m^3]
  std::vector<Index> touched_piles_;  // vertices with it
  double raised_ = 0.0, raised_lost_ = 0.0;
  std::vector<double> volume_;  // per element, in all [m^3]
  std::vector<double> pending_element_;
  std::vector<Index> touched_elements_;
  std::vector<char> open_border_;  // vertex on an open border whose star is not flat
  bool flat_ = true, border_moved_ = false;
  double swept_by_updates_ = 0.0, odometer_ = 0.0, deepest_sink_ = 0.0;
  std::uint64_t revision_ = 1;
  mutable std::vector<Index> worn_;  // worn_triangles() as last asked for, once that is known
  mutable bool worn_known_ = false;
  mutable std::vector<Index> first_moved_;  // vertices displaced for the first time since then
  DeformGuards guards_;
};

/// Volume that a triangle sweeps against its normal when its corners move straight from `from` to `to`, all
/// at once [m^3]: the integral of its area vector times the mean velocity, a cubic, exact for open surfaces
/// too.
[[nodiscard]] double swept_between(const Vec3 (&from)[3], const Vec3 (&to)[3]) noexcept;

}  // namespace abradem::wear
