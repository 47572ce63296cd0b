// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/case_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "abradem/core/suggest.h"
#include "abradem/core/units.h"
#include "abradem/io/case_study.h"
#include "abradem/io/case_toml.h"

namespace abradem::io {
namespace {

using core::Dimension;
using simulation::Duration;
using simulation::TimeStep;

std::string written(const Value& value) {
  switch (value.type) {
    case Value::Type::boolean:
      return value.boolean ? "true (a boolean)" : "false (a boolean)";
    case Value::Type::integer:
      return std::to_string(value.integer);
    case Value::Type::number:
      return fmt::format("{}", value.number);
    case Value::Type::text:
      return toml_string(value.text);
    case Value::Type::date:
      return "a date or time of day";
    case Value::Type::array:
      return fmt::format("an array of {}", value.items.size());
    case Value::Type::table:
      return "a table";
  }
  return {};
}

bool is_number(const Value& value) {
  return value.type == Value::Type::integer || value.type == Value::Type::number;
}
double number_of(const Value& value) {
  return value.type == Value::Type::integer ? static_cast<double>(value.integer) : value.number;
}

/// Reads values of one row; every function reports what is wrong where it is and returns nothing then.
class Reader {
 public:
  Reader(const Row& row, const Target& target, Problems& problems)
      : row_(row), target_(target), problems_(problems) {
    if (!row.unit.empty()) dimension_ = core::parse_unit(row.unit).dimension;
  }

  bool read(const Value& value) {
    switch (row_.kind) {
      case Kind::text:
      case Kind::file:
      case Kind::material:
        return store(text(value));
      case Kind::choice:
        return choice(value);
      case Kind::choices:
        return choices(value);
      case Kind::version:
        return version(value);
      case Kind::quantity:
        return store(limited(value, quantity(value)));
      case Kind::integer:
        return integer(value);
      case Kind::vector:
        return store(vector(value));
      case Kind::direction:
        return store(direction(value));
      case Kind::force_down:
        return store(vector_along(value, {0.0, 0.0, -1.0}));
      case Kind::along_axis:
        return store(vector_along(value, target_.motion->axis));
      case Kind::duration:
        return store(duration(value));
      case Kind::time_step:
        return store(time_step(value));
      case Kind::acceleration:
        return store(acceleration(value));
      case Kind::length_unit:
        return store(limited(value, length_unit(value)));
      case Kind::changes:
      case Kind::variations:
        return store(varied(value));
      case Kind::constants:
        return store(constants(value));
    }
    return false;
  }

 private:
  template <class T>
  bool store(const std::optional<T>& value) {
    if (!value) return false;
    const Slot slot = row_.slot(target_);
    if constexpr (std::is_same_v<T, double>) {
      if (auto* const* optional = std::get_if<std::optional<double>*>(&slot)) {
        **optional = *value;
        return true;
      }
    }
    *std::get<T*>(slot) = *value;
    return true;
  }

  std::nullopt_t wrong(const Value& value, const std::string& message) {
    problems_.error(value.place, fmt::format("'{}': {}", row_.key, message));
    return std::nullopt;
  }

  /// "a length such as "3 mm""
  [[nodiscard]] std::string expected() const {
    if (dimension_ == Dimension{}) return "a number";
    const std::string_view sample = core::example(dimension_);
    return sample.empty() ? core::describe(dimension_)
                          : fmt::format("{} such as \"{}\"", core::describe(dimension_), sample);
  }

  std::optional<core::Quantity> parsed(const Value& value, std::string_view part) {
    try {
      return core::parse_quantity(part);
    } catch (const core::UnitError& error) {
      // The caret goes to the very character: one past the opening quote, one column per code point.
      Value there = value;
      const std::string_view before = part.substr(0, error.position);
      there.place.column +=
          1 + static_cast<int>(std::ranges::count_if(before, [](char c) { return (c & 0xC0) != 0x80; }));
      return wrong(there, fmt::format("in \"{}\": {}", value.text, error.what()));
    }
  }

