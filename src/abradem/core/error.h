// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

namespace abradem {

/// What the process returns; documented in docs/reference/exit-codes.md.
enum class ExitCode : int {
  ok = 0,
  internal = 1,
  input = 2,       ///< command line or case file
  geometry = 3,    ///< a mesh that cannot be read or used
  unphysical = 4,  ///< the run left the range its equations hold in; the last good state is kept
  io = 5,          ///< a file or folder cannot be read or written
  interrupted = 130,
};

/// An error a person can act on: the message is complete (what, where, what was expected, what to try).
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  [[nodiscard]] ExitCode code() const noexcept { return code_; }

 private:
  ExitCode code_;
};

struct InputError : Error {
  explicit InputError(const std::string& message) : Error(ExitCode::input, message) {}
};
struct GeometryError : Error {
  explicit GeometryError(const std::string& message) : Error(ExitCode::geometry, message) {}
};
struct SimulationError : Error {
  explicit SimulationError(const std::string& message) : Error(ExitCode::unphysical, message) {}
};
/// Someone asked to stop.
struct Interrupted : Error {
  explicit Interrupted(const std::string& message) : Error(ExitCode::interrupted, message) {}
};
struct IoError : Error {
  explicit IoError(const std::string& message) : Error(ExitCode::io, message) {}
};

}  // namespace abradem
