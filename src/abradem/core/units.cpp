// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/core/units.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <vector>

#include "abradem/core/suggest.h"

namespace abradem::core {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr Dimension kNone{};
constexpr Dimension kMass{.mass = 1};
constexpr Dimension kLength{.length = 1};
constexpr Dimension kTime{.time = 1};
constexpr Dimension kAngle{.angle = 1};
constexpr Dimension kFrequency{.time = -1};
constexpr Dimension kRotation{.time = -1, .angle = 1};
constexpr Dimension kForce{.mass = 1, .length = 1, .time = -2};
constexpr Dimension kPressure{.mass = 1, .length = -1, .time = -2};
constexpr Dimension kEnergy{.mass = 1, .length = 2, .time = -2};
constexpr Dimension kPower{.mass = 1, .length = 2, .time = -3};

constexpr std::array kUnits{
    NamedUnit{"m", {1, 1, 0, kLength}, "metre"},
    NamedUnit{"km", {1, 1, 3, kLength}, "kilometre"},
    NamedUnit{"cm", {1, 1, -2, kLength}, "centimetre"},
    NamedUnit{"mm", {1, 1, -3, kLength}, "millimetre"},
    NamedUnit{"um", {1, 1, -6, kLength}, "micrometre"},
    NamedUnit{"µm", {1, 1, -6, kLength}, "micrometre (micro sign)"},
    NamedUnit{"μm", {1, 1, -6, kLength}, "micrometre (Greek mu)"},
    NamedUnit{"nm", {1, 1, -9, kLength}, "nanometre"},
    NamedUnit{"in", {0.0254, 1, 0, kLength}, "inch"},
    NamedUnit{"ft", {0.3048, 1, 0, kLength}, "foot"},
    NamedUnit{"kg", {1, 1, 0, kMass}, "kilogram"},
    NamedUnit{"g", {1, 1, -3, kMass}, "gram"},
    NamedUnit{"mg", {1, 1, -6, kMass}, "milligram"},
    NamedUnit{"t", {1, 1, 3, kMass}, "tonne"},
    NamedUnit{"s", {1, 1, 0, kTime}, "second"},
    NamedUnit{"ms", {1, 1, -3, kTime}, "millisecond"},
    NamedUnit{"us", {1, 1, -6, kTime}, "microsecond"},
    NamedUnit{"µs", {1, 1, -6, kTime}, "microsecond (micro sign)"},
    NamedUnit{"μs", {1, 1, -6, kTime}, "microsecond (Greek mu)"},
    NamedUnit{"min", {60, 1, 0, kTime}, "minute"},
    NamedUnit{"h", {3600, 1, 0, kTime}, "hour"},
    NamedUnit{"rad", {1, 1, 0, kAngle}, "radian"},
    NamedUnit{"deg", {kPi, 180, 0, kAngle}, "degree"},
    NamedUnit{"°", {kPi, 180, 0, kAngle}, "degree"},
    NamedUnit{"rev", {2 * kPi, 1, 0, kAngle}, "revolution, 2 pi rad"},
    NamedUnit{"cycle", {2 * kPi, 1, 0, kAngle}, "cycle of an oscillation, 2 pi rad"},
    NamedUnit{"cycles", {2 * kPi, 1, 0, kAngle}, "the same"},
    NamedUnit{"rpm", {2 * kPi, 60, 0, kRotation}, "revolutions per minute"},
    NamedUnit{"Hz", {1, 1, 0, kFrequency}, "hertz, 1/s"},
    NamedUnit{"kHz", {1, 1, 3, kFrequency}, "kilohertz"},
    NamedUnit{"N", {1, 1, 0, kForce}, "newton"},
    NamedUnit{"mN", {1, 1, -3, kForce}, "millinewton"},
    NamedUnit{"kN", {1, 1, 3, kForce}, "kilonewton"},
    NamedUnit{"MN", {1, 1, 6, kForce}, "meganewton"},
    NamedUnit{"Pa", {1, 1, 0, kPressure}, "pascal"},
    NamedUnit{"kPa", {1, 1, 3, kPressure}, "kilopascal"},
    NamedUnit{"MPa", {1, 1, 6, kPressure}, "megapascal"},
    NamedUnit{"GPa", {1, 1, 9, kPressure}, "gigapascal"},
    NamedUnit{"bar", {1, 1, 5, kPressure}, "bar"},
    NamedUnit{"HV", {9.80665, 1, 6, kPressure}, "Vickers hardness, 1 HV = 1 kgf/mm^2 = 9.80665 MPa"},
    NamedUnit{"J", {1, 1, 0, kEnergy}, "joule"},
    NamedUnit{"mJ", {1, 1, -3, kEnergy}, "millijoule"},
    NamedUnit{"kJ", {1, 1, 3, kEnergy}, "kilojoule"},
    NamedUnit{"W", {1, 1, 0, kPower}, "watt"},
    NamedUnit{"%", {1, 1, -2, kNone}, "per cent"},
};

/// What the dimensions met in a case are called; the SI unit is the one messages and files show.
struct NamedDimension {
  Dimension dimension;
  std::string_view name, si, example;
};
constexpr std::array kDimensions{
    NamedDimension{kNone, "a plain number", "", "0.5"},
    NamedDimension{kLength, "a length", "m", "3 mm"},
    NamedDimension{{.length = 2}, "an area", "m^2", "2 mm^2"},
    NamedDimension{{.length = 3}, "a volume", "m^3", "0.5 mm^3"},
    NamedDimension{kMass, "a mass", "kg", "2 g"},
    NamedDimension{kTime, "a time", "s", "24 s"},
    NamedDimension{kAngle, "an angle", "rad", "90 deg"},
    NamedDimension{kRotation, "a rate of rotation", "rad/s", "180 deg/s"},
    NamedDimension{kFrequency, "a frequency", "Hz", "2 Hz"},
    NamedDimension{{.length = 1, .time = -1}, "a velocity", "m/s", "70 mm/s"},
    NamedDimension{{.length = 1, .time = -2}, "an acceleration", "m/s^2", "-9.81 m/s^2"},
    NamedDimension{{.mass = 1, .length = -3}, "a density", "kg/m^3", "4850 kg/m^3"},
    NamedDimension{kForce, "a force", "N", "5 N"},
    NamedDimension{kPressure, "a pressure", "Pa", "0.1 GPa"},
    NamedDimension{{.mass = -1, .length = 1, .time = 2}, "an inverse pressure", "1/Pa", "5e-11 1/Pa"},
    NamedDimension{{.mass = 1, .time = -2}, "a stiffness, or an energy per area", "N/m", "1e5 N/m"},
    NamedDimension{kEnergy, "an energy or a torque", "J", "2 mJ"},
    NamedDimension{kPower, "a power", "W", "3 W"},
};

const NamedDimension* find(const Dimension& dimension) noexcept {
  for (const NamedDimension& d : kDimensions)
    if (d.dimension == dimension) return &d;
  return nullptr;
}

constexpr Unit raised(const Unit& u, int power) {
  Unit result;
  for (int i = 0; i < (power < 0 ? -power : power); ++i) {
    result.numerator *= power > 0 ? u.numerator : u.denominator;
    result.denominator *= power > 0 ? u.denominator : u.numerator;
  }
  result.exponent = u.exponent * power;
  result.dimension = {u.dimension.mass * power, u.dimension.length * power, u.dimension.time * power,
                      u.dimension.angle * power};
  return result;
}

constexpr Unit product(const Unit& a, const Unit& b) {
  return {a.numerator * b.numerator,
          a.denominator * b.denominator,
          a.exponent + b.exponent,
          {a.dimension.mass + b.dimension.mass, a.dimension.length + b.dimension.length,
           a.dimension.time + b.dimension.time, a.dimension.angle + b.dimension.angle}};
}

/// number * unit, with the power of ten applied to the decimal text so that it costs no rounding.
double scaled(std::string_view number, const Unit& unit, std::size_t position) {
  std::string digits(number);
  int exponent = unit.exponent;
  if (const std::size_t e = digits.find_first_of("eE"); e != std::string::npos) {
    std::string_view written = std::string_view(digits).substr(e + 1);
    if (written.front() == '+') written.remove_prefix(1);
    int given = 0;
    const auto [end, error] = std::from_chars(written.data(), written.data() + written.size(), given);
    constexpr int kFar = 100000;  // beyond any double; keeps the sum below from overflowing
    if (error != std::errc{}) given = written.front() == '-' ? -kFar : kFar;
    exponent += std::clamp(given, -kFar, kFar);
    digits.resize(e);
  }
  digits += fmt::format("e{}", exponent);
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc{}) value = value / unit.denominator * unit.numerator;  // 30 rpm: exactly pi
  if (error != std::errc{} || !std::isfinite(value))
    throw UnitError(position, fmt::format("'{}' is out of the range of a number", number));
  return value;
}

