// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "abradem/core/error.h"
#include "abradem/core/units.h"

/// A law of wear written as a formula.                                      docs/theory/wear.md#expression
namespace abradem::wear {

struct Impact;
struct WorkSample;

/// What an expression may name, in the order of expression_symbols().
enum class Symbol {
  Fn,
  Ft,
  slip,
  v_slide,
  shear_work,
  normal_work,
  a,
  p_mean,
  p_max,
  dt,
  v,
  angle,
  m,
  R,
  mu,
  E_eff,
  H,
  E,
  nu,
  rho,
  H_p,
  E_p,
  nu_p,
  rho_p
};
inline constexpr std::size_t kSymbols = 24;
/// SI; NaN where the case does not give it.
using SymbolValues = std::array<double, kSymbols>;

struct SymbolInfo {
  std::string_view name;
  /// What it belongs to: a contact in one step, one impact, the sphere, or the pair of materials.
  enum class Of { step, impact, sphere, materials } of;
  std::string_view unit;     ///< SI; empty: dimensionless
  double low, high;          ///< where it usually lies; only expressions are tried with it
  std::string_view meaning;  ///< one line
};
[[nodiscard]] std::span<const SymbolInfo> expression_symbols() noexcept;

/// An expression that cannot be used. `position` counts bytes from its start; npos: it is about the whole.
struct ExpressionError : InputError {
  ExpressionError(std::size_t at, const std::string& message) : InputError(message), position(at) {}
  std::size_t position;
};

/// How a contact is loaded in one step, besides its work.
struct ContactLoad {
  double F_t = 0.0;     ///< size of the tangential force [N]
  double v_t = 0.0;     ///< sliding speed [m/s]
  double dt = 0.0;      ///< [s]
  double radius = 0.0;  ///< of the sphere [m]
  double mass = 0.0;    ///< [kg]
  double weight = 1.0;  ///< share of the contact that forces and work have [-]
};

/// Volume worn, per contact and time step, or, where it names what belongs to an impact, per impact.
/// Not for several threads at once.
class Expression {
 public:
  /// @param title begins every message of a run, such as 'wear "ore/steel"'
  /// @param materials those of SymbolInfo::Of::materials count
  /// @throws ExpressionError where it is no expression, names what there is not, has no unit of its own or
  /// another than m^3, or is no volume (NaN, infinite, negative) wherever a contact begins or sticks
  Expression(std::string title, std::string text, std::vector<core::NamedQuantity> constants,
             const SymbolValues& materials);
  ~Expression();
  Expression(const Expression&) = delete;
  Expression& operator=(const Expression&) = delete;
  Expression(Expression&&) = delete;
  Expression& operator=(Expression&&) = delete;

  [[nodiscard]] const std::string& text() const noexcept { return text_; }
  /// Does it count impacts one by one?
  [[nodiscard]] bool by_impact() const noexcept { return by_impact_; }
  [[nodiscard]] bool names(Symbol symbol) const noexcept { return names_[static_cast<std::size_t>(symbol)]; }
  [[nodiscard]] bool names(std::string_view constant) const noexcept;
  /// Is the volume of half a step half the volume? Else it depends on the time step. By impact: always.
  [[nodiscard]] bool proportional_to_step() const noexcept { return proportional_; }
  /// Do both say the same of every contact?
  [[nodiscard]] bool same_as(const Expression& other) const noexcept;

  /// Volume of one contact in one step [m^3]; for those not by impact.
  /// @throws SimulationError where it is no volume
  [[nodiscard]] double of_step(const WorkSample& work, const ContactLoad& load) const;
  /// Volume of one impact [m^3]; for those by impact.   @throws SimulationError as of_step
  [[nodiscard]] double of_impact(const Impact& impact) const;

 private:
  struct Program;
  [[nodiscard]] double checked() const;
  void read();
  void find_names();
  void check_unit() const;
  void check_corners();

  std::string title_, text_;
  std::vector<core::NamedQuantity> constants_;
  SymbolValues materials_;
  std::array<bool, kSymbols> names_{};
  std::vector<char> names_constant_;
  bool by_impact_ = false, proportional_ = true, needs_radius_ = false;
  std::unique_ptr<Program> program_;
};

}  // namespace abradem::wear
