// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/cli/child_processes.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

#include "abradem/core/error.h"

namespace abradem::cli {
namespace {

constexpr std::size_t kKept = 4096;  // of what a child says: the message is at the end

/// In the child, between fork and exec: only what is safe in a process of which other threads are gone.
[[noreturn]] void become_program(pid_t parent, int null, int pipe, char* const* arguments) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(128 + SIGTERM);  // it died before it could be watched
  dup2(null, STDIN_FILENO);
  dup2(pipe, STDOUT_FILENO);
  dup2(pipe, STDERR_FILENO);
  // The very file that runs now, even if a newer one has taken its place meanwhile.
  execv("/proc/self/exe", arguments);
  constexpr std::string_view kWhy = "abradem: error: the program cannot be started again\n";
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, kWhy.data(), kWhy.size());
  _exit(static_cast<int>(ExitCode::io));
}

[[noreturn]] void cannot_start() {
  throw IoError(fmt::format("no process can be started: {}", std::strerror(errno)));
}

/// Reads what has come. @return false at the end
bool read_some(int pipe, std::string& said) {
  std::array<char, 4096> block;
  const ssize_t n = read(pipe, block.data(), block.size());
  if (n < 0) return errno == EINTR || errno == EAGAIN;
  said.append(block.data(), static_cast<std::size_t>(n));
  if (said.size() > 2 * kKept) said.erase(0, said.size() - kKept);
  return n > 0;
}

int exit_code_of(pid_t process) {
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

ChildProcesses::~ChildProcesses() {
  stop();
  for (const Child& child : children_) {
    close(child.pipe);
    exit_code_of(child.process);
  }
}

void ChildProcesses::start(std::size_t number, const std::vector<std::string>& arguments) {
  std::vector<std::string> texts{"abradem"};
  texts.insert(texts.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);

  std::array<int, 2> ends{};
  const int null = open("/dev/null", O_RDONLY | O_CLOEXEC);
  if (null < 0) cannot_start();
  if (pipe2(ends.data(), O_CLOEXEC) != 0) {
    close(null);
    cannot_start();
  }
  const pid_t parent = getpid();
  const pid_t process = fork();
  if (process == 0) become_program(parent, null, ends[1], pointers.data());
  close(null);
  close(ends[1]);
  if (process < 0) {
    close(ends[0]);
    cannot_start();
  }
  children_.push_back({number, process, ends[0], {}});
}

std::vector<ChildProcesses::Ended> ChildProcesses::wait(int milliseconds) {
  std::vector<pollfd> watched;
  for (const Child& child : children_) watched.push_back({child.pipe, POLLIN, 0});
  std::vector<Ended> ended;
  if (poll(watched.data(), watched.size(), milliseconds) <= 0) return ended;
  // A pipe without writers means that its child has ended: nobody else has the other end.
  std::vector<Child> left;
  for (std::size_t i = 0; i < children_.size(); ++i) {
    Child& child = children_[i];
    if (watched[i].revents == 0 || read_some(child.pipe, child.said)) {
      left.push_back(std::move(child));
      continue;
    }
    close(child.pipe);
    ended.push_back({child.number, exit_code_of(child.process), std::move(child.said)});
  }
  children_ = std::move(left);
  return ended;
}

void ChildProcesses::stop() noexcept {
  for (const Child& child : children_) kill(child.process, SIGTERM);
}

}  // namespace abradem::cli