/// Recursive descent over one text; `at_` is the byte looked at.
class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) {}

  Quantity quantity() {
    skip_space();
    const std::size_t start = at_;
    const std::string_view number = take_number();
    skip_space();
    Quantity result;
    const std::size_t unit_start = at_;
    Unit unit;
    if (at_ < text_.size()) unit = whole_unit();
    std::string_view written = text_.substr(unit_start);
    while (!written.empty() && is_space(written.back())) written.remove_suffix(1);
    result.unit = written;
    result.number = scaled(number, Unit{}, start);
    result.value = scaled(number, unit, start);
    result.dimension = unit.dimension;
    return result;
  }

  Unit whole_unit() {
    skip_space();
    if (at_ == text_.size()) fail("a unit is missing");
    const Unit unit = expression();
    if (at_ < text_.size()) fail(fmt::format("'{}' cannot stand here", rest()));
    return unit;
  }

 private:
  static bool is_space(char c) noexcept { return c == ' ' || c == '\t'; }
  static bool is_digit(char c) noexcept { return c >= '0' && c <= '9'; }
  static bool is_letter(char c) noexcept {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '%' || c == '_' || (c & 0x80) != 0;
  }
  [[noreturn]] void fail(const std::string& message) const { throw UnitError(at_, message); }
  [[nodiscard]] std::string_view rest() const { return text_.substr(at_); }
  [[nodiscard]] char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  void skip_space() {
    while (at_ < text_.size() && is_space(text_[at_])) ++at_;
  }
  bool take(std::string_view token) {
    if (!rest().starts_with(token)) return false;
    at_ += token.size();
    return true;
  }

  std::string_view take_number() {
    if (rest().empty()) fail("it is empty; expected a number and its unit");
    const std::size_t sign = at_;
    if (peek() == '+') ++at_;
    const std::size_t start = at_;
    double ignored = 0.0;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), ignored);
    const auto length = static_cast<std::size_t>(end - (text_.data() + start));
    const std::string_view number = text_.substr(start, length);
    if (error == std::errc::invalid_argument || (start > sign && peek() == '-')) {
      at_ = sign;
      fail(fmt::format("expected a number in front of '{}'", rest()));
    }
    if (number.find_first_of("nN") != std::string_view::npos) {
      at_ = sign;
      fail(fmt::format("'{}' is not a finite number", number));
    }
    at_ = start + length;
    if (peek() == ',') fail("a comma cannot stand in a number; write a decimal point");
    return number;
  }

  Unit expression() {
    Unit unit = factor(true);
    bool divided = false;
    while (true) {
      const std::size_t before = at_;
      skip_space();
      if (at_ == text_.size() || peek() == ')') return unit;
      if (take("/")) {
        divided = true;
        unit = product(unit, raised(factor(false), -1));
      } else if (take("*") || take("·")) {
        unit = product(unit, factor(false));
      } else if (at_ > before && is_letter(peek())) {
        if (divided) fail("a product after '/' can be read two ways; write kg/(m s) or kg*s/m");
        unit = product(unit, factor(false));
      } else {
        fail(fmt::format("'{}' cannot stand here", rest()));
      }
    }
  }

  Unit factor(bool first) {
    skip_space();
    if (take("(")) {
      const Unit inner = expression();
      if (!take(")")) fail("')' is missing");
      return raised(inner, power());
    }
    if (first && peek() == '1') {
      const std::size_t one = at_++;
      skip_space();
      if (peek() == '/') return {};
      at_ = one;
    }
    return symbol();
  }

  Unit symbol() {
    const std::size_t start = at_;
    while (is_letter(peek()) && !at_power() && !rest().starts_with("·")) ++at_;
    const std::string_view name = text_.substr(start, at_ - start);
    if (name.empty()) {
      if (at_ == text_.size()) fail("a unit is missing at the end");
      fail(fmt::format("expected a unit, got '{}'", rest()));
    }
    for (const NamedUnit& u : kUnits)
      if (u.symbol == name) return raised(u.unit, power());
    at_ = start;
    std::vector<std::string_view> symbols;
    for (const NamedUnit& u : kUnits) symbols.push_back(u.symbol);
    const std::string nearest = nearest_spelling(name, symbols);
    fail(nearest.empty() ? fmt::format("unknown unit '{}'", name)
                         : fmt::format("unknown unit '{}'; did you mean '{}'?", name, nearest));
  }

  [[nodiscard]] bool at_power() const { return rest().starts_with("²") || rest().starts_with("³"); }

  int power() {
    if (take("²")) return 2;
    if (take("³")) return 3;
    if (!take("^")) return 1;
    const bool negative = take("-");
    if (!is_digit(peek()) || peek() == '0') fail("a power is a whole number such as ^2 or ^-1");
    const int value = peek() - '0';
    ++at_;
    if (is_digit(peek())) fail("a power above 9 is no unit of this program");
    return negative ? -value : value;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

/// The decimal digits of a number times 10^-shift, as plain or exponent notation, whichever is shorter.
std::string shifted(double value, int shift) {
  // Scientific notation from the shortest round trip: d.ddde±XX; only its exponent changes.
  std::array<char, 32> buffer{};
  const auto written =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::scientific);
  std::string_view text(buffer.data(), static_cast<std::size_t>(written.ptr - buffer.data()));
  const std::size_t e = text.find('e');
  std::string_view mantissa = text.substr(0, e);
  std::string_view power = text.substr(e + 1);
  if (power.front() == '+') power.remove_prefix(1);
  int exponent = 0;
  std::from_chars(power.data(), power.data() + power.size(), exponent);
  const bool negative = mantissa.front() == '-';
  if (negative) mantissa.remove_prefix(1);
  std::string digits;
  for (const char c : mantissa)
    if (c != '.') digits += c;
  exponent -= value == 0.0 ? 0 : shift;
  constexpr int kLowest = -4,
                kHighest = 9;  // beyond these powers of ten a person reads 1e-5 faster than zeros
  std::string result(negative ? "-" : "");
  if (exponent < kLowest || exponent > kHighest) {
    result += digits.front();
    if (digits.size() > 1) result.append(".").append(digits, 1);
    result += fmt::format("e{}", exponent);
  } else if (exponent < 0) {
    result.append("0.").append(static_cast<std::size_t>(-exponent - 1), '0').append(digits);
  } else {
    const auto whole = static_cast<std::size_t>(exponent) + 1;
    if (digits.size() < whole) digits.append(whole - digits.size(), '0');
    result.append(digits, 0, whole);
    if (digits.size() > whole) result.append(".").append(digits, whole);
  }
  return result;
}

