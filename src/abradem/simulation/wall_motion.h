// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "abradem/geometry/pose.h"
#include "abradem/simulation/setup.h"

/// Where walls stand and how fast they go: closed forms of the time, so that nothing drifts.
namespace abradem::simulation {

/// One motion alone at a time [s].
[[nodiscard]] geometry::Pose pose_of(const MotionSetup& motion, double time) noexcept;
/// The first `count` motions of a wall, each carried by the next.
[[nodiscard]] geometry::Pose pose_of(const WallSetup& wall, std::size_t count, double time) noexcept;

/// Largest over all time.
struct MotionLimits {
  double speed = 0.0;         ///< of the centre of rotation [m/s]
  double rate = 0.0;          ///< of rotation [rad/s]
  double displacement = 0.0;  ///< from where the wall was put [m]; infinite for a translation
};
[[nodiscard]] MotionLimits limits_of(const MotionSetup& motion) noexcept;

/// The first motion of a wall that is one; else none of kind `none`.
[[nodiscard]] const MotionSetup& leading_motion(const WallSetup& wall) noexcept;
/// The first motion of a wall that turns or oscillates; nullptr where none does.
[[nodiscard]] const MotionSetup* cyclic_motion(const WallSetup& wall) noexcept;
/// Time of one turn or cycle of that motion [s].
[[nodiscard]] std::optional<double> period_of(const WallSetup& wall) noexcept;
/// … of the first wall that has one; 0 where none has [s].
[[nodiscard]] double period_of(const std::vector<WallSetup>& walls) noexcept;

/// What is wrong with a motion's table, and in which row; nothing for other motions.
struct TableProblem {
  std::size_t row = 0;
  std::string what;
};
[[nodiscard]] std::optional<TableProblem> problem_of_table(const MotionSetup& motion);

}  // namespace abradem::simulation
