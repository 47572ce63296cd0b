// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <csignal>

namespace abradem::cli {

/// Ctrl-C, a polite kill and a closed terminal end the work at the next look, with everything written; a
/// second one ends it at once. A reader that goes away (`… | head`) does not. One at a time.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  /// Has someone asked to stop since the signals were taken over?
  [[nodiscard]] static bool requested() noexcept;
  /// Has someone asked for a checkpoint (SIGUSR1) since this was asked last?
  [[nodiscard]] static bool take_checkpoint_request() noexcept;

 private:
  struct sigaction interrupt_ {
  }, terminate_{}, hang_up_{}, pipe_{}, user_{};
};

}  // namespace abradem::cli
