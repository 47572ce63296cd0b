// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "abradem/simulation/setup.h"

/// The particles in numbers that a run left in its folder, for another to begin with.
///                                                              docs/theory/bulk.md#from-another-run
namespace abradem::io {

/// Why a path is not the folder of a run with frames of its particles; empty where it is.
[[nodiscard]] std::string why_no_run(const std::filesystem::path& folder);

/// The file of a frame's clumps beside that of its spheres.
[[nodiscard]] std::filesystem::path clumps_beside(std::filesystem::path spheres);

/// The files that an insertion takes its particles from: spheres and, where there are any, clumps.
/// @throws InputError where the run has no frame of that time, IoError where its index cannot be read
[[nodiscard]] std::vector<std::filesystem::path> frame_files(const simulation::VolumeSetup& volume);

/// Fills the places of all insertions that go on with what a run left: of its particles those of the
/// insertion's material and shape, by name, as they were, bit for bit.
/// @return a line for each kind of particle that a run left and that no insertion takes
/// @throws InputError where it left none of that kind, or its shape was another; IoError for a frame that
/// cannot be read
[[nodiscard]] std::vector<std::string> take_from_runs(simulation::Setup& setup);

}  // namespace abradem::io
