// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/core/random.h"

#include <gtest/gtest.h>

namespace abradem::core {
namespace {

TEST(Random, SplitMixGivesTheReferenceSequence) {
  // First outputs of the authors' splitmix64.c for the state 1234567 (each call adds the golden gamma).
  constexpr std::uint64_t gamma = 0x9e3779b97f4a7c15ULL;
  EXPECT_EQ(splitmix64(1234567), 6457827717110365317ULL);
  EXPECT_EQ(splitmix64(1234567 + gamma), 3203168211198807973ULL);
  EXPECT_EQ(splitmix64(1234567 + 2 * gamma), 9817491932198370423ULL);
}

TEST(Random, UniformStaysInItsIntervalWithTheRightMeanAndVariance) {
  RandomStream random(42);
  double sum = 0.0, squares = 0.0;
  constexpr int n = 100000;
  for (int i = 0; i < n; ++i) {
    const double x = random.uniform();
    ASSERT_TRUE(x >= 0.0 && x < 1.0);
    sum += x;
    squares += x * x;
  }
  // Three standard errors of the mean (1/sqrt(12 n)) and of the mean square (sqrt(4/45 / n)).
  EXPECT_NEAR(sum / n, 0.5, 3.0 * 0.2887 / 316.0);
  EXPECT_NEAR(squares / n, 1.0 / 3.0, 3.0 * 0.2981 / 316.0);
}

TEST(Random, StreamsOfOneSeedDiffer) {
  RandomStream a(1, 0), b(1, 1), again(1, 0);
  const std::uint64_t first = a.bits();
  EXPECT_NE(first, b.bits());
  EXPECT_EQ(first, again.bits());
}

}  // namespace
}  // namespace abradem::core
