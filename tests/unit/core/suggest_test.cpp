// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/core/suggest.h"

#include <gtest/gtest.h>

#include <array>

namespace abradem::core {
namespace {

TEST(EditDistance, CountsInsertionsDeletionsReplacementsAndSwaps) {
  EXPECT_EQ(edit_distance("", ""), 0u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("static_frction", "static_friction"), 1u);
  EXPECT_EQ(edit_distance("raduis", "radius"), 1u);
}

TEST(NearestSpelling, FindsWhatWasMeantAndNothingElse) {
  constexpr std::array<std::string_view, 4> keys{"restitution", "static_friction", "rolling_friction", "law"};
  EXPECT_EQ(nearest_spelling("restituton", keys), "restitution");
  EXPECT_EQ(nearest_spelling("Law", keys), "law");
  EXPECT_EQ(nearest_spelling("friction", keys), "static_friction");
  EXPECT_EQ(nearest_spelling("colour", keys), "");
  EXPECT_EQ(nearest_spelling("x", keys), "");
}

}  // namespace
}  // namespace abradem::core
