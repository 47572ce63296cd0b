// SPDX-License-Identifier: BSD-3-Clause
// contact = "auto": each contact by the rule that suits its triangles. docs/verification/walls.md#auto
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "abradem/simulation/sphere_wall.h"
#include "support/cases.h"
#include "support/surfaces.h"

namespace abradem::test {
namespace {

using namespace simulation;

constexpr double R = PinOnDisc::kRadius;
constexpr double kDelta = 40.8e-6;  // a = 0.35 mm
const contact::PairProperties kPair{
    .E_eff = 2.6285e8, .G_eff = 5.675e7, .beta = 0.0, .static_friction = 0.0, .rolling_friction = 0.0};

/// Strips across x, each 4 mm long and of finer triangles than the one before: 4 mm to 62.5 um. Borders are
/// T-junctions, as in the meshes of CAD programs.
TriangleMesh graded_plate() {
  TriangleMesh all;
  std::map<std::pair<double, double>, Index> at;  // strips share their vertices
  for (int strip = 0; strip < 7; ++strip) {
    const TriangleMesh part = jittered_plate(4e-3, 4e-3, 4e-3 / (1 << strip), 0.0);
    std::vector<Index> index;
    for (const Vec3& p : part.vertices) {
      const double x = p.x + 4e-3 * strip;
      const auto [found, added] =
          at.try_emplace({std::round(1e9 * x), std::round(1e9 * p.y)}, all.vertex_count());
      if (added) all.vertices.push_back({x, p.y, 0.0});
      index.push_back(found->second);
    }
    const auto of = [&](Index v) { return index[static_cast<std::size_t>(v)]; };
    for (const auto& [a, b, c] : part.triangles) all.triangles.push_back({of(a), of(b), of(c)});
  }
  return all;
}

/// A rolling ball, its spring stretched by what holds it back: it drives a load up the plate.
SphereOnMesh rolling_ball(const TriangleMesh& mesh, ContactRule rule) {
  SphereOnMesh s;
  s.mesh = mesh;
  s.contact = rule;
  s.density = 5e6;  // so heavy that the load hardly speeds it up
  s.friction = 0.5;
  s.restitution = 0.8;
  const double weight = contact::hertz_force(s.pair(), R, kDelta);
  s.position = {-1e-3, 0.13e-3, R - kDelta};
  s.velocity = {0.6, 0.01, 0.0};
  s.spin = {0.0, 0.6 / R, 0.0};
  s.load = {-0.2 * weight, 0.0, -weight};
  s.time_step = 2e-6;
  s.end = 0.04;
  return s;
}

struct Steps {
  std::vector<double> normal, tangential;  // [N] at each step
  Vec3 position, velocity, spin;           // at the end
  int blended = 0, patches = 0, points = 0;
};

Steps roll(const simulation::Setup& setup, const TriangleMesh& mesh) {
  Simulation run(setup, [&](const MeshSetup&, std::uint64_t) { return mesh; });
  Steps steps;
  while (!run.finished()) {
    run.step();
    const ForceSample f = run.force_on(0);
    steps.normal.push_back(f.normal);
    steps.tangential.push_back(f.tangential);
    const auto& touches = run.contact(0, 0).touches();
    if (touches.size() == 2)
      ++steps.blended;
    else if (!touches.empty())
      ++(touches[0].of_point ? steps.points : steps.patches);
  }
  steps.position = run.particles().position[0];
  steps.velocity = run.particles().velocity[0];
  steps.spin = run.particles().spin[0];
  return steps;
}

double farthest(const std::vector<double>& a, const std::vector<double>& b) {
  double worst = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) worst = std::max(worst, std::abs(a[k] - b[k]));
  return worst;
}

/// On the plane itself the rules are equal, and one is taken; a nanometre of noise makes both share.
TEST(AutoWall, BallRollsFromCoarseToFineAsOnAPlane) {
  for (const double noise : {0.0, 1e-9}) {
    TriangleMesh mesh = graded_plate();
    if (noise > 0.0) roughen(mesh, noise, 3);
    const SphereOnMesh ball = rolling_ball(mesh, ContactRule::automatic);
    simulation::Setup on_plane = ball.setup();
    on_plane.walls[0].mesh.shape = MeshShape::plane;
    const Steps plane = roll(on_plane, ball.mesh), steps = roll(ball.setup(), ball.mesh);
    ASSERT_EQ(plane.normal.size(), steps.normal.size());
    EXPECT_GT(steps.points, 2000);
    EXPECT_GT(steps.patches, 2000);
    if (noise > 0.0) {
      EXPECT_GT(steps.blended, 1000);
    } else {
      EXPECT_EQ(steps.blended, 0);
    }
    EXPECT_GT(steps.position.x, 0.018);
    const double weight = norm(ball.load);
    const double normal = farthest(steps.normal, plane.normal) / weight,
                 tangential = farthest(steps.tangential, plane.tangential) / weight;
    double jump = 0.0;
    for (std::size_t k = 1; k < steps.normal.size(); ++k)
      jump = std::max(jump, std::abs((steps.tangential[k] - steps.tangential[k - 1]) -
                                     (plane.tangential[k] - plane.tangential[k - 1])) /
                                weight);
    const double energy = std::abs(norm2(steps.velocity) - norm2(plane.velocity)) / norm2(plane.velocity) +
                          std::abs(norm2(steps.spin) - norm2(plane.spin)) / norm2(plane.spin);
    // The force goes with the overlap to the power of 1.5, and the noise may be three of its deviations high.
    const double bound = 1e-5 + 1.5 * 3.0 * noise / kDelta;
    // Besides, the nearest point wanders to the highest node, and the damper feels the ball go uphill.
    const double of_points =
        noise > 0.0
            ? farthest(roll(rolling_ball(mesh, ContactRule::resolved).setup(), mesh).normal, plane.normal) /
                  weight
            : bound;
    measured(fmt::format("auto, rolling from h = 4 mm to 0.06 mm, noise {} nm: normal force against a plane",
                         1e9 * noise),
             normal, of_points);
    measured("… tangential force", tangential, bound);
    measured("… jump of the tangential force in a step", jump, 0.1 * bound);
    measured("… energy at the end", energy, bound);
    EXPECT_LT(normal, of_points);
    EXPECT_LT(tangential, bound);
    EXPECT_LT(jump, 0.1 * bound);
    EXPECT_LT(energy, bound);
  }
}

/// Elastic force on a ball at a place, frictionless.
class Press {
 public:
  Press(TriangleMesh mesh, ContactRule rule)
      : wall_(
            setup(rule), 0, [&](const MeshSetup&, std::uint64_t) { return mesh; }, 1) {}
  Vec3 operator()(const Vec3& c) {
    contact_.prepare(wall_, c, {}, R, kPair, 1.0, 1e-5);
    contact_.find(wall_, c, R, kPair);
    Vec3 sum;
    patch = 0.0;
    for (const SphereWall::Touch& t : contact_.touches()) {
      sum += t.elastic_force * t.n;
      if (!t.of_point) patch = std::max(patch, t.weight);
    }
    return sum;
  }
  double patch = 0.0;  ///< share of the patches in the last force

