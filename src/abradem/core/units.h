// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "abradem/core/error.h"

/// Quantities written with a unit, such as "3 mm" or "180 deg/s", and their values in SI. Inside the program
/// everything is SI; this is the only place that knows other units.
namespace abradem::core {

/// Powers of the base dimensions. The angle is kept as one of them (its SI unit is the radian), so that a
/// rate of rotation (rad/s) and a frequency (1/s) are not taken for each other.
struct Dimension {
  int mass = 0, length = 0, time = 0, angle = 0;
  constexpr bool operator==(const Dimension&) const noexcept = default;
};

/// A unit: `numerator / denominator * 10^exponent` SI units. The power of ten is kept apart so that "22 mm"
/// is read as 22e-3, the very double that 0.022 is.
struct Unit {
  double numerator = 1.0, denominator = 1.0;
  int exponent = 0;
  Dimension dimension;
};

/// A named unit of the table, with what it is called in the documentation.
struct NamedUnit {
  std::string_view symbol;
  Unit unit;
  std::string_view meaning;
};

/// Every unit a case file may use, in the order of the documentation.
[[nodiscard]] std::span<const NamedUnit> named_units() noexcept;

/// A value read from text.
struct Quantity {
  double value = 0.0;  ///< in SI units
  Dimension dimension;
  double number = 0.0;  ///< as written, before the unit
  std::string unit;     ///< as written; empty for a bare number
};

/// A constant with a name of its own.
struct NamedQuantity {
  std::string name;
  double value = 0.0;  ///< in SI units
  Dimension dimension;
  bool operator==(const NamedQuantity&) const = default;
};

/// Text that is not a quantity. `position` counts bytes from the start of the text.
struct UnitError : InputError {
  UnitError(std::size_t at, const std::string& message) : InputError(message), position(at) {}
  std::size_t position;
};

/// Reads a number and its unit. Products are written with `*`, `·` or a space, quotients with `/`, powers
/// with
/// `^2`, `²` or `³`; `1/Pa` and parentheses are allowed. A number without a unit is dimensionless.
/// @throws UnitError on anything else, on a value that is not finite, and on one too large for a double
[[nodiscard]] Quantity parse_quantity(std::string_view text);

/// Reads a unit without a number, such as "mm^3" or "kg/m^3".
/// @throws UnitError
[[nodiscard]] Unit parse_unit(std::string_view text);

/// The value in the given unit as text that parse_quantity() reads back to the same bits, e.g.
/// format_quantity(0.022, "mm") == "22 mm". Where no short decimal number does that, the SI unit is used
/// instead.
/// @param unit as for parse_unit(); empty or "-" for a dimensionless value
[[nodiscard]] std::string format_quantity(double value, std::string_view unit);

/// The shortest decimal number that reads back to the same bits.
[[nodiscard]] std::string format_number(double value);

/// The SI unit of a dimension, e.g. "kg/m^3", "Pa", "1/Pa"; empty when dimensionless.
[[nodiscard]] std::string si_unit(const Dimension& dimension);

/// What a dimension is called with its article ("a length"), or its SI unit ("a quantity in kg/s") where it
/// has no name; "a plain number" when dimensionless.
[[nodiscard]] std::string describe(const Dimension& dimension);

/// A quantity of this dimension as one would write it ("3 mm"); empty where none is known.
[[nodiscard]] std::string_view example(const Dimension& dimension) noexcept;

}  // namespace abradem::core
