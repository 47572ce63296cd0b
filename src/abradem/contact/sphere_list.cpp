// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/contact/sphere_list.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "abradem/core/parallel.h"
#include "abradem/core/periodic.h"

namespace abradem::contact {

namespace {

std::size_t at(std::int32_t i) noexcept { return static_cast<std::size_t>(i); }

struct KeyedIndex {
  std::uint32_t key, index;
};

/// The low ten bits of x, two zeros between each.
std::uint32_t spread_bits(std::uint32_t x) noexcept {
  x = (x | (x << 16)) & 0x030000ffU;
  x = (x | (x << 8)) & 0x0300f00fU;
  x = (x | (x << 4)) & 0x030c30c3U;
  return (x | (x << 2)) & 0x09249249U;
}

/// Stable sort by a 30-bit key, ten bits at a time.
void radix_sort(std::vector<KeyedIndex>& items) {
  std::vector<KeyedIndex> sorted(items.size());
  for (int shift = 0; shift < 30; shift += 10) {
    std::array<std::uint32_t, 1025> first{};
    for (const KeyedIndex& item : items) ++first[((item.key >> shift) & 1023U) + 1];
    for (std::size_t d = 1; d < first.size(); ++d) first[d] += first[d - 1];
    for (const KeyedIndex& item : items) sorted[first[(item.key >> shift) & 1023U]++] = item;
    items.swap(sorted);
  }
}

/// Brings the sphere at order[i].index to place i, for every i, in place: a second copy of a million of them
/// would be a fifth of all memory. Spoils the indices.
void reorder(Spheres& spheres, std::vector<KeyedIndex>& order) {
  constexpr auto kDone = std::numeric_limits<std::uint32_t>::max();
  const bool clumps = !spheres.clump.empty();
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (order[i].index == kDone) continue;
    const SphereRow row = spheres.row[i];
    const std::int32_t id = spheres.id[i], clump = clumps ? spheres.clump[i] : 0;
    std::size_t to = i;
    for (;;) {  // along the cycle that i belongs to
      const std::size_t from = std::exchange(order[to].index, kDone);
      if (from == i) break;
      spheres.row[to] = spheres.row[from];
      spheres.id[to] = spheres.id[from];
      if (clumps) spheres.clump[to] = spheres.clump[from];
      to = from;
    }
    spheres.row[to] = row;
    spheres.id[to] = id;
    if (clumps) spheres.clump[to] = clump;
  }
}

/// Closes the gaps of those that are to be taken out. @return where each that stays has been
std::vector<std::int32_t> close_gaps(Spheres& spheres) {
  std::vector<std::int32_t> was;
  was.reserve(spheres.size());
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    if (spheres.id[i] < 0) continue;
    const std::size_t to = was.size();
    was.push_back(static_cast<std::int32_t>(i));
    if (to == i) continue;
    spheres.row[to] = spheres.row[i];
    spheres.id[to] = spheres.id[i];
    if (!spheres.clump.empty()) spheres.clump[to] = spheres.clump[i];
  }
  spheres.row.resize(was.size());
  spheres.id.resize(was.size());
  if (!spheres.clump.empty()) spheres.clump.resize(was.size());
  return was;
}

}  // namespace

void SphereList::rebuild(Spheres& spheres, double skin, double margin) {
  double largest = 0.0;
  for (const SphereRow& s : spheres.row) largest = std::max(largest, s.radius);
  // Of the lists before, only what touches is needed, so that two of them do not stand side by side.
  std::vector<ContactBlock> before = std::move(near);
  core::parallel_blocks(before.size(), [&](std::size_t b) { before[b].keep_touching(); });
  std::vector<std::int32_t>().swap(partner);
  sort_along_curve(spheres, 2.0 * largest + skin);
  count_ = spheres.size();
  one_material_ = all_of_one_material(spheres);
  find_pairs(spheres, skin);
  find_guests();
  fill_near(spheres, margin, before, false);
  ++rebuilds_;
}

bool SphereList::all_of_one_material(const Spheres& spheres) noexcept {
  return std::ranges::all_of(spheres.row,
                             [&](const SphereRow& s) { return s.material == spheres.row.front().material; });
}

void SphereList::find_near(const Spheres& spheres, double margin) { fill_near(spheres, margin, near, true); }

