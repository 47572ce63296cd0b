// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "abradem/io/vtp.h"
#include "abradem/report/study_page.h"
#include "abradem/study/calibration.h"

/// Folders as the runs of a study leave them, made of formulas, so that what a page must say of them is
/// known.
namespace abradem::test {

inline constexpr double kTrack = 22e-3, kLoad = 5.0, kTrackLength = 2.0 * std::numbers::pi * kTrack;  // SI

/// What a run found: functions of the revolution and the angle [deg], in the tables' units.
struct SyntheticRun {
  int revolutions = 10;
  double per_row = 1.0;  ///< revolutions of the test per row
  std::function<double(double n, double angle)> depth_mm = [](double n, double) { return 1e-3 * n; };
  std::function<double(double n, double angle)> width_mm = [](double, double) { return 0.8; };
  std::function<double(double n)> law_mm3 = [](double n) { return 0.01 * n; };
  std::function<double(double n)> swept_mm3 = [](double n) { return 0.01 * n; };
  std::function<double(double n)> paper_mm3 = [](double n) { return 0.01 * n; };
  /// Along the load; sample k of each revolution.
  std::function<double(double n, int k)> force_N = [](double, int k) {
    return 5.0 + 0.001 * std::sin(1.7 * k);
  };
  bool with_surface = false;
};

inline void write_file(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
}

/// A ring of the track before and after: a parabolic groove of the run's last depth and width.
inline void write_surfaces(const std::filesystem::path& folder, const SyntheticRun& run) {
  constexpr int kAround = 120, kAcross = 13;
  geometry::TriangleMesh mesh;
  for (int a = 0; a < kAround; ++a) {
    for (int r = 0; r < kAcross; ++r) {
      const double angle = 2.0 * std::numbers::pi * a / kAround, radius = kTrack + 1e-3 * (r - 6) * 0.12;
      mesh.vertices.push_back({radius * std::cos(angle), radius * std::sin(angle), 0.0});
    }
  }
  for (int a = 0; a < kAround; ++a) {
    for (int r = 0; r + 1 < kAcross; ++r) {
      const int here = a * kAcross + r, next = (a + 1) % kAround * kAcross + r;
      mesh.triangles.push_back({here, here + 1, next + 1});
      mesh.triangles.push_back({here, next + 1, next});
    }
  }
  std::filesystem::create_directories(folder / "vtk");
  io::write_vtp(folder / "vtk/disc_0000.vtp", mesh, {}, {});
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const int a = static_cast<int>(v) / kAcross, r = static_cast<int>(v) % kAcross;
    const double n = run.revolutions * run.per_row, angle = 360.0 * a / kAround;
    const double x = 2.0 * (r - 6) * 0.12 / run.width_mm(n, angle);
    mesh.vertices[v].z -= 1e-3 * run.depth_mm(n, angle) * std::max(0.0, 1.0 - x * x);
  }
  io::write_vtp(folder / "vtk/disc_0001.vtp", mesh, {}, {});
  const std::vector<io::PvdEntry> frames{{0.0, "vtk/disc_0000.vtp", 0}, {1.0, "vtk/disc_0001.vtp", 0}};
  io::write_pvd(folder / "series.pvd", frames);
}

inline void write_run(const std::filesystem::path& folder, const SyntheticRun& run, int sections = 360) {
  std::string revolutions =
      "revolution,time_s,law_volume_mm3,swept_volume_mm3,paper_volume_mm3,depth_mean_mm,depth_sd_mm,depth_"
      "min_mm,"
      "depth_max_mm,width_mean_mm,width_sd_mm,area_mean_mm2,force_mean_N,force_sd_N,force_min_N,force_max_N,"
      "depth_p_chi2,width_p_chi2\n";
  std::string contours = "revolution,angle_deg,depth_mm,width_mm,area_mm2,displaced_width_mm\n";
  std::string profiles = "revolution,angle_deg,radius_mm,height_mm\n";
  std::string force =
      "time_s,revolution,normal_force_N,tangential_force_N,overlap_um,contacts,normal_along_N,normal_across_"
      "N,"
      "normal_sum_N\n";
  for (int row = 1; row <= run.revolutions; ++row) {
    const double n = row * run.per_row;
    double depth = 0.0, width = 0.0;
    for (int k = 0; k < sections; ++k) {
      const double angle = 360.0 * k / sections, d = run.depth_mm(n, angle), w = run.width_mm(n, angle);
      depth += d / sections;
      width += w / sections;
      contours += fmt::format("{},{},{},{},{},{}\n", n, angle, d, w, 2.0 / 3.0 * d * w, w);
      if (k % (sections / 8) != 0) continue;
      for (int p = -10; p <= 10; ++p)
        profiles +=
            fmt::format("{},{},{},{}\n", n, angle, 1e3 * kTrack + 0.05 * p * w, -d * (1.0 - 0.01 * p * p));
    }
    revolutions +=
        fmt::format("{},{},{},{},{},{},0,{},{},{},0,0.004,5,0.1,4.9,5.1,nan,nan\n", n, 2.0 * n,
                    run.law_mm3(n), run.swept_mm3(n), run.paper_mm3(n), depth, depth, depth, width);
    for (int k = 1; k <= 50; ++k) {
      const double f = run.force_N(n, k);
      force +=
          fmt::format("{0},{1},{2},5,40,1,{2},0.1,{3}\n", n, n - run.per_row * (1.0 - 0.02 * k), f, f + 0.01);
    }
  }
  write_file(folder / "tables/revolutions.csv", revolutions);
  write_file(folder / "tables/contours.csv", contours);
  write_file(folder / "tables/profiles.csv", profiles);
  write_file(folder / "tables/force.csv", force);
  if (run.with_surface) write_surfaces(folder, run);
}

