// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace abradem::test {

/// What the program did.
struct Outcome {
  int exit_code = -1;  ///< 128 + n when signal n ended it
  std::string out, err;
};

/// Runs the program with these arguments (a shell reads them) in the given folder.
/// @param before shell commands that go before it, such as "ulimit -f 40"
[[nodiscard]] Outcome run_program(const std::string& arguments, const std::filesystem::path& folder = ".",
                                  const std::string& before = "true");

/// Runs the program likewise, and sends it a signal as soon as a file (a path in the folder) exists.
/// @return its exit code, or 1000 + the signal that ended it
[[nodiscard]] int break_off(const std::string& arguments, const std::filesystem::path& folder,
                            const std::filesystem::path& file, int signal);

/// A folder of its own, removed at the end.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
};

[[nodiscard]] std::string read_file(const std::filesystem::path& path);
void write_file(const std::filesystem::path& path, const std::string& text);

}  // namespace abradem::test
