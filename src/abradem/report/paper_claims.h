// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "abradem/report/page.h"
#include "abradem/report/paper_runs.h"
#include "abradem/study/verdict.h"

/// What the paper claims, what our runs give, and the verdict: computed from the runs by the rule that the
/// file of published values names. docs/reference/study.md#verdicts
namespace abradem::report {

/// What the runs of one reading say to a claim.
struct ClaimAnswer {
  std::string ours;  ///< in the claim's unit
  study::Verdict verdict = study::Verdict::not_reproduced;
  std::string why;  ///< the reason in a sentence
};

struct JudgedClaim {
  const PublishedClaim* claim = nullptr;
  std::array<std::optional<ClaimAnswer>, 2> answers;  ///< of each reading; nothing where its runs are missing
};

/// Every claim that runs can answer, in the order of the file.
/// @throws IoError when the file names another rule for a claim than the one it is judged by, or too few
/// numbers
[[nodiscard]] std::vector<JudgedClaim> judge_claims(const PaperRuns& runs);

/// "reproduced", "trend only" or "not reproduced", as page.h shows as badges.
[[nodiscard]] std::string verdict_text(study::Verdict verdict);
/// The claim's value with its unit.
[[nodiscard]] std::string theirs_text(const PublishedClaim& claim);

/// All judged claims: theirs, ours, verdict, in both readings.
[[nodiscard]] DataTable claims_table(const std::vector<JudgedClaim>& judged, const PaperRuns& runs);
/// The reasons, one row per claim and reading, of the claims shown in one of these figures or tables.
[[nodiscard]] DataTable reasons_table(const std::vector<JudgedClaim>& judged, const PaperRuns& runs,
                                      const std::string& id, const std::vector<std::string>& shown);
/// The verdict on every figure and table of the paper, from that on the claims it shows.
[[nodiscard]] DataTable figures_table(const std::vector<JudgedClaim>& judged, const PaperRuns& runs);
/// The claims that no run can answer: inputs (with what the case has), choices, laboratory facts, literature.
[[nodiscard]] DataTable unanswered_table(const std::vector<JudgedClaim>& judged, const PaperRuns& runs);

}  // namespace abradem::report
