// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/simulation/sphere_wall.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "abradem/contact/full_law.h"
#include "abradem/geometry/closest_point.h"

namespace abradem::simulation {

namespace {
std::size_t at(std::int32_t i) noexcept { return static_cast<std::size_t>(i); }

/// How far a contact can be drawn out before it snaps [m].
double stretch_of(const contact::PairProperties& pair, double R) noexcept {
  return pair.options.adhesion > 0.0 ? contact::stretch_at_snap(contact::PairConstants::of(pair), R) : 0.0;
}

void weigh(contact::ContactForce& force, double weight) noexcept {
  force.F_n *= weight;
  force.F_t *= weight;
}

}  // namespace

void SphereWall::prepare(Wall& wall, const Vec3& c, const Vec3& v, double R,
                         const contact::PairProperties& pair, double load, double dt) {
  if (wall.is_plane()) return;
  is_near_ = stays_near(wall, c, load) && touch_near(wall, c, R, pair);
  if (is_near_) return;
  // The Hertz footprint reaches down to half its approach below the deepest point, which in a conforming
  // groove lies outside the ball.
  const double approach = contact::hertz_overlap(pair, R, load);
  const double stretch = stretch_of(pair, R);
  reach_ = R + std::max(0.5 * approach, stretch);
  // Skin: some tens of steps of motion, but no more than the patch can hide in.
  const double v_n = std::abs(dot(v, axis_));
  const Vec3 sliding = v - dot(v, axis_) * axis_;
  const double v_t = norm(sliding);
  skin_ = by_patches(wall) ? contact::CandidateSkin{0.01 * R, 0.001 * R} : skin_of_points(R);
  skin_.normal = std::clamp(20.0 * v_n * dt, skin_.normal, 0.1 * R);
  skin_.slide = v_t > 0.0 ? sliding * (std::clamp(160.0 * v_t * dt, 0.01 * R, 0.25 * R) / v_t) : Vec3{};
  stale_ = candidates_.stale(wall.view(), c, reach_);
  // Under `patch` what is worn stays in contact over a short slide: wear ends at the contact radius a, the
  // ball at sqrt(2) a.
  const double short_slide = 0.4 * contact::contact_radius(R, approach);
  if (stale_ || !by_patches(wall) || norm2(c - noted_at_) > short_slide * short_slide) {
    add_centroid_motion(wall);
    noted_at_ = c;
  }
  if (stale_) book_elements(wall);
}

/// @return whether there still is a contact, and points stand for it
bool SphereWall::touch_near(const Wall& wall, const Vec3& c, double R, const contact::PairProperties& pair) {
  if (const std::uint64_t revision = wall.surface().revision(); near_->revision != revision) {
    add_centroid_motion(wall);
    for (std::size_t k = 0; k < near_->few.count; ++k) near_->few.triangle[k].follow(wall.surface().mesh());
    near_->revision = revision;
  }
  const std::span<const contact::PointContact> points =
      points_.resolved(near_->few, c, R, wall.surface().odometer(), wall.setup().sides == Sides::both);
  if (points.empty()) return false;
  if (wall.setup().contact == ContactRule::automatic && !suit_points(points, R)) return false;
  touches_.clear();
  touch_points(wall, R, pair, points);
  noted_at_ = c;  // as a search would have it
  return true;
}

/// After a search: does its result hold for some way? Only where nobody but `land` asks for what the search
/// leaves behind.
void SphereWall::note_near(const Wall& wall, double R, const contact::PairProperties& pair) {
  if (near_) near_->holds = false;
  const ContactRule rule = wall.setup().contact;
  const bool points = rule == ContactRule::resolved || rule == ContactRule::automatic;
  if (!points || scratch_ == nullptr || tip_.worn() || pair.options.adhesion > 0.0 || touches_.empty() ||
      owes_elements() ||
      std::ranges::any_of(touches_, [](const Touch& t) { return !t.of_point || t.weight != 1.0; }))
    return;
  if (!near_) near_ = std::make_unique<Near>();
  if (!points_.note(candidates_, candidates_.skin_left(centre_), near_->few)) return;
  near_->holds = near_->few.way.least() > 0.0;
  near_->revision = wall.view().revision;
  near_->load = 0.999 * contact::hertz_force(pair, R, 2.0 * (candidates_.built_reach() - R));
}

/// Points need few triangles, and where these are coarse a wide margin hardly adds to them: within it, the
/// ball does not grow by more than half of one.
contact::CandidateSkin SphereWall::skin_of_points(double R) const noexcept {
  const double edge2 = candidates_.longest_edge2_at_gather();
  return {std::clamp(0.25 * std::sqrt(edge2), 0.01 * R, 0.1 * R),
          std::clamp(0.125 * edge2 / R, 0.001 * R, 0.02 * R)};
}

void SphereWall::find(const Wall& wall, const Vec3& c, double R, const contact::PairProperties& pair) {
  centre_ = c;
  if (is_near_) {
    axis_ = -touches_.front().n;
    return;
  }
  if (wall.is_plane()) {
    touches_.clear();
    touch_plane(wall, c, R, pair);
    return;
  }
  // Where spheres sleep, a run that is resumed wakes them at other steps.
  const ContactRule rule = wall.setup().contact;
  candidates_.update(wall.view(), c, axis_, reach_, skin_,
                     rule == ContactRule::resolved || rule == ContactRule::automatic);
  if (stale_) note_nodes();
  const bool patches_first = by_patches(wall);
  touches_.clear();
  switch (wall.setup().contact) {
    case ContactRule::patch:
      touch_patches(R, patches_.evaluate(candidates_, c, R, pair, tip_));
      break;
    case ContactRule::resolved:
      touch_points(
          wall, R, pair,
          points_.resolved(candidates_, c, R + stretch_of(pair, R), tip_, wall.setup().sides == Sides::both));
      break;
    case ContactRule::per_triangle:
      touch_points(wall, R, pair, points_.per_triangle(candidates_, c, R, tip_));
      break;
    case ContactRule::automatic:
      touch_either(wall, c, R, pair, patches_first);
      break;
  }
  if (!touches_.empty()) axis_ = -touches_.front().n;
  note_near(wall, R, pair);
}

contact::FreeWay SphereWall::free_way(const Wall& wall) const noexcept {
  if (wall.is_plane() || wall.setup().contact == ContactRule::patch || !touches_.empty() || !memory_.empty())
    return {};
  return points_.free_way(candidates_.skin_left(centre_));
}

void SphereWall::touch_patches(double R, std::span<const contact::Patch> patches) {
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const contact::Patch& p = patches[i];
    if (!(p.elastic_force > 0.0)) continue;
    touches_.push_back({.n = p.n,
                        .point = centre_ - R * p.n,
                        .overlap = p.overlap,
                        .elastic_force = p.elastic_force,
                        .a = contact::contact_radius(R, p.overlap),
                        .deepest = p.deepest,
                        .key = -1,
                        .part = static_cast<int>(i),
                        .nearest = -1,
                        .force = {}});
  }
}

