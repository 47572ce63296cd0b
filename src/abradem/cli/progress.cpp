// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/cli/progress.h"

#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>

#include "abradem/cli/print.h"
#include "abradem/core/error.h"

namespace abradem::cli {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_between(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

/// A count with its thousands set apart: 1,250,000.
std::string grouped(double count) {
  const std::string digits = fmt::format("{:.0f}", count);
  std::string out;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) out += ',';
    out += digits[i];
  }
  return out;
}

}  // namespace

std::string clock_time(double seconds) {
  if (!std::isfinite(seconds) || seconds > 3.6e6) return "a long time";
  const auto s = static_cast<long>(std::lround(seconds));
  return s >= 3600 ? fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60)
                   : fmt::format("{}:{:02}", s / 60, s % 60);
}

RunLog::RunLog(const std::filesystem::path& path, bool quiet, bool append)
    : file_(std::fopen(path.c_str(), append ? "ae" : "we")),
      quiet_(quiet),
      terminal_(!quiet && isatty(STDERR_FILENO) != 0) {
  if (file_ == nullptr)
    throw IoError(fmt::format("cannot write '{}': {}", path.string(), std::strerror(errno)));
}

RunLog::~RunLog() { std::fclose(file_); }

void RunLog::record(std::string_view text) {
  // A log that the disk has no room for must not end the run; the results, written later, say so.
  std::fputs(fmt::format("{:10.3f} s  {}\n", seconds_between(start_, Clock::now()), text).c_str(), file_);
  std::fflush(file_);
}

void RunLog::line(std::string_view text) {
  record(text);
  if (quiet_) return;
  clear_status();
  print_message(text);
}

void RunLog::warning(std::string_view text) { always(fmt::format("warning: {}", text)); }
void RunLog::error(std::string_view text) { always(fmt::format("abradem: error: {}", text)); }

void RunLog::always(std::string_view text) {
  record(text);
  clear_status();
  print_message(text);
}

void RunLog::status(std::string_view text) {
  print_raw(fmt::format("\r\033[K{}", text));
  status_shown_ = true;
}

void RunLog::clear_status() {
  if (status_shown_) print_raw("\r\033[K");
  status_shown_ = false;
}

std::string Progress::state(const simulation::Simulation& run) const {
  const double elapsed = seconds_between(start_, Clock::now());
  const auto steps = static_cast<double>(run.steps()), total = static_cast<double>(run.total_steps());
  const double left = steps > 0.0 ? elapsed * (total - steps) / steps : 0.0;
  std::string where = run.turns() ? fmt::format("{} {:.2f}", io::counted(run.setup()), run.revolution())
                                  : fmt::format("{:.4g} s", run.test_time());
  if (run.settling()) where += ", settling";
  const double planes = run.plane_volume();
  return fmt::format("{}{}  {:.0f} %  {} steps/s  wear {:.4g} mm^3{}  {} left", what_, where,
                     100.0 * steps / total, grouped(steps / std::max(elapsed, 1e-9)), 1e9 * run.law_volume(),
                     planes > 0.0 ? fmt::format(" (and {:.4g} on planes)", 1e9 * planes) : "",
                     clock_time(left));
}

void Progress::update(const simulation::Simulation& run) {
  const Clock::time_point now = Clock::now();
  const double interval = log_.on_terminal() ? 0.1 : 10.0;
  if (seconds_between(shown_, now) < interval) return;
  shown_ = now;
  if (log_.on_terminal())
    log_.status(state(run));
  else
    log_.line(state(run));
}

void Progress::output(const simulation::Simulation& run, const io::RunRecorder& recorder) {
  const auto& row = *recorder.last();
  const std::string depth = row.depth_mean > 0.0 ? fmt::format("  depth {:.3f} um  width {:.3f} mm",
                                                               1e6 * row.depth_mean, 1e3 * row.width_mean)
                                                 : "";
  const simulation::BulkState bulk = run.bulk_state();
  log_.line(fmt::format(
      "{}{}{}{}", state(run), depth,
      run.particles().size() > 0 ? fmt::format("  normal force {:.4g} N", row.force_mean) : "",
      bulk.inserted > 0 ? fmt::format("  {} particles, {} removed", bulk.present, bulk.removed) : ""));
}

void summarise(const io::RunRecord& record, RunLog& log) {
  const simulation::Ledger& l = record.ledger;
  if (!record.error.empty()) log.error(record.error);
  log.line(fmt::format("{} after {} steps in {:.2f} s ({} steps/s)", record.status, record.steps,
                       record.wall_seconds,
                       grouped(static_cast<double>(record.steps) / std::max(record.stepping_seconds, 1e-9))));
  log.line(
      fmt::format("ledger: law {:.9g} mm^3, deposited {:.9g}, swept {:.9g}; residual {:.2g}, kappa {:.6g}",
                  1e9 * l.law, 1e9 * l.deposited, 1e9 * l.swept, l.residual, l.kappa));
  if (l.planes > 0.0)
    log.line(fmt::format("analytic planes, which keep their shape: law {:.9g} mm^3 besides", 1e9 * l.planes));
  log.line(fmt::format("state {:016x}", record.state_hash));
}

}  // namespace abradem::cli
