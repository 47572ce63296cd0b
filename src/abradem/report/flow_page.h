// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "abradem/analysis/flow_profile.h"
#include "abradem/report/page.h"

namespace abradem::report {

/// Mean velocities along a line, and what was measured there.
struct FlowSummary {
  std::string title;      ///< of the run
  std::string sentence;   ///< the line, what was averaged, over which frames
  std::string component;  ///< name of the one direction shown; empty: x, y and z
  Vec3 direction;         ///< of that component: a unit vector
  double moments = 0.0;   ///< frames
  std::vector<analysis::FlowBin> bins;
  struct Points {
    std::string name;                        ///< in the legend
    std::vector<double> distance, velocity;  ///< [m], [m/s]
  };
  std::vector<Points> measured;
};

/// The velocities, their fluctuation and the number of particles, each against the distance.
[[nodiscard]] Page flow_page(const FlowSummary& summary);

}  // namespace abradem::report