bool reads_back(const std::string& text, double value) { return parse_quantity(text).value == value; }

}  // namespace

std::span<const NamedUnit> named_units() noexcept { return kUnits; }

Quantity parse_quantity(std::string_view text) { return Parser(text).quantity(); }

Unit parse_unit(std::string_view text) { return Parser(text).whole_unit(); }

std::string format_number(double value) { return shifted(value, 0); }

std::string format_quantity(double value, std::string_view unit) {
  if (unit.empty() || unit == "-") return format_number(value);
  const Unit u = parse_unit(unit);
  if (u.numerator == 1.0 && u.denominator == 1.0)
    return fmt::format("{} {}", shifted(value, u.exponent), unit);
  // A factor such as pi/180 costs roundings: fifteen digits often undo them, and where they do not, SI is
  // exact.
  const double number = value * u.denominator / u.numerator / std::pow(10.0, u.exponent);
  for (const double candidate : {std::strtod(fmt::format("{:.15g}", number).c_str(), nullptr), number}) {
    std::string text = fmt::format("{} {}", format_number(candidate), unit);
    if (reads_back(text, value)) return text;
  }
  return fmt::format("{} {}", format_number(value), si_unit(u.dimension));
}

std::string si_unit(const Dimension& dimension) {
  if (const NamedDimension* named = find(dimension)) return std::string(named->si);
  std::string result;
  const auto append = [&](std::string_view symbol, int power) {
    if (power == 0) return;
    if (!result.empty()) result += '*';
    result += symbol;
    if (power != 1) result += fmt::format("^{}", power);
  };
  append("kg", dimension.mass);
  append("m", dimension.length);
  append("s", dimension.time);
  append("rad", dimension.angle);
  return result;
}

std::string describe(const Dimension& dimension) {
  if (const NamedDimension* named = find(dimension)) return std::string(named->name);
  return fmt::format("a quantity in {}", si_unit(dimension));
}

std::string_view example(const Dimension& dimension) noexcept {
  const NamedDimension* named = find(dimension);
  return named != nullptr ? named->example : std::string_view{};
}

}  // namespace abradem::core
