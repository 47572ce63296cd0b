// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <optional>
#include <string_view>

#include "abradem/wear/archard.h"
#include "abradem/wear/expression.h"

/// Laws of wear beside Archard's, as pure functions of plain samples of a contact.   docs/theory/wear.md#laws
namespace abradem::wear {

/// In the order of simulation::WearLaw.
enum class Mechanism { archard, shear_work, finnie, oka, impact_energy, expression };
inline constexpr std::size_t kMechanisms = 6;
/// As the case, the tables and run.json call them.
inline constexpr std::array<std::string_view, kMechanisms> kMechanismNames{
    "archard", "shear_work", "finnie", "oka", "impact_energy", "expression"};
/// Volume by mechanism [m^3].
using MechanismVolumes = std::array<double, kMechanisms>;

/// What one contact does in one step.
struct WorkSample {
  ContactSample contact;
  double shear_work = 0.0;   ///< of friction over the plastic slip, >= 0 [J]
  double normal_loss = 0.0;  ///< dissipated by the normal damper, >= 0 [J]
};

/// A sphere that has struck a wall: as it was when they first touched.
struct Impact {
  double speed = 0.0;     ///< of the sphere's surface against the wall's, at the contact [m/s]
  double angle = 0.0;     ///< of that velocity from the surface, 0 … pi/2 [rad]
  double mass = 0.0;      ///< [kg]
  double diameter = 0.0;  ///< [m]
};

/// Finnie's cutting law: V = k m v^2 f(a), k = c / (psi p), with the angle function of `finnie_function`.
/// Finnie, Wear 3 (1960) 87.
struct FinnieLaw {
  double coefficient = 0.0;  ///< k [1/Pa]
  double force_ratio = 2.0;  ///< K, normal over tangential force on the grain [-]
};
/// f(a) = (sin 2a - (6/K) sin^2 a) / K where tan a <= K / 6, cos^2 a / 6 beyond; with K = 2 half of
/// sin 2a - 3 sin^2 a, cos^2 a / 3.
[[nodiscard]] double finnie_function(double force_ratio, double angle) noexcept;
[[nodiscard]] double finnie_volume(const FinnieLaw& law, const Impact& impact) noexcept;

/// Oka's erosion law: V = m E_90 g(a), E_90 = E_ref (v / v_ref)^k2 (D / D_ref)^k3.
/// Oka, Okamura & Yoshida, Wear 259 (2005) 95; Oka & Yoshida, ibid. 102.
struct OkaLaw {
  double reference_erosion = 0.0;      ///< E_ref: at 90 degrees, v_ref and D_ref [m^3/kg]
  double reference_speed = 104.0;      ///< v_ref [m/s]
  double reference_diameter = 326e-6;  ///< D_ref [m]
  double speed_exponent = 0.0;         ///< k2 [-]
  double diameter_exponent = 0.19;     ///< k3 [-]
  double hardness = 0.0;               ///< Vickers hardness of the wall [GPa]
  double n1 = 0.0, n2 = 0.0;           ///< exponents of the angle function [-]
  bool operator==(const OkaLaw&) const = default;

  /// The constants of SiO2 grains on a metal of this hardness [Pa] (Oka & Yoshida 2005, Table 3).
  [[nodiscard]] static OkaLaw of_hardness(double hardness) noexcept;
};
/// g(a) = sin(a)^n1 (1 + Hv (1 - sin a))^n2; 1 at 90 degrees.
[[nodiscard]] double oka_function(const OkaLaw& law, double angle) noexcept;
[[nodiscard]] double oka_volume(const OkaLaw& law, const Impact& impact) noexcept;

/// How one material wears another: the sum of the laws given.
struct Laws {
  double archard = 0.0;        ///< alpha_s [1/Pa]
  double shear_work = 0.0;     ///< C: volume per work of friction [m^3/J]
  double normal_energy = 0.0;  ///< k_n: volume per energy lost by impact along the normal [m^3/J]
  double shear_energy = 0.0;   ///< k_t: … by friction [m^3/J]
  std::optional<FinnieLaw> finnie;
  std::optional<OkaLaw> oka;
  std::shared_ptr<const Expression> expression;
  double of_expression = 1.0;  ///< its volumes count so many times

  [[nodiscard]] bool only_archard() const noexcept {
    return shear_work == 0.0 && normal_energy == 0.0 && shear_energy == 0.0 && !expression && !strikes();
  }
  /// Does any law count impacts one by one?
  [[nodiscard]] bool strikes() const noexcept {
    return finnie || oka || (expression && expression->by_impact());
  }
};

/// Volumes worn by what acts all the time, and added to `volumes`.
/// shear work: dV = C |F_t| ds; impact energy: dV = k_n dE_n + k_t |F_t| ds.
inline void add_work(const Laws& laws, const WorkSample& sample, MechanismVolumes& volumes) noexcept {
  volumes[static_cast<std::size_t>(Mechanism::archard)] += archard_volume(laws.archard, sample.contact);
  volumes[static_cast<std::size_t>(Mechanism::shear_work)] += laws.shear_work * sample.shear_work;
  volumes[static_cast<std::size_t>(Mechanism::impact_energy)] +=
      laws.normal_energy * sample.normal_loss + laws.shear_energy * sample.shear_work;
}
/// … by an expression that is about steps.   @throws SimulationError as Expression::of_step
inline void add_expression(const Laws& laws, const WorkSample& sample, const ContactLoad& load,
                           MechanismVolumes& volumes) {
  if (laws.expression && !laws.expression->by_impact())
    volumes[static_cast<std::size_t>(Mechanism::expression)] +=
        laws.of_expression * laws.expression->of_step(sample, load);
}
/// … by one impact.   @throws SimulationError as Expression::of_impact
void add_impact(const Laws& laws, const Impact& impact, MechanismVolumes& volumes);
[[nodiscard]] inline double total(const MechanismVolumes& volumes) noexcept {
  double sum = 0.0;
  for (const double v : volumes) sum += v;
  return sum;
}

/// The impacts on a wall by their angle.
class ImpactSpectrum {
 public:
  static constexpr std::size_t kBins = 36;  // of 2.5 degrees
  struct Bin {
    std::uint64_t count = 0;
    /// Of the impacts: mass [kg]; mass-weighted sums of the angle [rad kg], speed [m/s kg] and diameter [m
    /// kg]; volume worn [m^3].
    double mass = 0.0, angle = 0.0, speed = 0.0, diameter = 0.0, finnie = 0.0, oka = 0.0, expression = 0.0;

    template <typename Self, typename Archive>
    static void visit(Self& self, Archive& archive) {
      archive("count", self.count)("mass", self.mass)("angle", self.angle)("speed", self.speed);
      archive("diameter", self.diameter)("finnie", self.finnie)("oka", self.oka);
      archive("expression", self.expression);
    }
  };
  [[nodiscard]] static double low(std::size_t bin) noexcept {
    return 0.5 * std::numbers::pi * static_cast<double>(bin) / static_cast<double>(kBins);
  }

  /// @param volumes of this impact
  void add(const Impact& impact, const MechanismVolumes& volumes) noexcept;
  [[nodiscard]] const std::array<Bin, kBins>& bins() const noexcept { return bins_; }
  [[nodiscard]] std::uint64_t count() const noexcept;

  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    for (auto& bin : self.bins_) archive("bin", bin);
  }

 private:
  std::array<Bin, kBins> bins_{};
};

}  // namespace abradem::wear
