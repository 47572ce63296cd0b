// SPDX-License-Identifier: BSD-3-Clause
// A data race on purpose: what does not report it watches nothing.
#include <chrono>
#include <thread>

#include "abradem/core/parallel.h"

int main() {
  double sum = 0.0;
  abradem::core::parallel_blocks(64, [&](std::size_t i) {
    sum += static_cast<double>(i);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));  // so that all threads have their part
  });
  return sum < 0.0;
}
