// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "abradem/core/error.h"

namespace abradem::report {

inline void write_text(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
}

inline std::string read_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The message of the IoError a call throws; empty when it throws none.
template <class Call>
std::string io_error(Call call) {
  try {
    call();
  } catch (const IoError& error) {
    return error.what();
  }
  return {};
}

/// A folder as a small run of one revolution leaves it; gone when the test ends.
class RunFixture : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              ("abradem_report_" + std::to_string(::getpid()) + info->name());
    write_text(folder_ / "run.json", manifest(R"("case_title": "A & B <script>alert(1)</script>",)"));
    write_text(folder_ / "case.resolved.toml", "title = \"</pre><script>alert(2)</script>\"\n");
    write_text(folder_ / "tables/revolutions.csv",
               "revolution,time_s,law_volume_mm3,swept_volume_mm3,paper_volume_mm3,depth_mean_mm,depth_sd_mm,"
               "depth_min_mm,"
               "depth_max_mm,width_mean_mm,width_sd_mm,area_mean_mm2,force_mean_N,force_sd_N,force_min_N,"
               "force_max_N,"
               "depth_p_chi2,width_p_chi2\n1,2,0.05,0.05,0.02,0.0081,0.0002,0.0075,0.0088,0.75,0.01,0.004,5,"
               "0.1,4.8,5.2,0.4,\n");
    write_text(folder_ / "tables/contours.csv",
               "revolution,angle_deg,depth_mm,width_mm,area_mm2\n1,0,0.008,0.75,0.004\n");
    write_text(folder_ / "tables/profiles.csv", "revolution,angle_deg,radius_mm,height_mm\n1,0,22,-0.008\n");
    write_text(folder_ / "tables/force.csv",
               "time_s,revolution,normal_force_N,tangential_force_N,overlap_um,contacts\n0.1,1,5,5,40.8,1\n");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  static std::string manifest(const std::string& more) {
    return "{" + more +
           R"("status": "completed", "exit_code": 0, "version": "0.1.0", "commit": "abc", "compiler": "GNU",
      "threads": 2, "seed": 18446744073709551615, "steps": 142857, "wall_seconds": 0.3, "steps_per_second": 476190.0,
      "state_hash": "9f3c", "ledger": {"law_volume_mm3": 0.05, "deposited_volume_mm3": 0.05, "swept_volume_mm3": 0.05,
      "residual_relative": 2e-13, "kappa": 1.0}, "results": {"revolution": 1, "width_p_chi2": null}})";
  }

  std::filesystem::path folder_;
};

}  // namespace abradem::report
