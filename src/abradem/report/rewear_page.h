// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "abradem/analysis/rewear.h"
#include "abradem/report/page.h"

namespace abradem::report {

/// What a run's recorded wear comes to by other laws.
struct RewearSummary {
  std::string name;         ///< of what is written
  std::string title;        ///< of the run
  std::string assumptions;  ///< how each pair wears now: a sentence
  struct Wall {
    std::string name;
    std::vector<std::string> regions;
    double before = 0.0;  ///< law volume of the run, on elements of the map [m^3]
  };
  std::vector<Wall> walls;
  analysis::Reworn reworn;
};

[[nodiscard]] Page rewear_page(const RewearSummary& summary);
/// A table for the terminal; and the same as JSON.
[[nodiscard]] std::string rewear_text(const RewearSummary& summary);
[[nodiscard]] std::string rewear_json(const RewearSummary& summary);

}  // namespace abradem::report
