// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/simulation/insertion.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <unordered_map>

#include "abradem/core/error.h"

namespace abradem::simulation {

namespace {

constexpr double pi = std::numbers::pi;

double mass_of(double radius, double density) noexcept {
  return density * 4.0 / 3.0 * pi * radius * radius * radius;
}

/// Standard normal, by Box and Muller; one of the pair is thrown away, so that a draw keeps no state.
double draw_normal(core::RandomStream& random) {
  const double u = 1.0 - random.uniform(), v = random.uniform();
  return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * pi * v);
}

/// Spheres by cells, to ask whether one more would overlap.
class Occupancy {
 public:
  explicit Occupancy(double largest) : cell_(2.0 * largest), largest_(largest) {}
  void add(const Vec3& p, double R) {
    const std::size_t index = spheres_.size();
    spheres_.push_back({p, R});
    largest_ = std::max(largest_, R);
    cells_[key(cell_of(p.x), cell_of(p.y), cell_of(p.z))].push_back(index);
  }
  [[nodiscard]] bool is_free(const Vec3& p, double R) const {
    const double reach = R + largest_;
    for (auto z = cell_of(p.z - reach); z <= cell_of(p.z + reach); ++z)
      for (auto y = cell_of(p.y - reach); y <= cell_of(p.y + reach); ++y)
        for (auto x = cell_of(p.x - reach); x <= cell_of(p.x + reach); ++x) {
          const auto cell = cells_.find(key(x, y, z));
          if (cell == cells_.end()) continue;
          for (const std::size_t s : cell->second) {
            const double r = R + spheres_[s].radius;
            if (norm2(p - spheres_[s].position) < r * r) return false;
          }
        }
    return true;
  }

 private:
  struct Ball {
    Vec3 position;
    double radius;
  };
  [[nodiscard]] std::int64_t cell_of(double x) const noexcept {
    return static_cast<std::int64_t>(std::floor(x / cell_));
  }
  [[nodiscard]] static std::int64_t key(std::int64_t x, std::int64_t y, std::int64_t z) noexcept {
    constexpr std::int64_t mask =
        (1 << 21) - 1;  // cells beyond a million from the origin share keys: harmless
    return ((z & mask) << 42) | ((y & mask) << 21) | (x & mask);
  }
  double cell_, largest_;
  std::vector<Ball> spheres_;
  std::unordered_map<std::int64_t, std::vector<std::size_t>> cells_;
};

}  // namespace

geometry::BoundingBox box_of(const VolumeSetup& v) {
  if (v.shape != VolumeShape::cylinder) return {v.low, v.high};
  const Vec3 axis = normalized(v.top - v.base);
  const auto across = [&](double a) { return v.radius * std::sqrt(std::max(0.0, 1.0 - a * a)); };
  const Vec3 r{across(axis.x), across(axis.y), across(axis.z)};
  return {{std::min(v.base.x, v.top.x) - r.x, std::min(v.base.y, v.top.y) - r.y,
           std::min(v.base.z, v.top.z) - r.z},
          {std::max(v.base.x, v.top.x) + r.x, std::max(v.base.y, v.top.y) + r.y,
           std::max(v.base.z, v.top.z) + r.z}};
}

double volume_of(const VolumeSetup& v) {
  if (v.shape == VolumeShape::cylinder) return pi * v.radius * v.radius * norm(v.top - v.base);
  const Vec3 e = v.high - v.low;
  return e.x * e.y * e.z;
}

double smallest_radius(const SizeSetup& size) noexcept {
  switch (size.kind) {
    case SizeKind::single:
      return size.radius;
    case SizeKind::table:
      return size.radii.empty() ? 0.0 : *std::ranges::min_element(size.radii);
    default:
      return size.low;
  }
}

double largest_radius(const SizeSetup& size) noexcept {
  switch (size.kind) {
    case SizeKind::single:
      return size.radius;
    case SizeKind::table:
      return size.radii.empty() ? 0.0 : *std::ranges::max_element(size.radii);
    default:
      return size.high;
  }
}

double smallest_radius(const InsertionSetup& insertion) noexcept {
  if (insertion.placed.empty()) return smallest_radius(insertion.size);
  return std::ranges::min(insertion.placed, {}, &PlacedSphere::radius).radius;
}

double largest_radius(const InsertionSetup& insertion) noexcept {
  if (insertion.placed.empty()) return largest_radius(insertion.size);
  return std::ranges::max(insertion.placed, {}, &PlacedSphere::radius).radius;
}

