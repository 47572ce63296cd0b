// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/analysis/flow_profile.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "abradem/core/error.h"

namespace abradem::analysis {

FlowProfile::FlowProfile(const FlowLine& line)
    : line_(line),
      along_(normalized(line.to - line.from)),
      averaged_(normalized(line.averaged)),
      length_(norm(line.to - line.from)) {
  if (!(length_ > 0.0) || !std::isfinite(length_))
    throw InputError("the line of a flow profile needs two ends that differ");
  if (line.bins < 1) throw InputError(fmt::format("a flow profile needs 1 bin or more, not {}", line.bins));
  if (!(line.reach > 0.0))
    throw InputError(fmt::format("the reach of a flow profile must be above 0, not {} m", line.reach));
  if (std::abs(dot(along_, averaged_)) > 1e-6)
    throw InputError("the direction to average along must be at right angles to the line");
  sums_.resize(static_cast<std::size_t>(line.bins));
}

void FlowProfile::add(std::span<const Vec3> centres, std::span<const Vec3> velocities) {
  if (centres.size() != velocities.size())
    throw std::invalid_argument("FlowProfile::add: as many velocities as centres are needed");
  ++moments_;
  const double bin = length_ / static_cast<double>(sums_.size());
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const Vec3 from = centres[i] - line_.from;
    const double s = dot(from, along_);
    if (!(s >= 0.0 && s < length_)) continue;
    if (norm(from - s * along_ - dot(from, averaged_) * averaged_) > line_.reach) continue;
    // Welford's update, as RunningStatistics.
    Sum& sum = sums_[std::min(sums_.size() - 1, static_cast<std::size_t>(s / bin))];
    const Vec3 from_old_mean = velocities[i] - sum.mean;
    sum.mean += from_old_mean / static_cast<double>(++sum.count);
    sum.squares += dot(from_old_mean, velocities[i] - sum.mean);
  }
}

std::vector<FlowBin> FlowProfile::bins() const {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::vector<FlowBin> out;
  const double bin = length_ / static_cast<double>(sums_.size());
  for (std::size_t k = 0; k < sums_.size(); ++k) {
    const Sum& sum = sums_[k];
    const auto n = static_cast<double>(sum.count);
    const double s = (static_cast<double>(k) + 0.5) * bin;
    out.push_back({s, line_.from + s * along_, sum.count,
                   sum.count > 0 ? sum.mean : Vec3{kNone, kNone, kNone},
                   sum.count > 0 ? std::sqrt(sum.squares / (3.0 * n)) : kNone});
  }
  return out;
}

}  // namespace abradem::analysis
