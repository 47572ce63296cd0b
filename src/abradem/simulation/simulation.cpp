// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/simulation/simulation.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "abradem/core/error.h"
#include "abradem/core/hash.h"
#include "abradem/core/parallel.h"
#include "abradem/simulation/pair_laws.h"

namespace abradem::simulation {

namespace {

constexpr double pi = std::numbers::pi;

template <typename T>
int index_of(const std::vector<T>& items, const std::string& name, const char* what) {
  const auto found = std::ranges::find(items, name, &T::name);
  if (found == items.end()) throw InputError(fmt::format("there is no {} named '{}'", what, name));
  return static_cast<int>(found - items.begin());
}

material::ContactOptions options_of(const ContactSetup& c) {
  material::ContactOptions o;
  if (c.law == ContactLaw::linear) {
    o.normal_stiffness = c.normal_stiffness;
    o.tangential_stiffness = c.tangential_stiffness.value_or(2.0 / 7.0 * c.normal_stiffness);
    if (!(o.normal_stiffness > 0.0) || !(o.tangential_stiffness > 0.0))
      throw InputError(
          fmt::format("contact \"{}/{}\": a linear law needs stiffnesses > 0", c.first, c.second));
    if (c.cohesion == Cohesion::jkr)
      throw InputError(
          fmt::format("contact \"{}/{}\": JKR is the adhesion of Hertz's contact; with law = "
                      "\"linear\" take cohesion = \"sjkr\"",
                      c.first, c.second));
  }
  if (c.cohesion == Cohesion::sjkr) o.cohesion = c.cohesion_energy_density;
  if (c.cohesion == Cohesion::jkr) o.adhesion = c.work_of_adhesion;
  o.rolling_spring = c.rolling_model == RollingModel::epsd2 && c.rolling_friction > 0.0;
  o.torsion = c.torsion == Torsion::marshall;
  return o;
}

}  // namespace

Simulation::Simulation(Setup setup, const MeshSource& source) : setup_(clumps_in_numbers(std::move(setup))) {
  for (const MaterialSetup& m : setup_.materials)
    materials_.push_back({m.density, m.shear_modulus, m.poisson_ratio});
  for (const WallSetup& wall : setup_.walls)
    walls_.emplace_back(wall, index_of(setup_.materials, wall.material, "material"), source, setup_.run.seed);
  period_ = period_of(setup_.walls);
  find_pair_properties();
  check_ploughing();
  choose_accounts();
  choose_maps();
  find_uses_of_wear();
  add_particles();
  add_tips();
  sphere_walls_.resize(particles_.size() * walls_.size());
  law_.assign(walls_.size(), 0.0);
  paper_.assign(walls_.size(), 0.0);
  displaced_.assign(walls_.size(), 0.0);
  choose_time_step();
  poses_.resize(walls_.size());
  move_walls();
  limit_energies();
}

void Simulation::find_pair_properties() {
  const std::size_t n = materials_.size();
  pairs_.assign(n * n, {});
  std::vector<char> given(n * n, 0);
  for (const ContactSetup& c : setup_.contacts) {
    const auto a = static_cast<std::size_t>(index_of(setup_.materials, c.first, "material"));
    const auto b = static_cast<std::size_t>(index_of(setup_.materials, c.second, "material"));
    contact::PairProperties p = material::effective_moduli(materials_[a], materials_[b]);
    p.beta = material::damping_ratio(c.restitution);
    p.static_friction = c.static_friction;
    p.rolling_friction = c.rolling_friction;
    p.options = options_of(c);
    if (p.options.any() && setup_.run.method == Method::quasi_static)
      throw InputError(
          fmt::format("contact \"{}/{}\": method quasi_static balances Hertz's forces; a linear "
                      "law, cohesion, torsion or rolling_model = \"epsd2\" want dynamic",
                      c.first, c.second));
    pairs_[a * n + b] = pairs_[b * n + a] = p;
    given[a * n + b] = given[b * n + a] = 1;
  }
  refuse_missing_pairs(given);
  for (const Wall& wall : walls_)
    if (wall.setup().sides == Sides::both &&
        (wall.is_plane() || wall.setup().contact != ContactRule::resolved ||
         wall.setup().deformation != DeformationRule::none))
      throw InputError(
          fmt::format("wall '{}': a sheet with two sides takes a mesh, contact = \"resolved\" and "
                      "deformation = \"none\"",
                      wall.setup().name));
  for (const Wall& wall : walls_)
    for (std::size_t m = 0; m < n; ++m)
      if (!wall.is_plane() && wall.setup().contact != ContactRule::resolved &&
          pair(static_cast<int>(m), wall.material()).options.adhesion > 0.0)
        throw InputError(
            fmt::format("wall '{}': JKR contacts last beyond zero overlap, which only contact = "
                        "\"resolved\" (or a plane) can follow",
                        wall.setup().name));
  wear_.assign(n * n, 0.0);
  laws_.assign(n * n, {});
  for (const WearSetup& w : setup_.wear) {
    const auto a = static_cast<std::size_t>(index_of(setup_.materials, w.abrader, "material"));
    const auto b = static_cast<std::size_t>(index_of(setup_.materials, w.worn, "material"));
    if (w.acceleration.automatic)
      throw InputError(fmt::format(
          "wear \"{}/{}\": the acceleration is still to be chosen; study::choose_acceleration does that",
          w.abrader, w.worn));
    if (!(w.acceleration.factor >= 1.0) || !std::isfinite(w.acceleration.factor))
      throw InputError(fmt::format("wear \"{}/{}\": acceleration = {}; must be >= 1", w.abrader, w.worn,
                                   w.acceleration.factor));
    if (&w != &setup_.wear.front() && w.acceleration.factor != acceleration_)
      throw InputError("the accelerations of the wear pairs differ; they shorten one and the same run");
    acceleration_ = w.acceleration.factor;
    laws_[a * n + b] = laws_of(setup_, w, acceleration_);
    wear_[a * n + b] = laws_[a * n + b].archard;
  }
}

/// Which walls wear by more than Archard's law, and what such laws cannot be combined with.
void Simulation::choose_accounts() {
  by_laws_.assign(walls_.size(), 0);
  account_.resize(walls_.size());
  for (const WearSetup& w : setup_.wear) {
    const wear::Laws& laws = wear_laws(index_of(setup_.materials, w.abrader, "material"),
                                       index_of(setup_.materials, w.worn, "material"));
    if (laws.only_archard()) continue;
    if (ploughs())
      throw InputError(fmt::format("[ploughing] shares out what Archard's law removes; \"{}/{}\" has others",
                                   w.abrader, w.worn));
    for (const ParticleSetup& p : setup_.particles)
      if (p.guide != Guide::none && p.material == w.worn)
        throw InputError(fmt::format("particle '{}' wears by Archard's law alone; \"{}/{}\" has others",
                                     p.name, w.abrader, w.worn));
    if (setup_.run.method == Method::quasi_static &&
        (laws.strikes() || laws.normal_energy > 0.0 ||
         (laws.expression && laws.expression->names(wear::Symbol::normal_work))))
      throw InputError(fmt::format("wear \"{}/{}\": a balance of forces has no impacts; use method dynamic",
                                   w.abrader, w.worn));
    for (std::size_t k = 0; k < walls_.size(); ++k) {
      if (walls_[k].setup().material != w.worn) continue;
      by_laws_[k] = 1;
      if (laws.strikes()) walls_[k].watch_impacts();
    }
  }
}

/// Everything that can meet needs a [contact] of its materials. @param given of each pair of materials
void Simulation::refuse_missing_pairs(const std::vector<char>& given) const {
  struct Body {
    std::string title, material;
    bool alone;  ///< nothing of its own kind can meet it
  };
  std::vector<Body> bodies;
  for (const ParticleSetup& p : setup_.particles)
    bodies.push_back({fmt::format("particle '{}'", p.name), p.material, true});
  for (const InsertionSetup& i : setup_.insertions)
    bodies.push_back({fmt::format("insertion '{}'", i.name), i.material, i.placed.size() == 1});
  const std::size_t moving = bodies.size();
  for (const WallSetup& wall : setup_.walls)
    bodies.push_back({fmt::format("wall '{}'", wall.name), wall.material, true});
  for (std::size_t i = 0; i < moving; ++i)
    for (std::size_t j = i; j < bodies.size(); ++j) {
      if (i == j && bodies[i].alone) continue;
      const auto a = static_cast<std::size_t>(index_of(setup_.materials, bodies[i].material, "material"));
      const auto b = static_cast<std::size_t>(index_of(setup_.materials, bodies[j].material, "material"));
      if (given[a * materials_.size() + b] != 0) continue;
      const std::string pair = fmt::format("[contact.\"{}/{}\"]", bodies[i].material, bodies[j].material);
      throw InputError(
          i == j ? fmt::format("the particles of {} can meet one another, but no {} says how",
                               bodies[i].title, pair)
                 : fmt::format("{} can meet {}, but no {} says how", bodies[i].title, bodies[j].title, pair));
    }
}

double Simulation::wear_coefficient(int abrader, int worn) const {
  return wear_[static_cast<std::size_t>(abrader) * materials_.size() + static_cast<std::size_t>(worn)];
}

double Simulation::groove_coefficient(int abrader, int worn) const {
  const double alpha_s = wear_coefficient(abrader, worn), f = removed_fraction();
  // Where nothing is removed the coefficient is that of the groove; see PloughingSetup.
  return f < 1.0 && f > 0.0 ? alpha_s / f : alpha_s;
}

void Simulation::check_ploughing() const {
  if (!setup_.ploughing) return;
  const PloughingSetup& p = *setup_.ploughing;
  if (!(p.removed_fraction >= 0.0 && p.removed_fraction <= 1.0))
    throw InputError(
        fmt::format("ploughing: removed_fraction = {}; must be from 0 to 1", p.removed_fraction));
  if (!(p.ridge_angle > 0.0 && p.ridge_angle < 0.5 * pi))
    throw InputError(fmt::format("ploughing: ridge_angle = {:.4g} degrees; must be above 0 and below 90",
                                 p.ridge_angle * 180.0 / pi));
  if (!(p.ahead >= 0.0 && p.ahead <= 1.0))
    throw InputError(fmt::format("ploughing: ahead = {}; must be from 0 to 1", p.ahead));
  for (const Wall& wall : walls_)
    if (ploughs() && wall.setup().deformation == DeformationRule::paper)
      throw InputError(
          fmt::format("wall '{}': the deformation rule paper has no ridges; with [ploughing] use conserving",
                      wall.setup().name));
}

void Simulation::add_particles() {
  for (const ParticleSetup& p : setup_.particles) {
    const int m = index_of(setup_.materials, p.material, "material");
    if (!(p.radius > 0.0))
      throw InputError(fmt::format("particle '{}': radius = {} m; must be > 0", p.name, p.radius));
    const double mass =
        materials_[static_cast<std::size_t>(m)].density * 4.0 / 3.0 * pi * p.radius * p.radius * p.radius;
    const bool guided = p.guide == Guide::vertical;
    const Vec3 along = norm2(p.load) > 0.0 ? normalized(p.load) : Vec3{0.0, 0.0, -1.0};
    particles_.name.push_back(p.name);
    particles_.radius.push_back(p.radius);
    particles_.mass.push_back(mass);
    particles_.material.push_back(m);
    particles_.position.push_back(p.position);
    particles_.velocity.push_back(guided ? dot(p.velocity, along) * along : p.velocity);
    particles_.spin.push_back(guided ? Vec3{} : p.spin);
    particles_.load.push_back(p.load);
    particles_.guide.push_back(guided ? along : Vec3{});
  }
  particles_.force.resize(particles_.size());
  particles_.torque.resize(particles_.size());
  stiffness_ratio_.assign(particles_.size(), 0.0);
  growth_.assign(particles_.size(), 0.0);
  std::vector<ClumpShape> shapes;
  for (const ShapeSetup& shape : setup_.shapes) shapes.push_back(clump_shape(shape));
  for (InsertionSetup& i : setup_.insertions) {
    if (i.shape.empty()) continue;
    const ClumpShape& shape = shapes[static_cast<std::size_t>(index_of(setup_.shapes, i.shape, "shape"))];
    // Without a size: as the shape was given.
    if (i.size.kind == SizeKind::single && i.size.radius == 0.0) i.size.radius = shape.radius;
  }
  if (particles_.size() > 1 || !setup_.insertions.empty())
    bulk_.emplace(setup_, materials_, pairs_, particles_, shapes, walls_);
}

/// A map for every guided sphere that some wall wears; as fine as a quarter of its first contact.
void Simulation::add_tips() {
  constexpr double kPointsPerRadius = 4.0;
  tips_.resize(particles_.size());
  tip_law_.assign(particles_.size(), 0.0);
  tip_along_.assign(particles_.size(), {});
  for (std::size_t p = 0; p < particles_.size(); ++p) {
    const Vec3& guide = particles_.guide[p];
    if (guide == Vec3{}) continue;
    const double R = particles_.radius[p];
    const double load = std::max(norm(particles_.load[p]), particles_.mass[p] * norm(setup_.run.gravity));
    double a = 0.01 * R;
    Vec3 sliding;
    bool wears = false;
    for (const Wall& wall : walls_) {
      if (wear_coefficient(wall.material(), particles_.material[p]) == 0.0) continue;
      wears = true;
      if (wall.setup().contact == ContactRule::automatic)
        throw InputError(
            fmt::format("wall '{}' wears particle '{}', and a worn tip has no contact = \"auto\": "
                        "set contact = \"patch\"",
                        wall.setup().name, particles_.name[p]));
      if (load > 0.0)
        a = std::min(a,
                     contact::contact_radius(
                         R, contact::hertz_overlap(pair(particles_.material[p], wall.material()), R, load)));
      if (sliding == Vec3{}) sliding = wall.pose_at(0.0).velocity_at(particles_.position[p]);
    }
    if (!wears) continue;
    tips_[p].emplace(R, a / kPointsPerRadius);
    // The map's first axis along the slide, as far as it goes across the guide; else along x or y.
    const auto across = [&](const Vec3& v) { return v - dot(v, guide) * guide; };
    Vec3 along = across(sliding);
    if (norm(along) <= 1e-9 * norm(sliding)) along = across({1.0, 0.0, 0.0});
    if (norm(along) < 0.1 * norm(across(sliding)) || norm2(along) < 1e-2 * norm2(sliding) || along == Vec3{})
      along = across(std::abs(guide.x) < 0.9 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0});
    tip_along_[p] = normalized(along);
  }
}

