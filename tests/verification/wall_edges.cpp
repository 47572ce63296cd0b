// SPDX-License-Identifier: BSD-3-Clause
// Edges, corners and steps. docs/verification/walls.md
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "abradem/contact/patch.h"
#include "abradem/contact/point_contacts.h"
#include "support/cases.h"
#include "support/surfaces.h"

namespace abradem::test {
namespace {

using simulation::ContactRule;

constexpr double R = PinOnDisc::kRadius;
const contact::PairProperties kPair{
    .E_eff = 2.6285e8, .G_eff = 5.675e7, .beta = 0.0, .static_friction = 0.0, .rolling_friction = 0.0};

/// Two plates that meet in the y axis; both fall (slope > 0, convex) or rise (concave) away from it.
TriangleMesh roof(double slope, double size = 20e-3) {
  TriangleMesh mesh;
  const double run = size * std::cos(slope), z = -size * std::sin(slope);
  mesh.vertices = {{0, -size, 0},  {0, size, 0},     {run, -size, z},
                   {run, size, z}, {-run, -size, z}, {-run, size, z}};
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {0, 1, 5}, {0, 5, 4}};
  return mesh;
}

std::string name_of(ContactRule rule) { return rule == ContactRule::patch ? "patch" : "resolved"; }

/// Elastic force on a ball by a rule, frictionless.
class Presser {
 public:
  Presser(TriangleMesh mesh, ContactRule rule) : scene_(std::move(mesh)), rule_(rule) {}
  Vec3 force(const Vec3& c) {
    Vec3 sum;
    const contact::CandidateSkin skin{0.3e-3, 0.1e-3};
    contact::MeshCandidates& m = scene_.candidates_at(c, R, {}, skin);
    contacts_ = 0;
    if (rule_ == ContactRule::patch) {
      for (const contact::Patch& p : patches_.evaluate(m, c, R, kPair)) {
        sum += p.elastic_force * p.n;
        ++contacts_;
      }
    } else {
      for (const contact::PointContact& p : points_.resolved(m, c, R)) {
        sum += contact::hertz_force(kPair, R, p.overlap) * p.n;
        ++contacts_;
      }
    }
    return sum;
  }
  [[nodiscard]] int contacts() const { return contacts_; }

