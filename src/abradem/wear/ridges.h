// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "abradem/contact/mesh_candidates.h"
#include "abradem/contact/tip_shape.h"
#include "abradem/wear/wearing_surface.h"

namespace abradem::wear {

/// How much of what leaves a groove is lost, and where the rest goes.
struct Ploughing {
  double removed_fraction = 1.0;  ///< f_ab of Zum Gahr: debris / volume that leaves the groove [-]
  double slope = 0.0;             ///< steepest flank that a ridge builds, rise over run [-]
  double ahead = 0.0;             ///< share of what is displaced that goes ahead of the contact [-]
};

/// A sphere that ploughs, in the frame of the candidates.
struct PloughingContact {
  Vec3 c;                ///< centre [m]
  double R = 0.0;        ///< [m]
  contact::Tip tip{};    ///< worn end, if any
  Vec3 n;                ///< of the contact, from the surface to the sphere
  Vec3 forward;          ///< direction in which the sphere slides over the surface
  Vec3 turning;          ///< curvature of its path over the surface [1/m]
  double deepest = 0.0;  ///< largest overlap in the contact [m]
  double d_e = 0.0;      ///< Hertz approach of its force [m]
  double cut = 0.0;      ///< area that this pass takes from the groove's section [m^2]

  /// For core/archive.h; the shape of the tip belongs to the sphere and is put back by whoever loads.
  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("c", self.c)("R", self.R)("tip_u", self.tip.u)("tip_v", self.tip.v)("tip_axis", self.tip.axis);
    archive("n", self.n)("forward", self.forward)("turning", self.turning)("deepest", self.deepest)("d_e",
                                                                                                    self.d_e);
    archive("cut", self.cut);
  }
};

/// Piles displaced material up beside a contact.                                 docs/theory/ploughing.md
///
/// Each side gets its half as a level fill: under a plane that descends outwards at the steepest slope, and
/// not into the sphere as it stands halfway through its sinking in this pass. What of the surface the pressed
/// part of the contact covers gets nothing. The fill's level follows from the volume, so the pile holds it
/// exactly.
class RidgeBuilder {
 public:
  /// @return volume that found no place: no surface beside the contact [m^3]
  double pile_up(WearingSurface& surface, const contact::SurfaceView& view, const PloughingContact& contact,
                 const Ploughing& ploughing, double volume);

  /// Half of the contact's length along the slide, at the last pile; 0 before [m].
  [[nodiscard]] double half_length() const noexcept { return half_length_; }

  /// What lasts from one pile to the next, for core/archive.h.
  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("margin", self.margin_)("half_length", self.half_length_);
  }

 private:
  struct Place {
    std::size_t node;  // of the candidates
    double outwards;   // distance from the contact's middle [m]
    double height;     // above the first surface [m]
    double room;       // below the sphere [m]
    double area;       // [m^2]
  };
  bool gather(const contact::SurfaceView& view, const PloughingContact& contact, double margin);
  void sort_places(const WearingSurface& surface, const PloughingContact& contact, double side);
  [[nodiscard]] static double capacity(const std::vector<Place>& places) noexcept;
  [[nodiscard]] double fill(WearingSurface& surface, const std::vector<Place>& places, double slope,
                            double volume);
  void book_elements(WearingSurface& surface);

  contact::MeshCandidates candidates_;
  std::vector<Place> left_, right_, ahead_;
  std::vector<double> piled_;  // at each candidate node [m^3]
  double margin_ = 0.0, half_length_ = 0.0;
};

}  // namespace abradem::wear
