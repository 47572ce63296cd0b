// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/report/report.h"

#include <algorithm>

#include "abradem/report/sections.h"
#include "abradem/report/sweep_table.h"
#include "run_fixture.h"

namespace abradem::report {
namespace {

using Report = RunFixture;

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_F(Report, IsOnePageThatLoadsNothing) {
  const std::filesystem::path page = write_report(folder_);
  EXPECT_EQ(page, folder_ / "report.html");
  const std::string html = read_text(page);
  EXPECT_TRUE(has(html, "<!DOCTYPE html>"));
  EXPECT_TRUE(has(html, "default-src 'none'"));
  for (const char* link : {" src=\"http", "href=\"http", "@import", "url("})
    EXPECT_FALSE(has(html, link)) << link;
  EXPECT_FALSE(has(html, "{{"));
  for (const auto& entry : std::filesystem::directory_iterator(folder_))
    EXPECT_NE(entry.path().extension(), ".tmp") << entry.path();
}

TEST_F(Report, TextOfTheCaseIsNeverMarkup) {
  const std::string html = make_page(read_run_folder(folder_));
  EXPECT_TRUE(has(html, "<title>A &amp; B &lt;script&gt;alert(1)&lt;/script&gt;</title>"));
  EXPECT_TRUE(has(html, "&lt;/pre&gt;&lt;script&gt;alert(2)"));
  EXPECT_FALSE(has(html, "<script>alert"));
}

TEST_F(Report, PlacesOfTheTemplateInTheCaseStayText) {
  write_text(folder_ / "run.json", manifest(R"("case_title": "{{charts}}",)"));
  EXPECT_TRUE(has(make_page(read_run_folder(folder_)), "<h1>{{charts}}</h1>"));
}

TEST_F(Report, IsTheSameBytesEachTime) {
  write_report(folder_);
  const std::string first = read_text(folder_ / "report.html");
  write_report(folder_);
  EXPECT_EQ(read_text(folder_ / "report.html"), first);
}

TEST_F(Report, ComparesWithTheLaboratory) {
  write_text(
      folder_ / "run.json",
      manifest(
          R"("measurement": {"wear_volume_mm3": {"mean": 0.565, "sd": 0.089}, "depth_mm": {"low": 0.007, "high": 0.014},
                         "width_mm": {"low": 0.5, "high": 0.7}, "revolutions": 1302.5},)"));
  const std::string cards = verdict_cards(read_run_folder(folder_));
  EXPECT_TRUE(has(cards, "below the measured range"));
  EXPECT_TRUE(has(cards, "inside the measured range"));
  EXPECT_TRUE(has(cards, "above the measured range"));
  EXPECT_TRUE(has(cards, "Laboratory: 0.565 ± 0.089 mm³, after 1302.5 rev"));
  EXPECT_TRUE(has(cards, "Laboratory: 7.0 to 14 µm"));
}

TEST_F(Report, StatesLimitsWarningsAndTheWholeSeed) {
  write_text(
      folder_ / "run.json",
      manifest(
          R"("limits": [{"name": "overlap", "value": 0.2, "limit": "10 %", "ok": false}], "warnings": ["<b>"],)"));
  const RunFolder run = read_run_folder(folder_);
  EXPECT_TRUE(has(limits_and_warnings(run), "exceeded"));
  EXPECT_TRUE(has(limits_and_warnings(run), "<li>&lt;b&gt;</li>"));
  EXPECT_TRUE(has(record_table(run), "18446744073709551615"));
}

TEST_F(Report, NamesTheFolderWhenTheRunHasNoTitle) {
  write_text(folder_ / "run.json", manifest(""));
  EXPECT_EQ(page_title(read_run_folder(folder_)), "Run in " + folder_.filename().string());
  EXPECT_EQ(page_title(read_run_folder(folder_ / "")), "Run in " + folder_.filename().string());
}

TEST_F(Report, EachMissingFileIsNamed) {
  for (const char* name : {"run.json", "case.resolved.toml", "tables/revolutions.csv", "tables/contours.csv",
                           "tables/profiles.csv", "tables/force.csv"}) {
    const std::string content = read_text(folder_ / name);
    std::filesystem::remove(folder_ / name);
    const std::string message = io_error([&] { write_report(folder_); });
    EXPECT_TRUE(has(message, (folder_ / name).string() + ": no such file")) << name << ": " << message;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "report.html"));
    write_text(folder_ / name, content);
  }
}

