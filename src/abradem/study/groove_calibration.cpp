// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/study/groove_calibration.h"

#include <fmt/core.h>

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

#include "abradem/analysis/statistics.h"
#include "abradem/analysis/wall_contours.h"
#include "abradem/core/error.h"
#include "abradem/study/acceleration.h"
#include "abradem/study/calibration.h"

namespace abradem::study {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using simulation::Setup;

/// ln alpha, ln ratio, removed fraction.
Vector3d coordinates(const GrooveParameters& p) { return {std::log(p[0]), std::log(p[1]), p[2]}; }
GrooveParameters parameters(const Vector3d& x) { return {std::exp(x[0]), std::exp(x[1]), x[2]}; }
/// ln of volume, depth and width: their changes are relative.
Vector3d matched(const GrooveState& s) { return {std::log(s.volume), std::log(s.depth), std::log(s.width)}; }

struct Further {
  const char* name;
  const char* unit;
  double GrooveState::*value;
};
constexpr std::array kFurther{Further{"ridge height", "m", &GrooveState::ridge_height},
                              Further{"ridge area", "m^2", &GrooveState::ridge_area},
                              Further{"tip flat along the slide", "m", &GrooveState::flat_along},
                              Further{"tip flat across the slide", "m", &GrooveState::flat_across},
                              Further{"pin mass loss", "kg", &GrooveState::pin_mass}};

class GrooveCalibrator {
 public:
  GrooveCalibrator(const Setup& setup, const simulation::MeshSource& source,
                   const GrooveCalibrationOptions& options)
      : source_(source), options_(options), pair_(calibrated_pair(setup, options.pair)) {
    if (!setup.measurement || !setup.measurement->wear_volume || !setup.measurement->depth ||
        !setup.measurement->width)
      throw InputError(
          "three numbers need three measurements: give wear_volume, depth and width in "
          "[measurement]");
    const simulation::WearSetup& wear = setup.wear[pair_];
    if (std::ranges::none_of(setup.particles, [&](const auto& p) {
          return p.material == wear.abrader && p.guide != simulation::Guide::none;
        }))
      throw InputError(
          fmt::format("the pin's wear is sought, but no particle of {} has a guide", wear.abrader));
    if (!setup.run.end.in_revolutions)
      throw InputError("run.end must be a number of revolutions: the trials make fewer of them");
    const double scale = setup.run.end.value / options.revolutions;
    setup_ = scale > 1.0 ? accelerated(setup, scale) : setup;
    setup_.output.every = setup_.run.end;
    setup_.measurement = setup.measurement;
    result_.revolutions = std::min(options.revolutions, setup.run.end.value);
    const simulation::MeasurementSetup& m = *setup.measurement;
    const auto half_range = [](const simulation::Range& r) { return (r.high - r.low) / std::sqrt(12.0); };
    result_.target = {m.wear_volume->mean, 0.5 * (m.depth->low + m.depth->high),
                      0.5 * (m.width->low + m.width->high)};
    result_.target_sd = {m.wear_volume->sd, half_range(*m.depth), half_range(*m.width)};
    for (std::size_t i = 0; i < 3; ++i)
      if (!(result_.target[i] > 0.0) || !(result_.target_sd[i] > 0.0))
        throw InputError("the measured volume, depth and width must be > 0, and each must have a scatter");
    result_.coverage = options.coverage;
    result_.z = boost::math::quantile(boost::math::normal(), 0.5 * (1.0 + options.coverage));
  }

  GrooveCalibration run() {
    constexpr double kClose = 0.02;  // of each sd: far inside what the measurement can tell
    for (std::size_t i = 0; i < 3; ++i) goal_[static_cast<Eigen::Index>(i)] = std::log(result_.target[i]);
    Vector3d x = start();
    GrooveState state = evaluate(x, "first run");
    Matrix3d J = derivatives(x, state, "derivatives");
    for (int step = 0; step < options_.most_steps; ++step) {
      const Vector3d miss = goal_ - matched(state);
      if ((miss.array() / relative_sd().array()).abs().maxCoeff() < kClose) break;
      const Vector3d next = limited(x, J.fullPivLu().solve(miss));
      const Vector3d dx = next - x;
      if (dx.norm() < 1e-3) break;  // at a limit
      const GrooveState there = evaluate(next, fmt::format("step {}", step + 1));
      // Broyden: the derivatives that the step has shown.
      J += ((matched(there) - matched(state)) - J * dx) * dx.transpose() / dx.squaredNorm();
      x = next, state = there;
    }
    result_.at_limit =
        limited(x, Vector3d::Zero()) != x || x[2] <= kLeastFraction + 1e-9 || x[2] >= kMostFraction - 1e-9;
    result_.calibrated = state;
    judge(derivatives(x, state, "derivatives at the result"));
    return result_;
  }

