// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <omp.h>

#include <map>
#include <string>

#include "abradem/core/archive.h"
#include "abradem/core/random.h"
#include "abradem/simulation/simulation.h"

/// Runs that are saved and put back.
namespace abradem::test {

using simulation::Ledger;
using simulation::Setup;
using simulation::Simulation;

/// Everything, as bytes: more than the state's hash.
inline std::string saved(const Simulation& run) {
  core::ArchiveWriter archive;
  run.save(archive);
  return archive.take();
}

inline Simulation loaded(const Setup& setup, const std::string& bytes) {
  Simulation run(setup);
  core::ArchiveReader archive(bytes);
  run.load(archive);
  EXPECT_TRUE(archive.at_end());
  return run;
}

inline void finish(Simulation& run, std::uint64_t steps) {
  while (run.steps() < steps) run.step();
}

/// Saves at a dozen steps, goes on from each in a new run, and compares with the run that was never broken
/// off.
inline void expect_same_bits_from_anywhere(const Setup& setup, std::uint64_t steps) {
  Simulation whole(setup);
  core::RandomStream random(7, 1);
  std::map<std::uint64_t, std::string> states;
  for (int i = 0; i < 12; ++i)
    states[static_cast<std::uint64_t>(random.uniform() * static_cast<double>(steps))].clear();
  for (auto& [from, state] : states) {
    finish(whole, from);
    state = saved(whole);
  }
  finish(whole, steps);
  const std::string end = saved(whole);
  const Ledger ledger = whole.ledger();
  EXPECT_GT(ledger.law, 0.0);
  for (const auto& [from, state] : states) {
    Simulation run = loaded(setup, state);
    EXPECT_TRUE(saved(run) == state) << "from step " << from;
    finish(run, steps);
    EXPECT_TRUE(saved(run) == end) << "from step " << from;
    EXPECT_EQ(run.state_hash(), whole.state_hash()) << "from step " << from;
    const Ledger other = run.ledger();
    EXPECT_EQ(other.swept, ledger.swept);
    EXPECT_EQ(other.paper, ledger.paper);
    EXPECT_EQ(other.deposited, ledger.deposited);
  }
}

/// Saves in the middle of a run on one thread, goes on with three, and compares with the one that kept its
/// own.
inline void expect_same_bits_on_other_threads(const Setup& setup, std::uint64_t middle, std::uint64_t end) {
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  Simulation whole(setup);
  finish(whole, middle);
  const std::string state = saved(whole);
  finish(whole, end);
  omp_set_num_threads(3);
  Simulation run = loaded(setup, state);
  finish(run, end);
  omp_set_num_threads(before);
  EXPECT_TRUE(saved(run) == saved(whole));
}

}  // namespace abradem::test
