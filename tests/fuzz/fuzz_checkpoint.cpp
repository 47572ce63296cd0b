// SPDX-License-Identifier: BSD-3-Clause
// Any bytes as a checkpoint file, and as the state of a run behind its checksum: a run that can be stepped
// on, or an error of ours.
#include <cstdint>
#include <string_view>

#include "abradem/core/archive.h"
#include "abradem/core/error.h"
#include "abradem/io/checkpoint.h"
#include "fuzz/checkpoint_case.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace abradem;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    (void)io::checkpoint_from(bytes);
  } catch (const Error&) {
  }
  for (const simulation::Setup& setup : {test::checkpoint_case(), test::grains_checkpoint_case()}) {
    try {
      simulation::Simulation run(setup);
      core::ArchiveReader archive(bytes);
      run.load(archive);
      run.step();
      core::ArchiveWriter again;
      run.save(again);
    } catch (const Error&) {
    }
  }
  return 0;
}
