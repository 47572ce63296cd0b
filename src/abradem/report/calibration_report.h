// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "abradem/report/page.h"
#include "abradem/study/calibration.h"

/// A calibration as text for a terminal, as JSON and as a page.                docs/reference/calibrate.md
namespace abradem::report {

/// What was found and what cannot be known from the measurement, a sentence or two each.
[[nodiscard]] std::vector<std::string> calibration_findings(const study::CalibrationResult& result);

/// The result, the findings and the table of pairs, for a person.
[[nodiscard]] std::string calibration_text(const study::CalibrationResult& result);

/// Everything, in 1/Pa, mm^3 and mm; what does not exist is null.
[[nodiscard]] std::string calibration_json(const study::CalibrationResult& result);

/// @param title of the case
[[nodiscard]] Page calibration_page(const study::CalibrationResult& result, const std::string& title);

}  // namespace abradem::report
