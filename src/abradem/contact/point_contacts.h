// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <vector>

#include "abradem/contact/mesh_candidates.h"
#include "abradem/contact/tip_shape.h"
#include "abradem/contact/triangle_links.h"
#include "abradem/core/prefetch.h"
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
  std::size_t place = 0;      ///< among those touched
};

/// A triangle out of a ball's reach stays there while away . c - odometer > level, c the ball's centre.
struct OutOfReach {
  Vec3 away;
  double level = std::numeric_limits<double>::infinity();  ///< [m]
  [[nodiscard]] bool holds(const Vec3& c, double odometer) const noexcept {
    return dot(away, c) - odometer > level;
  }
};

/// Where a sphere may go from a place before it can touch more than it does there.
///
/// The distance from a triangle is a convex function of the place: it grows at least as its gradient says,
/// the unit vector away from the nearest point, and shrinks by no more than the surface wears. So each
/// triangle allows a half-space; of the nearest these are kept, of the others the least distance.
struct FreeWay {
  static constexpr std::size_t kNearest = 4;
  Vec3 from;                           ///< [m]
  double wear = 0.0;                   ///< the surface's odometer there [m]
  double any = 0.0;                    ///< way in any direction; 0: none [m]
  std::array<Vec3, kNearest> away{};   ///< unit vectors, or zero
  std::array<double, kNearest> gap{};  ///< to each [m]

  /// Does the sphere, now at c, touch nothing new?
  [[nodiscard]] bool holds(const Vec3& c, double odometer) const noexcept {
    const Vec3 moved = c - from;
    const double worn = odometer - wear, left = any - worn;
    bool free = left > 0.0 && norm2(moved) < left * left;
    for (std::size_t k = 0; k < kNearest; ++k) free = free && dot(away[k], moved) + gap[k] > worn;
    return free;
  }
  /// Way in any direction, past the nearest triangles too [m].
  [[nodiscard]] double least() const noexcept { return std::min(any, *std::ranges::min_element(gap)); }
};

/// The few triangles that a ball can meet on some way, of many contacts with meshes all that a step reads of
/// them: as long as the way holds, what is found among them is what is found among all candidates, to the
/// bit.
struct FewTriangles {
  static constexpr std::size_t kMost = 8;
  FreeWay way;  ///< past all others
  std::size_t count = 0;
  std::array<std::uint8_t, kMost> order{};  ///< in that of the candidates
  std::array<OutOfReach, kMost> out{};
  std::array<CandidateTriangle, kMost> triangle{};  ///< what is touched in front

  /// Asks the memory for what the next search reads, but for triangles that most often are out of reach.
  void fetch() const noexcept {
    core::prefetch(this, sizeof *this - (kMost - 2) * sizeof(CandidateTriangle));
  }
};

/// The point-contact rules: what the sphere's ball touches, each feature once, face before edge before
/// vertex. docs/theory/contact-walls.md#point-contacts
class PointContactFinder {
 public:
  /// What a call finds. Many finders that are used one after another may share it (lend), where nobody asks
  /// for it later: then it stays in the fast memory.
  struct Findings {
    std::vector<PointContact> touched;         // nearest point of every triangle that the ball cuts
    std::vector<CandidateTriangle> triangles;  // these
    std::vector<PointContact> accepted, best;
    std::vector<CandidateTriangle> of_set;
    std::vector<int> set;
    TriangleLinks links;
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
  /// The same among a few of the candidates, of a sphere as new.
  /// @param odometer of the surface whose triangles these are
  std::span<const PointContact> resolved(FewTriangles& few, const Vec3& c, double R, double odometer,
                                         bool sheet = false);
  /// Notes the triangles that the last call found in the ball, and those that it will reach first.
  /// @param most how far the candidates reach [m]   @return whether there are few enough
  [[nodiscard]] bool note(const MeshCandidates& candidates, double most, FewTriangles& few) const;

  /// 1 - |x - c|^2 / R^2 of each candidate node at the last call, padded; > 0 inside. With a worn tip: the
  /// excess that has the overlap with it.   @param candidates those of that call
  [[nodiscard]] std::span<const double> node_excess(const MeshCandidates& candidates);
  /// The same of the sphere as new; of a worn tip only.
  [[nodiscard]] std::span<const double> raw_excess() const noexcept { return found().raw; }

  /// Every triangle that the ball cut in the last call, each by its nearest point.
  [[nodiscard]] std::span<const PointContact> touched() const noexcept { return found().touched; }
  /// Triangles that it cut: all, or with `resolved` those of a set.
  [[nodiscard]] std::span<const CandidateTriangle> touched_triangles() const noexcept {
    return found().triangles;
  }
  [[nodiscard]] std::span<const CandidateTriangle> triangles_of(int set);
  /// From the place of the last call, and within `most`, until the ball reaches a triangle that it did not
  /// touch there.
  [[nodiscard]] FreeWay free_way(double most) const noexcept;

  /// `resolved`: set of each candidate triangle, or -1 where it is not overlapped.
  [[nodiscard]] std::span<const int> sets(const MeshCandidates& candidates);

  /// Asks the memory for what the next call reads.
  void fetch() const noexcept { __builtin_prefetch(out_.data()); }

 private:
  void collect(const MeshCandidates& candidates, const Vec3& c, double R, const Tip& tip, bool sheet);
  void begin(const Vec3& c, double R, double odometer) noexcept;
  void meet(const CandidateTriangle& triangle, const Vec3& c, double R, const Tip& tip, bool sheet,
            OutOfReach& out);
  [[nodiscard]] std::span<const PointContact> deepest_of_sets();
  void find_excess(const MeshCandidates& candidates);
  void find_flat_sets();
  [[nodiscard]] FreeWay way_past(double most, std::span<const std::int32_t> these) const noexcept;
  [[nodiscard]] bool touched(std::size_t t) const noexcept;
  [[nodiscard]] Findings& found() noexcept { return lent_ != nullptr ? *lent_ : own_; }
  [[nodiscard]] const Findings& found() const noexcept { return lent_ != nullptr ? *lent_ : own_; }

  core::PooledVector<OutOfReach> out_;  // of each candidate
  double odometer_ = 0.0, radius_ = 0.0;
  Vec3 last_;
  std::uint64_t stamp_ = 0;  // of the candidates that these are of
  bool excess_known_ = false;
  Findings* lent_ = nullptr;
  Findings own_;
};

}  // namespace abradem::contact