  std::optional<double> quantity(const Value& value) {
    if (is_number(value)) {
      if (!std::isfinite(number_of(value)))
        return wrong(value, fmt::format("{} is not a finite number", written(value)));
      return number_of(value);
    }
    if (value.type != Value::Type::text)
      return wrong(value, fmt::format("expected {}, got {}", expected(), written(value)));
    const auto read = parsed(value, value.text);
    if (!read) return std::nullopt;
    if (read->dimension == dimension_ && (!read->unit.empty() || dimension_ == Dimension{}))
      return read->value;
    return wrong(value, fmt::format("expected {}, got \"{}\" ({})", expected(), value.text, mismatch(*read)));
  }

  [[nodiscard]] std::string mismatch(const core::Quantity& read) const {
    if (read.unit.empty())
      return fmt::format("text without a unit; a bare number, {}, would be in {}",
                         core::format_number(read.number), core::si_unit(dimension_));
    constexpr double kEarth = 9.80665;  // [m/s^2]
    if (dimension_ == Dimension{.mass = 1, .length = 1, .time = -2} && read.dimension == Dimension{.mass = 1})
      return fmt::format("a mass, and a load is a force: its weight is {} N",
                         core::format_number(kEarth * read.value));
    Dimension turning = dimension_;
    turning.angle = 1;
    if (dimension_ == Dimension{.time = -1} && read.dimension == turning)
      return "a rate of rotation; 1 Hz is one cycle per second";
    if (dimension_ == turning && read.dimension == Dimension{.time = -1})
      return "a frequency; say what turns: rad/s, deg/s, rev/s or rpm";
    return core::describe(read.dimension);
  }

  std::optional<double> limited(const Value& value, std::optional<double> number) {
    if (!number || within(*number)) return number;
    std::string hint;
    if (!row_.unit.empty() && is_number(value) && *number > row_.limits.high)
      hint = fmt::format("; a bare number is in {}: was \"{} {}\" meant?", core::si_unit(dimension_),
                         written(value), row_.unit);
    return wrong(value,
                 fmt::format("must be {}{}, got {}{}", describe_limits(row_),
                             row_.unit.empty() || row_.limits.low == 0.0 ? "" : fmt::format(" {}", row_.unit),
                             written(value), hint));
  }

  [[nodiscard]] bool within(double v) const {
    const Limits& l = row_.limits;
    return (l.low_excluded ? v > l.low : v >= l.low) && (l.high_excluded ? v < l.high : v <= l.high);
  }

  std::optional<std::string> text(const Value& value) {
    if (value.type != Value::Type::text)
      return wrong(value, fmt::format("expected text such as {}, got {}", row_.example, written(value)));
    if (row_.kind != Kind::text && value.text.empty())
      return wrong(value, fmt::format("is empty; expected text such as {}", row_.example));
    return value.text;
  }

  bool choice(const Value& value) {
    const auto index = chosen(value);
    if (!index) return false;
    const Slot slot = row_.slot(target_);
    if (const auto* stored = std::get_if<ChoiceSlot>(&slot)) stored->set(*index);
    return true;
  }

  bool choices(const Value& value) {
    std::vector<int> indices;
    const bool list = value.type == Value::Type::array;
    if (list && value.items.empty()) {
      wrong(value, fmt::format("is an empty list; expected one or several of \"{}\"",
                               fmt::join(row_.choices, "\", \"")));
      return false;
    }
    for (const Value& item : list ? std::span<const Value>(value.items) : std::span<const Value>(&value, 1)) {
      const auto index = chosen(item);
      if (!index) return false;
      if (std::ranges::find(indices, *index) != indices.end()) {
        wrong(item, fmt::format("has {} twice", written(item)));
        return false;
      }
      indices.push_back(*index);
    }
    std::get<ChoicesSlot>(row_.slot(target_)).set(indices);
    return true;
  }

  std::optional<int> chosen(const Value& value) {
    const std::string list = fmt::format("\"{}\"", fmt::join(row_.choices, "\", \""));
    if (value.type != Value::Type::text) {
      return wrong(value, fmt::format("expected one of {}, got {}", list, written(value)));
    }
    const auto found = std::ranges::find(row_.choices, value.text);
    if (found == row_.choices.end()) {
      const std::string nearest = core::nearest_spelling(value.text, row_.choices);
      return wrong(value, nearest.empty() ? fmt::format("expected one of {}, got {}", list, written(value))
                                          : fmt::format("expected one of {}, got {}; did you mean \"{}\"?",
                                                        list, written(value), nearest));
    }
    return static_cast<int>(found - row_.choices.begin());
  }

