// SPDX-License-Identifier: BSD-3-Clause
// make_page <folder>: a page with every kind of series, table and text, for the browser test.
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <random>

#include "abradem/core/error.h"
#include "abradem/report/page.h"

namespace {

using namespace abradem::report;
using Kind = Series::Kind;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::vector<double> steps(double from, double to, int count) {
  std::vector<double> out;
  for (int k = 0; k < count; ++k) out.push_back(from + (to - from) * k / (count - 1));
  return out;
}

template <class Function>
std::vector<double> of(const std::vector<double>& x, Function f) {
  std::vector<double> y;
  for (const double v : x) y.push_back(f(v));
  return y;
}

Figure lines_and_bands() {
  const auto sizes = steps(0.1, 1.0, 10), fine = steps(0.1, 1.0, 60);
  Panel depth{.title = "(a) Depth", .x = {.title = "mesh size [mm]"}, .y = {.title = "wear depth [µm]"}};
  depth.series = {{.kind = Kind::band,
                   .name = "measured",
                   .x = {0.1, 1.0},
                   .y_low = {10, 10},
                   .y_high = {14, 14},
                   .theirs = true},
                  {.kind = Kind::line_markers,
                   .name = "patch, conserving",
                   .x = sizes,
                   .y = of(sizes, [](double s) { return 13 - 4 * s; }),
                   .y_low = of(sizes, [](double s) { return 12.6 - 4 * s; }),
                   .y_high = of(sizes, [](double s) { return 13.4 - 4 * s; })},
                  {.kind = Kind::markers,
                   .name = "per triangle, paper's rule",
                   .x = sizes,
                   .y = of(sizes, [](double s) { return s == 0.5 ? kNaN : 16 / (1 + s); }),
                   .colour = 1},
                  {.kind = Kind::markers,
                   .name = "Yan et al. (2022), Fig. 7",
                   .x = sizes,
                   .y = of(sizes, [](double s) { return 15 / (1 + s); }),
                   .theirs = true}};
  Panel width{.title = "(b) Width",
              .x = {.title = "mesh size [mm]", .log = true},
              .y = {.title = "wear width [mm]", .log = true}};
  width.series = {{.kind = Kind::band,
                   .x = fine,
                   .y_low = of(fine, [](double s) { return 0.6 + 0.5 * s; }),
                   .y_high = of(fine, [](double s) { return s > 0.4 && s < 0.5 ? kNaN : 0.7 + 0.7 * s; })},
                  {.kind = Kind::line,
                   .name = "fit, 0.65 + 0.6 h",
                   .x = fine,
                   .y = of(fine, [](double s) { return 0.65 + 0.6 * s; }),
                   .dash = Series::Dash::dash},
                  {.kind = Kind::markers,
                   .name = "Yan et al. (2022), Fig. 7",
                   .x = sizes,
                   .y = of(sizes, [](double s) { return 0.7 + 0.5 * s; }),
                   .theirs = true}};
  return {"mesh_size",
          "Depth and width against mesh size",
          "Mean over 360 contours after 12 revolutions; bars are one standard deviation.",
          {depth, width},
          2};
}

Figure force_boxes() {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  Panel panel{.x = {.title = "revolution [-]"}, .y = {.title = "normal force [N]"}};
  for (int reading = 0; reading < 2; ++reading) {
    Series box{.kind = Kind::box, .name = reading ? "per triangle" : "patch", .colour = reading};
    for (int turn = 1; turn <= 12; ++turn) {
      for (int k = 0; k < 5000; ++k) {
        box.x.push_back(turn);
        box.y.push_back(5.0 + (0.02 + 0.01 * reading + 0.002 * turn) * normal(random));
      }
    }
    panel.series.push_back(box);
  }
  return {"forces",
          "Normal force in each revolution",
          "Boxes are quartiles, whiskers reach 1.5 quartile ranges.",
          {panel}};
}

Figure histograms() {
  Figure figure{"spread",
                "Depth over the contours",
                "Counts with the normal density of the same mean and deviation.",
                {},
                3};
  for (int turn = 1; turn <= 6; ++turn) {
    const auto bins = steps(8, 12, 21), fine = steps(8, 12, 81);
    const auto bell = [&](double x) { return 50 * std::exp(-2.0 * (x - 10) * (x - 10)); };
    figure.panels.push_back(
        {.title = fmt::format("Revolution {}", turn),
         .x = {.title = "depth [µm]"},
         .y = {.title = "contours [-]"},
         .series = {{.kind = Kind::bars,
                     .name = "contours",
                     .x = bins,
                     .y = of(bins, [&](double x) { return std::round(bell(x) + turn); })},
                    {.kind = Kind::line, .name = "normal", .x = fine, .y = of(fine, bell), .colour = 1}}});
  }
  return figure;
}

Series ring(Kind kind) {
  Series s{.kind = kind,
           .name = "wear",
           .x = steps(0, 359, 360),
           .y = steps(20, 24, 41),
           .z_title = "height [µm]",
           .polar = kind == Kind::surface,
           .z_unit = 1e-3};
  for (const double r : s.y) {
    for (const double a : s.x)
      s.z.push_back(std::abs(r - 22) < 0.4
                        ? -10 * (1 - std::pow((r - 22) / 0.4, 2)) * (1 + 0.1 * std::sin(a / 30))
                        : 0.0);
  }
  return s;
}

Figure heat_and_surface() {
  return {"disc",
          "The worn disc, unrolled and in 3D",
          "Height of the surface after 12 revolutions.",
          {{.title = "Unrolled",
            .x = {.title = "angle [°]"},
            .y = {.title = "radius [mm]"},
            .series = {ring(Kind::heat)}},
           {.title = "In 3D",
            .x = {.title = "angle [°]"},
            .y = {.title = "radius [mm]"},
            .series = {ring(Kind::surface)}}},
          1};
}

Figure many_points() {
  const auto x = steps(0, 24, 100000);
  auto y = of(x, [](double t) { return 5 + 0.1 * std::sin(40 * t); });
  y[51234] = 9.0;  // a spike of one sample must stay visible
  return {"trace",
          "A long record",
          "",
          {{.x = {.title = "time [s]"},
            .y = {.title = "force [N]"},
            .series = {{.kind = Kind::line, .name = "force <N>", .x = x, .y = y}}}}};
}

Figure nothing() {
  return {
      "nothing",
      "A figure without data",
      "Nothing was measured.",
      {{.x = {.title = "a [-]"}, .y = {.title = "b [-]"}, .series = {{.kind = Kind::line, .name = "none"}}}}};
}

Figure named_bars() {
  const std::vector<double> at{1, 2, 3};
  Panel panel{.x = {.title = "quantity [-]", .labels = {{1, "volume"}, {2, "depth"}, {3, "width"}}},
              .y = {.title = "discrepancy [%]"}};
  panel.series = {{.kind = Kind::bars, .name = "ours", .x = at, .y = {3, -5, 8}},
                  {.kind = Kind::bars, .name = "the paper's", .x = at, .y = {6, -9, 11}, .theirs = true}};
  return {"discrepancies", "Discrepancies from the test", "Model minus test, over test.", {panel}};
}

DataTable claims() {
  return {"claims",
          "Claims",
          "What the article states and what the runs give.",
          {"Claim", "Theirs", "Ours", "Verdict", "Why"},
          {{"Depth falls with mesh size", "12.1", "11.8 ± 0.3", "reproduced",
            "The trend and the value agree within the scatter of the contours of one revolution, which is "
            "0.3 µm."},
           {"Width <grows> & \"spreads\"", "0.75", "0.61", "trend only",
            "The width at 1 mm is governed by the size of an element."},
           {"Forces are independent of size", "–", "5.00", "not reproduced", ""},
           {"Colour of the disc", "–", "–", "not answered", "No run can say."}},
          {"runs/a/report.html", "", "", ""}};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: make_page <folder>\n");
    return static_cast<int>(abradem::ExitCode::input);
  }
  Page page{
      .title = "<script>alert(\"page\")</script> {{charts}} & every kind of figure",
      .summary = "A page for tests: 3 of 4 claims < \"all\".",
      .cards = {
          {"Reproduced", "41 of 69"}, {"Runs", "52"}, {"Slowest", "per_triangle at 0.1 mm, 12 revolutions"}}};
  page.sections = {{"Claims", {Paragraph{"Text & <markup> that is none."}, claims()}},
                   {"Mesh size", {lines_and_bands(), force_boxes()}},
                   {"Distributions", {histograms()}},
                   {"The disc", {heat_and_surface(), many_points(), nothing(), named_bars()}}};
  try {
    fmt::print("{}\n", write_page(argv[1], page).string());
    return 0;
  } catch (const abradem::Error& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return static_cast<int>(error.code());
  }
}
