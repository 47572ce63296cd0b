// SPDX-License-Identifier: BSD-3-Clause
#include "cli/program.h"

#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <thread>

namespace abradem::test {

namespace fs = std::filesystem;

int break_off(const std::string& arguments, const fs::path& folder, const fs::path& file, int signal) {
  const pid_t child = ::fork();
  if (child == 0) {
    const std::string command = "cd '" + folder.string() + "' && exec '" ABRADEM_PROGRAM "' " + arguments;
    ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    ::_exit(127);
  }
  for (int i = 0; i < 12000 && !fs::exists(folder / file); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  ::kill(child, signal);
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
}

ScratchFolder::ScratchFolder() {
  std::string pattern = (fs::temp_directory_path() / "abradem-test-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no scratch folder: " + pattern);
  path_ = pattern;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string read_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_file(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

Outcome run_program(const std::string& arguments, const fs::path& folder, const std::string& before) {
  const ScratchFolder scratch;
  const fs::path errors = scratch.path() / "stderr";
  const std::string command = "cd '" + folder.string() + "' && " + before +
                              " && exec '" ABRADEM_PROGRAM "' " + arguments + " 2>'" + errors.string() + "'";
  std::FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot start a shell");
  Outcome outcome;
  char buffer[4096];
  for (std::size_t n = 0; (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;)
    outcome.out.append(buffer, n);
  const int status = ::pclose(pipe);
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  outcome.err = read_file(errors);
  return outcome;
}

}  // namespace abradem::test
