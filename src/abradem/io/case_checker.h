// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "abradem/io/case_checks.h"

/// What check_case() is made of; for case_checks*.cpp alone.
namespace abradem::io {

[[nodiscard]] std::string mm(double metres);
/// A length in the unit a person would choose.
[[nodiscard]] std::string readable(double metres);
[[nodiscard]] std::string path_of(std::string_view section, std::string_view name);
/// Is the shape one that the program meshes itself?
[[nodiscard]] bool is_generated(simulation::MeshShape shape) noexcept;

class Checker {
 public:
  Checker(const simulation::Setup& setup, const Places& places, Problems& problems)
      : setup_(setup), places_(places), problems_(problems) {}

  void run();

 private:
  void error(const std::string& path, std::string message) {
    problems_.error(places_.of(path), std::move(message));
  }
  void note(const std::string& path, std::string message) {
    problems_.note(places_.of(path), std::move(message));
  }
  [[nodiscard]] bool good(const std::string& path) const { return places_.good(path); }

  // names and pairs
  bool check_material(const std::string& name, const std::string& path);
  void check_names();
  [[nodiscard]] bool has_contact(const std::string& a, const std::string& b) const;
  void require_contact(const std::string& a, const std::string& b, const std::string& path,
                       const std::string& who);
  void check_contact_pairs();

  // particles in numbers
  void check_insertion_pairs(const simulation::InsertionSetup& insertion);
  void check_shapes();
  void check_insertions();
  void check_face(const simulation::InsertionSetup& i, const std::string& path);
  void check_drawn(const simulation::InsertionSetup& i, const std::string& path);
  void check_left(const simulation::InsertionSetup& i, const std::string& path);

  // wear
  void check_wear_pairs();
  void check_wear_laws();
  void check_expression(const simulation::WearSetup& w, const std::string& path);
  void check_regions();
  void check_ploughing();
  void check_acceleration();

  // walls
  void check_wall(const simulation::WallSetup& wall);
  /// @return false when the shape makes no sense, so that nothing can be said about what lies on it
  bool check_mesh(const simulation::WallSetup& wall, const std::string& path);
  void check_mesh_file(const simulation::MeshSetup& m, const std::string& path);

  // named particles
  void check_particle(const simulation::ParticleSetup& p);
  void check_named_clump(const simulation::ParticleSetup& p, const std::string& path);
  void check_load(const simulation::ParticleSetup& p, const std::string& path);
  void check_placement(const simulation::ParticleSetup& p, const std::string& path);

  // the run and what it is compared with
  void check_run();
  void check_quasi_static();
  void check_measurement();
  void check_published();

  const simulation::Setup& setup_;
  const Places& places_;
  Problems& problems_;
  std::set<std::string> materials_;
  std::set<std::string> unusable_;  // walls whose shape is wrong
  std::set<std::pair<std::string, std::string>> reported_;
};

}  // namespace abradem::io