TEST_F(Report, AMissingFolderIsNamed) {
  EXPECT_TRUE(has(io_error([&] { write_report(folder_ / "none"); }), "none: no such folder"));
}

TEST_F(Report, ADamagedManifestIsExplained) {
  write_text(folder_ / "run.json", "{\"status\": ");
  EXPECT_TRUE(has(io_error([&] { write_report(folder_); }), "run.json: not valid JSON at byte"));
  write_text(folder_ / "run.json", "[]");
  EXPECT_TRUE(has(io_error([&] { write_report(folder_); }), "expected an object"));
  write_text(folder_ / "run.json", "{\"status\": \"completed\", \"exit_code\": \"none\"}");
  EXPECT_TRUE(
      has(io_error([&] { write_report(folder_); }), "key 'exit_code' is \"none\", expected a whole number"));
  std::string text = manifest("");
  text.replace(text.find("\"kappa\": 1.0"), 12, "\"kapa\": 1.0");
  write_text(folder_ / "run.json", text);
  EXPECT_TRUE(has(io_error([&] { write_report(folder_); }), "key 'ledger.kappa' is missing"));
}

TEST_F(Report, ADamagedSeriesIsAnErrorAndNoSeriesIsNot) {
  EXPECT_TRUE(has(read_run_folder(folder_).surface_note, "no frames"));
  write_text(folder_ / "series.pvd",
             "<VTKFile type=\"Collection\"><Collection><DataSet timestep=\"0\" file=\"vtk/a.vtp\"/>");
  EXPECT_TRUE(has(io_error([&] { (void)read_run_folder(folder_); }), "a.vtp: no such file"));
}

TEST_F(Report, ShowsParticlesInsteadOfAGrooveWhereARunHasThemInNumbers) {
  std::string html = make_page(read_run_folder(folder_));
  EXPECT_FALSE(has(html, ">Particles<"));
  EXPECT_TRUE(has(html, ">The groove<"));

  write_text(
      folder_ / "tables/particles.csv",
      "time_s,particles,mass_kg,inserted,removed,removed_mass_kg,contacts,wall_contacts,kinetic_energy_J,"
      "elastic_energy_J,fastest_m_per_s\n"
      "0,100,1,100,0,0,0,0,0,0,0\n0.5,80,0.8,100,20,0.2,150,12,0.01,0.002,1.5\n");
  EXPECT_TRUE(has(make_page(read_run_folder(folder_)), ">The groove<"));  // a guided pin among them
  const std::string force = read_text(folder_ / "tables/force.csv");
  write_text(folder_ / "tables/force.csv", force.substr(0, force.find('\n') + 1));
  html = make_page(read_run_folder(folder_));
  EXPECT_TRUE(has(html, "At 0.5000 s the run holds 80 particles of 0.8000 kg in 150 contacts"));
  EXPECT_TRUE(has(html, "20 left it, 0.2000 kg"));
  EXPECT_TRUE(has(html, "<b>Figure 4.</b>"));
  EXPECT_FALSE(has(html, ">The groove<"));
  EXPECT_FALSE(has(html, ">Groove depth<"));
  write_report(folder_);
  EXPECT_TRUE(has(read_text(folder_ / "tables/mass-flow.csv"), "0.4"));  // kg/s
  EXPECT_TRUE(has(html, "20 particles; 0.4000 kg/s on average since 0 s"));
  EXPECT_TRUE(has(html, "After 1 revolution the walls have lost "));
  EXPECT_TRUE(has(html, "<b>Figure 1.</b> <b>Wear volume.</b>"));

  // A table of runs has them too, where one has.
  const SweepTable sweep = make_sweep_table({"a"}, {{"0001", "completed", {"1"}, folder_}});
  const auto of_run = [&](const char* column) {
    const auto found = std::ranges::find(sweep.results, column, &SweepColumn::title);
    return found == sweep.results.end() ? -1.0 : found->number[0];
  };
  EXPECT_EQ(of_run("particles"), 80.0);
  EXPECT_DOUBLE_EQ(of_run("outflow_kg_per_s"), 0.4);

  // Walls that keep their shape; then nothing worn; then a run that failed.
  std::string text = manifest("");
  const auto with = [&](const std::string& was, const std::string& is) {
    text.replace(text.find(was), was.size(), is);
    write_text(folder_ / "run.json", text);
    return make_page(read_run_folder(folder_));
  };
  html = with("\"kappa\": 1.0", "\"kappa\": 0.0");
  EXPECT_TRUE(has(html, "the wear laws have taken 0.05000 mm³ from walls that keep their shape"));
  EXPECT_FALSE(has(html, "κ, mesh over law"));
  html = with("\"law_volume_mm3\": 0.05", "\"law_volume_mm3\": 0.0");
  EXPECT_TRUE(has(html, "After 1 revolution no wall has worn."));
  EXPECT_FALSE(has(html, "Wear volume"));
  html = with("\"completed\"", "\"failed\", \"error\": \"particle 7 is <gone>\"");
  EXPECT_TRUE(has(html, "The run failed: particle 7 is &lt;gone&gt;. What follows is the last good state."));
}

