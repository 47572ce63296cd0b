// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/study/variations.h"

#include <fmt/core.h>

#include <algorithm>

namespace abradem::study {

using simulation::StudySetup;
using simulation::VariationSetup;
using simulation::VariedKey;

std::size_t side_by_side(const VariationSetup& variation) noexcept {
  return variation.together.empty() ? 1 : variation.together.front().values.size();
}

std::size_t count_runs(const VariationSetup& variation, std::size_t most) noexcept {
  std::size_t runs = side_by_side(variation);
  for (const VariedKey& key : variation.vary) {
    if (!key.values.empty() && runs > most / key.values.size()) return most + 1;
    runs *= key.values.size();
  }
  return runs;
}

std::vector<PlannedRun> plan(const StudySetup& study) {
  std::vector<PlannedRun> runs;
  for (std::size_t v = 0; v < study.variations.size(); ++v) {
    const VariationSetup& variation = study.variations[v];
    std::size_t crossed = 1;
    for (const VariedKey& key : variation.vary) crossed *= key.values.size();
    const std::size_t count = side_by_side(variation) * crossed;
    const std::size_t digits = std::max<std::size_t>(2, std::to_string(count).size());
    for (std::size_t i = 0; i < count; ++i) {
      PlannedRun run{fmt::format("{}/{:0{}}", variation.name, i + 1, digits), v, i / crossed,
                     std::vector<std::size_t>(variation.vary.size())};
      std::size_t rest = i % crossed;
      for (std::size_t k = variation.vary.size(); k-- > 0;) {
        run.vary[k] = rest % variation.vary[k].values.size();
        rest /= variation.vary[k].values.size();
      }
      runs.push_back(std::move(run));
    }
  }
  return runs;
}

std::vector<std::pair<std::string, std::string>> varied_in(const VariationSetup& variation,
                                                           const PlannedRun& run) {
  std::vector<std::pair<std::string, std::string>> varied;
  for (const VariedKey& key : variation.together) varied.emplace_back(key.key, key.values[run.together]);
  for (std::size_t k = 0; k < variation.vary.size(); ++k)
    varied.emplace_back(variation.vary[k].key, variation.vary[k].values[run.vary[k]]);
  return varied;
}

std::vector<std::string> overrides_of(const VariationSetup& variation, const PlannedRun& run,
                                      const std::vector<std::string>& user) {
  std::vector<std::string> overrides;
  for (const VariedKey& key : variation.set)
    overrides.push_back(fmt::format("{}={}", key.key, key.values.front()));
  overrides.insert(overrides.end(), user.begin(), user.end());
  for (const auto& [key, value] : varied_in(variation, run))
    overrides.push_back(fmt::format("{}={}", key, value));
  return overrides;
}

}  // namespace abradem::study
