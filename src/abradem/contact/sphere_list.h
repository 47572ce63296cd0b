// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "abradem/contact/sphere_rows.h"

namespace abradem::contact {

/// The contacts of one block of spheres, and pairs so near that they may soon be some: i < j, i of this
/// block, ascending by (i, j). The columns go on to a multiple of eight with copies of the last pair.
struct ContactBlock {
  std::size_t count = 0;
  std::vector<std::int32_t> first;            ///< first pair of each sphere of the block; one more than these
  std::vector<std::int32_t> i, j;             ///< the spheres
  std::vector<std::int32_t> row;              ///< of the loads, that acts on j: j, or one beyond all spheres
  std::vector<std::uint8_t> touching, image;  ///< at the last step; which of the shifts, if any
  std::vector<double> sx, sy, sz;             ///< tangential spring of i [m]; zero where it does not touch
  std::vector<SpringRow> torque;              ///< what else is remembered, or empty

  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("first", self.first)("i", self.i)("j", self.j)("touching", self.touching);
    archive("sx", self.sx)("sy", self.sy)("sz", self.sz)("torque", self.torque);
  }
  static constexpr std::size_t padded(std::size_t pairs) noexcept { return (pairs + 7) / 8 * 8; }
  /// Room for so many pairs and some more.
  void resize(std::size_t pairs, bool torques, bool periodic);
  /// What the pair of spheres `low` and `high` remembered in the blocks of the order before, for pair k.
  void remember(std::size_t k, const std::vector<ContactBlock>& before, std::int32_t low, std::int32_t high,
                double sign);
  /// A copy no longer than it need be.
  void take(const ContactBlock& from);
  /// Forgets the pairs that do not touch, and of the others all but what remember() asks for.
  void keep_touching();
  /// Fills up the columns of who touches whom.
  void repeat_last();
  /// The spring of pair k [m].
  [[nodiscard]] Vec3 spring(std::size_t k) const noexcept { return {sx[k], sy[k], sz[k]}; }
};

/// Pairs of spheres nearer than a skin (Verlet list, CSR), and among them those nearer than a margin, which
/// are looked at in every step.
///
/// A pair belongs to the lower of its two spheres. The pairs within the skin hold while no sphere has moved
/// by more than half of it since they were found, those within the margin likewise.
///
/// Spheres are worked through in blocks of kBlock. What a block's contacts do to spheres of later blocks, its
/// guests, is summed in rows of its own behind those of the spheres and added afterwards block by block, so
/// that sums have one order for any number of threads. They do not depend on the margin.
class SphereList {
 public:
  static constexpr std::size_t kBlock = 1024;

  /// Sorts the spheres along a Morton curve, takes out those with id < 0, finds the pairs within `skin` and
  /// within `margin`, and carries the springs over. O(n).
  void rebuild(Spheres& spheres, double skin, double margin);
  void rebuild(Spheres& spheres, double skin) { rebuild(spheres, skin, skin); }
  /// Finds the pairs within `margin` among those within the skin.
  void find_near(const Spheres& spheres, double margin);
  /// Space repeats itself: what is at x is also at x + period, along the axes whose period is not zero. The
  /// rebuild brings spheres back into [low, low + period). Periods are at least three times 2 R + skin.
  void make_periodic(const Vec3& low, const Vec3& period);
  /// Contacts are to remember torques too, from the next rebuild on.
  void remember_torques() noexcept { torques_ = true; }

  /// Calls body(block, k) for every pair k within the margin.
  template <typename Body>
  void for_each_near(Body&& body) const {
    for (const ContactBlock& block : near)
      for (std::size_t k = 0; k < block.count; ++k) body(block, k);
  }
  /// Where j is seen from i: add this to x_i - x_j [m].
  [[nodiscard]] Vec3 shift(const ContactBlock& block, std::size_t k) const noexcept {
    if (block.image.empty()) return {};
    const SpringRow& s = shifts[block.image[k]];
    return {s.x, s.y, s.z};
  }

  /// The pairs and what they remember, for core/archive.h; restore() follows a load.
  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("start", self.start)("partner", self.partner)("near", self.near);
    archive("rebuilds", self.rebuilds_);
  }
  /// Makes what follows from the pairs.   @return whether these can be pairs of these spheres
  [[nodiscard]] bool restore(const Spheres& spheres);

  [[nodiscard]] std::size_t size() const noexcept { return count_; }
  [[nodiscard]] std::size_t blocks() const noexcept { return (count_ + kBlock - 1) / kBlock; }
  [[nodiscard]] std::size_t pairs() const noexcept { return partner.size(); }
  /// Are all spheres of one material?
  [[nodiscard]] bool one_material() const noexcept { return one_material_; }
  /// Rows of loads: one for each sphere, and then those of the guests.
  [[nodiscard]] std::size_t load_rows() const noexcept { return count_ + guest.size(); }
  [[nodiscard]] std::uint64_t rebuilds() const noexcept { return rebuilds_; }

  /// A run of guests of one block that are spheres of one other.
  struct Visit {
    std::int32_t block;       ///< that they are guests of
    std::int32_t begin, end;  ///< in `guest`
  };

  std::vector<std::int32_t> start;           ///< first pair of each sphere; one more than spheres
  std::vector<std::int32_t> partner;         ///< of each pair within the skin; rows ascend
  std::vector<ContactBlock> near;            ///< of each block, the pairs within the margin
  std::vector<std::int32_t> guest;           ///< guests of all blocks, block by block, ascending
  std::vector<std::int32_t> guest_start;     ///< first guest of each block; one more than blocks
  std::vector<std::vector<Visit>> visitors;  ///< of each block, its spheres as guests of earlier blocks
  std::array<SpringRow, 27> shifts{};

 private:
  void sort_along_curve(Spheres& spheres, double cell);
  void find_pairs(const Spheres& spheres, double skin);
  void find_guests();
  void fill_near(const Spheres& spheres, double margin, const std::vector<ContactBlock>& before,
                 bool same_order);
  [[nodiscard]] bool restore_block(const Spheres& spheres, std::size_t block);
  [[nodiscard]] std::uint8_t image_of(const Vec3& apart) const noexcept;

  [[nodiscard]] static bool all_of_one_material(const Spheres& spheres) noexcept;

  bool torques_ = false, one_material_ = false;
  std::size_t count_ = 0;
  std::uint64_t rebuilds_ = 0;
  // The grid that the spheres were sorted by.
  Vec3 origin_;
  Vec3 cell_{1.0, 1.0, 1.0};
  std::int32_t nx_ = 1, ny_ = 1, nz_ = 1;
  Vec3 low_, period_;  // 0: open
  std::vector<std::int32_t> cell_begin_, cell_end_;
  std::vector<std::int32_t> was_;  // index of each sphere in the order before; beyond those: new
};

}  // namespace abradem::contact
