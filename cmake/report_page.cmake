# SPDX-License-Identifier: BSD-3-Clause
# Adds the report's page (folder report/) to the library's sources, as code made by embed_report.cmake.
set(report_page ${PROJECT_BINARY_DIR}/generated/report_page.cpp)
add_custom_command(
  OUTPUT ${report_page}
  COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR}/report -DOUTPUT=${report_page}
          -P ${PROJECT_SOURCE_DIR}/cmake/embed_report.cmake
  DEPENDS ${PROJECT_SOURCE_DIR}/report/page.html ${PROJECT_SOURCE_DIR}/report/run.html
          ${PROJECT_SOURCE_DIR}/report/groove.html ${PROJECT_SOURCE_DIR}/report/wear-map.html
          ${PROJECT_SOURCE_DIR}/report/surface.html ${PROJECT_SOURCE_DIR}/report/volume.html
          ${PROJECT_SOURCE_DIR}/report/page.css ${PROJECT_SOURCE_DIR}/report/charts.js
          ${PROJECT_SOURCE_DIR}/report/run.js ${PROJECT_SOURCE_DIR}/report/figures.js
          ${PROJECT_SOURCE_DIR}/report/vendor/plotly/plotly-abradem.min.js
          ${PROJECT_SOURCE_DIR}/cmake/embed_report.cmake
  COMMENT "Embedding the report's page"
  VERBATIM)
list(APPEND sources ${report_page})
# Literals longer than every C++ compiler must take; ours take them.
set_source_files_properties(${report_page} PROPERTIES COMPILE_OPTIONS -Wno-overlength-strings)
