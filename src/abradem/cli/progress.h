// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "abradem/io/run_record.h"
#include "abradem/io/run_recorder.h"
#include "abradem/simulation/simulation.h"

namespace abradem::cli {

/// A time as a person reads it off a clock: "1:02:03" or "4:05".
[[nodiscard]] std::string clock_time(double seconds);

/// Lines of a run: into run.log with the time since the start, and onto stderr unless quiet. Warnings and
/// errors always reach stderr.
class RunLog {
 public:
  /// @throws IoError when the file cannot be written
  RunLog(const std::filesystem::path& path, bool quiet, bool append = false);
  ~RunLog();
  RunLog(const RunLog&) = delete;
  RunLog& operator=(const RunLog&) = delete;

  void line(std::string_view text);
  /// Into the file alone.
  void record(std::string_view text);
  void warning(std::string_view text);
  void error(std::string_view text);
  [[nodiscard]] bool quiet() const noexcept { return quiet_; }
  /// stderr is a terminal that can show a line that changes.
  [[nodiscard]] bool on_terminal() const noexcept { return terminal_; }
  /// Wipes the changing line, if there is one; what follows starts on a clean line.
  void clear_status();
  void status(std::string_view text);

 private:
  void always(std::string_view text);
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::FILE* file_ = nullptr;
  bool quiet_, terminal_, status_shown_ = false;
};

/// Speed, wear so far and time left: a changing line on a terminal, a plain line now and then elsewhere.
class Progress {
 public:
  /// @param what the run is for; empty: it is the run itself
  explicit Progress(RunLog& log, std::string what = {}) : log_(log), what_(std::move(what)) {}
  void update(const simulation::Simulation& run);
  /// A line per output.
  void output(const simulation::Simulation& run, const io::RunRecorder& recorder);
  void finish() { log_.clear_status(); }

 private:
  [[nodiscard]] std::string state(const simulation::Simulation& run) const;
  RunLog& log_;
  std::string what_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now(), shown_ = start_;
};

/// The end of a run in a few lines.
void summarise(const io::RunRecord& record, RunLog& log);

}  // namespace abradem::cli
