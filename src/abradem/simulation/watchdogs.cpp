// SPDX-License-Identifier: BSD-3-Clause
// A state that the equations no longer describe stops the run, with what is needed to see why.
// docs/reliability.md#watchdogs
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "abradem/core/error.h"
#include "abradem/simulation/simulation.h"

namespace abradem::simulation {

namespace {

constexpr double kDeepest = 0.1;  // of the radius: Hertz's small contact is long gone

/// Fastest that a point of the wall can be within `extent` of the scene [m/s], its belt included.
double fastest(const WallSetup& wall, double extent) {
  double sum = norm(wall.motion.surface_velocity), displaced = 0.0;
  for (std::size_t k = 0; k < wall.motions(); ++k)
    if (const double d = limits_of(wall.motion_at(k)).displacement; std::isfinite(d)) displaced += d;
  for (std::size_t k = 0; k < wall.motions(); ++k) {
    const MotionLimits most = limits_of(wall.motion_at(k));
    sum += most.speed + most.rate * (extent + displaced + norm(wall.motion_at(k).center));
  }
  return sum;
}

/// What rounding of its nodes' coordinates may change of the volume that a surface swept [m^3]: a node is
/// known to half a unit in the last place, times the area that hangs on it.
double rounding_of(const wear::WearingSurface& surface) {
  double furthest = 0.0, area = 0.0;
  for (const geometry::Index t : surface.worn_triangles()) {
    const geometry::Triangle& v = surface.mesh().triangles[static_cast<std::size_t>(t)];
    const auto node = [&](std::size_t k) { return surface.reference()[static_cast<std::size_t>(v[k])]; };
    for (std::size_t k = 0; k < 3; ++k) furthest = std::max(furthest, norm(node(k)));
    area += 0.5 * norm(cross(node(1) - node(0), node(2) - node(0)));
  }
  return std::numeric_limits<double>::epsilon() * furthest * area;
}

}  // namespace

/// A particle gets its energy from its start, from falling along load and gravity through the scene, and from
/// walls that hit it: a hundred times all that is an explosion.
void Simulation::limit_energies() {
  constexpr double kExplosion = 100.0;
  Vec3 low = particles_.position.empty() ? Vec3{} : particles_.position.front(), high = low;
  const auto include = [&](const Vec3& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  };
  for (const Vec3& p : particles_.position) include(p);
  bool bounded = true;  // a plane has no end: what lies on it may go far
  for (const Wall& wall : walls_) {
    bounded = bounded && !wall.is_plane();
    if (!wall.is_plane())
      for (const Vec3& p : wall.surface().reference()) include(p);
  }
  const double extent = norm(high - low);
  energy_limit_.assign(particles_.size(), 0.0);
  if (!setup_.insertions.empty()) {
    // Whatever comes in may hit them.
    energy_limit_.assign(particles_.size(), std::numeric_limits<double>::infinity());
    limit_bulk_energy(low, high, bounded);
    return;
  }
  for (std::size_t p = 0; p < particles_.size(); ++p) {
    const double m = particles_.mass[p], R = particles_.radius[p];
    const double force = norm(particles_.load[p]) + m * norm(setup_.run.gravity);
    const double start = norm(particles_.velocity[p]);
    double way = particles_.guide[p] != Vec3{} ? 2.0 * R : extent + 2.0 * R;
    if (!bounded && particles_.guide[p] == Vec3{}) way += start * end_ + 0.5 * force / m * end_ * end_;
    double hit = start;
    for (const Wall& wall : walls_) hit = std::max(hit, 2.0 * fastest(wall.setup(), extent));
    energy_limit_[p] = kExplosion * (0.5 * m * hit * hit + force * way);
    double stored = 0.0;  // in a contact that starts as deep as it may, or is drawn together so far
    const auto contact_with = [&](int material) {
      const contact::PairProperties& c = pair(particles_.material[p], material);
      const double overlap = kDeepest * R, area = 2.0 * std::numbers::pi * R * overlap;
      const double cohesive = (c.options.cohesion * overlap + c.options.adhesion) * area;
      stored = std::max(stored, 0.4 * overlap * contact::hertz_force(c, R, overlap) + cohesive);
    };
    for (const Wall& wall : walls_) contact_with(wall.material());
    for (std::size_t q = 0; q < particles_.size(); ++q)
      if (q != p && pair(particles_.material[p], particles_.material[q]).options.any())
        contact_with(particles_.material[q]);
    energy_limit_[p] += stored;
  }
  // Particles hand on their energies to one another.
  double whole = 0.0;
  for (const double e : energy_limit_) whole += e;
  for (double& e : energy_limit_)
    if (particles_.size() > 1) e = whole;
}

/// The same for particles in numbers, per mass, and so for their speed. Between spheres of different size a
/// light one may leave with some times the speed of the heavy one; with ten times that of all sources none
/// does.
void Simulation::limit_bulk_energy(Vec3 low, Vec3 high, bool bounded) {
  constexpr double kExplosion = 100.0;
  const auto include = [&](const Vec3& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  };
  double hit = 0.0, elastic = 0.0, pull = norm(setup_.run.gravity);
  for (std::size_t p = 0; p < particles_.size(); ++p) {
    hit = std::max(hit, norm(particles_.velocity[p]));
    pull = std::max(pull, norm(setup_.run.gravity) + norm(particles_.load[p]) / particles_.mass[p]);
  }
  for (const InsertionSetup& i : setup_.insertions) {
    // A spin becomes a speed where it meets something.
    hit = std::max(hit, norm(i.velocity) + norm(i.spin) * largest_radius(i.size));
    for (const PlacedSphere& s : i.placed) {
      include(s.position);
      hit = std::max(hit, norm(s.velocity) + norm(s.spin) * s.radius);
    }
    if (i.placed.empty()) {
      const geometry::BoundingBox box = box_of(i.volume);
      include(box.low);
      include(box.high);
    }
    // Of a sphere that starts as deep in another one as it may.
    const auto m = std::ranges::find(setup_.materials, i.material, &MaterialSetup::name);
    const auto k = static_cast<int>(m - setup_.materials.begin());
    const double R = smallest_radius(i), overlap = 2.0 * kDeepest * R;
    const double mass =
        materials_[static_cast<std::size_t>(k)].density * 4.0 / 3.0 * std::numbers::pi * R * R * R;
    elastic = std::max(elastic, 0.4 * overlap * contact::hertz_force(pair(k, k), R, overlap) / mass);
  }
  if (setup_.domain) {
    include(setup_.domain->low);
    include(setup_.domain->high);
  }
  const double extent = norm(high - low);
  for (const Wall& wall : walls_) hit = std::max(hit, 2.0 * fastest(wall.setup(), extent));
  double way = extent;
  if (!bounded && !setup_.domain) way += hit * end_ + 0.5 * pull * end_ * end_;
  bulk_->limit_speed(std::sqrt(2.0 * kExplosion * (0.5 * hit * hit + pull * way + elastic)));
}

void Simulation::check_state() const {
  const auto fail = [&](std::size_t p, const std::string& what, const char* advice) {
    throw SimulationError(fmt::format("particle '{}', step {}, {:.6g} s: {}. {}", particles_.name[p], steps_,
                                      time(), what, advice));
  };
  constexpr auto kGeneral =
      "Shorten the time step, or check the load, the stiffness and the starting position";
  for (std::size_t p = 0; p < particles_.size(); ++p) {
    const double R = particles_.radius[p];
    if (!is_finite(particles_.position[p]) || !is_finite(particles_.velocity[p]) ||
        !is_finite(particles_.spin[p]))
      fail(p, "its position, speed or spin is no longer a number", kGeneral);
    // A guided sphere that has sunk by its own radius has no wall under it any more.
    const Vec3& guide = particles_.guide[p];
    if (dot(particles_.position[p] - setup_.particles[p].position, guide) > R)
      fail(p, "it has moved by more than its radius along its guide: it has left the walls", kGeneral);
    // A faster one may pass through a wall between two steps.
    const double speed = norm(particles_.velocity[p]);
    if (const double way = speed * dt_; way > kDeepest * R)
      fail(p, fmt::format("it moves {:.4g} mm in one step, more than a tenth of its radius", 1e3 * way),
           kGeneral);
    if (const double energy = 0.5 * particles_.mass[p] * speed * speed; energy > energy_limit_[p])
      fail(p,
           fmt::format(
               "its energy explodes: {:.4g} J at {:.4g} m/s, a hundred times what its start, load, gravity "
               "and the walls can give it",
               energy, speed),
           "Shorten the time step; if the forces are meant to be as large, check the stiffness");
    for (std::size_t w = 0; w < walls_.size(); ++w) {
      // A wall that comes by more than the radius in one step may jump over the centre, unseen by any
      // overlap.
      const Vec3 past = particles_.velocity[p] - poses_[w].velocity_at(particles_.position[p]);
      if (const double way = norm(past) * dt_; way > R && setup_.run.method == Method::dynamic)
        fail(
            p,
            fmt::format("wall '{}' moves past it by {:.4g} mm in one step, more than its radius: it may pass "
                        "through unseen",
                        walls_[w].setup().name, 1e3 * way),
            kGeneral);
      const SphereWall& sw = sphere_walls_[p * walls_.size() + w];
      for (const SphereWall::Touch& t : sw.touches()) {
        // Not a number fails the comparison too.
        if (t.overlap <= kDeepest * R) continue;
        const geometry::Index face = sw.nearest_triangle(poses_[w].to_body(particles_.position[p]));
        fail(p,
             fmt::format(
                 "its overlap with wall '{}'{} is {:.4g} mm, more than a tenth of its radius of {:.4g} mm; "
                 "it presses with {:.4g} N",
                 walls_[w].setup().name, face >= 0 ? fmt::format(", triangle {},", face) : "",
                 1e3 * t.overlap, 1e3 * R, t.elastic_force),
             kGeneral);
      }
    }
  }
  for (std::size_t w = 0; w < walls_.size(); ++w)
    if (!std::isfinite(law_[w]) || !std::isfinite(displaced_[w]))
      throw SimulationError(
          fmt::format("wall '{}', step {}, {:.6g} s: what it has lost is no longer a number. {}",
                      walls_[w].setup().name, steps_, time(), kGeneral));
}

/// Between outputs too, where no wear waits for an update of the surface.
bool Simulation::ledger_due() const noexcept {
  constexpr std::uint64_t kBetweenLedgers = std::uint64_t{1} << 16U;
  return steps_ % kBetweenLedgers == 0 && std::ranges::all_of(walls_, [this](const Wall& wall) {
           return steps_ % static_cast<std::uint64_t>(wall.setup().deform_every) == 0;
         });
}

double Simulation::ledger_tolerance(const Ledger& books) const {
  constexpr double kLargest = 1e-9;  // round-off of a long run stays a thousand times below
  const double worn = books.law + books.displaced;
  if (!(worn > 0.0)) return kLargest;
  double rounding = 0.0;
  for (const Wall& wall : walls_)
    if (!wall.is_plane()) rounding += rounding_of(wall.surface());
  return kLargest + rounding / worn;
}

/// The books are compared at every output: a difference is a fault of the program, or wear too deep for the
/// mesh.
void Simulation::check_ledger() {
  constexpr auto kAdvice =
      "If wear is as deep as a triangle is long, take a shorter time_step, a coarser mesh or less wear per "
      "revolution; otherwise please report it with the case file";
  const Ledger books = ledger();
  // Of what is no number the largest residual may be one.
  const double sum = books.law + books.deposited + books.swept + books.tip_deposited + books.tip_removed;
  const auto check = [&](double residual, const char* whose, double law, double deposited, double shape) {
    if (residual <= ledger_tolerance(books) && std::isfinite(sum)) return;
    throw SimulationError(fmt::format(
        "step {}, {:.6g} s: the ledger{} does not close: law {:.12g} mm^3, deposited {:.12g}, by the shape "
        "{:.12g}; residual {:.3g}, at most {:.0e}. {}",
        steps_, time(), whose, 1e9 * law, 1e9 * deposited, 1e9 * shape, residual, ledger_tolerance(books),
        kAdvice));
  };
  check(books.residual, "", books.law, books.deposited, books.swept);
  check(books.tip_residual, " of the worn tips", books.tip_law, books.tip_deposited, books.tip_removed);
}

}  // namespace abradem::simulation
