// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "abradem/report/page.h"
#include "abradem/study/wear_law.h"

/// Laws fitted to many wear tests, as text for a terminal, as JSON and as a page.
///                                                               docs/reference/calibrate.md#many-tests
namespace abradem::report {

/// What the tests say of a material, a sentence or two each: whether Archard's law holds, the power law, what
/// cannot be known, the errors of prediction, what the residuals show.
[[nodiscard]] std::vector<std::string> wear_law_findings(const study::WearLawFit& r);

/// @param fits one per material, at least one
[[nodiscard]] std::string wear_law_text(std::span<const study::WearLawFit> fits);
/// Everything, in mm^3, N, m and 1/Pa; what does not exist is null.
[[nodiscard]] std::string wear_law_json(std::span<const study::WearLawFit> fits);
/// @param source name of the file of tests
[[nodiscard]] Page wear_law_page(std::span<const study::WearLawFit> fits, const std::string& source);

}  // namespace abradem::report
