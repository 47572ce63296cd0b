// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

/// A page of text, tables and figures, as plain data: what a study, a sweep, a calibration or an analysis has
/// to show. Written as one HTML file that opens without a network, prints, and fits a phone. docs/report.md
/// All texts are plain text in UTF-8, never markup. Every axis carries its unit: "wear depth [µm]".
namespace abradem::report {

struct Axis {
  std::string title = {};  ///< with its unit in brackets; [-] where there is none
  bool log = false;
  std::optional<std::array<double, 2>> range = {};          ///< in the axis's unit, also where log
  bool equal_to_other = false;                              ///< one unit is as long on both axes
  std::vector<std::pair<double, std::string>> labels = {};  ///< named positions in place of numbers
};

/// One thing drawn in a panel. Numbers that are not finite leave a gap.
struct Series {
  enum class Kind {
    line,
    markers,
    line_markers,
    band,    ///< the area from y_low to y_high over x
    box,     ///< quartiles, whiskers to the last value within 1.5 quartile ranges, outliers as points
    bars,    ///< a histogram, or counts: y over the middle x of each bin
    heat,    ///< z as colour over x and y
    surface  ///< z as height over x and y, in 3D
  };
  enum class Dash { solid, dash, dot };

  Kind kind = Kind::line;
  std::string name = {};  ///< in the legend; empty: not in it
  /// Box: x is the position of each value's box (equal x, one box), y the values.
  /// Heat, surface: the coordinates of the columns (x) and of the rows (y).
  std::vector<double> x = {}, y = {};
  std::vector<double> y_low = {}, y_high = {};  ///< edges of the band; ends of error bars at markers, as y
  std::vector<double> z = {};                   ///< heat, surface: y.size() rows of x.size() values
  std::string z_title = {};                     ///< with unit; equal titles in a figure share one scale
  int colour = 0;  ///< 0 to 7: the same thing has the same colour (and marker) in all figures of a page
  Dash dash = Dash::solid;
  bool theirs = false;        ///< published or measured values: grey, hollow markers; must have a name
  bool polar = false;         ///< surface: x is an angle [deg], y a radius; drawn as the ring it is
  double exaggeration = 0.0;  ///< surface: z is drawn that many times too large; 0: chosen; always stated
  double z_unit = 1.0;        ///< surface: units of x and y in one of z (heights in µm over mm: 1e-3)
};

struct Panel {
  std::string title = {};  ///< empty: none
  Axis x = {}, y = {};
  std::vector<Series> series = {};
};

/// "Figure 3. Title. Caption", its panels, and beside the page tables/<id>.csv with what it shows.
struct Figure {
  std::string id = {};  ///< name of the CSV file: lower-case letters, digits, '-', '_'; unique in the page
  std::string title = {}, caption = {};
  std::vector<Panel> panels = {};
  int columns = 1;  ///< panels side by side (stacked on a phone)
};

/// "Table 2. Title. Caption" and tables/<id>.csv. The values "reproduced", "trend only" and "not reproduced"
/// of a column whose name begins with "verdict" are shown as badges; any other value there as a grey one.
struct DataTable {
  std::string id = {};  ///< as in Figure
  std::string title = {}, caption = {};
  std::vector<std::string> columns = {};            ///< with units
  std::vector<std::vector<std::string>> rows = {};  ///< as many cells as columns; numbers are right-aligned
  std::vector<std::string> links = {};  ///< empty, or for each row where its first cell leads (relative path)
};

struct Paragraph {
  std::string text = {};
};

struct PageSection {
  std::string title = {};
  std::vector<std::variant<Paragraph, DataTable, Figure>> items = {};
};

struct Page {
  std::string title = {};
  std::string summary = {};                                     ///< the answer in a sentence or two
  std::vector<std::pair<std::string, std::string>> cards = {};  ///< label and value with unit
  std::vector<PageSection> sections = {};
};

/// The page as HTML, with the data of its figures inside. Large figures carry fewer points (lines keep their
/// extremes, boxes are computed from all values); their captions say so.
/// @throws Error (internal) when the data contradict themselves: lengths, ids, a series of theirs without a
/// name
[[nodiscard]] std::string page_html(const Page& page);

/// Sections of a page that is made otherwise: their HTML, and the data of their figures for figures.js.
struct SectionParts {
  std::string html, data;
};
/// @param figures, tables that the page numbers before them   @throws Error (internal) as page_html
[[nodiscard]] SectionParts section_parts(const std::vector<PageSection>& sections, int figures, int tables);

/// Writes folder/tables/<id>.csv for each figure and table.   @throws IoError
void write_section_tables(const std::filesystem::path& folder, const std::vector<PageSection>& sections);

/// Writes folder/tables/<id>.csv for each figure and table, folder/tables/figures.json (what is drawn from
/// which rows, for scripts/plot_paper.py) and last folder/report.html, each whole or not at all.
/// @return the path of the page   @throws IoError, and as page_html before anything is written
std::filesystem::path write_page(const std::filesystem::path& folder, const Page& page);

}  // namespace abradem::report
