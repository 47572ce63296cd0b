// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "abradem/report/page.h"

/// What a figure shows as text: its table and the description of what is drawn from which rows.
namespace abradem::report {

/// A column's name made of an axis title: "wear depth [µm]" gives wear_depth_um; empty when nothing remains.
[[nodiscard]] std::string column_name(std::string_view axis_title);

/// A field of a CSV file: quoted where it holds a comma, a quote or a line end (RFC 4180).
[[nodiscard]] std::string csv_field(std::string_view text);

/// @throws Error (internal) that names the figure, panel and series, when the data contradict themselves
void check(const Figure& figure);

/// The figure with at most about max_points points: lines keep the extremes of each stretch, markers and
/// values of boxes every k-th, heat and surface every k-th row and column.
[[nodiscard]] Figure thinned(const Figure& figure, std::size_t max_points);

/// Rows of the figure's table, headers not counted.
[[nodiscard]] std::size_t row_count(const Figure& figure);

/// The table: one row per point, series after series, with the columns panel, series, x, y and, where any
/// series has them, the edges and z. The columns of numbers are named after the axes where all panels have
/// the same. A number that does not exist is nan.
/// @param digits significant digits; 0: the fewest that read back to the same double
[[nodiscard]] std::string figure_csv(const Figure& figure, int digits);

/// Five-number summary of one box with its outliers; whiskers and outliers as tukey_outliers().
struct Box {
  double x = 0.0;
  std::size_t count = 0;
  double low = 0.0, lower_quartile = 0.0, median = 0.0, upper_quartile = 0.0, high = 0.0;
  std::vector<double> outliers;  ///< ascending
};
/// The boxes of a series of that kind, by ascending x; values that are not finite are left out.
[[nodiscard]] std::vector<Box> boxes(const Series& series);

/// The description as a JSON object: titles, axes, and for each series its kind, style and number of rows.
/// @param complete the figure whose boxes are stated, `drawn` or what it was thinned from
/// @param number of the figure in its page
[[nodiscard]] std::string figure_json(const Figure& drawn, const Figure& complete, int number);

}  // namespace abradem::report
