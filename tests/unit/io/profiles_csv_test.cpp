// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/profiles_csv.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "abradem/core/error.h"
#include "temporary_folder.h"

namespace abradem::io {
namespace {

class ProfilesFile : public TemporaryFolder {
 protected:
  std::string refusal(std::string_view content) {
    const std::filesystem::path file = write("p.csv", content);
    try {
      (void)read_profiles(file);
    } catch (const IoError& e) {
      const std::string text = e.what(), folder = folder_.string() + "/";
      return text.starts_with(folder) ? text.substr(folder.size()) : text;
    }
    return "accepted";
  }
};

TEST_F(ProfilesFile, HoldsSectionsByRevolutionAngleAndName) {
  const auto s = read_profiles(write("p.csv",
                                     "revolution,angle_deg,radius_mm,height_mm\n1,0,21,0\n1,0,22,-0.01\n"
                                     "1,90,21,0\n1,90,22,-0.02\n2,0,21,0\n2,0,23,-0.03\n"));
  ASSERT_EQ(s.size(), 3U);
  EXPECT_EQ(s[0].name, "p.csv, revolution 1, 0 deg");
  EXPECT_EQ(s[1].revolution, 1.0);
  EXPECT_NEAR(s[1].angle, std::numbers::pi / 2, 1e-15);
  ASSERT_EQ(s[2].profile.size(), 2U);
  EXPECT_EQ(s[2].profile[0], (analysis::ProfilePoint{0.021, 0.0}));
  EXPECT_EQ(s[2].profile[1].radius, 0.023);
  EXPECT_DOUBLE_EQ(s[2].profile[1].height, -3e-5);

  const auto named = read_profiles(write("n.csv", "section;x (um);z (nm)\na;0;0\na;1;-5\nb;0;0\nb;2;1\n"));
  ASSERT_EQ(named.size(), 2U);
  EXPECT_EQ(named[1].name, "n.csv, b");
  EXPECT_TRUE(std::isnan(named[1].revolution) && std::isnan(named[1].angle));
  EXPECT_EQ(named[0].profile[1], (analysis::ProfilePoint{1e-6, -5e-9}));
}

TEST_F(ProfilesFile, MayRunBackwards) {
  const auto s = read_profiles(write("p.csv", "x_mm,z_um\n3,0\n2,-1\n1,0\n"));
  ASSERT_EQ(s.size(), 1U);
  EXPECT_EQ(s[0].name, "p.csv");
  EXPECT_EQ(s[0].profile.front().radius, 1e-3);
}

TEST_F(ProfilesFile, SaysWhereItIsWrong) {
  EXPECT_EQ(refusal("x_mm,z_um\n1,0\n2,-1\n2,0\n").substr(0, 50),
            "p.csv:4:1: 2 follows 2 mm; the points of a section");
  EXPECT_EQ(refusal("x_mm,z_um\n1,0\n2,-1\n1.5,0\n").substr(0, 24), "p.csv:4:1: 1.5 follows 2");
  EXPECT_EQ(refusal("section,x_mm,z_um\na,1,0\na,2,0\nb,1,0\nb,2,0\na,3,0\na,4,0\n"),
            "p.csv:6: a section that has ended begins again; keep the rows of a section together");
  EXPECT_EQ(refusal("section,x_mm,z_um\na,1,0\nb,1,0\nb,2,0\n"),
            "p.csv:2:3: a section of one point; 2 or more are needed");
  EXPECT_EQ(refusal("x_mm,z_um\n1,0\n2,1 um\n"),
            "p.csv:3:3: column 'z_um': '1 um' is not a number; expected digits with a decimal point, such as "
            "0.0081");
  EXPECT_EQ(
      refusal("x_mm,hight_um\n1,0\n"),
      "p.csv:1: no column 'height' with its unit, as in 'height [mm]'; the header has: x_mm, hight_um; is it "
      "'hight'?");
  EXPECT_EQ(refusal("x_mm,z_um\n"), "p.csv: no points below the header");
}

}  // namespace
}  // namespace abradem::io
