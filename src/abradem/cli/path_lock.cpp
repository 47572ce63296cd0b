// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/cli/path_lock.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <thread>

#include "abradem/cli/stop_signals.h"
#include "abradem/core/error.h"

namespace abradem::cli {

PathLock::PathLock(const std::filesystem::path& path, Kind kind) : handle_(open(path.c_str(), O_RDONLY)) {
  if (handle_ < 0) return;
  constexpr int kTries = 60;
  constexpr auto kPause = std::chrono::milliseconds(50);
  const int operation = (kind == Kind::shared ? LOCK_SH : LOCK_EX) | LOCK_NB;
  for (int i = 0; i < kTries; ++i) {
    if (flock(handle_, operation) == 0 || errno != EWOULDBLOCK) return;
    if (StopSignals::requested()) break;
    std::this_thread::sleep_for(kPause);
  }
  close(handle_);
  throw InputError(fmt::format("another abradem works on '{}'; wait for it to end", path.string()));
}

PathLock::~PathLock() {
  if (handle_ >= 0) close(handle_);
}

}  // namespace abradem::cli
