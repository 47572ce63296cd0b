// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/contact/sphere_list.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "abradem/core/parallel.h"

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

}  // namespace

void SphereList::rebuild(Spheres& spheres, double skin) {
  double largest = 0.0;
  for (const SphereRow& s : spheres.row) largest = std::max(largest, s.radius);
  SphereList before;
  before.start.swap(start);
  before.partner.swap(partner);
  before.touching.swap(touching);
  before.spring.swap(spring);
  before.torque.swap(torque);
  before.count_ = count_;
  sort_along_curve(spheres, 2.0 * largest + skin);
  count_ = spheres.size();
  find_pairs(spheres, skin);
  carry_springs(before);
  link_far_pairs();
  ++rebuilds_;
}

void SphereList::make_periodic(const Vec3& low, const Vec3& period) {
  low_ = low;
  period_ = period;
  for (std::size_t k = 0; k < shifts.size(); ++k) {
    const auto steps = [&](std::size_t by) { return static_cast<double>(k / by % 3) - 1.0; };
    shifts[k] = {steps(1) * period.x, steps(3) * period.y, steps(9) * period.z, 0.0};
  }
}

void SphereList::name_images(const Spheres& spheres) {
  image.clear();
  if (period_ == Vec3{}) return;
  image.resize(pairs());
  const auto steps = [](double d, double period) {  // to the nearest image
    return period > 0.0 && d < -0.5 * period ? 2 : period > 0.0 && d > 0.5 * period ? 0 : 1;
  };
  core::parallel_for(
      pairs(),
      [&](std::size_t k) {
        const Vec3 d = spheres.row[at(owner[k])].position() - spheres.row[at(partner[k])].position();
        image[k] = static_cast<std::uint8_t>(steps(d.x, period_.x) + 3 * steps(d.y, period_.y) +
                                             9 * steps(d.z, period_.z));
      },
      kBlock);
}

void SphereList::sort_along_curve(Spheres& spheres, double cell) {
  const auto wrap = [](double& x, double low, double period) {
    if (!(period > 0.0)) return;
    x -= period * std::floor((x - low) / period);
    if (x >= low + period) x = low;  // by rounding
  };
  if (period_ != Vec3{})
    for (SphereRow& s : spheres.row)
      wrap(s.x, low_.x, period_.x), wrap(s.y, low_.y, period_.y), wrap(s.z, low_.z, period_.z);
  constexpr double kInf = std::numeric_limits<double>::infinity();
  Vec3 low{kInf, kInf, kInf}, high = -low;
  std::vector<KeyedIndex> order;
  order.reserve(spheres.size());
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    if (spheres.id[i] < 0) continue;
    const SphereRow& s = spheres.row[i];
    low = {std::min(low.x, s.x), std::min(low.y, s.y), std::min(low.z, s.z)};
    high = {std::max(high.x, s.x), std::max(high.y, s.y), std::max(high.z, s.z)};
    order.push_back({0, static_cast<std::uint32_t>(i)});
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
      [&](std::size_t k) {
        const auto c = cell_of(spheres.row[order[k].index]);
        order[k].key = spread_bits(c[0]) | (spread_bits(c[1]) << 1) | (spread_bits(c[2]) << 2);
      },
      kBlock);
  radix_sort(order);

  Spheres sorted;
  sorted.row.resize(order.size());
  sorted.id.resize(order.size());
  was_.resize(order.size());
  core::parallel_for(
      order.size(),
      [&](std::size_t i) {
        sorted.row[i] = spheres.row[order[i].index];
        sorted.id[i] = spheres.id[order[i].index];
        was_[i] = static_cast<std::int32_t>(order[i].index);
      },
      kBlock);
  spheres.row.swap(sorted.row);
  spheres.id.swap(sorted.id);
  if (!spheres.clump.empty()) {
    for (const std::int32_t was : was_) sorted.clump.push_back(spheres.clump[at(was)]);
    spheres.clump.swap(sorted.clump);
  }

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
  name_owners();
  name_images(spheres);
}

void SphereList::name_owners() {
  owner.resize(partner.size());
  core::parallel_blocks(blocks(), [&](std::size_t b) {
    for (std::size_t i = b * kBlock; i < std::min(count_, (b + 1) * kBlock); ++i)
      std::fill(owner.begin() + start[i], owner.begin() + start[i + 1], static_cast<std::int32_t>(i));
  });
}

bool SphereList::restore(std::size_t spheres) {
  const auto pairs_at_end = static_cast<std::int32_t>(partner.size());
  if (start.size() != spheres + 1 || start.front() != 0 || start.back() != pairs_at_end ||
      !std::ranges::is_sorted(start) || touching.size() != pairs() || spring.size() != pairs() ||
      torque.size() != (torques_ ? pairs() : 0))
    return false;
  for (std::size_t i = 0; i < spheres; ++i) {
    auto last = static_cast<std::int32_t>(i);  // partners come later, in ascending order
    for (auto k = at(start[i]); k < at(start[i + 1]); last = partner[k++])
      if (partner[k] <= last || at(partner[k]) >= spheres || touching[k] > 1) return false;
  }
  count_ = spheres;
  name_owners();
  link_far_pairs();
  return true;
}

/// A contact that stays is looked up in the row of the sphere that owned it; where the two have changed
/// places in the order, its spring belongs to the other one and points the other way.
void SphereList::carry_springs(const SphereList& before) {
  touching.assign(pairs(), 0);
  spring.assign(pairs(), {});
  torque.assign(torques_ ? pairs() : 0, {});
  if (before.partner.empty()) return;
  core::parallel_for(
      pairs(),
      [&](std::size_t k) {
        const std::int32_t i = was_[at(owner[k])], j = was_[at(partner[k])];
        const auto [low, high] = std::minmax(i, j);
        if (at(high) >= before.count_) return;
        const auto row = before.partner.begin() + before.start[at(low)];
        const auto row_end = before.partner.begin() + before.start[at(low) + 1];
        const auto old = std::lower_bound(row, row_end, high);
        if (old == row_end || *old != high) return;
        const auto o = static_cast<std::size_t>(old - before.partner.begin());
        if (before.touching[o] == 0) return;
        touching[k] = 1;
        const double sign = i < j ? 1.0 : -1.0;
        const SpringRow& s = before.spring[o];
        spring[k] = {sign * s.x, sign * s.y, sign * s.z, 0.0};
        if (!torques_ || before.torque.empty()) return;
        const SpringRow& t = before.torque[o];  // about the normal it is the same seen from either side
        torque[k] = {sign * t.x, sign * t.y, sign * t.z, t.twist};
      },
      kBlock);
}

void SphereList::link_far_pairs() {
  far.assign(pairs(), -1);
  std::vector<std::int32_t> incoming(count_ + 1, 0);
  const auto is_far = [&](std::size_t k) { return at(partner[k]) / kBlock != at(owner[k]) / kBlock; };
  for (std::size_t k = 0; k < pairs(); ++k)
    if (is_far(k)) ++incoming[at(partner[k]) + 1];
  far_target.clear();
  far_start.assign(1, 0);
  for (std::size_t i = 0; i < count_; ++i) {
    if (incoming[i + 1] > 0) {
      far_target.push_back(static_cast<std::int32_t>(i));
      far_start.push_back(far_start.back() + incoming[i + 1]);
    }
    incoming[i + 1] += incoming[i];
  }
  far_load.assign(at(incoming[count_]), {});
  for (std::size_t k = 0; k < pairs(); ++k)
    if (is_far(k)) far[k] = incoming[at(partner[k])]++;
}

}  // namespace abradem::contact
