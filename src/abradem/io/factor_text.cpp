// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/factor_text.h"

#include <fmt/core.h>

#include <charconv>
#include <cmath>
#include <vector>

#include "abradem/core/error.h"
#include "abradem/core/text.h"
#include "abradem/core/units.h"
#include "abradem/io/case_schema.h"

namespace abradem::io {
namespace {

using core::trimmed;

/// Pieces between separators that stand outside quotes and brackets; at most `most` of them.
std::vector<std::string_view> split(std::string_view text, char separator, std::size_t most = SIZE_MAX) {
  std::vector<std::string_view> pieces;
  std::size_t start = 0;
  int depth = 0;
  char quote = '\0';
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quote != '\0') {
      if (c == '\\' && quote == '"') ++i;
      if (c == quote) quote = '\0';
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '[' || c == '{') {
      ++depth;
    } else if (c == ']' || c == '}') {
      --depth;
    } else if (c == separator && depth <= 0 && pieces.size() + 1 < most) {
      pieces.push_back(text.substr(start, i - start));
      start = i + 1;
    }
  }
  pieces.push_back(text.substr(std::min(start, text.size())));
  return pieces;
}

/// Whether the case reads a whole number there. Names stand between the words of the table's sections.
bool is_whole_number(std::string_view key) {
  std::vector<std::string_view> words = split(key, '.');
  for (const Row& row : case_rows()) {
    if (row.kind != Kind::integer) continue;
    const std::string path = fmt::format("{}.{}", row.section, row.key);
    const std::vector<std::string_view> wanted = split(path, '.');
    bool equal = words.size() == wanted.size();
    for (std::size_t i = 0; equal && i < words.size(); ++i)
      equal = wanted[i] == "*" || wanted[i] == trimmed(words[i]);
    if (equal) return true;
  }
  return false;
}

class RangeReader {
 public:
  RangeReader(std::string_view key, std::string_view text) : key_(key), text_(text) {}

  /// nullopt for text that is no range, such as "../disc.stl". @param count the values it names, 0: none
  std::optional<study::Range> read(int& count) {
    const std::size_t dots = text_.find("..");
    if (dots == std::string_view::npos) return std::nullopt;
    const auto low = read_number_text(text_.substr(0, dots));
    std::vector<std::string_view> parts = split(text_.substr(dots + 2), ':');
    const auto high = read_number_text(parts.front());
    if (!low || !high) return std::nullopt;
    study::Range range{.low = low->number, .high = high->number, .unit = low->unit};
    if (low->unit != high->unit) unite(*low, *high, range);
    for (std::size_t i = 1; i < parts.size(); ++i) read_option(trimmed(parts[i]), range, count);
    range.whole = range.unit.empty() && is_whole_number(key_);
    return range;
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw InputError(fmt::format("{}={}: {}", key_, text_, why));
  }

  void unite(const NumberText& low, const NumberText& high, study::Range& range) const {
    if (high.unit.empty()) refuse("the upper end has no unit; give it there, or at both ends");
    range.unit = high.unit;
    if (low.unit.empty()) return;
    try {
      const core::Quantity a = core::parse_quantity(fmt::format("{} {}", low.number, low.unit));
      const core::Quantity one = core::parse_quantity(fmt::format("1 {}", high.unit));
      if (!(a.dimension == one.dimension))
        refuse(fmt::format("its ends are {} and {}", core::describe(a.dimension),
                           core::describe(one.dimension)));
      range.low = a.value / one.value;
    } catch (const core::UnitError& error) {
      refuse(error.what());
    }
  }

  void read_option(std::string_view option, study::Range& range, int& count) const {
    if (option == "log") {
      range.logarithmic = true;
      return;
    }
    const auto [end, error] = std::from_chars(option.data(), option.data() + option.size(), count);
    if (error != std::errc{} || end != option.data() + option.size() || count < 2)
      refuse(fmt::format("':{}' is neither ':log' nor a number of values, 2 or more", option));
  }

  std::string_view key_, text_;
};

}  // namespace

std::optional<NumberText> read_number_text(std::string_view text) {
  text = trimmed(text);
  NumberText result;
  std::string_view digits = text;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), result.number);
  if (error != std::errc{} || !std::isfinite(result.number)) return std::nullopt;
  result.unit = trimmed(digits.substr(static_cast<std::size_t>(end - digits.data())));
  return result;
}

study::Factor make_factor(std::string_view key, std::span<const std::string> values) {
  study::Factor factor{.key = std::string(trimmed(key)), .values = {}, .range = {}};
  for (const std::string& value : values) {
    int count = 0;
    const auto range = RangeReader(factor.key, value).read(count);
    if (!range) {
      factor.values.push_back(value);
    } else if (count > 0) {
      for (std::string& v : study::spread(*range, count)) factor.values.push_back(std::move(v));
    } else if (values.size() == 1) {
      factor.range = range;
    } else {
      throw InputError(
          fmt::format("{}: '{}' stands among other values; say how many it stands for, as in {}:5",
                      factor.key, value, value));
    }
  }
  return factor;
}

study::Factor parse_factor(std::string_view text) {
  const std::vector<std::string_view> sides = split(text, '=', 2);
  const auto refuse = [&](const char* why) {
    throw InputError(fmt::format(
        "'{}' {}; expected KEY=VALUE,VALUE,… or KEY=LOW..HIGH, such as wall.disc.mesh.size=0.1 mm,0.2 mm",
        text, why));
  };
  if (sides.size() < 2) refuse("names no values");
  if (trimmed(sides[0]).empty()) refuse("names no key");
  std::vector<std::string> values;
  for (const std::string_view value : split(sides[1], ',')) {
    if (trimmed(value).empty()) refuse("has an empty value");
    values.emplace_back(trimmed(value));
  }
  return make_factor(sides[0], values);
}

}  // namespace abradem::io
