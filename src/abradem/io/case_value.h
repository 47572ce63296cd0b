// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// The case file as a plain tree in the order it was written, each node with its place. It keeps the TOML
/// library out of everything but case_toml.cpp.
namespace abradem::io {

/// Where something was written. Lines and columns count from 1; line 0 means "nowhere in particular".
struct Place {
  int source = 0;  ///< 0: the case file; n: the n-th override
  int line = 0;
  int column = 0;
};

struct Entry;

struct Value {
  enum class Type { boolean, integer, number, text, date, array, table };
  Type type = Type::table;
  bool boolean = false;
  std::int64_t integer = 0;
  double number = 0.0;
  std::string text;
  std::vector<Value> items;    ///< array
  std::vector<Entry> entries;  ///< table, in the order written
  Place place;

  [[nodiscard]] const Entry* find(std::string_view key) const noexcept;
  [[nodiscard]] Entry* find(std::string_view key) noexcept;
};

struct Entry {
  std::string key;
  Place place;
  Value value;
};

}  // namespace abradem::io
