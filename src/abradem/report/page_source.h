// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

/// The pages' sources (folder report/), embedded when the library is built (cmake/embed_report.cmake).
namespace abradem::report {
[[nodiscard]] std::string_view page_shell() noexcept;  ///< HTML of every page, with {{name}} places
[[nodiscard]] std::string_view run_body() noexcept;    ///< what the shell holds in a run's report
[[nodiscard]] std::string_view
groove_figures() noexcept;  ///< its sections on the groove and the contact of a guided body
[[nodiscard]] std::string_view surface_figures() noexcept;     ///< its section on the worn surface
[[nodiscard]] std::string_view volume_figure() noexcept;       ///< its section on the worn volume
[[nodiscard]] std::string_view wear_map_body() noexcept;       ///< its section on the walls' wear maps
[[nodiscard]] std::string_view page_style() noexcept;          ///< CSS of every page
[[nodiscard]] std::string_view chart_tools_script() noexcept;  ///< what every page's figures are drawn with
[[nodiscard]] std::string_view run_script() noexcept;          ///< the figures of a run's report
[[nodiscard]] std::string_view figures_script() noexcept;      ///< the figures of page.h
[[nodiscard]] std::string_view page_charts_gzip() noexcept;    ///< the chart library (plotly.js), gzip
}  // namespace abradem::report
