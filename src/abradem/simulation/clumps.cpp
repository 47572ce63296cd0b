// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/simulation/clumps.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "abradem/core/error.h"
#include "abradem/core/parallel.h"
#include "abradem/core/periodic.h"

namespace abradem::simulation {

namespace {

std::size_t at(std::int32_t i) noexcept { return static_cast<std::size_t>(i); }

constexpr std::size_t kWorthSharing = 64;  // clumps

/// Turns the body by an angle about its own axis k: what it holds still (a vector in the body's frame) turns
/// the other way.
template <double Vec3::*kU, double Vec3::*kV>
void turn_about(double geometry::Quaternion::*axis, double angle, geometry::Quaternion& turn, Vec3& held) {
  const double c = std::cos(angle), s = std::sin(angle);
  const double u = held.*kU, v = held.*kV;
  held.*kU = c * u + s * v;
  held.*kV = c * v - s * u;
  geometry::Quaternion by{std::cos(0.5 * angle)};
  by.*axis = std::sin(0.5 * angle);
  turn = turn * by;
}

}  // namespace

void rotate_freely(geometry::Quaternion& turn, const Vec3& momentum, const Vec3& inertia,
                   double dt) noexcept {
  using geometry::Quaternion;
  Vec3 l = turn.turn_back(momentum);
  const auto about_x = [&](double t) {
    turn_about<&Vec3::y, &Vec3::z>(&Quaternion::x, t * l.x / inertia.x, turn, l);
  };
  const auto about_y = [&](double t) {
    turn_about<&Vec3::z, &Vec3::x>(&Quaternion::y, t * l.y / inertia.y, turn, l);
  };
  const auto about_z = [&](double t) {
    turn_about<&Vec3::x, &Vec3::y>(&Quaternion::z, t * l.z / inertia.z, turn, l);
  };
  about_z(0.5 * dt);
  about_y(0.5 * dt);
  about_x(dt);
  about_y(0.5 * dt);
  about_z(0.5 * dt);
  turn = geometry::normalized(turn);
}

ClumpShape clump_shape(const ShapeSetup& setup) {
  const std::vector<geometry::Ball>& balls = setup.fit ? setup.fit->fit.balls : setup.spheres;
  for (const geometry::Ball& b : balls)
    if (!(b.radius > 0.0) || !is_finite(b.centre))
      throw InputError(fmt::format("shape '{}': every sphere needs a radius > 0", setup.name));
  if (balls.empty()) throw InputError(fmt::format("shape '{}' has no spheres", setup.name));
  const geometry::MassProperties body = setup.fit ? setup.fit->solid : geometry::mass_properties(balls);
  const geometry::PrincipalAxes axes = geometry::principal_axes(body);
  ClumpShape shape;
  shape.name = setup.name;
  shape.turn = axes.turn;
  shape.radius = std::cbrt(0.75 * body.volume / std::numbers::pi);
  if (!(body.volume > 0.0) || !(axes.moments.x > 0.0))
    throw InputError(fmt::format("shape '{}' has no volume", setup.name));
  shape.inertia = axes.moments / std::pow(shape.radius, 5.0);
  shape.smallest = balls.front().radius / shape.radius;
  for (const geometry::Ball& b : balls) {
    const geometry::Ball own{axes.turn.turn_back(b.centre - body.centre) / shape.radius,
                             b.radius / shape.radius};
    shape.bounding = std::max(shape.bounding, norm(own.centre) + own.radius);
    shape.smallest = std::min(shape.smallest, own.radius);
    shape.largest = std::max(shape.largest, own.radius);
    shape.spheres.push_back(own);
  }
  return shape;
}

Setup clumps_in_numbers(Setup setup) {
  using geometry::Quaternion;
  std::vector<InsertionSetup> named;
  for (const ParticleSetup& p : setup.particles) {
    if (p.shape.empty()) continue;
    const auto given = std::ranges::find(setup.shapes, p.shape, &ShapeSetup::name);
    if (given == setup.shapes.end())
      throw InputError(fmt::format("particle '{}': no shape '{}'", p.name, p.shape));
    if (p.guide != Guide::none || p.load != Vec3{})
      throw InputError(fmt::format("particle '{}' is a clump, which has no guide and no load", p.name));
    const ClumpShape shape = clump_shape(*given);
    const Vec3 half = 0.5 * p.rotation;
    const Quaternion turn = Quaternion{std::cos(half.z), 0.0, 0.0, std::sin(half.z)} *
                            Quaternion{std::cos(half.y), 0.0, std::sin(half.y), 0.0} *
                            Quaternion{std::cos(half.x), std::sin(half.x), 0.0, 0.0};
    InsertionSetup& one = named.emplace_back();
    one.name = p.name;
    one.material = p.material;
    one.shape = p.shape;
    one.volume.shape = VolumeShape::file;
    one.placed = {{p.position, p.radius > 0.0 ? p.radius : shape.radius, p.velocity, p.spin}};
    one.turns = {turn * shape.turn};
  }
  std::erase_if(setup.particles, [](const ParticleSetup& p) { return !p.shape.empty(); });
  setup.insertions.insert(setup.insertions.begin(), named.begin(), named.end());
  return setup;
}

void Clumps::add(const Birth& birth, contact::Spheres& spheres, std::int32_t& next_id) {
  const ClumpShape& shape = shapes_[at(birth.shape)];
  Clump c;
  c.id = next_clump_++;
  c.shape = birth.shape;
  c.first_sphere = next_id;
  c.material = birth.material;
  c.radius = birth.radius;
  const double R3 = birth.radius * birth.radius * birth.radius;
  c.mass = birth.density * 4.0 / 3.0 * std::numbers::pi * R3;
  c.inertia = birth.density * R3 * birth.radius * birth.radius * shape.inertia;
  c.position = birth.position;
  c.velocity = birth.velocity;
  c.turn = birth.turn;
  const Vec3 w = c.turn.turn_back(birth.spin);
  c.momentum = c.turn.turn({c.inertia.x * w.x, c.inertia.y * w.y, c.inertia.z * w.z});
  spheres.clump.resize(spheres.size(), -1);
  for (const geometry::Ball& b : shape.spheres) {
    contact::SphereRow s;
    const Vec3 arm = c.turn.turn(birth.radius * b.centre);
    s.set_position(c.position + arm);
    s.set_velocity(c.velocity + cross(birth.spin, arm));
    s.set_spin(birth.spin);
    s.radius = birth.radius * b.radius;
    s.inverse_mass = 1.0 / c.mass;
    s.material = c.material;
    spheres.row.push_back(s);
    spheres.id.push_back(next_id++);
    spheres.clump.push_back(static_cast<std::int32_t>(clumps_.size()));
  }
  clumps_.push_back(c);
}

void Clumps::take_out(const std::vector<std::uint8_t>& gone, contact::Spheres& spheres) const {
  for (std::size_t i = 0; i < spheres.clump.size(); ++i)
    if (spheres.clump[i] >= 0 && gone[at(spheres.clump[i])] != 0) spheres.id[i] = -1;
}

void Clumps::settle(contact::Spheres& spheres, const Vec3& low, const Vec3& period) {
  std::vector<std::int32_t> now(clumps_.size(), -1);
  for (const std::int32_t c : spheres.clump)
    if (c >= 0) now[at(c)] = 0;
  std::size_t kept = 0;
  for (std::size_t c = 0; c < clumps_.size(); ++c) {
    if (now[c] < 0) continue;
    now[c] = static_cast<std::int32_t>(kept);
    clumps_[kept++] = clumps_[c];
  }
  clumps_.resize(kept);
  for (std::int32_t& c : spheres.clump)
    if (c >= 0) c = now[at(c)];
  for (Clump& c : clumps_) c.position = wrapped(c.position, low, period);
  static_cast<void>(locate(spheres, period));
}

/// @return whether every clump has all its spheres
bool Clumps::locate(const contact::Spheres& spheres, const Vec3& period) {
  start_.assign(1, 0);
  for (const Clump& c : clumps_) start_.push_back(start_.back() + shape_of(c).spheres.size());
  member_.assign(start_.back(), -1);
  for (std::size_t i = 0; i < spheres.clump.size(); ++i) {
    if (spheres.clump[i] < 0) continue;
    const auto c = at(spheres.clump[i]);
    const std::int32_t m = spheres.id[i] - clumps_[c].first_sphere;
    if (m < 0 || at(m) >= start_[c + 1] - start_[c]) return false;
    member_[start_[c] + at(m)] = static_cast<std::int32_t>(i);
  }
  if (std::ranges::find(member_, -1) != member_.end()) return false;
  image_.assign(member_.size(), {});
  if (period == Vec3{}) return true;
  const auto whole = [](double d, double length) {
    return length > 0.0 ? length * std::round(d / length) : 0.0;
  };
  for (std::size_t c = 0; c < clumps_.size(); ++c)
    for (std::size_t k = start_[c]; k < start_[c + 1]; ++k) {
      const Vec3 own =
          clumps_[c].position +
          clumps_[c].turn.turn(clumps_[c].radius * shape_of(clumps_[c]).spheres[k - start_[c]].centre);
      const Vec3 d = spheres.row[at(member_[k])].position() - own;
      image_[k] = {whole(d.x, period.x), whole(d.y, period.y), whole(d.z, period.z)};
    }
  return true;
}

void Clumps::take_loads(contact::LoadRows& load) {
  core::parallel_for(
      clumps_.size(),
      [&](std::size_t n) {
        Clump& c = clumps_[n];
        const ClumpShape& shape = shape_of(c);
        c.force = c.torque = {};
        for (std::size_t k = start_[n]; k < start_[n + 1]; ++k) {
          contact::LoadRow& l = load[at(member_[k])];
          const Vec3 f = l.force();
          if (f != Vec3{} || l.torque() != Vec3{}) {
            const Vec3 arm = c.turn.turn(c.radius * shape.spheres[k - start_[n]].centre);
            c.force += f;
            c.torque += l.torque() + cross(arm, f);
          }
          const double stiffening = l.stiffening;  // the watch of the step asks for it
          l = {};
          l.stiffening = stiffening;
        }
      },
      kWorthSharing);
}

double Clumps::response(const Clump& c) const noexcept {
  double furthest2 = 0.0;
  for (const geometry::Ball& b : shape_of(c).spheres) furthest2 = std::max(furthest2, norm2(b.centre));
  return 1.0 / c.mass + c.radius * c.radius * furthest2 / std::min({c.inertia.x, c.inertia.y, c.inertia.z});
}

void Clumps::place(const Clump& c, std::size_t n, contact::Spheres& spheres) const noexcept {
  const ClumpShape& shape = shape_of(c);
  const Vec3 spin = c.spin();
  for (std::size_t k = start_[n]; k < start_[n + 1]; ++k) {
    contact::SphereRow& s = spheres.row[at(member_[k])];
    const Vec3 arm = c.turn.turn(c.radius * shape.spheres[k - start_[n]].centre);
    s.set_position(c.position + arm + image_[k]);
    s.set_velocity(c.velocity + cross(spin, arm));
    s.set_spin(spin);
  }
}

void Clumps::advance(contact::Spheres& spheres, const contact::LoadRows& load, const Vec3& gravity, double dt,
                     contact::Advance& met) {
  constexpr std::size_t kBlock = 256;
  std::vector<contact::Advance> of_block((clumps_.size() + kBlock - 1) / kBlock);
  core::parallel_blocks(of_block.size(), [&](std::size_t b) {
    contact::Advance& own = of_block[b];
    for (std::size_t n = b * kBlock; n < std::min(clumps_.size(), (b + 1) * kBlock); ++n) {
      Clump& c = clumps_[n];
      c.velocity += c.force * (dt / c.mass) + gravity * dt;
      c.position += c.velocity * dt;
      c.momentum += c.torque * dt;
      if (c.momentum != Vec3{}) rotate_freely(c.turn, c.momentum, c.inertia, dt);
      place(c, n, spheres);
      double stiffening = 0.0;
      for (std::size_t k = start_[n]; k < start_[n + 1]; ++k) {
        const contact::SphereRow& s = spheres.row[at(member_[k])];
        const double v2 = norm2(s.velocity());
        own.finite = own.finite && v2 < 1e300;
        own.fastest2 = std::max(own.fastest2, v2);
        own.longest = std::max(own.longest, dt * std::sqrt(v2) / s.radius);
        stiffening += load[at(member_[k])].stiffening;
      }
      if (stiffening > 0.0) own.stability = std::max(own.stability, stiffening * response(c));
    }
  });
  for (const contact::Advance& own : of_block) {
    met.fastest2 = std::max(met.fastest2, own.fastest2);
    met.longest = std::max(met.longest, own.longest);
    met.stability = std::max(met.stability, own.stability);
    met.finite = met.finite && own.finite;
  }
}

bool Clumps::sound(const Clump& c) const noexcept {
  const double q2 = c.turn.norm2();
  return c.shape >= 0 && at(c.shape) < shapes_.size() && c.id >= 0 && c.id < next_clump_ && c.radius > 0.0 &&
         std::isfinite(c.radius) && c.mass > 0.0 && std::isfinite(c.mass) && is_finite(c.inertia) &&
         std::min({c.inertia.x, c.inertia.y, c.inertia.z}) > 0.0 && is_finite(c.position) &&
         is_finite(c.velocity) && is_finite(c.momentum) && std::abs(q2 - 1.0) < 1e-6 && is_finite(c.force) &&
         is_finite(c.torque);
}

bool Clumps::restore(const contact::Spheres& spheres, const Vec3& period) {
  if (!spheres.clump.empty() && spheres.clump.size() != spheres.size()) return false;
  if (spheres.clump.empty() && !clumps_.empty()) return false;
  if (!std::ranges::all_of(clumps_, [&](const Clump& c) { return sound(c); })) return false;
  if (!std::ranges::all_of(spheres.clump,
                           [&](std::int32_t c) { return c >= -1 && (c < 0 || at(c) < clumps_.size()); }))
    return false;
  return locate(spheres, period);
}

void Clumps::add_to(core::StateHash& hash) const {
  for (const Clump& c : clumps_) {
    hash.add(static_cast<std::uint64_t>(c.id));
    hash.add(c.position);
    hash.add(c.velocity);
    hash.add(c.momentum);
    hash.add(Vec3{c.turn.x, c.turn.y, c.turn.z});
    hash.add(c.turn.w);
  }
}

}  // namespace abradem::simulation
