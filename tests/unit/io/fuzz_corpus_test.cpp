// SPDX-License-Identifier: BSD-3-Clause
// What the fuzzers start from must get past the first check of each reader, or they stay in front of it.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include "abradem/core/archive.h"
#include "abradem/io/checkpoint.h"
#include "abradem/io/vtp_read.h"
#include "fuzz/checkpoint_case.h"

namespace abradem::io {
namespace {

const std::filesystem::path kCorpus = std::filesystem::path(ABRADEM_SOURCE_DIR) / "tests/fuzz/corpus";

std::string content(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Loads a state and takes it one step on.
void go_on(const simulation::Setup& setup, const std::string& state) {
  simulation::Simulation run(setup);
  core::ArchiveReader archive(state);
  ASSERT_NO_THROW(run.load(archive)) << "write them anew: ninja -C build/ci fuzz_seeds"
                                     << kCorpus / "checkpoint";
  EXPECT_NO_THROW(run.step());
}

TEST(FuzzCorpus, StatesAreReadByThisVersion) {
  std::set<std::string> seen;
  for (const auto& entry : std::filesystem::directory_iterator(kCorpus / "checkpoint")) {
    SCOPED_TRACE(entry.path());
    const std::string name = entry.path().filename().string();
    seen.insert(name);
    if (name.starts_with("state-")) go_on(test::checkpoint_case(), content(entry.path()));
    if (name.starts_with("grains-")) go_on(test::grains_checkpoint_case(), content(entry.path()));
  }
  for (const char* name : {"state-0", "state-40", "grains-0", "grains-6", "file"})
    EXPECT_EQ(seen.count(name), 1U) << name;
  go_on(test::grains_checkpoint_case(), checkpoint_from(content(kCorpus / "checkpoint/file")).state);
}

TEST(FuzzCorpus, HoldsAStateOfParticlesThatTouchEverything) {
  const simulation::Setup setup = test::grains_checkpoint_case();
  simulation::Simulation run(setup);
  const std::string state = content(kCorpus / "checkpoint/grains-6");
  core::ArchiveReader archive(state);
  run.load(archive);
  for (int i = 0; i < 2; ++i) run.step();
  const simulation::BulkState now = run.bulk_state();
  EXPECT_GT(now.pair_contacts, 1U);
  EXPECT_GT(now.wall_contacts, 1U);
  EXPECT_GT(now.inserted, 5U);
}

TEST(FuzzCorpus, SurfacesAreReadByThisVersion) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kCorpus / "vtp")) {
    SCOPED_TRACE(entry.path());
    if (entry.path().filename().string().starts_with("surface-")) {
      EXPECT_FALSE(read_vtp(entry.path()).mesh.triangles.empty());
    } else if (entry.path().filename() == "series") {
      EXPECT_FALSE(read_pvd(entry.path()).empty());
    }
    ++files;
  }
  EXPECT_GE(files, 4U);
}

}  // namespace
}  // namespace abradem::io
