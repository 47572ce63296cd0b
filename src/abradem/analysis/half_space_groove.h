// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// The groove that a guided sphere wears into a flat: closed forms for every stiffness.
///                                                                          docs/theory/groove.md
/// A sphere under a constant force slides n times along one track; material goes by Archard's law where the
/// elastic contact presses (local law), and the track is long. Then depth / d0 depends on one number alone,
/// W = alpha n E*: the wear in units of the elastic contact.
namespace abradem::analysis {

/// A sphere pressed on a flat, both elastic.
struct PressedSphere {
  double radius = 0.0;             ///< R [m]
  double force = 0.0;              ///< F [N]
  double effective_modulus = 0.0;  ///< E* [Pa]

  /// Half-width of the Hertz contact, a0 = (3 F R / (4 E*))^(1/3) [m].
  [[nodiscard]] double half_width() const noexcept;
  /// Hertz approach, d0 = a0^2 / R [m].
  [[nodiscard]] double approach() const noexcept;
};

/// W = alpha n E* [-].   @param wear alpha n, wear coefficient times passes [1/Pa]
[[nodiscard]] double groove_number(double wear, double effective_modulus) noexcept;

/// Depth / d0 of wear too thin to change the contact: W, for the pressure of the middle line integrated along
/// the track.
[[nodiscard]] double thin_wear_depth(double W) noexcept;
/// Depth / d0 of the circular segment that a rigid sphere leaves, (W / sqrt 2)^(2/3), from its section
/// A = (4/3) sqrt(2 R) depth^(3/2) = alpha n F.
[[nodiscard]] double rigid_sphere_depth(double W) noexcept;

/// Depth / d0 between the two: [W^-m + (W / sqrt 2)^(-2 m / 3)]^(-1/m), m = 3.395. Fitted to solutions of the
/// elastic half-space (FFT, conjugate gradients); within 0.37 % of them for 0.002 <= W <= 48. 0 at W = 0.
[[nodiscard]] double half_space_depth(double W) noexcept;
/// Largest relative deviation of half_space_depth() from those solutions, and the range of W it was found in.
inline constexpr double kHalfSpaceDepthError = 0.0037, kHalfSpaceLowest = 0.002, kHalfSpaceHighest = 48.0;

/// W above which half_space_depth() is within a relative `deviation` of the rigid sphere's: beyond it the
/// stiffness of the pin does not matter.   @throws InputError unless 0 < deviation < 0.5
[[nodiscard]] double rigid_from(double deviation);

}  // namespace abradem::analysis
