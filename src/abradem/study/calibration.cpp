// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/study/calibration.h"

#include <fmt/core.h>

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/interpolators/pchip.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <exception>
#include <limits>
#include <mutex>

#include "abradem/core/error.h"
#include "abradem/core/parallel.h"

namespace abradem::study {

namespace {

using simulation::DeformationRule;
using simulation::Setup;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
/// Where a run is close enough to the target: the closed form converges to it in one or two corrections; the
/// volume of the paper's rule is no smooth function of the coefficient and jumps by about 1e-4 on its own.
constexpr double kConservingTolerance = 1e-7, kPaperTolerance = 5e-4;
constexpr int kCorrections = 4;

/// As passes(), along a curve that keeps the shape of its points (PCHIP through them and the origin; Fritsch
/// and Butland, doi:10.1137/0905021).
double passes_smoothly(std::span<const double> x, std::span<const double> y, double level) {
  constexpr std::size_t kFewest = 4;  // points that a PCHIP needs
  std::vector<double> from{0.0}, to{0.0};
  for (std::size_t i = 0; i < x.size() && y[i] > from.back(); ++i) from.push_back(y[i]), to.push_back(x[i]);
  if (from.size() < kFewest || level <= 0.0 || level > from.back()) return passes(x, y, level);
  return boost::math::interpolators::pchip(std::move(from), std::move(to))(level);
}

/// Does the work of several trials at once, each with its own state. The first failure by index is thrown.
template <typename Work>
void in_parallel(std::size_t count, Work&& work) {
  std::vector<std::exception_ptr> errors(count);
  core::parallel_blocks(count, [&](std::size_t i) {
    try {
      work(i);
    } catch (...) {
      errors[i] = std::current_exception();
    }
  });
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
}

Estimate known(double value) { return {value, value, value}; }

double spread(std::span<const double> values) {
  const auto [low, high] = std::ranges::minmax(values);
  const double mean = analysis::summarise(values).mean;
  return mean > 0.0 ? (high - low) / mean : 0.0;
}

class Calibrator {
 public:
  Calibrator(const Setup& setup, const simulation::MeshSource& source, const CalibrationOptions& options)
      : setup_(setup), source_(source), options_(options), pair_(calibrated_pair(setup, options.pair)) {
    check();
    // A mesh is the same in every trial: made once.
    for (const simulation::WallSetup& wall : setup_.walls)
      if (wall.mesh.shape != simulation::MeshShape::plane)
        meshes_.emplace_back(wall.mesh, source(wall.mesh, setup_.run.seed));
  }

  CalibrationResult run() {
    describe();
    if (options_.unknown == Unknown::wear_coefficient)
      find_coefficient();
    else
      find_revolutions();
    result_.product = {result_.wear_coefficient.value * result_.revolutions.value,
                       result_.wear_coefficient.low * result_.revolutions.low,
                       result_.wear_coefficient.high * result_.revolutions.high};
    result_.scaling_factor = factor(result_.revolutions.value);
    walk_the_ridge();
    follow_the_curve();
    fill_the_table();
    return std::move(result_);
  }

 private:
  // --- one run -------------------------------------------------------------------------------------------
  void check() const {
    if (!setup_.measurement || !setup_.measurement->wear_volume ||
        !(setup_.measurement->wear_volume->mean > 0.0))
      throw InputError(
          "a calibration needs a measured volume > 0: give the case [measurement] with wear_volume = { "
          "mean = \"0.565 mm^3\", sd = \"0.089 mm^3\" }");
    if (std::ranges::none_of(setup_.walls, [](const simulation::WallSetup& w) {
          return simulation::cyclic_motion(w) != nullptr;
        }))
      throw InputError("a calibration needs a wall that turns or oscillates: wear is counted in revolutions");
    if (!(options_.coverage > 0.0 && options_.coverage < 1.0))
      throw InputError(fmt::format("coverage = {}; must be between 0 and 1, as 0.95", options_.coverage));
    for (const std::vector<double>* list : {&options_.coefficients, &options_.revolutions})
      for (const double x : *list)
        if (!(x > 0.0) || !std::isfinite(x))
          throw InputError(fmt::format("a pair of the table with {}: must be > 0", x));
  }

