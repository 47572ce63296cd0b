// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/measured_table.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <string>

#include "abradem/core/error.h"
#include "abradem/io/wear_tests.h"
#include "temporary_folder.h"

namespace abradem::io {
namespace {

using namespace std::string_view_literals;
constexpr core::Dimension kForce{.mass = 1, .length = 1, .time = -2}, kVolume{.length = 3};
constexpr std::array kForceNames{"force"sv, "load"sv};
constexpr std::array kVolumeNames{"volume"sv};

class MeasuredTableFile : public TemporaryFolder {
 protected:
  /// The message without the folder.
  std::string refusal(std::string_view content,
                      const std::function<void(const std::filesystem::path&)>& read) {
    const std::filesystem::path file = write("t.csv", content);
    try {
      read(file);
    } catch (const IoError& e) {
      const std::string text = e.what(), folder = folder_.string() + "/";
      return text.starts_with(folder) ? text.substr(folder.size()) : text;
    }
    return "accepted";
  }
  std::string tests_refusal(std::string_view content) {
    return refusal(content, [](const std::filesystem::path& f) { (void)read_wear_tests(f); });
  }
};

TEST_F(MeasuredTableFile, ReadsWhatSpreadsheetsAndPeopleWrite) {
  const MeasuredTable t(
      write("t.csv",
            "\xef\xbb\xbf# from the laboratory\r\n\r\nMaterial;Load [kN];\"volume (mm^3)\"\r\n"
            "\"steel; \"\"hard\"\"\";0.5;+2e3\r\n bronze ; 1 ;3\r\n"));
  ASSERT_EQ(t.rows(), 2U);
  EXPECT_EQ(t.line(0), 4U);
  EXPECT_EQ(t.quantities(kForceNames, kForce), (std::vector<double>{500.0, 1000.0}));
  EXPECT_EQ(t.quantities(kVolumeNames, kVolume), (std::vector<double>{2e-6, 3e-9}));
  EXPECT_EQ(t.texts(std::array{"material"sv}), (std::vector<std::string>{"steel; \"hard\"", "bronze"}));
  EXPECT_FALSE(t.find(std::array{"distance"sv}));
}

TEST_F(MeasuredTableFile, ReadsUnitsBehindTheName) {
  const MeasuredTable t(write("t.csv",
                              "force_N,volume_mm3,wear_track,velocity_x_mm_per_s,wear_per_pass\n"
                              "5,0.5,1,20,3"));
  EXPECT_EQ(t.quantities(std::array{"velocity_x"sv}, {.length = 1, .time = -1}), (std::vector<double>{0.02}));
  EXPECT_TRUE(t.find(std::array{"wear_per_pass"sv}));
  const MeasuredTable gap(write("t.csv", "force_N\nnan\n5\n"));
  EXPECT_THROW((void)gap.quantities(kForceNames, kForce), IoError);
  EXPECT_TRUE(std::isnan(gap.quantities(kForceNames, kForce, true)[0]));
  EXPECT_EQ(t.quantities(kForceNames, kForce), (std::vector<double>{5.0}));
  EXPECT_EQ(t.quantities(kVolumeNames, kVolume), (std::vector<double>{0.5 / 1e9}));
  EXPECT_TRUE(t.find(std::array{"wear_track"sv}));
}

TEST_F(MeasuredTableFile, SaysWhereItIsWrong) {
  EXPECT_EQ(
      tests_refusal("force_N,distance_m,volume_mm3\n5,1,2\n5,x,2\n"),
      "t.csv:3:3: column 'distance_m': 'x' is not a number; expected digits with a decimal point, such as "
      "0.0081");
  EXPECT_EQ(tests_refusal("force_N,distance_m,volume_mm3\n5,1,2\n5,1\n"),
            "t.csv:3: 2 fields where the header names 3 columns");
  EXPECT_EQ(tests_refusal("force,distance_m,volume_mm3\n5,1,2\n"),
            "t.csv:1:1: column 'force' has no unit; write a force, as in 'force [N]'");
  EXPECT_EQ(tests_refusal("force_N,distance_s,volume_mm3\n5,1,2\n"),
            "t.csv:1:9: column 'distance_s' is in 's'; a length is expected");
  EXPECT_EQ(tests_refusal("# x\nforce_N,distnce_m,volume_mm3\n5,1,2\n"),
            "t.csv:2: no column 'distance' with its unit, as in 'distance [mm]'; the header has: force_N, "
            "distnce_m, "
            "volume_mm3; is it 'distnce'?");
  EXPECT_EQ(tests_refusal("force_N,load_N,distance_m,volume_mm3\n5,1,2,3\n"),
            "t.csv:1:9: 'force_N' and 'load_N' are both the force; leave one");
  EXPECT_EQ(tests_refusal("force_N,force_N\n5,1\n"), "t.csv:1:9: column 'force_N' is there twice");
  EXPECT_EQ(tests_refusal("force_N,distance_m,volume_mm3\n5,1,0\n").substr(0, 61),
            "t.csv:2:5: column 'volume_mm3': a test needs a positive value");
  EXPECT_EQ(tests_refusal("force_N,\"distance\n"), "t.csv:1:9: the quote that begins here does not end");
  EXPECT_EQ(tests_refusal(""), "t.csv: empty; expected a line that names the columns, then the rows");
  EXPECT_EQ(tests_refusal("force_N,distance_m,volume_mm3\n"), "t.csv: no tests below the header");
  EXPECT_THROW((void)read_wear_tests(in_folder("none.csv")), IoError);
}

TEST_F(MeasuredTableFile, TakesMassAndDensityForAVolume) {
  const auto tests =
      read_wear_tests(write("t.csv",
                            "material,load_N,sliding_distance_km,mass_loss_mg,density [g/cm^3]\n"
                            "b,5,1,7.8,7.8\na,5,2,2.7,2.7\nb,10,1,15.6,7.8\n"));
  ASSERT_EQ(tests.size(), 2U);
  EXPECT_EQ(tests[0].material, "b");
  ASSERT_EQ(tests[0].volume.size(), 2U);
  EXPECT_NEAR(tests[0].volume[1], 2e-9, 1e-23);
  EXPECT_EQ(tests[1].distance, (std::vector<double>{2000.0}));
}

}  // namespace
}  // namespace abradem::io