 private:
  static WallSetup setup(ContactRule rule) {
    WallSetup wall;
    wall.mesh.shape = MeshShape::file;
    wall.contact = rule;
    return wall;
  }
  Wall wall_;
  SphereWall contact_;
};

/// The largest step that is left of the force when a path is looked at ever more closely; of `scale`.
double largest_jump(Press& press, const std::function<Vec3(double)>& path, int steps, double scale) {
  double worst = 0.0;
  for (int i = 0; i < steps; ++i) {
    double low = static_cast<double>(i) / steps, high = static_cast<double>(i + 1) / steps;
    Vec3 at_low = press(path(low)), at_high = press(path(high));
    for (int k = 0; k < 30 && norm(at_high - at_low) > 1e-6 * scale; ++k) {
      const double middle = 0.5 * (low + high);
      const Vec3 f = press(path(middle));
      if (norm(f - at_low) > norm(at_high - f))
        high = middle, at_high = f;
      else
        low = middle, at_low = f;
    }
    worst = std::max(worst, norm(at_high - at_low) / scale);
  }
  return worst;
}

TriangleMesh roof(double slope, double h) {
  TriangleMesh mesh = jittered_plate(6e-3, 6e-3, h, 0.0);
  for (Vec3& p : mesh.vertices) p = {p.x * std::cos(slope), p.y, -std::abs(p.x) * std::sin(slope)};
  return mesh;
}

TEST(AutoWall, ForceIsContinuousWhereTheRuleChanges) {
  const double scale = contact::hertz_force(kPair, R, kDelta);
  // Coming down onto the plate: each contact begins as a point, and ends as a patch where triangles are fine.
  for (const double x : {0.3e-3, 8.2e-3, 12.3e-3, 16.2e-3, 24.1e-3}) {
    Press press(graded_plate(), ContactRule::automatic);
    double off = 0.0, first = 1.0, last = 0.0;
    const auto down = [&](double s) { return Vec3{x, 0.21e-3, R + 1e-6 - s * 60e-6}; };
    for (int i = 0; i <= 600; ++i) {
      const double delta = std::max(R - down(i / 600.0).z, 0.0);
      off = std::max(off, std::abs(press(down(i / 600.0)).z - contact::hertz_force(kPair, R, delta)));
      first = std::min(first, press.patch), last = press.patch;
    }
    measured(
        fmt::format("auto, pressed onto h near {:.2g} mm: force against Hertz (last share of patch {:.2f})",
                    4.0 / std::exp2(std::floor((x + 2e-3) / 4e-3)), last),
        off / scale, 1e-5);
    EXPECT_LT(off, 1e-5 * scale);
    EXPECT_EQ(first, 0.0);
    EXPECT_LT(largest_jump(press, down, 200, scale), 2e-6);
  }
  // Over edges, at a constant height above the planes, with triangles in the band where both rules share.
  for (const double h : {0.5e-3, 0.6e-3})
    for (const double slope : {0.6, 0.1, -0.1, -0.6}) {
      double of_rule[3];
      int k = 0;
      for (const ContactRule rule : {ContactRule::automatic, ContactRule::patch, ContactRule::resolved}) {
        Press press(roof(slope, h), rule);
        const auto over = [&](double s) {
          const double x = (2.0 * s - 1.0) * 1e-3;
          const double z = slope > 0.0
                               ? std::max((R - kDelta) / std::cos(slope) - std::abs(x) * std::tan(slope), 0.0)
                               : (R - kDelta) / std::cos(slope) - std::abs(x) * std::tan(slope);
          const double far = std::hypot(x, z);
          // On a convex edge no nearer than the overlap asks for.
          return slope > 0.0 && std::abs(x) < (R - kDelta) * std::sin(slope)
                     ? Vec3{x, 0.07e-3, z * std::min(1.0, (R - kDelta) / far)}
                     : Vec3{x, 0.07e-3, z};
        };
        of_rule[k++] = largest_jump(press, over, 400, scale);
      }
      measured(fmt::format("auto, edge of {:+.1f} rad, h = {} mm: jump (patch {:.1e}, resolved {:.1e})",
                           2.0 * slope, 1e3 * h, of_rule[1], of_rule[2]),
               of_rule[0], std::max({of_rule[1], of_rule[2], 2e-6}));
      EXPECT_LE(of_rule[0], std::max({of_rule[1], of_rule[2], 2e-6}));
    }
}

/// Over a convex edge of 90 degrees and back through the air: net over gross work, where the shares of the
/// rules change along the way.
TEST(AutoWall, WorkAroundAnEdgeIsSmallWhereBothRulesShare) {
  const double half = 10e-3, reach = 0.98 * R, s = std::sqrt(0.5);
  const std::vector<Vec3> corners{
      {half + reach, 0.3e-3, half - 1e-3},          {half + 0.99 * reach, 0.3e-3, half + 0.3e-3},
      {half + s * reach, 0.3e-3, half + s * reach}, {half - 1e-3, 0.3e-3, half + reach},
      {half - 1e-3, 0.3e-3, half + 1.1 * R},        {half + 1.1 * R, 0.3e-3, half - 1e-3}};
  for (const int cells : {4, 20, 28, 60}) {
    Press press(box_mesh(half, cells), ContactRule::automatic);
    double net = 0.0, gross = 0.0, most = 0.0;
    constexpr int n = 1000;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vec3 step = (corners[(k + 1) % corners.size()] - corners[k]) / n;
      for (int i = 0; i < n; ++i) {
        const double work = dot(press(corners[k] + (i + 0.5) * step), step);
        net += work;
        gross += std::abs(work);
        most = std::max(most, press.patch);
      }
    }
    measured(fmt::format(
                 "auto, loop over a convex edge, h = {:.2f} mm (share of patch up to {:.2f}): net/gross work",
                 2e3 * half / cells, most),
             std::abs(net) / gross, 0.05);
    EXPECT_LT(std::abs(net) / gross, 0.05);
  }
}