void SphereWall::touch_points(const Wall& wall, double R, const contact::PairProperties& pair,
                              std::span<const contact::PointContact> points) {
  const bool every = wall.setup().contact == ContactRule::per_triangle;
  const double stretch = every ? 0.0 : stretch_of(pair, R);
  for (const contact::PointContact& p : points) {
    const double overlap = p.overlap - stretch, depth = std::max(overlap, 0.0);
    if (overlap <= 0.0 && !sticking(p.n)) continue;
    Touch& touch = touches_.emplace_back();  // in place: to copy it would take longer than to find it
    touch.n = p.n;
    touch.point = p.point;
    touch.overlap = overlap;
    touch.elastic_force = contact::hertz_force(pair, R, depth);
    touch.a = contact::contact_radius(R, depth);
    touch.deepest = p.overlap;  // in the field of the stretched sphere, whose differences count
    touch.key = every ? candidates_.triangle[at(p.triangle)] : -1;
    touch.part = every ? p.triangle : p.set;
    touch.nearest = p.triangle;
    touch.of_point = true;
  }
}

/// Both rules, each with its share. The shares follow from the overlapped triangles alone, so the force is as
/// continuous as those of the rules. What went before decides only which rule is asked first.
void SphereWall::touch_either(const Wall& wall, const Vec3& c, double R, const contact::PairProperties& pair,
                              bool patches_first) {
  std::span<const contact::PointContact> points;
  const auto points_do = [&] {
    points = points_.resolved(candidates_, c, R);
    if (!suit_points(points, R)) return false;
    patches_.forget();
    touches_.clear();
    touch_points(wall, R, pair, points);
    return true;
  };
  if (!patches_first && points_do()) return;
  touch_patches(R, patches_.evaluate(candidates_, c, R, pair, tip_));
  const std::size_t patches = touches_.size();
  bool all = patches > 0;
  for (Touch& t : touches_) {
    t.weight =
        patches_.fineness_of(candidates_, patches_.clusters(), t.part, contact::contact_radius(R, t.deepest));
    all = all && t.weight == 1.0;
  }
  if (all || (patches_first && points_do())) return;
  touch_points(wall, R, pair, points);
  for (std::size_t k = patches; k < touches_.size(); ++k) {
    Touch& t = touches_[k];
    double fine =
        patches == 0 ? 0.0 : patches_.fineness_of(candidates_, points_.sets(candidates_), t.part, t.a);
    if (fine < 0.0) fine = contact::fineness(t.a, contact::width_of(candidates_, at(t.nearest)));
    t.weight = 1.0 - fine;
  }
  std::erase_if(touches_, [](const Touch& t) { return !(t.weight > 0.0); });
  for (Touch& t : touches_) t.elastic_force *= t.weight;
}

