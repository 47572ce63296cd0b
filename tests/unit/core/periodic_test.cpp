// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/core/periodic.h"

#include <gtest/gtest.h>

namespace abradem {
namespace {

TEST(Wrapped, IsTheImageBetweenLowAndHigh) {
  const Vec3 low{-1.0, 2.0, 5.0}, period{2.0, 0.5, 0.0};
  EXPECT_EQ(wrapped({0.25, 2.25, 99.0}, low, period), (Vec3{0.25, 2.25, 99.0}));
  EXPECT_EQ(wrapped({-1.5, 1.75, -3.0}, low, period), (Vec3{0.5, 2.25, -3.0}));
  EXPECT_EQ(wrapped({7.5, 2.5, 0.0}, low, period), (Vec3{-0.5, 2.0, 0.0}));
}

TEST(Wrapped, OfAHairBelowLowIsNotHigh) {
  // low - 1e-17 + period rounds to low + period, which is low's image.
  EXPECT_EQ(wrapped({-1e-17, 0.0, 0.0}, {}, {1.0, 0.0, 0.0}), Vec3{});
}

}  // namespace
}  // namespace abradem