void Simulation::step() {
  move_walls();
  find_contacts();
  compute_forces();
  accumulate_wear();
  deform_walls();
  integrate();
  record();
}

bool Simulation::advance(const std::function<bool()>& watch) {
  constexpr std::uint64_t kBetweenLooks = 4096;
  while (!finished()) {
    step();
    if (at_output()) return true;
    if (watch && steps_ % kBetweenLooks == 0 && !watch()) return false;
  }
  return true;
}

void Simulation::move_walls() {
  double instant = time();
  // An increment stands for the distance it slides: where in it the balance is struck differs from one
  // revolution to the next, or else every revolution would wear the same spots. Counted from where the
  // revolution begins, which need not be a whole number of increments. docs/theory/quasi-static.md#increment
  if (setup_.run.method == Method::quasi_static && period_ > 0.0) {
    constexpr double kShift = 0.5698402909980532;  // inverse square of the plastic number
    const double places = std::floor(time() / period_) * (kShift + period_ / dt_);
    instant += (places - std::floor(places)) * dt_;
  }
  for (std::size_t w = 0; w < walls_.size(); ++w) poses_[w] = walls_[w].pose_at(instant);
  for (std::size_t p = 0; p < particles_.size(); ++p) {
    if (!tips_[p]) continue;
    for (std::size_t w = 0; w < walls_.size(); ++w)
      sphere_walls_[p * walls_.size() + w].set_tip({&tips_[p]->shape(), poses_[w].turn_back(tip_along_[p]),
                                                    poses_[w].turn_back(tip_across(p)),
                                                    poses_[w].turn_back(particles_.guide[p])});
  }
}

