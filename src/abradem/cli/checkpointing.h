// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "abradem/cli/progress.h"
#include "abradem/io/checkpoint.h"
#include "abradem/io/run_record.h"
#include "abradem/io/run_recorder.h"
#include "abradem/simulation/simulation.h"

namespace abradem::cli {

/// A run's work so far, apart from its state.
struct RunState {
  double wall_seconds = 0.0, stepping_seconds = 0.0;
  int resumed = 0;
  std::optional<study::AccelerationChoice> acceleration;
  io::RunRecorder::State recorder;

  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("wall_seconds", self.wall_seconds)("stepping_seconds", self.stepping_seconds);
    archive("resumed", self.resumed)("acceleration", self.acceleration)("recorder", self.recorder);
  }
};

}  // namespace abradem::cli

/// Rotations are kept as the doubles that they are.
template <>
struct abradem::core::archive_detail::Plain<abradem::geometry::Quaternion> {
  using Scalar = double;
};

namespace abradem::cli {

/// What an insertion took from files and other runs.
struct InsertionInputs {
  std::vector<simulation::PlacedSphere> placed;
  std::vector<geometry::Quaternion> turns;
  std::vector<double> radii, shares;

  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("placed", self.placed)("turns", self.turns)("radii", self.radii)("shares", self.shares);
  }
};

/// What a shape took from a file.
struct ShapeInputs {
  geometry::SphereFit fit;
  geometry::MassProperties solid;

  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("fit", self.fit)("solid", self.solid);
  }
};

/// What a run is made of, as text, meshes and tables; it stays the same while the run goes on.
struct RunInputs {
  std::string resolved_case;
  std::vector<geometry::TriangleMesh> meshes;  ///< of the walls that have one, as they began
  std::vector<InsertionInputs> insertions;     ///< of each insertion
  std::vector<ShapeInputs> shapes;             ///< of each shape
  /// Tables of each motion of each wall.
  std::vector<std::vector<std::vector<simulation::MotionRow>>> motions;

  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("resolved_case", self.resolved_case)("meshes", self.meshes)("insertions", self.insertions);
    archive("shapes", self.shapes);
    archive("motions", self.motions);
  }
};
[[nodiscard]] RunInputs inputs_of(const simulation::Simulation& run, std::string resolved_case);

/// Keeps a run safe while it goes on. A copy of its state stays in memory, some seconds old at most; it
/// becomes a file in restart/ at every `[output] checkpoint_every`, when SIGUSR1 asks for it, and where the
/// run ends. With each file run.json is brought up to date, with the status "running".
class Checkpoints {
 public:
  Checkpoints(std::filesystem::path folder, const simulation::Simulation& run, io::RunRecorder& recorder,
              io::RunRecord& record, RunLog& log, const RunInputs& inputs);

  /// Between two steps: saves what is due. A file that cannot be written is a warning; the run goes on.
  void look();
  /// Now, as a file. @param running not at its end, where the record itself follows
  /// @return whether it could be written
  bool save(bool running = true);
  /// The run has gone unphysical: the copy in memory is its last good state, and becomes a file.
  void save_last_good() noexcept;

  /// Time of the run so far, of earlier parts too [s].
  [[nodiscard]] double seconds() const;

 private:
  using Clock = std::chrono::steady_clock;
  void note();
  void write(bool running);

  std::filesystem::path folder_;
  const simulation::Simulation& run_;
  io::RunRecorder& recorder_;
  io::RunRecord& record_;
  RunLog& log_;
  std::string inputs_;  // archived once
  io::Checkpoint copy_;
  std::uint64_t saved_steps_ = ~std::uint64_t{0};
  double earlier_seconds_;
  Clock::time_point start_ = Clock::now(), saved_ = start_, noted_ = start_;
  double cost_ = 0.0;  // of a copy [s]
};

}  // namespace abradem::cli
