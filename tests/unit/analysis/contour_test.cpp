// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/analysis/contour.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <random>
#include <string>

#include "abradem/core/error.h"
#include "unit/analysis/ring_fixture.h"

namespace abradem::analysis {
namespace {

using namespace test;
using geometry::Index;

constexpr double kPi = std::numbers::pi;

std::vector<Index> all_triangles(const geometry::TriangleMesh& mesh) {
  std::vector<Index> all;
  for (Index t = 0; t < mesh.triangle_count(); ++t) all.push_back(t);
  return all;
}

std::vector<Contour> cut(const Wall& wall, const RotaryCuts& cuts = {}) {
  return cut_contours(wall.mesh, wall.reference, worn_region(wall.mesh, wall.reference), cuts);
}

double noise(std::mt19937& random) { return 2.0 * static_cast<double>(random()) / 4294967295.0 - 1.0; }

struct GrooveErrors {
  double depth = 0.0, area = 0.0, width = 0.0, quarter_width = 0.0;  ///< largest over the sections, relative
};

/// Errors of the sections of a segment groove against its closed form: the worst over sections and over where
/// the groove lies among the nodes, for a single lie may be lucky.
GrooveErrors groove_errors(double h, double depth) {
  GrooveErrors worst;
  const auto keep = [](double& largest, double got, double exact) {
    largest = std::max(largest, std::abs(got / exact - 1.0));
  };
  constexpr int lies = 10;
  for (int lie = 0; lie < lies; ++lie) {
    Wall wall = ring(h, 0.02, static_cast<double>(lie) / lies);
    wear_track(wall, depth);
    for (const Contour& c : cut(wall)) {
      if (c.angle < 0.01 || c.angle > 0.12) continue;  // the arc spans 0.126 rad
      keep(worst.depth, c.depth, depth);
      keep(worst.area, c.area, segment_area(depth));
      keep(worst.width, c.width, segment_width(depth, width_level(depth)));
      keep(worst.quarter_width, opening(c.profile, 0.25 * depth), segment_width(depth, 0.25 * depth));
    }
  }
  return worst;
}

TEST(Contour, MeasuresOfASegmentGrooveConvergeToTheClosedForm) {
  constexpr double depth = 50e-6;  // as deep as the paper's deepest grooves; 1.09 mm wide
  const GrooveErrors coarse = groove_errors(0.1e-3, depth), middle = groove_errors(0.05e-3, depth),
                     fine = groove_errors(0.025e-3, depth);
  // Linear interpolation of a smooth arc is of second order.
  const auto order = [](double a, double b) { return std::log2(a / b) / 2.0; };
  EXPECT_NEAR(order(coarse.depth, fine.depth), 2.0, 0.1);
  EXPECT_NEAR(order(coarse.quarter_width, fine.quarter_width), 2.0, 0.2);
  // The level of the width lies within one element of the kink at either edge of the groove: first order.
  EXPECT_NEAR(order(coarse.width, fine.width), 1.0, 0.2);
  // The area's error comes from the same two kinks, at most slope h^2 / 12 each (Euler-Maclaurin), and
  // depends on where they lie in their elements: a bound, not a ratio, is what can be promised.
  const double slope = 0.5 * segment_width(depth, 0.0) / kBall;
  const auto bound = [&](double h) { return 1.02 * slope * h * h / 6.0 / segment_area(depth); };
  EXPECT_LT(coarse.area, bound(0.1e-3));
  EXPECT_LT(middle.area, bound(0.05e-3));
  EXPECT_LT(fine.area, bound(0.025e-3));
}

TEST(Contour, SectionsOfACircleCoverItEvenly) {
  Wall wall = ring(0.2e-3);
  wear_track(wall, 10e-6);
  const auto contours = cut(wall, {.count = 90});
  ASSERT_EQ(contours.size(), 90u);
  for (std::size_t k = 0; k < 90; ++k) {
    EXPECT_DOUBLE_EQ(contours[k].angle, 2.0 * kPi * static_cast<double>(k) / 90.0);
    // 0.2 mm elements on a groove 0.49 mm wide: h^2 / (8 R) = 1.7 um is the chord's sagitta.
    EXPECT_NEAR(contours[k].depth, 10e-6, 1.7e-6) << k;
    EXPECT_TRUE(std::ranges::is_sorted(contours[k].profile, {}, &ProfilePoint::radius));
  }
}

TEST(Contour, PappusSumOfTheSectionsIsTheSweptVolume) {
  Wall wall = ring(0.1e-3);
  wear_track(wall, 20e-6);
  double swept = 0.0;  // vertical sinks over the reference areas
  for (const geometry::Triangle& t : wall.mesh.triangles) {
    const Vec3 &a = wall.reference[static_cast<std::size_t>(t[0])],
               &b = wall.reference[static_cast<std::size_t>(t[1])],
               &c = wall.reference[static_cast<std::size_t>(t[2])];
    double sum = 0.0;
    for (const Index v : t) sum -= wall.mesh.vertices[static_cast<std::size_t>(v)].z;
    swept += 0.5 * cross(b - a, c - a).z * sum / 3.0;
  }
  double pappus = 0.0;
  const auto contours = cut(wall);
  for (const Contour& c : contours)
    for (std::size_t i = 1; i < c.profile.size(); ++i) {
      const ProfilePoint &p = c.profile[i - 1], &q = c.profile[i];
      const double dr = q.radius - p.radius;  // exact integral of -height * r over the segment
      pappus -= dr * (p.height * (2 * p.radius + q.radius) + q.height * (p.radius + 2 * q.radius)) / 6.0;
    }
  pappus *= 2.0 * kPi / 360.0;
  EXPECT_NEAR(pappus / swept, 1.0, 1e-4);
}

TEST(Contour, ATiltedAndShiftedWallMeasuresTheSame) {
  Wall wall = ring(0.1e-3);
  wear_track(wall, 15e-6);
  const auto straight = cut(wall, {.count = 72});

  const Vec3 axis = normalized({0.3, -0.5, 0.8}), u = angle_zero(axis), v = cross(axis, u),
             shift{0.1, -0.04, 7e-3};
  const auto move = [&](const Vec3& p) { return shift + p.x * u + p.y * v + p.z * axis; };
  for (Vec3& p : wall.mesh.vertices) p = move(p);
  for (Vec3& p : wall.reference) p = move(p);
  // After the motion every vertex differs from the reference only where it did before: z was exactly 0
  // elsewhere.
  const auto tilted = cut(wall, {.axis = 2.5 * axis, .center = shift, .count = 72});
  const auto given = cut(wall, {.axis = axis, .center = shift, .count = 72, .zero = u + 3.0 * axis});
  ASSERT_EQ(tilted.size(), straight.size());
  for (std::size_t k = 0; k < straight.size(); ++k) {
    // Round-off of positions of 0.1 m against a depth of 15 um is 1e-12.
    EXPECT_NEAR(tilted[k].depth / straight[k].depth, 1.0, 1e-9);
    EXPECT_NEAR(tilted[k].width / straight[k].width, 1.0, 1e-9);
    EXPECT_NEAR(tilted[k].area / straight[k].area, 1.0, 1e-9);
    EXPECT_NEAR(given[k].depth / straight[k].depth, 1.0, 1e-9);
  }
}

TEST(Contour, ReferenceSurfaceMayBeNoisyAndCurved) {
  Wall flat = ring(0.1e-3, 0.1);
  Wall rough = flat;
  std::mt19937 random(7);
  for (Vec3& p : rough.reference) p.z = 2e-6 * noise(random) + 4.0 * (p.x * p.x + p.y * p.y);
  rough.mesh.vertices = rough.reference;
  wear_track(flat, 12e-6);
  wear_track(rough, 12e-6);
  const auto a = cut(flat), b = cut(rough);
  for (std::size_t k = 0; k < a.size(); ++k) {
    ASSERT_EQ(a[k].profile.size(), b[k].profile.size());
    EXPECT_NEAR(a[k].depth, b[k].depth, 1e-17);  // z of 2 mm carries 2e-19 m of round-off
    EXPECT_NEAR(a[k].width, b[k].width, 1e-12);
    EXPECT_NEAR(a[k].area, b[k].area, 1e-18);
  }
}

/// Height on the section at one radius by barycentric coordinates in whichever triangle holds the point.
double height_by_search(const Wall& wall, double x, double y) {
  for (const geometry::Triangle& t : wall.mesh.triangles) {
    std::array<Vec3, 3> p, q;
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] = wall.mesh.vertices[static_cast<std::size_t>(t[k])];
      q[k] = wall.reference[static_cast<std::size_t>(t[k])];
    }
    const auto area = [](const Vec3& a, const Vec3& b, double px, double py) {
      return (b.x - a.x) * (py - a.y) - (b.y - a.y) * (px - a.x);
    };
    const double whole = area(p[0], p[1], p[2].x, p[2].y);
    const double l0 = area(p[1], p[2], x, y) / whole, l1 = area(p[2], p[0], x, y) / whole;
    const double l2 = 1.0 - l0 - l1;
    if (std::min({l0, l1, l2}) < 0.0) continue;
    return l0 * (p[0].z - q[0].z) + l1 * (p[1].z - q[1].z) + l2 * (p[2].z - q[2].z);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

TEST(Contour, ProfileIsTheSurfaceFoundByBruteForce) {
  // A disc through whose middle triangle the axis passes, irregular nodes, sunk by a rough field.
  std::mt19937 random(3);
  Wall wall;
  wall.mesh = grid(12, 12, false, [&](int i, int j) {
    return Vec3{(i - 6.3 + 0.3 * noise(random)) * 1e-3, (j - 5.8 + 0.3 * noise(random)) * 1e-3, 0.0};
  });
  wall.reference = wall.mesh.vertices;
  for (Vec3& p : wall.mesh.vertices) p += 1e-5 * Vec3{noise(random), noise(random), noise(random)};
  const auto contours = cut(wall, {.count = 37, .radii = {0.0, 4e-3}});
  int checked = 0;
  for (const Contour& c : contours) {
    ASSERT_GE(c.profile.size(), 3u);
    EXPECT_DOUBLE_EQ(c.profile.front().radius, 0.0);
    EXPECT_DOUBLE_EQ(c.profile.back().radius, 4e-3);
    for (std::size_t i = 1; i < c.profile.size(); ++i) {
      const ProfilePoint &p = c.profile[i - 1], &q = c.profile[i];
      if (q.radius - p.radius < 1e-9) continue;
      const double r = p.radius + 0.3 * (q.radius - p.radius), h = p.height + 0.3 * (q.height - p.height);
      EXPECT_NEAR(h, height_by_search(wall, r * std::cos(c.angle), r * std::sin(c.angle)), 1e-15);
      ++checked;
    }
  }
  EXPECT_GT(checked, 37 * 5);
}

TEST(Contour, SectionsThroughVerticesAndAlongEdgesLoseNothing) {
  // Nodes at whole degrees: each of the 360 planes runs along a row of edges.
  Wall wall;
  wall.mesh = grid(24, 360, true, [](int i, int j) {
    const double r = kTrack + (i - 12) * 0.1e-3, angle = 2.0 * kPi * j / 360.0;
    return Vec3{r * std::cos(angle), r * std::sin(angle), 0.0};
  });
  wall.reference = wall.mesh.vertices;
  wear_track(wall, 30e-6);
  const auto contours = cut(wall);
  for (const Contour& c : contours) {
    EXPECT_NEAR(c.depth, 30e-6, 1e-12);  // a node lies on the deepest line
    EXPECT_NEAR(c.area, contours[0].area, 1e-15);
    EXPECT_NEAR(c.width, contours[0].width, 1e-9);
  }
}

TEST(Contour, CandidatesNeitherOrderNorSurplusChangeTheMeasures) {
  Wall wall = ring(0.2e-3);
  wear_track(wall, 25e-6);
  auto region = worn_region(wall.mesh, wall.reference, 0);
  const auto narrow = cut_contours(wall.mesh, wall.reference, region, RotaryCuts{});
  std::shuffle(region.begin(), region.end(), std::mt19937(1));
  const auto shuffled = cut_contours(wall.mesh, wall.reference, region, RotaryCuts{});
  const auto whole = cut_contours(wall.mesh, wall.reference, all_triangles(wall.mesh), RotaryCuts{});
  for (std::size_t k = 0; k < narrow.size(); ++k) {
    EXPECT_EQ(narrow[k].profile, shuffled[k].profile);
    EXPECT_EQ(narrow[k].depth, whole[k].depth);
    EXPECT_EQ(narrow[k].width, whole[k].width);
    EXPECT_EQ(narrow[k].area, whole[k].area);
    EXPECT_EQ(displaced_width(narrow[k].profile), displaced_width(whole[k].profile));
    EXPECT_GT(whole[k].profile.size(), narrow[k].profile.size());
  }
}

TEST(Contour, UnwornSectionsAreZero) {
  Wall wall = ring(0.2e-3);
  wear(wall, [](double x, double y) {  // a quarter of the track only
    return x > 0.0 && y > 0.0 ? segment_sink(std::hypot(x, y) - kTrack, 10e-6) : 0.0;
  });
  const auto contours = cut(wall, {.count = 8});
  EXPECT_GT(contours[1].depth, 8e-6);
  for (const std::size_t k : {3u, 4u, 5u, 6u, 7u}) {
    EXPECT_EQ(contours[k].depth, 0.0);
    EXPECT_EQ(contours[k].width, 0.0);
    EXPECT_EQ(contours[k].area, 0.0);
    EXPECT_FALSE(std::signbit(contours[k].area));
    EXPECT_EQ(displaced_width(contours[k].profile), 0.0);
  }
  const Wall fresh = ring(0.2e-3);
  EXPECT_TRUE(worn_region(fresh.mesh, fresh.reference).empty());
  EXPECT_EQ(cut(fresh).size(), 360u);
}

TEST(Contour, BandKeepsItsPartOfTheSection) {
  Wall wall = ring(0.1e-3);
  wear_track(wall, 30e-6);
  const auto whole = cut(wall, {.count = 4}), left = cut(wall, {.count = 4, .radii = {0.0, kTrack}}),
             right = cut(wall, {.count = 4, .radii = {kTrack, 1.0}});
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_DOUBLE_EQ(left[k].profile.back().radius, kTrack);
    EXPECT_DOUBLE_EQ(right[k].profile.front().radius, kTrack);
    EXPECT_NEAR(left[k].area + right[k].area, whole[k].area, 1e-9 * whole[k].area);
    EXPECT_NEAR(left[k].width + right[k].width, whole[k].width, 1e-9 * whole[k].width);
  }
}

TEST(Contour, WornRegionGrowsByRings) {
  Wall wall;
  wall.mesh = grid(6, 6, false, [](int i, int j) { return Vec3{1.0 * i, 1.0 * j, 0.0}; });
  wall.reference = wall.mesh.vertices;
  wall.mesh.vertices[24].z = -0.1;  // the middle vertex: six triangles
  EXPECT_EQ(worn_region(wall.mesh, wall.reference, 0).size(), 6u);
  // Their hexagon of vertices touches 6 + 18 triangles.
  EXPECT_EQ(worn_region(wall.mesh, wall.reference, 1).size(), 24u);
}

TEST(Contour, StraightGrooveIsCutAcrossTheSlidingDirection) {
  Wall wall;
  // A plate in the x-z plane, worn along x, its outward normal along -y: nothing is where the disc has it.
  wall.mesh = grid(200, 40, false, [](int i, int j) {
    return Vec3{(i - 100.21) * 0.1e-3, 0.0, (j - 20.37) * 0.1e-3};
  });
  wall.reference = wall.mesh.vertices;
  constexpr double depth = 40e-6, half_length = 5e-3;
  for (Vec3& p : wall.mesh.vertices)
    if (std::abs(p.x) < half_length) p.y += segment_sink(p.z, depth);
  const auto region = worn_region(wall.mesh, wall.reference);
  const Vec3 direction{2.0, 0.0, 0.0}, axis{0.0, -1.0, 0.0};
  const auto length = worn_extent(wall.mesh, wall.reference, region, {}, direction);
  ASSERT_TRUE(length);
  EXPECT_NEAR(length->low, -half_length, 0.1e-3);
  EXPECT_NEAR(length->high, half_length, 0.1e-3);
  const StraightCuts cuts{.axis = axis, .direction = direction, .count = 50, .along = *length};
  const auto contours = cut_contours(wall.mesh, wall.reference, region, cuts);
  ASSERT_EQ(contours.size(), 50u);
  for (std::size_t k = 0; k < 50; ++k) {
    const double position =
        length->low + (static_cast<double>(k) + 0.5) * (length->high - length->low) / 50.0;
    EXPECT_NEAR(contours[k].angle, position, 1e-15);
    EXPECT_NEAR(contours[k].depth, depth, 0.5e-6);  // sagitta of a 0.1 mm chord: 0.4 um
    EXPECT_NEAR(contours[k].area / segment_area(depth), 1.0, 0.01);
    // One element at either edge of the groove.
    EXPECT_NEAR(contours[k].width, segment_width(depth, width_level(depth)), 2 * 0.1e-3);
    EXPECT_LT(contours[k].profile.front().radius, -0.4e-3);
    EXPECT_GT(contours[k].profile.back().radius, 0.4e-3);
  }
  const Wall fresh{{wall.reference, wall.mesh.triangles}, wall.reference};
  EXPECT_FALSE(worn_extent(fresh.mesh, fresh.reference, all_triangles(fresh.mesh), {}, direction));
}

TEST(Profile, WidthsOfAHandDrawnSection) {
  constexpr double um = 1e-6;
  // A shallow scratch, a ridge, the groove; 100 um deep, so the level is 1 um.
  const std::vector<ProfilePoint> p{{0, 0},
                                    {10 * um, 0},
                                    {20 * um, -2 * um},
                                    {30 * um, 3 * um},
                                    {50 * um, -100 * um},
                                    {60 * um, -10 * um},
                                    {70 * um, 0},
                                    {90 * um, 0}};
  EXPECT_DOUBLE_EQ(deepest_sink(p), 100 * um);
  EXPECT_DOUBLE_EQ(width_level(100 * um), 1 * um);
  EXPECT_NEAR(worn_width(p), (69 - 15) * um, 1e-18);
  EXPECT_NEAR(displaced_width(p), (70 - 10) * um, 1e-18);
  EXPECT_NEAR(opening(p, 10 * um), (60 - (30 + 20 * 13.0 / 103.0)) * um, 1e-18);
  EXPECT_EQ(opening(p, 100 * um), 0.0);
  // Trapezoids: 10, -5, 970, 550, 50 um^2.
  EXPECT_NEAR(sunk_area(p), 1575 * um * um, 1e-22);
}

TEST(Profile, WidthOfAShallowSectionNeedsHalfAMicrometre) {
  const std::vector<ProfilePoint> shallow{{0, 0}, {1e-4, -0.4e-6}, {2e-4, 0}};
  EXPECT_EQ(worn_width(shallow), 0.0);
  EXPECT_DOUBLE_EQ(displaced_width(shallow), 2e-4);
  const std::vector<ProfilePoint> deeper{{0, 0}, {1e-4, -1e-6}, {2e-4, 0}};
  EXPECT_NEAR(worn_width(deeper), 1e-4, 1e-16);
}

TEST(Profile, SectionThatEndsInTheGrooveCountsToItsEnd) {
  const std::vector<ProfilePoint> border{{0, -50e-6}, {1e-4, -50e-6}, {2e-4, 0}};
  EXPECT_NEAR(worn_width(border), 1.99e-4, 1e-15);
  EXPECT_DOUBLE_EQ(displaced_width(border), 2e-4);
  EXPECT_EQ(worn_width({}), 0.0);
  EXPECT_EQ(displaced_width({}), 0.0);
  EXPECT_EQ(deepest_sink({}), 0.0);
  EXPECT_EQ(sunk_area({}), 0.0);
}

TEST(Contour, RefusesWhatItCannotCut) {
  const Wall wall = ring(0.4e-3);
  const std::vector<Index> none, beyond{wall.mesh.triangle_count()}, negative{-1};
  const auto rotary = [&](const RotaryCuts& cuts, std::span<const Index> candidates = {}) {
    return cut_contours(wall.mesh, wall.reference, candidates, cuts);
  };
  EXPECT_THROW(rotary({.axis = {0, 0, 0}}), InputError);
  EXPECT_THROW(rotary({.count = 0}), InputError);
  EXPECT_THROW(rotary({.zero = Vec3{0, 0, -2}}), InputError);
  EXPECT_THROW(rotary({.radii = {2e-3, 1e-3}}), InputError);
  EXPECT_THROW(rotary({}, beyond), InputError);
  EXPECT_THROW(rotary({}, negative), InputError);
  EXPECT_THROW((void)cut_contours(wall.mesh, {}, none, RotaryCuts{}), InputError);
  EXPECT_THROW((void)cut_contours(wall.mesh, wall.reference, none, StraightCuts{}), InputError);
  EXPECT_THROW((void)worn_region(wall.mesh, {}), InputError);
  EXPECT_THROW((void)worn_region(wall.mesh, wall.reference, -1), InputError);
  EXPECT_THROW((void)worn_extent(wall.mesh, wall.reference, beyond, {}, {1, 0, 0}), InputError);
  try {
    rotary({.count = -3});
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("count is -3"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace abradem::analysis