/// The case of the published study, as plain data.
inline simulation::Setup paper_setup() {
  simulation::Setup setup;
  setup.title = "Pin on disc <published>";
  setup.materials = {{"iron_ore", 4850.0, 0.1e9, 0.24, {}},
                     {"mild_steel", 7932.0, 78e9, 0.30, 143.0 * 9806650.0}};
  setup.contacts = {{"iron_ore", "mild_steel", 0.4, 1.0, 0.0}};
  setup.wear = {{"iron_ore", "mild_steel", 5e-11, {}, 0.01}};
  simulation::WallSetup wall;
  wall.name = "disc";
  wall.material = "mild_steel";
  wall.mesh.outer = 24e-3;
  wall.mesh.size = 0.1e-3;
  wall.motion.rate = std::numbers::pi;
  wall.contact = simulation::ContactRule::per_triangle;
  wall.deformation = simulation::DeformationRule::paper;
  setup.walls = {wall};
  simulation::ParticleSetup pin;
  pin.name = "pin";
  pin.material = "iron_ore";
  pin.radius = 3e-3;
  pin.position = {kTrack, 0.0, 3e-3};
  pin.load = {0.0, 0.0, -kLoad};
  setup.particles = {pin};
  setup.run.end = {12.0, true};
  setup.measurement =
      simulation::MeasurementSetup{simulation::MeanSd{0.565e-9, 0.089e-9}, simulation::Range{10e-6, 14e-6},
                                   simulation::Range{0.65e-3, 0.80e-3}, 1302.5};
  setup.study.emplace();
  return setup;
}