void SphereList::make_periodic(const Vec3& low, const Vec3& period) {
  low_ = low;
  period_ = period;
  for (std::size_t k = 0; k < shifts.size(); ++k) {
    const auto steps = [&](std::size_t by) { return static_cast<double>(k / by % 3) - 1.0; };
    shifts[k] = {steps(1) * period.x, steps(3) * period.y, steps(9) * period.z, 0.0};
  }
}

std::uint8_t SphereList::image_of(const Vec3& apart) const noexcept {
  const auto steps = [](double d, double period) {  // to the nearest image
    return period > 0.0 && d < -0.5 * period ? 2 : period > 0.0 && d > 0.5 * period ? 0 : 1;
  };
  return static_cast<std::uint8_t>(steps(apart.x, period_.x) + 3 * steps(apart.y, period_.y) +
                                   9 * steps(apart.z, period_.z));
}

void SphereList::sort_along_curve(Spheres& spheres, double cell) {
  if (period_ != Vec3{})
    for (SphereRow& s : spheres.row) s.set_position(wrapped(s.position(), low_, period_));
  const std::vector<std::int32_t> was = close_gaps(spheres);
  constexpr double kInf = std::numeric_limits<double>::infinity();
  Vec3 low{kInf, kInf, kInf}, high = -low;
  std::vector<KeyedIndex> order(spheres.size());
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const SphereRow& s = spheres.row[i];
    low = {std::min(low.x, s.x), std::min(low.y, s.y), std::min(low.z, s.z)};
    high = {std::max(high.x, s.x), std::max(high.y, s.y), std::max(high.z, s.z)};
    order[i].index = static_cast<std::uint32_t>(i);
  }
  if (order.empty()) low = high = {};
  // No more cells than some per sphere, however far one has strayed, and no more than the key can hold.
  const double budget = 8.0 * static_cast<double>(order.size()) + 4096.0;
  const Vec3 extent = high - low;
  const auto cells = [&](double length, double period) {  // a period holds a whole number of them
    return period > 0.0 ? std::max(3.0, std::floor(period / cell)) : std::floor(length / cell) + 1.0;
  };
  double count[3];
  for (;; cell *= 1.26) {
    count[0] = cells(extent.x, period_.x), count[1] = cells(extent.y, period_.y),
    count[2] = cells(extent.z, period_.z);
    const double most = std::max({count[0], count[1], count[2]});
    if (!(count[0] * count[1] * count[2] > budget || most > 1024.0) || most <= 3.0) break;
  }
  const auto origin = [](double lowest, double of_box, double period) {
    return period > 0.0 ? of_box : lowest;
  };
  const auto width = [&](double period, double n) { return period > 0.0 ? period / n : cell; };
  origin_ = {origin(low.x, low_.x, period_.x), origin(low.y, low_.y, period_.y),
             origin(low.z, low_.z, period_.z)};
  cell_ = {width(period_.x, count[0]), width(period_.y, count[1]), width(period_.z, count[2])};
  nx_ = static_cast<std::int32_t>(count[0]);
  ny_ = static_cast<std::int32_t>(count[1]);
  nz_ = static_cast<std::int32_t>(count[2]);

  const auto cell_of = [&](const SphereRow& s) {
    const auto along = [](double way, double wide, std::int32_t n) {
      return std::min(static_cast<std::uint32_t>(way / wide), static_cast<std::uint32_t>(n - 1));
    };
    return std::array{along(s.x - origin_.x, cell_.x, nx_), along(s.y - origin_.y, cell_.y, ny_),
                      along(s.z - origin_.z, cell_.z, nz_)};
  };
  core::parallel_for(
      order.size(),
      [&](std::size_t i) {
        const auto c = cell_of(spheres.row[i]);
        order[i].key = spread_bits(c[0]) | (spread_bits(c[1]) << 1) | (spread_bits(c[2]) << 2);
      },
      kBlock);
  radix_sort(order);

  was_.resize(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) was_[i] = was[order[i].index];
  reorder(spheres, order);

  const std::size_t total = at(nx_) * at(ny_) * at(nz_);
  cell_begin_.assign(total, 0);
  cell_end_.assign(total, 0);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool first = i == 0 || order[i].key != order[i - 1].key;
    const bool last = i + 1 == order.size() || order[i].key != order[i + 1].key;
    if (!first && !last) continue;
    const auto c = cell_of(spheres.row[i]);
    const std::size_t cell_number = (c[2] * at(ny_) + c[1]) * at(nx_) + c[0];
    if (first) cell_begin_[cell_number] = static_cast<std::int32_t>(i);
    if (last) cell_end_[cell_number] = static_cast<std::int32_t>(i) + 1;
  }
}

