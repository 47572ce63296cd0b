// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "abradem/analysis/normality.h"
#include "abradem/report/published.h"
#include "abradem/report/study_page.h"
#include "abradem/report/table.h"

/// The runs of the published pin-on-disc study, sorted by what is drawn from them.
///                                                                      docs/reference/study.md#page-paper
namespace abradem::report {

/// A completed run with its tables.
struct FinishedRun {
  const StudyRun* run = nullptr;
  Table revolutions, contours, profiles, force;

  [[nodiscard]] const simulation::Setup& setup() const noexcept { return run->setup; }
  [[nodiscard]] double wear_coefficient() const noexcept;  ///< [1/Pa]
  [[nodiscard]] double mesh_size() const noexcept;         ///< of the worn wall [m]
  [[nodiscard]] double effective_modulus() const;          ///< E* of the pair that wears [Pa]
  [[nodiscard]] double last_revolution() const { return revolutions["revolution"].back(); }
  /// A column of a table, times a factor, in the rows of one revolution, or in all.
  [[nodiscard]] std::vector<double> sections(double revolution, std::string_view column,
                                             double factor = 1.0) const;
  [[nodiscard]] std::vector<double> forces(double revolution, std::string_view column) const;
  [[nodiscard]] std::vector<double> column(std::string_view name, double factor = 1.0) const;
  /// p of the chi-squared test for each revolution; NaN without verdict.
  [[nodiscard]] std::vector<double> normality(std::string_view contour_column,
                                              analysis::Binning binning) const;
  /// A column of revolutions.csv at a revolution; NaN where the run has no such row.
  [[nodiscard]] double at(double revolution, std::string_view column) const;
};
/// @throws IoError when a table is damaged
[[nodiscard]] FinishedRun read_finished(const StudyRun& run);

/// One section of profiles.csv: radius from the track [mm] and height [µm].
struct DrawnProfile {
  double angle = 0.0;  ///< [deg]
  std::vector<double> x_mm, height_um;
};
/// The sections written of one revolution, by angle.   @param track radius of the track [mm]
[[nodiscard]] std::vector<DrawnProfile> profiles_of(const FinishedRun& run, double revolution, double track);

/// The paper's results in one reading of its rules.
struct PaperReading {
  std::string name;           ///< "paper's rules"
  std::string volume_column;  ///< of revolutions.csv that stands for the wear volume
  std::string volume_name;    ///< what it is, in words
  std::string width_column;   ///< of contours.csv
  std::string width_name;
  analysis::Binning binning{};  ///< of the chi-squared test
  bool conserving = false;
  int colour = 0;
  std::vector<FinishedRun> mesh_sizes{};     ///< by ascending size
  std::optional<FinishedRun> revolutions{};  ///< the reference, revolution by revolution
  std::vector<FinishedRun> coefficients{};   ///< by ascending wear coefficient
  std::vector<FinishedRun> seeds{};
  std::optional<FinishedRun> profile{};  ///< with its surface

  /// The run at a wear coefficient; nothing where there is none.
  [[nodiscard]] const FinishedRun* with_coefficient(double coefficient) const noexcept;
};

struct PaperRuns {
  std::array<PaperReading, 2> readings;   ///< the paper's rules, conserving
  std::vector<FinishedRun> calibrated;    ///< conserving, by ascending E*
  std::optional<FinishedRun> laboratory;  ///< conserving, with a worn pin and ridges
  PublishedValues published;
  simulation::MeasurementSetup measured;
  double load = 0.0;          ///< on the pin [N]
  double track = 0.0;         ///< radius of the track [m]
  double passes_test = 0.0;   ///< revolutions of the test; NaN where not measured
  simulation::Setup setup{};  ///< of the study
};

/// Width against mesh size, in both readings: the paper's, for coarse conserving grooves are shallower than
/// the threshold of the other.
inline constexpr std::string_view kMeshWidth = "displaced_width_mm";

/// Names of the variations that are drawn from.
inline constexpr std::string_view kMeshSizeRuns = "mesh_size", kRevolutionRuns = "revolutions",
                                  kCoefficientRuns = "wear_coefficient", kSeedRuns = "seed",
                                  kProfileRuns = "profile", kCalibratedRuns = "calibrated",
                                  kLaboratoryRuns = "laboratory";

/// @throws IoError when a finished run's tables, or the published values, are damaged
[[nodiscard]] PaperRuns read_paper_runs(const simulation::Setup& study, std::span<const StudyRun> runs);

}  // namespace abradem::report