 private:
  Scene scene_;
  ContactRule rule_;
  contact::PatchEvaluator patches_;
  contact::PointContactFinder points_;
  int contacts_ = 0;
};

class Edges : public testing::TestWithParam<ContactRule> {};

// W3. The height at which the wall carries the weight, by bisection on the vertical force.
double resting_height(Presser& presser, double x, double y, double low, double high, double weight) {
  for (int i = 0; i < 200; ++i) {
    const double z = 0.5 * (low + high);
    (presser.force({x, y, z}).z > weight ? low : high) = z;
  }
  return 0.5 * (low + high);
}

TEST_P(Edges, BallRestsOnAConvexEdgeAndOnAVertex) {
  const double weight = 1.0;
  Presser edge(roof(std::numbers::pi / 4), GetParam());
  const double z = resting_height(edge, 0.0, 1e-3, 0.9 * R, 1.01 * R, weight);
  const Vec3 f = edge.force({0.0, 1e-3, z});
  EXPECT_EQ(edge.contacts(), 1);
  EXPECT_NEAR(f.z / weight, 1.0, 1e-10);
  EXPECT_NEAR(f.x / weight, 0.0, 1e-10);
  EXPECT_NEAR(f.y / weight, 0.0, 1e-10);

  // The corner of a cube that stands on its opposite corner: three faces meet on top.
  TriangleMesh cube = box_mesh(10e-3, 1);
  const Vec3 u = normalized(Vec3{1, -1, 0}), v = normalized(Vec3{1, 1, -2}), w = normalized(Vec3{1, 1, 1});
  for (Vec3& p : cube.vertices) p = Vec3{dot(p, u), dot(p, v), dot(p, w) - 10e-3 * std::sqrt(3.0)};
  Presser vertex(cube, GetParam());
  const double top = resting_height(vertex, 0.0, 0.0, 0.8 * R, 1.01 * R, weight);
  const Vec3 g = vertex.force({0.0, 0.0, top});
  EXPECT_EQ(vertex.contacts(), 1);
  EXPECT_NEAR(g.z / weight, 1.0, 1e-10);
  EXPECT_NEAR(std::hypot(g.x, g.y) / weight, 0.0, 1e-10);
}

TEST_P(Edges, BallInAConcaveCornerStandsOnTwoContacts) {
  // 90 degrees: F = m g / sqrt 2 each; 150 degrees: 2 F cos 15 = m g.
  const double weight = 1.0;
  for (const double slope_degrees : {45.0, 15.0}) {
    const double slope = slope_degrees * std::numbers::pi / 180.0, apex = R / std::cos(slope);
    SphereOnMesh s;
    s.mesh = roof(-slope);
    Presser presser(s.mesh, GetParam());
    const double z = resting_height(presser, 0.0, 0.3e-3, apex - 0.05 * R, apex, weight);
    const Vec3 f = presser.force({0.0, 0.3e-3, z});
    EXPECT_EQ(presser.contacts(), 2);
    EXPECT_NEAR(f.z / weight, 1.0, 1e-10);
    EXPECT_NEAR(f.x / weight, 0.0, 1e-10);
    // Each contact is Hertz on its own plane.
    const double overlap = R - z * std::cos(slope);
    const double each = contact::hertz_force(kPair, R, overlap), expected = weight / (2.0 * std::cos(slope));
    measured(fmt::format("W3, {}, concave {} degrees: force of each contact", name_of(GetParam()),
                         180.0 - 2.0 * slope_degrees),
             each / expected - 1.0, 1e-10);
    EXPECT_NEAR(each / expected, 1.0, 1e-10);
  }
}

TEST_P(Edges, StepIsFeltOnGeometricContactOnlyAndTurnsTheNormalSmoothly) {
  // W4: a step of R / 10 at x = 0, up to the right; the ball slides on the lower floor.
  const double step = 0.1 * R, L = 20e-3;
  TriangleMesh mesh;
  mesh.vertices = {{-L, -L, 0},   {0, -L, 0},   {0, L, 0},     {-L, L, 0},
                   {0, -L, step}, {0, L, step}, {L, -L, step}, {L, L, step}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}, {4, 6, 7}, {4, 7, 5}};
  Presser presser(mesh, GetParam());
  const double delta = 10e-6, z = R - delta;
  // The ball's centre is higher than the step: it meets the step's edge first.
  const double touch = -std::sqrt(R * R - (z - step) * (z - step));
  for (const double gap : {0.5e-3, 1e-5, 1e-9}) {
    const Vec3 f = presser.force({touch - gap, 0.1e-3, z});
    EXPECT_NEAR(f.x, 0.0, 1e-12);
    EXPECT_NEAR(f.z / contact::hertz_force(kPair, R, delta), 1.0, 1e-7);
  }
  // Pushed up over the edge at one distance from it, then on over the upper floor at the same height: the
  // normal turns by no more than the path, and ends upright.
  std::vector<Vec3> path;
  constexpr int n = 400;
  const double low = std::acos((z - step + 2.0 * delta) / (R - delta)), even = low / n;
  for (int i = 0; i <= n; ++i) {  // from clear of the lower floor
    const double angle = low * (1.0 - static_cast<double>(i) / n);
    path.push_back({-(R - delta) * std::sin(angle), 0.1e-3, step + (R - delta) * std::cos(angle)});
  }
  for (int i = 1; i <= n; ++i) path.push_back({(R - delta) * even * i, 0.1e-3, step + R - delta});
  double largest_turn = 0.0;
  Vec3 before = normalized(presser.force(path.front()));
  for (const Vec3& c : path) {
    const Vec3 normal = normalized(presser.force(c));
    largest_turn = std::max(largest_turn, norm(normal - before));
    before = normal;
  }
  measured(fmt::format("W4, {}: largest turn of the normal per step, over an even one", name_of(GetParam())),
           largest_turn / even, 2.0);
  EXPECT_LT(largest_turn / even, 2.0);
  EXPECT_NEAR(norm(before - Vec3{0, 0, 1}), 0.0, 1e-12);
}

