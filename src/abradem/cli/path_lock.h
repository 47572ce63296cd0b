// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace abradem::cli {

/// A file or folder kept for one user as long as this lives, and for the children that inherit it. Where the
/// file system knows no locks, or the path does not exist, there is none.
class PathLock {
 public:
  enum class Kind { shared, exclusive };
  /// @throws InputError while another has it, also after waiting a few seconds: the children of one that was
  /// killed need a moment to end
  PathLock(const std::filesystem::path& path, Kind kind);
  ~PathLock();
  PathLock(const PathLock&) = delete;
  PathLock& operator=(const PathLock&) = delete;

 private:
  int handle_;
};

}  // namespace abradem::cli
