// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/core/units.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace abradem::core {
namespace {

constexpr Dimension kLength{.length = 1};
constexpr Dimension kPressure{.mass = 1, .length = -1, .time = -2};

struct Sample {
  const char* text;
  double value;
  Dimension dimension;
};

class ReadsQuantity : public testing::TestWithParam<Sample> {};

TEST_P(ReadsQuantity, AsTheSameDoubleAsTheLiteral) {
  const Quantity q = parse_quantity(GetParam().text);
  EXPECT_EQ(q.value, GetParam().value);
  EXPECT_EQ(q.dimension, GetParam().dimension);
}

INSTANTIATE_TEST_SUITE_P(
    Units, ReadsQuantity,
    testing::Values(
        Sample{"3 mm", 0.003, kLength}, Sample{"3mm", 0.003, kLength}, Sample{"  22   mm  ", 0.022, kLength},
        Sample{"0.1 mm", 0.0001, kLength}, Sample{"-7 um", -7e-6, kLength}, Sample{"7 µm", 7e-6, kLength},
        Sample{"7 μm", 7e-6, kLength}, Sample{"+2.5 cm", 0.025, kLength}, Sample{"1e3 nm", 1e-6, kLength},
        Sample{"2 km", 2000.0, kLength}, Sample{"1 in", 0.0254, kLength}, Sample{"0.5 ft", 0.1524, kLength},
        Sample{".5 m", 0.5, kLength}, Sample{"1E+2 mm", 0.1, kLength},
        Sample{"0.565 mm^3", 0.565e-9, {.length = 3}}, Sample{"2 mm²", 2e-6, {.length = 2}},
        Sample{"2 mm³", 2e-9, {.length = 3}}, Sample{"4850 kg/m^3", 4850.0, {.mass = 1, .length = -3}},
        Sample{"4.85 g/cm^3", 4850.0, {.mass = 1, .length = -3}},
        Sample{"7.9 t/m^3", 7900.0, {.mass = 1, .length = -3}}, Sample{"0.1 GPa", 1e8, kPressure},
        Sample{"78 GPa", 78e9, kPressure}, Sample{"5 N/mm^2", 5e6, kPressure},
        Sample{"143 HV", 143 * 9.80665e6, kPressure}, Sample{"1 bar", 1e5, kPressure},
        Sample{"3 kg/(m s^2)", 3.0, kPressure}, Sample{"3 kg*m^-1*s^-2", 3.0, kPressure},
        Sample{"3 kg/m/s^2", 3.0, kPressure},
        Sample{"5e-11 1/Pa", 5e-11, {.mass = -1, .length = 1, .time = 2}},
        Sample{"6.81e-11 Pa^-1", 6.81e-11, {.mass = -1, .length = 1, .time = 2}},
        Sample{"1 mm^3/(N m)", 1e-9, {.mass = -1, .length = 1, .time = 2}},
        Sample{"180 deg/s", std::numbers::pi, {.time = -1, .angle = 1}},
        Sample{"30 rpm", std::numbers::pi, {.time = -1, .angle = 1}},
        Sample{"0.5 rev/s", std::numbers::pi, {.time = -1, .angle = 1}},
        Sample{"1 rev", 2 * std::numbers::pi, {.angle = 1}},
        Sample{"90°", std::numbers::pi / 2, {.angle = 1}}, Sample{"2 Hz", 2.0, {.time = -1}},
        Sample{"2 1/s", 2.0, {.time = -1}}, Sample{"3 min", 180.0, {.time = 1}},
        Sample{"2 h", 7200.0, {.time = 1}}, Sample{"15 us", 15e-6, {.time = 1}},
        Sample{"5 N", 5.0, {.mass = 1, .length = 1, .time = -2}},
        Sample{"5 mN", 5e-3, {.mass = 1, .length = 1, .time = -2}},
        Sample{"2 N m", 2.0, {.mass = 1, .length = 2, .time = -2}},
        Sample{"2 N·m", 2.0, {.mass = 1, .length = 2, .time = -2}},
        Sample{"-9.81 m/s^2", -9.81, {.length = 1, .time = -2}}, Sample{"20%", 0.2, {}},
        Sample{"0.4", 0.4, {}}));

TEST(Quantity, KeepsTheNumberAndTheUnitAsWritten) {
  const Quantity q = parse_quantity("12 rev");
  EXPECT_EQ(q.number, 12.0);
  EXPECT_EQ(q.unit, "rev");
}

TEST(Quantity, TellsARateOfRotationFromAFrequency) {
  EXPECT_NE(parse_quantity("1 rad/s").dimension, parse_quantity("1 1/s").dimension);
  EXPECT_EQ(parse_quantity("1 rad/s").dimension, parse_quantity("1 rpm").dimension);
}

struct Bad {
  const char* text;
  std::size_t position;
  const char* part_of_message;
};

class RefusesQuantity : public testing::TestWithParam<Bad> {};

TEST_P(RefusesQuantity, AtTheByteThatIsWrong) {
  try {
    static_cast<void>(parse_quantity(GetParam().text));
    FAIL() << "accepted " << GetParam().text;
  } catch (const UnitError& error) {
    EXPECT_EQ(error.position, GetParam().position) << error.what();
    EXPECT_NE(std::string(error.what()).find(GetParam().part_of_message), std::string::npos) << error.what();
  }
}

INSTANTIATE_TEST_SUITE_P(
    Units, RefusesQuantity,
    testing::Values(Bad{"", 0, "empty"}, Bad{"   ", 3, "empty"}, Bad{"mm", 0, "expected a number"},
                    Bad{"3 mmm", 2, "did you mean 'mm'"}, Bad{"3 Mpa", 2, "did you mean 'MPa'"},
                    Bad{"3 furlong", 2, "unknown unit 'furlong'"}, Bad{"3,5 mm", 1, "decimal point"},
                    Bad{"nan", 0, "not a finite"}, Bad{"inf mm", 0, "not a finite"},
                    Bad{"-inf m", 0, "not a finite"}, Bad{"1e400 m", 0, "out of the range"},
                    Bad{"1e-400 m", 0, "out of the range"}, Bad{"1e306 km", 0, "out of the range"},
                    Bad{"1e99999999999 m", 0, "out of the range"}, Bad{"3 m/", 4, "unit is missing"},
                    Bad{"3 /m", 2, "expected a unit"}, Bad{"3 m^", 4, "power"}, Bad{"3 m^x", 4, "power"},
                    Bad{"3 m^0", 4, "power"}, Bad{"3 m^12", 5, "power"}, Bad{"3 kg/m s", 7, "two ways"},
                    Bad{"3 kg/(m s", 9, "')'"}, Bad{"3 4 mm", 2, "expected a unit"},
                    Bad{"3 mm)", 4, "cannot stand"}, Bad{"+-3 mm", 0, "expected a number"},
                    Bad{"0x10", 1, "x"}, Bad{"3 m$", 3, "cannot stand"}, Bad{"3 1", 2, "expected a unit"}));

TEST(Unit, IsReadWithoutANumber) {
  const Unit u = parse_unit("mm^3");
  EXPECT_EQ(u.exponent, -9);
  EXPECT_EQ(u.dimension, (Dimension{.length = 3}));
  EXPECT_THROW(static_cast<void>(parse_unit("")), UnitError);
  EXPECT_THROW(static_cast<void>(parse_unit("3 mm")), UnitError);
}

TEST(FormatQuantity, IsShortAndInTheUnitAskedFor) {
  EXPECT_EQ(format_quantity(0.022, "mm"), "22 mm");
  EXPECT_EQ(format_quantity(1e8, "GPa"), "0.1 GPa");
  EXPECT_EQ(format_quantity(6.81e-11, "1/Pa"), "6.81e-11 1/Pa");
  EXPECT_EQ(format_quantity(std::numbers::pi, "deg/s"), "180 deg/s");
  EXPECT_EQ(format_quantity(0.2, "%"), "20 %");
  EXPECT_EQ(format_quantity(0.0, "mm"), "0 mm");
  EXPECT_EQ(format_quantity(0.4, ""), "0.4");
  EXPECT_EQ(format_number(1302.5), "1302.5");
  EXPECT_EQ(format_number(1e20), "1e20");
  EXPECT_EQ(format_number(-2.5e-7), "-2.5e-7");
}

TEST(FormatQuantity, ReadsBackToTheSameBits) {
  std::mt19937_64 random(7);
  for (const char* unit : {"mm", "deg/s", "HV", "GPa", "mm^3", "1/Pa", "rpm", "h", "%", "m/s^2"}) {
    for (int i = 0; i < 2000; ++i) {
      const double exponent = -30.0 + static_cast<double>(random() % 60);
      const double value = (static_cast<double>(random()) * 0x1p-63 - 1.0) * std::pow(10.0, exponent);
      const std::string text = format_quantity(value, unit);
      ASSERT_EQ(parse_quantity(text).value, value) << text;
    }
  }
}

TEST(NamedUnits, AreAllReadableAndUnique) {
  for (const NamedUnit& a : named_units()) {
    EXPECT_EQ(parse_unit(a.symbol).dimension, a.unit.dimension) << a.symbol;
    int same = 0;
    for (const NamedUnit& b : named_units()) same += a.symbol == b.symbol ? 1 : 0;
    EXPECT_EQ(same, 1) << a.symbol;
  }
}

TEST(Describe, NamesDimensionsAndFallsBackToTheirUnit) {
  EXPECT_EQ(describe(kLength), "a length");
  EXPECT_EQ(describe({}), "a plain number");
  EXPECT_EQ(describe({.mass = 1, .time = -1}), "a quantity in kg*s^-1");
  EXPECT_EQ(si_unit({.mass = 1, .length = -3}), "kg/m^3");
}

}  // namespace
}  // namespace abradem::core
