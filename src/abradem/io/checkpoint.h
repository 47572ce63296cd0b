// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Checkpoints of a run as files in its folder's restart/.                     docs/reference/resume.md#files
///
///   bytes    what
///   8        "\x89ABRADM\n"
///   4        version of this format, little-endian as everything
///   8        length of the rest
///   8        checksum of the rest (core::StateHash over its words)
///   rest     an archive (core/archive.h): who wrote it, of what inputs, at which step; then the state
namespace abradem::io {

struct Checkpoint {
  std::string version, commit;    ///< of the program that wrote it
  std::uint64_t inputs_hash = 0;  ///< inputs_hash() of the run
  std::uint64_t steps = 0;
  std::string state;  ///< archive of the run

  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("version", self.version)("commit", self.commit)("inputs_hash", self.inputs_hash);
    archive("steps", self.steps)("state", self.state);
  }
};

/// The bytes of a checkpoint file, and back.
[[nodiscard]] std::string to_bytes(const Checkpoint& checkpoint);
/// @throws IoError saying what is wrong: no checkpoint, of another format, cut short, damaged
[[nodiscard]] Checkpoint checkpoint_from(std::string_view bytes);

/// Writes restart/step-<steps>.checkpoint: on the disk before it takes its name. The last two are kept.
/// @return the file   @throws IoError; what was there is then still there
std::filesystem::path write_checkpoint(const std::filesystem::path& folder, const Checkpoint& checkpoint);

/// The checkpoint files of a run's folder, the newest first.
[[nodiscard]] std::vector<std::filesystem::path> checkpoint_files(const std::filesystem::path& folder);

/// Reads one. @throws IoError naming the file
[[nodiscard]] Checkpoint read_checkpoint(const std::filesystem::path& file);

/// The newest checkpoint that can be read; none where there is none.
/// @param refused gets a line for each that had to be passed over
[[nodiscard]] std::optional<Checkpoint> newest_checkpoint(const std::filesystem::path& folder,
                                                          std::vector<std::string>* refused = nullptr);

}  // namespace abradem::io
