// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/simulation/bulk.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "abradem/contact/full_law.h"
#include "abradem/core/error.h"
#include "abradem/geometry/mesh_check.h"

namespace abradem::simulation {

namespace {

std::size_t at(std::int32_t i) noexcept { return static_cast<std::size_t>(i); }

constexpr double kSkin = 0.2;     // of the mean radius
constexpr double kFastest = 0.1;  // of the radius in one step: a faster one may pass through a wall
constexpr double kDeepestInWall = 0.5 * contact::kDeepest;  // of the radius

/// Lengths after which space repeats itself; 0 along open axes.
Vec3 period_of(const std::optional<DomainSetup>& d) noexcept {
  if (!d) return {};
  const auto along = [&](Periodic a, Periodic b, Periodic c, double length) {
    const Periodic p = d->periodic;
    return p == a || p == b || p == c || p == Periodic::xyz ? length : 0.0;
  };
  const Vec3 e = d->high - d->low;
  return {along(Periodic::x, Periodic::xy, Periodic::xz, e.x),
          along(Periodic::y, Periodic::xy, Periodic::yz, e.y),
          along(Periodic::z, Periodic::xz, Periodic::yz, e.z)};
}

bool outside(const DomainSetup& d, const Vec3& period, const Vec3& p) noexcept {
  const auto within = [](double x, double low, double high, double L) {
    return L > 0.0 || (x >= low && x <= high);
  };
  return !(within(p.x, d.low.x, d.high.x, period.x) && within(p.y, d.low.y, d.high.y, period.y) &&
           within(p.z, d.low.z, d.high.z, period.z));
}

std::string left_the_domain(const std::string& who, const Vec3& p, const Vec3& v) {
  return fmt::format(
      "{} has left the domain at ({:.6g}, {:.6g}, {:.6g}) m with {:.4g} m/s. Enlarge the [domain], close the "
      "walls, or set outside = \"remove\"",
      who, p.x, p.y, p.z, norm(v));
}

/// Does a sphere at c, in the wall's frame, overlap none of it?
bool is_clear_of(const Wall& wall, const Vec3& c, double radius) {
  if (!wall.is_plane()) return !distance_within(wall.view(), c, radius);
  return dot(wall.setup().mesh.normal, c - wall.setup().mesh.position) >= radius;
}

}  // namespace

Bulk::Bulk(const Setup& setup, const std::vector<material::Material>& materials,
           const std::vector<material::PairProperties>& properties, const Particles& named,
           const std::vector<ClumpShape>& shapes, std::span<const Wall> walls)
    : clumps_(shapes),
      walls_(setup.walls.size()),
      domain_(setup.domain),
      period_(period_of(setup.domain)),
      names_(named.name) {
  table_.materials = materials.size();
  bool remembers_torques = false;
  for (const material::PairProperties& p : properties) {
    table_.pair.push_back(contact::PairConstants::of(p));
    table_.rolling = table_.rolling || p.rolling_friction > 0.0;
    table_.options = table_.options || p.options.any();
    table_.adhesion = table_.adhesion || p.options.adhesion > 0.0;
    remembers_torques = remembers_torques || p.options.rolling_spring || p.options.torsion;
  }
  if (remembers_torques) list_.remember_torques();
  for (std::size_t p = 0; p < named.size(); ++p) {
    contact::SphereRow s;
    s.set_position(named.position[p]);
    s.radius = named.radius[p];
    s.inverse_mass = 1.0 / named.mass[p];
    s.material = named.material[p];
    spheres_.row.push_back(s);
    spheres_.id.push_back(next_id_++);
  }
  named_ = next_id_;
  if (period_ != Vec3{}) {
    if (named_ > 0)
      throw InputError("a periodic [domain] is for particles in numbers; leave out the named ones");
    list_.make_periodic(domain_->low, period_);
  }
  for (std::size_t k = 0; k < setup.insertions.size(); ++k) {
    const InsertionSetup& insertion = setup.insertions[k];
    const auto material = std::ranges::find(setup.materials, insertion.material, &MaterialSetup::name);
    const auto m = static_cast<std::size_t>(material - setup.materials.begin());
    constexpr std::uint64_t kStream = 1000;  // of the first insertion: far from those of the meshes
    const auto shape = std::ranges::find(shapes, insertion.shape, &ClumpShape::name);
    inserters_.emplace_back(insertion, static_cast<int>(m), materials[m].density, setup.run.seed, kStream + k,
                            shape != shapes.end() ? &*shape : nullptr);
  }
  std::vector<geometry::Pose> poses;
  for (const Wall& wall : walls) poses.push_back(wall.pose_at(0.0));
  take_in(0.0, walls, poses);
}

void Bulk::take_in(double time, std::span<const Wall> walls, std::span<const geometry::Pose> poses) {
  const auto clear = [&](const Vec3& centre, double radius) {
    for (std::size_t w = 0; w < walls.size(); ++w) {
      const Vec3 c = poses[w].to_body(centre);
      if (walls[w].present(time) && (!is_clear_of(walls[w], c, radius) || is_inside(w, walls[w], c)))
        return false;
    }
    return true;
  };
  for (Inserter& inserter : inserters_) {
    if (!inserter.wants(time)) continue;
    const std::size_t first = spheres_.size();
    if (const ClumpShape* shape = inserter.shape()) {
      const auto number =
          std::ranges::find(clumps_.shapes(), shape->name, &ClumpShape::name) - clumps_.shapes().begin();
      for (Clumps::Birth& birth : inserter.insert_clumps(time, spheres_, period_, clear)) {
        birth.shape = static_cast<std::int32_t>(number);
        clumps_.add(birth, spheres_, next_id_);
        worn_out_ = true;
      }
    } else {
      for (const contact::SphereRow& s : inserter.insert(time, spheres_, period_, clear)) {
        spheres_.row.push_back(s);
        spheres_.id.push_back(next_id_++);
        worn_out_ = true;
      }
    }
    if (gives_places(inserter.setup().volume.shape)) refuse_buried(inserter, first, time, walls);
  }
  if (!clumps_.empty()) spheres_.clump.resize(spheres_.size(), -1);
}

/// What a file or another run says may touch walls; but where this case has its walls elsewhere, it may lie
/// in them.
void Bulk::refuse_buried(const Inserter& inserter, std::size_t first, double time,
                         std::span<const Wall> walls) {
  for (std::size_t w = 0; w < walls.size(); ++w) {
    if (!walls[w].present(time)) continue;
    const geometry::Pose pose = walls[w].pose_at(time);
    std::size_t count = 0, example = 0;
    for (std::size_t i = first; i < spheres_.size(); ++i) {
      const contact::SphereRow& s = spheres_.row[i];
      const Vec3 c = pose.to_body(s.position());
      if (is_clear_of(walls[w], c, (1.0 - kDeepestInWall) * s.radius) && !is_inside(w, walls[w], c)) continue;
      if (count++ == 0) example = i;
    }
    if (count == 0) continue;
    const std::string& run = inserter.setup().volume.run;
    const Vec3 p = spheres_.row[example].position();
    const std::string what = fmt::format(
        "'{}': {} of its {} spheres lie inside wall '{}' or deeper in it than a tenth of their radius, the "
        "first at ({:.4g}, {:.4g}, {:.4g}) mm{}",
        inserter.setup().name, count, spheres_.size() - first, walls[w].setup().name, 1e3 * p.x, 1e3 * p.y,
        1e3 * p.z,
        run.empty() ? std::string{}
                    : fmt::format(". So '{}' left them: does the wall stand where it stood there? One that "
                                  "moved there begins here as its mesh and motion say",
                                  run));
    if (time > 0.0) throw SimulationError(what);
    throw InputError(what);
  }
}

/// Is c, in its frame, inside the solid that the wall's mesh bounds?
bool Bulk::is_inside(std::size_t w, const Wall& wall, const Vec3& c) {
  if (wall.is_plane() || wall.setup().sides == Sides::both) return false;
  const geometry::BoundingBox box = wall.view().grid.box();
  if (c.x < box.low.x || c.y < box.low.y || c.z < box.low.z || c.x > box.high.x || c.y > box.high.y ||
      c.z > box.high.z)
    return false;
  solid_.resize(std::max(solid_.size(), w + 1));
  if (!solid_[w]) {
    const geometry::TriangleMesh& mesh = wall.surface().mesh();
    solid_[w] = geometry::signed_volume(mesh) > 0.0 && geometry::check_mesh(mesh).closed;
  }
  return *solid_[w] && is_behind(wall.view(), c);
}

void Bulk::take_out_clumps() {
  std::vector<std::uint8_t> gone(clumps_.size(), 0);
  for (std::size_t k = 0; k < clumps_.size(); ++k) {
    const Clump& c = clumps_.clumps()[k];
    if (!outside(*domain_, period_, c.position)) continue;
    if (domain_->outside == Outside::stop)
      throw SimulationError(left_the_domain(fmt::format("clump {}", c.id), c.position, c.velocity));
    gone[k] = 1;
    ++removed_;
    removed_mass_ += c.mass;
  }
  clumps_.take_out(gone, spheres_);
}

void Bulk::take_out() {
  if (!domain_) return;
  if (!clumps_.empty()) take_out_clumps();
  for (std::size_t i = 0; i < spheres_.size(); ++i) {
    const contact::SphereRow& s = spheres_.row[i];
    if (spheres_.id[i] < named_ || in_clump(i) || !outside(*domain_, period_, s.position())) continue;
    if (domain_->outside == Outside::stop)
      throw SimulationError(
          left_the_domain(fmt::format("particle {}", spheres_.id[i]), s.position(), s.velocity()));
    spheres_.id[i] = -1;
    ++removed_;
    removed_mass_ += 1.0 / s.inverse_mass;
  }
}

void Bulk::find_named() {
  place_of_named_.assign(at(named_), 0);
  for (std::size_t i = 0; i < spheres_.size(); ++i)
    if (spheres_.id[i] >= 0 && spheres_.id[i] < named_) place_of_named_[at(spheres_.id[i])] = i;
}

/// Copies of the named particles as they are now. What they moved besides the engine's own idea of it
/// (guides, loads, a hand) counts as travelled.
void Bulk::fetch_named(const Particles& named) {
  double furthest = 0.0;
  for (std::size_t p = 0; p < place_of_named_.size(); ++p) {
    contact::SphereRow& s = spheres_.row[place_of_named_[p]];
    furthest = std::max(furthest, norm(named.position[p] - s.position()));
    s.set_position(named.position[p]);
    s.set_velocity(named.velocity[p]);
    s.set_spin(named.spin[p]);
  }
  travelled_ += furthest;
}

void Bulk::find_contacts(const Surroundings& around, const Particles& named, std::vector<double>& paper) {
  take_in(around.time, around.walls, around.poses);
  fetch_named(named);
  const double by_walls = walls_.fastest_wall() * wall_time_;
  worn_out_ = worn_out_ || around.time >= walls_.next_removal();
  if (worn_out_ || travelled_ > 0.5 * skin_ || travelled_ + by_walls > skin_) {
    take_out();
    double sum = 0.0;
    for (const contact::SphereRow& s : spheres_.row) sum += s.radius;
    skin_ = spheres_.size() > 0 ? kSkin * sum / static_cast<double>(spheres_.size()) : 0.0;
    check_periods();
    if (table_.adhesion) skin_ = std::max(skin_, 2.0 * longest_stretch());
    list_.rebuild(spheres_, skin_, margin(around.dt));
    if (!spheres_.clump.empty()) clumps_.settle(spheres_, domain_ ? domain_->low : Vec3{}, period_);
    walls_.rebuild(spheres_, around, skin_, named_, paper);
    find_named();
    travelled_ = near_at_ = wall_time_ = 0.0;
    const bool first = worn_out_;
    worn_out_ = false;
    if (first) fetch_named(named);
  } else if (travelled_ - near_at_ > 0.5 * margin_) {
    list_.find_near(spheres_, margin(around.dt));
    near_at_ = travelled_;
  }
  walls_.prepare(spheres_, around, travelled_ + walls_.fastest_wall() * wall_time_);
}

/// Within which pairs are looked at in every step [m]. Finding them costs C and lasts margin / (2 way) steps;
/// those that do not touch cost c margin / skin in every step. The sum is least at √(2 C/c way skin), and
/// C/c = 2.5 is an estimate: near the least the sum is flat. Where that comes near the skin, the list itself
/// lasts no longer and all of it is taken.
double Bulk::margin(double dt) {
  const double way = std::sqrt(met_.fastest2) * dt, best = std::sqrt(5.0 * way * skin_);
  margin_ = table_.adhesion || best > 0.5 * skin_ ? skin_ : best;
  return margin_;
}

void Bulk::check_periods() const {
  if (period_ == Vec3{}) return;
  double largest = 0.0;
  for (const contact::SphereRow& s : spheres_.row) largest = std::max(largest, s.radius);
  const double least = 3.0 * (2.0 * largest + skin_ + 2.0 * longest_stretch());
  for (const double length : {period_.x, period_.y, period_.z})
    if (length > 0.0 && length < least)
      throw InputError(
          fmt::format("the [domain] repeats itself after {:.4g} mm; with these particles it must be "
                      "at least {:.4g} mm, three of them and a margin",
                      1e3 * length, 1e3 * least));
}

/// How far any contact can be drawn out before it snaps [m].
double Bulk::longest_stretch() const {
  double largest = 0.0, stretch = 0.0;
  for (const contact::SphereRow& s : spheres_.row) largest = std::max(largest, s.radius);
  for (const contact::PairConstants& p : table_.pair)
    stretch = std::max(stretch, contact::stretch_at_snap(p, largest));
  return stretch;
}

void Bulk::compute_forces(const Surroundings& around, Particles& named) {
  walls_sound_ = walls_.compute(spheres_, around);
  if (!needs_loads()) return;  // integrate() finds the forces among the spheres where it uses them
  pairs_sound_ = contact::sphere_forces(spheres_, list_, table_, around.dt, load_);
  for (std::size_t p = 0; p < place_of_named_.size(); ++p) {
    contact::LoadRow& l = load_[place_of_named_[p]];
    named.force[p] += l.force();
    named.torque[p] += l.torque();
    const double stiffening = l.stiffening;  // the watch of the step asks for it
    l = {};
    l.stiffening = stiffening;
  }
  walls_.add_loads(0, spheres_.size(), load_);
}

void Bulk::integrate(const Surroundings& around) {
  if (needs_loads()) {
    if (!clumps_.empty()) clumps_.take_loads(load_);
    met_ = contact::advance_spheres(spheres_.row, load_, around.gravity, around.dt);
    if (!clumps_.empty()) clumps_.advance(spheres_, load_, around.gravity, around.dt, met_);
  } else {
    met_ = contact::forces_and_advance(
        spheres_, list_, table_, around.dt, load_, around.gravity,
        [&](std::size_t begin, std::size_t end) { walls_.add_loads(begin, end, load_); });
    pairs_sound_ = met_.sound;
  }
  const double fastest = std::sqrt(met_.fastest2);
  fastest_ = std::max(fastest_, fastest);
  travelled_ += fastest * around.dt;
  wall_time_ += around.dt;
}

void Bulk::check(const Surroundings& around, std::uint64_t step) const {
  const bool slow = met_.longest <= kFastest && met_.fastest2 <= fastest_allowed_ * fastest_allowed_ &&
                    walls_.fastest_wall() * around.dt <= skin_;
  const bool deep = !pairs_sound_ || !walls_sound_;
  // What lies too deep is thrown out too fast: the cause first.
  if (met_.finite && deep) check_overlaps(around, step);
  if (!met_.finite || !slow) check_motion(around, step);
  if (deep)
    fail(0, "it or another one overlaps a sphere or a wall by more than a tenth of its radius", around, step);
}

void Bulk::check_motion(const Surroundings& around, std::uint64_t step) const {
  for (std::size_t i = 0; i < spheres_.size(); ++i) {
    if (spheres_.id[i] < named_) continue;  // a copy: it is looked at with its own kind
    const contact::SphereRow& s = spheres_.row[i];
    if (!is_finite(s.position()) || !is_finite(s.velocity()))
      fail(i, "its position or speed is no longer a number", around, step);
    const double speed = norm(s.velocity());
    if (const double way = speed * around.dt; way > kFastest * s.radius)
      fail(i, fmt::format("it moves {:.4g} mm in one step, more than a tenth of its radius", 1e3 * way),
           around, step);
    if (speed > fastest_allowed_)
      fail(i,
           fmt::format("its energy explodes: {:.4g} J at {:.4g} m/s, a hundred times what its start, gravity "
                       "and the walls can give it",
                       0.5 * speed * speed / s.inverse_mass, speed),
           around, step);
    for (std::size_t w = 0; w < around.walls.size(); ++w) {
      const Vec3 past = s.velocity() - around.poses[w].velocity_at(s.position());
      if (const double way = norm(past) * around.dt; way > s.radius && around.walls[w].present(around.time))
        fail(
            i,
            fmt::format("wall '{}' moves past it by {:.4g} mm in one step, more than its radius: it may pass "
                        "through unseen",
                        around.walls[w].setup().name, 1e3 * way),
            around, step);
    }
  }
}

void Bulk::check_overlaps(const Surroundings& around, std::uint64_t step) const {
  list_.for_each_near([&](const contact::ContactBlock& block, std::size_t k) {
    const contact::SphereRow &i = spheres_.row[at(block.i[k])], &j = spheres_.row[at(block.j[k])];
    const double overlap = i.radius + j.radius - norm(i.position() - j.position() + list_.shift(block, k));
    // Positions are one step on, so what was a hair too deep may no longer be.
    if (overlap > 0.95 * contact::kDeepest * i.radius * j.radius / (i.radius + j.radius))
      fail(at(block.i[k]),
           fmt::format("its overlap with {} is {:.4g} mm, more than a tenth of the radius",
                       title(at(block.j[k])), 1e3 * overlap),
           around, step);
  });
  const auto check_wall = [&](std::int32_t sphere, std::size_t w, double overlap, double most) {
    const double R = spheres_.row[at(sphere)].radius;
    if (overlap <= most * R) return;
    const std::string what =
        fmt::format("its overlap with wall '{}' is {:.4g} mm, more than a tenth of its radius",
                    around.walls[w].setup().name, 1e3 * overlap);
    // Nothing is pressed in so deep: it came from behind.
    if (overlap > 0.5 * R && !around.walls[w].is_plane() && around.walls[w].setup().sides == Sides::front)
      fail(at(sphere), what, around, step,
           ". Do the normals of its triangles point to the particles? The other side of a wall cannot be "
           "touched; "
           "of a thin sheet both can with sides = \"both\"");
    fail(at(sphere), what, around, step);
  };
  for (std::size_t w = 0; w < walls_.planes().size(); ++w) {
    const contact::PlaneList& plane = walls_.planes()[w];
    const MeshSetup& mesh = around.walls[w].setup().mesh;
    for (std::size_t k = 0; k < plane.size(); ++k) {
      const contact::SphereRow& s = spheres_.row[at(plane.sphere[k])];
      const Vec3 c = around.poses[w].to_body(s.position());
      check_wall(plane.sphere[k], w, s.radius - dot(mesh.normal, c - mesh.position), 0.95 * kDeepestInWall);
    }
  }
  for (const BulkWalls::NearMesh& m : walls_.meshes())
    for (const SphereWall::Touch& t : m.contact->touches())
      check_wall(m.sphere, at(m.wall), t.overlap, kDeepestInWall);
}

void Bulk::watch_stability(const Surroundings& around, std::uint64_t step, Stability then) {
  const auto mode = stability_.watch(spheres_, list_, table_, load_, walls_, clumps_, around, met_.stability);
  if (!mode || then == Stability::warn) return;
  fail(mode->sphere,
       fmt::format("the time step is too long: 2g + W = {:.4g} in its contact with {}, stable below 4; a "
                   "disturbance has grown a thousandfold. Take run.time_step below {:.3g} s; run.stability = "
                   "\"warn\" goes on nevertheless",
                   mode->scheme.number(),
                   mode->partner >= 0 ? title(at(mode->partner))
                                      : fmt::format("wall '{}'", around.walls[at(mode->wall)].setup().name),
                   mode->scheme.stable_step(around.dt)),
       around, step, "");
}

std::string Bulk::title(std::size_t i) const {
  const std::int32_t id = spheres_.id[i];
  if (in_clump(i)) {
    const Clump& c = clumps_.clumps()[at(spheres_.clump[i])];
    // Named ones come in first, each by an insertion of its own (clumps_in_numbers).
    const auto n = at(c.id);
    const bool named = n < inserters_.size() && inserters_[n].setup().turns.size() == 1 &&
                       inserters_[n].setup().volume.file.empty() && inserters_[n].setup().volume.run.empty();
    return fmt::format(
        "sphere {} of {}", id - c.first_sphere,
        named ? fmt::format("particle '{}'", inserters_[n].setup().name) : fmt::format("clump {}", c.id));
  }
  return id < named_ ? fmt::format("particle '{}'", names_[at(id)]) : fmt::format("particle {}", id);
}

void Bulk::fail(std::size_t i, const std::string& what, const Surroundings& around, std::uint64_t step,
                const char* advice) const {
  const contact::SphereRow& s = spheres_.row[i];
  throw SimulationError(fmt::format("{} at ({:.4g}, {:.4g}, {:.4g}) mm, step {}, {:.6g} s: {}{}", title(i),
                                    1e3 * s.x, 1e3 * s.y, 1e3 * s.z, step, around.time, what, advice));
}

BulkState Bulk::state(const std::vector<material::PairProperties>& properties) const {
  BulkState state;
  for (const Inserter& inserter : inserters_) state.inserted += inserter.inserted();
  state.removed = removed_;
  state.removed_mass = removed_mass_;
  for (std::size_t i = 0; i < spheres_.size(); ++i) {
    if (spheres_.id[i] < named_) continue;
    const contact::SphereRow& s = spheres_.row[i];
    const double mass = 1.0 / s.inverse_mass, v2 = norm2(s.velocity());
    if (in_clump(i)) {
      state.fastest = std::max(state.fastest, v2);
      continue;
    }
    ++state.present;
    state.mass += mass;
    state.kinetic_energy += 0.5 * mass * (v2 + 0.4 * s.radius * s.radius * norm2(s.spin()));
    state.fastest = std::max(state.fastest, v2);
  }
  state.fastest = std::sqrt(state.fastest);
  state.present += clumps_.size();
  for (const Clump& c : clumps_.clumps()) {
    state.mass += c.mass;
    state.kinetic_energy += c.kinetic_energy();
  }
  list_.for_each_near([&](const contact::ContactBlock& block, std::size_t k) {
    const contact::SphereRow &i = spheres_.row[at(block.i[k])], &j = spheres_.row[at(block.j[k])];
    const double reach = i.radius + j.radius,
                 overlap = reach - norm(i.position() - j.position() + list_.shift(block, k));
    if (overlap <= 0.0) return;
    ++state.pair_contacts;
    const auto& pair = properties[static_cast<std::size_t>(i.material) * table_.materials +
                                  static_cast<std::size_t>(j.material)];
    state.elastic_energy +=
        pair.options.linear()
            ? 0.5 * pair.options.normal_stiffness * overlap * overlap
            : 0.4 * overlap * contact::hertz_force(pair, i.radius * j.radius / reach, overlap);
  });
  state.wall_contacts = walls_.contacts();
  return state;
}

bool Bulk::restore(const Surroundings& around) {
  if (spheres_.id.size() != spheres_.size()) return false;
  if (!std::ranges::all_of(inserters_, [](const Inserter& i) { return i.restored(); })) return false;
  for (std::size_t i = 0; i < spheres_.size(); ++i) {
    const contact::SphereRow& s = spheres_.row[i];
    const bool sound = is_finite(s.position()) && is_finite(s.velocity()) && is_finite(s.spin()) &&
                       s.radius > 0.0 && std::isfinite(s.radius) && s.inverse_mass > 0.0 &&
                       s.material >= 0.0 && s.material < static_cast<double>(around.materials);
    if (!sound || spheres_.id[i] < 0 || spheres_.id[i] >= next_id_) return false;
  }
  if (!clumps_.restore(spheres_, period_)) return false;
  if (worn_out_) return walls_.meshes().empty();  // everything else will be made anew
  find_named();
  for (std::size_t p = 0; p < place_of_named_.size(); ++p)
    if (spheres_.size() == 0 || at(spheres_.id[place_of_named_[p]]) != p) return false;
  if (!list_.restore(spheres_)) return false;
  return walls_.restore(spheres_, around);
}

void Bulk::add_to(core::StateHash& hash) const {
  for (std::size_t i = 0; i < spheres_.size(); ++i) {
    const contact::SphereRow& s = spheres_.row[i];
    if (spheres_.id[i] < named_) continue;
    hash.add(static_cast<std::uint64_t>(spheres_.id[i]));
    hash.add(s.position());
    hash.add(s.velocity());
    hash.add(s.spin());
  }
  clumps_.add_to(hash);
  list_.for_each_near([&](const contact::ContactBlock& block, std::size_t k) {
    if (block.touching[k] == 0) return;
    hash.add(block.spring(k));
    if (block.torque.empty()) return;
    const contact::SpringRow& t = block.torque[k];
    hash.add(Vec3{t.x, t.y, t.z}), hash.add(t.twist);
  });
  for (const contact::PlaneList& plane : walls_.planes())
    for (const contact::SpringRow& s : plane.spring) hash.add(Vec3{s.x, s.y, s.z});
  if (table_.options)
    for (const contact::PlaneList& plane : walls_.planes())
      for (const contact::SpringRow& t : plane.torque) hash.add(Vec3{t.x, t.y, t.z}), hash.add(t.twist);
  for (const BulkWalls::NearMesh& m : walls_.meshes()) m.contact->add_to(hash);
}

}  // namespace abradem::simulation