void SphereList::find_pairs(const Spheres& spheres, double skin) {
  start.assign(count_ + 1, 0);
  std::vector<std::vector<std::int32_t>> found(blocks());
  core::parallel_blocks(blocks(), [&](std::size_t b) {
    std::vector<std::int32_t>& list = found[b];
    list.reserve(6 * kBlock);
    const std::size_t end = std::min(count_, (b + 1) * kBlock);
    for (std::size_t i = b * kBlock; i < end; ++i) {
      const SphereRow& s = spheres.row[i];
      const auto cell = [](double way, double wide, std::int32_t n) {
        return std::min(static_cast<std::int32_t>(way / wide), n - 1);
      };
      const std::int32_t cx = cell(s.x - origin_.x, cell_.x, nx_), cy = cell(s.y - origin_.y, cell_.y, ny_),
                         cz = cell(s.z - origin_.z, cell_.z, nz_);
      const std::size_t row = list.size();
      const double reach = s.radius + skin;
      const std::int32_t clump = spheres.clump.empty() ? -1 : spheres.clump[i];
      // One cell further than the last is, where space is periodic, the first one's image.
      const auto first = [](std::int32_t c, double period) {
        return period > 0.0 ? c - 1 : std::max(c - 1, 0);
      };
      const auto past = [](std::int32_t c, std::int32_t n, double period) {
        return period > 0.0 ? c + 1 : std::min(c + 1, n - 1);
      };
      const auto image_of = [](std::int32_t& c, std::int32_t n, double period) {
        const double away = c < 0 ? period : c >= n ? -period : 0.0;
        c += c < 0 ? n : c >= n ? -n : 0;
        return away;
      };
      for (std::int32_t iz = first(cz, period_.z); iz <= past(cz, nz_, period_.z); ++iz)
        for (std::int32_t iy = first(cy, period_.y); iy <= past(cy, ny_, period_.y); ++iy)
          for (std::int32_t ix = first(cx, period_.x); ix <= past(cx, nx_, period_.x); ++ix) {
            std::int32_t x = ix, y = iy, z = iz;
            const double sx = image_of(x, nx_, period_.x), sy = image_of(y, ny_, period_.y),
                         sz = image_of(z, nz_, period_.z);
            const std::size_t c = (at(z) * at(ny_) + at(y)) * at(nx_) + at(x);
            const std::int32_t last = cell_end_[c];
            for (std::int32_t j = std::max(cell_begin_[c], static_cast<std::int32_t>(i) + 1); j < last; ++j) {
              const SphereRow& o = spheres.row[at(j)];
              const double dx = s.x - o.x + sx, dy = s.y - o.y + sy, dz = s.z - o.z + sz,
                           r = reach + o.radius;
              if (dx * dx + dy * dy + dz * dz < r * r && (clump < 0 || spheres.clump[at(j)] != clump))
                list.push_back(j);
            }
          }
      std::sort(list.begin() + static_cast<std::ptrdiff_t>(row), list.end());
      start[i + 1] = static_cast<std::int32_t>(list.size() - row);
    }
  });
  for (std::size_t i = 0; i < count_; ++i) start[i + 1] += start[i];
  const std::size_t total = at(start[count_]);
  partner.resize(total);
  core::parallel_blocks(blocks(), [&](std::size_t b) {
    std::copy(found[b].begin(), found[b].end(), partner.begin() + start[b * kBlock]);
  });
}

void SphereList::find_guests() {
  std::vector<std::vector<std::int32_t>> found(blocks());
  core::parallel_blocks(blocks(), [&](std::size_t b) {
    const std::size_t begin = b * kBlock, end = std::min(count_, begin + kBlock);
    for (auto k = at(start[begin]); k < at(start[end]); ++k)
      if (at(partner[k]) >= end) found[b].push_back(partner[k]);
    std::ranges::sort(found[b]);
    const auto rest = std::ranges::unique(found[b]);
    found[b].erase(rest.begin(), rest.end());
  });
  guest.clear();
  guest_start.assign(1, 0);
  visitors.assign(blocks(), {});
  for (const std::vector<std::int32_t>& of_block : found) {
    for (const std::int32_t g : of_block) {
      const auto here = static_cast<std::int32_t>(guest.size());
      std::vector<Visit>& visits = visitors[at(g) / kBlock];
      const bool goes_on = !visits.empty() && visits.back().end == here && here > guest_start.back();
      if (!goes_on) visits.push_back({static_cast<std::int32_t>(guest_start.size()) - 1, here, here});
      ++visits.back().end;
      guest.push_back(g);
    }
    guest_start.push_back(static_cast<std::int32_t>(guest.size()));
  }
}