/// Do point contacts stand for the whole, so that the patches need not be asked? Where all triangles in the
/// ball are coarse; and on one plane, where the two rules are equal, unless all are fine.
bool SphereWall::suit_points(std::span<const contact::PointContact> points, double R) const noexcept {
  constexpr double kPlane2 = 1e-12;  // sine squared
  if (points.empty()) return false;
  double deepest = 0.0;
  for (const contact::PointContact& p : points) deepest = std::max(deepest, p.overlap);
  const double a = contact::contact_radius(R, deepest);
  const std::span<const contact::CandidateTriangle> touched = points_.touched_triangles();
  const contact::CandidateTriangle& first = touched[points.front().place];
  bool coarse = true, fine = true, plane = points.size() == 1;
  for (const contact::CandidateTriangle& t : touched) {
    const double share = contact::fineness(a, contact::width_of(t));
    coarse = coarse && share == 0.0;
    fine = fine && share == 1.0;
    plane = plane && norm2(cross(t.normal, first.normal)) <= kPlane2 * norm2(t.normal) * norm2(first.normal);
  }
  return coarse || (plane && !fine);
}

/// Does the surface act through patches alone now?
bool SphereWall::by_patches(const Wall& wall) const noexcept {
  if (wall.is_plane()) return false;
  if (wall.setup().contact != ContactRule::automatic) return wall.setup().contact == ContactRule::patch;
  return !touches_.empty() && std::ranges::none_of(touches_, &Touch::of_point);
}

void SphereWall::touch_plane(const Wall& wall, const Vec3& c, double R, const contact::PairProperties& pair) {
  const MeshSetup& plane = wall.setup().mesh;
  double overlap = R - dot(c - plane.position, plane.normal);
  if (tip_.worn()) overlap = tip_.overlap((overlap - R) * plane.normal, R);
  if (overlap <= 0.0 && !(pair.options.adhesion > 0.0 && sticking(plane.normal))) return;
  const double depth = std::max(overlap, 0.0);
  touches_.push_back({.n = plane.normal,
                      .point = c - R * plane.normal,
                      .overlap = overlap,
                      .elastic_force = contact::hertz_force(pair, R, depth),
                      .a = contact::contact_radius(R, depth),
                      .deepest = depth,
                      .key = -1,
                      .part = 0,
                      .nearest = -1,
                      .of_point = true,
                      .force = {}});
}

