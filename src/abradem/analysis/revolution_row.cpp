// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/analysis/revolution_row.h"

#include <vector>

#include "abradem/analysis/normality.h"

namespace abradem::analysis {

RevolutionRow revolution_row(double revolution, double time, const WearVolumes& volumes,
                             std::span<const Contour> contours, const RunningStatistics& normal_force) {
  std::vector<double> depths, widths, areas;
  for (const Contour& c : contours) {
    depths.push_back(c.depth);
    widths.push_back(c.width);
    areas.push_back(c.area);
  }
  const Summary depth = summarise(depths), width = summarise(widths);
  return {
      .revolution = revolution,
      .time = time,
      .law_volume = volumes.law,
      .swept_volume = volumes.swept,
      .paper_volume = volumes.paper,
      .depth_mean = depth.mean,
      .depth_sd = depth.sd,
      .depth_min = depth.min,
      .depth_max = depth.max,
      .width_mean = width.mean,
      .width_sd = width.sd,
      .area_mean = summarise(areas).mean,
      .force_mean = normal_force.mean(),
      .force_sd = normal_force.sd(),
      .force_min = normal_force.min(),
      .force_max = normal_force.max(),
      .depth_p_chi2 = chi_squared_normality(depths).p,
      .width_p_chi2 = chi_squared_normality(widths).p,
  };
}

}  // namespace abradem::analysis
