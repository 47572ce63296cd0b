// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/report/paper_page.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <set>

#include "abradem/report/paper_claims.h"
#include "abradem/report/paper_figures.h"
#include "abradem/report/text.h"

namespace abradem::report {
namespace {

template <class Item>
void add(PageSection& section, std::optional<Item> item) {
  if (item) section.items.emplace_back(std::move(*item));
}

void add_verdicts(PageSection& section, const std::vector<JudgedClaim>& judged, const PaperRuns& runs,
                  const std::string& id, const std::vector<std::string>& shown) {
  DataTable table = reasons_table(judged, runs, id, shown);
  if (!table.rows.empty()) section.items.emplace_back(std::move(table));
}

/// Counts of the three verdicts in one reading.
std::array<int, 3> counts(const std::vector<JudgedClaim>& judged, std::size_t reading) {
  std::array<int, 3> out{};
  for (const JudgedClaim& claim : judged)
    if (claim.answers[reading]) ++out[static_cast<std::size_t>(claim.answers[reading]->verdict)];
  return out;
}

std::string count_text(const std::array<int, 3>& c) {
  return fmt::format("{} reproduced, {} in trend only, {} not", c[0], c[1], c[2]);
}

PageSection overview(const std::vector<JudgedClaim>& judged, const PaperRuns& runs) {
  PageSection section{"Verdicts", {}};
  section.items.emplace_back(
      Paragraph{"Two readings of the same study. The paper's rules: each triangle is a contact, all three "
                "nodes of a worn triangle move "
                "by its full depth (eq. 9), volume is the tally of eq. 10-12. Conserving: one contact patch "
                "whatever the mesh, and the "
                "mesh loses exactly what the wear law says. Nothing is tuned to the paper."});
  section.items.emplace_back(
      Paragraph{fmt::format("How verdicts are made, from the runs and the tolerance stated for each claim in "
                            "the file of published values: a number "
                            "is reproduced within its tolerance (10 % unless stated), in trend only within a "
                            "factor of {:.0f}; a range when both "
                            "ends are, in trend only when the ranges overlap; a trend when every step "
                            "follows it, in trend only when most do; a "
                            "curve when every value is within its tolerance, in trend only within a factor "
                            "of {:.0f} and bent the same way; p-values "
                            "when all lie on the same side of 5 %, in trend only when four in five do.",
                            study::kTrendFactor, study::kTrendFactor)});
  section.items.emplace_back(figures_table(judged, runs));
  section.items.emplace_back(claims_table(judged, runs));
  return section;
}

}  // namespace

Page paper_page(const simulation::Setup& study, std::span<const StudyRun> study_runs,
                const std::filesystem::path& output) {
  const PaperRuns runs = read_paper_runs(study, study_runs);
  const std::vector<JudgedClaim> judged = judge_claims(runs);
  Page page;
  page.title = study.title.empty() ? "Published study" : study.title;
  const std::array<int, 3> theirs = counts(judged, 0), ours = counts(judged, 1);
  page.summary = fmt::format(
      "Of the claims that runs can answer, the paper's own rules give {}; the volume-conserving rules {}. "
      "The source: {}.",
      count_text(theirs), count_text(ours), runs.published.source);
  const auto completed = std::ranges::count(study_runs, "completed", &StudyRun::status);
  double seconds = 0.0;
  std::set<std::filesystem::path> counted;
  for (const StudyRun& run : study_runs)
    if (counted.insert(run.folder).second) seconds += run.seconds;
  const auto is_figure = [](const PublishedClaim& claim) { return claim.kind == "figure"; };
  const auto figures =
      std::ranges::count_if(judged, [&](const JudgedClaim& j) { return is_figure(*j.claim); });
  page.cards = {
      {"claims of the paper", std::to_string(std::ssize(runs.published.claims) -
                                             std::ranges::count_if(runs.published.claims, is_figure))},
      {"that runs can answer", fmt::format("{}, and {} figures", std::ssize(judged) - figures, figures)},
      {runs.readings[0].name + ": reproduced",
       fmt::format("{} of {}", theirs[0], std::accumulate(theirs.begin(), theirs.end(), 0))},
      {runs.readings[1].name + ": reproduced",
       fmt::format("{} of {}", ours[0], std::accumulate(ours.begin(), ours.end(), 0))},
      {"runs", fmt::format("{} of {}", completed, study_runs.size())},
      {"time of all runs", fmt::format("{:.3g} s", seconds)}};
  page.sections.push_back(overview(judged, runs));

  PageSection mesh{"Mesh size", {}};
  add(mesh, fig07_mesh_size(runs));
  add(mesh, fig08_contours(runs));
  add_verdicts(mesh, judged, runs, "verdicts-mesh", {"Fig. 7", "Fig. 8"});

  PageSection force{"Normal force", {}};
  add(force, fig09_forces(runs));
  add_verdicts(force, judged, runs, "verdicts-force", {"Fig. 9"});

  PageSection spread{"Depth and width, revolution by revolution", {}};
  add(spread, fig10_depths(runs));
  add(spread, fig11_widths(runs));
  add(spread, fig12_depth_boxes(runs));
  add(spread, fig13_width_boxes(runs));
  add(spread, table3_normality(runs));
  add(spread, table3_figure(runs));
  for (std::string& sentence : normality_sensitivity(runs))
    spread.items.emplace_back(Paragraph{std::move(sentence)});
  for (const PaperReading& reading : runs.readings) add(spread, fig14_contours(reading, runs));
  add_verdicts(spread, judged, runs, "verdicts-spread",
               {"Fig. 10", "Fig. 11", "Fig. 12", "Fig. 13", "Fig. 14", "Table 3"});

  PageSection volume{"Volume and wear coefficient", {}};
  add(volume, fig15_volumes(runs));
  add(volume, fig15_ratio(runs));
  add(volume, fits_table(runs));
  add(volume, fig16_force_components(runs));
  add_verdicts(volume, judged, runs, "verdicts-volume", {"Fig. 15", "Fig. 16"});

  PageSection groove{"The groove, against the test", {}};
  add(groove, fig17_wear_profile(runs));
  add(groove, fig18_against_test(runs));
  add(groove, table4(runs));
  add_verdicts(groove, judged, runs, "verdicts-groove", {"Fig. 17", "Fig. 18", "Table 4"});

  for (PageSection* section : {&mesh, &force, &spread, &volume, &groove})
    if (!section->items.empty()) page.sections.push_back(std::move(*section));
  page.sections.push_back({"What no run can answer", {unanswered_table(judged, runs)}});
  page.sections.push_back(all_runs(study_runs, output));
  return page;
}

}  // namespace abradem::report