void Simulation::find_contacts() {
  if (setup_.run.method == Method::quasi_static) {
    for (std::size_t p = 0; p < particles_.size(); ++p) find_equilibrium(p);
    return;
  }
  const auto centre = [this](std::size_t p, std::size_t w) {
    return poses_[w].to_body(particles_.position[p]);
  };
  for (std::size_t k = 0; k < sphere_walls_.size(); ++k) {
    const std::size_t p = k / walls_.size(), w = k % walls_.size();
    const Vec3 v =
        poses_[w].turn_back(particles_.velocity[p] - poses_[w].velocity_at(particles_.position[p]));
    sphere_walls_[k].prepare(walls_[w], centre(p, w), v, particles_.radius[p],
                             pair(particles_.material[p], walls_[w].material()), norm(particles_.load[p]),
                             dt_);
  }
  core::parallel_for(sphere_walls_.size(), [&](std::size_t k) {
    const std::size_t p = k / walls_.size(), w = k % walls_.size();
    if (!walls_[w].present(time())) {
      sphere_walls_[k].let_go();
      return;
    }
    sphere_walls_[k].find(walls_[w], centre(p, w), particles_.radius[p],
                          pair(particles_.material[p], walls_[w].material()));
  });
  if (bulk_) bulk_->find_contacts(surroundings(), particles_, paper_);
}

