// SPDX-License-Identifier: BSD-3-Clause
// Which expressions the record of a run tells exactly.
#include "abradem/analysis/rewear.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "abradem/wear/expression.h"

namespace abradem::analysis {
namespace {

wear::Expression read(const std::string& text) {
  wear::SymbolValues materials;
  materials.fill(std::numeric_limits<double>::quiet_NaN());
  materials[static_cast<std::size_t>(wear::Symbol::mu)] = 0.5;
  materials[static_cast<std::size_t>(wear::Symbol::E_eff)] = 1e9;
  const auto constant = [](const char* name, const char* value) {
    const core::Quantity q = core::parse_quantity(value);
    return core::NamedQuantity{name, q.value, q.dimension};
  };
  return {"wear",
          text,
          {constant("k", "2e-11 1/Pa"), constant("C", "3 mm^3/J"), constant("F0", "1 N"),
           constant("v0", "1 m/s"), constant("T", "1 ms"), constant("L", "1 mm")},
          materials};
}

TEST(LinearExpression, IsASumOfWhatMapsKeep) {
  const auto all = linear_expression(read("(k * Fn * slip + C * mu * shear_work) / 2 + 4 * C * normal_work"));
  ASSERT_TRUE(all);
  EXPECT_NEAR(all->force_sliding / 1e-11, 1.0, 1e-12);
  EXPECT_NEAR(all->shear_work / 0.75e-9, 1.0, 1e-12);
  EXPECT_NEAR(all->normal_work / 12e-9, 1.0, 1e-12);
  const auto one = linear_expression(read("C * normal_work * sqrt(mu)"));
  ASSERT_TRUE(one);
  EXPECT_EQ(one->force_sliding, 0.0);
  EXPECT_EQ(one->shear_work, 0.0);
}

TEST(LinearExpression, IsNotSeenInAnyOther) {
  for (const char* text : {"k * max(0, Fn - F0) * slip", "Fn > F0 ? k * Fn * slip : 0",
                           "k * Fn * slip * (v_slide / v0)", "k * Fn * slip * (Fn / F0)^0.001",
                           "C * shear_work * a / R", "C * Ft * slip", "k * m / dt * v_slide * slip",
                           "C * sqrt(shear_work * normal_work)", "k * Fn * slip * (slip / (v0 * dt))",
                           "C * m * v^2", "k * F0 * slip", "k * Fn * slip + C * normal_work * slip / L"})
    EXPECT_FALSE(linear_expression(read(text))) << text;
}

TEST(LinearExpression, OfSlidingAloneIsToldFromWearAtRest) {
  EXPECT_TRUE(wears_by_sliding_alone(read("k * Fn * slip * sqrt(slip / (v0 * dt))")));
  EXPECT_TRUE(wears_by_sliding_alone(read("C * shear_work * (1 + dt / T)")));
  EXPECT_FALSE(wears_by_sliding_alone(read("k * Fn * v_slide * dt")));
  EXPECT_FALSE(wears_by_sliding_alone(read("C * normal_work")));
}

}  // namespace
}  // namespace abradem::analysis