 private:
  static constexpr double kLeastFraction = 0.1, kMostFraction = 0.98;

  [[nodiscard]] Vector3d relative_sd() const {
    return {result_.target_sd[0] / result_.target[0], result_.target_sd[1] / result_.target[1],
            result_.target_sd[2] / result_.target[2]};
  }

  [[nodiscard]] Vector3d start() const {
    const simulation::WearSetup& wear = setup_.wear[pair_];
    const auto back = std::ranges::find_if(setup_.wear, [&](const auto& w) {
      return w.abrader == wear.worn && w.worn == wear.abrader && w.wear_coefficient > 0.0;
    });
    constexpr double kRatio = 0.005, kFraction = 0.6;  // where the case says nothing
    const double f = setup_.ploughing ? setup_.ploughing->removed_fraction : 1.0;
    return coordinates({wear.wear_coefficient,
                        back != setup_.wear.end() ? back->wear_coefficient / wear.wear_coefficient : kRatio,
                        f > kLeastFraction && f < kMostFraction ? f : kFraction});
  }

  /// A step cut to what the derivatives can be trusted for, inside the parameters' ranges.
  [[nodiscard]] static Vector3d limited(const Vector3d& x, Vector3d dx) {
    const Vector3d most{0.5, 1.0, 0.15};
    const double over = (dx.array().abs() / most.array()).maxCoeff();
    if (over > 1.0) dx /= over;
    Vector3d next = x + dx;
    next[1] = std::clamp(next[1], std::log(1e-5), std::log(1.0));
    next[2] = std::clamp(next[2], kLeastFraction, kMostFraction);
    return next;
  }

  GrooveState evaluate(const Vector3d& x, const std::string& doing) {
    const Setup setup = with_groove_parameters(setup_, pair_, parameters(x));
    simulation::Simulation run(setup, source_);
    const auto watch = [&] {
      return !options_.watch ||
             options_.watch(doing, static_cast<double>(run.steps()) / static_cast<double>(run.total_steps()));
    };
    while (!run.finished()) {
      run.advance(watch);
      if (!watch()) throw Interrupted("interrupted");
    }
    GrooveState s;
    s.parameters = parameters(x);
    s.volume = run.ledger().law;
    const auto worn = analysis::worn_wall(run.walls());
    if (!worn) throw InputError("no wall of the case changes its shape");
    const auto contours = analysis::wall_contours(run.walls()[*worn], setup.output.contours);
    for (const analysis::Contour& c : contours) {
      s.depth += c.depth / static_cast<double>(contours.size());
      s.width += c.width / static_cast<double>(contours.size());
    }
    const analysis::RidgeSummary ridge = analysis::ridge_summary(contours);
    s.ridge_height = ridge.height_mean, s.ridge_area = ridge.ridge_area, s.groove_area = ridge.groove_area;
    for (std::size_t p = 0; p < run.particles().size(); ++p) {
      const wear::WearingTip* tip = run.tip(p);
      if (tip == nullptr) continue;
      const auto flat = tip->flat(simulation::kFlatLevel);
      s.flat_along = flat.along_s, s.flat_across = flat.along_t;
      s.pin_volume += tip->removed_volume();
      s.pin_mass += tip->removed_volume() *
                    setup.materials[static_cast<std::size_t>(run.particles().material[p])].density;
    }
    result_.trials.push_back(s);
    ++result_.runs;
    return s;
  }

  /// Forward differences of what is matched and of what could be measured besides.
  Matrix3d derivatives(const Vector3d& x, const GrooveState& at, const std::string& doing) {
    const std::array<double, 3> steps{0.15, 0.4,
                                      x[2] > 0.5 * (kLeastFraction + kMostFraction) ? -0.08 : 0.08};
    Matrix3d J;
    further_.resize(static_cast<Eigen::Index>(kFurther.size()), 3);
    for (Eigen::Index k = 0; k < 3; ++k) {
      Vector3d moved = x;
      const double h = steps[static_cast<std::size_t>(k)];
      moved[k] += h;
      const GrooveState s = evaluate(moved, doing);
      J.col(k) = (matched(s) - matched(at)) / h;
      for (std::size_t i = 0; i < kFurther.size(); ++i)
        further_(static_cast<Eigen::Index>(i), k) = (s.*kFurther[i].value - at.*kFurther[i].value) / h;
    }
    return J;
  }