  [[nodiscard]] Setup with(double alpha, double revolutions) const {
    Setup s = setup_;
    s.wear[pair_].wear_coefficient = alpha;
    s.run.end = {revolutions, true};
    return s;
  }

  geometry::TriangleMesh mesh(const simulation::MeshSetup& wanted, std::uint64_t seed) const {
    for (const auto& [setup, made] : meshes_)
      if (setup == wanted) return made;
    return source_(wanted, seed);
  }

  /// Makes a trial that keeps what a failing run had, and reports progress.
  Outcome trial(const Setup& setup, TrialOptions how = {}) {
    how.keep_failed = true;
    how.watch = [this](const simulation::Simulation& run) {
      return watch(static_cast<double>(run.steps()) / static_cast<double>(run.total_steps()));
    };
    return run_trial(
        setup, [this](const auto& m, auto seed) { return mesh(m, seed); }, how);
  }

  bool watch(double fraction) {
    if (!options_.watch) return true;
    const std::scoped_lock lock(watching_);
    return options_.watch(doing_, fraction);
  }

  /// The volume that is matched.
  [[nodiscard]] double volume(const analysis::WearVolumes& v) const {
    return result_.rule == DeformationRule::paper ? v.paper : v.law;
  }

  [[nodiscard]] CalibrationPoint point(double alpha, const Outcome& o) const {
    return {alpha, o.revolutions, volume(o.volumes), o.depth, o.width, kNone, o.failure};
  }

  [[nodiscard]] double factor(double revolutions) const {
    return result_.test_revolutions ? *result_.test_revolutions / revolutions : kNone;
  }

  // --- the unknown ---------------------------------------------------------------------------------------
  void describe() {
    const simulation::MeasurementSetup& m = *setup_.measurement;
    result_.abrader = setup_.wear[pair_].abrader;
    result_.worn = setup_.wear[pair_].worn;
    result_.method = setup_.run.method;
    result_.rule = DeformationRule::none;
    for (const simulation::WallSetup& w : setup_.walls)
      if (w.material == result_.worn && w.deformation != DeformationRule::none) {
        result_.rule = w.deformation;
        break;
      }
    result_.closed_form = result_.rule != DeformationRule::paper;
    result_.target = *m.wear_volume;
    result_.coverage = options_.coverage;
    result_.z = boost::math::quantile(boost::math::normal(), 0.5 + 0.5 * options_.coverage);
    result_.unknown = options_.unknown;
    result_.test_revolutions = m.revolutions;
    result_.measured_depth = m.depth;
    result_.measured_width = m.width;
    low_ = std::max(0.0, result_.target.mean - result_.z * result_.target.sd);
    high_ = result_.target.mean + result_.z * result_.target.sd;
  }

  /// The first run, at the case's own numbers; with a smaller coefficient where that one fails at once.
  Outcome first_run() {
    doing_ = "first run";
    double alpha = setup_.wear[pair_].wear_coefficient;
    if (alpha == 0.0 && options_.unknown == Unknown::wear_coefficient) alpha = 1e-12;
    if (!(alpha > 0.0))
      throw InputError(fmt::format(
          "[wear.\"{}/{}\"] wear_coefficient = 0: give the coefficient whose revolutions are sought",
          result_.abrader, result_.worn));
    Setup s = setup_;
    std::string failure;
    for (int attempt = 0; attempt < 6; ++attempt) {
      s.wear[pair_].wear_coefficient = alpha;
      Outcome o = trial(s);
      ++result_.runs;
      if (!o.history.empty() && volume(o.volumes) > 0.0 && o.revolutions > 0.0) {
        result_.start = point(alpha, o);
        if (o.failure.empty()) return o;
        if (options_.unknown == Unknown::revolutions) return o;
      } else if (o.failure.empty()) {
        throw InputError("nothing is worn in a run of the case: does a wall slide under a loaded particle?");
      }
      failure = o.failure;
      alpha *= 0.1;
    }
    throw SimulationError(fmt::format("no run of the case comes to its end: {}", failure));
  }

