// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abradem/io/case_schema.h"

/// What the tables of rows are written with; for case_rows_*.cpp alone.
namespace abradem::io {

template <class Enum>
ChoiceSlot choice(Enum& value) {
  return {[&value] { return static_cast<int>(value); }, [&value](int i) { value = static_cast<Enum>(i); }};
}

template <class Enum>
ChoicesSlot choices(std::vector<Enum>& values) {
  return {[&values] {
            std::vector<int> indices;
            for (const Enum value : values) indices.push_back(static_cast<int>(value));
            return indices;
          },
          [&values](const std::vector<int>& indices) {
            values.clear();
            for (const int i : indices) values.push_back(static_cast<Enum>(i));
          }};
}

inline constexpr Limits kPositive{.low = 0.0, .low_excluded = true};
inline constexpr Limits kNotNegative{.low = 0.0};

}  // namespace abradem::io

#define ABRADEM_SLOT(member) [](const Target& t) -> Slot { return &t.member; }
#define ABRADEM_CHOICES(member) [](const Target& t) -> Slot { return choices(t.member); }
#define ABRADEM_CHOICE(member) [](const Target& t) -> Slot { return choice(t.member); }