/// The memory that continues in this contact: the same element, else the unclaimed contact nearest in place
/// (per_triangle), or the one that faced most alike, within 25 degrees (patch, resolved). None: a new one.
/// Of two rules that share a contact each has its own; one that comes in goes on from the other's.
SphereWall::Memory& SphereWall::recall(const Touch& touch, ContactRule rule) {
  Memory* best = nullptr;
  double best_score = rule == ContactRule::per_triangle ? -std::numeric_limits<double>::infinity() : 0.9;
  const bool either = rule == ContactRule::automatic;
  for (Memory& m : memory_) {
    if (m.used || (either && m.of_point != touch.of_point)) continue;
    const double score = rule != ContactRule::per_triangle ? dot(m.n, touch.n)
                         : m.key == touch.key              ? std::numeric_limits<double>::infinity()
                                                           : -norm2(m.point - touch.point);
    if (score > best_score) best = &m, best_score = score;
  }
  Memory& memory = scratch().kept.emplace_back();
  memory.n = touch.n;
  memory.point = touch.point;
  memory.key = touch.key;
  memory.of_point = touch.of_point;
  if (best != nullptr)
    best->used = true;
  else if (either)
    for (Memory& m : memory_)
      if (const double score = dot(m.n, touch.n); score > best_score) best = &m, best_score = score;
  memory.fresh = best == nullptr;
  if (best == nullptr) return memory;
  memory.history = best->history;
  memory.speed = best->speed;
  memory.angle = best->angle;
  memory.approaching = best->approaching;
  return memory;
}

/// A contact that begins notes how the surfaces meet; it strikes in the step in which they no longer come
/// closer, where the footprint is largest. Where two rules share a contact the heavier one strikes, for both.
/// @param v of the sphere's surface against the wall's
void SphereWall::watch_impact(Memory& memory, const Touch& touch, const Vec3& v) noexcept {
  const double v_n = dot(v, touch.n);
  if (memory.fresh && v_n < 0.0) {
    memory.speed = norm(v);
    memory.angle = std::asin(std::min(1.0, -v_n / memory.speed));
    memory.approaching = true;
  }
  memory.striking = memory.approaching && v_n >= 0.0 && touch.weight >= 0.5;
  if (!memory.striking) return;
  memory.approaching = false;
  if (touch.weight == 1.0) return;
  for (auto* memories : {&memory_, &scratch().kept})
    for (Memory& m : *memories)
      if (dot(m.n, touch.n) > 0.9) m.approaching = false;
}

/// The damper's power is (D v_n)^2 / D, and of Hertz's contact D v_n is what it takes off the elastic force.
wear::WorkSample SphereWall::work_of(const Touch& touch, double slip, double mass,
                                     const contact::PairProperties& pair, double dt) noexcept {
  const double damper = contact::damping_coefficient(pair, contact::normal_stiffness(pair, touch.a), mass);
  const double by_damper = (touch.elastic_force - touch.force.F_n) / touch.weight;
  const double power = !pair.options.damped_hertz() ? touch.damper_power
                       : damper > 0.0               ? by_damper * by_damper / damper
                                                    : 0.0;
  return {.contact = {std::max(touch.force.F_n, 0.0), slip},
          .shear_work = norm(touch.force.F_t) * slip,
          .normal_loss = touch.weight * power * dt};
}

/// Does a contact that faces this way last from the step before?
bool SphereWall::sticking(const Vec3& n) const noexcept {
  return std::ranges::any_of(memory_, [&](const Memory& m) { return dot(m.n, n) > 0.9; });
}