TEST_F(Report, ShowsThePinAndTheRidgesOnlyWhereThereAreSome) {
  EXPECT_FALSE(has(make_page(read_run_folder(folder_)), "The worn pin"));
  EXPECT_FALSE(has(make_page(read_run_folder(folder_)), "The ridges"));

  write_text(folder_ / "tables/ridges.csv",
             "revolution,groove_volume_mm3,removed_volume_mm3,displaced_volume_mm3,piled_volume_mm3,"
             "ridge_height_mean_mm,ridge_height_sd_mm,ridge_area_mean_mm2,groove_area_mean_mm2\n"
             "1,0.1,0.06,0.04,0.04,0.005,0.001,0.0003,0.001\n");
  std::string html = make_page(read_run_folder(folder_));
  EXPECT_TRUE(has(html, ">The ridges<"));
  EXPECT_TRUE(has(html,
                  "60.0 % was lost and the rest moved aside; the ridges are 5.00 µm high, and their "
                  "section is 30.0 % of the groove"));
  EXPECT_FALSE(has(html, "Wear of the pin"));

  write_text(
      folder_ / "tables/tip.csv",
      "revolution,particle,law_volume_mm3,deposited_volume_mm3,removed_volume_mm3,mass_ug,recession_um,"
      "flat_along_mm,flat_across_mm,map_cell_um\n"
      "1,0,0.002,0.002,0.002,9.7,20,0.5,0.7,15\n1,1,0.001,0.001,0.00099,4.8,15,0.4,0.6,15\n");
  html = make_page(read_run_folder(folder_));
  EXPECT_TRUE(has(html, ">The worn pin and the ridges<"));
  EXPECT_TRUE(has(html, "Pin 1 lost 9.70 µg and stands on a flat of 0.500 by 0.700 mm"));
  EXPECT_TRUE(has(html, "Pin 2 lost 4.80 µg"));
  EXPECT_TRUE(has(html, "0.010 [-]"));         // the second pin's map lacks less than the law took
  EXPECT_FALSE(has(html, "The worn end of"));  // a run that was stopped has no profile yet

  write_text(folder_ / "tables/tip_profile.csv",
             "particle,distance_mm,sphere_um,recession_along_um,recession_across_um\n"
             "0,-1,160,0,0\n0,0,0,20,20\n0,1,160,0,0\n1,-1,160,0,0\n1,0,0,15,15\n1,1,160,0,0\n");
  write_report(folder_);
  EXPECT_TRUE(has(read_text(folder_ / "report.html"), "The worn end of the pin"));
  const std::string profile = read_text(folder_ / "tables/tip-profile.csv");
  EXPECT_TRUE(has(profile, "Pin 2"));
  EXPECT_TRUE(has(profile, ",0,20"));

  write_text(folder_ / "tables/tip.csv", "revolution,particle\n1,0\n");
  EXPECT_TRUE(has(io_error([&] { (void)read_run_folder(folder_); }), "tip.csv"));
}

TEST_F(Report, AnUnwritablePageIsNamed) {
  std::filesystem::create_directories(folder_ / "report.html/inside");
  EXPECT_TRUE(has(io_error([&] { write_report(folder_); }), "report.html': "));
}

}  // namespace
}  // namespace abradem::report
