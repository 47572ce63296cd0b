// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/wear/ridges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/surfaces.h"

namespace abradem::wear {
namespace {

constexpr double kR = 3e-3, kEdge = 0.04e-3;

/// A plate and a sphere that has sunk into it along x.
struct Furrow {
  WearingSurface surface;
  geometry::TriangleGrid grid;
  PloughingContact contact;
  RidgeBuilder ridges;

  explicit Furrow(double jitter = 0.0)
      : surface(test::jittered_plate(2e-3, 2e-3, kEdge, jitter)), grid(surface.mesh()) {
    contact.c = {0.0, 0.0, kR - 2e-6};
    contact.R = kR;
    contact.n = {0.0, 0.0, 1.0};
    contact.forward = {1.0, 0.0, 0.0};
    contact.deepest = 2e-6;
    contact.d_e = 1e-6;
  }
  contact::SurfaceView view() const {
    return {surface.mesh(), grid, surface.revision(), surface.odometer(), surface.deepest_sink()};
  }
  double pile(double volume, const Ploughing& how) {
    const double left = ridges.pile_up(surface, view(), contact, how, volume);
    surface.deform_conserving();
    return left;
  }
  /// Volumes above the first surface on either side of the path.
  std::pair<double, double> sides() const {
    std::pair<double, double> sum{};
    for (std::size_t v = 0; v < surface.mesh().vertices.size(); ++v) {
      const double h = std::max(0.0, surface.height(static_cast<Index>(v)));
      (surface.mesh().vertices[v].y > contact.c.y ? sum.first : sum.second) += h;
    }
    return sum;
  }
};

const Ploughing kTenDegrees{0.5, std::tan(10.0 * std::numbers::pi / 180.0), 0.0};

TEST(RidgeBuilder, PilesTheVolumeExactly) {
  for (const double jitter : {0.0, 0.3}) {
    Furrow f(jitter);
    double piled = 0.0;
    for (int k = 1; k <= 20; ++k) {
      const double volume = 1e-14 * k;
      EXPECT_EQ(f.pile(volume, kTenDegrees), 0.0);
      piled += volume;
    }
    EXPECT_NEAR(f.surface.raised_volume() / piled, 1.0, 1e-14);
    EXPECT_NEAR(f.surface.swept_volume() / -piled, 1.0, 1e-12);
    EXPECT_NEAR(f.surface.deposited_volume() / -piled, 1.0, 1e-12);
  }
}

TEST(RidgeBuilder, IsSymmetric) {
  Furrow f(0.2);
  for (int k = 0; k < 10; ++k) f.pile(5e-14, kTenDegrees);
  const auto [left, right] = f.sides();
  EXPECT_GT(left, 0.0);
  EXPECT_NEAR(left / right, 1.0, 0.1);  // noise of the mesh
}

TEST(RidgeBuilder, NeverDescendsMoreSteeplyThanTheAngleAndNeverEntersTheSphere) {
  Furrow f;
  for (int k = 0; k < 30; ++k) f.pile(3e-15, kTenDegrees);
  const double pressed = f.contact.deepest - 0.5 * f.contact.d_e;
  const auto& v = f.surface.mesh().vertices;
  const double window = std::max(f.ridges.half_length(), std::sqrt(kR * f.contact.d_e));
  double top = 0.0;
  for (const Vec3& p : v) top = std::max(top, p.z);
  EXPECT_GT(top, 3.5e-6);
  for (std::size_t i = 0; i < v.size(); ++i) {
    if (!(v[i].z > 0.0)) continue;
    // The sphere's middle section, which passes over the whole pile.
    EXPECT_LE(kR - std::hypot(v[i].y - f.contact.c.y, v[i].z - f.contact.c.z), pressed + 2e-8);
    // No node further out in the same rows is lower than the plane through this one allows.
    for (std::size_t j = 0; j < v.size(); ++j) {
      const double out = std::abs(v[j].y - f.contact.c.y) - std::abs(v[i].y - f.contact.c.y);
      const bool same_side = (v[j].y > f.contact.c.y) == (v[i].y > f.contact.c.y);
      if (!same_side || out <= 0.0 || std::abs(v[j].x - f.contact.c.x) > 0.8 * window ||
          std::abs(v[i].x - f.contact.c.x) > 0.8 * window)
        continue;
      ASSERT_GE(v[j].z, v[i].z - kTenDegrees.slope * out - 1e-9) << i << ' ' << j;
    }
  }
}

TEST(RidgeBuilder, SteepRidgesAreNoSpikes) {
  // Along the contact no node stands far above the others of its row.
  Furrow f(0.3);
  const Ploughing steep{0.25, 1.0, 0.0};
  const double volume = 8e-14;
  f.pile(volume, steep);
  double top = 0.0;
  for (const Vec3& p : f.surface.mesh().vertices) top = std::max(top, p.z);
  const double window = std::max(f.ridges.half_length(), std::sqrt(kR * f.contact.d_e));
  EXPECT_LT(top, 1.1 * 2.0 * (0.5 * volume) / (2.0 * window * kEdge));
}

TEST(RidgeBuilder, FollowsAPathThatBends) {
  Furrow f;
  f.contact.turning = {0.0, 1.0 / 2e-3, 0.0};  // to the left: a circle of 2 mm
  for (int k = 0; k < 10; ++k) f.pile(5e-14, kTenDegrees);
  // The ridges lie on circles about its centre: on the right ridge, nodes before and behind lie further left.
  const Vec3 centre{0.0, 2e-3, 0.0};
  double inner = 0.0, outer = 0.0, of_inner = 0.0, of_outer = 0.0;
  for (const Vec3& p : f.surface.mesh().vertices) {
    if (!(p.z > 0.0)) continue;
    const double r = std::hypot(p.x - centre.x, p.y - centre.y);
    if (r < 2e-3)
      inner += p.z * (2e-3 - r), of_inner += p.z;
    else
      outer += p.z * (r - 2e-3), of_outer += p.z;
  }
  EXPECT_NEAR((inner / of_inner) / (outer / of_outer), 1.0, 0.15);
}

TEST(RidgeBuilder, SaysWhatFoundNoPlace) {
  Furrow f;
  f.contact.c.x = 50e-3;  // beside the plate
  EXPECT_EQ(f.pile(1e-14, kTenDegrees), 1e-14);
  EXPECT_EQ(f.surface.raised_volume(), 0.0);
}

TEST(RidgeBuilder, TheSameVolumesGiveTheSameBits) {
  Furrow a(0.3), b(0.3);
  for (int k = 0; k < 5; ++k) a.pile(3e-14, kTenDegrees), b.pile(3e-14, kTenDegrees);
  for (std::size_t i = 0; i < a.surface.mesh().vertices.size(); ++i)
    ASSERT_EQ(a.surface.mesh().vertices[i], b.surface.mesh().vertices[i]);
}

}  // namespace
}  // namespace abradem::wear