/// A contact that stays is looked up in the row of the sphere that owned it; where the two have changed
/// places in the order, its spring belongs to the other one and points the other way.
void SphereList::fill_near(const Spheres& spheres, double margin, const std::vector<ContactBlock>& before,
                           bool same_order) {
  const bool periodic = period_ != Vec3{};
  near.resize(blocks());
  core::parallel_blocks(blocks(), [&](std::size_t b) {
    static thread_local ContactBlock fresh;
    static thread_local std::vector<std::int32_t> row_of;  // of the loads, of each guest
    const std::size_t begin = b * kBlock, end = std::min(count_, begin + kBlock);
    if (row_of.size() < count_) row_of.resize(count_);
    for (auto g = guest_start[b]; g < guest_start[b + 1]; ++g)
      row_of[at(guest[at(g)])] = static_cast<std::int32_t>(count_) + g;
    const std::size_t most = at(start[end] - start[begin]);
    fresh.resize(most, torques_, periodic);
    fresh.first.assign(1, 0);
    std::size_t count = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const SphereRow& s = spheres.row[i];
      for (auto k = at(start[i]); k < at(start[i + 1]); ++k) {
        const std::int32_t j = partner[k];
        const SphereRow& o = spheres.row[at(j)];
        Vec3 apart = s.position() - o.position();
        if (periodic) {
          fresh.image[count] = image_of(apart);
          apart += shift(fresh, count);
        }
        const double reach = s.radius + o.radius + margin;
        fresh.i[count] = static_cast<std::int32_t>(i);
        fresh.j[count] = j;
        count += norm2(apart) < reach * reach;
      }
      fresh.first.push_back(static_cast<std::int32_t>(count));
    }
    fresh.count = count;
    for (std::size_t k = 0; k < count; ++k) {
      const std::int32_t i = fresh.i[k], j = fresh.j[k];
      fresh.row[k] = at(j) < end ? j : row_of[at(j)];
      const std::int32_t was_i = same_order ? i : was_[at(i)], was_j = same_order ? j : was_[at(j)];
      fresh.remember(k, before, std::min(was_i, was_j), std::max(was_i, was_j), was_i < was_j ? 1.0 : -1.0);
    }
    near[b].take(fresh);
  });
}

bool SphereList::restore(const Spheres& spheres) {
  const auto pairs_at_end = static_cast<std::int32_t>(partner.size());
  if (start.size() != spheres.size() + 1 || start.front() != 0 || start.back() != pairs_at_end ||
      !std::ranges::is_sorted(start))
    return false;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    auto last = static_cast<std::int32_t>(i);  // partners come later, in ascending order
    for (auto k = at(start[i]); k < at(start[i + 1]); last = partner[k++])
      if (partner[k] <= last || at(partner[k]) >= spheres.size()) return false;
  }
  count_ = spheres.size();
  one_material_ = all_of_one_material(spheres);
  if (near.size() != blocks()) return false;
  find_guests();
  for (std::size_t b = 0; b < blocks(); ++b)
    if (!restore_block(spheres, b)) return false;
  return true;
}

/// Pairs of a block are some of those within the skin; what follows from them is made anew.
bool SphereList::restore_block(const Spheres& spheres, std::size_t b) {
  ContactBlock& block = near[b];
  const std::size_t begin = b * kBlock, end = std::min(count_, begin + kBlock);
  if (block.first.size() != end - begin + 1 || block.first.front() != 0 ||
      !std::ranges::is_sorted(block.first))
    return false;
  block.count = at(block.first.back());
  const std::size_t padded = ContactBlock::padded(block.count);
  if (block.torque.size() != (torques_ ? padded : 0)) return false;
  for (const std::size_t size : {block.i.size(), block.j.size(), block.touching.size(), block.sx.size(),
                                 block.sy.size(), block.sz.size()})
    if (size != padded) return false;
  block.row.resize(padded);
  block.image.resize(period_ != Vec3{} ? padded : 0);
  for (std::size_t i = begin; i < end; ++i) {
    auto k = at(start[i]);
    for (auto c = at(block.first[i - begin]); c < at(block.first[i - begin + 1]); ++c, ++k) {
      while (k < at(start[i + 1]) && partner[k] != block.j[c]) ++k;
      if (k == at(start[i + 1]) || at(block.i[c]) != i || block.touching[c] > 1) return false;
      const std::int32_t j = block.j[c];
      const auto guests = guest.begin() + guest_start[b], guests_end = guest.begin() + guest_start[b + 1];
      const auto place = std::lower_bound(guests, guests_end, j) - guest.begin();
      block.row[c] = at(j) < end ? j : static_cast<std::int32_t>(count_ + static_cast<std::size_t>(place));
      if (!block.image.empty())
        block.image[c] = image_of(spheres.row[i].position() - spheres.row[at(j)].position());
    }
  }
  block.repeat_last();
  return true;
}

