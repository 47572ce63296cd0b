// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "abradem/report/paper_claims.h"
#include "abradem/report/text.h"

namespace abradem::report {
namespace {

/// As somebody would write it, without zeros at its end.
std::string number_text(double x) {
  const double size = std::abs(x);
  return x == 0.0 || (size >= 1e-4 && size < 1e5) ? fmt::format("{:.6g}", x) : readable(x, 2);
}

std::string where_text(const PublishedClaim& claim) {
  std::string text = claim.quantity;
  if (!claim.conditions.empty()) text += fmt::format("; {}", claim.conditions);
  return text;
}

/// The verdict on each reading, as text for a cell.
std::string verdict_of(const std::optional<ClaimAnswer>& answer) {
  return answer ? verdict_text(answer->verdict) : "not run";
}

const simulation::MaterialSetup* material(const simulation::Setup& setup, bool abrader) {
  if (setup.wear.empty()) return nullptr;
  const std::string& name = abrader ? setup.wear.front().abrader : setup.wear.front().worn;
  const auto found = std::ranges::find(setup.materials, name, &simulation::MaterialSetup::name);
  return found == setup.materials.end() ? nullptr : &*found;
}

/// A number of the case that stands for an input of the paper, in the paper's unit; nothing where there is
/// none.
std::optional<double> input_of(const std::string& id, const PaperRuns& runs) {
  const simulation::Setup& setup = runs.setup;
  const auto *pin = material(setup, true), *disc = material(setup, false);
  const auto* wall = setup.walls.empty() ? nullptr : &setup.walls.front();
  const auto* sphere = setup.particles.empty() ? nullptr : &setup.particles.front();
  const auto* contact = setup.contacts.empty() ? nullptr : &setup.contacts.front();
  if (pin == nullptr || disc == nullptr || wall == nullptr || sphere == nullptr || contact == nullptr)
    return {};
  if (id == "S01") return 1e3 * sphere->radius;
  if (id == "S04") return pin->density;
  if (id == "S05") return disc->density;
  if (id == "S06a" && disc->hardness) return *disc->hardness / 9806650.0;
  if (id == "S07") return runs.load;
  if (id == "S10") return runs.passes_test;
  if (id == "S11") return 1e3 * runs.track;
  if (id == "S13") return 1e3 * wall->mesh.outer;
  if (id == "S14") return pin->poisson_ratio;
  if (id == "S15") return 1e-9 * pin->shear_modulus;
  if (id == "S16") return disc->poisson_ratio;
  if (id == "S17") return 1e-9 * disc->shear_modulus;
  if (id == "S18") return 1e3 * wall->mesh.size;
  if (id == "S19") return contact->restitution;
  if (id == "S20") return contact->static_friction;
  if (id == "S21") return contact->rolling_friction;
  if (id == "S22") return wall->motion.rate * 180.0 / std::numbers::pi;
  if (id == "S23") return setup.wear.front().wear_coefficient;
  if (id == "S24" && !setup.run.time_step.of_rayleigh) return setup.run.time_step.value;
  if (id == "S26") return setup.output.contours;
  if (id == "S09" && std::isfinite(runs.passes_test))
    return runs.passes_test * 2.0 * std::numbers::pi * runs.track;
  return {};
}

struct Status {
  std::string ours, status;
};

Status status_of(const PublishedClaim& claim, const PaperRuns& runs) {
  if (claim.rule == "literature") return {"–", "literature: no run can answer"};
  if (claim.rule == "choice") return {"–", "a choice, made by the runs' length"};
  if (claim.id == "S25")
    return {fmt::format("{} sizes",
                        std::max(runs.readings[0].mesh_sizes.size(), runs.readings[1].mesh_sizes.size())),
            "input: the sizes run"};
  if (claim.id == "S27") return {"1 deg", "input: 360 sections fill the turn at 1° (decision 002)"};
  if (const auto ours = input_of(claim.id, runs); ours && claim.numbers.size() == 1) {
    const bool same = std::abs(*ours - claim.numbers.front()) <= 1e-3 * std::abs(claim.numbers.front());
    return {number_text(*ours), same ? "input: the same" : "input: differs"};
  }
  if (claim.id == "S06b") return {"–", "input: the text says 143 (decision 001)"};
  if (claim.id == "S08") return {"–", "laboratory: speed does not enter Archard's law (decision 011)"};
  return {"–", "laboratory fact: no run can answer"};
}

}  // namespace

std::string theirs_text(const PublishedClaim& claim) {
  if (!claim.words.empty()) return claim.words;
  const std::string unit = claim.unit == "-" ? "" : " " + claim.unit;
  const auto text = number_text;
  if (claim.rule == "curve" && claim.numbers.size() == 4)
    return fmt::format("{} + {} n + {} n² mm³", text(claim.numbers[0]), text(claim.numbers[1]),
                       text(claim.numbers[2]));
  if (claim.id.starts_with('T') && claim.numbers.size() == 3)
    return fmt::format("{} {}, {} % from the test", text(claim.numbers[1]),
                       claim.unit.substr(0, claim.unit.find(',')), text(claim.numbers[2]));
  if (claim.numbers.size() == 2 && claim.rule != "above")
    return fmt::format("{} to {}{}", text(claim.numbers[0]), text(claim.numbers[1]), unit);
  std::string list;
  for (const double x : claim.numbers) list += (list.empty() ? "" : ", ") + text(x);
  return list + unit;
}

DataTable claims_table(const std::vector<JudgedClaim>& judged, const PaperRuns& runs) {
  DataTable table{.id = "claims",
                  .title = "Claims that runs can answer",
                  .columns = {"claim", "what", "theirs", runs.readings[0].name, "verdict",
                              runs.readings[1].name, "verdict "}};
  table.caption =
      "Each verdict is on the column before it; the reasons stand in the sections below. E: measured in the "
      "laboratory; all "
      "others: results of the paper's model.";
  for (const JudgedClaim& claim : judged) {
    std::vector<std::string> row{claim.claim->id, claim.claim->quantity, theirs_text(*claim.claim)};
    for (const auto& answer : claim.answers) {
      row.push_back(answer ? answer->ours : "–");
      row.push_back(verdict_of(answer));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

DataTable reasons_table(const std::vector<JudgedClaim>& judged, const PaperRuns& runs, const std::string& id,
                        const std::vector<std::string>& shown) {
  DataTable table{.id = id,
                  .title = "Verdicts",
                  .columns = {"claim", "what", "theirs", "reading", "ours", "verdict", "why"}};
  for (const JudgedClaim& claim : judged) {
    if (std::ranges::find(shown, claim.claim->shown) == shown.end()) continue;
    for (std::size_t r = 0; r < runs.readings.size(); ++r) {
      const auto& answer = claim.answers[r];
      table.rows.push_back({claim.claim->id, claim.claim->quantity, theirs_text(*claim.claim),
                            runs.readings[r].name, answer ? answer->ours : "–", verdict_of(answer),
                            answer ? answer->why : "The runs that answer it are missing."});
    }
  }
  return table;
}

DataTable figures_table(const std::vector<JudgedClaim>& judged, const PaperRuns& runs) {
  DataTable table{.id = "figures-and-tables",
                  .title = "Every figure and table of the paper",
                  .columns = {"shown in", "claims", "verdict: " + runs.readings[0].name,
                              "verdict: " + runs.readings[1].name, "what decides"}};
  table.caption =
      "Reproduced where all claims that a figure or table shows are, not reproduced where none is even in "
      "trend, trend only "
      "between. What decides: the reason for the worst verdict by the paper's rules.";
  std::vector<std::string> shown;
  for (const JudgedClaim& claim : judged)
    if (!claim.claim->shown.empty() && std::ranges::find(shown, claim.claim->shown) == shown.end())
      shown.push_back(claim.claim->shown);
  const auto place = [](const std::string& s) {
    return std::pair{s.starts_with("Table"), std::stoi(s.substr(s.find_first_of("0123456789")))};
  };
  std::ranges::sort(shown, {}, place);
  for (const std::string& name : shown) {
    std::string ids, why;
    study::Verdict worst = study::Verdict::reproduced;
    std::array<std::vector<study::Verdict>, 2> verdicts;
    for (const JudgedClaim& claim : judged) {
      if (claim.claim->shown != name) continue;
      ids += (ids.empty() ? "" : ", ") + claim.claim->id;
      for (std::size_t r = 0; r < verdicts.size(); ++r)
        if (claim.answers[r]) verdicts[r].push_back(claim.answers[r]->verdict);
      if (const auto& answer = claim.answers[0]; answer && (why.empty() || answer->verdict > worst)) {
        worst = answer->verdict;
        why = answer->why;
      }
    }
    const auto verdict = [&](std::size_t r) {
      return verdicts[r].empty() ? std::string("not run") : verdict_text(study::together(verdicts[r]));
    };
    table.rows.push_back({name, ids, verdict(0), verdict(1), why});
  }
  return table;
}

DataTable unanswered_table(const std::vector<JudgedClaim>& judged, const PaperRuns& runs) {
  DataTable table{.id = "unanswered",
                  .title = "Claims that no run can answer",
                  .columns = {"claim", "what", "theirs", "in the case", "status", "where"}};
  table.caption = "Inputs are compared with what the case has; nothing is judged.";
  for (const PublishedClaim& claim : runs.published.claims) {
    if (std::ranges::any_of(judged, [&](const JudgedClaim& j) { return j.claim == &claim; })) continue;
    const Status status = status_of(claim, runs);
    table.rows.push_back(
        {claim.id, where_text(claim), theirs_text(claim), status.ours, status.status, claim.where});
  }
  return table;
}

}  // namespace abradem::report
