// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "abradem/core/small_blocks.h"
#include "abradem/geometry/triangle_grid.h"
#include "abradem/geometry/triangle_mesh.h"

namespace abradem::contact {

using geometry::Index;

/// A deforming surface as contact sees it: positions and topology in the wall's own frame, and how far wear
/// has moved them.
struct SurfaceView {
  const geometry::TriangleMesh& mesh;
  const geometry::TriangleGrid& grid;
  std::uint64_t revision = 0;  ///< changes whenever a vertex moves
  double odometer = 0.0;       ///< grows by at least as much as any vertex moves [m]
  double displaced = 0.0;      ///< bound on how far any vertex is from where the grid was built [m]
};

/// How far a sphere may move before its candidates are gathered again: across the surface, and towards it.
struct CandidateSkin {
  double tangential = 0.0;  ///< to any side [m]
  double normal = 0.0;      ///< [m]
  Vec3 slide{};             ///< besides, from where it is to where it is going, across the normal [m]
};

/// One of the candidates with all that point contacts and their footprints ask of it, in one piece.
struct CandidateTriangle {
  std::array<Vec3, 3> corner;     ///< [m]
  Vec3 normal;                    ///< outwards, times the area [m^2]
  double area = 0.0;              ///< [m^2]
  double longest = 0.0;           ///< longest edge squared [m^2]
  std::array<Index, 3> vertex{};  ///< of the mesh
  Index triangle = 0;             ///< of the mesh
  std::int32_t local = 0;         ///< among the candidates

  [[nodiscard]] bool has(Index v) const noexcept {
    return vertex[0] == v || vertex[1] == v || vertex[2] == v;
  }
  /// Brings it to where its vertices are now, to the bit as the candidates would have it.
  void follow(const geometry::TriangleMesh& mesh) noexcept;
};

/// The triangles of a mesh that one sphere can meet, gathered into small contiguous arrays with vertices of
/// their own numbering. They stay valid while the sphere moves less than the skin, so that a step touches
/// nothing but these arrays. Arrays are padded to whole SIMD lanes with
/// vertices out of reach and triangles of no area. Triangles are ordered from the middle of the contact
/// outwards.
class MeshCandidates {
 public:
  static constexpr std::size_t kLanes = 8;

  MeshCandidates() = default;
  MeshCandidates(const MeshCandidates&) = delete;  // the arrays lie in stores of this object
  MeshCandidates& operator=(const MeshCandidates&) = delete;
  MeshCandidates(MeshCandidates&&) = default;
  MeshCandidates& operator=(MeshCandidates&&) = default;
  ~MeshCandidates() = default;

  /// Would an update gather anew (the sphere has left the skin), rather than fetch moved vertices?
  [[nodiscard]] bool stale(const SurfaceView& surface, const Vec3& c, double reach) const noexcept;

  /// How far a sphere at c that is not stale, and the surface, may still move in any direction [m].
  [[nodiscard]] double skin_left(const Vec3& c) const noexcept;

  /// What `reach` may grow to before they are stale [m].
  [[nodiscard]] double built_reach() const noexcept { return built_reach_; }

  /// Brings the candidates up to date for a sphere at c: gathers anew when stale, else fetches moved
  /// vertices.
  /// @param axis unit vector from c towards the surface (the last contact's), or zero: unknown
  /// @param reach distance from c within which a triangle counts [m]
  /// @param to_the_bit measure moved triangles however little they moved: what follows must not depend on
  /// when this was called last
  void update(const SurfaceView& surface, const Vec3& c, const Vec3& axis, double reach,
              const CandidateSkin& skin, bool to_the_bit = false);

  /// Forgets everything, so that the next update gathers anew.
  void reset() noexcept { gathered_ = false; }

  /// What was gathered and when, for core/archive.h: which triangles, in which order, where their nodes stood
  /// when they were last measured. The rest follows from it: restore().
  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("triangle", self.triangle)("measured", self.measured_)("mean_point", self.mean_point);
    archive("gathered", self.gathered_)("built_at", self.built_at_)("built_axis", self.built_axis_);
    archive("tangential", self.built_skin_.tangential)("normal", self.built_skin_.normal);
    archive("slide", self.built_skin_.slide)("built_reach", self.built_reach_);
    archive("odometer_at_gather", self.odometer_at_gather_);
    archive("odometer_at_measure", self.odometer_at_measure_);
    archive("longest_edge2_at_gather", self.longest_edge2_at_gather_);
    archive("revision", self.revision_)("gatherings", self.gatherings_);
  }
  /// After loading: makes the arrays of the triangles loaded, bit for bit as they were.
  /// @return whether they fit the mesh
  [[nodiscard]] bool restore(const geometry::TriangleMesh& mesh);

