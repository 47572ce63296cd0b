// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "abradem/report/page.h"
#include "abradem/study/groove_calibration.h"

/// A calibration of all three numbers behind a groove, as text, as JSON and as a page, and its row of the
/// paper's Table 4.                                                      docs/reference/calibrate.md#groove
namespace abradem::report {

[[nodiscard]] std::string groove_calibration_text(const study::GrooveCalibration& result);
/// In 1/Pa, mm, mm^2, mm^3 and micrograms.
[[nodiscard]] std::string groove_calibration_json(const study::GrooveCalibration& result);
/// @param title of the case
[[nodiscard]] Page groove_calibration_page(const study::GrooveCalibration& result, const std::string& title);

/// What a run has to say to Table 4 of [yan2022]: volume, depth and width; NaN where it has none.
struct GrooveRow {
  std::string name;
  double volume = 0.0, depth = 0.0, width = 0.0;  ///< SI
};
/// Table 4 again: the measured ranges, the published values, and rows of ours, each with what it misses the
/// published test values by (depth 0.014 mm, width 0.8 mm, volume 0.565 mm^3) and whether it is inside the
/// measured ranges.
[[nodiscard]] DataTable groove_table(const std::vector<GrooveRow>& ours);

}  // namespace abradem::report
