// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "abradem/core/prefetch.h"
#include "abradem/wear/laws.h"

/// What a wall suffers, element by element, and how hard and fast, region by region.
///                                                                         docs/theory/wear.md#maps
namespace abradem::wear {

/// Class of a positive number: eight to each doubling, bounded by 2^e (1 + k/8). 0 has the class 0.
[[nodiscard]] inline std::uint16_t eighth_octave(double x) noexcept {
  constexpr int kShift = 49;  // leaves the exponent and three bits of the mantissa
  return x > 0.0 ? static_cast<std::uint16_t>(std::bit_cast<std::uint64_t>(x) >> kShift) : std::uint16_t{0};
}
/// Smallest number of a class.
[[nodiscard]] inline double low_of_eighth_octave(std::uint16_t bin) noexcept {
  return std::bit_cast<double>(static_cast<std::uint64_t>(bin) << 49);
}

/// Sums kept for the classes that occur, by key.
template <typename Sums>
class SparseBins {
 public:
  struct Entry {
    std::uint64_t key = 0;
    Sums sums;

    template <typename Self, typename Archive>
    static void visit(Self& self, Archive& archive) {
      archive("key", self.key)("sums", self.sums);
    }
  };
  Sums& operator[](std::uint64_t key) {
    std::uint32_t& found = found_[place_of(key)];
    if (found < entries_.size() && entries_[found].key == key) return entries_[found].sums;
    auto place = std::ranges::lower_bound(entries_, key, {}, &Entry::key);
    if (place == entries_.end() || place->key != key) place = entries_.insert(place, Entry{key, {}});
    found = static_cast<std::uint32_t>(place - entries_.begin());
    return place->sums;
  }
  /// Asks the memory for the sums of a key that occurred before.
  void fetch(std::uint64_t key) const noexcept {
    if (const std::size_t found = found_[place_of(key)]; found < entries_.size())
      __builtin_prefetch(&entries_[found], 1);
  }
  /// In the order of the keys.
  [[nodiscard]] const std::vector<Entry>& entries() const noexcept { return entries_; }

  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("entries", self.entries_);
  }

 private:
  [[nodiscard]] static std::size_t place_of(std::uint64_t key) noexcept {
    return key * 0x9e3779b97f4a7c15U >> 54U;
  }

  std::vector<Entry> entries_;
  std::array<std::uint32_t, 1024> found_{};  // where keys were last found, by ten bits of their hash
};

/// Contacts that slide, by their normal force and sliding speed.
struct SlidingSums {
  double time = 0.0;           ///< sum over the steps of their length [s]
  double sliding = 0.0;        ///< … of the sliding distance [m]
  double force_sliding = 0.0;  ///< … of F_n s [J]
  double shear_work = 0.0;     ///< [J]

  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("time", self.time)("sliding", self.sliding);
    archive("force_sliding", self.force_sliding)("shear_work", self.shear_work);
  }
};

/// Impacts together. Angles and diameters are weighted by m v^2: many a small bounce does not hide a blow.
struct ImpactSums {
  std::uint64_t count = 0;
  double mass = 0.0;      ///< [kg]
  double mv2 = 0.0;       ///< sum of m v^2 [J]
  double angle = 0.0;     ///< sum of m v^2 a [J rad]
  double diameter = 0.0;  ///< sum of m v^2 D [J m]

  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("count", self.count)("mass", self.mass)("mv2", self.mv2);
    archive("angle", self.angle)("diameter", self.diameter);
  }
  void add(const Impact& impact) noexcept {
    const double weight = impact.mass * impact.speed * impact.speed;
    ++count;
    mass += impact.mass;
    mv2 += weight;
    angle += weight * impact.angle;
    diameter += weight * impact.diameter;
  }
  ImpactSums& operator+=(const ImpactSums& other) noexcept {
    count += other.count;
    mass += other.mass;
    mv2 += other.mv2;
    angle += other.angle;
    diameter += other.diameter;
    return *this;
  }
  [[nodiscard]] double energy() const noexcept { return 0.5 * mv2; }
  /// The impact that all of them together stand for, of the same energy; there must be some.
  [[nodiscard]] Impact mean() const noexcept {
    return {std::sqrt(mv2 / mass), angle / mv2, mass, diameter / mv2};
  }
};

/// Classes of angles: as those of ImpactSpectrum.
[[nodiscard]] std::uint16_t angle_class(double angle) noexcept;

/// Force, speed and angle in one region of a wall.
struct Spectra {
  SparseBins<SlidingSums> sliding;  ///< key: class of the force << 16 | class of the speed
  SparseBins<ImpactSums> impacts;   ///< key: class of the angle << 32 | of the speed << 16 | of the diameter

