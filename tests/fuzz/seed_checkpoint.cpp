// SPDX-License-Identifier: BSD-3-Clause
// Writes what fuzz_checkpoint starts from: states of its run, and a checkpoint file. usage:
// fuzz_seed_checkpoint DIR
#include <fstream>
#include <string>

#include "abradem/core/archive.h"
#include "abradem/io/checkpoint.h"
#include "fuzz/checkpoint_case.h"

int main(int argc, char** argv) {
  using namespace abradem;
  if (argc != 2) return 2;
  const std::string folder = argv[1];
  simulation::Simulation run(test::checkpoint_case());
  for (int k = 0; k < 2; ++k) {
    core::ArchiveWriter archive;
    run.save(archive);
    std::ofstream(folder + "/state-" + std::to_string(run.steps()), std::ios::binary) << archive.bytes();
    for (int i = 0; i < 40; ++i) run.step();
  }
  std::ofstream(folder + "/file", std::ios::binary)
      << io::to_bytes({"0.1.0", "0123456", 7, 40, "not a state"});
}
