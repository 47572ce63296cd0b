// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/wear/expression.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <muParser.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "abradem/core/suggest.h"
#include "abradem/wear/laws.h"

namespace abradem::wear {

namespace {

using Of = SymbolInfo::Of;

constexpr std::array<SymbolInfo, kSymbols> kTable{{
    {"Fn", Of::step, "N", 1e-3, 1e3, "normal force, 0 where the contact pulls"},
    {"Ft", Of::step, "N", 1e-4, 1e3, "tangential force"},
    {"slip", Of::step, "m", 1e-9, 1e-4, "sliding distance of the step"},
    {"v_slide", Of::step, "m/s", 1e-3, 1e2, "sliding speed"},
    {"shear_work", Of::step, "J", 1e-9, 1e-3, "work of friction in the step, Ft * slip"},
    {"normal_work", Of::step, "J", 1e-9, 1e-3, "work lost to the normal damper in the step"},
    {"a", Of::step, "m", 1e-6, 1e-2, "radius of Hertz's contact under Fn"},
    {"p_mean", Of::step, "Pa", 1e5, 1e10, "mean pressure of that contact, Fn / (pi a^2)"},
    {"p_max", Of::step, "Pa", 1e5, 1e10, "its peak pressure, 3/2 p_mean"},
    {"dt", Of::step, "s", 1e-8, 1e-3, "length of the step"},
    {"v", Of::impact, "m/s", 1e-2, 3e2, "speed of the sphere's surface against the wall at first touch"},
    {"angle", Of::impact, "", 0.05, 1.55, "of that velocity from the surface, 0 to pi/2 [rad]"},
    {"m", Of::sphere, "kg", 1e-6, 1e2, "mass of the sphere (of a clump: the whole)"},
    {"R", Of::sphere, "m", 1e-4, 1e0, "radius of the sphere"},
    {"mu", Of::materials, "", 0.1, 1.0, "static_friction of the pair"},
    {"E_eff", Of::materials, "Pa", 1e8, 1e12, "effective Young's modulus of the pair"},
    {"H", Of::materials, "Pa", 1e7, 1e11, "hardness of the wall"},
    {"E", Of::materials, "Pa", 1e8, 1e12, "Young's modulus of the wall"},
    {"nu", Of::materials, "", 0.1, 0.5, "Poisson's ratio of the wall"},
    {"rho", Of::materials, "kg/m^3", 5e2, 2e4, "density of the wall"},
    {"H_p", Of::materials, "Pa", 1e7, 1e11, "hardness of the particle"},
    {"E_p", Of::materials, "Pa", 1e8, 1e12, "Young's modulus of the particle"},
    {"nu_p", Of::materials, "", 0.1, 0.5, "Poisson's ratio of the particle"},
    {"rho_p", Of::materials, "kg/m^3", 5e2, 2e4, "density of the particle"},
}};

std::size_t at(Symbol s) noexcept { return static_cast<std::size_t>(s); }

using Function = double (*)(double);
struct NamedFunction {
  const char* name;
  Function of;
};
constexpr std::array kFunctions{
    NamedFunction{"sin", [](double x) { return std::sin(x); }},
    NamedFunction{"cos", [](double x) { return std::cos(x); }},
    NamedFunction{"tan", [](double x) { return std::tan(x); }},
    NamedFunction{"asin", [](double x) { return std::asin(x); }},
    NamedFunction{"acos", [](double x) { return std::acos(x); }},
    NamedFunction{"atan", [](double x) { return std::atan(x); }},
    NamedFunction{"exp", [](double x) { return std::exp(x); }},
    NamedFunction{"ln", [](double x) { return std::log(x); }},
    NamedFunction{"log10", [](double x) { return std::log10(x); }},
    NamedFunction{"sqrt", [](double x) { return std::sqrt(x); }},
    NamedFunction{"cbrt", [](double x) { return std::cbrt(x); }},
    NamedFunction{"abs", [](double x) { return std::abs(x); }},
};
double smaller(double x, double y) { return std::min(x, y); }
double larger(double x, double y) { return std::max(x, y); }

bool starts_name(char c) noexcept { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool goes_on(char c) noexcept { return starts_name(c) || std::isdigit(static_cast<unsigned char>(c)) != 0; }

bool is_function(std::string_view name) {
  return name == "min" || name == "max" ||
         std::ranges::any_of(kFunctions, [&](const NamedFunction& f) { return name == f.name; });
}
std::optional<std::size_t> symbol_named(std::string_view name) {
  const auto found = std::ranges::find(kTable, name, &SymbolInfo::name);
  return found == kTable.end() ? std::nullopt
                               : std::optional(static_cast<std::size_t>(found - kTable.begin()));
}

/// Every name in a text with its place, and whether it is called.
struct Word {
  std::string_view name;
  std::size_t place;
  bool called;
};
std::vector<Word> words_of(std::string_view text) {
  std::vector<Word> words;
  for (std::size_t i = 0; i < text.size();) {
    const bool digit = std::isdigit(static_cast<unsigned char>(text[i])) != 0;
    if (!starts_name(text[i])) {
      // The exponent of a number is no name.
      if (const std::size_t e = text.find_first_not_of("0123456789.", i);
          digit && e != text.npos && (text[e] == 'e' || text[e] == 'E'))
        i = e;
      ++i;
      continue;
    }
    std::size_t end = i;
    while (end < text.size() && goes_on(text[end])) ++end;
    const std::size_t next = text.find_first_not_of(" \t", end);
    words.push_back({text.substr(i, end - i), i, next != text.npos && text[next] == '('});
    i = end;
  }
  return words;
}

std::string character(std::size_t position) { return fmt::format("at character {}", position + 1); }

/// What the parser found wrong, in our words.
std::string complaint(const mu::Parser::exception_type& e) {
  const std::string& token = e.GetToken();
  switch (e.GetCode()) {
    case mu::ecUNEXPECTED_EOF:
      return "the expression is cut short: something is missing";
    case mu::ecMISSING_PARENS:
      return "a closing parenthesis is missing";
    case mu::ecUNEXPECTED_PARENS:
      return "unexpected parenthesis";
    case mu::ecTOO_MANY_PARAMS:
      return fmt::format("too many arguments of {}", token);
    case mu::ecTOO_FEW_PARAMS:
      return fmt::format("too few arguments of {}", token);
    case mu::ecMISSING_ELSE_CLAUSE:
      return "'condition ? this : that' lacks its ':'";
    case mu::ecMISPLACED_COLON:
      return "':' without its '?'";
    default:
      return token.empty() ? "this is no expression" : fmt::format("unexpected '{}'", token);
  }
}
ExpressionError refused(const mu::Parser::exception_type& e, const std::string& text) {
  const bool placed = e.GetPos() >= 0 && static_cast<std::size_t>(e.GetPos()) < text.size();
  const std::size_t place = placed ? static_cast<std::size_t>(e.GetPos()) : text.size();
  return {place, fmt::format("{} {}", complaint(e), placed ? character(place) : "at the end")};
}

/// Values that a contact may well have, each time others: the n-th of a fixed sequence. Every second one goes
/// far beyond.
SymbolValues sample(std::size_t n) {
  SymbolValues values;
  for (std::size_t s = 0; s < kSymbols; ++s) {
    // Fractional parts of n sqrt(p), p the square-free numbers from 2.
    constexpr std::array<double, kSymbols> kRoots{2,  3,  5,  6,  7,  10, 11, 13, 14, 15, 17, 19,
                                                  21, 22, 23, 26, 29, 30, 31, 33, 34, 35, 37, 38};
    const double x = static_cast<double>(n + 1) * std::sqrt(kRoots[s]), u = x - std::floor(x);
    const double beyond = n % 2 == 1 && !kTable[s].unit.empty() ? 1e3 : 1.0, low = kTable[s].low / beyond,
                 high = kTable[s].high * beyond;
    values[s] = low * std::pow(high / low, u);
  }
  return values;
}
constexpr std::size_t kSamples = 64;

core::Dimension dimension_of(std::size_t symbol) {
  return kTable[symbol].unit.empty() ? core::Dimension{} : core::parse_unit(kTable[symbol].unit).dimension;
}

}  // namespace

std::span<const SymbolInfo> expression_symbols() noexcept { return kTable; }

/// The parsed text and the places its names stand for.
struct Expression::Program {
  mu::Parser parser;
  SymbolValues values{};
  std::vector<double> constants;

