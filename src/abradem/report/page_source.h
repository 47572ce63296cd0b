// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

/// The page's sources (folder report/), embedded when the library is built (cmake/embed_report.cmake).
namespace abradem::report {
[[nodiscard]] std::string_view page_template() noexcept;     ///< HTML with {{name}} places
[[nodiscard]] std::string_view page_style() noexcept;        ///< CSS
[[nodiscard]] std::string_view page_script() noexcept;       ///< what draws the figures
[[nodiscard]] std::string_view page_charts_gzip() noexcept;  ///< the chart library (plotly.js), gzip
}  // namespace abradem::report