TEST_P(Edges, StickingContactKeepsItsSpringAcrossEdges) {
  // W5: a ball held by friction on a mesh that creeps under it: the contact point crosses edges and vertices
  // while F_t grows by S_t v dt a step, as on a plane.
  SphereOnMesh s;
  s.mesh = jittered_plate(6e-3, 4e-3, GetParam() == ContactRule::patch ? 0.1e-3 : 0.4e-3, 0.25, 3);
  s.friction = 100.0;  // sticks throughout
  s.guided = true;
  s.load = {0.0, 0.0, -5.0};
  const double delta = contact::hertz_overlap(s.pair(), R, 5.0);
  s.position = {0.07e-3, 0.03e-3, R - delta};
  s.motion.kind = simulation::MotionKind::translation;
  s.motion.velocity = {0.05, 0.013, 0.0};
  s.contact = GetParam();
  s.time_step = 1e-5;
  s.end = 12e-3;  // 0.6 mm of sliding
  simulation::Simulation run = s.run();
  const double a = contact::contact_radius(R, delta);
  const double S_t = contact::tangential_stiffness(s.pair(), a), v = norm(s.motion.velocity);
  const double damping = contact::damping_coefficient(
                             [&] {
                               auto p = s.pair();
                               p.beta = material::damping_ratio(s.restitution);
                               return p;
                             }(),
                             S_t, s.mass()) *
                         v;
  double jump = 0.0, drift = 0.0, before = 0.0;
  while (!run.finished()) {
    run.step();
    const double force = run.force_on(0).tangential, growth = S_t * v * run.time_step();
    if (run.steps() > 1) jump = std::max(jump, std::abs(force - before - growth) / force);
    drift = std::max(drift, std::abs(force / (S_t * v * run.time() + damping) - 1.0));
    before = force;
  }
  measured(fmt::format("W5, {}: jump of the tangential force in a step", name_of(GetParam())), jump, 1e-6);
  measured(fmt::format("W5, {}: drift of the tangential force over 0.6 mm", name_of(GetParam())), drift,
           1e-5);
  EXPECT_LT(jump, 1e-6);
  EXPECT_LT(drift, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Rules, Edges, testing::Values(ContactRule::patch, ContactRule::resolved),
                         [](const auto& instance) { return name_of(instance.param); });

/// Work along a closed path, net over gross, by the midpoint rule on n steps a side.
double net_work(Presser& presser, const std::vector<Vec3>& corners, int n) {
  double net = 0.0, gross = 0.0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec3 step = (corners[(k + 1) % corners.size()] - corners[k]) / n;
    for (int i = 0; i < n; ++i) {
      const double work = dot(presser.force(corners[k] + (i + 0.5) * step), step);
      net += work;
      gross += std::abs(work);
    }
  }
  return std::abs(net) / gross;
}

TEST(ClosedLoop, PatchDoesNoWorkAroundEdgesAndVertices) {
  struct Loop {
    const char* name;
    TriangleMesh mesh;
    std::vector<Vec3> corners;
  };
  const double half = 10e-3, reach = R - 0.02 * R;
  const Vec3 y{0, 0.3e-3, 0};
  std::vector<Loop> loops;
  // Over the convex edge of a roof: in from one face, over the ridge, down the other, back through the air.
  const double s = std::sqrt(0.5);
  loops.push_back({"convex edge",
                   box_mesh(half, 3),
                   {Vec3{half + reach, 0.3e-3, half - 1e-3}, Vec3{half + reach * 0.99, 0.3e-3, half + 0.3e-3},
                    Vec3{half + s * reach, 0.3e-3, half + s * reach}, Vec3{half - 1e-3, 0.3e-3, half + reach},
                    Vec3{half - 1e-3, 0.3e-3, half + 1.1 * R}, Vec3{half + 1.1 * R, 0.3e-3, half - 1e-3}}});
  // Over the vertex of a cube.
  const double t = std::sqrt(1.0 / 3.0);
  loops.push_back(
      {"convex vertex",
       box_mesh(half, 3),
       {Vec3{half - 1e-3, half - 1e-3, half + reach},
        Vec3{half + t * reach, half + t * reach, half + t * reach},
        Vec3{half + reach, half - 1e-3, half - 1e-3}, Vec3{half + 1.1 * R, half + 1.1 * R, half + 1.1 * R}}});
  // Down into a concave corner and out, with the two patches growing together near the edge.
  loops.push_back(
      {"concave edge, 90 degrees",
       roof(-std::numbers::pi / 4),
       {Vec3{0, 0, std::sqrt(2.0) * reach} + y, Vec3{0.01 * R, 0, std::sqrt(2.0) * (R - 0.01 * R)} + y,
        Vec3{0.02 * R, 0, 1.5 * R} + y, Vec3{-0.02 * R, 0, 1.45 * R} + y}});
  loops.push_back({"concave edge, 150 degrees",
                   roof(-std::numbers::pi / 12),
                   {Vec3{0, 0, reach / std::cos(std::numbers::pi / 12)} + y,
                    Vec3{0.05 * R, 0, reach / std::cos(std::numbers::pi / 12) + 0.014 * R} + y,
                    Vec3{0.02 * R, 0, 1.1 * R} + y, Vec3{-0.05 * R, 0, 1.1 * R} + y}});
  for (Loop& loop : loops) {
    Presser presser(loop.mesh, ContactRule::patch);
    const double work = net_work(presser, loop.corners, 4000);
    measured(fmt::format("closed loop, {}: net over gross work", loop.name), work, 1e-6);
    EXPECT_LT(work, 1e-6) << loop.name;
  }
}

}  // namespace
}  // namespace abradem::test
