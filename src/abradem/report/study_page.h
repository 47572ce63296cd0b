// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "abradem/report/page.h"
#include "abradem/simulation/setup.h"

/// The page of a study, drawn from the folders of its runs.
namespace abradem::report {

/// One run of a study and what became of it.
struct StudyRun {
  std::string name;                                         ///< "mesh_size/03"
  std::string variation;                                    ///< "mesh_size"
  std::vector<std::pair<std::string, std::string>> varied;  ///< keys by which it differs, and their values
  simulation::Setup setup;
  std::filesystem::path folder;  ///< with run.json and tables/; may lack them where the run failed
  std::string status;            ///< completed, failed, interrupted or missing
  std::string message;           ///< why it failed
  double seconds = 0.0;
};

/// The page that [study] asks for. Runs that failed or are missing leave gaps, which the page names.
/// @param study the case of the study   @param output folder of the page, for its links
/// @throws IoError when a finished run's tables, or the published values, are damaged
[[nodiscard]] Page study_page(const simulation::Setup& study, std::span<const StudyRun> runs,
                              const std::filesystem::path& output);

/// The section that ends a study's page: which runs did not complete, and of all what was varied, how they
/// ended, and where their tables are.
[[nodiscard]] PageSection all_runs(std::span<const StudyRun> runs, const std::filesystem::path& output);

}  // namespace abradem::report
