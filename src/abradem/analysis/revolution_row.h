// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "abradem/analysis/contour.h"
#include "abradem/analysis/statistics.h"

namespace abradem::analysis {

/// The three wear volumes of a wall since the start [m^3].
struct WearVolumes {
  double law = 0.0;    ///< sum of alpha_s F_n |v_t| dt
  double swept = 0.0;  ///< what the mesh lost
  double paper = 0.0;  ///< [yan2022, Eq. 10-12] over the elements in contact
};

/// What is recorded of one revolution (or output interval): the columns of tables/revolutions.csv, in their
/// order, in SI units.
struct RevolutionRow {
  double revolution = 0.0;                                                    ///< [-] since the start
  double time = 0.0;                                                          ///< [s]
  double law_volume = 0.0;                                                    ///< [m^3]
  double swept_volume = 0.0;                                                  ///< [m^3]
  double paper_volume = 0.0;                                                  ///< [m^3]
  double depth_mean = 0.0, depth_sd = 0.0, depth_min = 0.0, depth_max = 0.0;  ///< [m] over the contours
  double width_mean = 0.0, width_sd = 0.0;                                    ///< [m]
  double area_mean = 0.0;                                                     ///< [m^2]
  double force_mean = 0.0, force_sd = 0.0, force_min = 0.0,
         force_max = 0.0;  ///< [N] normal force in the interval
  double depth_p_chi2 = 0.0,
         width_p_chi2 = 0.0;  ///< [-] ChiSquaredNormality::p; NaN where no test can be made

  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("revolution", self.revolution)("time", self.time)("law_volume", self.law_volume)(
        "swept_volume", self.swept_volume)("paper_volume", self.paper_volume)("depth_mean", self.depth_mean)(
        "depth_sd", self.depth_sd)("depth_min", self.depth_min)("depth_max", self.depth_max)(
        "width_mean", self.width_mean)("width_sd", self.width_sd)("area_mean", self.area_mean)(
        "force_mean", self.force_mean)("force_sd", self.force_sd)("force_min", self.force_min)(
        "force_max", self.force_max)("depth_p_chi2", self.depth_p_chi2)("width_p_chi2", self.width_p_chi2);
  }
};

/// Assembles the row. Every contour counts, also those without wear; without contours (without forces) their
/// columns are NaN.
/// @param normal_force of the steps of this interval alone [N]
/// @throws InputError when a measure of a contour is not finite
[[nodiscard]] RevolutionRow revolution_row(double revolution, double time, const WearVolumes& volumes,
                                           std::span<const Contour> contours,
                                           const RunningStatistics& normal_force);

}  // namespace abradem::analysis