  void judge(const Matrix3d& J) {
    const Vector3d sd = relative_sd();
    const Matrix3d inverse = J.inverse();
    const Matrix3d C = inverse * sd.array().square().matrix().asDiagonal() * inverse.transpose();
    const GrooveState& s = result_.calibrated;
    const std::array<double, 3> value{s.volume, s.depth, s.width};
    const simulation::MeasurementSetup& m = *setup_.measurement;
    for (std::size_t i = 0; i < 3; ++i)
      result_.residual[i] = (value[i] - result_.target[i]) / result_.target_sd[i];
    result_.inside = std::abs(result_.residual[0]) <= 1.0 && s.depth >= m.depth->low &&
                     s.depth <= m.depth->high && s.width >= m.width->low && s.width <= m.width->high;
    const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(C);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto a = static_cast<Eigen::Index>(i);
      const double half = result_.z * std::sqrt(C(a, a));
      const double p = s.parameters[i];
      result_.low[i] = i < 2 ? p * std::exp(-half) : std::max(0.0, p - half);
      result_.high[i] = i < 2 ? p * std::exp(half) : std::min(1.0, p + half);
      result_.direction_sd[i] = std::sqrt(std::max(0.0, eigen.eigenvalues()[2 - a]));
      for (std::size_t j = 0; j < 3; ++j) {
        const auto b = static_cast<Eigen::Index>(j);
        result_.covariance[i][j] = C(a, b);
        result_.correlation[i][j] = C(a, b) / std::sqrt(C(a, a) * C(b, b));
        result_.directions[i][j] = eigen.eigenvectors()(b, 2 - a);
      }
    }
    for (std::size_t i = 0; i < kFurther.size(); ++i) {
      FurtherMeasurement f{kFurther[i].name, kFurther[i].unit, s.*kFurther[i].value, 0.0, 0.1, {}, 1.0};
      const Vector3d g = further_.row(static_cast<Eigen::Index>(i)).transpose();
      const double predicted = g.dot(C * g), noise = std::pow(f.precision * f.value, 2);
      f.sd = std::sqrt(predicted);
      const Matrix3d after = C - (C * g) * (C * g).transpose() / (predicted + noise);
      for (std::size_t k = 0; k < 3; ++k) {
        const auto a = static_cast<Eigen::Index>(k);
        f.sd_after[k] = std::sqrt(std::max(0.0, after(a, a)));
      }
      f.volume_left = std::sqrt(noise / (predicted + noise));
      result_.further.push_back(f);
    }
    std::ranges::stable_sort(result_.further, {}, &FurtherMeasurement::volume_left);
  }

  const simulation::MeshSource& source_;
  const GrooveCalibrationOptions& options_;
  std::size_t pair_;
  Setup setup_;
  GrooveCalibration result_;
  Vector3d goal_;
  Eigen::MatrixXd further_;
};

}  // namespace

Setup with_groove_parameters(Setup setup, std::size_t pair, const GrooveParameters& parameters) {
  simulation::WearSetup& wear = setup.wear[pair];
  wear.wear_coefficient = parameters[0];
  simulation::WearSetup back = wear;
  std::swap(back.abrader, back.worn);
  back.wear_coefficient = parameters[0] * parameters[1];
  const auto found = std::ranges::find_if(
      setup.wear, [&](const auto& w) { return w.abrader == back.abrader && w.worn == back.worn; });
  if (found == setup.wear.end())
    setup.wear.push_back(back);
  else
    *found = back;
  if (!setup.ploughing) setup.ploughing.emplace();
  setup.ploughing->removed_fraction = parameters[2];
  return setup;
}

GrooveCalibration calibrate_groove(const Setup& setup, const simulation::MeshSource& source,
                                   const GrooveCalibrationOptions& options) {
  return GrooveCalibrator(setup, source, options).run();
}

std::vector<std::string> undetermined(const GrooveCalibration& calibration) {
  constexpr double kFactor = 10.0, kPart = 0.5;
  const GrooveParameters &low = calibration.low, &high = calibration.high;
  std::vector<std::string> names;
  // Negated, so that an interval that is no number counts as open.
  if (!(high[0] <= kFactor * low[0])) names.emplace_back("wear coefficient");
  if (!(high[1] <= kFactor * low[1])) names.emplace_back("pin-to-disc ratio");
  if (!(high[2] - low[2] <= kPart)) names.emplace_back("removed fraction");
  return names;
}

}  // namespace abradem::study
