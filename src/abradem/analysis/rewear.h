// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "abradem/wear/wear_map.h"

/// Wear by other laws or coefficients, from what a run has recorded.              docs/reference/rewear.md
namespace abradem::analysis {

/// What one material did to one element, in the test.
struct RecordedElement {
  int wall = 0, abrader = 0, region = 0, element = 0;
  double area = 0.0;  ///< [m^2]
  wear::WearMap::Element sums;
  wear::Impact impact;  ///< mean of those that fell here; its mass is that of all together; none: no mass
};

/// A class of the impacts of one material on one region of a wall, as its mean.
struct RecordedImpacts {
  int wall = 0, abrader = 0, region = 0;
  wear::Impact mean;   ///< its mass is that of all together
  double count = 0.0;  ///< of the test [-]
};

/// A class of the contacts that slide, of one material in one region of a wall.
struct RecordedSliding {
  int wall = 0, abrader = 0, region = 0;
  wear::SlidingSums sums;
  double speed = 0.0;  ///< in the middle of the class; the sliding is that of plastic slip, less than speed
                       ///< times time [m/s]
};

struct Recorded {
  std::vector<RecordedElement> elements;  ///< by wall, then abrader, then element
  std::vector<RecordedImpacts> impacts;
  std::vector<RecordedSliding> sliding;
};

/// How a material wore a wall in the run, and how it is to wear it.
struct LawChange {
  int wall = 0, abrader = 0;
  wear::Laws before, after;
  double radius = 0.0, mass = 0.0;  ///< of its spheres, where an expression of steps needs them [m, kg]
};

/// An expression of steps as a sum of what a map keeps of each element, each times a number.
struct LinearExpression {
  double force_sliding = 0.0;                  ///< of F_n s [1/Pa]
  double shear_work = 0.0, normal_work = 0.0;  ///< [m^3/J]
};
/// @return nothing where it is no such sum, or cannot be known to be one everywhere
[[nodiscard]] std::optional<LinearExpression> linear_expression(const wear::Expression& expression);
/// Does nothing wear where nothing slides, whatever else a contact does?
[[nodiscard]] bool wears_by_sliding_alone(const wear::Expression& expression);

struct RewornElement {
  int wall = 0, element = 0, region = 0;
  double area = 0.0;
  wear::MechanismVolumes volumes{};  ///< of all abraders [m^3]
};

struct RewornRegion {
  int wall = 0, region = 0;
  wear::MechanismVolumes volumes{};
  bool exact = true;  ///< nothing in it comes from classes
};

struct Reworn {
  std::vector<RewornElement> elements;  ///< by wall, then element
  std::vector<RewornRegion> regions;    ///< those that were touched, by wall, then region
};

/// Laws by work are exact: their coefficients times the sums of each element. So are Finnie's and Oka's where
/// the run had them and nothing but the coefficient is other, and linear expressions. Else each class of
/// impacts counts as its mean, and the region's volume is shared out among its elements as their mean impacts
/// would wear them. So it is with another expression by impact; one of steps (proportional to them, worn by
/// sliding alone) takes each class of contacts that slide as its mean, and is shared out as Archard's law
/// would be.
[[nodiscard]] Reworn rewear(const Recorded& recorded, const std::vector<LawChange>& changes);

}  // namespace abradem::analysis