double draw_radius(const SizeSetup& size, core::RandomStream& random) {
  switch (size.kind) {
    case SizeKind::single:
      return size.radius;
    case SizeKind::uniform:
      return random.uniform(size.low, size.high);
    case SizeKind::table: {
      double sum = 0.0;
      for (const double share : size.shares) sum += share;
      double left = random.uniform() * sum;
      for (std::size_t k = 0; k + 1 < size.radii.size(); ++k) {
        left -= size.shares[k];
        if (left < 0.0) return size.radii[k];
      }
      return size.radii.back();
    }
    case SizeKind::normal:
    case SizeKind::lognormal:
      break;
  }
  // ln R of a lognormal with this mean and sd of R itself.
  const double variance = std::log1p(size.sd * size.sd / (size.mean * size.mean));
  const double middle = std::log(size.mean) - 0.5 * variance;
  for (;;) {
    const double z = draw_normal(random);
    const double R =
        size.kind == SizeKind::normal ? size.mean + size.sd * z : std::exp(middle + std::sqrt(variance) * z);
    if (R >= size.low && R <= size.high) return R;
  }
}

Inserter::Inserter(const InsertionSetup& setup, int material, double density, std::uint64_t seed,
                   std::uint64_t stream, const ClumpShape* shape)
    : setup_(&setup),
      material_(material),
      density_(density),
      random_(seed, stream),
      turns_(seed, stream + 1'000'000),
      next_(setup.start) {
  if (shape != nullptr) shape_ = *shape;
  if (setup_->placed.empty()) {
    refuse_too_small_a_volume();
    draw_next();
  }
}

void Inserter::refuse_too_small_a_volume() const {
  const VolumeSetup& v = setup_->volume;
  const double R = (shape_ ? shape_->bounding : 1.0) * largest_radius(setup_->size);
  const auto narrow = [&](double e) { return !(v.shape == VolumeShape::face && e == 0.0) && e < 2.0 * R; };
  const Vec3 e = v.high - v.low;
  const bool fits = v.shape == VolumeShape::cylinder ? v.radius >= R && norm(v.top - v.base) >= 2.0 * R
                                                     : !narrow(e.x) && !narrow(e.y) && !narrow(e.z);
  if (!fits)
    throw InputError(
        fmt::format("insertion '{}': its volume is too small for one {} of {:.4g} mm radius", setup_->name,
                    shape_ ? fmt::format("'{}', which turns in a sphere", shape_->name) : "sphere", 1e3 * R));
}

void Inserter::draw_next() {
  radius_ = draw_radius(setup_->size, random_);
  if (!shape_) return;
  const double u = turns_.uniform(), v = turns_.uniform();
  turn_ = geometry::uniform_rotation(u, v, turns_.uniform());
}

