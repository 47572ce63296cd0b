// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/study/scaling.h"

#include <fmt/core.h>

#include <cmath>

#include "abradem/core/error.h"

namespace abradem::study {

LargestFactor largest_factor(std::span<const double> factors, std::span<const double> errors,
                             double tolerance) {
  if (factors.empty() || factors.size() != errors.size())
    throw InputError(fmt::format("{} scaling factors and {} errors", factors.size(), errors.size()));
  if (!(tolerance > 0.0))
    throw InputError(fmt::format("tolerance {}; expected a positive number", tolerance));
  for (std::size_t k = 0; k < factors.size(); ++k) {
    if (!(factors[k] > (k == 0 ? 1.0 : factors[k - 1])))
      throw InputError(fmt::format("scaling factor {}; expected factors above 1 that ascend", factors[k]));
    if (!(errors[k] > 0.0)) throw InputError(fmt::format("error {}; expected a positive number", errors[k]));
  }
  if (errors[0] > tolerance) return {factors[0], false, true};
  for (std::size_t k = 1; k < factors.size(); ++k) {
    if (errors[k] <= tolerance) continue;
    const double part = std::log(tolerance / errors[k - 1]) / std::log(errors[k] / errors[k - 1]);
    return {factors[k - 1] * std::pow(factors[k] / factors[k - 1], part), false, false};
  }
  return {factors.back(), true, false};
}

}  // namespace abradem::study
