// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "abradem/core/vec3.h"
#include "abradem/geometry/triangle_mesh.h"

/// Sections through a worn surface, and what is measured on them.                docs/theory/contours.md
///
/// A section is where a half-plane through the axis of rotation (or a plane across the sliding direction)
/// cuts the current triangles. Its height is not the position of the surface but how far the surface has
/// moved along the axis since it was new, (x - x_reference) . axis, interpolated linearly along the cut
/// edges. So a noisy or curved wall measures the same as a flat one. Worn material has negative height. The
/// surface must be single-valued seen along the axis; a candidate list of the worn side alone ensures it.
namespace abradem::analysis {

/// One corner of the section's polyline.
struct ProfilePoint {
  double radius = 0.0;  ///< [m] distance from the axis; for straight cuts the coordinate across the track
  double height = 0.0;  ///< [m] displacement along the axis; negative where material is gone
  bool operator==(const ProfilePoint&) const = default;
};

/// One section and its measures. A section that meets no wear has depth, width and area 0.
struct Contour {
  double angle = 0.0;  ///< [rad] in [0, 2 pi); for straight cuts the position along the track [m]
  double depth = 0.0;  ///< [m] deepest sink, positive
  double width = 0.0;  ///< [m] worn_width() of the profile
  double area = 0.0;   ///< [m^2] sunk_area() of the profile
  std::vector<ProfilePoint> profile;  ///< by ascending radius, no point twice
  double displaced_width = 0.0;       ///< [m] displaced_width() of the profile
};

/// A closed range of a coordinate [m].
struct Band {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

/// Half-planes through an axis, at angles 2 pi k / count.
struct RotaryCuts {
  Vec3 axis{0.0, 0.0, 1.0};    ///< out of the worn solid; any length but zero
  Vec3 center{};               ///< a point on the axis [m]
  int count = 360;             ///< sections per turn, >= 1
  std::optional<Vec3> zero{};  ///< direction of angle 0, not parallel to the axis; default angle_zero(axis)
  Band radii{};                ///< the part of each section that is kept
};

/// Planes across a sliding direction, for walls that do not turn. Section k lies at
/// along.low + (k + 1/2) (along.high - along.low) / count.
struct StraightCuts {
  Vec3 axis{0.0, 0.0, 1.0};       ///< out of the worn solid; any length but zero
  Vec3 direction{1.0, 0.0, 0.0};  ///< of sliding; its part along the axis is ignored
  Vec3 origin{};                  ///< where both coordinates are 0 [m]; across = axis x direction
  int count = 360;                ///< >= 1
  Band along{};                   ///< finite; worn_extent() gives the worn length
  Band across{};                  ///< the part of each section that is kept
};

/// Direction from which RotaryCuts counts its angles: the x axis made perpendicular to the axis of rotation,
/// or the y axis where those two are within about 25 degrees.
[[nodiscard]] Vec3 angle_zero(const Vec3& axis);

/// Triangles with a displaced vertex, and `rings` rings of neighbours (by shared vertex) around them,
/// ascending.
/// @param reference the vertices of the new wall, in the order of mesh.vertices   O(triangles)
/// @throws InputError when the sizes differ or rings < 0
[[nodiscard]] std::vector<geometry::Index> worn_region(const geometry::TriangleMesh& mesh,
                                                       std::span<const Vec3> reference, int rings = 1);

/// Range of (x - origin) . direction over the displaced vertices of the candidate triangles [m]; nothing when
/// no vertex is displaced. @param direction any length but zero
[[nodiscard]] std::optional<Band> worn_extent(const geometry::TriangleMesh& mesh,
                                              std::span<const Vec3> reference,
                                              std::span<const geometry::Index> candidates, const Vec3& origin,
                                              const Vec3& direction);

/// Cuts the candidate triangles; one contour per section, in order of angle (position).
/// The order of the candidates does not matter; candidates without displacement only add points of height 0.
/// One pass over the candidates: O(candidates + crossings log crossings).
/// @param reference the vertices of the new wall, in the order of mesh.vertices
/// @param candidates indices of triangles; must hold every triangle with a displaced vertex that is of
/// interest
/// @throws InputError for a zero axis, count < 1, an inverted band, sizes that differ, an index out of range
[[nodiscard]] std::vector<Contour> cut_contours(const geometry::TriangleMesh& mesh,
                                                std::span<const Vec3> reference,
                                                std::span<const geometry::Index> candidates,
                                                const RotaryCuts& cuts);
[[nodiscard]] std::vector<Contour> cut_contours(const geometry::TriangleMesh& mesh,
                                                std::span<const Vec3> reference,
                                                std::span<const geometry::Index> candidates,
                                                const StraightCuts& cuts);

/// Fills depth, width and area from the profile; also for measured profiles.
void measure(Contour& contour) noexcept;

/// Deepest sink [m], >= 0.
[[nodiscard]] double deepest_sink(std::span<const ProfilePoint> profile) noexcept;
/// Integral of the sink over the section [m^2], trapezoidal (exact for the polyline). Raised parts count
/// negative.
[[nodiscard]] double sunk_area(std::span<const ProfilePoint> profile) noexcept;

/// Distance between the outermost crossings of height = -level [m], linear between points; 0 when nothing is
/// deeper than level. A profile that ends below the level counts to its end.   @param level [m], >= 0
[[nodiscard]] double opening(std::span<const ProfilePoint> profile, double level) noexcept;

/// What stands above the first surface, and what lies below it.
struct RidgeSummary {
  double height_mean = 0.0, height_sd = 0.0;  ///< of the highest point of each section [m]
  double ridge_area = 0.0;                    ///< mean area above the first surface [m^2]
  double groove_area = 0.0;                   ///< mean area below it [m^2]
};
/// Over sections that have their profiles; others are left out.
[[nodiscard]] RidgeSummary ridge_summary(std::span<const Contour> contours) noexcept;

/// The level of worn_width [m]: max(1 % of the section's depth, 0.5 um).
[[nodiscard]] double width_level(double depth) noexcept;
/// Width [m] as a profilometer would give it: opening at width_level of the section's own depth.
[[nodiscard]] double worn_width(std::span<const ProfilePoint> profile) noexcept;
/// Width [m] after [yan2022]: from where the first displacement begins to where the last one ends, however
/// small. Quantised by the rows of elements: up to two element sizes more than the groove.
[[nodiscard]] double displaced_width(std::span<const ProfilePoint> profile) noexcept;

}  // namespace abradem::analysis
