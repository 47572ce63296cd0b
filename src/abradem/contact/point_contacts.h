// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "abradem/contact/mesh_candidates.h"
#include "abradem/contact/tip_shape.h"
#include "abradem/geometry/closest_point.h"

namespace abradem::contact {

/// One point contact between a sphere and a mesh.
struct PointContact {
  Vec3 point;            ///< nearest point of the surface [m]
  Vec3 n;                ///< unit vector from it to the centre
  double overlap = 0.0;  ///< R - distance, less the recession of a worn tip there; > 0 [m]
  geometry::Feature feature = geometry::Feature::face;
  std::int32_t triangle = 0;  ///< local, in the candidates
  int set = 0;                ///< `resolved`: its connected flat set; otherwise its own number
};

/// The point-contact rules: what the sphere's ball touches, each feature once, face before edge before
/// vertex. docs/theory/contact-walls.md#point-contacts
class PointContactFinder {
 public:
  /// What a call finds. Many finders that are used one after another may share it (lend), where nobody asks
  /// for it later: then it stays in the fast memory.
  struct Findings {
    std::vector<PointContact> touched;  // nearest point of every triangle that the ball cuts
    std::vector<PointContact> accepted, best;
    std::vector<int> set;
    std::vector<double> excess, raw;
    TipCorrection correction;
  };
  /// From now on findings go there; null: to a place of its own.
  void lend(Findings* findings) noexcept {
    lent_ = findings;
    excess_known_ = false;
  }

  /// Rule `per_triangle`: every triangle whose nearest point lies within R is a contact of its own; a shared
  /// edge or vertex counts once, and not at all where a triangle around it is touched on its face.
  std::span<const PointContact> per_triangle(const MeshCandidates& candidates, const Vec3& c, double R,
                                             const Tip& tip = {});

  /// Rule `resolved`: one contact, the deepest, per connected set of overlapped triangles that lie within 5
  /// degrees of their neighbours; an edge or vertex of a set that touches another contact's set there is that
  /// contact. Angles are those of the mesh as it is now.
  /// @param sheet the surface is a thin sheet: triangles are touched from behind, too
  std::span<const PointContact> resolved(const MeshCandidates& candidates, const Vec3& c, double R,
                                         const Tip& tip = {}, bool sheet = false);

  /// 1 - |x - c|^2 / R^2 of each candidate node at the last call, padded; > 0 inside. With a worn tip: the
  /// excess that has the overlap with it.   @param candidates those of that call
  [[nodiscard]] std::span<const double> node_excess(const MeshCandidates& candidates);
  /// The same of the sphere as new; of a worn tip only.
  [[nodiscard]] std::span<const double> raw_excess() const noexcept { return found().raw; }

  /// Every triangle that the ball cut in the last call, each by its nearest point.
  [[nodiscard]] std::span<const PointContact> touched() const noexcept { return found().touched; }
  /// After a call that found nothing: how far the sphere and the surface must come before the ball reaches
  /// any of the candidates [m].
  [[nodiscard]] double clearance() const noexcept;

  /// After a call that touched one triangle: how far the sphere and the surface must come before the ball
  /// reaches another [m].
  [[nodiscard]] double room_beside() const noexcept;

  /// `resolved`: set of each candidate triangle, or -1 where it is not overlapped.
  [[nodiscard]] std::span<const int> sets() const noexcept { return found().set; }

  /// Asks the memory for what the next call reads.
  void fetch() const noexcept { __builtin_prefetch(wake_.data()); }

 private:
  void collect(const MeshCandidates& candidates, const Vec3& c, double R, const Tip& tip, bool sheet);
  void travel(const MeshCandidates& candidates, const Vec3& c, double R);
  void find_excess(const MeshCandidates& candidates);
  void find_flat_sets(const MeshCandidates& candidates);
  [[nodiscard]] Findings& found() noexcept { return lent_ != nullptr ? *lent_ : own_; }
  [[nodiscard]] const Findings& found() const noexcept { return lent_ != nullptr ? *lent_ : own_; }

  // Triangles out of reach: how far the sphere and the surface must have come before each can be touched.
  std::vector<double> wake_;  // [m]
  double way_ = 0.0, odometer_ = 0.0, radius_ = 0.0;
  Vec3 last_;
  std::uint64_t stamp_ = 0;  // of the candidates that these are of
  bool excess_known_ = false;
  Findings* lent_ = nullptr;
  Findings own_;
};

}  // namespace abradem::contact