  bool version(const Value& value) {
    if (value.type == Value::Type::integer && value.integer == 1) return true;
    wrong(value, fmt::format("this program reads version 1 of the case format, got {}", written(value)));
    return false;
  }

  bool integer(const Value& value) {
    if (value.type != Value::Type::integer || !within(static_cast<double>(value.integer))) {
      wrong(value, fmt::format("expected a whole number {}, got {}", describe_limits(row_), written(value)));
      return false;
    }
    const Slot slot = row_.slot(target_);
    if (int* const* small = std::get_if<int*>(&slot)) **small = static_cast<int>(value.integer);
    if (std::uint64_t* const* large = std::get_if<std::uint64_t*>(&slot))
      **large = static_cast<std::uint64_t>(value.integer);
    return true;
  }

  std::optional<Vec3> vector(const Value& value) {
    if (value.type != Value::Type::array || value.items.size() != 3)
      return wrong(value, fmt::format("expected three {} such as {}, got {}",
                                      dimension_ == Dimension{} ? "numbers" : "components", row_.example,
                                      written(value)));
    const auto x = quantity(value.items[0]), y = quantity(value.items[1]), z = quantity(value.items[2]);
    if (!x || !y || !z) return std::nullopt;
    return Vec3{*x, *y, *z};
  }

  std::optional<Vec3> direction(const Value& value) {
    const auto v = vector(value);
    if (!v) return std::nullopt;
    const double largest = std::max({std::abs(v->x), std::abs(v->y), std::abs(v->z)});
    if (largest == 0.0) return wrong(value, "is [0, 0, 0], which points nowhere");
    // Already of length 1 within rounding: kept, so that a resolved case resolves to itself.
    constexpr double kRounding = 1e-14;
    if (std::abs(norm2(*v) - 1.0) < kRounding) return v;
    return normalized(*v / largest);
  }

  std::optional<Vec3> vector_along(const Value& value, const Vec3& direction) {
    if (value.type == Value::Type::array) return vector(value);
    const auto along = quantity(value);
    if (!along) return std::nullopt;
    // 0 + …: no negative zeros from a direction with zero components.
    return Vec3{0.0 + *along * direction.x, 0.0 + *along * direction.y, 0.0 + *along * direction.z};
  }

  std::optional<Duration> duration(const Value& value) {
    constexpr std::string_view kExpected =
        "a time such as \"24 s\" or a number of revolutions such as \"12 rev\"";
    Duration result;
    if (is_number(value)) {
      result.value = number_of(value);
      if (!std::isfinite(result.value))
        return wrong(value, fmt::format("{} is not a finite number", written(value)));
    } else if (value.type == Value::Type::text) {
      const auto read = parsed(value, value.text);
      if (!read) return std::nullopt;
      result.in_revolutions = read->unit == "rev" || read->unit == "cycle" || read->unit == "cycles";
      result.value = result.in_revolutions ? read->number : read->value;
      if (!result.in_revolutions && read->dimension != Dimension{.time = 1})
        return wrong(
            value, fmt::format("expected {}, got \"{}\" ({})", kExpected, value.text,
                               read->unit.empty() ? "text without a unit" : core::describe(read->dimension)));
    } else {
      return wrong(value, fmt::format("expected {}, got {}", kExpected, written(value)));
    }
    if (!within(result.value))
      return wrong(value, fmt::format("must be {}, got {}", describe_limits(row_), written(value)));
    return result;
  }