  void find_coefficient() {
    const Outcome o = first_run();
    const double n = o.revolutions;
    result_.revolutions = known(n);
    result_.first_guess = result_.start.wear_coefficient * result_.target.mean / result_.start.volume;
    doing_ = "calibrated run";
    if (result_.closed_form) {
      // V = c alpha n; c hardly depends on the groove, so that correcting by it converges at once.
      double alpha = result_.first_guess;
      for (int i = 0; i <= kCorrections; ++i) {
        keep_calibrated(alpha, trial(with(alpha, n)), i == 0);
        if (std::abs(result_.residual) <= kConservingTolerance) break;
        if (i < kCorrections) alpha /= 1.0 + result_.residual;
      }
      const double c = result_.calibrated.volume / alpha;
      result_.wear_coefficient = {alpha, low_ / c, high_ / c};
    } else {
      const Root root = solve(n, result_.target.mean, result_.start, kPaperTolerance, true);
      if (!root.found)
        throw SimulationError(fmt::format(
            "no wear coefficient was found at which the run wears {:.4g} mm^3 in {:.4g} revolutions: {}",
            1e9 * result_.target.mean, n, root.failure));
      std::array<double, 2> bound{};
      std::array<std::string, 2> failure{};
      doing_ = "bounds of the interval";
      in_parallel(2, [&](std::size_t i) {
        const double level = i == 0 ? low_ : high_;
        if (level == result_.target.mean)
          bound[i] = result_.calibrated.wear_coefficient;
        else if (level > 0.0) {
          const Root at = solve(n, level, result_.calibrated, 4.0 * kPaperTolerance, false);
          bound[i] = at.found ? at.wear_coefficient : kNone;
          if (!at.found) failure[i] = at.failure;
        }
      });
      result_.wear_coefficient = {root.wear_coefficient, bound[0], bound[1]};
      result_.failure = failure[1].empty() ? failure[0] : failure[1];
    }
  }

  /// The run at a result, in place of the one before.
  void keep_calibrated(double alpha, const Outcome& o, bool first) {
    ++result_.runs;
    if (!o.failure.empty())
      throw SimulationError(fmt::format(
          "the run with wear_coefficient = {:.4g} 1/Pa, which the volume asks for, fails: {}\nMore "
          "revolutions need a smaller coefficient",
          alpha, o.failure));
    result_.calibrated = point(alpha, o);
    result_.calibrated.profile_distance = 0.0;
    result_.residual = result_.calibrated.volume / result_.target.mean - 1.0;
    if (first) result_.first_residual = result_.residual;
    calibrated_section_ = section(o);
  }

  struct Root {
    double wear_coefficient = kNone;  ///< the best one met
    bool found = false;
    std::string failure{};  ///< of the last run that failed
  };
  /// The root of log(V(alpha, n) / level) in log alpha, where V is about proportional to alpha.
  Root solve(double n, double level, const CalibrationPoint& from, double tolerance, bool keep) {
    double best_x = kNone, best = std::numeric_limits<double>::infinity();
    bool first = true;
    std::string failure;
    const auto f = [&](double x) {
      const Outcome o = trial(with(std::exp(x), n));
      const double v = volume(o.volumes);
      // A run that fails wears too fast for its mesh: away from there, to smaller coefficients.
      double y = 1.0;
      {
        const std::scoped_lock lock(watching_);
        if (o.failure.empty())
          y = std::log(v / level);
        else
          failure = o.failure;
        ++result_.runs;
      }
      if (o.failure.empty() && std::abs(y) < std::abs(best)) {
        best = y, best_x = x;
        if (keep) {
          --result_.runs;
          keep_calibrated(std::exp(x), o, first);
        }
      }
      first = false;
      return y;
    };
    double a = std::log(from.wear_coefficient * level / from.volume * from.revolutions / n);
    double f_a = f(a);
    double b = a, f_b = f_a, step = std::max(1.3 * std::abs(f_a), 2.0 * tolerance);
    for (int i = 0; i < 8 && std::abs(best) > tolerance && f_a * f_b > 0.0; ++i, step *= 2.0) {
      a = b, f_a = f_b;
      b = a + (f_a > 0.0 ? -step : step);
      f_b = f(b);
    }
    if (std::abs(best) > tolerance && f_a * f_b < 0.0) {
      const auto close = [&](double, double) { return std::abs(best) <= tolerance; };
      std::uintmax_t most = 12;
      const auto narrow = [&](double x, double y) {
        return close(x, y) || std::abs(x - y) < 0.1 * tolerance;
      };
      if (a > b) std::swap(a, b), std::swap(f_a, f_b);
      (void)boost::math::tools::toms748_solve(f, a, b, f_a, f_b, narrow, most);
    }
    // Volumes jump by themselves: a root is found where the target lies inside such a jump.
    return {std::exp(best_x), std::abs(best) <= 10.0 * tolerance, failure};
  }

