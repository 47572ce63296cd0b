// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

namespace abradem::contact {

/// Disjoint sets of local triangles; the root of a set is its smallest member, so that results do not depend
/// on the order of joining.
class TriangleLinks {
 public:
  explicit TriangleLinks(std::size_t count = 0) { reset(count); }
  /// Each by itself.
  void reset(std::size_t count) {
    parent_.resize(count);
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  [[nodiscard]] std::int32_t root(std::int32_t i) noexcept {
    while (parent_[at(i)] != i) i = parent_[at(i)] = parent_[at(parent_[at(i)])];
    return i;
  }
  void join(std::int32_t a, std::int32_t b) noexcept {
    const std::int32_t ra = root(a), rb = root(b);
    if (ra < rb) parent_[at(rb)] = ra;
    if (rb < ra) parent_[at(ra)] = rb;
  }

 private:
  static std::size_t at(std::int32_t i) noexcept { return static_cast<std::size_t>(i); }
  std::vector<std::int32_t> parent_;
};

}  // namespace abradem::contact