/// One contact by the law of pairs with options; the torque is beside that of the lever arm. In the wall's
/// frame.   @return whether it is still there
bool SphereWall::compute_with_options(Touch& touch, const Vec3& v, const SphereState& sphere,
                                      const Vec3& spin, const contact::PairProperties& pair, double dt,
                                      contact::TangentialHistory& history, Vec3& torque) const {
  contact::ContactChunk c;
  contact::OptionsChunk o;
  const double R = sphere.radius, a = touch.overlap > 0.0 ? touch.overlap * (2.0 * R - touch.overlap) : 0.0;
  const contact::PairConstants constants = contact::PairConstants::of(pair);
  c.set_constants(0, constants);
  o.set_constants(0, constants);
  o.held[0] = 1.0;  // what is found apart is found because it sticks
  // The contact rule knows the elastic force; a patch in a groove is stiffer than Hertz on a plane.
  const double plane = touch.overlap > 0.0 ? contact::hertz_force(pair, R, touch.overlap) : 0.0;
  if (plane > 0.0) c.elastic[0] *= touch.elastic_force / touch.weight / plane;
  c.nx[0] = touch.n.x, c.ny[0] = touch.n.y, c.nz[0] = touch.n.z;
  c.vx[0] = v.x, c.vy[0] = v.y, c.vz[0] = v.z;
  c.sx[0] = history.s.x, c.sy[0] = history.s.y, c.sz[0] = history.s.z;
  c.overlap[0] = touch.overlap, c.R_eff[0] = R, c.m_eff[0] = sphere.mass;
  o.area[0] = std::numbers::pi * a;
  o.a_c[0] = contact::snapping_radius(constants, R);
  o.wx[0] = spin.x, o.wy[0] = spin.y, o.wz[0] = spin.z;
  o.mx[0] = history.rolling.x, o.my[0] = history.rolling.y, o.mz[0] = history.rolling.z;
  o.twist[0] = history.twist;
  o.inertia[0] = 0.4 * sphere.mass * R * R;
  for (std::size_t k = 1; k < 8; ++k) c.copy(0, k), o.copy(0, k);
  contact::full_law_loop(c, o, 8, dt);
  if (pair.options.adhesion > 0.0) touch.a = o.S_t[0] / constants.tangential;
  touch.force.F_n = c.F_n[0];
  touch.damper_power = o.lost[0];
  touch.force.F_t = Vec3{c.fx[0], c.fy[0], c.fz[0]} - c.F_n[0] * touch.n;
  touch.force.slip = c.slip[0] > 0.0 ? c.slip[0] / o.S_t[0] : 0.0;
  touch.force.v_t = norm(v - dot(v, touch.n) * touch.n);
  history = {{c.sx[0], c.sy[0], c.sz[0]}, {o.mx[0], o.my[0], o.mz[0]}, o.twist[0]};
  torque = {o.wx[0], o.wy[0], o.wz[0]};
  return o.parted[0] == 0.0;
}

ForceAndTorque SphereWall::compute(const Wall& wall, const geometry::Pose& pose, const SphereState& sphere,
                                   const contact::PairProperties& pair, double dt) {
  ForceAndTorque total;
  rolling_ = {};
  core::PooledVector<Memory>& kept = scratch().kept;
  kept.clear();
  kept.reserve(touches_.size());  // recall hands out references
  for (Touch& touch : touches_) {
    const Vec3 n = pose.turn(touch.n);
    const Vec3 arm = -sphere.radius * n;
    const Vec3 v = sphere.velocity + cross(sphere.spin, arm) - pose.velocity_at(sphere.position + arm);
    contact::ContactState state{touch.n, touch.elastic_force / touch.weight, touch.a, sphere.mass,
                                pose.turn_back(v)};
    if (wall.is_belt()) state.v -= wall.belt_velocity(touch.n);
    Memory& memory = recall(touch, wall.setup().contact);
    touch.memory = static_cast<int>(kept.size()) - 1;
    if (wall.watches_impacts()) watch_impact(memory, touch, state.v);
    if (pair.options.any()) {
      Vec3 torque;
      const Vec3 spin = pose.turn_back(sphere.spin - pose.spin);
      if (!compute_with_options(touch, state.v, sphere, spin, pair, dt, memory.history, torque)) {
        kept.pop_back();
        touch.memory = -1;
        continue;
      }
      weigh(touch.force, touch.weight);
      torque *= touch.weight;
      const Vec3 tangential = pose.turn(touch.force.F_t);
      total.force += touch.force.F_n * n + tangential;
      total.torque += cross(arm, tangential) + pose.turn(torque);
      rolling_ += pose.turn(torque);
      continue;
    }
    touch.force = contact::hertz_mindlin(pair, state, dt, memory.history);
    weigh(touch.force, touch.weight);
    const Vec3 tangential = pose.turn(touch.force.F_t);
    total.force += touch.force.F_n * n + tangential;
    const double I = 0.4 * touch.weight * sphere.mass * sphere.radius * sphere.radius;
    const Vec3 rolling =
        contact::rolling_torque(pair, sphere.radius, touch.force.F_n, sphere.spin - pose.spin, I, dt);
    total.torque += cross(arm, tangential) + rolling;
    rolling_ += rolling;
  }
  memory_.assign(kept.begin(), kept.end());
  return total;
}