  void find_revolutions() {
    const Outcome o = first_run();
    const double alpha = result_.start.wear_coefficient;
    result_.wear_coefficient = known(alpha);
    result_.first_guess = result_.start.revolutions * result_.target.mean / result_.start.volume;
    doing_ = "calibrated run";
    double n = result_.first_guess;
    if (result_.closed_form) {
      constexpr double kLong = 200.0;  // revolutions from which one run must do
      for (int i = 0; i <= 2; ++i) {
        keep_calibrated(alpha, trial(with(alpha, n)), i == 0);
        // The revolutions made are whole steps; what is found is not.
        n = result_.calibrated.revolutions / (1.0 + result_.residual);
        if (std::abs(result_.residual) <= kPaperTolerance || n > kLong) break;
      }
      result_.revolutions = {n, n * low_ / result_.target.mean, n * high_ / result_.target.mean};
    } else {
      const CalibrationPair row = revolutions_for(alpha, o);
      result_.revolutions = row.revolutions;
      result_.failure = row.failure;
      if (std::isnan(row.revolutions.value))
        throw SimulationError(fmt::format("the run stops before it has worn {:.4g} mm^3: {}",
                                          1e9 * result_.target.mean, row.failure));
      keep_calibrated(alpha, trial(with(alpha, row.revolutions.value)), true);
    }
  }

  /// Revolutions that a coefficient needs, read from one run that goes on until it has worn enough.
  /// @param known a run with some coefficient, to tell how far to go
  CalibrationPair revolutions_for(double alpha, const Outcome& known_run) {
    CalibrationPair row;
    row.wear_coefficient = known(alpha);
    const double rate = volume(known_run.volumes) / (result_.start.wear_coefficient * known_run.revolutions);
    // Far enough also where the rate per alpha n falls to a quarter of the known run's on the way.
    const double far = std::ceil(4.0 * high_ / (rate * alpha));
    Setup s = with(alpha, far);
    // Whole revolutions, as a case has them: other rows mean other increments, which the paper's measure
    // feels.
    s.output.every = {std::max(1.0, std::ceil(far / 400.0)), true};
    const Outcome o = trial(s, {.enough = [this](const Milestone& m) { return volume(m.volumes) >= high_; }});
    std::vector<double> n, v;
    for (const Milestone& m : o.history) n.push_back(m.revolutions), v.push_back(volume(m.volumes));
    const auto needed = [&](double level) { return passes_smoothly(n, v, level); };
    row.revolutions = {needed(result_.target.mean), needed(low_), needed(high_)};
    row.scaling_factor = factor(row.revolutions.value);
    if (std::isnan(row.revolutions.high)) row.failure = o.failure;
    return row;
  }

  // --- what the measurement cannot tell ------------------------------------------------------------------
  [[nodiscard]] std::vector<analysis::ProfilePoint> section(const Outcome& o) const {
    const auto worn = std::ranges::find_if(setup_.walls, [](const simulation::WallSetup& w) {
      return w.deformation != DeformationRule::none && w.mesh.shape != simulation::MeshShape::plane;
    });
    if (worn == setup_.walls.end()) return {};
    const double step = 0.25 * (worn->mesh.size > 0.0 ? worn->mesh.size : 1e-4);
    return mean_profile(o.contours, step);
  }

