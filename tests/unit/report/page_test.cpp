// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/report/page.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "abradem/report/figure_data.h"
#include "run_fixture.h"

namespace abradem::report {
namespace {

using Kind = Series::Kind;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string internal_error(const Page& page) {
  try {
    (void)page_html(page);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::internal);
    return error.what();
  }
  return {};
}

Figure one_panel(std::vector<Series> series) {
  return {.id = "f",
          .title = "F",
          .panels = {{.x = {.title = "mesh size [mm]"},
                      .y = {.title = "wear depth [µm]"},
                      .series = std::move(series)}}};
}

Page with(std::vector<std::variant<Paragraph, DataTable, Figure>> items) {
  return {.title = "T", .sections = {{.title = "S", .items = std::move(items)}}};
}

TEST(ColumnName, CarriesTheUnitInPlainLetters) {
  EXPECT_EQ(column_name("wear depth [µm]"), "wear_depth_um");
  EXPECT_EQ(column_name("volume [mm³]"), "volume_mm3");
  EXPECT_EQ(column_name("angle [°]"), "angle_deg");
  EXPECT_EQ(column_name("wear coefficient α_s [1/Pa]"), "wear_coefficient_alpha_s_1_per_Pa");
  EXPECT_EQ(column_name("contours [-]"), "contours");
  EXPECT_EQ(column_name("[-]"), "");
}

TEST(CsvField, IsQuotedWhereItMustBe) {
  EXPECT_EQ(csv_field("fit, 2 h"), "\"fit, 2 h\"");
  EXPECT_EQ(csv_field("a \"b\""), "\"a \"\"b\"\"\"");
  EXPECT_EQ(csv_field("plain"), "plain");
}

TEST(FigureCsv, HasARowPerPointWithTheAxesAsColumns) {
  const Figure figure = one_panel({{.kind = Kind::markers,
                                    .name = "a, b",
                                    .x = {0.1, 0.2},
                                    .y = {12.5, kNaN},
                                    .y_low = {12, 11},
                                    .y_high = {13, 12}},
                                   {.kind = Kind::line, .x = {1.0 / 3.0}, .y = {2}}});
  EXPECT_EQ(figure_csv(figure, 0),
            "panel,series,mesh_size_mm,wear_depth_um,wear_depth_um_low,wear_depth_um_high\n"
            "1,\"a, b\",0.1,12.5,12,13\n1,\"a, b\",0.2,nan,11,12\n1,,0.3333333333333333,2,nan,nan\n");
  EXPECT_TRUE(has(figure_csv(figure, 3), "1,,0.333,2,"));
}

TEST(FigureCsv, NamesAxesPlainlyWherePanelsDiffer) {
  Figure figure = one_panel({});
  figure.panels.push_back({.x = {.title = "revolution [-]"}, .y = {.title = "wear depth [µm]"}});
  EXPECT_EQ(figure_csv(figure, 0), "panel,series,x,wear_depth_um\n");
  figure.panels = {{.x = {.title = "theirs [mm]"}, .y = {.title = "theirs [mm]"}}};
  EXPECT_EQ(figure_csv(figure, 0), "panel,series,x,y\n");
}

TEST(FigureCsv, WritesAGridRowByRow) {
  const Figure figure = one_panel(
      {{.kind = Kind::heat, .x = {1, 2}, .y = {10, 20}, .z = {5, 6, 7, kNaN}, .z_title = "depth [µm]"}});
  EXPECT_EQ(
      figure_csv(figure, 0),
      "panel,series,mesh_size_mm,wear_depth_um,depth_um\n1,,1,10,5\n1,,2,10,6\n1,,1,20,7\n1,,2,20,nan\n");
}

TEST(Boxes, AreQuartilesWhiskersAndOutliers) {
  // 0 … 8 and 30: quartiles of type 7 are 2.25, 4.5, 6.75; a whisker reaches at most 6.75 + 1.5 * 4.5 = 13.5.
  Series series{.kind = Kind::box};
  for (const double v : {30., 0., 1., 2., 3., 4., 5., 6., 7., 8.}) {
    series.x.push_back(2);
    series.y.push_back(v);
  }
  series.x.insert(series.x.end(), {1, 1});
  series.y.insert(series.y.end(), {kNaN, 7});
  const std::vector<Box> all = boxes(series);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].count, 1u);
  EXPECT_EQ(all[0].median, 7);
  EXPECT_DOUBLE_EQ(all[1].lower_quartile, 2.25);
  EXPECT_DOUBLE_EQ(all[1].median, 4.5);
  EXPECT_DOUBLE_EQ(all[1].upper_quartile, 6.75);
  EXPECT_EQ(all[1].low, 0);
  EXPECT_EQ(all[1].high, 8);
  EXPECT_EQ(all[1].outliers, std::vector<double>{30});
}

