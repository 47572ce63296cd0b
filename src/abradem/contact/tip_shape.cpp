// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/contact/tip_shape.h"

#include <algorithm>

namespace abradem::contact {

void TipCorrection::apply(const MeshCandidates& candidates, const Vec3& c, double R, const Tip& tip,
                          std::span<const double> raw, std::span<double> worn) {
  constexpr double kStill = 1e-12;  // [m]: round-off of a motion along the axis
  const double s = dot(c, tip.u), t = dot(c, tip.v);
  const bool same = shape_ == tip.shape && revision_ == tip.shape->revision && u_ == tip.u &&
                    gathering_ == candidates.gatherings() && recession_.size() == raw.size() &&
                    std::abs(s - s_) < kStill && std::abs(t - t_) < kStill;
  if (!same) {
    recession_.assign(raw.size(), 0.0);
    for (std::size_t i = 0; i < candidates.node_count(); ++i)
      recession_[i] = tip.recession(candidates.node_position(i) - c);
    shape_ = tip.shape, revision_ = tip.shape->revision, gathering_ = candidates.gatherings();
    s_ = s, t_ = t, u_ = tip.u;
  }
  const double height = dot(c, tip.axis);
  for (std::size_t i = 0; i < raw.size(); ++i) {
    const double z =
        candidates.x[i] * tip.axis.x + candidates.y[i] * tip.axis.y + candidates.z[i] * tip.axis.z - height;
    worn[i] = worn_excess(raw[i], recession_[i], z, R);
  }
}

}  // namespace abradem::contact
