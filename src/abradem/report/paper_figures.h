// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "abradem/report/page.h"
#include "abradem/report/paper_runs.h"

/// The figures and tables of the published pin-on-disc study, drawn from our runs with the paper's own
/// numbers beside them. Each is nothing where its runs are missing. docs/reference/study.md#page-paper
namespace abradem::report {

// Mesh size (paper_figures.cpp)
[[nodiscard]] std::optional<Figure> fig07_mesh_size(const PaperRuns& runs);
[[nodiscard]] std::optional<Figure> fig08_contours(const PaperRuns& runs);
// Revolution by revolution (paper_figures.cpp)
[[nodiscard]] std::optional<Figure> fig09_forces(const PaperRuns& runs);
[[nodiscard]] std::optional<Figure> fig10_depths(const PaperRuns& runs);
[[nodiscard]] std::optional<Figure> fig11_widths(const PaperRuns& runs);
[[nodiscard]] std::optional<Figure> fig12_depth_boxes(const PaperRuns& runs);
[[nodiscard]] std::optional<Figure> fig13_width_boxes(const PaperRuns& runs);
[[nodiscard]] std::optional<Figure> fig14_contours(const PaperReading& reading, const PaperRuns& runs);

// Normality (paper_tables.cpp)
[[nodiscard]] std::optional<DataTable> table3_normality(const PaperRuns& runs);
[[nodiscard]] std::optional<Figure> table3_figure(const PaperRuns& runs);
/// How much Table 3 owes to the mesh and to the number of bins, in a few sentences; empty without runs.
[[nodiscard]] std::vector<std::string> normality_sensitivity(const PaperRuns& runs);

// Volume (paper_volume.cpp)
[[nodiscard]] std::optional<Figure> fig15_volumes(const PaperRuns& runs);
[[nodiscard]] std::optional<Figure> fig15_ratio(const PaperRuns& runs);
[[nodiscard]] std::optional<DataTable> fits_table(const PaperRuns& runs);
[[nodiscard]] std::optional<Figure> fig16_force_components(const PaperRuns& runs);

// The groove, and against the test (paper_groove.cpp)
[[nodiscard]] std::optional<Figure> fig17_wear_profile(const PaperRuns& runs);
[[nodiscard]] std::optional<Figure> fig18_against_test(const PaperRuns& runs);
[[nodiscard]] std::optional<DataTable> table4(const PaperRuns& runs);

}  // namespace abradem::report
