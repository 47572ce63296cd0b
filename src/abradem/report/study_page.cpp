// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/report/study_page.h"

#include <fmt/core.h>

#include <algorithm>

#include "abradem/report/paper_page.h"
#include "abradem/report/scaling_page.h"
#include "abradem/report/sweep_table.h"
#include "abradem/report/text.h"

namespace abradem::report {
namespace {

/// The value as a reader wants it: text without its quotes.
std::string plain(const std::string& toml) {
  return toml.size() >= 2 && toml.front() == '"' ? toml.substr(1, toml.size() - 2) : toml;
}

SweepTable table_of(const simulation::VariationSetup& variation, std::span<const StudyRun> runs) {
  std::vector<std::string> keys;
  for (const auto* list : {&variation.together, &variation.vary})
    for (const simulation::VariedKey& key : *list) keys.push_back(key.key);
  std::vector<SweepRun> rows;
  for (const StudyRun& run : runs) {
    if (run.variation != variation.name) continue;
    SweepRun row{run.name, run.status, {}, run.folder};
    for (const auto& [key, value] : run.varied) row.values.push_back(plain(value));
    rows.push_back(std::move(row));
  }
  return make_sweep_table(keys, rows);
}

DataTable results_table(const std::string& variation, const SweepTable& table) {
  DataTable out{variation + "-results",
                "Results",
                "The end of each run: what was varied, and the last row of its revolutions.csv.",
                {"run"},
                {},
                {}};
  for (const auto* columns : {&table.factors, &table.results})
    for (const SweepColumn& column : *columns) out.columns.push_back(column.title);
  for (std::size_t r = 0; r < table.names.size(); ++r) {
    std::vector<std::string> row{table.names[r]};
    for (const SweepColumn& column : table.factors) row.push_back(column.text[r]);
    for (const SweepColumn& column : table.results)
      row.push_back(column.number.empty() ? column.text[r] : readable(column.number[r], 4));
    out.rows.push_back(std::move(row));
  }
  return out;
}

Page table_page(const simulation::Setup& setup, std::span<const StudyRun> runs,
                const std::filesystem::path& output) {
  Page page;
  page.title = setup.title.empty() ? "Study" : setup.title;
  const auto completed = std::ranges::count(runs, "completed", &StudyRun::status);
  page.summary = fmt::format("{} of {} runs completed.", completed, runs.size());
  page.cards = {{"runs", readable_count(static_cast<long long>(runs.size()))},
                {"completed", readable_count(completed)}};
  for (const simulation::VariationSetup& variation : setup.study->variations) {
    const SweepTable table = table_of(variation, runs);
    PageSection section{variation.name, {}};
    section.items.emplace_back(results_table(variation.name, table));
    page.sections.push_back(std::move(section));
  }
  page.sections.push_back(all_runs(runs, output));
  return page;
}

DataTable runs_table(std::span<const StudyRun> runs, const std::filesystem::path& output) {
  DataTable table{
      "study-runs",
      "Runs of the study",
      "What each run changes in the case, how it ended, and its time. The name leads to its folder.",
      {"run", "changes", "status", "time [s]"},
      {},
      {}};
  for (const StudyRun& run : runs) {
    std::string changes;
    for (const auto& [key, value] : run.varied)
      changes += fmt::format("{}{} = {}", changes.empty() ? "" : ", ", key, plain(value));
    table.rows.push_back({run.name, changes,
                          run.message.empty() ? run.status : fmt::format("{}: {}", run.status, run.message),
                          readable(run.seconds, 3)});
    table.links.push_back(std::filesystem::relative(run.folder, output).generic_string() + "/run.json");
  }
  return table;
}

/// "mesh_size/03 failed: …" of each run that did not complete, as one text; empty where all did.
std::string gaps(std::span<const StudyRun> runs) {
  std::string text;
  for (const StudyRun& run : runs)
    if (run.status != "completed")
      text += fmt::format("{}{} {}{}{}", text.empty() ? "" : "; ", run.name, run.status,
                          run.message.empty() ? "" : ": ", run.message);
  return text;
}

}  // namespace

PageSection all_runs(std::span<const StudyRun> runs, const std::filesystem::path& output) {
  PageSection all{"All runs", {}};
  if (const std::string missing = gaps(runs); !missing.empty())
    all.items.emplace_back(Paragraph{"Not completed: " + missing});
  all.items.emplace_back(runs_table(runs, output));
  return all;
}

Page study_page(const simulation::Setup& study, std::span<const StudyRun> runs,
                const std::filesystem::path& output) {
  switch (study.study->page) {
    case simulation::StudyPage::paper:
      return paper_page(study, runs, output);
    case simulation::StudyPage::scaling:
      return scaling_page(study, runs, output);
    case simulation::StudyPage::table:
      break;
  }
  return table_page(study, runs, output);
}

}  // namespace abradem::report