  /// Asks the memory for what a point contact reads.
  void fetch() const noexcept {
    for (const double* array : {x.data(), y.data(), z.data(), ax.data(), ay.data(), az.data(), area.data()})
      __builtin_prefetch(array);
    for (const std::int32_t* array : {v0.data(), v1.data(), v2.data()}) __builtin_prefetch(array);
    __builtin_prefetch(triangle.data());
  }

  [[nodiscard]] std::size_t node_count() const noexcept { return node.size(); }
  [[nodiscard]] std::size_t triangle_count() const noexcept { return triangle.size(); }
  [[nodiscard]] std::size_t padded_triangle_count() const noexcept { return v0.size(); }
  /// All candidates face nearly the same way (within 10 degrees): one patch, no clusters to look for.
  [[nodiscard]] bool nearly_flat() const noexcept { return nearly_flat_; }
  [[nodiscard]] Vec3 node_position(std::size_t i) const noexcept { return {x[i], y[i], z[i]}; }
  /// Local triangle t by itself.
  [[nodiscard]] CandidateTriangle triangle_at(std::size_t t) const noexcept;
  /// Longest edge when they were gathered, squared [m^2].
  [[nodiscard]] double longest_edge2_at_gather() const noexcept { return longest_edge2_at_gather_; }
  [[nodiscard]] std::uint64_t gatherings() const noexcept { return gatherings_; }
  /// A number that no other gathering has, of this or another object.
  [[nodiscard]] std::uint64_t stamp() const noexcept { return stamp_; }
  /// The surface's odometer at the last update [m].
  [[nodiscard]] double odometer() const noexcept { return odometer_; }

  /// Number of nodes in front, in whole lanes, behind which no excess is above `least` (nodes are numbered
  /// outwards too).
  [[nodiscard]] static std::size_t count_above(std::span<const double> excess, double least) noexcept {
    std::size_t n = excess.size();
    while (n > 0 && excess[n - 1] <= least) --n;
    return (n + kLanes - 1) / kLanes * kLanes;
  }

  core::PooledVector<Index> node;               ///< mesh vertex of each local node
  std::span<double> x, y, z;                    ///< node positions, padded [m]
  std::span<double> node_area;                  ///< third of the area of the triangles around, padded [m^2]
  std::span<double> bx, by, bz;                 ///< third of their area vectors, padded [m^2]
  core::PooledVector<std::int32_t> star_start;  ///< local triangles around node i (CSR)
  core::PooledVector<std::int32_t> star;
  Vec3 mean_normal;                    ///< of all candidates, unit
  Vec3 mean_point;                     ///< of the nodes inside the ball when gathered, by overlap [m]
  double below_plane = 0.0;            ///< no node lies further below the plane through these two [m]
  core::PooledVector<Index> triangle;  ///< mesh triangle of each local triangle
  std::span<std::int32_t> v0, v1, v2;  ///< local nodes of each triangle, padded
  std::span<double> ax, ay, az;        ///< area vectors, padded [m^2]
  std::span<double> plane;             ///< area vector . vertex, padded [m^3]
  std::span<double> l01, l12, l20;     ///< squared edge lengths, padded [m^2]
  std::span<double> longest;           ///< largest of the three [m^2]
  std::span<double> area;              ///< [m^2]
  double longest_edge2 = 0.0;          ///< largest of `longest` [m^2]

 private:
  void gather(const SurfaceView& surface, const Vec3& c, const Vec3& axis, double reach,
              const CandidateSkin& skin);
  void order_outwards();
  void number_nodes(const geometry::TriangleMesh& mesh);
  void allocate();
  void link_nodes();
  void place_mean_plane(const Vec3& c, double reach) noexcept;
  void fetch_positions(const geometry::TriangleMesh& mesh) noexcept;
  void measure_triangles();
  void bound_depth() noexcept;

  // Side by side, in the order of their use: there may be thousands of these objects, most of a few
  // triangles.
  core::PooledVector<double> of_nodes_, of_triangles_;
  core::PooledVector<std::int32_t> corners_;
  bool gathered_ = false, nearly_flat_ = false;
  Vec3 built_at_, built_axis_;
  CandidateSkin built_skin_;
  double built_reach_ = 0.0, odometer_at_gather_ = 0.0, odometer_at_measure_ = 0.0, shortest_ = 0.0;
  double odometer_ = 0.0, longest_edge2_at_gather_ = 0.0;
  std::uint64_t revision_ = 0, gatherings_ = 0, stamp_ = 0;
  core::PooledVector<Vec3> measured_;  // nodes' positions when the triangles were last measured
  std::vector<Index> near_;            // scratch: triangles of the cells near the way
  std::vector<double> across_;         // scratch: their distances from the way, or -1: out of reach
  std::vector<double> around_;         // scratch: of measure_nodes
};

}  // namespace abradem::contact
