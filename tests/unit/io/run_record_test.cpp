// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/run_record.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace abradem::io {
namespace {

using simulation::MotionKind;
using simulation::WallSetup;

simulation::Setup setup_with(std::initializer_list<MotionKind> motions) {
  simulation::Setup setup;
  for (const MotionKind kind : motions) {
    WallSetup wall;
    wall.motion.kind = kind;
    wall.motion.rate = 1.0;
    wall.motion.frequency = 1.0;
    setup.walls.push_back(wall);
  }
  return setup;
}

TEST(Counted, FirstWallThatTurnsOrOscillatesDecides) {
  EXPECT_EQ(counted(setup_with({MotionKind::none, MotionKind::rotation, MotionKind::oscillation})),
            "revolution");
  EXPECT_EQ(counted(setup_with({MotionKind::translation, MotionKind::oscillation, MotionKind::rotation})),
            "cycle");
  EXPECT_EQ(counted(setup_with({MotionKind::none, MotionKind::translation})), "output");
  simulation::Setup stopped = setup_with({MotionKind::rotation});
  stopped.walls.front().motion.rate = 0.0;
  EXPECT_EQ(counted(stopped), "output");
}

TEST(RunRecord, WritesWhatDoesNotExistAsNullAndTheErrorOnlyWhereThereIsOne) {
  RunRecord record;
  record.last = analysis::RevolutionRow{};
  record.last->depth_mean = std::nan("");
  const auto good = nlohmann::json::parse(to_json(record, setup_with({MotionKind::translation})));
  EXPECT_TRUE(good["results"]["depth_mean_mm"].is_null());
  EXPECT_FALSE(good.contains("error"));
  EXPECT_EQ(good["counted"], "output");
  record.status = "failed";
  record.error = "too deep";
  const auto bad = nlohmann::json::parse(to_json(record, setup_with({})));
  EXPECT_EQ(bad["error"], "too deep");
  EXPECT_EQ(bad["status"], "failed");
}

}  // namespace
}  // namespace abradem::io