  /// Runs with the same alpha n in fewer and in more revolutions.
  void walk_the_ridge() {
    doing_ = "ridge";
    const double n = result_.calibrated.revolutions, alpha = result_.calibrated.wear_coefficient;
    // A long run is compared with shorter ones alone: they say the same.
    const std::vector<double> factors =
        n <= 50.0 ? std::vector{0.5, 2.0, 4.0} : std::vector{1.0 / 32.0, 1.0 / 16.0, 1.0 / 8.0};
    result_.ridge.assign(factors.size() + 1, result_.calibrated);
    in_parallel(factors.size(), [&](std::size_t i) {
      const double a = alpha / factors[i];
      const Outcome o = trial(with(a, n * factors[i]));
      CalibrationPoint p = point(a, o);
      p.profile_distance = profile_distance(section(o), calibrated_section_);
      result_.ridge[i + 1] = p;
    });
    std::ranges::sort(result_.ridge, {}, &CalibrationPoint::revolutions);
    std::vector<double> volumes, depths, widths;
    for (const CalibrationPoint& p : result_.ridge) {
      if (!p.failure.empty()) continue;
      volumes.push_back(p.volume);
      result_.ridge_profile_distance = std::max(result_.ridge_profile_distance, p.profile_distance);
      if (p.depth.count > 0) depths.push_back(p.depth.mean), widths.push_back(p.width.mean);
    }
    result_.ridge_volume_spread = spread(volumes);
    result_.ridge_depth_spread = depths.empty() ? kNone : spread(depths);
    result_.ridge_width_spread = widths.empty() ? kNone : spread(widths);
  }

  /// One run beyond the measured ranges: since only alpha n counts, its revolutions stand for any others.
  void follow_the_curve() {
    doing_ = "curve";
    constexpr double kFurthest = 8.0, kMostRevolutions = 24.0;
    const double n = std::min(result_.calibrated.revolutions, kMostRevolutions);
    const double alpha = result_.calibrated.product() / n;
    Setup s = with(alpha, kFurthest * n);
    s.output.every = {n / 24.0, true};
    const auto enough = [&](const Milestone& m) {
      const auto beyond = [](double mean, const std::optional<simulation::Range>& range) {
        return !range || std::isnan(mean) || mean > range->high;
      };
      return volume(m.volumes) >= high_ && beyond(m.depth_mean, result_.measured_depth) &&
             beyond(m.width_mean, result_.measured_width);
    };
    const Outcome o = trial(s, {.enough = enough, .sections_in_history = true});
    std::vector<double> x, depth, width;
    for (const Milestone& m : o.history) {
      result_.curve.push_back({alpha * m.revolutions, volume(m.volumes), m.depth_mean, m.width_mean});
      x.push_back(alpha * m.revolutions);
      depth.push_back(m.depth_mean);
      width.push_back(m.width_mean);
    }
    result_.by_volume = {result_.product.low, result_.product.high, !std::isnan(result_.product.low),
                         !std::isnan(result_.product.high)};
    const auto range = [&](const std::vector<double>& y, const simulation::Range& measured) {
      ProductRange r{passes(x, y, measured.low), passes(x, y, measured.high)};
      if (std::isnan(r.low)) r.low_reached = false, r.low = x.back();
      if (std::isnan(r.high)) r.high_reached = false, r.high = x.back();
      return r;
    };
    if (o.depth.count == 0 || x.empty()) return;
    if (result_.measured_depth) result_.by_depth = range(depth, *result_.measured_depth);
    if (result_.measured_width) result_.by_width = range(width, *result_.measured_width);
  }

  // --- the table -----------------------------------------------------------------------------------------
  void fill_the_table() {
    doing_ = "table of pairs";
    std::vector<double> given = options_.coefficients;
    std::ranges::sort(given);
    const std::size_t by_coefficient = given.size();
    std::vector<double> revolutions = options_.revolutions;
    std::ranges::sort(revolutions, std::greater<>());
    given.insert(given.end(), revolutions.begin(), revolutions.end());
    result_.pairs.assign(given.size(), {});
    const double per_product = result_.calibrated.volume / result_.calibrated.product();  // V / (alpha n)
    const double v = result_.target.mean;

    Outcome reference;
    reference.volumes = {result_.start.volume, kNone, result_.start.volume};
    reference.revolutions = result_.start.revolutions;
    const auto row_of = [&](std::size_t i) -> CalibrationPair {
      CalibrationPair row;
      if (i < by_coefficient) {
        if (!result_.closed_form) return revolutions_for(given[i], reference);
        const double product_to_n = 1.0 / (per_product * given[i]);
        row.wear_coefficient = known(given[i]);
        row.revolutions = {v * product_to_n, low_ * product_to_n, high_ * product_to_n};
      } else {
        row.unknown = Unknown::wear_coefficient;
        row.revolutions = known(given[i]);
        if (result_.closed_form) {
          const double to_alpha = 1.0 / (per_product * given[i]);
          row.wear_coefficient = {v * to_alpha, low_ * to_alpha, high_ * to_alpha};
        } else if (result_.unknown == Unknown::wear_coefficient && given[i] == result_.revolutions.value) {
          row.wear_coefficient = result_.wear_coefficient;
        } else {
          const std::array levels{v, low_, high_};
          std::array<double, 3> found{};
          for (std::size_t k = 0; k < 3; ++k) {
            if (levels[k] == 0.0) continue;
            if (k > 0 && levels[k] == v) {
              found[k] = found[0];
              continue;
            }
            const Root at = solve(given[i], levels[k], result_.calibrated, 4.0 * kPaperTolerance, false);
            found[k] = at.found ? at.wear_coefficient : kNone;
            if (!at.found) row.failure = at.failure;
          }
          row.wear_coefficient = {found[0], found[1], found[2]};
        }
      }
      row.scaling_factor = factor(row.revolutions.value);
      return row;
    };
    in_parallel(given.size(), [&](std::size_t i) { result_.pairs[i] = row_of(i); });
  }

