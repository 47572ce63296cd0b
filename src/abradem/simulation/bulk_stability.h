// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "abradem/contact/contact_chunk.h"
#include "abradem/contact/sphere_list.h"
#include "abradem/simulation/bulk_walls.h"
#include "abradem/simulation/clumps.h"
#include "abradem/simulation/stability.h"
#include "abradem/simulation/surroundings.h"

namespace abradem::simulation {

/// Watches whether the step is short enough for the contacts of particles in numbers.
/// docs/theory/time-step.md#particles-in-numbers
class BulkStability {
 public:
  /// Two spheres that swing against each other along their normal, or one against a wall.
  struct Mode {
    std::size_t sphere = 0;
    std::int32_t partner = -1;  ///< index of the other sphere; < 0: the wall
    std::int32_t wall = -1;
    Scheme scheme;
  };

  /// A clump is one body that answers as at its most willing sphere (Clumps::response): its contacts add up.
  /// @param largest the largest 2 g + W of one sphere's contacts together in this step
  /// @return the mode in which a disturbance has grown a thousandfold, if there is one
  [[nodiscard]] std::optional<Mode> watch(const contact::Spheres& spheres, const contact::SphereList& list,
                                          const contact::PairTable& table, const contact::LoadRows& load,
                                          const BulkWalls& walls, const Clumps& clumps,
                                          const Surroundings& around, double largest);
  /// Largest 2 g + W met, of a sphere's contacts together or of a mode. docs/theory/time-step.md
  [[nodiscard]] double worst() const noexcept { return worst_; }

  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("worst", self.worst_)("growing", self.growing_);
  }

 private:
  /// Disturbances that grew and have not died out.
  struct Growing {
    std::int32_t id = 0;
    double ln = 0.0;  ///< of what it was multiplied by

    template <typename Self, typename Archive>
    static void visit(Self& self, Archive& archive) {
      archive("id", self.id)("ln", self.ln);
    }
  };

  double worst_ = 0.0;
  std::vector<Growing> growing_;  // ascending by id
};

}  // namespace abradem::simulation