Vec3 Inserter::draw_place(double radius) {
  const VolumeSetup& v = setup_->volume;
  if (v.shape != VolumeShape::cylinder) {
    const auto margin = [&](double low, double high) {
      return high > low ? radius : 0.0;
    };  // on a face: none
    const Vec3 r{margin(v.low.x, v.high.x), margin(v.low.y, v.high.y), margin(v.low.z, v.high.z)},
        low = v.low + r, high = v.high - r;
    const double x = random_.uniform(low.x, high.x), y = random_.uniform(low.y, high.y);
    return {x, y, random_.uniform(low.z, high.z)};
  }
  const Vec3 axis = normalized(v.top - v.base);
  const Vec3 side = normalized(cross(axis, std::abs(axis.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
  const double along = random_.uniform(radius, norm(v.top - v.base) - radius);
  const double out = (v.radius - radius) * std::sqrt(random_.uniform()), angle = 2.0 * pi * random_.uniform();
  return v.base + along * axis + out * (std::cos(angle) * side + std::sin(angle) * cross(axis, side));
}

bool Inserter::restored() const noexcept {
  const bool drawn = !setup_->placed.empty() ||
                     (radius_ >= smallest_radius(setup_->size) && radius_ <= largest_radius(setup_->size));
  return drawn && mass_ >= 0.0 && std::isfinite(mass_) && next_ >= 0.0 &&
         std::abs(turn_.norm2() - 1.0) < 1e-6;
}

bool Inserter::due(double time, double next_mass) const noexcept {
  if (!setup_->placed.empty()) return inserted_ < setup_->placed.size();
  if (setup_->number > 0 && inserted_ >= setup_->number) return false;
  if (setup_->mass && mass_ + 0.5 * next_mass > *setup_->mass) return false;
  return !setup_->mass_rate || mass_ + next_mass <= *setup_->mass_rate * (time - setup_->start);
}

std::vector<contact::SphereRow> Inserter::insert(double time, const contact::Spheres& present,
                                                 const Vec3& period, const Clear& clear) {
  std::vector<contact::SphereRow> made;
  for (const Clumps::Birth& b : bring_in(time, present, period, clear)) {
    contact::SphereRow s;
    s.set_position(b.position);
    s.set_velocity(b.velocity);
    s.set_spin(b.spin);
    s.radius = b.radius;
    s.inverse_mass = 1.0 / mass_of(b.radius, density_);
    s.material = material_;
    made.push_back(s);
  }
  return made;
}

std::vector<Clumps::Birth> Inserter::insert_clumps(double time, const contact::Spheres& present,
                                                   const Vec3& period, const Clear& clear) {
  return bring_in(time, present, period, clear);
}

std::vector<Clumps::Birth> Inserter::bring_in(double time, const contact::Spheres& present,
                                              const Vec3& period, const Clear& clear) {
  std::vector<Clumps::Birth> made;
  const auto make = [&](const Vec3& p, double R, const Vec3& v, const Vec3& spin) {
    made.push_back({0, material_, R, density_, p, v, spin, turn_});
    ++inserted_;
    mass_ += mass_of(R, density_);
  };
  if (!setup_->placed.empty()) {
    for (std::size_t k = 0; k < setup_->placed.size(); ++k) {
      const PlacedSphere& p = setup_->placed[k];
      if (!setup_->turns.empty()) {
        turn_ = setup_->turns[k];
      } else if (shape_) {
        const double u = turns_.uniform(), v = turns_.uniform();
        turn_ = geometry::uniform_rotation(u, v, turns_.uniform());
      }
      make(p.position, p.radius, p.velocity, p.spin);
    }
    next_ = std::numeric_limits<double>::infinity();
    return made;
  }
  const double largest = largest_radius(setup_->size), bounding = shape_ ? shape_->bounding : 1.0;
  const geometry::BoundingBox box = box_of(setup_->volume);
  Occupancy occupancy(shape_ ? largest * shape_->largest : largest);
  const double beyond = setup_->volume.shape == VolumeShape::face ? bounding * largest
                                                                  : 0.0;  // bodies lie inside, but of a face
  const auto add = [&](const Vec3& centre, double R) {                    // and its images
    const auto count = [](double length) { return length > 0.0 ? 1 : 0; };
    for (int i = -count(period.x); i <= count(period.x); ++i)
      for (int j = -count(period.y); j <= count(period.y); ++j)
        for (int k = -count(period.z); k <= count(period.z); ++k) {
          const Vec3 p = centre + Vec3{i * period.x, j * period.y, k * period.z};
          const double r = R + beyond;
          if (p.x > box.low.x - r && p.y > box.low.y - r && p.z > box.low.z - r && p.x < box.high.x + r &&
              p.y < box.high.y + r && p.z < box.high.z + r)
            occupancy.add(p, R);
        }
  };
  /// Calls f(centre, radius) for the next one's spheres at p until one says no. @return whether none did
  const auto all_spheres = [&](const Vec3& p, auto&& f) {
    if (!shape_) return f(p, radius_);
    return std::ranges::all_of(shape_->spheres, [&](const geometry::Ball& b) {
      return f(p + turn_.turn(radius_ * b.centre), radius_ * b.radius);
    });
  };
  for (const contact::SphereRow& s : present.row) add(s.position(), s.radius);
  waiting_ = false;
  while (!waiting_ && due(time, mass_of(radius_, density_))) {
    // Finds a gap of a 1/5000 of the volume nearly always; at a rate there will be another try soon.
    const int tries = setup_->mass_rate ? 1000 : 20000;
    waiting_ = true;
    for (int k = 0; k < tries && waiting_; ++k) {
      const Vec3 p = draw_place(shape_ ? radius_ * bounding : radius_);
      if (!all_spheres(
              p, [&](const Vec3& c, double R) { return occupancy.is_free(c, R) && (!clear || clear(c, R)); }))
        continue;
      static_cast<void>(all_spheres(p, [&](const Vec3& c, double R) {
        add(c, R);
        return true;
      }));
      make(p, radius_, setup_->velocity, setup_->spin);
      draw_next();
      waiting_ = false;
    }
  }
  if (waiting_ && !setup_->mass_rate) refuse_full_volume();
  // At a rate: again when a sphere of the largest size may have cleared its place.
  const double pause = setup_->mass_rate ? std::max(mass_of(radius_, density_) / *setup_->mass_rate, 1e-3)
                                         : std::numeric_limits<double>::infinity();
  const bool done = (setup_->number > 0 && inserted_ >= setup_->number) ||
                    (setup_->mass && mass_ + 0.5 * mass_of(radius_, density_) > *setup_->mass);
  next_ = done ? std::numeric_limits<double>::infinity() : time + pause;
  return made;
}

void Inserter::refuse_full_volume() const {
  throw InputError(fmt::format(
      "insertion '{}': its volume is full after {} of the {} particles to be placed there ({:.3g} kg, {:.1f} "
      "% of the volume; at random, without overlaps, {} can be reached, less where walls stand in it). "
      "Enlarge "
      "the volume, lower the number, or insert at a mass_rate{}",
      setup_->name, inserted_,
      setup_->number > 0 ? fmt::format("{}", setup_->number) : fmt::format("{:.4g} kg of", *setup_->mass),
      mass_, 100.0 * mass_ / density_ / volume_of(setup_->volume),
      shape_ ? "less than the 30 % of spheres" : "about 30 %",
      inserted_ == 0 ? ". Does it lie inside a wall? A closed mesh is a solid; a container of one layer has "
                       "sides = \"both\""
                     : ""));
}

}  // namespace abradem::simulation
