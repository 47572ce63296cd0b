// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "abradem/analysis/correlation.h"
#include "abradem/analysis/normality.h"
#include "abradem/analysis/statistics.h"

namespace abradem::analysis {

/// All that is asked of the depths (or widths) of the sections of one revolution.  docs/theory/statistics.md
struct SectionStatistics {
  Summary summary;
  std::size_t outliers = 0;    ///< tukey_outliers
  ThinnedNormality normality;  ///< tests on all sections, and on those that are left after thinning
  BinSensitivity equiprobable, equal_width;  ///< of the chi-squared test on all sections
};
/// @throws InputError when a value is not finite
[[nodiscard]] SectionStatistics section_statistics(std::span<const double> values, Ends ends);

}  // namespace abradem::analysis