  /// @param fixed what does not change in a run is folded in
  Program(const Expression& e, bool fixed) {
    parser.ClearFun();
    for (const NamedFunction& f : kFunctions) parser.DefineFun(f.name, f.of);
    parser.DefineFun("min", smaller);
    parser.DefineFun("max", larger);
    parser.ClearConst();
    parser.DefineConst("pi", std::numbers::pi);
    values = e.materials_;
    for (const core::NamedQuantity& c : e.constants_) constants.push_back(c.value);
    for (std::size_t s = 0; s < kSymbols; ++s) {
      const std::string name(kTable[s].name);
      if (fixed && kTable[s].of == Of::materials)
        parser.DefineConst(name, values[s]);
      else
        parser.DefineVar(name, &values[s]);
    }
    for (std::size_t k = 0; k < constants.size(); ++k) {
      if (fixed)
        parser.DefineConst(e.constants_[k].name, constants[k]);
      else
        parser.DefineVar(e.constants_[k].name, &constants[k]);
    }
    parser.SetExpr(e.text_);
  }
};

Expression::Expression(std::string title, std::string text, std::vector<core::NamedQuantity> constants,
                       const SymbolValues& materials)
    : title_(std::move(title)),
      text_(std::move(text)),
      constants_(std::move(constants)),
      materials_(materials),
      names_constant_(constants_.size(), 0) {
  find_names();
  try {
    read();
    check_unit();
    check_corners();
  } catch (const mu::Parser::exception_type& e) {
    throw refused(e, text_);
  }
}

Expression::~Expression() = default;

bool Expression::names(std::string_view constant) const noexcept {
  const auto found = std::ranges::find(constants_, constant, &core::NamedQuantity::name);
  return found != constants_.end() &&
         names_constant_[static_cast<std::size_t>(found - constants_.begin())] != 0;
}

bool Expression::same_as(const Expression& other) const noexcept {
  if (text_ != other.text_ || constants_ != other.constants_) return false;
  for (std::size_t s = 0; s < kSymbols; ++s)
    if (names_[s] && kTable[s].of == Of::materials && materials_[s] != other.materials_[s]) return false;
  return true;
}

/// Which names it uses, and whether they go together.
void Expression::find_names() {
  constexpr std::size_t kLongest = 2000;
  if (text_.find_first_not_of(" \t\n") == text_.npos)
    throw ExpressionError(text_.npos, "the expression is empty");
  if (text_.size() > kLongest)
    throw ExpressionError(text_.npos, fmt::format("the expression has {} characters; at most {} are possible",
                                                  text_.size(), kLongest));
  std::vector<std::string_view> known;
  for (const SymbolInfo& s : kTable) known.push_back(s.name);
  for (const core::NamedQuantity& c : constants_) {
    const std::string& name = c.name;
    if (name.empty() || !starts_name(name[0]) || !std::ranges::all_of(name, goes_on))
      throw ExpressionError(text_.npos,
                            fmt::format("constant '{}': a name has letters, digits and _, and begins "
                                        "with none of the digits",
                                        name));
    if (symbol_named(name) || is_function(name) || name == "pi")
      throw ExpressionError(
          text_.npos, fmt::format("constant '{}': this name has a meaning of its own; choose another", name));
    known.push_back(name);
  }
  known.push_back("pi");

  std::optional<Word> of_step, of_impact;
  for (const Word& word : words_of(text_)) {
    if (word.called ? is_function(word.name) : word.name == "pi") continue;
    if (const auto s = symbol_named(word.name); s && !word.called) {
      names_[*s] = true;
      if (kTable[*s].of == Of::step) of_step = word;
      if (kTable[*s].of == Of::impact) of_impact = word;
      if (kTable[*s].of == Of::materials && std::isnan(materials_[*s]))
        throw ExpressionError(word.place, fmt::format("'{}' {} is the {}, which the case does not give",
                                                      word.name, character(word.place), kTable[*s].meaning));
      continue;
    }
    const auto c = std::ranges::find(constants_, word.name, &core::NamedQuantity::name);
    if (c != constants_.end() && !word.called) {
      names_constant_[static_cast<std::size_t>(c - constants_.begin())] = 1;
      continue;
    }
    std::vector<std::string_view> choices = known;
    if (word.called) {
      choices = {"min", "max"};
      for (const NamedFunction& f : kFunctions) choices.emplace_back(f.name);
    }
    const std::string nearest = core::nearest_spelling(word.name, choices);
    throw ExpressionError(word.place,
                          fmt::format("unknown {} '{}' {}{}; known are {}", word.called ? "function" : "name",
                                      word.name, character(word.place),
                                      nearest.empty() ? "" : fmt::format(", did you mean '{}'?", nearest),
                                      fmt::join(choices, ", ")));
  }
  by_impact_ = of_impact.has_value();
  if (of_step && of_impact)
    throw ExpressionError(
        of_impact->place,
        fmt::format("'{}' {} belongs to an impact, and '{}' {} to a step of a contact; an "
                    "expression is about one of them",
                    of_impact->name, character(of_impact->place), of_step->name, character(of_step->place)));
  if (!of_step && !of_impact)
    throw ExpressionError(
        text_.npos,
        "the expression names nothing that a contact does, such as Fn, slip, shear_work, or an "
        "impact, such as v, angle");
  needs_radius_ = names(Symbol::a) || names(Symbol::p_mean) || names(Symbol::p_max);
  if (needs_radius_ && std::isnan(materials_[at(Symbol::E_eff)]))
    throw ExpressionError(text_.npos, "the radius of Hertz's contact needs a [contact] of the two materials");
}

void Expression::read() {
  for (std::size_t i = 0; i < text_.size(); ++i) {
    if (text_[i] != '=') continue;
    const bool compares = text_.substr(i, 2) == "==" ||
                          (i > 0 && std::string_view("=<>!").find(text_[i - 1]) != std::string_view::npos);
    if (!compares)
      throw ExpressionError(i,
                            fmt::format("'=' {}: an expression assigns nothing; equal is ==", character(i)));
  }
  program_ = std::make_unique<Program>(*this, true);
  int results = 0;
  (void)program_->parser.Eval(results);
  if (results != 1)
    throw ExpressionError(
        text_.npos,
        fmt::format("the expression has {} results; a ',' belongs between arguments of a function", results));
}

/// In other units of mass, length and time the volume must be the same, whatever the contact does. The units
/// are powers of two apart, so that round-off is the same in all.
void Expression::check_unit() const {
  Program trial(*this, false);
  for (double& c : trial.constants) c = c == 0.0 ? 1.0 : c;  // a coefficient of 0 has a unit too
  const std::vector<double> constants = trial.constants;
  const auto value = [&](const SymbolValues& v, double mass, double length, double time) {
    const auto scale = [&](const core::Dimension& d) {
      return std::pow(mass, d.mass) * std::pow(length, d.length) * std::pow(time, d.time);
    };
    for (std::size_t s = 0; s < kSymbols; ++s) trial.values[s] = v[s] * scale(dimension_of(s));
    for (std::size_t k = 0; k < constants.size(); ++k)
      trial.constants[k] = constants[k] * scale(constants_[k].dimension);
    return trial.parser.Eval();
  };
  constexpr double kSame = 1e-6, kLeast = 1e-200, kMost = 1e200;  // beyond, doubles run out of bits or range
  std::optional<std::array<double, 3>> powers;
  for (std::size_t n = 0; n < kSamples; ++n) {
    const SymbolValues v = sample(n);
    const double here = value(v, 1.0, 1.0, 1.0);
    if (!(here == 0.0 || (std::abs(here) > kLeast && std::abs(here) < kMost))) continue;
    for (const double factor : {4.0, 1.0 / 4096.0}) {
      std::array<double, 3> found{};
      bool nowhere = here == 0.0, mixed = false;
      for (std::size_t k = 0; k < 3; ++k) {
        const double there = value(v, k == 0 ? factor : 1.0, k == 1 ? factor : 1.0, k == 2 ? factor : 1.0),
                     ratio = there / here;
        if (here == 0.0)
          mixed = mixed || std::abs(there) > kLeast;
        else if (!(ratio > 0.0) || !std::isfinite(ratio))
          mixed = true;
        else
          found[k] = std::log(ratio) / std::log(factor);
      }
      if (nowhere && !mixed) continue;
      for (std::size_t k = 0; k < 3 && !mixed && powers; ++k)
        mixed = std::abs(found[k] - (*powers)[k]) > kSame;
      if (mixed)
        throw ExpressionError(
            text_.npos,
            "the expression has no unit of its own: it adds or compares what has different units, or takes a "
            "function of what has one. A number has no unit; give it as one of constants, such as { F0 = \"1 "
            "N\" }");
      if (!powers) powers = found;
    }
  }
  if (!powers) return;
  const auto [mass, length, time] = *powers;
  if (std::abs(mass) < kSame && std::abs(length - 3.0) < kSame && std::abs(time) < kSame) return;
  const auto whole = [&](double p) { return std::abs(p - std::round(p)) < kSame; };
  const auto power = [](double p) { return static_cast<int>(std::lround(p)); };
  const core::Dimension d{.mass = power(mass), .length = power(length), .time = power(time)};
  const std::string unit = core::si_unit(d), name = core::describe(d);
  throw ExpressionError(
      text_.npos,
      fmt::format(
          "the expression is {}; expected a volume [m^3]. Numbers have no unit: give constants with theirs, "
          "such as constants = {{ k = \"1e-12 1/Pa\" }}",
          whole(mass) && whole(length) && whole(time)
              ? (d == core::Dimension{} ? "a plain number"
                 : name.ends_with(unit) ? name
                                        : fmt::format("{} [{}]", name, unit))
              : fmt::format("a quantity in kg^{:.3g} m^{:.3g} s^{:.3g}", mass, length, time)));
}

/// Is it a volume at all, and also where every contact passes: while it sticks, and where it ends? And is
/// that of half a step half as much?
void Expression::check_corners() {
  Program& p = *program_;
  const auto good = [&](const std::vector<Symbol>& zero) {
    for (std::size_t n = 0; n < kSamples; ++n) {
      SymbolValues v = sample(n);
      for (const Symbol s : zero) v[at(s)] = 0.0;
      p.values = v;
      const double volume = p.parser.Eval();
      if (std::isfinite(volume) && volume >= 0.0) return true;
    }
    return false;
  };
  const auto example = [&] { return fmt::format("{:.3g}", p.parser.Eval()); };
  if (!good({}))
    throw ExpressionError(
        text_.npos,
        fmt::format("the expression is no volume for any of the contacts it was tried with: it gives {}",
                    example()));
  if (by_impact_) return;
  if (!good({Symbol::slip, Symbol::v_slide, Symbol::shear_work}))
    throw ExpressionError(
        text_.npos, fmt::format("the expression gives {} where a contact does not slide (slip, v_slide and "
                                "shear_work are 0), as most do at times; write it without dividing by them, "
                                "or slip > 0 ? … : 0",
                                example()));
  if (!good({Symbol::Fn, Symbol::a, Symbol::p_mean, Symbol::p_max}))
    throw ExpressionError(
        text_.npos, fmt::format("the expression gives {} where a contact ends (Fn, a, p_mean and p_max are "
                                "0); write it without dividing by them, or Fn > 0 ? … : 0",
                                example()));
  for (std::size_t n = 0; n < kSamples && proportional_; ++n) {
    const SymbolValues v = sample(n);
    p.values = v;
    const double whole = p.parser.Eval();
    for (const Symbol s : {Symbol::slip, Symbol::shear_work, Symbol::normal_work, Symbol::dt})
      p.values[at(s)] *= 0.5;
    const double half = p.parser.Eval();
    if (std::isfinite(whole) && std::isfinite(half))
      proportional_ = std::abs(half - 0.5 * whole) <= 1e-9 * std::abs(whole);
  }
}

double Expression::checked() const {
  const double volume = program_->parser.Eval();
  if (volume >= 0.0 && std::isfinite(volume)) return volume;
  std::vector<std::string> values;
  for (std::size_t s = 0; s < kSymbols; ++s)
    if (names_[s])
      values.push_back(fmt::format("{} = {:.6g}{}{}", kTable[s].name, program_->values[s],
                                   kTable[s].unit.empty() ? "" : " ", kTable[s].unit));
  throw SimulationError(
      fmt::format("{}: the expression gives {:.6g} m^3 where {}; a volume is finite and not below 0. Let it "
                  "be 0 there: max(0, …), or condition ? … : 0",
                  title_, volume, fmt::join(values, ", ")));
}

double Expression::of_step(const WorkSample& work, const ContactLoad& load) const {
  SymbolValues& v = program_->values;
  const double F_n = work.contact.F_n / load.weight;
  v[at(Symbol::Fn)] = F_n;
  v[at(Symbol::Ft)] = load.F_t / load.weight;
  v[at(Symbol::slip)] = work.contact.slip;
  v[at(Symbol::v_slide)] = load.v_t;
  v[at(Symbol::shear_work)] = work.shear_work / load.weight;
  v[at(Symbol::normal_work)] = work.normal_loss / load.weight;
  v[at(Symbol::dt)] = load.dt;
  v[at(Symbol::m)] = load.mass;
  v[at(Symbol::R)] = load.radius;
  if (needs_radius_) {  // a^3 = 3 F R / (4 E_eff)
    const double a = std::cbrt(0.75 * F_n * load.radius / materials_[at(Symbol::E_eff)]);
    const double mean = F_n > 0.0 ? F_n / (std::numbers::pi * a * a) : 0.0;
    v[at(Symbol::a)] = a;
    v[at(Symbol::p_mean)] = mean;
    v[at(Symbol::p_max)] = 1.5 * mean;
  }
  return load.weight * checked();
}

double Expression::of_impact(const Impact& impact) const {
  SymbolValues& v = program_->values;
  v[at(Symbol::v)] = impact.speed;
  v[at(Symbol::angle)] = impact.angle;
  v[at(Symbol::m)] = impact.mass;
  v[at(Symbol::R)] = 0.5 * impact.diameter;
  return checked();
}

}  // namespace abradem::wear
