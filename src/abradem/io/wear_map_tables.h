// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "abradem/io/vtp.h"
#include "abradem/simulation/simulation.h"

/// What a run leaves of its walls' elements at its end. Sums are those of the test: an acceleration
/// multiplies them. docs/reference/output.md
namespace abradem::io {

/// tables/wear.csv: the elements of the worn wall that lost material, in its reference numbering; where maps
/// are kept, all elements that were touched, of all walls with a map, with what they suffered.
/// Where maps are kept also tables/wear_integrals.csv, tables/sliding_spectrum.csv and
/// tables/impact_spectrum.csv, which `abradem rewear` reads.   @throws IoError
/// @param worn_wall the wall that wear.csv is about where no maps are kept
void write_wear_maps(const std::filesystem::path& tables, const simulation::Simulation& run,
                     std::optional<std::size_t> worn_wall);

/// The map of one wall as arrays on its triangles; `arrays` points into `values`.
struct MapArrays {
  std::vector<std::vector<double>> values;
  std::vector<VtpArray> arrays;
};
/// @param wall of a mesh; without a map: the worn volume alone
[[nodiscard]] MapArrays map_arrays(const simulation::Simulation& run, std::size_t wall);

}  // namespace abradem::io
