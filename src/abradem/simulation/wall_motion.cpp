// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/simulation/wall_motion.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace abradem::simulation {

namespace {

using std::numbers::pi;

geometry::Pose pose_of_table(const MotionSetup& m, double time) noexcept {
  const MotionRow &first = m.rows.front(), &last = m.rows.back();
  if (m.after == TableEnd::repeat && time > first.time)
    time = first.time + std::fmod(time - first.time, last.time - first.time);
  const auto next = std::ranges::upper_bound(m.rows, time, {}, &MotionRow::time);
  Vec3 displacement, velocity;
  double angle = 0.0, rate = 0.0;
  if (next == m.rows.begin() || next == m.rows.end()) {
    const MotionRow& there = next == m.rows.begin() ? first : last;
    displacement = there.displacement;
    angle = there.angle;
  } else {
    const MotionRow& row = *(next - 1);
    const double interval = next->time - row.time, since = time - row.time;
    velocity = (next->displacement - row.displacement) / interval;
    rate = (next->angle - row.angle) / interval;
    displacement = row.displacement + since * velocity;
    angle = row.angle + since * rate;
  }
  geometry::Pose pose = geometry::rotation_pose(m.axis, m.center, angle, rate);
  pose.shift = displacement;
  pose.velocity = velocity;
  return pose;
}

bool cyclic(const MotionSetup& m) noexcept {
  return (m.kind == MotionKind::rotation && m.rate != 0.0) ||
         (m.kind == MotionKind::oscillation && m.frequency > 0.0);
}

}  // namespace

geometry::Pose pose_of(const MotionSetup& m, double time) noexcept {
  geometry::Pose pose;
  switch (m.kind) {
    case MotionKind::none:
      break;
    case MotionKind::rotation:
      return geometry::rotation_pose(m.axis, m.center, m.rate * time, m.rate);
    case MotionKind::translation:
      pose.shift = time * m.velocity;
      pose.velocity = m.velocity;
      break;
    case MotionKind::oscillation: {
      const double omega = 2.0 * pi * m.frequency;
      pose.shift = std::sin(omega * time) * m.amplitude;
      pose.velocity = omega * std::cos(omega * time) * m.amplitude;
      break;
    }
    case MotionKind::table:
      return pose_of_table(m, time);
  }
  return pose;
}

geometry::Pose pose_of(const WallSetup& wall, std::size_t count, double time) noexcept {
  if (count == 0) return {};
  geometry::Pose pose = pose_of(wall.motion, time);
  for (std::size_t k = 1; k < count; ++k) pose = geometry::compose(pose_of(wall.motion_at(k), time), pose);
  return pose;
}

MotionLimits limits_of(const MotionSetup& m) noexcept {
  switch (m.kind) {
    case MotionKind::none:
      break;
    case MotionKind::rotation:
      return {.rate = std::abs(m.rate)};
    case MotionKind::translation:
      return {.speed = norm(m.velocity), .displacement = std::numeric_limits<double>::infinity()};
    case MotionKind::oscillation:
      return {.speed = 2.0 * pi * m.frequency * norm(m.amplitude), .displacement = norm(m.amplitude)};
    case MotionKind::table: {
      MotionLimits most;
      for (std::size_t r = 0; r < m.rows.size(); ++r) {
        most.displacement = std::max(most.displacement, norm(m.rows[r].displacement));
        if (r == 0) continue;
        const double interval = m.rows[r].time - m.rows[r - 1].time;
        most.speed =
            std::max(most.speed, norm(m.rows[r].displacement - m.rows[r - 1].displacement) / interval);
        most.rate = std::max(most.rate, std::abs(m.rows[r].angle - m.rows[r - 1].angle) / interval);
      }
      return most;
    }
  }
  return {};
}

const MotionSetup& leading_motion(const WallSetup& wall) noexcept {
  for (std::size_t k = 0; k < wall.motions(); ++k)
    if (wall.motion_at(k).kind != MotionKind::none) return wall.motion_at(k);
  return wall.motion;
}

const MotionSetup* cyclic_motion(const WallSetup& wall) noexcept {
  for (std::size_t k = 0; k < wall.motions(); ++k)
    if (cyclic(wall.motion_at(k))) return &wall.motion_at(k);
  return nullptr;
}

std::optional<double> period_of(const WallSetup& wall) noexcept {
  const MotionSetup* m = cyclic_motion(wall);
  if (m == nullptr) return std::nullopt;
  return m->kind == MotionKind::rotation ? 2.0 * pi / std::abs(m->rate) : 1.0 / m->frequency;
}

double period_of(const std::vector<WallSetup>& walls) noexcept {
  for (const WallSetup& wall : walls)
    if (const std::optional<double> period = period_of(wall)) return *period;
  return 0.0;
}

std::optional<TableProblem> problem_of_table(const MotionSetup& m) {
  if (m.kind != MotionKind::table) return std::nullopt;
  if (m.rows.empty()) return TableProblem{0, "the table has no rows"};
  for (std::size_t r = 0; r < m.rows.size(); ++r) {
    const MotionRow& row = m.rows[r];
    if (!std::isfinite(row.time) || !is_finite(row.displacement) || !std::isfinite(row.angle))
      return TableProblem{r, "must be finite numbers"};
    if (r > 0 && !(row.time > m.rows[r - 1].time))
      return TableProblem{
          r, fmt::format("the times must ascend: {} s comes after {} s", row.time, m.rows[r - 1].time)};
  }
  if (m.after == TableEnd::hold) return std::nullopt;
  const MotionRow &first = m.rows.front(), &last = m.rows.back();
  const std::size_t end = m.rows.size() - 1;
  if (m.rows.size() < 2) return TableProblem{end, "a table that repeats itself needs two rows or more"};
  constexpr double kRounding = 1e-9;  // of what was typed
  const double turns = (last.angle - first.angle) / (2.0 * pi);
  const double step = norm(last.displacement - first.displacement);
  if (step > kRounding * limits_of(m).displacement || std::abs(turns - std::round(turns)) > kRounding)
    return TableProblem{end,
                        fmt::format("a table that repeats itself must end where it began (or whole turns "
                                    "on): the last row is {:.4g} mm and {:.4g} degrees away from the first",
                                    1e3 * step, 360.0 * turns)};
  return std::nullopt;
}

}  // namespace abradem::simulation
