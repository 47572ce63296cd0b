// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/simulation/sphere_wall.h"

#include <gtest/gtest.h>

#include "support/surfaces.h"

namespace abradem::simulation {
namespace {

constexpr double R = 3e-3, kStep = 1e-5;
const contact::PairProperties kPair{
    .E_eff = 1e8, .G_eff = 2.5e7, .beta = -0.2, .static_friction = 0.5, .rolling_friction = 0.02};

/// A sphere that rolls and slides over a plate which it wears, and what it did in the last step.
struct Slider {
  Wall wall;
  SphereWall contact;
  SphereWall::Scratch scratch;
  WearRecords records;
  ForceAndTorque force;
  bool shares_scratch = false;

  Slider(const geometry::TriangleMesh& mesh, ContactRule rule, Sides sides, bool shares)
      : wall(
            setup_of(rule, sides), 0, [&](const MeshSetup&, std::uint64_t) { return mesh; }, 1),
        shares_scratch(shares) {}

  static WallSetup setup_of(ContactRule rule, Sides sides) {
    WallSetup setup;
    setup.mesh.shape = MeshShape::file;
    setup.contact = rule;
    setup.sides = sides;
    setup.deformation = sides == Sides::both ? DeformationRule::none : DeformationRule::conserving;
    return setup;
  }
  void step(const SphereState& s, int number) {
    const geometry::Pose pose;
    if (shares_scratch) contact.lend(&scratch);
    contact.prepare(wall, s.position, s.velocity, R, kPair, 0.05, kStep);
    contact.find(wall, s.position, R, kPair);
    force = contact.compute(wall, pose, s, kPair, kStep);
    records.clear();
    contact.record_wear(wall, s, kPair, {.sliding = {kStep, false}, .sliding_only = true}, records);
    contact.lend(nullptr);
    for (const WearRecords::Record& record : records.record) {
      wear::MapSample sample = record.sample;
      sample.volumes[0] = wear::archard_volume(1e-10, sample.work.contact);
      contact.book(wall, records, record, sample, {});
    }
    if (number % 20 == 19 && wall.setup().deformation != DeformationRule::none)
      wall.surface().deform_conserving();
  }
};

void expect_same(const Vec3& a, const Vec3& b, int step) {
  ASSERT_EQ(a.x, b.x) << step;
  ASSERT_EQ(a.y, b.y) << step;
  ASSERT_EQ(a.z, b.z) << step;
}

/// What is found among the few triangles that the sphere can meet on its way has the bits of a search, on
/// triangles wider than the contact and on triangles of which it covers several.
TEST(SphereWall, NearFewTrianglesFindsWhatASearchFinds) {
  for (const double edge : {2e-3, 0.5e-3}) {
    auto mesh = test::jittered_plate(16e-3, 16e-3, edge, 0.2);
    test::roughen(mesh, 2e-6, 3);
    for (const auto& [rule, sides] :
         {std::pair(ContactRule::resolved, Sides::front), std::pair(ContactRule::resolved, Sides::both),
          std::pair(ContactRule::automatic, Sides::front)}) {
      Slider with(mesh, rule, sides, true), without(mesh, rule, sides, false);
      int kept = 0, on_several = 0, touching = 0;
      SphereState s{.position = {}, .velocity = {}, .spin = {1.0, 7.0, 0.5}, .radius = R, .mass = 2.8e-4};
      constexpr int kSteps = 4000;
      for (int k = 0; k < kSteps; ++k) {
        const double t = k * kStep;
        // Across many triangles, up and down through touching, fast and slow.
        const Vec3 next{4e-3 * std::sin(40.0 * t), 3e-3 * std::sin(63.0 * t),
                        R - 4e-6 + 9e-6 * std::sin(300.0 * t)};
        s.velocity = k == 0 ? Vec3{} : (next - s.position) / kStep;
        s.position = next;
        with.step(s, k);
        without.step(s, k);
        kept += with.contact.is_near();
        ASSERT_FALSE(without.contact.is_near());
        ASSERT_EQ(with.contact.touches().size(), without.contact.touches().size()) << k;
        touching += with.contact.touches().empty() ? 0 : 1;
        expect_same(with.force.force, without.force.force, k);
        expect_same(with.force.torque, without.force.torque, k);
        ASSERT_EQ(with.records.share.size(), without.records.share.size()) << k;
        on_several += with.contact.is_near() && with.records.share.size() > 1;
        for (std::size_t i = 0; i < with.records.share.size(); ++i) {
          ASSERT_EQ(with.records.share[i].triangle, without.records.share[i].triangle) << k;
          ASSERT_EQ(with.records.share[i].at1, without.records.share[i].at1) << k;
        }
        ASSERT_EQ(with.wall.surface().odometer(), without.wall.surface().odometer()) << k;
        ASSERT_EQ(with.contact.centroid_volume(with.wall), without.contact.centroid_volume(without.wall))
            << k;
      }
      EXPECT_GT(touching, kSteps / 2);
      EXPECT_LT(touching, kSteps);
      EXPECT_GT(kept, touching / 4);
      EXPECT_GT(on_several, kSteps / 50);
      EXPECT_GT(with.wall.surface().deposited_volume(), 0.0);
    }
  }
}

}  // namespace
}  // namespace abradem::simulation
