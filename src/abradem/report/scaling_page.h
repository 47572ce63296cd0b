// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <span>

#include "abradem/report/study_page.h"

namespace abradem::report {

/// The page of what scaling costs: the same wear in fewer revolutions than the test, the largest factor for a
/// tolerance, the master curve of the groove's depth, and the unscaled test against the laboratory.
///                                                                      docs/reference/study.md#page-scaling
/// @throws IoError as study_page
[[nodiscard]] Page scaling_page(const simulation::Setup& study, std::span<const StudyRun> runs,
                                const std::filesystem::path& output);

}  // namespace abradem::report