Surroundings Simulation::surroundings() noexcept {
  return {walls_,
          poses_,
          pairs_,
          materials_.size(),
          dt_,
          time(),
          setup_.run.gravity,
          settling() ? no_wear_ : wear_use_,
          ploughs()};
}

void Simulation::compute_forces() {
  if (setup_.run.method == Method::quasi_static) return;  // the balance has found them
  core::parallel_for(particles_.size(), [this](std::size_t p) {
    Vec3 force = particles_.load[p] + particles_.mass[p] * setup_.run.gravity, torque;
    const SphereState sphere{particles_.position[p], particles_.velocity[p], particles_.spin[p],
                             particles_.radius[p], particles_.mass[p]};
    for (std::size_t w = 0; w < walls_.size(); ++w) {
      const auto f = sphere_walls_[p * walls_.size() + w].compute(
          walls_[w], poses_[w], sphere, pair(particles_.material[p], walls_[w].material()), dt_);
      force += f.force;
      torque += f.torque;
    }
    particles_.force[p] = force;
    particles_.torque[p] = torque;
  });
  if (bulk_) bulk_->compute_forces(surroundings(), particles_);
}

void Simulation::deform_walls() {
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    const WallSetup& setup = walls_[w].setup();
    if (walls_[w].is_plane() || setup.deformation == DeformationRule::none) continue;
    wear::WearingSurface& surface = walls_[w].surface();
    const bool due = output_due();
    if (setup.deformation == DeformationRule::paper)
      paper_[w] += surface.deform_paper();
    else if (due || (steps_ + 1) % static_cast<std::uint64_t>(setup.deform_every) == 0)
      surface.deform_conserving();
    constexpr std::uint64_t kBetweenChecks = 4096;  // elements beside the worn ones turn slowly
    if (due || (steps_ + 1) % kBetweenChecks == 0) surface.check_orientation();
    const wear::DeformGuards& guards = surface.guards();
    if (guards.fatal_steps > 0 || guards.flipped > 0)
      throw SimulationError(fmt::format(
          "wall '{}', step {}, {:.6g} s: {} {}: the wear is too deep for the mesh. Lower the wear "
          "coefficient or spread it over more revolutions, or take a coarser mesh or a shorter step",
          setup.name, steps_, time(),
          guards.flipped > 0 ? "wear turned over triangle" : "wear moved by more than half a triangle vertex",
          guards.flipped > 0 ? guards.worst_triangle : guards.worst_vertex));
  }
}