/// Grains fall onto the graded plate and slide: what they wear, and how often they strike.
TEST(AutoWall, WearsAndCountsImpactsLikeEachOfItsRules) {
  const TriangleMesh mesh = graded_plate();
  double volume[2];
  std::uint64_t impacts[2];
  int k = 0;
  for (const ContactRule rule : {ContactRule::automatic, ContactRule::patch}) {
    SphereOnMesh s;
    s.mesh = mesh;
    s.contact = rule;
    s.friction = 0.3;
    s.restitution = 0.6;
    s.deformation = DeformationRule::conserving;
    s.wear_coefficient = 1e-13;
    s.gravity = {0.0, 0.0, -9.81};
    s.time_step = 2e-6;
    s.end = 0.06;
    simulation::Setup setup = s.setup();
    setup.particles.clear();
    setup.contacts.push_back({"ball", "ball", 0.6, 0.3, 0.0});
    setup.wear[0].laws = {WearLaw::archard, WearLaw::impact_energy};
    setup.wear[0].normal_energy_coefficient = 1e-13;
    setup.wear[0].shear_energy_coefficient = 1e-13;
    InsertionSetup grains;
    grains.name = "grains";
    grains.material = "ball";
    grains.volume.shape = VolumeShape::file;
    for (int i = 0; i < 10; ++i)
      grains.placed.push_back({{-1e-3 + 2.6e-3 * i, 0.02e-3 * i, 1.2e-3}, 1e-3, {0.1, 0.0, -0.6 - 0.05 * i}});
    setup.insertions = {grains};
    Simulation run(setup, [&](const MeshSetup&, std::uint64_t) { return mesh; });
    while (!run.finished()) run.step();
    const Ledger books = run.ledger();
    EXPECT_LT(books.residual, 1e-9);
    volume[k] = books.law;
    impacts[k++] = run.impacts_on(0).count();
  }
  measured("auto: worn volume against patch", volume[0] / volume[1] - 1.0, 1e-3);
  EXPECT_NEAR(volume[0] / volume[1], 1.0, 1e-3);
  EXPECT_EQ(impacts[0], impacts[1]);
}

}  // namespace
}  // namespace abradem::test