  const Setup& setup_;
  const simulation::MeshSource& source_;
  const CalibrationOptions& options_;
  std::size_t pair_;
  std::vector<std::pair<simulation::MeshSetup, geometry::TriangleMesh>> meshes_;
  CalibrationResult result_;
  double low_ = 0.0, high_ = 0.0;  // of the target [m^3]
  std::vector<analysis::ProfilePoint> calibrated_section_;
  std::string doing_;
  std::mutex watching_;
};

}  // namespace

double passes(std::span<const double> x, std::span<const double> y, double level) {
  if (level <= 0.0) return 0.0;
  double x0 = 0.0, y0 = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (y[i] >= level) return x0 + (x[i] - x0) * (level - y0) / (y[i] - y0);
    x0 = x[i], y0 = y[i];
  }
  return kNone;
}

std::size_t calibrated_pair(const Setup& setup, const std::string& wanted) {
  std::vector<std::size_t> able;
  std::string names;
  for (std::size_t i = 0; i < setup.wear.size(); ++i) {
    const simulation::WearSetup& w = setup.wear[i];
    const bool wall = std::ranges::any_of(setup.walls, [&](const auto& x) { return x.material == w.worn; });
    const bool grain =
        std::ranges::any_of(setup.particles, [&](const auto& x) { return x.material == w.abrader; });
    if (!wall || !grain) continue;
    const std::string name = w.abrader + "/" + w.worn;
    if (w.laws != std::vector{simulation::WearLaw::archard}) {
      if (name == wanted)
        throw InputError(
            fmt::format("[wear.\"{}\"] has other laws than Archard's, whose coefficient is "
                        "calibrated",
                        name));
      continue;
    }
    if (name == wanted) return i;
    able.push_back(i);
    names += (names.empty() ? "" : ", ") + name;
  }
  if (!wanted.empty())
    throw InputError(fmt::format("no [wear.\"{}\"] wears a wall of this case{}", wanted,
                                 names.empty() ? "" : "; there is " + names));
  if (able.empty())
    throw InputError("the case has no [wear.\"abrader/worn\"] with a particle and a wall of these materials");
  if (able.size() > 1)
    throw InputError(
        fmt::format("several coefficients could be calibrated ({}); say which with --pair", names));
  return able.front();
}

CalibrationResult calibrate(const Setup& setup, const simulation::MeshSource& source,
                            const CalibrationOptions& options) {
  return Calibrator(setup, source, options).run();
}

double PublishedFit::revolutions(double volume) const noexcept {
  const double c = a0 - 1e9 * volume;
  return (-a1 + std::sqrt(a1 * a1 - 4.0 * a2 * c)) / (2.0 * a2);
}

double PublishedFit::volume(double revolutions) const noexcept {
  return 1e-9 * (a0 + revolutions * (a1 + revolutions * a2));
}

std::span<const PublishedFit> published_fits() noexcept {
  static constexpr std::array fits{
      PublishedFit{13, 1e-11, 0.001, 0.012, 0.0008}, PublishedFit{14, 1.5e-11, 0.006, 0.023, 0.001},
      PublishedFit{15, 1.7e-11, 0.006, 0.03, 0.001}, PublishedFit{16, 2e-11, 0.03, 0.042, 0.0012},
      PublishedFit{17, 5e-11, 0.08, 0.098, 0.011}};
  return fits;
}

}  // namespace abradem::study