void Simulation::integrate() {
  if (setup_.run.method == Method::quasi_static) return;
  for (std::size_t p = 0; p < particles_.size(); ++p) {
    Vec3 dv = particles_.force[p] * (dt_ / particles_.mass[p]);
    const Vec3& guide = particles_.guide[p];
    if (guide != Vec3{}) {
      dv = dot(dv, guide) * guide;
    } else {
      const double I = 0.4 * particles_.mass[p] * particles_.radius[p] * particles_.radius[p];
      particles_.spin[p] += particles_.torque[p] * (dt_ / I);
    }
    particles_.velocity[p] += dv;
    particles_.position[p] += particles_.velocity[p] * dt_;
  }
  if (bulk_) bulk_->integrate(surroundings());
}

void Simulation::record() {
  check_state();
  if (bulk_) bulk_->check(surroundings(), steps_);
  watch_stability();
  ++steps_;
  const bool due = at_output();
  if (due) book_elements();
  if (due || ledger_due()) check_ledger();
  if (observer_) observer_(*this);
}

ForceSample Simulation::force_on(std::size_t p) const noexcept {
  ForceSample sample;
  sample.time = time();
  Vec3 normal, tangential;
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    const SphereWall& sw = sphere_walls_[p * walls_.size() + w];
    for (const SphereWall::Touch& t : sw.touches()) {
      normal += poses_[w].turn(t.force.F_n * t.n);
      tangential += poses_[w].turn(t.force.F_t);
      sample.overlap = std::max(sample.overlap, t.overlap);
    }
  }
  sample.normal = norm(normal);
  sample.tangential = norm(tangential);
  return sample;
}

