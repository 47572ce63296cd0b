# SPDX-License-Identifier: BSD-3-Clause
# Turns the report's page sources into one C++ file of string literals, so that the program carries its page.
# Run by the build:  cmake -DSOURCE=<folder report/> -DOUTPUT=<report_page.cpp> -P embed_report.cmake
# The chart library is embedded compressed (gzip), exactly as the page hands it to the browser.
cmake_minimum_required(VERSION 3.25)

# A literal per 64 bytes: every byte escaped, so no byte can run into the next.
function(to_literal file result)
  file(READ ${file} hex HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "\\\\x\\1" bytes "${hex}")
  # 64 bytes are 256 characters; CMake's expressions have no counts, so the pattern is built.
  string(REPEAT "." 256 line)
  string(REGEX REPLACE "(${line})" "\\1\"\n    \"" bytes "${bytes}")
  set(${result} "\"${bytes}\"" PARENT_SCOPE)
endfunction()

set(bundle ${SOURCE}/vendor/plotly/plotly-abradem.min.js)
set(packed ${OUTPUT}.plotly.gz)
file(ARCHIVE_CREATE OUTPUT ${packed} PATHS ${bundle} FORMAT raw COMPRESSION GZip COMPRESSION_LEVEL 9)

set(code "// Made by cmake/embed_report.cmake from report/; do not edit.\n#include \"abradem/report/page_source.h\"\n\n")
string(APPEND code "using namespace std::string_view_literals;\n\nnamespace abradem::report {\n")
foreach(entry IN ITEMS page_shell=${SOURCE}/page.html run_body=${SOURCE}/run.html groove_figures=${SOURCE}/groove.html
                       surface_figures=${SOURCE}/surface.html volume_figure=${SOURCE}/volume.html
                       wear_map_body=${SOURCE}/wear-map.html
                       page_style=${SOURCE}/page.css
                       chart_tools_script=${SOURCE}/charts.js run_script=${SOURCE}/run.js
                       figures_script=${SOURCE}/figures.js page_charts_gzip=${packed})
  string(REGEX MATCH "^([a-z_]+)=(.*)$" entry "${entry}")
  set(name ${CMAKE_MATCH_1})
  to_literal(${CMAKE_MATCH_2} literal)
  string(APPEND code "std::string_view ${name}() noexcept {\n  return\n    ${literal}sv;\n}\n")
endforeach()
string(APPEND code "}  // namespace abradem::report\n")
file(WRITE ${OUTPUT} "${code}")