  std::optional<TimeStep> time_step(const Value& value) {
    constexpr std::string_view kExpected = "a time such as \"1.4e-5 s\" or a share such as \"20% rayleigh\"";
    constexpr std::string_view kRayleigh = "rayleigh";
    TimeStep result{.value = 0.0, .of_rayleigh = false};
    if (is_number(value)) {
      result.value = number_of(value);
      if (!std::isfinite(result.value))
        return wrong(value, fmt::format("{} is not a finite number", written(value)));
    } else if (value.type == Value::Type::text) {
      std::string_view part = value.text;
      const std::string_view last = part.substr(part.find_last_of(" %") + 1);
      if (last == kRayleigh) {
        result.of_rayleigh = true;
        part.remove_suffix(kRayleigh.size());
      } else if (!core::nearest_spelling(last, {&kRayleigh, 1}).empty()) {
        return wrong(
            value, fmt::format("expected {}, got \"{}\"; did you mean \"rayleigh\"?", kExpected, value.text));
      }
      const auto read = parsed(value, part);
      if (!read) return std::nullopt;
      result.value = read->value;
      const Dimension needed = result.of_rayleigh ? Dimension{} : Dimension{.time = 1};
      if (read->dimension != needed)
        return wrong(value, fmt::format("expected {}, got \"{}\"", kExpected, value.text));
    } else {
      return wrong(value, fmt::format("expected {}, got {}", kExpected, written(value)));
    }
    if (!within(result.value))
      return wrong(value, fmt::format("must be {}, got {}", describe_limits(row_), written(value)));
    if (result.of_rayleigh && result.value > 1.0)
      return wrong(value,
                   fmt::format("a step above the Rayleigh time is never stable, got {}", written(value)));
    return result;
  }

  std::optional<std::vector<simulation::VariedKey>> varied(const Value& value) {
    if (value.type != Value::Type::table)
      return wrong(value, fmt::format("expected keys of the case with their values, such as {}, got {}",
                                      row_.example, written(value)));
    std::vector<simulation::VariedKey> keys;
    bool good = true;
    for (const KeyedValue& k : keyed_values(value)) {
      if (k.key == "study" || k.key.starts_with("study.")) {
        problems_.error(k.place, fmt::format("'{}': a run knows nothing of its study", k.key));
        good = false;
      }
      if (row_.kind == Kind::changes) {
        keys.push_back({k.key, {toml_text(*k.value)}});
        continue;
      }
      if (k.value->type != Value::Type::array || k.value->items.empty()) {
        problems_.error(
            k.value->place,
            fmt::format("'{}': expected a list of values, such as [\"0.1 mm\", \"0.2 mm\"], got {}", k.key,
                        written(*k.value)));
        good = false;
        continue;
      }
      keys.push_back({k.key, {}});
      for (const Value& item : k.value->items) keys.back().values.push_back(toml_text(item));
    }
    if (!good) return std::nullopt;
    return keys;
  }

  std::optional<std::vector<core::NamedQuantity>> constants(const Value& value) {
    if (value.type != Value::Type::table)
      return wrong(value, fmt::format("expected names with their quantities, such as {}, got {}",
                                      row_.example, written(value)));
    std::vector<core::NamedQuantity> named;
    for (const Entry& e : value.entries) {
      if (is_number(e.value) && std::isfinite(number_of(e.value))) {
        named.push_back({e.key, number_of(e.value), {}});
      } else if (e.value.type == Value::Type::text) {
        const auto read = parsed(e.value, e.value.text);
        if (!read) return std::nullopt;
        named.push_back({e.key, read->value, read->dimension});
      } else {
        return wrong(e.value,
                     fmt::format("'{}' is {}; expected a number, or text with a unit such as \"5 N\"", e.key,
                                 written(e.value)));
      }
    }
    return named;
  }

  std::optional<simulation::Acceleration> acceleration(const Value& value) {
    if (value.type == Value::Type::text && value.text == "auto")
      return simulation::Acceleration{.factor = 1.0, .automatic = true};
    if (!is_number(value))
      return wrong(value, fmt::format("expected a number such as {} or \"auto\", got {}", row_.example,
                                      written(value)));
    const auto factor = limited(value, quantity(value));
    if (!factor) return std::nullopt;
    return simulation::Acceleration{.factor = *factor, .automatic = false};
  }

  std::optional<double> length_unit(const Value& value) {
    if (value.type != Value::Type::text) return quantity(value);
    try {
      const core::Unit unit = core::parse_unit(value.text);
      if (unit.dimension == Dimension{.length = 1})
        return core::parse_quantity(fmt::format("1 {}", value.text)).value;
      return wrong(value, fmt::format("expected a unit of length such as \"mm\", got \"{}\"", value.text));
    } catch (const core::UnitError&) {
      return quantity(value);  // "25.4 mm" is a unit too
    }
  }

  const Row& row_;
  const Target& target_;
  Problems& problems_;
  Dimension dimension_;
};

}  // namespace

bool read_value(const Row& row, const Value& value, const Target& target, Problems& problems) {
  return Reader(row, target, problems).read(value);
}

}  // namespace abradem::io