NormalParts Simulation::normal_parts_on(std::size_t p) const noexcept {
  const Vec3& load = particles_.load[p];
  const Vec3 axis = norm2(load) > 0.0 ? normalized(-load) : Vec3{0.0, 0.0, 1.0};
  NormalParts total;
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    const NormalParts parts =
        sphere_walls_[p * walls_.size() + w].normal_parts(walls_[w], poses_[w].turn_back(axis));
    total.along += parts.along;
    total.across += parts.across;
    total.sum += parts.sum;
  }
  return total;
}

int Simulation::elements_in_contact(std::size_t p) const {
  int count = 0;
  for (std::size_t w = 0; w < walls_.size(); ++w)
    count += sphere_walls_[p * walls_.size() + w].elements(walls_[w]);
  return count;
}

std::uint64_t Simulation::state_hash() const {
  core::StateHash hash;
  hash.add(steps_);
  hash.add(dt_);
  hash.add(std::span<const Vec3>(particles_.position));
  hash.add(std::span<const Vec3>(particles_.velocity));
  hash.add(std::span<const Vec3>(particles_.spin));
  for (const Wall& wall : walls_) {
    if (wall.is_plane()) continue;
    hash.add(std::span<const Vec3>(wall.surface().mesh().vertices));
    hash.add(wall.surface().element_volume());
  }
  for (const SphereWall& sw : sphere_walls_) sw.add_to(hash);
  for (const auto& tip : tips_)
    if (tip) hash.add(std::span<const double>(tip->shape().recession));
  if (bulk_) bulk_->add_to(hash);
  return hash.value();
}

Simulation::WallLoad Simulation::load_on_wall(std::size_t w) const noexcept {
  const geometry::Pose& pose = poses_[w];
  const Vec3 middle = pose.pivot + pose.shift;
  WallLoad sum;
  const auto add = [&](const Vec3& centre, const Vec3& force, const Vec3& torque) {
    sum.force -= force;
    sum.torque -= cross(centre - middle, force) + torque;
  };
  for (std::size_t p = 0; p < particles_.size(); ++p) {
    const SphereWall& contact = sphere_walls_[p * walls_.size() + w];
    if (contact.touches().empty()) continue;
    const ForceAndTorque f = contact.load(pose, particles_.radius[p]);
    add(pose.to_world(contact.centre()), f.force, f.torque);
  }
  if (bulk_) {
    const auto row = [&](std::int32_t i) -> const contact::SphereRow& {
      return bulk_->spheres().row[static_cast<std::size_t>(i)];
    };
    const contact::PlaneList& plane = bulk_->walls().planes()[w];
    for (std::size_t k = 0; k < plane.size(); ++k) {
      if (plane.touching[k] == 0) continue;
      const contact::SphereRow& s = row(plane.sphere[k]);
      add(s.position() - s.velocity() * dt_, plane.load[k].force(), plane.load[k].torque());  // one step back
    }
    for (const BulkWalls::NearMesh& m : bulk_->walls().meshes())
      if (static_cast<std::size_t>(m.wall) == w && !m.contact->touches().empty())
        add(pose.to_world(m.contact->centre()), m.load.force(), m.load.torque());
  }
  sum.power = -dot(sum.force, pose.velocity) - dot(sum.torque, pose.spin);
  if (walls_[w].is_belt()) sum.power -= dot(sum.force, pose.turn(walls_[w].setup().motion.surface_velocity));
  return sum;
}

double Simulation::kinetic_energy() const noexcept {
  double energy = 0.0;
  for (std::size_t p = 0; p < particles_.size(); ++p)
    energy += 0.5 * particles_.mass[p] *
              (norm2(particles_.velocity[p]) +
               0.4 * particles_.radius[p] * particles_.radius[p] * norm2(particles_.spin[p]));
  return energy + bulk_state().kinetic_energy;
}

}  // namespace abradem::simulation