ForceAndTorque SphereWall::load(const geometry::Pose& pose, double R) const noexcept {
  ForceAndTorque sum;
  for (const Touch& touch : touches_) {
    const Vec3 n = pose.turn(touch.n), tangential = pose.turn(touch.force.F_t);
    sum.force += touch.force.F_n * n + tangential;
    sum.torque += cross(-R * n, tangential);
  }
  if (!touches_.empty()) sum.torque += rolling_;
  return sum;
}

NormalParts SphereWall::normal_parts(const Wall& wall, const Vec3& axis) const noexcept {
  NormalParts parts;
  const auto add = [&](const Vec3& force) {
    const double along = dot(force, axis);
    parts.along += along;
    parts.across += norm(force - along * axis);
    parts.sum += norm(force);
  };
  Vec3 resultant;
  for (const Touch& touch : touches_) resultant += touch.force.F_n * touch.n;
  if (!by_patches(wall) || touches_.empty()) {
    for (const Touch& touch : touches_) add(touch.force.F_n * touch.n);
    return parts;
  }
  // F = K sum_T G_T n_T over the nodes: each carries its overlap times its third of the area vectors around.
  const std::span<const double> excess = patches_.node_excess();
  Vec3 whole;
  for (std::size_t i = 0; i < candidates_.node_count(); ++i) {
    if (!(excess[i] > 0.0)) continue;
    const Vec3 part = excess[i] * Vec3{candidates_.bx[i], candidates_.by[i], candidates_.bz[i]};
    whole += part;
    add(part);
  }
  if (!(norm2(whole) > 0.0)) {  // a patch smaller than a triangle holds no node
    parts = {};
    for (const Touch& touch : touches_) add(touch.force.F_n * touch.n);
    return parts;
  }
  const double scale = norm(resultant) / norm(whole);
  parts.along *= scale;
  parts.across *= scale;
  parts.sum *= scale;
  return parts;
}

double SphereWall::pending_volume() const noexcept {
  double sum = 0.0;
  for (const double v : node_pending_) sum += v;
  return sum;
}

/// Adds what the centroids of the elements in contact have moved since they were last noted, and notes them.
void SphereWall::add_centroid_motion(const Wall& wall) {
  centroid_volume_ += unnoted_centroid_volume(wall);
  if (wall.setup().deformation != DeformationRule::conserving) return;
  if (noted_revision_ == wall.view().revision) return;
  noted_revision_ = wall.view().revision;
  for (std::size_t i = 0; i < noted_.size(); ++i)
    noted_[i] = wall.surface().mesh().vertices[at(candidates_.node[i])];
}

double SphereWall::area_when_noted(std::size_t t) const noexcept {
  const Vec3& a = noted_[at(candidates_.v0[t])];
  return 0.5 * norm(cross(noted_[at(candidates_.v1[t])] - a, noted_[at(candidates_.v2[t])] - a));
}

