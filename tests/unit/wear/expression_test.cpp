// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/wear/expression.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "abradem/wear/laws.h"

namespace abradem::wear {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

SymbolValues steel() {
  SymbolValues v;
  v.fill(kNone);
  const auto set = [&](Symbol s, double value) { v[static_cast<std::size_t>(s)] = value; };
  set(Symbol::H, 2e9);
  set(Symbol::E, 210e9);
  set(Symbol::nu, 0.3);
  set(Symbol::rho, 7800.0);
  set(Symbol::E_p, 50e9);
  set(Symbol::nu_p, 0.25);
  set(Symbol::rho_p, 2650.0);
  set(Symbol::mu, 0.4);
  set(Symbol::E_eff, 44e9);
  return v;
}

core::NamedQuantity constant(const std::string& name, std::string_view text) {
  const core::Quantity q = core::parse_quantity(text);
  return {name, q.value, q.dimension};
}

struct Trial {
  std::vector<core::NamedQuantity> constants;
  [[nodiscard]] Expression of(const std::string& text) const {
    return {"wear \"a/b\"", text, constants, steel()};
  }
};

/// What is refused, and where.
std::pair<std::string, std::size_t> refused(const std::string& text,
                                            std::vector<core::NamedQuantity> constants = {}) {
  try {
    const Expression e("wear \"a/b\"", text, std::move(constants), steel());
    ADD_FAILURE() << text << " was accepted";
  } catch (const ExpressionError& error) {
    return {error.what(), error.position};
  }
  return {};
}
void expect_refused(const std::string& text, std::size_t position, const std::string& part,
                    std::vector<core::NamedQuantity> constants = {}) {
  const auto [message, at] = refused(text, std::move(constants));
  EXPECT_EQ(at, position) << text << ": " << message;
  EXPECT_NE(message.find(part), std::string::npos) << text << ": " << message;
}

const WorkSample kWork{.contact = {3.0, 2e-7}, .shear_work = 4e-7, .normal_loss = 5e-8};
const ContactLoad kLoad{.F_t = 1.5, .v_t = 0.2, .dt = 1e-6, .radius = 4e-3, .mass = 1e-3, .weight = 1.0};

TEST(Expression, SeesTheContact) {
  const Trial t{{constant("W", "1 J"), constant("V", "1 m^3"), constant("F", "1 N"), constant("L", "1 m"),
                 constant("T", "1 s"), constant("M", "1 kg"), constant("p", "1 Pa")}};
  const auto value = [&](const std::string& text) { return t.of(text).of_step(kWork, kLoad); };
  EXPECT_EQ(value("V * Fn / F"), 3.0);
  EXPECT_EQ(value("V * Ft / F"), 1.5);
  EXPECT_EQ(value("V * slip / L"), 2e-7);
  EXPECT_EQ(value("V * v_slide * T / L"), 0.2);
  EXPECT_EQ(value("V * shear_work / W"), 4e-7);
  EXPECT_EQ(value("V * normal_work / W"), 5e-8);
  EXPECT_EQ(value("V * dt / T"), 1e-6);
  EXPECT_DOUBLE_EQ(value("V * m / M * dt / T"), 1e-9);
  EXPECT_DOUBLE_EQ(value("V * R / L * dt / T"), 4e-9);
  EXPECT_DOUBLE_EQ(value("V * H / p * dt / T"), 2e3);
  EXPECT_DOUBLE_EQ(value("V * (mu + nu + nu_p) * dt / T"), 0.95e-6);
  // Hertz: a^3 = 3 F R / (4 E), p_0 = 3 F / (2 pi a^2).
  const double a = std::cbrt(0.75 * 3.0 * 4e-3 / 44e9);
  EXPECT_DOUBLE_EQ(value("a^2 * L * dt / T"), a * a * 1e-6);
  EXPECT_DOUBLE_EQ(value("V * p_max / p * dt / T"), 1.5 * 3.0 / (std::numbers::pi * a * a) * 1e-6);
  EXPECT_DOUBLE_EQ(value("V * p_mean / p * dt / T"), 3.0 / (std::numbers::pi * a * a) * 1e-6);
}

/// Where two rules share a contact it is seen whole, and each takes its part.
TEST(Expression, SeesASharedContactWhole) {
  const Trial t{{constant("k", "1e-12 1/Pa"), constant("F0", "1 N")}};
  const auto whole = t.of("k * Fn^2 / F0 * slip").of_step(kWork, kLoad);
  ContactLoad half = kLoad;
  half.weight = 0.25, half.F_t *= 0.25;
  const WorkSample part{.contact = {0.75, 2e-7}, .shear_work = 1e-7, .normal_loss = 1.25e-8};
  EXPECT_DOUBLE_EQ(t.of("k * Fn^2 / F0 * slip").of_step(part, half), 0.25 * whole);
}

TEST(Expression, SeesAnImpact) {
  const Trial t{{constant("k", "2e-11 1/Pa")}};
  const Expression e = t.of("k * m * v^2 * sin(angle)^2 * (2 * R > 1e-9 * R ? 1 : 0)");
  EXPECT_TRUE(e.by_impact());
  EXPECT_FALSE(t.of("k * Fn * slip").by_impact());
  EXPECT_DOUBLE_EQ(e.of_impact({20.0, 0.5, 1e-3, 8e-3}), 2e-11 * 1e-3 * 400.0 * std::pow(std::sin(0.5), 2));
}

TEST(Expression, SaysWhereItIsWrong) {
  const std::vector<core::NamedQuantity> k{constant("k", "1e-12 1/Pa")};
  expect_refused("k * Fm * slip", 4, "unknown name 'Fm' at character 5, did you mean 'Fn'?", k);
  expect_refused("kk * Fn * slip", 0, "unknown name 'kk'", {});
  expect_refused("k * sine(angle) * m * v^2", 4,
                 "unknown function 'sine' at character 5, did you mean 'sin'?", k);
  expect_refused("k * Fn * (slip", 14, "parenthesis is missing at the end", k);
  expect_refused("k * Fn * slip)", 13, "unexpected parenthesis at character 14", k);
  expect_refused("k * Fn * ", 9, "cut short", k);
  expect_refused("k * / Fn * slip", 4, "unexpected '/'", k);
  expect_refused("k * Fn slip", 7, "unexpected 'slip'", k);
  expect_refused("Fn = 3", 3, "assigns nothing", k);
  expect_refused("k * Fn, slip", std::string::npos, "2 results", k);
  expect_refused("k * min(Fn) * slip", 10, "too few arguments", k);
  expect_refused("  ", std::string::npos, "empty");
  expect_refused("k * H_p * slip^3 / k / H_p", 4, "'H_p' at character 5 is the hardness of the particle", k);
  expect_refused("k * m * v^2 * slip / R", 8,
                 "'v' at character 9 belongs to an impact, and 'slip' at character 15", k);
  expect_refused("R^3", std::string::npos, "names nothing that a contact does");
  expect_refused("k * Fn * slip", std::string::npos, "constant 'Fn': this name has a meaning",
                 {constant("Fn", "1 N")});
  expect_refused("k * Fn * slip", std::string::npos, "constant '2k'", {constant("2k", "1")});
  expect_refused(std::string(3000, '1'), std::string::npos, "3000 characters");
}

TEST(Expression, HasTheUnitOfAVolume) {
  const std::vector<core::NamedQuantity> k{constant("k", "1e-12 1/Pa"), constant("F0", "3 N"),
                                           constant("n", "1.7")};
  expect_refused("1e-12 * Fn * slip", std::string::npos, "an energy or a torque [J]");
  expect_refused("k * Fn", std::string::npos, "expected a volume", k);
  expect_refused("k * Fn^1.5 * slip", std::string::npos, "kg^0.5 m^3.5 s^-1", k);
  expect_refused("k * (Fn + 3) * slip", std::string::npos, "has no unit of its own", k);
  expect_refused("Fn > 3 ? k * Fn * slip : 0", std::string::npos, "has no unit of its own", k);
  expect_refused("k * Fn * slip * exp(v_slide)", std::string::npos, "has no unit of its own", k);
  const Trial t{k};
  EXPECT_TRUE(t.of("k * F0 * (Fn / F0)^n * slip").proportional_to_step());
  EXPECT_TRUE(t.of("Fn > F0 ? k * (Fn - F0) * slip : 0").proportional_to_step());
  EXPECT_TRUE(t.of("0 * k * Fn * slip").proportional_to_step());
  EXPECT_FALSE(t.of("k * Fn * a").proportional_to_step());
  // Values that a double can hardly hold, or not at all, say nothing about the unit.
  EXPECT_TRUE(t.of("k * Fn * slip * exp(-E / p_max)").proportional_to_step());
  EXPECT_TRUE(t.of("k * Fn * slip * (Fn / F0)^40").proportional_to_step());
  EXPECT_TRUE(t.of("k * Fn * slip * (sqrt(a^2 + R^2) - R) / R").proportional_to_step());
  EXPECT_TRUE(t.of("k * m * v^2").proportional_to_step());
  // A coefficient of 0 has a unit too.
  expect_refused("c * Fn", std::string::npos, "expected a volume", {constant("c", "0 1/Pa")});
  EXPECT_EQ(Trial{{constant("c", "0 1/Pa")}}.of("c * Fn * slip").of_step(kWork, kLoad), 0.0);
}

TEST(Expression, IsAVolumeWhereContactsPass) {
  const std::vector<core::NamedQuantity> k{constant("k", "1e-12 1/Pa"), constant("F0", "1 N"),
                                           constant("z", "0 Pa"), constant("v0", "10 m/s")};
  expect_refused("k * Fn * slip / (z / H)", std::string::npos, "it gives inf", k);
  expect_refused("-k * Fn * slip", std::string::npos, "it gives -", k);
  expect_refused("k * shear_work^2 / slip / Fn * Fn / Fn", std::string::npos,
                 "where a contact does not slide", k);
  expect_refused("k * F0^2 / Fn * slip", std::string::npos, "where a contact ends", k);
  expect_refused("k * (Fn - F0) * slip", std::string::npos, "where a contact ends", k);
  EXPECT_EQ(Trial{k}.of("k * max(0, Fn - F0) * slip").of_step({{0.5, 1e-7}, 0.0, 0.0}, kLoad), 0.0);
  const Trial t{k};
  EXPECT_EQ(t.of("Fn > 0 ? k * F0^2 / Fn * slip : 0").of_step({{0.0, 1e-7}, 0.0, 0.0}, kLoad), 0.0);
  // Above 10 m/s it would give back.
  const Expression less = t.of("k * Fn * slip * (1 - v_slide / v0)");
  EXPECT_GT(less.of_step(kWork, kLoad), 0.0);
  ContactLoad fast = kLoad;
  fast.v_t = 20.0;
  try {
    (void)less.of_step({{0.25, 1e-7}, 0.0, 0.0}, fast);
    FAIL();
  } catch (const SimulationError& error) {
    EXPECT_EQ(std::string(error.what()),
              "wear \"a/b\": the expression gives -2.5e-20 m^3 where Fn = 0.25 N, slip = 1e-07 m, v_slide = "
              "20 m/s; a volume "
              "is finite and not below 0. Let it be 0 there: max(0, …), or condition ? … : 0");
  }
}

TEST(Expression, KnowsItsLike) {
  const Trial a{{constant("k", "1e-12 1/Pa")}}, b{{constant("k", "2e-12 1/Pa")}};
  EXPECT_TRUE(a.of("k*Fn*slip").same_as(a.of("k*Fn*slip")));
  EXPECT_FALSE(a.of("k*Fn*slip").same_as(a.of("k*slip*Fn")));
  EXPECT_FALSE(a.of("k*Fn*slip").same_as(b.of("k*Fn*slip")));
  EXPECT_TRUE(a.of("k*Fn*slip").names("k"));
  EXPECT_FALSE(a.of("Fn/H*slip").names("k"));
}

}  // namespace
}  // namespace abradem::wear
