// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/report/scaling_page.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "abradem/analysis/half_space_groove.h"
#include "abradem/report/paper_claims.h"
#include "abradem/report/paper_runs.h"
#include "abradem/report/text.h"
#include "abradem/study/scaling.h"
#include "abradem/study/trial.h"
#include "abradem/study/verdict.h"

namespace abradem::report {
namespace {

using Kind = Series::Kind;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
/// Elastic half-space, applied several times per patch length: 12 passes against the whole test, relative L2.
constexpr double kHalfSpacePasses = 12.0, kHalfSpaceError = 1e-3;
/// The paper's rule: not fewer revolutions than its run-in of 7 leaves.
constexpr double kPaperRevolutions = 8.0;
constexpr std::string_view kScalingRuns = "scaling", kFrictionlessRuns = "frictionless";

/// One run: the wear of the test in some revolutions.
struct Scaled {
  FinishedRun run;
  double factor = 1.0, modelled = 0.0, depth = 0.0, width = 0.0, volume = 0.0;  // -, -, mm, mm, mm^3
  std::vector<analysis::ProfilePoint> profile;                                  // mean section [m]
  double depth_error = 0.0, width_error = 0.0, profile_error = 0.0;  // against the least scaled [-]
};

/// The runs of one pin, by ascending factor; the first is the reference.
struct Pin {
  double shear_modulus = 0.0, effective_modulus = 0.0;  // [Pa]
  std::vector<Scaled> runs;
  int colour = 0;
  [[nodiscard]] std::string name() const { return fmt::format("pin of {:.3g} GPa", 1e-9 * shear_modulus); }
};

struct Scaling {
  std::vector<Pin> pins;          // by ascending stiffness
  std::vector<Pin> further;       // for the master curve alone
  std::vector<Pin> frictionless;  // as the half-space is
  simulation::MeasurementSetup measured;
  double load = 0.0, radius = 0.0, track = 0.0;  // SI
  double test_revolutions = 0.0;
  double test_wear = 0.0;  // alpha n of the test [1/Pa]
};

double shear_modulus(const FinishedRun& run) {
  for (const simulation::MaterialSetup& m : run.setup().materials)
    if (!run.setup().wear.empty() && m.name == run.setup().wear.front().abrader) return m.shear_modulus;
  return kNaN;
}

Scaled scaled(FinishedRun run, double track) {
  Scaled out;
  out.factor = run.setup().wear.front().acceleration.factor;
  const double last = run.last_revolution();
  out.modelled = last / out.factor;
  out.depth = run.at(last, "depth_mean_mm");
  out.width = run.at(last, "width_mean_mm");
  out.volume = run.at(last, "swept_volume_mm3");
  std::vector<analysis::Contour> contours;
  for (const DrawnProfile& drawn : profiles_of(run, last, 1e3 * track)) {
    analysis::Contour contour;
    for (std::size_t k = 0; k < drawn.x_mm.size(); ++k)
      contour.profile.push_back({track + 1e-3 * drawn.x_mm[k], 1e-6 * drawn.height_um[k]});
    contours.push_back(std::move(contour));
  }
  constexpr double kStep = 5e-6;
  out.profile = study::mean_profile(contours, kStep);
  out.run = std::move(run);
  return out;
}

void compare(Pin& pin) {
  std::ranges::stable_sort(pin.runs, {}, &Scaled::factor);
  const Scaled& reference = pin.runs.front();
  for (Scaled& run : pin.runs) {
    run.depth_error = run.depth / reference.depth - 1.0;
    run.width_error = run.width / reference.width - 1.0;
    run.profile_error = study::profile_distance(run.profile, reference.profile);
  }
}

Scaling read_scaling(const simulation::Setup& setup, std::span<const StudyRun> runs) {
  Scaling out;
  out.measured = setup.measurement.value_or(simulation::MeasurementSetup{});
  for (const simulation::ParticleSetup& particle : setup.particles) {
    if (norm(particle.load) == 0.0) continue;
    out.load = norm(particle.load);
    out.radius = particle.radius;
    out.track = std::hypot(particle.position.x, particle.position.y);
  }
  for (const StudyRun& run : runs) {
    if (run.status != "completed" || run.setup.wear.empty()) continue;
    Scaled one = scaled(read_finished(run), out.track);
    std::vector<Pin>& group = run.variation == kScalingRuns        ? out.pins
                              : run.variation == kFrictionlessRuns ? out.frictionless
                                                                   : out.further;
    const double modulus = shear_modulus(one.run);
    auto pin = std::ranges::find(group, modulus, &Pin::shear_modulus);
    if (pin == group.end()) pin = group.insert(group.end(), {modulus, one.run.effective_modulus(), {}, 0});
    pin->runs.push_back(std::move(one));
  }
  int colour = 0;
  for (std::vector<Pin>* group : {&out.pins, &out.further, &out.frictionless}) {
    std::ranges::sort(*group, {}, &Pin::shear_modulus);
    for (Pin& pin : *group) {
      const auto known = std::ranges::find(out.pins, pin.shear_modulus, &Pin::shear_modulus);
      pin.colour = group != &out.pins && known != out.pins.end() ? known->colour : colour++ % 8;
      compare(pin);
    }
  }
  if (!setup.wear.empty() && setup.run.end.in_revolutions) {
    out.test_revolutions = setup.run.end.value;
    out.test_wear = setup.wear.front().wear_coefficient * out.test_revolutions;
  }
  return out;
}

std::string percent(double share) { return share == 0.0 ? "0" : fmt::format("{:+.2g} %", 100.0 * share); }

/// The run of a pin in about the passes of the half-space statement.
const Scaled* at_twelve(const Pin& pin) {
  for (const Scaled& run : pin.runs)
    if (std::abs(run.modelled - kHalfSpacePasses) < 0.1 && run.profile_error > 0.0) return &run;
  return nullptr;
}

// ---------------------------------------------------------------- what scaling costs

DataTable cost_table(const Scaling& s) {
  DataTable table{.id = "scaling-runs",
                  .title = "The same wear in fewer revolutions",
                  .columns = {"pin", "revolutions modelled", "scaling factor", "depth [µm]", "depth off",
                              "width [mm]", "width off", "volume [mm³]", "profile off (L2) [%]", "time [s]"}};
  table.caption =
      "α n is that of the test in every run. Off: against the least scaled run of that pin; profile: "
      "relative L2 distance of "
      "the mean section.";
  for (const Pin& pin : s.pins) {
    for (const Scaled& run : pin.runs)
      table.rows.push_back({pin.name(), readable(run.modelled, 5), readable(run.factor, 4),
                            readable(1e3 * run.depth, 4), percent(run.depth_error), readable(run.width, 3),
                            percent(run.width_error), readable(run.volume, 4),
                            readable(100.0 * run.profile_error, 2), readable(run.run.run->seconds, 3)});
  }
  return table;
}

Figure cost_figure(const Scaling& s) {
  Panel profile{.title = "(a) Profile",
                .x = {.title = "scaling factor [-]", .log = true},
                .y = {.title = "profile off, relative L2 [%]", .log = true}};
  Panel depth{.title = "(b) Depth and width",
              .x = {.title = "scaling factor [-]", .log = true},
              .y = {.title = "off [%]"}};
  double low = 1e-2, high = 1.0;
  for (const Pin& pin : s.pins) {
    const auto start = [&](const char* what) {
      return Series{.kind = Kind::line_markers, .name = pin.name() + what, .colour = pin.colour};
    };
    Series l2 = start(""), d = start(", depth"), w = start(", width");
    w.dash = Series::Dash::dot;
    for (const Scaled& run : pin.runs) {
      d.x.push_back(run.factor);
      d.y.push_back(100.0 * run.depth_error);
      w.x.push_back(run.factor);
      w.y.push_back(100.0 * run.width_error);
      if (run.profile_error == 0.0) continue;
      l2.x.push_back(run.factor);
      l2.y.push_back(100.0 * run.profile_error);
      low = std::min(low, 70.0 * run.profile_error);
      high = std::max(high, 130.0 * run.profile_error);
    }
    profile.series.push_back(std::move(l2));
    for (const Pin& other : s.frictionless) {
      const Scaled* run = at_twelve(other);
      if (other.shear_modulus != pin.shear_modulus || run == nullptr) continue;
      profile.series.push_back({.kind = Kind::markers,
                                .name = pin.name() + ", no friction",
                                .x = {run->factor},
                                .y = {100.0 * run->profile_error},
                                .colour = 2 + pin.colour});
      low = std::min(low, 70.0 * run->profile_error);
    }
    depth.series.push_back(std::move(d));
    depth.series.push_back(std::move(w));
  }
  profile.series.push_back({.kind = Kind::markers,
                            .name = "elastic half-space, 12 passes: below",
                            .x = {s.test_revolutions / kHalfSpacePasses},
                            .y = {100.0 * kHalfSpaceError},
                            .colour = 6,
                            .theirs = true});
  profile.series.push_back(
      {.kind = Kind::line,
       .name = "paper's largest factor",
       .x = {s.test_revolutions / kPaperRevolutions, s.test_revolutions / kPaperRevolutions},
       .y = {low, high},
       .colour = 7,
       .theirs = true});
  return {.id = "scaling-cost",
          .title = "What scaling costs",
          .caption =
              "Deviation from the least scaled run of each pin. The half-space, without friction, says that "
              "12 passes differ "
              "from the whole test by less than 0.1 % when wear is applied several times per patch length. "
              "The paper's "
              "rule (8 revolutions after its run-in, 162.8) says nothing of an error. Below about 0.1 % the "
              "soft pin's "
              "values are the ripple of the increments, which differ from run to run.",
          .panels = {std::move(profile), std::move(depth)},
          .columns = 2};
}

Figure profile_figure(const Scaling& s) {
  Figure figure{.id = "scaling-profiles", .title = "Mean section by scaling factor", .columns = 2};
  for (const Pin& pin : s.pins) {
    Panel panel{.title = fmt::format("({}) {}", static_cast<char>('a' + figure.panels.size()), pin.name()),
                .x = {.title = "radius from the track [mm]"},
                .y = {.title = "height [µm]"}};
    int colour = 0;
    for (const Scaled& run : pin.runs) {
      Series line{.kind = Kind::line,
                  .name = fmt::format("{:.5g} revolutions", run.modelled),
                  .colour = colour++ % 8};
      for (const analysis::ProfilePoint& p : run.profile) {
        line.x.push_back(1e3 * (p.radius - s.track));
        line.y.push_back(1e6 * p.height);
      }
      panel.series.push_back(std::move(line));
    }
    panel.x.range = {-0.6, 0.6};
    figure.panels.push_back(std::move(panel));
  }
  figure.caption =
      "Heights averaged over eight sections. Where the lines cannot be told apart, scaling costs nothing.";
  return figure;
}

std::string factor_text(const Pin& pin, double tolerance) {
  std::vector<double> factors, errors;
  for (const Scaled& run : pin.runs) {
    if (!(run.factor > pin.runs.front().factor && run.profile_error > 0.0)) continue;
    factors.push_back(run.factor);
    errors.push_back(run.profile_error);
  }
  if (factors.empty()) return "–";
  const study::LargestFactor found = study::largest_factor(factors, errors, tolerance);
  return found.at_least    ? fmt::format("{} or more", readable(found.factor, 4))
         : found.less_than ? fmt::format("< {}", readable(found.factor, 3))
                           : readable(found.factor, 3);
}

DataTable factor_table(const Scaling& s) {
  DataTable table{.id = "largest-factor",
                  .title = "The largest scaling factor for a tolerance",
                  .columns = {"tolerance of the profile (L2)"}};
  for (const Pin& pin : s.pins) table.columns.push_back(pin.name());
  table.columns.emplace_back("paper's rule");
  table.caption =
      "Interpolated between the runs, in logarithms. The paper's rule knows no tolerance: 1302.5 revolutions "
      "over the 8 after "
      "which its depths and widths passed a test of normality. acceleration = \"auto\" makes this choice for "
      "a case.";
  for (const double tolerance : {1e-4, 3e-4, 1e-3, 3e-3, 1e-2}) {
    std::vector<std::string> row{fmt::format("{:.3g} %", 100.0 * tolerance)};
    for (const Pin& pin : s.pins) row.push_back(factor_text(pin, tolerance));
    row.push_back(readable(s.test_revolutions / kPaperRevolutions, 4));
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string half_space_sentence(const Scaling& s) {
  std::string text, frictionless;
  for (const Pin& pin : s.pins)
    if (const Scaled* run = at_twelve(pin))
      text += fmt::format("{}{:.2g} % ({}; its volume by {:+.2g} %)", text.empty() ? "" : ", ",
                          100.0 * run->profile_error, pin.name(),
                          100.0 * (run->volume / pin.runs.front().volume - 1.0));
  for (const Pin& pin : s.frictionless)
    if (const Scaled* run = at_twelve(pin))
      frictionless += fmt::format("{}{:.2g} % ({})", frictionless.empty() ? "" : ", ",
                                  100.0 * run->profile_error, pin.name());
  if (text.empty()) return text;
  text = fmt::format("Twelve revolutions differ from the least scaled run in profile by {}.", text);
  if (!frictionless.empty())
    text += fmt::format(
        " The half-space statement, below {:.2g} %, is one without friction: on the slope in front of a "
        "groove that is worn in "
        "few passes, friction presses the pin down and adds volume. Without friction, twelve revolutions "
        "differ from {:.3g} by "
        "{}.",
        100.0 * kHalfSpaceError, s.frictionless.front().runs.front().modelled, frictionless);
  return text;
}

// ---------------------------------------------------------------- the master curve

std::vector<double> logarithmic(double low, double high, int count) {
  std::vector<double> out;
  for (int k = 0; k < count; ++k)
    out.push_back(low * std::pow(high / low, static_cast<double>(k) / (count - 1)));
  return out;
}

template <class Function>
Series curve(std::string name, const std::vector<double>& x, Function f, int colour, Series::Dash dash) {
  Series s{.kind = Kind::line, .name = std::move(name), .x = x, .colour = colour, .dash = dash};
  for (const double v : x) s.y.push_back(f(v));
  return s;
}

analysis::PressedSphere sphere(const Scaling& s, double effective_modulus) {
  return {s.radius, s.load, effective_modulus};
}

constexpr int kCurveColour = 7, kThinColour = 5, kRigidColour = 6;

Panel master_panel(const Scaling& s) {
  Panel panel{.title = "(a) Every stiffness and wear on one curve",
              .x = {.title = "W = α n E* [-]", .log = true},
              .y = {.title = "depth / Hertz approach d0 [-]", .log = true}};
  panel.x.range = {2e-3, 2e2};
  panel.y.range = {1e-3, 50.0};
  const std::vector<double> W = logarithmic(2e-3, 2e2, 80);
  panel.series.push_back(
      curve("elastic half-space", W, analysis::half_space_depth, kCurveColour, Series::Dash::solid));
  panel.series.push_back(curve("thin wear, W", W, analysis::thin_wear_depth, kThinColour, Series::Dash::dot));
  panel.series.push_back(
      curve("rigid sphere, (W/√2)^(2/3)", W, analysis::rigid_sphere_depth, kRigidColour, Series::Dash::dash));
  for (const std::vector<Pin>* group : {&s.pins, &s.further}) {
    for (const Pin& pin : *group) {
      Series ours{.kind = Kind::markers, .name = pin.name(), .colour = pin.colour};
      const double d0 = 1e3 * sphere(s, pin.effective_modulus).approach();
      for (const Scaled& run : pin.runs) {
        const std::vector<double> n = run.run.column("revolution"), depth = run.run.column("depth_mean_mm");
        for (std::size_t k = 0; k < n.size(); ++k) {
          ours.x.push_back(analysis::groove_number(run.run.wear_coefficient() * n[k], pin.effective_modulus));
          ours.y.push_back(depth[k] / d0);
        }
      }
      panel.series.push_back(std::move(ours));
    }
  }
  if (s.measured.depth) {
    Series lab{.kind = Kind::markers, .name = "laboratory, taken for each pin", .colour = 4, .theirs = true};
    for (const Pin& pin : s.pins) {
      const double d0 = sphere(s, pin.effective_modulus).approach();
      lab.x.push_back(analysis::groove_number(s.test_wear, pin.effective_modulus));
      lab.y.push_back(0.5 * (s.measured.depth->low + s.measured.depth->high) / d0);
      lab.y_low.push_back(s.measured.depth->low / d0);
      lab.y_high.push_back(s.measured.depth->high / d0);
    }
    panel.series.push_back(std::move(lab));
  }
  return panel;
}

Panel stiffness_panel(const Scaling& s) {
  Panel panel{.title = "(b) The test's wear, any pin",
              .x = {.title = "effective modulus E* [GPa]", .log = true},
              .y = {.title = "wear depth [µm]"}};
  const std::vector<double> modulus = logarithmic(0.05, 200.0, 80);
  panel.x.range = {0.05, 200.0};
  if (s.measured.depth)
    panel.series.push_back({.kind = Kind::band,
                            .name = "measured depth",
                            .x = {0.05, 200.0},
                            .y_low = {1e6 * s.measured.depth->low, 1e6 * s.measured.depth->low},
                            .y_high = {1e6 * s.measured.depth->high, 1e6 * s.measured.depth->high},
                            .theirs = true});
  const auto depth = [&](double gpa, auto ratio) {
    return 1e6 * sphere(s, 1e9 * gpa).approach() * ratio(analysis::groove_number(s.test_wear, 1e9 * gpa));
  };
  panel.series.push_back(curve(
      "elastic half-space", modulus, [&](double e) { return depth(e, analysis::half_space_depth); },
      kCurveColour, Series::Dash::solid));
  panel.series.push_back(curve(
      "rigid sphere, (W/√2)^(2/3)", modulus, [&](double e) { return depth(e, analysis::rigid_sphere_depth); },
      kRigidColour, Series::Dash::dash));
  for (const std::vector<Pin>* group : {&s.pins, &s.further})
    for (const Pin& pin : *group)
      panel.series.push_back({.kind = Kind::markers,
                              .name = pin.name(),
                              .x = {1e-9 * pin.effective_modulus},
                              .y = {1e3 * pin.runs.front().depth},
                              .colour = pin.colour});
  return panel;
}

Figure master_figure(const Scaling& s) {
  const double one = analysis::rigid_from(0.01), five = analysis::rigid_from(0.05);
  return {
      .id = "master-curve",
      .title = "When the pin's stiffness matters",
      .caption = fmt::format(
          "Depth of the groove of a guided sphere on a wearing elastic half-space. Every row of every run is "
          "a point (first "
          "grooves of stiff pins are a triangle or two wide and lie off it); the curve is fitted to "
          "half-space solutions (within {:.2g} % for W from {:.3g} to {:.3g}) and not to these runs. Above W "
          "= {:.2g} the depth is within 5 % of a rigid sphere's, above {:.2g} within 1 %: there the "
          "stiffness no longer "
          "matters. With the test's α n = {:.3g} 1/Pa these are E* = {:.2g} and {:.2g} GPa.",
          100.0 * analysis::kHalfSpaceDepthError, analysis::kHalfSpaceLowest, analysis::kHalfSpaceHighest,
          five, one, s.test_wear, 1e-9 * five / s.test_wear, 1e-9 * one / s.test_wear),
      .panels = {master_panel(s), stiffness_panel(s)},
      .columns = 2};
}

/// Largest distance of a run's last row from the curve.
std::string master_sentence(const Scaling& s) {
  std::string text;
  for (const std::vector<Pin>* group : {&s.pins, &s.further}) {
    for (const Pin& pin : *group) {
      const double d0 = 1e3 * sphere(s, pin.effective_modulus).approach();
      const Scaled& run = pin.runs.front();
      const double W = analysis::groove_number(run.run.wear_coefficient() * run.run.last_revolution(),
                                               pin.effective_modulus);
      text += fmt::format("{}{} at W = {:.3g}: {}", text.empty() ? "" : "; ", pin.name(), W,
                          percent(run.depth / d0 / analysis::half_space_depth(W) - 1.0));
    }
  }
  return "Depth at the end of the least scaled run against the curve: " + text + ".";
}

// ---------------------------------------------------------------- against the laboratory

struct Comparison {
  std::string name, unit;
  study::Interval measured;
  double Scaled::*member;
  std::string why;
};

std::string inside_text(study::Interval range, double value) {
  return value < range.low ? "below" : value > range.high ? "above" : "inside";
}

void add_laboratory(PageSection& section, const Scaling& s) {
  std::vector<Comparison> rows;
  if (s.measured.wear_volume) {
    const auto& v = *s.measured.wear_volume;
    rows.push_back({"volume",
                    "mm³",
                    {1e9 * (v.mean - v.sd), 1e9 * (v.mean + v.sd)},
                    &Scaled::volume,
                    "The coefficient was measured as volume over load and distance, so the volume agrees by "
                    "construction, "
                    "for any pin."});
  }
  if (s.measured.depth)
    rows.push_back({"depth",
                    "mm",
                    {1e3 * s.measured.depth->low, 1e3 * s.measured.depth->high},
                    &Scaled::depth,
                    "A stiff pin leaves nearly the segment of a rigid sphere. A softened pin spreads the "
                    "same volume over its "
                    "wide contact, and is too shallow."});
  if (s.measured.width)
    rows.push_back({"width",
                    "mm",
                    {1e3 * s.measured.width->low, 1e3 * s.measured.width->high},
                    &Scaled::width,
                    "A stiff sphere that keeps its shape cannot leave so wide a groove at this volume: the "
                    "real tip wore flat, "
                    "and the steel was ploughed aside. The softened pin is wide for another reason, its "
                    "elastic contact."});
  if (rows.empty() || s.pins.empty()) return;
  DataTable table{.id = "laboratory",
                  .title = "The whole test against the laboratory",
                  .columns = {"quantity", "measured"}};
  for (const Pin& pin : s.pins) {
    table.columns.push_back(pin.name());
    table.columns.push_back("verdict: " + pin.name());
  }
  table.columns.emplace_back("why");
  table.caption = fmt::format(
      "The least scaled runs: {:.6g} revolutions, {:.6g} modelled. Reproduced: inside the measured range "
      "(volume: mean ± one "
      "standard deviation); trend only: within a factor of {:.0f} of its nearer end.",
      s.test_revolutions, s.pins.front().runs.front().modelled, study::kTrendFactor);
  std::string agree;
  for (const Comparison& row : rows) {
    std::vector<std::string> cells{row.name, fmt::format("{} to {} {}", readable(row.measured.low, 3),
                                                         readable(row.measured.high, 3), row.unit)};
    for (const Pin& pin : s.pins) {
      const double value = pin.runs.front().*row.member;
      cells.push_back(fmt::format("{} {}", readable(value, 3), row.unit));
      cells.push_back(verdict_text(study::judge_inside(row.measured, value)));
      agree += fmt::format("{}{} of the {} {} the measured range", agree.empty() ? "" : "; ", row.name,
                           pin.name(), inside_text(row.measured, value));
    }
    cells.push_back(row.why);
    table.rows.push_back(std::move(cells));
  }
  section.items.emplace_back(Paragraph{"Said plainly: " + agree + "."});
  section.items.emplace_back(std::move(table));
}

}  // namespace

Page scaling_page(const simulation::Setup& study, std::span<const StudyRun> runs,
                  const std::filesystem::path& output) {
  const Scaling s = read_scaling(study, runs);
  Page page;
  page.title = study.title.empty() ? "What scaling costs" : study.title;
  const auto completed = std::ranges::count(runs, "completed", &StudyRun::status);
  page.cards = {{"runs", fmt::format("{} of {}", completed, runs.size())}};
  if (!s.pins.empty()) {
    std::string shares;
    for (const Pin& pin : s.pins) {
      const std::string most = factor_text(pin, 0.01);
      page.cards.emplace_back(pin.name() + ": largest factor for 1 %", most);
      const Scaled* twelve = at_twelve(pin);
      if (twelve != nullptr)
        shares += fmt::format("{}{:.2g} % ({})", shares.empty() ? "" : ", ", 100.0 * twelve->profile_error,
                              pin.name());
    }
    page.summary = shares.empty()
                       ? fmt::format("The same wear in fewer revolutions, {} of {} runs completed.",
                                     completed, runs.size())
                       : fmt::format(
                             "The test's wear in 12 revolutions instead of {:.6g} changes the profile of the "
                             "groove by {}.",
                             s.test_revolutions, shares);
    PageSection cost{"What scaling costs", {}};
    cost.items.emplace_back(cost_figure(s));
    if (const std::string sentence = half_space_sentence(s); !sentence.empty())
      cost.items.emplace_back(Paragraph{sentence});
    cost.items.emplace_back(factor_table(s));
    cost.items.emplace_back(profile_figure(s));
    cost.items.emplace_back(cost_table(s));
    page.sections.push_back(std::move(cost));
    PageSection stiffness{"When the pin's stiffness matters", {}};
    stiffness.items.emplace_back(master_figure(s));
    stiffness.items.emplace_back(Paragraph{master_sentence(s)});
    page.sections.push_back(std::move(stiffness));
    PageSection laboratory{"Against the laboratory", {}};
    add_laboratory(laboratory, s);
    if (!laboratory.items.empty()) page.sections.push_back(std::move(laboratory));
  }
  page.sections.push_back(all_runs(runs, output));
  return page;
}

}  // namespace abradem::report
