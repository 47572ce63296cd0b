// SPDX-License-Identifier: BSD-3-Clause
// Grooves of known shape as an instrument would write them: depth, both widths and area through the table,
// level and tilted.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "abradem/core/error.h"
#include "abradem/core/random.h"
#include "abradem/io/profiles_csv.h"
#include "abradem/report/profile_report.h"

namespace abradem {
namespace {

/// What the issue of such measures is: a tenth of a per cent, at points 0.2 um apart.
constexpr double kTolerance = 1e-3;
constexpr double kDepth = 10e-6, kHalf = 0.35e-3, kLevel = 0.5e-6;  // the level is max(1 % of kDepth, 0.5 um)

struct Groove {
  const char* name;
  std::function<double(double)> height;  ///< [m] over the distance from the middle [m]
  double width, displaced_width, area;
};

std::vector<Groove> grooves() {
  const double R = 3e-3, b = R - kDepth, a = std::sqrt(R * R - b * b);
  const auto chord = [&](double level) { return 2.0 * std::sqrt(R * R - (b + level) * (b + level)); };
  return {{"segment", [=](double x) { return std::abs(x) < a ? b - std::sqrt(R * R - x * x) : 0.0; },
           chord(kLevel), 2.0 * a, R * R * std::acos(b / R) - b * a},
          {"parabola", [](double x) { return std::min(0.0, kDepth * (x * x / (kHalf * kHalf) - 1.0)); },
           2.0 * kHalf * std::sqrt(1.0 - kLevel / kDepth), 2.0 * kHalf, 4.0 / 3.0 * kHalf * kDepth},
          {"V", [](double x) { return std::min(0.0, kDepth * (std::abs(x) / kHalf - 1.0)); },
           2.0 * kHalf * (1.0 - kLevel / kDepth), 2.0 * kHalf, kHalf * kDepth}};
}

class MeasuredProfiles : public ::testing::Test {
 protected:
  void SetUp() override {
    file_ = std::filesystem::temp_directory_path() / ("abradem-profile-" + std::to_string(getpid()) + ".csv");
  }
  void TearDown() override { std::filesystem::remove(file_); }

  /// The groove in the middle of 2 mm, in mm and um, on a surface with this offset and tilt and noise of this
  /// range; the grid does not meet the middle.
  void write(const Groove& groove, double offset = 0.0, double tilt = 0.0, double noise = 0.0) const {
    std::ofstream out(file_);
    out.precision(12);
    out << "x [mm],z (um)\n";
    core::RandomStream random(1);
    for (int i = 0; i <= 10000; ++i) {
      const double x = -1e-3 + 0.2e-6 * (i + 0.37);
      const double z = groove.height(x) + offset + tilt * x + noise * (random.uniform() - 0.5);
      out << 1e3 * (x + 22e-3) << ',' << 1e6 * z << '\n';
    }
  }
  [[nodiscard]] report::MeasuredSection measure(const report::ProfileOptions& options = {}) const {
    return report::analyse_profiles(io::read_profiles(file_), options).sections.at(0);
  }

  std::filesystem::path file_;
};

void expect_close(double value, double expected, double tolerance = kTolerance) {
  EXPECT_NEAR(value, expected, tolerance * expected);
}

TEST_F(MeasuredProfiles, OfKnownGroovesMeasureToATenthOfAPerCent) {
  for (const Groove& groove : grooves()) {
    SCOPED_TRACE(groove.name);
    write(groove);
    const report::MeasuredSection s = measure({.width_depth = 5e-6});
    expect_close(s.contour.depth, kDepth);
    expect_close(s.contour.width, groove.width);
    expect_close(s.contour.displaced_width, groove.displaced_width);
    expect_close(s.contour.area, groove.area);
    EXPECT_EQ(s.levelled.roughness, 0.0);
    EXPECT_FALSE(s.ends_in_groove);
    if (std::string(groove.name) == "V") expect_close(s.width_at_depth, kHalf);
  }
}

TEST_F(MeasuredProfiles, OfTiltedGroovesMeasureTheSameWhenLevelled) {
  for (const Groove& groove : grooves()) {
    SCOPED_TRACE(groove.name);
    write(groove, 30e-6, 5e-3);
    const report::MeasuredSection s = measure({.baseline = analysis::Baseline::line, .shoulder = 0.3e-3});
    expect_close(s.contour.depth, kDepth);
    expect_close(s.contour.width, groove.width);
    expect_close(s.contour.area, groove.area);
    EXPECT_NEAR(s.levelled.tilt, 5e-3, 1e-12);
    EXPECT_NEAR(s.levelled.offset, 30e-6 + 5e-3 * 0.37 * 0.2e-6, 1e-12);
    EXPECT_LT(s.levelled.roughness, 1e-12);
  }
}

TEST_F(MeasuredProfiles, MeanBaselineTakesAwayTheOffsetAlone) {
  const Groove v = grooves()[2];
  write(v, -12e-6);
  const report::MeasuredSection s = measure({.baseline = analysis::Baseline::mean, .shoulder = 0.2e-3});
  expect_close(s.contour.depth, kDepth);
  expect_close(s.contour.area, v.area);
  EXPECT_EQ(s.levelled.tilt, 0.0);
}

TEST_F(MeasuredProfiles, RoughnessIsMeasuredAndWarnedOf) {
  const Groove v = grooves()[2];
  write(v, 0.0, 0.0, 2e-6);  // uniform over 2 um: Rq = 2/sqrt(12) um
  const auto analysis =
      report::analyse_profiles(io::read_profiles(file_), {.baseline = analysis::Baseline::line});
  const report::MeasuredSection& s = analysis.sections.at(0);
  EXPECT_NEAR(s.levelled.roughness, 2e-6 / std::sqrt(12.0), 0.03e-6);
  EXPECT_GT(s.contour.width, 1.9e-3);  // to the outermost scratch, which is why it is warned of
  EXPECT_NEAR(s.contour.area, v.area, 0.01 * v.area);
  const auto warnings = report::profile_warnings(analysis);
  ASSERT_FALSE(warnings.empty());
  EXPECT_NE(warnings[0].find("so rough that the level of the width"), std::string::npos);
}

TEST_F(MeasuredProfiles, ShouldersThatDoNotSufficeAreRefused) {
  write(grooves()[2]);
  const auto refusal = [&](const report::ProfileOptions& options) {
    try {
      (void)measure(options);
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string("accepted");
  };
  EXPECT_NE(refusal({.baseline = analysis::Baseline::line, .shoulder = 1.1e-3})
                .find("shoulders of 1.1 mm on a section of 2 mm"),
            std::string::npos);
  EXPECT_NE(
      refusal({.baseline = analysis::Baseline::line, .shoulder = 0.1e-6}).find("1 and 1 points on shoulders"),
      std::string::npos);
}

}  // namespace
}  // namespace abradem
