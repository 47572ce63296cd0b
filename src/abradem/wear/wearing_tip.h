// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "abradem/contact/mesh_candidates.h"
#include "abradem/contact/tip_shape.h"
#include "abradem/wear/footprint.h"

namespace abradem::wear {

/// The worn end of a sphere that cannot spin: a map of its recession, and the volume that it has lost.
///
/// Wear arrives as the volume of a contact; the same pressure that shares out the wall's wear shares it among
/// the points of the map under the contact (`press_on`, then `wear`). Every point of the lattice owns its
/// square cell and loses cell^2 dr when its recession along the axis grows by dr, so that the map loses the
/// volume exactly. Where a contact has outgrown the map's fineness the map is once made twice as coarse,
/// which keeps its volume. docs/theory/pin-wear.md
class WearingTip {
 public:
  /// @param R radius of the sphere [m]   @param cell distance of the map's points at first [m]
  WearingTip(double R, double cell);

  [[nodiscard]] const contact::TipShape& shape() const noexcept { return shape_; }
  [[nodiscard]] double radius() const noexcept { return R_; }

  /// How a contact presses: its overlap field (excess of the tip as it is, or of the sphere as new where it
  /// is still that), the pressure's law, and which triangles belong to it.
  struct Contact {
    OverlapField field;
    contact::Tip frame;  ///< where the map's axes point in the frame of the candidates
    double d_e = 0.0;    ///< Hertz approach of its force [m]; 0: pressure by the overlap
    std::span<const char> mask{};
  };
  /// Finds how much of the pressure falls to each point of the map. Points that no triangle covers get none;
  /// where a contact is finer than the map, the point nearest to `deepest_at` gets all.
  /// @throws SimulationError where the contact reaches further from the axis than the map can show
  void press_on(const contact::MeshCandidates& candidates, const Contact& contact, const Vec3& deepest_at);
  /// The same on an analytic plane. @param height of the sphere's centre above it [m] @param n its normal
  void press_on_plane(const Contact& contact, double height, const Vec3& n, const Vec3& deepest_at);
  /// Area of the tip under the pressure last found [m^2].
  [[nodiscard]] double pressed_area() const noexcept { return pressed_area_; }

  /// Takes a volume off, shared out as last found [m^3].
  void wear(double volume);
  /// Is there a contact to wear by?
  [[nodiscard]] bool pressed() const noexcept { return !pressed_.empty(); }

  [[nodiscard]] double deposited_volume() const noexcept { return deposited_; }
  /// Volume that the map lacks, by its shape alone [m^3].
  [[nodiscard]] double removed_volume() const;
  /// Furthest that it stands back [m].
  [[nodiscard]] double deepest() const;
  /// Extent of what stands back by more than `level` along s and along t, through the map's middle [m].
  struct Extent {
    double along_s = 0.0, along_t = 0.0;
  };
  [[nodiscard]] Extent flat(double level) const;
  /// Coordinates of the k-th point of the map [m].
  [[nodiscard]] double s_of(std::size_t k) const noexcept;
  [[nodiscard]] double t_of(std::size_t k) const noexcept;
  /// Recession of the k-th point [m].
  [[nodiscard]] double recession_of(std::size_t k) const noexcept { return shape_.recession[k]; }

  /// The map, how the contact presses, and what was booked, for core/archive.h. restored() follows a load.
  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("cell", self.shape_.cell)("half", self.shape_.half)("recession", self.shape_.recession);
    archive("revision", self.shape_.revision)("pressed", self.pressed_)("span", self.span_);
    archive("total", self.total_)("pressed_area", self.pressed_area_);
    archive("deposited", self.deposited_)("lost", self.lost_);
  }
  /// @return whether what was loaded is a map
  [[nodiscard]] bool restored();

 private:
  struct Share {
    std::uint64_t point = 0;
    double weight = 0.0;  // pressure times area, of `total_`

    template <typename Self, typename Archive>
    static void visit(Self& self, Archive& archive) {
      archive("point", self.point)("weight", self.weight);
    }
  };
  template <typename Visit>
  void cover(const contact::MeshCandidates& candidates, const Contact& contact, std::size_t triangle,
             const Visit& visit) const;
  template <typename Collect>
  void gather(const Contact& contact, const Vec3& deepest_at, const Collect& collect);
  [[nodiscard]] static double pressure(const Contact& contact, double deepest, double g) noexcept;
  [[nodiscard]] static double least_overlap(const Contact& contact) noexcept;
  [[nodiscard]] double area(std::size_t k) const noexcept;
  void grow(int half);
  void coarsen();
  [[nodiscard]] std::size_t point(int i, int j) const noexcept {
    return static_cast<std::size_t>((j + shape_.half) * shape_.side() + i + shape_.half);
  }
  void set_grid(int half);

  double R_, coarsest_;
  contact::TipShape shape_;
  std::vector<double> pressure_;  // scratch: of each point of the map
  std::vector<Share> pressed_;
  int span_ = 0;  // points across the contact, at its widest
  double total_ = 0.0, pressed_area_ = 0.0, deposited_ = 0.0, lost_ = 0.0;
};

}  // namespace abradem::wear