void ContactBlock::resize(std::size_t pairs, bool torques, bool periodic) {
  const std::size_t size = padded(pairs) + 8;
  for (std::vector<std::int32_t>* column : {&i, &j, &row}) column->resize(size);
  for (std::vector<double>* column : {&sx, &sy, &sz}) column->resize(size);
  touching.resize(size);
  image.resize(periodic ? size : 0);
  torque.resize(torques ? size : 0);
}

void ContactBlock::remember(std::size_t k, const std::vector<ContactBlock>& before, std::int32_t low,
                            std::int32_t high, double sign) {
  touching[k] = 0;
  sx[k] = sy[k] = sz[k] = 0.0;
  if (!torque.empty()) torque[k] = {};
  const std::size_t b = at(low) / SphereList::kBlock, own = at(low) % SphereList::kBlock;
  if (b >= before.size() || own + 1 >= before[b].first.size()) return;
  const ContactBlock& old = before[b];
  auto o = at(old.first[own]);
  while (o < at(old.first[own + 1]) && old.j[o] < high) ++o;
  if (o == at(old.first[own + 1]) || old.j[o] != high || old.touching[o] == 0) return;
  touching[k] = 1;
  sx[k] = sign * old.sx[o], sy[k] = sign * old.sy[o], sz[k] = sign * old.sz[o];
  if (torque.empty() || old.torque.empty()) return;
  const SpringRow& t = old.torque[o];  // about the normal it is the same seen from either side
  torque[k] = {sign * t.x, sign * t.y, sign * t.z, t.twist};
}

void ContactBlock::keep_touching() {
  ContactBlock kept;
  const auto touches = static_cast<std::size_t>(std::ranges::count(touching, 1));
  kept.first.reserve(first.size()), kept.j.reserve(touches);
  kept.sx.reserve(touches), kept.sy.reserve(touches), kept.sz.reserve(touches);
  for (std::size_t s = 0, k = 0; s + 1 < first.size(); ++s) {
    kept.first.push_back(static_cast<std::int32_t>(kept.j.size()));
    for (; k < at(first[s + 1]); ++k) {
      if (touching[k] == 0) continue;
      kept.j.push_back(j[k]);
      kept.sx.push_back(sx[k]), kept.sy.push_back(sy[k]), kept.sz.push_back(sz[k]);
      if (!torque.empty()) kept.torque.push_back(torque[k]);
    }
  }
  kept.first.push_back(static_cast<std::int32_t>(kept.j.size()));
  kept.count = kept.j.size();
  kept.touching.assign(kept.count, 1);
  *this = std::move(kept);
}

void ContactBlock::take(const ContactBlock& from) {
  count = from.count;
  const auto copy = [](auto& to, const auto& column, std::size_t length) {
    to.assign(column.begin(), column.begin() + static_cast<std::ptrdiff_t>(std::min(length, column.size())));
  };
  copy(first, from.first, from.first.size());
  const std::size_t size = padded(count);
  copy(i, from.i, size), copy(j, from.j, size), copy(row, from.row, size);
  copy(touching, from.touching, size), copy(image, from.image, size);
  copy(sx, from.sx, size), copy(sy, from.sy, size), copy(sz, from.sz, size);
  copy(torque, from.torque, size);
  for (std::size_t k = count; k < size; ++k) {
    touching[k] = 0, sx[k] = sy[k] = sz[k] = 0.0;
    if (!torque.empty()) torque[k] = {};
  }
  repeat_last();
}

void ContactBlock::repeat_last() {
  for (std::size_t k = count; k < padded(count); ++k) {
    i[k] = i[count - 1], j[k] = j[count - 1], row[k] = row[count - 1];
    if (!image.empty()) image[k] = image[count - 1];
  }
}

}  // namespace abradem::contact
