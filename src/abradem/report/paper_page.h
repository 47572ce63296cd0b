// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <span>

#include "abradem/report/study_page.h"

namespace abradem::report {

/// The page of the published pin-on-disc study: every table and figure of it from our runs, in two readings
/// of its rules, with verdicts. docs/reference/study.md#page-paper
/// @throws IoError as study_page
[[nodiscard]] Page paper_page(const simulation::Setup& study, std::span<const StudyRun> runs,
                              const std::filesystem::path& output);

}  // namespace abradem::report
