// SPDX-License-Identifier: BSD-3-Clause
// A data race on purpose: what does not report it watches nothing.
#include "abradem/core/parallel.h"

int main() {
  double sum = 0.0;
  abradem::core::parallel_for(1000, [&](std::size_t i) { sum += static_cast<double>(i); });
  return sum < 0.0;
}
