// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/analysis/groove_statistics.h"

namespace abradem::analysis {

SectionStatistics section_statistics(std::span<const double> values, Ends ends) {
  return {.summary = summarise(values),
          .outliers = tukey_outliers(values).size(),
          .normality = test_thinned_normality(values, ends),
          .equiprobable = bin_sensitivity(values, Binning::equiprobable),
          .equal_width = bin_sensitivity(values, Binning::equal_width)};
}

}  // namespace abradem::analysis
