// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/cli/stop_signals.h"

namespace abradem::cli {

namespace {

volatile std::sig_atomic_t stop_requested = 0;
volatile std::sig_atomic_t checkpoint_requested = 0;
void request_stop(int) { stop_requested = 1; }
void request_checkpoint(int) { checkpoint_requested = 1; }

}  // namespace

bool StopSignals::requested() noexcept { return stop_requested != 0; }

bool StopSignals::take_checkpoint_request() noexcept {
  if (checkpoint_requested == 0) return false;
  checkpoint_requested = 0;
  return true;
}

StopSignals::StopSignals() {
  stop_requested = 0;
  checkpoint_requested = 0;
  struct sigaction action {};
  action.sa_handler = request_stop;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, &interrupt_);
  sigaction(SIGTERM, &action, &terminate_);
  sigaction(SIGHUP, nullptr, &hang_up_);
  if (hang_up_.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);  // not under nohup
  action.sa_handler = request_checkpoint;
  action.sa_flags = SA_RESTART;
  sigaction(SIGUSR1, &action, &user_);
  action.sa_handler = SIG_IGN;
  action.sa_flags = 0;
  sigaction(SIGPIPE, &action, &pipe_);
}

StopSignals::~StopSignals() {
  sigaction(SIGINT, &interrupt_, nullptr);
  sigaction(SIGTERM, &terminate_, nullptr);
  sigaction(SIGHUP, &hang_up_, nullptr);
  sigaction(SIGPIPE, &pipe_, nullptr);
  sigaction(SIGUSR1, &user_, nullptr);
}

}  // namespace abradem::cli
