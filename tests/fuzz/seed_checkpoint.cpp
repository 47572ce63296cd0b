// SPDX-License-Identifier: BSD-3-Clause
// Writes what fuzz_checkpoint starts from: states of its runs, and a checkpoint file. To be run again
// whenever a state has other fields (FuzzCorpus.StatesAreReadByThisVersion): ninja -C build/ci fuzz_seeds.
// usage: fuzz_seed_checkpoint DIR
#include <fstream>
#include <string>
#include <tuple>

#include "abradem/core/archive.h"
#include "abradem/io/checkpoint.h"
#include "fuzz/checkpoint_case.h"

int main(int argc, char** argv) {
  using namespace abradem;
  if (argc != 2) return 2;
  const std::string folder = argv[1];
  std::string state;
  for (const auto& [name, setup, steps] : {std::tuple("state", test::checkpoint_case(), 40),
                                           std::tuple("grains", test::grains_checkpoint_case(), 6)}) {
    simulation::Simulation run(setup);
    for (int k = 0; k < 2; ++k) {
      core::ArchiveWriter archive;
      run.save(archive);
      state = archive.bytes();
      std::ofstream(folder + "/" + name + "-" + std::to_string(run.steps()), std::ios::binary) << state;
      for (int i = 0; i < steps; ++i) run.step();
    }
  }
  std::ofstream(folder + "/file", std::ios::binary) << io::to_bytes({"0.1.0", "0123456", 7, 40, state});
}
