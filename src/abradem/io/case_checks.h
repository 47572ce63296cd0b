// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>

#include "abradem/io/case_problems.h"
#include "abradem/simulation/setup.h"

namespace abradem::io {

/// Where each key of the case was written, by its path ("wall.disc.mesh.size"), and which values were wrong,
/// so that the checks between keys neither lose their place nor complain twice.
class Places {
 public:
  void set(const std::string& path, const Place& place) { places_[path] = place; }
  void set_wrong(const std::string& path) { wrong_[path] = true; }
  /// What the files hold that the case names is kept elsewhere, as in a checkpoint: they are not looked at.
  void keep_files() { files_kept_ = true; }
  [[nodiscard]] bool files_kept() const { return files_kept_; }
  /// The value was a number without its unit.
  void set_bare(const std::string& path) { bare_.insert(path); }

  /// The place of the key, or of the nearest table around it that was written.
  [[nodiscard]] Place of(std::string path) const;
  [[nodiscard]] bool bare(const std::string& path) const { return bare_.contains(path); }
  [[nodiscard]] bool given(const std::string& path) const { return places_.contains(path); }
  /// Whether neither the key nor anything inside it was found wrong.
  [[nodiscard]] bool good(const std::string& path) const;

 private:
  std::map<std::string, Place> places_;
  std::map<std::string, bool> wrong_;
  std::set<std::string> bare_;
  bool files_kept_ = false;
};

/// Adds what is wrong between keys: names that do not exist, pairs that are missing, shapes and positions
/// that cannot be meant.
void check_case(const simulation::Setup& setup, const Places& places, Problems& problems);

/// Whether a wall is flat, and lies at the start as its shape is made: where it is follows from the case
/// alone.
[[nodiscard]] bool lies_flat(const simulation::WallSetup& wall) noexcept;

/// Whether something can stick to a wall by JKR, which only points of contact can follow.
[[nodiscard]] bool adheres(const simulation::Setup& setup, const simulation::WallSetup& wall) noexcept;

/// Whether some wall turns or oscillates, so that revolutions can be counted.
[[nodiscard]] bool counts_revolutions(const simulation::Setup& setup) noexcept;

/// How many triangles a generated shape will have, about: its area over that of an equilateral triangle.
[[nodiscard]] double estimated_triangles(const simulation::MeshSetup& mesh) noexcept;

/// Says why a wall of this extent [m] is probably given in the wrong unit of length, seen from a pin of this
/// radius [m]; empty where the two go together.
[[nodiscard]] std::string implausible_extent(std::string_view wall, double extent, std::string_view particle,
                                             double radius);
/// The same of a generated shape; empty for others.
[[nodiscard]] std::string implausible_extent(const simulation::WallSetup& wall, std::string_view particle,
                                             double radius);

}  // namespace abradem::io