/// A study under a folder: its runs, as the program hands them to the page.
class SyntheticStudy {
 public:
  explicit SyntheticStudy(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// A completed run, made from a setup.
  void add(const std::string& variation, simulation::Setup setup, const SyntheticRun& run) {
    report::StudyRun& made = entry(variation, std::move(setup));
    made.status = "completed";
    write_run(made.folder, run);
  }
  void add_failed(const std::string& variation, simulation::Setup setup, const std::string& message) {
    report::StudyRun& made = entry(variation, std::move(setup));
    made.status = "failed";
    made.message = message;
  }
  [[nodiscard]] const std::vector<report::StudyRun>& runs() const noexcept { return runs_; }
  [[nodiscard]] const std::filesystem::path& folder() const noexcept { return folder_; }

 private:
  report::StudyRun& entry(const std::string& variation, simulation::Setup setup) {
    report::StudyRun run;
    run.variation = variation;
    run.name = fmt::format("{}/{:02}", variation, runs_.size() + 1);
    run.folder = folder_ / "runs" / run.name;
    run.setup = std::move(setup);
    run.seconds = 0.5;
    runs_.push_back(std::move(run));
    return runs_.back();
  }
  std::filesystem::path folder_;
  std::vector<report::StudyRun> runs_;
};

/// Numbers that pass for independent draws of a normal distribution with mean 0 and sd 1: its quantiles,
/// shuffled.
inline double normal_like(int k, int of) {
  const int shuffled = (k * 149) % of;  // 149 has no divisor in common with 360
  const double p = (shuffled + 0.5) / of;
  // Inverse of the normal distribution by bisection of erfc.
  double low = -6.0, high = 6.0;
  for (int i = 0; i < 60; ++i) {
    const double x = 0.5 * (low + high);
    (0.5 * std::erfc(-x / std::numbers::sqrt2) < p ? low : high) = x;
  }
  return 0.5 * (low + high);
}

/// The published study as the paper found it in its own rules, and as Archard's law has it in ours.
inline SyntheticStudy published_study(const std::filesystem::path& folder) {
  SyntheticStudy study(folder);
  const auto setup_of = [](bool conserving, double coefficient, double size) {
    simulation::Setup setup = paper_setup();
    setup.study.reset();
    setup.wear.front().wear_coefficient = coefficient;
    setup.walls.front().mesh.size = size;
    if (conserving) {
      setup.walls.front().contact = simulation::ContactRule::patch;
      setup.walls.front().deformation = simulation::DeformationRule::conserving;
    }
    return setup;
  };
  const auto archard = [](double coefficient) {
    return [coefficient](double n) { return 1e9 * coefficient * kLoad * kTrackLength * n; };
  };
  const auto section = [](double angle) { return normal_like(static_cast<int>(std::lround(angle)), 360); };
  for (const bool conserving : {false, true}) {
    for (int k = 1; k <= 10; ++k) {
      SyntheticRun run{.revolutions = 1};
      run.depth_mm = [=](double, double) { return 0.01 / k; };
      // Falls with the mesh size where the paper's grows.
      run.width_mm = [=](double, double) { return conserving ? 2.0 - 0.1 * k : 0.5 + 0.1 * k; };
      study.add("mesh_size", setup_of(conserving, 5e-11, 1e-4 * k), run);
    }
    SyntheticRun turns;
    turns.law_mm3 = turns.swept_mm3 = turns.paper_mm3 = archard(5e-11);
    if (conserving) {
      turns.depth_mm = [=](double n, double angle) {
        return 1e-3 * std::pow(n, 0.6) * (1.0 + 0.01 * section(angle));
      };
      turns.width_mm = [=](double n, double angle) {
        return 0.4 * std::pow(n, 0.3) * (1.0 + 0.01 * section(angle));
      };
    } else {
      // Two thirds of a normal distribution's range is that of the paper, from revolution 8 on; before, two
      // heaps.
      const auto scatter = [=](double n, double angle) {
        return n > 7.5 ? section(angle) : (section(angle) > 0.0 ? 1.0 : -1.0) + 0.1 * section(angle);
      };
      turns.depth_mm = [=](double n, double angle) { return 5.6e-3 * n * (1.0 + 0.083 * scatter(n, angle)); };
      turns.width_mm = [=](double n, double angle) {
        return 1.2 * std::pow(0.1 * n, 0.3) * (1.0 + 0.11 * scatter(n, angle));
      };
      turns.force_N = [](double, int k) { return k == 7 ? 15.0 : 4.8 + 0.01 * std::sin(1.7 * k); };
    }
    study.add("revolutions", setup_of(conserving, 5e-11, 1e-4), turns);
    for (const study::PublishedFit& fit : study::published_fits()) {
      SyntheticRun run{.revolutions = 12};
      run.law_mm3 = run.swept_mm3 = archard(fit.wear_coefficient);
      run.paper_mm3 = [fit](double n) { return 1e9 * fit.volume(n); };
      run.depth_mm = [](double n, double) { return 0.019 * n / 12.0; };
      run.width_mm = [](double, double) { return 1.07; };
      study.add("wear_coefficient", setup_of(conserving, fit.wear_coefficient, 1e-4), run);
    }
    SyntheticRun profile{.revolutions = 1, .per_row = 12.0};
    profile.depth_mm = [=](double, double angle) {
      return 0.015 * (1.0 + 0.01 * section(angle)) +
             (!conserving && angle > 95.0 && angle < 105.0 ? 0.01 : 0.0);
    };
    profile.with_surface = true;
    study.add("profile", setup_of(conserving, 1.7e-11, 1e-4), profile);
  }
  SyntheticRun calibrated{.revolutions = 12};
  calibrated.swept_mm3 = [=](double n) { return 0.565 * n / 12.0; };
  calibrated.depth_mm = [](double n, double) { return 0.00796 * n / 12.0; };
  calibrated.width_mm = [](double, double) { return 0.78; };
  study.add("calibrated", setup_of(true, 6.81e-11, 1e-4), calibrated);
  SyntheticRun laboratory = calibrated;
  laboratory.depth_mm = [](double n, double) { return 0.0121 * n / 12.0; };
  laboratory.width_mm = [](double, double) { return 0.72; };
  simulation::Setup ridges = setup_of(true, 6.82e-11, 5e-5);
  ridges.ploughing = simulation::PloughingSetup{.removed_fraction = 0.54};
  study.add("laboratory", ridges, laboratory);
  return study;
}

}  // namespace abradem::test