TEST(Thinned, KeepsExtremesGapsAndEnds) {
  Series line{.kind = Kind::line};
  for (int k = 0; k < 100000; ++k) {
    line.x.push_back(k);
    line.y.push_back(std::sin(0.01 * k));
  }
  line.y[31234] = 7;
  line.y[61111] = -7;
  line.y[80000] = kNaN;
  const Figure full = one_panel({line}), thin = thinned(full, 5000);
  const Series& kept = thin.panels[0].series[0];
  EXPECT_LE(kept.x.size(), 5100u);
  EXPECT_GE(kept.x.size(), 4000u);
  EXPECT_EQ(kept.x.size(), kept.y.size());
  EXPECT_EQ(kept.x.front(), 0);
  EXPECT_EQ(kept.x.back(), 99999);
  EXPECT_TRUE(std::is_sorted(kept.x.begin(), kept.x.end()));
  EXPECT_EQ(std::count(kept.y.begin(), kept.y.end(), 7), 1);
  EXPECT_EQ(std::count(kept.y.begin(), kept.y.end(), -7), 1);
  EXPECT_EQ(std::count_if(kept.y.begin(), kept.y.end(), [](double y) { return std::isnan(y); }), 1);
  EXPECT_EQ(row_count(thinned(full, 100000)), 100000u);
}

TEST(Thinned, KeepsTheBordersOfAGrid) {
  Series grid{.kind = Kind::heat, .z_title = "z [µm]"};
  for (int k = 0; k < 400; ++k) grid.x.push_back(k);
  for (int k = 0; k < 300; ++k) grid.y.push_back(k);
  for (int r = 0; r < 300; ++r) {
    for (int c = 0; c < 400; ++c) grid.z.push_back(1000 * r + c);
  }
  const Figure thin = thinned(one_panel({grid}), 10000);
  const Series& kept = thin.panels[0].series[0];
  EXPECT_LE(kept.z.size(), 31000u);
  ASSERT_EQ(kept.z.size(), kept.x.size() * kept.y.size());
  EXPECT_EQ(kept.x.back(), 399);
  EXPECT_EQ(kept.y.back(), 299);
  EXPECT_EQ(kept.z.back(), 299399);
  EXPECT_EQ(kept.z[kept.x.size()], 1000 * kept.y[1]);
}

TEST(FigureJson, DescribesWhatIsDrawnFromWhichRows) {
  Figure figure = one_panel(
      {{.kind = Kind::markers, .name = "Yan <2022>", .x = {1, 2}, .y = {3, 4}, .colour = 2, .theirs = true}});
  figure.panels[0].x.log = true;
  figure.panels[0].y.range = {{0, kNaN}};
  const std::string json = figure_json(figure, figure, 4);
  EXPECT_TRUE(has(json, R"("number":4,"id":"f","title":"F")"));
  EXPECT_TRUE(has(json, R"("roles":["panel","series","x","y"])"));
  EXPECT_TRUE(has(
      json, R"("kind":"markers","name":"Yan \u003c2022>","colour":2,"dash":"solid","theirs":true,"rows":2)"));
  EXPECT_TRUE(has(json, R"("title":"mesh size [mm]","log":true)"));
  EXPECT_TRUE(has(json, R"("range":[0,null])"));
}

TEST(PageHtml, NumbersFiguresAndTablesAndNeverTakesTextForMarkup) {
  Page page = with(
      {Paragraph{"<b>&"}, one_panel({}),
       DataTable{.id = "t", .title = "<i>", .columns = {"a", "Verdict"}, .rows = {{"<u>", "trend only"}}}});
  page.title = "<script>alert(1)</script> {{data}}";
  page.cards = {{"<label>", "1 < 2"}};
  Figure second = one_panel({{.kind = Kind::line, .name = "</script>", .x = {1}, .y = {1}}});
  second.id = "g";
  second.caption = "</figcaption>";
  page.sections.push_back({.title = "<h2>", .items = {second}});
  const std::string html = page_html(page);
  EXPECT_TRUE(has(html, "<title>&lt;script&gt;alert(1)&lt;/script&gt; {{data}}</title>"));
  EXPECT_FALSE(has(html, "<script>alert"));
  EXPECT_TRUE(has(html, "<b>Figure 1.</b> <b>F.</b>"));
  EXPECT_TRUE(has(html, "<b>Figure 2.</b> <b>F.</b> &lt;/figcaption&gt;"));
  EXPECT_TRUE(has(html, "<b>Table 1.</b> <b>&lt;i&gt;.</b>"));
  EXPECT_TRUE(has(html, "<p class=\"text\">&lt;b&gt;&amp;</p>"));
  EXPECT_TRUE(has(html, "<td>&lt;u&gt;</td>"));
  EXPECT_TRUE(has(html, "class=\"mark partly\""));
  EXPECT_TRUE(has(html, "<h3>&lt;label&gt;</h3><p class=\"value\">1 &lt; 2</p>"));
  EXPECT_TRUE(has(html, "<h2 id=\"section-2\">&lt;h2&gt;</h2>"));
  EXPECT_TRUE(has(html, "default-src 'none'"));
  EXPECT_FALSE(has(html, "<nav"));
}

