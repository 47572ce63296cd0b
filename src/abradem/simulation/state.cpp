// SPDX-License-Identifier: BSD-3-Clause
// What a run is at a moment: saved, and put back. docs/reference/resume.md#state
#include <algorithm>
#include <cmath>

#include "abradem/core/archive.h"
#include "abradem/simulation/simulation.h"

namespace abradem::simulation {

/// Everything that changes from step to step and that a step does not make anew. What follows from the setup
/// alone (masses, pairs, poses, the grid over the unworn mesh) is not here.
template <typename Self, typename Archive>
void Simulation::visit(Self& self, Archive& archive) {
  archive("steps", self.steps_)("dt", self.dt_)("steps_per_output", self.steps_per_output_);
  archive.fixed("position", self.particles_.position).fixed("velocity", self.particles_.velocity);
  archive.fixed("spin", self.particles_.spin);
  archive.fixed("law", self.law_).fixed("paper", self.paper_).fixed("displaced", self.displaced_);
  archive.fixed("account", self.account_);
  for (auto& map : self.maps_)
    if (map) archive("map", *map);
  for (auto& wall : self.walls_)
    if (!wall.is_plane()) archive("surface", wall.surface());
  for (auto& tip : self.tips_)
    if (tip) archive("tip", *tip);
  archive.fixed("tip_law", self.tip_law_);
  archive.fixed("sphere_walls", self.sphere_walls_);
  if (self.bulk_) archive("bulk", *self.bulk_);
  archive.fixed("stiffness_ratio", self.stiffness_ratio_)("worst_damping", self.worst_damping_);
  archive.fixed("growth", self.growth_);
}

void Simulation::save(core::ArchiveWriter& archive) const { visit(*this, archive); }

void Simulation::load(core::ArchiveReader& archive) {
  visit(*this, archive);
  archive.require(dt_ > 0.0 && std::isfinite(dt_) && steps_per_output_ > 0 && end_ / dt_ < 1e15,
                  "belongs to a time step that cannot be");
  archive.require(std::ranges::all_of(particles_.position, is_finite) &&
                      std::ranges::all_of(particles_.velocity, is_finite) &&
                      std::ranges::all_of(particles_.spin, is_finite),
                  "belongs to particles that are nowhere");
  for (Wall& wall : walls_)
    archive.require(wall.is_plane() || wall.surface().restored(),
                    "belongs to piles that do not fit the wall");
  for (auto& tip : tips_) archive.require(!tip || tip->restored(), "belongs to a worn tip that is no map");
  count_steps();
  move_walls();
  for (std::size_t k = 0; k < sphere_walls_.size(); ++k)
    archive.require(sphere_walls_[k].restore(walls_[k % walls_.size()]),
                    "belongs to candidates that do not fit the wall");
  archive.require(!bulk_ || bulk_->restore(surroundings()), "belongs to particles that do not fit the case");
}

}  // namespace abradem::simulation
