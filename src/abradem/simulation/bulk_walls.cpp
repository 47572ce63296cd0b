// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/simulation/bulk_walls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "abradem/core/parallel.h"

namespace abradem::simulation {

namespace {

std::size_t at(std::int32_t i) noexcept { return static_cast<std::size_t>(i); }

constexpr std::size_t kPart = 16, kWorthSharing = 16;  // spheres near meshes, parts of them

contact::MovingPlane plane_of(const Wall& wall, const geometry::Pose& pose) {
  contact::MovingPlane plane{wall.setup().mesh.position, wall.setup().mesh.normal, pose};
  if (wall.is_belt()) plane.pose.velocity += pose.turn(wall.belt_velocity(plane.normal));
  return plane;
}

SphereState state_of(const contact::SphereRow& s) noexcept {
  return {s.position(), s.velocity(), s.spin(), s.radius, 1.0 / s.inverse_mass};
}

/// Bound of the speed at which a wall comes closer to any sphere while none of them, nor the wall, has moved
/// by more than the skin: the sum over its motions, each with its largest speed over all time, and each
/// rotation with its arm, in its own frame, to the furthest sphere or (if that is less) to the furthest
/// vertex.
double largest_speed(const Wall& wall, const contact::Spheres& spheres, double skin, double time) {
  double sum = 0.0;
  geometry::Pose outer;  // of all motions on top of the k-th
  for (std::size_t k = wall.setup().motions(); k-- > 0;) {
    const MotionSetup& m = wall.setup().motion_at(k);
    const geometry::Pose pose = pose_of(m, time);
    const MotionLimits most = limits_of(m);
    sum += most.speed;
    if (most.rate > 0.0) {
      double arm2 = 0.0;
      for (const contact::SphereRow& s : spheres.row)
        arm2 = std::max(arm2, norm2(cross(m.axis, outer.to_body(s.position()) - pose.shift - m.center)));
      if (!wall.is_plane()) {
        const geometry::Pose inner = pose_of(wall.setup(), k, time);
        double mesh2 = 0.0;
        for (const Vec3& v : wall.surface().mesh().vertices)
          mesh2 = std::max(mesh2, norm2(cross(m.axis, inner.to_world(v) - m.center)));
        arm2 = std::min(arm2, mesh2);
      }
      sum += most.rate * (std::sqrt(arm2) + skin);
    }
    if (k > 0) outer = geometry::compose(outer, pose);
  }
  return sum;
}

}  // namespace

void BulkWalls::find_constants(const Surroundings& around) {
  constants_.resize(around.walls.size() * around.materials);
  options_ = false;
  for (std::size_t w = 0; w < around.walls.size(); ++w)
    for (std::size_t m = 0; m < around.materials; ++m) {
      const material::PairProperties& pair = around.pair(static_cast<int>(m), around.walls[w].material());
      constants_[w * around.materials + m] = contact::PairConstants::of(pair);
      options_ = options_ || pair.options.any();
    }
}

bool BulkWalls::restore(const contact::Spheres& spheres, const Surroundings& around) {
  find_constants(around);
  for (std::size_t w = 0; w < planes_.size(); ++w)
    if (!planes_[w].fits(spheres.size()) || (planes_[w].size() > 0 && !around.walls[w].is_plane()))
      return false;
  for (const NearMesh& m : meshes_) {
    const bool there = m.sphere >= 0 && at(m.sphere) < spheres.size() && m.wall >= 0 &&
                       at(m.wall) < around.walls.size() && m.id == spheres.id[at(m.sphere)];
    if (!there || around.walls[at(m.wall)].is_plane() || !m.contact->restore(around.walls[at(m.wall)]))
      return false;
  }
  return true;
}

void BulkWalls::rebuild(const contact::Spheres& spheres, const Surroundings& around, double skin,
                        int first_id, std::vector<double>& paper) {
  find_constants(around);
  fastest_wall_ = 0.0;
  next_removal_ = std::numeric_limits<double>::infinity();
  for (std::size_t w = 0; w < around.walls.size(); ++w) {
    const Wall& wall = around.walls[w];
    if (!wall.present(around.time)) {
      planes_[w] = {};
      continue;
    }
    if (wall.setup().until) next_removal_ = std::min(next_removal_, *wall.setup().until);
    fastest_wall_ = std::max(fastest_wall_, largest_speed(wall, spheres, skin, around.time));
    odometer_[w] = wall.is_plane() ? 0.0 : wall.surface().odometer();
    if (wall.is_plane()) planes_[w].rebuild(spheres, plane_of(wall, around.poses[w]), skin, first_id);
  }
  list_meshes(spheres, around, skin, first_id, paper);
}

void BulkWalls::list_meshes(const contact::Spheres& spheres, const Surroundings& around, double skin,
                            int first_id, std::vector<double>& paper) {
  double largest = 0.0;
  for (const contact::SphereRow& s : spheres.row) largest = std::max(largest, s.radius);
  constexpr std::size_t kBlock = contact::SphereList::kBlock;
  const std::size_t blocks = (spheres.size() + kBlock - 1) / kBlock;
  std::vector<NearMesh> before = std::move(meshes_);
  meshes_.clear();
  const auto key = [](const NearMesh& m) { return std::tuple(m.id, m.wall); };
  std::ranges::sort(before, {}, key);
  struct Found {
    NearMesh near;
    NearMesh* before = nullptr;
  };
  std::vector<std::vector<Found>> found(blocks);
  for (std::size_t w = 0; w < around.walls.size(); ++w)
    if (!around.walls[w].is_plane() && largest > 0.0)
      grids_[w].update(around.walls[w].view(), largest + skin);
  core::parallel_blocks(blocks, [&](std::size_t b) {
    for (std::size_t i = b * kBlock; i < std::min(spheres.size(), (b + 1) * kBlock); ++i) {
      if (spheres.id[i] < first_id) continue;
      const contact::SphereRow& s = spheres.row[i];
      for (std::size_t w = 0; w < around.walls.size(); ++w) {
        if (around.walls[w].is_plane() || !around.walls[w].present(around.time)) continue;
        const Vec3 c = around.poses[w].to_body(s.position());
        if (!grids_[w].may_be_near(c)) continue;
        NearMesh near;
        near.sphere = static_cast<std::int32_t>(i);
        near.id = spheres.id[i];
        near.wall = static_cast<std::int32_t>(w);
        const auto old = std::ranges::lower_bound(before, key(near), {}, key);
        const bool known = old != before.end() && key(*old) == key(near);
        if (!known || old->contact->touches().empty()) {  // those that touch are near
          const auto distance = distance_within(around.walls[w].view(), c, s.radius + skin);
          if (!distance) continue;
          near.clear = *distance - s.radius;
        }
        found[b].push_back({std::move(near), known ? &*old : nullptr});
      }
    }
  });

  for (std::vector<Found>& block : found)
    for (auto& [near, old] : block) {
      if (old != nullptr) {
        near.contact = std::move(old->contact);
        near.expected = old->expected;
        near.load = old->load;
      } else {
        near.contact = std::make_unique<SphereWall>();
      }
      meshes_.push_back(std::move(near));
    }
  for (NearMesh& gone : before) {
    if (!gone.contact) continue;
    Wall& wall = around.walls[at(gone.wall)];
    paper[at(gone.wall)] += gone.contact->centroid_volume(wall);
    gone.contact->book_elements(wall);
    unplaced_[at(gone.wall)] += gone.contact->unpiled_volume();
  }
}

void BulkWalls::prepare(const contact::Spheres& spheres, const Surroundings& around, double travelled) {
  for (NearMesh& m : meshes_) {
    m.come = travelled + around.walls[at(m.wall)].surface().odometer() - odometer_[at(m.wall)];
    m.awake = m.clear <= m.come;
    if (m.awake && m.owes) prepare(m, spheres.row[at(m.sphere)], around);
  }
}

/// By its own way over the wall, which most often is much less than the bound for all.
bool BulkWalls::sleeps_on(const NearMesh& m, const contact::SphereRow& s,
                          const Surroundings& around) noexcept {
  return m.way.any > 0.0 && m.way.holds(around.poses[at(m.wall)].to_body(s.position()),
                                        around.walls[at(m.wall)].surface().odometer());
}

void BulkWalls::prepare(NearMesh& m, const contact::SphereRow& s, const Surroundings& around) {
  const geometry::Pose& pose = around.poses[at(m.wall)];
  Wall& wall = around.walls[at(m.wall)];
  m.expected = std::max({m.expected, norm(m.load.force()), norm(around.gravity) / s.inverse_mass});
  const Vec3 v = pose.turn_back(s.velocity() - pose.velocity_at(s.position()));
  m.contact->prepare(wall, pose.to_body(s.position()), v, s.radius,
                     around.pair(static_cast<int>(s.material), wall.material()), m.expected, around.dt);
}

bool BulkWalls::compute(const contact::Spheres& spheres, const Surroundings& around) {
  bool sound = true;
  for (std::size_t w = 0; w < planes_.size(); ++w) {
    if (planes_[w].size() == 0) continue;
    const std::span constants(constants_.data() + w * around.materials, around.materials);
    sound = contact::plane_forces(spheres, planes_[w], plane_of(around.walls[w], around.poses[w]), constants,
                                  options_, around.dt) &&
            sound;
  }
  const std::size_t parts = (meshes_.size() + kPart - 1) / kPart;
  std::vector<std::uint8_t> deep(parts, 0);
  wear_.resize(parts);
  core::parallel_for(
      parts,
      [&](std::size_t part) {
        static thread_local SphereWall::Scratch scratch;
        wear_[part].clear();
        const std::size_t end = std::min(meshes_.size(), kPart * (part + 1));
        std::array<std::size_t, kPart> awake{};
        std::size_t count = 0;
        for (std::size_t k = kPart * part; k < end; ++k) {
          if (!meshes_[k].awake || sleeps_on(meshes_[k], spheres.row[at(meshes_[k].sphere)], around))
            continue;
          meshes_[k].contact->fetch();
          awake[count++] = k;
        }
        if (count > 0) meshes_[awake[0]].contact->fetch_arrays();
        for (std::size_t a = 0; a < count; ++a) {
          const NearMesh& m = meshes_[awake[a]];
          if (a + 1 < count) meshes_[awake[a + 1]].contact->fetch_arrays();
          if (!around.ploughs) m.contact->lend(&scratch);
          if (compute(awake[a], spheres.row[at(m.sphere)], around, wear_[part])) deep[part] = 1;
          m.contact->lend(nullptr);
        }
      },
      kWorthSharing);
  return sound && std::ranges::none_of(deep, [](std::uint8_t d) { return d != 0; });
}

/// One sphere beside one mesh. @return whether it is too deep in it
bool BulkWalls::compute(std::size_t k, const contact::SphereRow& s, const Surroundings& around,
                        WearRecords& records) {
  NearMesh& m = meshes_[k];
  if (!m.owes) prepare(m, s, around);
  const Wall& wall = around.walls[at(m.wall)];
  const geometry::Pose& pose = around.poses[at(m.wall)];
  const material::PairProperties& pair = around.pair(static_cast<int>(s.material), wall.material());
  m.contact->find(wall, pose.to_body(s.position()), s.radius, pair);
  if (m.contact->touches().empty()) {
    m.way = m.contact->free_way(wall);
    m.clear = std::max(m.clear, m.come + m.way.least());
  } else {
    m.way.any = 0.0;
  }
  if (m.contact->touches().empty() && m.load.stiffening == 0.0 && m.load.force() == Vec3{}) return false;
  const SphereState sphere = state_of(s);
  const ForceAndTorque f = m.contact->compute(wall, pose, sphere, pair, around.dt);
  m.load = {f.force.x, f.force.y, f.force.z, 0.0, f.torque.x, f.torque.y, f.torque.z, 0.0};
  bool deep = false;
  for (const SphereWall::Touch& t : m.contact->touches()) {
    const double S = contact::step_stiffness(pair, t.a);
    const double D = contact::step_damping(pair, S, sphere.mass);
    m.load.stiffening += t.weight * (2.0 * D + S * around.dt) * around.dt;
    deep = deep || t.overlap > 0.5 * contact::kDeepest * s.radius;
  }
  const auto material = static_cast<std::size_t>(s.material);
  const WearUse use = around.wear[at(m.wall) * around.materials + material];
  if (use != WearUse::none)
    m.contact->record_wear(wall, sphere, pair,
                           {.sliding = {around.dt, wall.wears_by_speed()},
                            .sliding_only = use == WearUse::sliding,
                            .contact = static_cast<std::int32_t>(k),
                            .wall = m.wall,
                            .material = static_cast<std::int32_t>(material)},
                           records);
  return deep;
}

void BulkWalls::add_loads(std::size_t begin, std::size_t end, contact::LoadRows& load) const {
  const auto first = static_cast<std::int32_t>(begin), last = static_cast<std::int32_t>(end);
  for (const contact::PlaneList& plane : planes_) {
    const auto from = std::ranges::lower_bound(plane.sphere, first) - plane.sphere.begin();
    for (auto k = static_cast<std::size_t>(from); k < plane.size() && plane.sphere[k] < last; ++k)
      load[at(plane.sphere[k])] += plane.load[k];
  }
  auto near = std::ranges::lower_bound(meshes_, first, {}, &NearMesh::sphere);
  for (; near != meshes_.end() && near->sphere < last; ++near) load[at(near->sphere)] += near->load;
}

Vec3 BulkWalls::force_on(std::size_t wall) const noexcept {
  Vec3 sum;
  for (const contact::LoadRow& l : planes_[wall].load) sum -= l.force();
  for (const NearMesh& m : meshes_)
    if (at(m.wall) == wall) sum -= m.load.force();
  return sum;
}

std::size_t BulkWalls::contacts() const noexcept {
  std::size_t count = 0;
  for (const contact::PlaneList& plane : planes_)
    count += static_cast<std::size_t>(std::ranges::count(plane.touching, 1));
  for (const NearMesh& m : meshes_) count += m.contact->touches().size();
  return count;
}

}  // namespace abradem::simulation
