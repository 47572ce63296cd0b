// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace abradem::cli {

/// The folder of a run: created, or emptied of an earlier run when `force` is given. Only what a run writes
/// is ever deleted, and only from a folder that holds a run; nothing is deleted before the folder has proved
/// writable. A run that does not get under way leaves nothing: unless kept, what was written and created goes
/// again.
class OutputFolder {
 public:
  /// @throws InputError when the path is no folder, holds something, or holds what is not a run
  /// @throws IoError when it cannot be created or written; then nothing is left
  OutputFolder(std::filesystem::path folder, bool force);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// The run has something to show: from now on the folder stays.
  void keep() noexcept { kept_ = true; }

 private:
  void create();
  void take_over(bool force);
  void discard() noexcept;

  std::filesystem::path folder_;
  std::vector<std::filesystem::path> created_;  // outermost first
  bool kept_ = false;
};

/// Refuses, before any work, a folder that the results of a command may not be written to.
/// @param record file by which an earlier result of that kind is known   @param what "a calibration"
/// @throws InputError when it is a file, holds other things, or holds such a result and `force` is not given
void check_result_folder(const std::filesystem::path& folder, std::string_view record, std::string_view what,
                         bool force);

/// What a file holds; nothing where it is missing or cannot be read.
[[nodiscard]] std::string read_file(const std::filesystem::path& path);

/// Writes a whole file. @throws IoError
void write_file(const std::filesystem::path& path, std::string_view text);

}  // namespace abradem::cli