TEST(PageHtml, AlignsColumnsOfNumbersToTheRight) {
  const std::string html =
      page_html(with({DataTable{.id = "t",
                                .columns = {"n", "mixed"},
                                .rows = {{"−1.5 ± 0.2", "3 of 4"}, {"–", "none"}, {"2 × 10⁻³", ""}}}}));
  EXPECT_TRUE(has(html, "<th scope=\"col\" class=\"number\">n</th><th scope=\"col\">mixed</th>"));
}

TEST(PageHtml, ALongPageHasContents) {
  Page page = with({});
  for (int s = 0; s < 4; ++s) {
    Figure figure = one_panel({});
    figure.id = "f" + std::to_string(s);
    page.sections.push_back({.title = "Part", .items = {figure}});
  }
  const std::string html = page_html(page);
  EXPECT_TRUE(has(html, "<nav class=\"contents\""));
  EXPECT_TRUE(has(html, "<a href=\"#section-5\">Part</a>"));
  EXPECT_TRUE(has(html, "<a href=\"#fig-f3\">Figure 4</a> F"));
}

TEST(PageHtml, RefusesDataThatContradictThemselves) {
  const Series good{.kind = Kind::markers, .name = "n", .x = {1, 2}, .y = {1, 2}};
  const auto error = [](const Series& s) { return internal_error(with({one_panel({s})})); };
  EXPECT_EQ(error(good), "");
  Series bad = good;
  bad.y = {1};
  EXPECT_EQ(error(bad), "figure 'f', panel 1, series 1 ('n'): 2 values of x and 1 of y");
  bad = good;
  bad.y_low = {0, 0};
  EXPECT_TRUE(has(error(bad), "2 lower and 0 upper edges"));
  bad = good;
  bad.theirs = true;
  bad.name = "";
  EXPECT_TRUE(has(error(bad), "must have a name"));
  bad = good;
  bad.kind = Kind::heat;
  bad.z_title = "z [µm]";
  bad.z = {1, 2, 3};
  EXPECT_TRUE(has(error(bad), "3 values of z over 2 columns and 2 rows"));
  bad = good;
  bad.colour = 8;
  EXPECT_TRUE(has(error(bad), "colour 8; expected 0 to 7"));
  bad = good;
  bad.kind = Kind::band;
  EXPECT_TRUE(has(error(bad), "2 values of x and 0 of y"));
  EXPECT_TRUE(has(internal_error(with({one_panel({}), one_panel({})})), "have the id 'f'"));
  Figure figure = one_panel({});
  figure.id = "../f";
  EXPECT_TRUE(has(internal_error(with({figure})), "id '../f'"));
  EXPECT_TRUE(has(internal_error(with({DataTable{.id = "t", .columns = {"a"}, .rows = {{"1", "2"}}}})),
                  "row 1 has 2 cells, the header 1"));
  EXPECT_TRUE(has(internal_error(with({DataTable{
                      .id = "t", .columns = {"a"}, .rows = {{"1"}}, .links = {"javascript:alert(1)"}}})),
                  "expected a path relative"));
}

class WritePage : public RunFixture {};

TEST_F(WritePage, LeavesTheTablesAndTheirDescriptionBesideThePage) {
  std::filesystem::remove_all(folder_);
  const Page page = with({one_panel({{.kind = Kind::line, .name = "a", .x = {1}, .y = {2}}}),
                          DataTable{.id = "t", .columns = {"a", "b"}, .rows = {{"1,5", "x"}}}});
  EXPECT_EQ(write_page(folder_, page), folder_ / "report.html");
  EXPECT_EQ(read_text(folder_ / "tables/f.csv"), "panel,series,mesh_size_mm,wear_depth_um\n1,a,1,2\n");
  EXPECT_EQ(read_text(folder_ / "tables/t.csv"), "a,b\n\"1,5\",x\n");
  EXPECT_TRUE(has(read_text(folder_ / "tables/figures.json"), R"([{"number":1,"id":"f")"));
  EXPECT_EQ(read_text(folder_ / "report.html"), page_html(page));
}

TEST_F(WritePage, WritesNothingOfABadPage) {
  std::filesystem::remove_all(folder_);
  Page page = with({one_panel({}), one_panel({})});
  EXPECT_THROW(write_page(folder_, page), Error);
  EXPECT_FALSE(std::filesystem::exists(folder_));
}

TEST_F(WritePage, NamesAFolderThatCannotBeMade) {
  write_text(folder_ / "file", "");
  EXPECT_TRUE(has(io_error([&] { write_page(folder_ / "file", with({})); }), "cannot make the folder"));
}

}  // namespace
}  // namespace abradem::report