double SphereWall::unnoted_centroid_volume(const Wall& wall) {
  if (wall.setup().deformation != DeformationRule::conserving) return 0.0;
  if (noted_revision_ == wall.view().revision) return 0.0;  // nothing has moved since
  const geometry::TriangleMesh& mesh = wall.surface().mesh();
  const bool patch = by_patches(wall);
  const std::span<const double> excess = patches_.node_excess();
  bool moved = false;
  for (std::size_t i = 0; i < noted_.size(); ++i) {
    const Vec3 motion = mesh.vertices[at(candidates_.node[i])] - noted_[i];
    motion_[i] = {motion.x, motion.y, motion.z, patch && excess[i] > 0.0 ? 1.0 : 0.0};
    moved = moved || motion != Vec3{};
  }
  if (!moved) return 0.0;
  if (patch) return contact::kernels::centroid_motion(candidates_, motion_, terms_);
  double volume = 0.0;
  for (std::size_t t = 0; t < candidates_.triangle_count(); ++t) {
    const auto of_touch = [&](const Touch& touch) { return touch.part == static_cast<int>(t); };
    if (std::ranges::none_of(touches_, of_touch)) continue;
    Vec3 sum;
    for (const std::int32_t v : {candidates_.v0[t], candidates_.v1[t], candidates_.v2[t]})
      sum += Vec3{motion_[at(v)][0], motion_[at(v)][1], motion_[at(v)][2]};
    volume += norm(sum) * area_when_noted(t) / 3.0;
  }
  return volume;
}

/// Does the ball hold a corner of the candidate triangle?
bool SphereWall::inside(std::size_t t) const noexcept {
  const auto excess = patches_.node_excess();
  const double e0 = excess[at(candidates_.v0[t])], e1 = excess[at(candidates_.v1[t])],
               e2 = excess[at(candidates_.v2[t])];
  return std::max({e0, e1, e2}) > 0.0;
}

int SphereWall::elements(const Wall& wall) const {
  if (!by_patches(wall) || touches_.empty()) return static_cast<int>(touches_.size());
  int count = 0;
  for (std::size_t t = 0; t < candidates_.triangle_count(); ++t) count += inside(t);
  return std::max(count, static_cast<int>(touches_.size()));
}

geometry::Index SphereWall::nearest_triangle(const Vec3& c) const noexcept {
  geometry::Index nearest = -1;
  double distance2 = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < candidates_.triangle_count(); ++t) {
    const auto corner = [&](std::int32_t v) { return candidates_.node_position(at(v)); };
    const Vec3 point = geometry::closest_point_on_triangle(
                           c, corner(candidates_.v0[t]), corner(candidates_.v1[t]), corner(candidates_.v2[t]))
                           .point;
    if (norm2(point - c) < distance2) distance2 = norm2(point - c), nearest = candidates_.triangle[t];
  }
  return nearest;
}

void SphereWall::note_nodes() {
  noted_revision_ = kNeverNoted;
  noted_.resize(candidates_.node_count());
  motion_.assign(candidates_.x.size(), {});
  for (std::size_t i = 0; i < noted_.size(); ++i) noted_[i] = candidates_.node_position(i);
}

bool SphereWall::restore(const Wall& wall) {
  for (Pressing& pressing : ploughing_) pressing.contact.tip.shape = tip_.shape;
  patches_.restore(tip_);
  if (wall.is_plane()) return true;
  if (!candidates_.restore(wall.surface().mesh())) return false;
  const std::size_t nodes = candidates_.node_count(), padded = candidates_.x.size();
  motion_.assign(padded, {});
  return (noted_.empty() || noted_.size() == nodes) &&
         (node_pending_.empty() || node_pending_.size() == padded) &&
         (patches_.node_excess().empty() || patches_.node_excess().size() == padded);
}

void SphereWall::add_to(core::StateHash& hash) const {
  for (const Memory& m : memory_) {
    hash.add(m.history.s);
    if (m.history.rolling != Vec3{}) hash.add(m.history.rolling);
    if (m.history.twist != 0.0) hash.add(m.history.twist);
  }
  if (tip_pending_ != 0.0) hash.add(tip_pending_);
  if (unpiled_ != 0.0) hash.add(unpiled_);
}

double SphereWall::centroid_volume(const Wall& wall) {
  return wall.is_plane() ? 0.0 : centroid_volume_ + unnoted_centroid_volume(wall);
}

}  // namespace abradem::simulation
