// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "abradem/analysis/levelling.h"
#include "abradem/io/profiles_csv.h"
#include "abradem/report/page.h"
#include "abradem/report/statistics_section.h"

/// Measured profiles of a groove: what a run's sections are measured by, on those of an instrument.
///                                                                             docs/reference/analyse.md
namespace abradem::report {

struct ProfileOptions {
  analysis::Baseline baseline = analysis::Baseline::none;
  std::optional<double> shoulder{};      ///< [m]; default: a tenth of each section's length
  std::optional<double> width_depth{};   ///< depth at which a third width is measured [m]
  std::optional<double> track_radius{};  ///< [m]; gives the worn volume and lengths along the track
};

struct MeasuredSection {
  std::string name;
  double revolution = 0.0;      ///< NaN where the table has none
  analysis::Contour contour;    ///< of the levelled profile; angle NaN where the table has none
  analysis::Levelled levelled;  ///< offset and tilt that were taken away, roughness left
  double width_at_depth = 0.0;  ///< [m] at ProfileOptions::width_depth; NaN without
  bool ends_in_groove = false;  ///< an end lies below the level of the width
};

struct ProfileAnalysis {
  ProfileOptions options;
  std::vector<MeasuredSection> sections;  ///< by revolution, in the order of the tables
  GrooveSeries series;
};

/// @throws InputError naming the section that cannot be levelled
[[nodiscard]] ProfileAnalysis analyse_profiles(std::span<const io::ReadSection> sections,
                                               const ProfileOptions& options);

/// What a reader must know before trusting the numbers: levels inside the roughness, sections that end in the
/// groove.
[[nodiscard]] std::vector<std::string> profile_warnings(const ProfileAnalysis& analysis);

[[nodiscard]] std::string profile_text(const ProfileAnalysis& analysis);
/// In mm, mm^2, um and degrees; what does not exist is null.
[[nodiscard]] std::string profile_json(const ProfileAnalysis& analysis);
/// @param source name of the file (or files)
[[nodiscard]] Page profile_page(const ProfileAnalysis& analysis, const std::string& source);

}  // namespace abradem::report
