// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "abradem/simulation/simulation.h"

namespace abradem::cli {

/// A simulation's MeshSource: meshes the generated shapes; reads, repairs and judges the others, with
/// warnings on stderr.
class MeshLoader {
 public:
  explicit MeshLoader(const simulation::Setup& setup);

  /// @throws IoError, GeometryError for a file that cannot be read or used
  [[nodiscard]] geometry::TriangleMesh operator()(const simulation::MeshSetup& mesh,
                                                  std::uint64_t seed) const;

 private:
  std::optional<double> largest_radius_;  // of the particles [m]
};

}  // namespace abradem::cli
