// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <string>
#include <vector>

namespace abradem::cli {

/// This program again, as children that run beside it. They are told to stop when it dies, however that
/// happens.
class ChildProcesses {
 public:
  ChildProcesses() = default;
  /// Stops those left and waits for them.
  ~ChildProcesses();
  ChildProcesses(const ChildProcesses&) = delete;
  ChildProcesses& operator=(const ChildProcesses&) = delete;

  /// @param number what wait() calls it   @param arguments after the name of the program
  /// @throws IoError when no process can be started
  void start(std::size_t number, const std::vector<std::string>& arguments);

  struct Ended {
    std::size_t number = 0;
    int exit_code = 0;  ///< 128 + n when signal n ended it
    std::string said;   ///< the end of what it wrote to stdout and stderr
  };
  /// Those that ended; waits for one up to this long. A signal ends the waiting.
  [[nodiscard]] std::vector<Ended> wait(int milliseconds);

  /// Asks all politely to stop (SIGTERM); they are still to be waited for.
  void stop() noexcept;

  [[nodiscard]] std::size_t running() const noexcept { return children_.size(); }

 private:
  struct Child {
    std::size_t number;
    pid_t process;
    int pipe;
    std::string said;
  };
  std::vector<Child> children_;
};

}  // namespace abradem::cli