  [[nodiscard]] static std::uint64_t sliding_key(double force, double speed) noexcept {
    return std::uint64_t{eighth_octave(force)} << 16 | eighth_octave(speed);
  }
  [[nodiscard]] static std::uint64_t impact_key(const Impact& impact) noexcept {
    return std::uint64_t{angle_class(impact.angle)} << 32 | std::uint64_t{eighth_octave(impact.speed)} << 16 |
           eighth_octave(impact.diameter);
  }

  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("sliding", self.sliding)("impacts", self.impacts);
  }
};

/// What one contact does in one step, as the map books it.
struct MapSample {
  WorkSample work;
  ContactLoad load;         ///< its weight: forces and work have it already
  double hertz_area = 0.0;  ///< of the circle that Hertz's contact of its force has [m^2]
  bool strikes = false;     ///< its impact falls on the wall in this step
  Impact impact;
  MechanismVolumes volumes{};  ///< of this step [m^3]
};

/// The map of one wall.
class WearMap {
 public:
  /// What one element has suffered so far. Sums over contacts and steps, each times the share of the contact
  /// that falls on the element (docs/theory/wear.md#footprint); the shares of a contact add up to one.
  struct Element {
    double force_sliding = 0.0;                        ///< F_n s: what Archard's coefficient multiplies [J]
    double shear_work = 0.0;                           ///< of friction [J]
    double normal_work = 0.0;                          ///< lost to the normal damper [J]
    double sliding = 0.0;                              ///< s [m]
    double finnie = 0.0, oka = 0.0, expression = 0.0;  ///< worn by these laws [m^3]
    double peak_pressure = 0.0;  ///< largest of F_n share / min(area of the element, Hertz's circle) [Pa]
    ImpactSums impacts;          ///< by their shares; counted: those whose largest fell here

    template <typename Self, typename Archive>
    static void visit(Self& self, Archive& archive) {
      archive("force_sliding", self.force_sliding)("shear_work", self.shear_work);
      archive("normal_work", self.normal_work)("sliding", self.sliding)("finnie", self.finnie);
      archive("oka", self.oka)("expression", self.expression);
      archive("peak_pressure", self.peak_pressure)("impacts", self.impacts);
    }
    Element& operator+=(const Element& other) noexcept;
    [[nodiscard]] bool touched() const noexcept {
      return peak_pressure > 0.0 || normal_work > 0.0 || sliding > 0.0;
    }
  };

  /// What one material does to the wall.
  struct Layer {
    int abrader = 0;
    std::vector<Element> elements;
    std::vector<Spectra> regions;

    /// Asks the memory for the class of a contact that slides; of several regions for none.
    void fetch(const MapSample& sample) const noexcept {
      if (regions.size() == 1)
        regions.front().sliding.fetch(
            Spectra::sliding_key(sample.work.contact.F_n / sample.load.weight, sample.load.v_t));
    }
    /// Asks the memory for an element.
    void fetch(std::size_t element) const noexcept {
      core::prefetch<true>(&elements[element], sizeof(Element));
    }

    template <typename Self, typename Archive>
    static void visit(Self& self, Archive& archive) {
      archive.fixed("elements", self.elements);
      for (auto& region : self.regions) archive("region", region);
    }
  };

  /// @param abraders materials that may wear the wall   @param region_of each element   @param regions how
  /// many
  WearMap(std::size_t elements, std::span<const int> abraders, std::vector<std::uint16_t> region_of,
          std::size_t regions);

  /// Of this material; nothing where it does not wear the wall.
  [[nodiscard]] Layer* layer(int abrader) noexcept;
  [[nodiscard]] const std::vector<Layer>& layers() const noexcept { return layers_; }
  [[nodiscard]] std::uint16_t region_of(std::size_t element) const noexcept { return region_of_[element]; }
  /// All materials together.
  [[nodiscard]] Element total(std::size_t element) const noexcept;
  [[nodiscard]] std::size_t element_count() const noexcept { return region_of_.size(); }

  /// Books one contact of one step.
  class Booking {
   public:
    Booking(WearMap& map, Layer& layer, const MapSample& sample) noexcept
        : map_(map), layer_(layer), s_(sample) {}
    /// @param share of the contact that falls on the element   @param area of the element [m^2]
    void add(std::size_t element, double share, double area) noexcept;
    /// What belongs to the contact as a whole goes where most of it fell.
    void finish();

   private:
    WearMap& map_;
    Layer& layer_;
    const MapSample& s_;
    std::size_t largest_ = 0;
    double largest_share_ = 0.0;
  };

  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    for (auto& layer : self.layers_) archive("layer", layer);
  }

 private:
  std::vector<Layer> layers_;
  std::vector<std::uint16_t> region_of_;
};

/// Volume that the laws took from an element [m^3]: those by work from its sums, the others as booked.
[[nodiscard]] MechanismVolumes mapped_volumes(const Laws& laws, const WearMap::Element& element) noexcept;

}  // namespace abradem::wear
