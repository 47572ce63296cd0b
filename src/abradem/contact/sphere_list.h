// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "abradem/contact/sphere_rows.h"

namespace abradem::contact {

/// Pairs of spheres nearer than a skin, and what their contacts remember (Verlet list, CSR).
///
/// Pair k belongs to the lower of its two spheres, `owner[k]`; the other is `partner[k]`. Rows ascend. The
/// list holds while no sphere has moved by more than half the skin since it was made.
///
/// Spheres are worked through in blocks of kBlock. What a block's contacts do to spheres of later blocks
/// ("far" pairs) is kept in rows of its own and added afterwards in the order of pairs, so that sums have one
/// order for any number of threads.
class SphereList {
 public:
  static constexpr std::size_t kBlock = 1024;

  /// Sorts the spheres along a Morton curve, takes out those with id < 0, finds the pairs within `skin` and
  /// carries the springs over. O(n).
  void rebuild(Spheres& spheres, double skin);
  /// Contacts are to remember torques too, from the next rebuild on.
  void remember_torques() noexcept { torques_ = true; }

  /// The pairs and what they remember, for core/archive.h; restore() follows a load.
  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("start", self.start)("partner", self.partner)("touching", self.touching)("spring", self.spring);
    archive("torque", self.torque);
    archive("rebuilds", self.rebuilds_);
  }
  /// Makes what follows from the pairs.   @return whether these can be pairs of so many spheres
  [[nodiscard]] bool restore(std::size_t spheres);

  [[nodiscard]] std::size_t size() const noexcept { return count_; }
  [[nodiscard]] std::size_t blocks() const noexcept { return (count_ + kBlock - 1) / kBlock; }
  [[nodiscard]] std::size_t pairs() const noexcept { return partner.size(); }
  [[nodiscard]] std::uint64_t rebuilds() const noexcept { return rebuilds_; }

  std::vector<std::int32_t> start;           ///< first pair of each sphere; one more than spheres
  std::vector<std::int32_t> owner, partner;  ///< of each pair
  std::vector<std::uint8_t> touching;        ///< of each pair, at the last step
  std::vector<SpringRow> spring;             ///< of each pair; zero where it does not touch
  std::vector<SpringRow> torque;             ///< likewise, where remembered; else empty
  std::vector<std::int32_t> far;  ///< of each pair whose partner is in a later block: its row in far_load
  std::vector<LoadRow> far_load;  ///< what far pairs do to their partners, partner by partner
  std::vector<std::int32_t> far_target;  ///< spheres that far pairs act on, ascending
  std::vector<std::int32_t> far_start;   ///< first row of far_load of each; one more than targets

 private:
  void sort_along_curve(Spheres& spheres, double cell);
  void find_pairs(const Spheres& spheres, double skin);
  void carry_springs(const SphereList& before);
  void name_owners();
  void link_far_pairs();

  bool torques_ = false;
  std::size_t count_ = 0;
  std::uint64_t rebuilds_ = 0;
  // The grid that the spheres were sorted by.
  Vec3 origin_;
  double cell_ = 1.0;
  std::int32_t nx_ = 1, ny_ = 1, nz_ = 1;
  std::vector<std::int32_t> cell_begin_, cell_end_;
  std::vector<std::int32_t> was_;  // index of each sphere in the order before; at least `before` spheres: new
};

}  // namespace abradem::contact
