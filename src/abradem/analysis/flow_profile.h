// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "abradem/core/vec3.h"

/// How particles move along a line through them, on average.                       docs/reference/flow.md
namespace abradem::analysis {

/// A line cut into equal bins. A particle belongs to a bin by its centre: by where that is along the line,
/// and if it is no further from the line than `reach`.
struct FlowLine {
  Vec3 from, to;       ///< ends [m]
  int bins = 20;       ///< >= 1
  double reach = 0.0;  ///< [m]
  Vec3 averaged;       ///< a direction across the line along which distance does not count; zero: none
};

/// What was in a bin, over all moments that were added.
struct FlowBin {
  double distance = 0.0;      ///< of its middle from the line's beginning [m]
  Vec3 middle;                ///< [m]
  std::uint64_t samples = 0;  ///< particles, each once a moment
  Vec3 velocity;              ///< mean [m/s]; NaN without samples
  double fluctuation = std::numeric_limits<double>::quiet_NaN();  ///< rms of one component about it [m/s]
};

class FlowProfile {
 public:
  /// @throws InputError for a line without length, no bins, a reach that is not above 0, or a direction to
  /// average along that runs along the line
  explicit FlowProfile(const FlowLine& line);

  /// Adds the particles of one moment.   @throws std::invalid_argument when the lengths differ
  void add(std::span<const Vec3> centres, std::span<const Vec3> velocities);
  [[nodiscard]] std::uint64_t moments() const noexcept { return moments_; }
  [[nodiscard]] std::vector<FlowBin> bins() const;

 private:
  struct Sum {
    std::uint64_t count = 0;
    Vec3 mean;
    double squares = 0.0;  // of the distances from the mean
  };
  FlowLine line_;
  Vec3 along_, averaged_;  // unit vectors; averaged_ may be zero
  double length_ = 0.0;
  std::uint64_t moments_ = 0;
  std::vector<Sum> sums_;
};

}  // namespace abradem::analysis
